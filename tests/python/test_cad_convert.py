# SPDX-License-Identifier: BSD-3-Clause
"""STEP files as decks: shapes as workshops make them, and what the command says.

Sizes are those that the solids are made with here, by OpenCASCADE directly.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("OCP")
sys.path.append(str(Path(__file__).resolve().parents[1]))

from cad import shapes
from cad.shapes import box, cut, cylinder, fused, plate, prism
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakeWire,
    BRepBuilderAPI_NurbsConvert,
)
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.gp import gp_Ax2, gp_Dir, gp_Elips, gp_Pnt, gp_Vec
from OCP.TopoDS import TopoDS_Shape

import flexact
from flexact.apps.cli.main import main
from flexact.apps.convert.cad import reader
from flexact.apps.convert.cad.assembly import Assembly, Choices, Flexure, Kind
from flexact.apps.convert.cad.mechanism import CadMechanism, mechanism_of, model_of_assembly
from flexact.apps.convert.cad.reader import recognised
from flexact.apps.convert.cad.report import assembly_of
from flexact.apps.convert.cad.step_file import parts_of
from flexact.util.errors import BatchError

BASE, STAGE = box((0, 100), (0, 20), (0, 30)), box((0, 100), (60, 72), (0, 30))


def assembly(folder: Path, choices: Choices | None = None, **solids: TopoDS_Shape) -> Assembly:
    """What solids are, recognised in this process."""
    path = folder / "part.step"
    named = {name.replace("_", " "): solid for name, solid in solids.items()}
    shapes.write(path, tuple(((name,), solid) for name, solid in named.items()))
    parts, doubts, remarks = parts_of(path)
    return assembly_of(
        parts, choices or Choices(), name="part", drawing=False, doubts=doubts, remarks=remarks
    )


def counts(found: Assembly) -> tuple[int, int]:
    """Under- and over-constrained by, with what the model declares by itself left out."""
    analysis = flexact.analyse(model_of_assembly(found))
    return analysis.under_constrained, analysis.over_constrained


def sizes(flexure: Flexure) -> list[float]:
    """Length, breadth and thickness in mm."""
    return [1e3 * x for x in (flexure.length, flexure.breadth, flexure.thickness)]


def slot(p: tuple[float, float], q: tuple[float, float], width: float) -> TopoDS_Shape:
    """A slot with round ends through a plate of 10 mm."""
    ends = [cylinder((*x, -2), (*x, 12), width) for x in (p, q)]
    return fused(plate((*p, 5), (*q, 5), (0, 0, 1), 14, width), *ends)


def test_sheets_between_slots_with_round_ends_reach_to_their_bottoms(tmp_path: Path) -> None:
    """Slots of 2 mm from y = 20 to 60: their round ends are 1 mm beyond, at 19 and 61."""
    cuts = [slot((x + side, 20), (x + side, 60), 2) for x in (20, 80) for side in (-1.25, 1.25)]
    window, outside = box((22, 78), (20, 60), (-1, 11)), [(-1, 17.9), (82.1, 101)]
    whole = cut(box((0, 100), (0, 80), (0, 10)), *cuts, window)
    whole = cut(whole, *(box(x, (19, 90), (-1, 11)) for x in outside))
    found = assembly(tmp_path, plate=whole)
    assert [each.kind for each in found.flexures] == [Kind.SHEET] * 2
    for each in found.flexures:
        assert sizes(each) == pytest.approx([42, 10, 0.5], rel=0.05)
    assert counts(found) == (1, 1)


def test_fillets_in_the_plane_of_a_sheet_change_neither_length_nor_breadth(
    tmp_path: Path,
) -> None:
    def blade(x: float) -> TopoDS_Shape:
        tabs = [box((x, x + 0.5), y, (0, 30)) for y in ((8, 20), (60, 72))]
        whole = fused(box((x, x + 0.5), (20, 60), (5, 25)), *tabs)
        return shapes.filleted(whole, [(x + 0.25, y, z) for y in (20, 60) for z in (5, 25)], 3)

    found = assembly(tmp_path, base=BASE, stage=STAGE, left=blade(-0.5), right=blade(100))
    for each in found.flexures:
        assert sizes(each) == pytest.approx([40, 20, 0.5], rel=1e-6)
    assert not found.doubts


def test_short_walls_between_fillets_are_notches(tmp_path: Path) -> None:
    blocks = [box((0, 10), y, (0, 10)) for y in ((-10, -2), (2, 10))]
    whole = fused(*blocks, box((4.7, 5.3), (-2, 2), (0, 10)))
    whole = shapes.filleted(whole, [(x, y, 5) for x in (4.7, 5.3) for y in (-2, 2)], 1)
    (neck,) = assembly(tmp_path, part=whole).flexures
    assert (neck.kind, neck.contour) == (Kind.NOTCH, "fillet")
    assert sizes(neck) == pytest.approx([4, 10, 0.6])
    assert 1e3 * neck.radius == pytest.approx(1)


def test_elliptic_necks_are_notches(tmp_path: Path) -> None:
    """Two ellipses with half axes of 6 and 4.7 mm, 10 mm apart: 0.6 mm is left."""

    def hole(x: float) -> TopoDS_Shape:
        ellipse = gp_Elips(gp_Ax2(gp_Pnt(x, 0, -1), gp_Dir(0, 0, 1), gp_Dir(0, 1, 0)), 6, 4.7)
        wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse).Edge()).Wire()
        face = BRepBuilderAPI_MakeFace(wire).Face()
        return BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, 12)).Shape()

    found = assembly(tmp_path, part=cut(box((0, 10), (-20, 20), (0, 10)), hole(0), hole(10)))
    (neck,) = found.flexures
    assert (neck.kind, neck.contour) == (Kind.NOTCH, "elliptic")
    assert sizes(neck) == pytest.approx([12, 10, 0.6], rel=1e-4)
    assert counts(found) == (1, 0)


def test_planes_that_are_splines_are_planes(tmp_path: Path) -> None:
    sheets = [box((x - 0.25, x + 0.25), (20, 60), (0, 30)) for x in (20, 80)]
    whole = BRepBuilderAPI_NurbsConvert(fused(BASE, STAGE, *sheets), True).Shape()
    found = assembly(tmp_path, part=shapes.solids(whole)[0])
    for each in found.flexures:
        assert sizes(each) == pytest.approx([40, 30, 0.5])
    assert counts(found) == (1, 1)


def test_wires_and_sheets_may_be_glued_which_is_told(tmp_path: Path) -> None:
    """Wires of 0.8 mm in holes of 1 mm: 0.1 mm all around."""
    base, stage = box((-40, 40), (-40, 40), (-60, -40)), box((-20, 20), (-20, 20), (0, 25))
    wires = {}
    for k, (x, y) in enumerate(((-15, -10), (15, -10), (0, 15)), 1):
        base = cut(base, cylinder((x, y, -48), (x, y, -39), 1))
        stage = cut(stage, cylinder((x, y, -1), (x, y, 8), 1))
        wires[f"wire_{k}"] = cylinder((x, y, -46), (x, y, 6), 0.8)
    found = assembly(tmp_path, base=base, stage=stage, **wires)
    for each in found.flexures:
        assert each.kind is Kind.WIRE
        assert each.length == pytest.approx(0.04)
    assert "gaps of up to 0.1 mm are taken as joined: wire 1 to" in found.doubts[0]
    assert counts(found) == (3, 0)


def test_rods_between_necks_are_wires_with_a_stiff_middle(tmp_path: Path) -> None:
    def strut(x: float, y: float) -> TopoDS_Shape:
        necks = [cylinder((x, y, z), (x, y, z + 6), 1) for z in (0, 34)]
        return fused(*necks, cylinder((x, y, 6), (x, y, 34), 4))

    places = {f"strut_{k}": strut(*p) for k, p in enumerate(((-20, -20), (20, -20), (0, 20)))}
    base, stage = box((-30, 30), (-30, 30), (-10, 0)), box((-30, 30), (-30, 30), (40, 55))
    found = assembly(tmp_path, base=base, stage=stage, **places)
    assert [each.kind for each in found.flexures] == [Kind.WIRE] * 6
    assert sum(body.is_middle for body in found.bodies) == 3
    assert counts(found) == (3, 0)


def test_membranes_are_told_and_no_flexures(tmp_path: Path) -> None:
    ring = cut(cylinder((0, 0, -5), (0, 0, 0), 80), cylinder((0, 0, -6), (0, 0, 1), 60))
    found = assembly(
        tmp_path,
        base_ring=ring,
        membrane=cylinder((0, 0, 0), (0, 0, 0.2), 80),
        hub=cylinder((0, 0, 0.2), (0, 0, 10), 20),
    )
    assert found.flexures == ()
    assert any("membrane has a thin part" in doubt for doubt in found.doubts)
    with pytest.raises(BatchError, match="no flexure was recognised in 3 solids"):
        model_of_assembly(found)


def test_breadth_that_changes_and_holes_in_the_middle_are_told(tmp_path: Path) -> None:
    taper = prism([(19.75, 20, 0), (19.75, 60, 5), (19.75, 60, 25), (19.75, 20, 30)], (0.5, 0, 0))
    holed = cut(box((79.75, 80.25), (20, 60), (0, 30)), cylinder((79, 40, 15), (81, 40, 15), 12))
    found = assembly(tmp_path, base=BASE, stage=STAGE, taper=taper, holed=holed)
    assert [round(1e3 * each.length, 6) for each in found.flexures] == [40, 40]
    assert any(doubt.startswith("taper: its breadth changes") for doubt in found.doubts)
    assert any(doubt.startswith("holed: holes take away") for doubt in found.doubts)


def test_masses_and_inertias_are_those_of_the_solids(tmp_path: Path) -> None:
    """A stage of 100 x 12 x 30 mm of aluminium: m (b^2 + c^2) / 12 about each axis."""
    sheets = {f"s{k}": box((x, x + 0.5), (20, 60), (0, 30)) for k, x in ((1, 20), (2, 80))}
    found = assembly(tmp_path, Choices(material="aluminium"), base=BASE, stage=STAGE, **sheets)
    stage = found.bodies[1]
    mass = 2700 * 0.1 * 0.012 * 0.03
    a, b, c = 0.1, 0.012, 0.03
    about = [b * b + c * c, a * a + c * c, a * a + b * b]
    assert stage.mass == pytest.approx(mass, rel=1e-3)
    assert stage.inertia[[0, 3, 5]] == pytest.approx(mass * np.array(about) / 12, rel=1e-3)
    assert stage.centre == pytest.approx([0.05, 0.066, 0.015], abs=1e-5)


def guide(folder: Path) -> Path:
    path = folder / "guide.step"
    sheets = [(f"sheet {k}", box((x, x + 0.5), (20, 60), (0, 30))) for k, x in ((1, 20), (2, 80))]
    parts = [("base", BASE), ("stage", STAGE), *sheets, ("cover", box((0, 9), (90, 99), (0, 9)))]
    shapes.write(path, tuple(((name,), solid) for name, solid in parts))
    return path


def test_the_command_says_what_it_found_then_doubts_then_the_verdict(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, deck = guide(tmp_path), tmp_path / "guide.dat"
    assert main(["convert", str(path), "-o", str(deck), "--declare", "stage:x"]) == 0
    said = capsys.readouterr().out
    words = [
        "sheet 1  sheet, 40 x 30 x 0.5 mm, between base and stage",
        "cover touches nothing that is part of the mechanism and is left out",
        "Over-constrained by 1",
        "sheet 1 and sheet 2 both hold the stage against rotation about",
    ]
    places = [said.index(each) for each in words]
    assert places == sorted(places)
    text = deck.read_text("utf-8")
    assert text.startswith("% in doubt: cover touches nothing")
    model = flexact.read(deck)
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)
    assert model.units == "mm"


def test_ground_is_what_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, deck = guide(tmp_path), tmp_path / "guide.dat"
    assert main(["convert", str(path), "-o", str(deck), "--ground", "stage"]) == 0
    assert "ground is stage: as was said" in capsys.readouterr().out
    assert main(["convert", str(path), "-o", str(deck), "--ground", "table"]) == 1
    said = capsys.readouterr().err
    assert "no solid is called 'table'" in said
    assert "The names are base, cover, sheet 1, sheet 2, stage" in said


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--fix", "1"], "--fix is for a mesh"),
        (["--declare", "stage"], "a body and its coordinates are wanted"),
        (["--declare", "stage:w"], "a body and its coordinates are wanted"),
        (["--material", "cheese"], "cheese"),
    ],
)
def test_wrong_options_are_told(
    options: list[str], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = guide(tmp_path)
    try:
        code = int(main(["convert", str(path), "-o", str(tmp_path / "x.dat"), *options]))
    except SystemExit as stopped:
        code = int(stopped.code or 0)
    assert code in (1, 2)
    assert words in capsys.readouterr().err
    assert not (tmp_path / "x.dat").exists()


def test_a_file_that_takes_too_long_is_given_up(tmp_path: Path) -> None:
    with pytest.raises(BatchError, match="took more than 0 s and was given up"):
        recognised(guide(tmp_path), seconds=0)


def test_a_file_that_takes_too_much_memory_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BatchError, match=r"memory|OpenCASCADE"):
        recognised(guide(tmp_path), memory=2**28)


def test_without_opencascade_it_is_said_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reader, "find_spec", lambda name: None)
    with pytest.raises(BatchError, match="pip install cadquery-ocp-novtk"):
        recognised(guide(tmp_path))


def test_a_mechanism_has_the_places_of_the_solids(tmp_path: Path) -> None:
    found = mechanism_of(guide(tmp_path), Choices(declared=(("stage", ("x",)),)))
    assert isinstance(found, CadMechanism)
    ends = np.array([[sheet.p, sheet.q] for sheet in found.assembly.flexures])
    assert sorted(ends[:, 0, 0]) == pytest.approx([0.02025, 0.08025], abs=1e-12)
    assert np.sort(ends[..., 1]) == pytest.approx(np.array([[0.02, 0.06]] * 2), abs=1e-12)
    assert all(piece.triangles.size for piece in found.assembly.pieces)
    codes = {each.code for each in found.model.diagnostics}
    assert {"cad-doubt", "cad-remark"} <= codes


def test_what_is_there_twice_counts_once(tmp_path: Path) -> None:
    sheets = {f"s{k}": box((x, x + 0.5), (20, 60), (0, 30)) for k, x in ((1, 20), (2, 80))}
    again = box((20, 20.5), (20, 60), (0, 30))
    found = assembly(tmp_path, base=BASE, stage=STAGE, **sheets, again=again)
    assert len(found.flexures) == 2
    assert "again is there twice, and counts once" in found.doubts


def test_nothing_of_opencascade_is_loaded_without_need() -> None:
    """The parent of the child process needs none of it either."""
    code = "import sys, flexact.apps.cli.convert; assert not any('OCP' in m for m in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
