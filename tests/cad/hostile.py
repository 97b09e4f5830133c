# SPDX-License-Identifier: BSD-3-Clause
"""Files called .step that are no mechanism, or are made to harm.

`HOSTILE` has them by name, as functions of the path to write and of a size; `FULL` says how large
they are meant to be, the tests make them small. What must happen: the file is refused in words,
with exit code 1 or 2, within 60 s and 4 GB. `BORDERLINE` are files that may also be read, with what
is odd in them told. No OpenCASCADE is needed but for those that spoil a good file.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from pathlib import Path

HEAD = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('{name}','2026-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
"""
TAIL = "ENDSEC;\nEND-ISO-10303-21;\n"

Make = Callable[[Path, int], None]
HOSTILE: dict[str, Make] = {}
BORDERLINE: dict[str, Make] = {}
#: Sizes that the files are meant to have, where that is not 1.
FULL = {
    "many points": 1_000_000,
    "many boxes": 5_000,
    "one long line": 100_000_000,
    "one long comment": 100_000_000,
    "zeros": 100_000_000,
    "noise": 20_000_000,
    "deep brackets": 1_000_000,
    "long name": 10_000_000,
    "assemblies of assemblies": 6,
    "chain of references": 1_000_000,
}


def hostile(name: str, *, borderline: bool = False) -> Callable[[Make], Make]:
    def known(make: Make) -> Make:
        (BORDERLINE if borderline else HOSTILE)[name] = make
        return make

    return known


def _text(path: Path, data: str) -> None:
    path.write_text(HEAD.format(name="x") + data + TAIL, "latin-1")


def good_text() -> str:
    """A parallel guide in an assembly, as text to be spoiled."""
    import tempfile

    from .designs import CASES

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "good.step"
        CASES["guide, one assembly twice"]().write(path)
        return path.read_text("latin-1")


# No STEP


#: How the unit of length stands in the files that are changed.
_MILLIMETRE = r"\( LENGTH_UNIT\(\) NAMED_UNIT\(\*\) SI_UNIT\(\.MILLI\.,\.METRE\.\) \)"


@hostile("nothing")
def nothing(path: Path, size: int) -> None:
    path.write_bytes(b"")


@hostile("prose")
def prose(path: Path, size: int) -> None:
    path.write_text("Dear colleague,\nplease find the model attached.\n")


@hostile("a deck")
def deck(path: Path, size: int) -> None:
    path.write_text("RBEAM 1 1 2 3 4 0 1 0\nX 1 0 0 0\nX 3 1 0 0\nFIX 1\nEND\nHALT\n")


@hostile("zeros")
def zeros(path: Path, size: int) -> None:
    path.write_bytes(bytes(size))


@hostile("noise")
def noise(path: Path, size: int) -> None:
    path.write_bytes(random.Random(1).randbytes(size))


@hostile("a zip")
def zipped(path: Path, size: int) -> None:
    import zipfile

    with zipfile.ZipFile(path, "w") as file:
        file.writestr("model.step", HEAD.format(name="x") + TAIL)


@hostile("a folder")
def folder(path: Path, size: int) -> None:
    path.mkdir()


@hostile("a header alone")
def header(path: Path, size: int) -> None:
    path.write_text(HEAD.format(name="x").partition("DATA;")[0])


@hostile("an empty model")
def empty(path: Path, size: int) -> None:
    _text(path, "")


@hostile("words for data")
def words(path: Path, size: int) -> None:
    _text(path, "this is no entity;\n#1=;\n#2=NOTHING(;\n#3 NOTHING();\n")


# Much of it


@hostile("many points")
def many_points(path: Path, size: int) -> None:
    with path.open("w") as file:
        file.write(HEAD.format(name="x"))
        for k in range(1, size + 1):
            file.write(f"#{k}=CARTESIAN_POINT('',({k}.,0.,0.));\n")
        file.write(TAIL)


@hostile("many boxes")
def many_boxes(path: Path, size: int) -> None:
    """Boxes that touch nothing: some 200 entities each."""
    from .shapes import box, write

    write(path, [((f"box {k}",), box((3 * k, 3 * k + 1), (0, 1), (0, 1))) for k in range(size)])


@hostile("one long line")
def long_line(path: Path, size: int) -> None:
    with path.open("w") as file:
        file.write(HEAD.format(name="x") + "#1=CARTESIAN_POINT('',(")
        for _ in range(max(size // 3000, 1)):
            file.write("0.," * 1000)
        file.write("0.));\n" + TAIL)


@hostile("one long comment")
def long_comment(path: Path, size: int) -> None:
    with path.open("w") as file:
        file.write(HEAD.format(name="x") + "/*")
        for _ in range(max(size // 1000, 1)):
            file.write("*" * 1000)
        file.write("\n" + TAIL)


@hostile("deep brackets")
def deep(path: Path, size: int) -> None:
    _text(path, "#1=CARTESIAN_POINT('',(" + "(" * size + "0." + ")" * size + "));\n")


@hostile("long name", borderline=True)
def long_name(path: Path, size: int) -> None:
    path.write_text(good_text().replace("'stage'", f"'{'stage' * (size // 5)}'"), "latin-1")


@hostile("chain of references", borderline=True)
def chain(path: Path, size: int) -> None:
    """Each surface is an offset of the next one."""
    data = [f"#{k}=OFFSET_SURFACE('',#{k + 1},1.,.F.);\n" for k in range(20, 20 + size)]
    text = good_text()
    number = max(map(int, re.findall(r"^#(\d+)", text, re.M))) + 1
    moved = "".join(re.sub(r"#(\d+)", lambda m: f"#{int(m[1]) + number}", each) for each in data)
    plane = re.search(r"^#(\d+) = PLANE\('',(#\d+)\);", text, re.M)
    assert plane is not None
    last = f"#{number + 20 + size}=PLANE('',{plane[2]});\n"
    text = text.replace(plane[0], f"#{plane[1]} = OFFSET_SURFACE('',#{number + 20},1.,.F.);")
    path.write_text(text.replace("ENDSEC;\nEND-ISO", moved + last + "ENDSEC;\nEND-ISO"), "latin-1")


@hostile("assemblies of assemblies")
def bomb(path: Path, size: int) -> None:
    """Of each assembly ten in the next one: 10 ** size solids in some kilobytes."""
    from OCP.gp import gp_Trsf

    from .shapes import box, vector, write_nested

    places = []
    for k in range(10):
        place = gp_Trsf()
        place.SetTranslation(vector((2 * k, 0, 0)))
        places.append(place)
    write_nested(path, box((0, 1), (0, 1), (0, 1)), places, size)


# Spoilt


@hostile("cut off")
def cut_off(path: Path, size: int) -> None:
    text = good_text()
    path.write_text(text[: len(text) // 2], "latin-1")


@hostile("cut off in the header")
def cut_off_early(path: Path, size: int) -> None:
    path.write_text(good_text()[:200], "latin-1")


@hostile("without its end", borderline=True)
def without_end(path: Path, size: int) -> None:
    path.write_text(good_text().replace(TAIL, ""), "latin-1")


def _replaced(path: Path, *pairs: tuple[str, str], count: int = 0) -> None:
    text = good_text()
    for pattern, new in pairs:
        text, done = re.subn(pattern, new, text, count=count)
        if not done:
            raise ValueError(f"{pattern} is not in the file")
    path.write_text(text, "latin-1")


@hostile("points that are no numbers")
def not_numbers(path: Path, size: int) -> None:
    _replaced(path, (r"CARTESIAN_POINT\('',\([^)]*\)\)", "CARTESIAN_POINT('',(NAN,NAN,NAN))"))


@hostile("points at infinity")
def infinite(path: Path, size: int) -> None:
    _replaced(path, (r"CARTESIAN_POINT\('',\([^)]*\)\)", "CARTESIAN_POINT('',(1.E400,0.,-1.E999))"))


@hostile("one point that is no number", borderline=True)
def one_not_number(path: Path, size: int) -> None:
    _replaced(
        path, (r"CARTESIAN_POINT\('',\(100.,[^)]*\)\)", "CARTESIAN_POINT('',(NAN,1.#QNAN,INF))"),
        count=1,
    )  # fmt: skip


@hostile("directions of no length", borderline=True)
def no_direction(path: Path, size: int) -> None:
    _replaced(path, (r"DIRECTION\('',\([^)]*\)\)", "DIRECTION('',(0.,0.,0.))"))


@hostile("lengths in grams", borderline=True)
def grams(path: Path, size: int) -> None:
    _replaced(
        path,
        (
            _MILLIMETRE,
            "( MASS_UNIT() NAMED_UNIT(*) SI_UNIT(.KILO.,.GRAM.) )",
        ),
    )


@hostile("no units", borderline=True)
def no_units(path: Path, size: int) -> None:
    _replaced(
        path, (r"GLOBAL_UNIT_ASSIGNED_CONTEXT\s*\(\([^)]*\)\)", "GLOBAL_UNIT_ASSIGNED_CONTEXT(())")
    )


@hostile("lengths in exametres", borderline=True)
def exametres(path: Path, size: int) -> None:
    _replaced(path, (r"SI_UNIT\(\.MILLI\.,\.METRE\.\)", "SI_UNIT(.EXA.,.METRE.)"))


@hostile("an inch of no length", borderline=True)
def no_inch(path: Path, size: int) -> None:
    _replaced(
        path,
        (
            _MILLIMETRE,
            "( CONVERSION_BASED_UNIT('INCH',#900001) LENGTH_UNIT() NAMED_UNIT(#900002) )",
        ),
        (
            "ENDSEC;\nEND-ISO",
            "#900001=LENGTH_MEASURE_WITH_UNIT(0.,#900003);\n"
            "#900002=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
            "#900003=( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\nENDSEC;\nEND-ISO",
        ),
    )


@hostile("shapes that are missing")
def missing(path: Path, size: int) -> None:
    _replaced(path, (r"MANIFOLD_SOLID_BREP\('',#\d+\)", "MANIFOLD_SOLID_BREP('',#987654)"))


@hostile("one shape that is missing", borderline=True)
def one_missing(path: Path, size: int) -> None:
    _replaced(path, (r"MANIFOLD_SOLID_BREP\('',#\d+\)", "MANIFOLD_SOLID_BREP('',#987654)"), count=1)


@hostile("shells without solids", borderline=True)
def shells(path: Path, size: int) -> None:
    _replaced(
        path,
        (r"MANIFOLD_SOLID_BREP\(''", "SHELL_BASED_SURFACE_MODEL(''"),
        (r"CLOSED_SHELL", "OPEN_SHELL"),
        (r"ADVANCED_BREP_SHAPE_REPRESENTATION", "MANIFOLD_SURFACE_SHAPE_REPRESENTATION"),
    )


@hostile("faces that are missing", borderline=True)
def open_shells(path: Path, size: int) -> None:
    """One face of each shell is gone."""
    _replaced(path, (r"CLOSED_SHELL\('',\(#\d+,", "CLOSED_SHELL('',("))


@hostile("all numbers the same", borderline=True)
def same_numbers(path: Path, size: int) -> None:
    _replaced(path, (r"(?m)^#\d+ = ", "#7 = "))


@hostile("numbers beyond all bounds", borderline=True)
def huge_numbers(path: Path, size: int) -> None:
    _replaced(path, (r"#(\d+)", r"#9999999999999999999\1"))


# Circles


@hostile("an assembly in itself")
def itself(path: Path, size: int) -> None:
    """The sub-assembly has the whole as its part."""
    text = good_text()
    uses = re.findall(
        r"NEXT_ASSEMBLY_USAGE_OCCURRENCE\('[^']*','[^']*','[^']*',(#\d+),(#\d+),", text
    )
    roots = {a for a, _ in uses} - {b for _, b in uses}
    (root,) = roots
    leaf = next(b for _, b in uses if b not in {a for a, _ in uses})
    path.write_text(
        re.sub(rf"(NEXT_ASSEMBLY_USAGE_OCCURRENCE\([^;]*){leaf}(?=,)", rf"\g<1>{root}", text),
        "latin-1",
    )


@hostile("a surface of itself", borderline=True)
def surface_of_itself(path: Path, size: int) -> None:
    _replaced(path, (r"(?m)^#(\d+) = PLANE\('',#\d+\);", r"#\1 = OFFSET_SURFACE('',#\1,1.,.F.);"))


@hostile("a curve of itself", borderline=True)
def curve_of_itself(path: Path, size: int) -> None:
    _replaced(
        path,
        (
            r"(?m)^#(\d+) = LINE\('',#\d+,#\d+\);",
            r"#\1 = TRIMMED_CURVE('',#\1,(PARAMETER_VALUE(0.)),"
            r"(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);",
        ),
    )


@hostile("a shell of itself", borderline=True)
def shell_of_itself(path: Path, size: int) -> None:
    _replaced(path, (r"(?m)^#(\d+) = CLOSED_SHELL\('',\(#\d+,", r"#\1 = CLOSED_SHELL('',(#\1,"))


# Names


@hostile("names with commands", borderline=True)
def commands(path: Path, size: int) -> None:
    r"""Escapes of a terminal, as \X\1B and raw, and HTML in names."""
    _replaced(
        path,
        (r"'stage'", r"'\\X\\1B[31mred\\X\\07 <script>alert(1)</script>'"),
        (
            r"'base'",
            "'\x1b]0;title\x07 \\\\X2\\\\202E\\\\X0\\\\ &lt;img src=x onerror=alert(1)&gt;'",
        ),
    )


@hostile("names that count", borderline=True)
def counting_names(path: Path, size: int) -> None:
    """Such names are those of pieces of one part in a model."""
    _replaced(path, (r"'stage'", "'plate, 2'"), (r"'base'", "'plate 1 of 2'"))


@hostile("names without letters", borderline=True)
def blank_names(path: Path, size: int) -> None:
    _replaced(path, (r"'(stage|base|blade|clamp \d)'", "'  '"))


@hostile("all names the same", borderline=True)
def one_name(path: Path, size: int) -> None:
    _replaced(path, (r"'(stage|base|blade|clamp \d|leaf set)'", "'part'"))
