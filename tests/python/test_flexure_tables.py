# SPDX-License-Identifier: BSD-3-Clause
"""Tables of flexures: from decks and back, tables typed by hand, mistakes."""

from __future__ import annotations

import csv
import io
import runpy
from pathlib import Path

import numpy as np
import pytest
from reference_decks import NAMES, text_of, truth_of

import flexact
from flexact.apps.convert.flexure_table import bytes_of_flexures, model_of_flexures
from flexact.apps.convert.table_input import TablesError

GALLERY = Path(__file__).parents[2] / "docs" / "gallery"
#: Decks of which a table cannot hold all; what is lost is told.
LOSING = {
    "flexures/cross_hinge_four_beams_undeclared": "releases inside divided flexures",
    "flexures/parallel_guide_four_beams_undeclared": "releases inside divided flexures",
    "flexures/sheet_clamped_both_ends_four_beams_undeclared": "releases inside divided flexures",
    "linkages/shaft_on_two_bearings": "displacements of bearings",
}
#: A parallel guide as somebody types it in a spreadsheet with decimal commas.
GUIDE = """\
Kind;Name;From;To;x1 [mm];y1 [mm];z1 [mm];x2 [mm];y2 [mm];z2 [mm];Width [mm];Thickness [mm];\
direction x;direction y;direction z;material
sheet;left;ground;stage;0;0;0;0;100;0;40;0,3;0;0;1;steel
sheet;right;ground;stage;50;0;0;50;100;0;40;0,3;0;0;1;steel
"""


def read(text: str) -> flexact.Model:
    return model_of_flexures(text.encode(), Path("flexures.csv"))


def flexures_of(model: flexact.Model) -> list[dict[str, str]]:
    content = bytes_of_flexures(model, ".csv")[0].decode()
    rows = [row for row in csv.DictReader(io.StringIO(content)) if row["kind"] != "point"]
    return sorted(rows, key=lambda row: (row["kind"], row["name"]))


def errors_of(text: str) -> list[tuple[str, int, int]]:
    with pytest.raises(TablesError) as caught:
        read(text)
    return [(item.message, item.line, item.column) for item in caught.value.diagnostics]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("suffix", [".csv", ".xlsx"])
def test_a_deck_through_its_table_has_the_same_counts(name: str, suffix: str) -> None:
    """The oracle's, of the same flexures at the same places, to the last bit."""
    if suffix == ".xlsx":
        pytest.importorskip("openpyxl")
    model = flexact.read_text(text_of(name))
    content, notes = bytes_of_flexures(model, suffix)
    lost = [note.message for note in notes if note.severity == "warning"]
    if name in LOSING:
        assert len(lost) == 1 and LOSING[name] in lost[0]
        return
    assert not lost
    again = model_of_flexures(content, Path(f"flexures{suffix}"))
    analysis = flexact.analyse(again)
    assert (analysis.under_constrained, analysis.over_constrained) == truth_of(name)
    # A workbook keeps 16 digits.
    near = 0.0 if suffix == ".csv" else 1e-15
    for mine, theirs in zip(flexures_of(model), flexures_of(again), strict=True):
        assert (mine["kind"], mine["name"]) == (theirs["kind"], theirs["name"])
        for name in (name for name in mine if name[0] in "xyzl" and mine[name]):
            assert float(theirs[name]) == pytest.approx(float(mine[name]), rel=near, abs=0.0)


@pytest.mark.parametrize("script", sorted(GALLERY.glob("*.py")), ids=lambda path: path.stem)
def test_a_mechanism_of_the_gallery_through_its_table_is_the_same(script: Path) -> None:
    """Struts on crossed notches among them, between which a piece is at no place of its own."""
    model = runpy.run_path(str(script))["model"]
    content, notes = bytes_of_flexures(model, ".csv")
    assert not [note for note in notes if note.severity == "warning"]
    mine, again = flexact.analyse(model), flexact.analyse(model_of_flexures(content, Path("t.csv")))
    for name in ("under_constrained", "over_constrained", "degrees_of_freedom"):
        assert getattr(again, name) == getattr(mine, name)


def test_sizes_and_material_come_back() -> None:
    """The sheet is 0.3 mm by 40 mm, of steel as EN 1993-1-1 has it; the wire 1 mm."""
    model = flexact.Model(units="mm")
    sheet = model.sheet(
        (0, 0, 0), (100, 0, 0), "z", 1, "blade", section=(40, 0.3), material="steel"
    )
    model.wire((0, 50, 0), (100, 50, 0), name="wire", thickness=1, material="titanium")
    model.body([sheet.nodes[1], (100, 50, 0)], "stage")
    model.fix((0, 0, 0), (0, 50, 0))
    content, _ = bytes_of_flexures(model, ".csv")
    blade, wire = csv.DictReader(io.StringIO(content.decode()))
    assert (blade["width [mm]"], blade["thickness [mm]"], blade["length [mm]"]) == (
        "40.0",
        "0.3",
        "100.0",
    )
    assert float(blade["E [MPa]"]) == pytest.approx(210e3)
    assert (blade["from"], blade["to"], wire["from"], wire["to"]) == (
        "clamp 1",
        "stage",
        "clamp 2",
        "stage",
    )
    again = model_of_flexures(content, Path("flexures.csv")).data
    given = model.data.properties
    assert given is not None and again.properties is not None
    for name in ("stiffness", "mass"):
        was, now = getattr(given, name)[:2], getattr(again.properties, name)[:2]
        assert np.allclose(now, was, rtol=1e-12, equal_nan=True)


def test_a_table_typed_by_hand_becomes_the_guide() -> None:
    """Over-constrained by one, as of the paper's parallel leaf springs, and free along x."""
    model = read(GUIDE)
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 1)
    assert model.units == "mm"
    driven = f"{GUIDE}point;;stage;;0;100;0\n".replace("material", "driven", 1).replace("steel", "")
    driven = driven.replace("0;100;0\n", "0;100;0;;;;;;;;;x\n")
    analysis = flexact.analyse(read(driven))
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)
    tabbed = GUIDE.replace(",", ".").replace(";", "\t")
    assert flexact.analyse(read(tabbed)).over_constrained == 1
    commas = GUIDE.replace(",", ".").replace(";", ",")
    assert read(commas).to_deck() == model.to_deck()


def test_every_mistake_is_told_with_its_place() -> None:
    text = GUIDE.replace("sheet;right", "sheeet;right").replace("40;0,3;0;0;1", "40;thin;0;0;1", 1)
    text += (
        "wire;w;ground;stage;25;;0;25;100;0;;1\nwire;v;ground;stage;25;0;0;25;100;0;;1;;;;stel\n"
    )
    assert errors_of(text) == [
        ("row 2, thickness: a number is wanted, not 'thin'", 2, 42),
        ("row 3, kind: there is no kind 'sheeet': did you mean sheet?", 3, 1),
        ("row 4: a wire needs y1", 4, 1),
        (
            "row 5: wire 'v': there is no material 'stel' (give 'steel', or "
            "flexact.Material(name, E, G, density))",
            5,
            1,
        ),
    ]
    assert errors_of(GUIDE.replace("x1 [mm]", "x1").replace("Kind", "kin"))[:2] == [
        ("row 1, column 1: there is no column 'kin'; did you mean kind?", 1, 1),
        ("row 1: the column kind is missing", 1, 1),
    ]
    assert "a unit of x1 is wanted: x1 [mm]" in errors_of(GUIDE.replace("x1 [mm]", "x1"))[0][0]
    length = GUIDE.replace(";material", ";length [mm]").replace("steel", "120")
    assert "its ends are 100 mm apart" in errors_of(length)[0][0]
    assert errors_of("") == [
        ("there is no table: the first line has the names of the columns", 0, 0)
    ]
    assert "has no rows" in errors_of(GUIDE.partition("\n")[0])[0][0]
    assert flexact.analyse(read(GUIDE + ";;;;\n\n")).over_constrained == 1


def test_what_is_no_table_is_refused_in_words() -> None:
    pytest.importorskip("openpyxl")
    for content in (b"", b"PK\x03\x04", bytes(range(256)) * 20):
        with pytest.raises(flexact.FlexactError):
            model_of_flexures(content, Path("flexures.xlsx"))
        with pytest.raises(flexact.FlexactError):
            model_of_flexures(content, Path("flexures.csv"))
