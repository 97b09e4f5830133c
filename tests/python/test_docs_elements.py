# SPDX-License-Identifier: BSD-3-Clause
"""docs/elements.md says of each element what the table of the core and the program say."""

import importlib.util
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import flexact
from flexact.analysis.places import deformation_word
from flexact.core.elements import Dual, element_kinds

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "elements.md").read_text("utf-8")
SECTIONS = dict(re.findall(r"^## `(\w+)`\n(.*?)(?=^## |\Z)", PAGE, re.MULTILINE | re.DOTALL))
KINDS = element_kinds()
KEYWORDS = [kind.keyword for kind in KINDS]
SLOTS = ("p", "op", "q", "oq")
STRESS = {Dual.FORCE: "force", Dual.MOMENT: "moment", Dual.MOMENT_OVER_LENGTH: "moment over l0"}
UNIT = {Dual.FORCE: "m", Dual.MOMENT: "rad", Dual.MOMENT_OVER_LENGTH: "m"}
#: Elements anyhow in space or in the plane, of a length that is not 1.
STATEMENTS = {
    "TRUSS": "TRUSS 1 1 3",
    "BEAM": "BEAM 1 1 2 3 4 0.3 -1 0.2",
    "RBEAM": "RBEAM 1 1 2 3 0.1 0.4 -1",
    "PINBODY": "PINBODY 1 1 2 3",
    "HINGE": "HINGE 1 2 4 0.5 0.2 -0.7",
    "BEARING": "BEARING 1 1 2 3 4 0.5 0.2 -0.7",
    "PLTRUSS": "PLTRUSS 1 1 3",
    "PLBEAM": "PLBEAM 1 1 2 3 4",
    "PLRBEAM": "PLRBEAM 1 1 2 3",
    "PLHINGE": "PLHINGE 1 2 4",
}


def rows(keyword: str) -> list[list[str]]:
    """The table of an element: number, word, sum, unit, stress, number of ESTIFF."""
    lines = re.findall(r"^\| (\d.*) \|$", SECTIONS[keyword], re.MULTILINE)
    return [line.split(" | ") for line in lines]


def test_every_element_has_its_section() -> None:
    assert sorted(SECTIONS) == sorted(KEYWORDS)


@pytest.mark.parametrize("kind", KINDS, ids=KEYWORDS)
def test_ends_and_deformations_are_those_of_the_table(kind: Any) -> None:
    text = SECTIONS[kind.keyword]
    ends = ", ".join(name for name, slot in zip(SLOTS, kind.slots, strict=True) if slot)
    assert f"\nEnds: {ends}." in text
    assert ("p and q must be apart." in text) == kind.needs_length
    assert not kind.synonym or f"also `{kind.synonym}`" in text
    expected = [
        [str(k + 1), deformation_word(kind.number, k + 1), UNIT[dual], STRESS[dual]]
        for k, dual in enumerate(kind.dual[: kind.deformations])
    ]
    assert [[row[0], row[1], row[3], row[4]] for row in rows(kind.keyword)] == expected


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_stiffness_is_that_of_the_deck_language(keyword: str) -> None:
    """Whose row is made from what the deck reader knows."""
    line = re.search(r"^\| `ESTIFF e …` \| (.*) \|$", decks(), re.MULTILINE)
    assert line
    numbers = {
        word: numbers
        for words, numbers in re.findall(r"of a ((?:`\w+`(?: or )?)+) ([^;]*)", line[1])
        for word in re.findall(r"\w+", words.replace(" or ", " "))
    }
    said = list(dict.fromkeys(row[5] for row in rows(keyword)))
    if keyword not in numbers:
        assert said == ["none"]
        return
    known = re.split(r", ", re.sub(r" \([^)]*\)", "", numbers[keyword]))
    assert said == [word for word in known if not word.startswith("shear")]


def decks() -> str:
    """The page on the deck language."""
    return (ROOT / "docs" / "decks.md").read_text("utf-8")


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_sums_are_what_the_program_computes(keyword: str) -> None:
    """For small random displacements of both ends, turned into local axes."""
    planar = keyword.startswith("PL")
    apart = keyword not in ("HINGE", "BEARING", "PLHINGE")
    place = ("X 3 0.3 -0.4" if planar else "X 3 0.3 -0.4 1.2") if apart else ""
    model = flexact.read_text(f"{STATEMENTS[keyword]}\n{place}\nEND\n")
    rng, small = np.random.default_rng(7), 1e-7
    frame = model.data.frames.frame[0]
    if planar:
        along = np.array([0.3, -0.4]) / 0.5 if apart else np.array([1.0, 0.0])
        frame = np.array([[along[0], -along[1], 0], [along[1], along[0], 0], [0, 0, 1]])
    length = 0.5 if planar else 1.3
    for _ in range(3):
        move, names = np.zeros((len(model.node_numbers), 3)), {"l0": length}
        for number, end in ((1, "p"), (2, "p"), (3, "q"), (4, "q")):
            if number not in model.node_numbers:
                continue
            local = rng.standard_normal(3)
            if planar:
                local *= (1, 1, 0) if number % 2 else (0, 0, 1)
            move[model.node_index(number)] = small * frame @ local
            axes = ("x", "y", "z") if number % 2 else ("rx", "ry", "rz")
            names |= {f"{axis}_{end}": value for axis, value in zip(axes, local, strict=True)}
            names |= {f"r_{end}": local[2]} if planar and not number % 2 else {}
        found = flexact.deformations(model, model.reference().moved(move)) / small
        for row, value in zip(rows(keyword), found, strict=False):
            terms = re.sub(r"l0 ", "l0 * ", re.sub(r"(\w+)\((\w)\)", r"\1_\2", row[2]))
            assert eval(terms, {}, names) == pytest.approx(value, abs=2e-6), (row, names)


def test_pictures_are_those_of_the_script(tmp_path: Path) -> None:
    path = ROOT / "tools" / "element_pictures.py"
    spec = importlib.util.spec_from_file_location("element_pictures", path)
    assert spec and spec.loader
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    script.main(tmp_path)
    for kind in KINDS:
        name = f"{kind.keyword.lower()}.svg"
        assert f"(elements/{name})" in SECTIONS[kind.keyword]
        drawn, stored = (
            (folder / name).read_text("utf-8") for folder in (tmp_path, ROOT / "docs" / "elements")
        )
        assert numbers_of(drawn) == pytest.approx(numbers_of(stored), abs=0.15), name
        assert re.sub(r"[-\d.]+", "", drawn) == re.sub(r"[-\d.]+", "", stored)


def numbers_of(text: str) -> list[float]:
    """All numbers of a picture."""
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]
