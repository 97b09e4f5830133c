# SPDX-License-Identifier: BSD-3-Clause
"""What stands in a mesh file: shapes, names, what is left out, and other formats."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import vtk_files
from reference_decks import ROOT
from test_export_values import written
from vtk_files import LINE, QUAD, VERTEX

import flexact
from flexact.show.mesh import content, mesh_of
from flexact.show.mesh.file import find_format, mesh_bytes

Read = Callable[[str], flexact.Analysis]

#: A sheet of length 2 along x; its end cannot move and turns about y alone.
TURNED_END = """\
BEAM 1 1 2 3 4 0 1 0
X 3 2 0 0
FIX 1
FIX 2
FIX 3
FIX 4 2 4
RLSE 1 3 4
"""
#: The same sheet; its end moves along z alone and does not turn.
SHIFTED_END = TURNED_END.replace("FIX 3\nFIX 4 2 4", "FIX 3 1 2\nFIX 4")
#: The same for a planar beam: its end turns.
PLANAR_TURNED_END = "PLBEAM 1 1 2 3 4\nX 3 2 0\nFIX 1\nFIX 2\nFIX 3\nRLSE 1 2 3\n"


@pytest.fixture
def analyse(tmp_path: Path) -> Read:
    def from_text(text: str) -> flexact.Analysis:
        path = tmp_path / "deck.dat"
        path.write_text(text, encoding="utf-8")
        return flexact.analyse(path)

    return from_text


def test_a_beam_whose_end_turns_is_a_cubic_curve(analyse: Read, tmp_path: Path) -> None:
    """Clamped at p, turned by theta about y at q: w = theta (x^2 / l - x^3 / l^2), downwards.

    A beam without shear; at the middle l / 8 and a quarter of the rotation backwards.
    """
    found = written(analyse(TURNED_END), ".vtu", tmp_path)
    line = found.points_of(1, LINE)
    x = found.points[line, 0]
    assert x == pytest.approx(np.arange(9) / 4, abs=1e-15)
    theta = found.point_data["motion_1_rotation"][line[-1], 1]
    assert abs(theta) == pytest.approx(1.0, abs=1e-15)
    moved = found.point_data["motion_1"][line]
    assert moved[:, :2] == pytest.approx(0.0, abs=1e-15)
    assert moved[:, 2] == pytest.approx(theta * (x**2 / 2 - x**3 / 4), abs=1e-14)
    assert moved[4, 2] == pytest.approx(theta * 2 / 8, abs=1e-14)
    turned = found.point_data["motion_1_rotation"][line]
    assert turned[:, 1] == pytest.approx(-theta * (x - 3 * x**2 / 4), abs=1e-14)
    assert turned[4, 1] == pytest.approx(-theta / 4, abs=1e-14)


def test_a_beam_whose_end_shifts_is_a_cubic_curve(analyse: Read, tmp_path: Path) -> None:
    """Guided cantilever: w = 3 (x / l)^2 - 2 (x / l)^3; the middle turns by -3 / (2 l)."""
    found = written(analyse(SHIFTED_END), ".vtu", tmp_path)
    line = found.points_of(1, LINE)
    share = np.arange(9) / 8
    moved = found.point_data["motion_1"][line, 2]
    assert np.abs(moved[-1]) == pytest.approx(1.0, abs=1e-15)
    assert moved == pytest.approx(moved[-1] * (3 * share**2 - 2 * share**3), abs=1e-14)
    turned = found.point_data["motion_1_rotation"][line, 1]
    assert turned[4] == pytest.approx(-moved[-1] * 3 / (2 * 2), abs=1e-14)


def test_a_planar_beam_is_a_cubic_curve_in_the_plane(analyse: Read, tmp_path: Path) -> None:
    found = written(analyse(PLANAR_TURNED_END), ".vtu", tmp_path)
    line = found.points_of(1, LINE)
    x, moved = found.points[line, 0], found.point_data["motion_1"][line]
    theta = found.point_data["motion_1_rotation"][line[-1], 2]
    assert abs(theta) == pytest.approx(1.0, abs=1e-15)
    assert moved[:, 1] == pytest.approx(-theta * (x**2 / 2 - x**3 / 4), abs=1e-14)
    assert not found.points[found.points_of(1, QUAD), 2].any()
    assert not found.points[line, 2].any()
    assert len(found.cells_of(1, QUAD)) == 8


def test_surfaces_move_with_their_sections(analyse: Read, tmp_path: Path) -> None:
    """Displacement of a corner: that of the axis at its x, plus rotation times the arm."""
    found = written(analyse(TURNED_END), ".vtu", tmp_path)
    line, skin = found.points_of(1, LINE), found.points_of(1, QUAD)
    assert len(skin) == 9 * 4 and len(found.cells_of(1, QUAD)) == 8 * 4 + 2
    for point in skin.tolist():
        near = line[np.argmin(np.abs(found.points[line, 0] - found.points[point, 0]))]
        arm = found.points[point] - found.points[near]
        assert arm[0] == pytest.approx(0.0, abs=1e-14) and np.abs(arm).max() > 1e-3
        for moved, turned in (("motion_1", "motion_1_rotation"), ("displacement", "rotation")):
            axis = found.point_data[moved][near]
            about = found.point_data[turned][near]
            expected = axis + np.cross(about, arm)
            assert found.point_data[moved][point] == pytest.approx(expected, abs=1e-14)
            assert found.point_data[turned][point] == pytest.approx(about, abs=1e-15)


def test_moments_go_on_from_a_beam_into_a_rigid_link(analyse: Read, tmp_path: Path) -> None:
    """A clamped beam and a link in line with it, whose far end is pinned: statics of one bar.

    Normal force and moments are the same on both sides of the joint and fall to zero at the pin,
    with one slope: the shear force is constant.
    """
    text = "BEAM 1 1 2 3 4\nRBEAM 2 3 4 5\nX 3 2 0 0\nX 5 3 0 0\nFIX 1\nFIX 2\nFIX 5\n"
    analysis = analyse(text)
    assert analysis.over_constrained == 3
    found = written(analysis, ".vtu", tmp_path)
    (start, joint), (near, pin) = found.ends_of(1), found.ends_of(2)
    seen = set()
    for k in (1, 2, 3):
        for quantity in ("normal_force", "in_plane_moment", "out_of_plane_moment"):
            values = found.point_data[f"selfstress_{k}_{quantity}"]
            assert values[joint] == pytest.approx(values[near], abs=1e-14)
            if abs(values[near]) > 0.1:
                seen.add(quantity)
            if quantity != "normal_force":
                assert values[pin] == 0.0
                assert values[start] == pytest.approx(3 * values[near], abs=1e-13)
    assert seen == {"normal_force", "in_plane_moment", "out_of_plane_moment"}


def test_collinear_trusses_carry_one_force(analyse: Read, tmp_path: Path) -> None:
    """Numbers of elements and nodes are the deck's; the middle moves across by 1."""
    text = "PLTRUSS 7 1 2\nPLTRUSS 9 2 3\nX 1 -1 0\nX 3 1 0\nFIX 1\nFIX 3\n"
    found = written(analyse(text), ".vtu", tmp_path)
    ends = [*found.ends_of(7), *found.ends_of(9)]
    np.testing.assert_array_equal(found.points[ends], [[-1, 0, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0]])
    np.testing.assert_array_equal(found.point_data["node"][ends], [1, 2, 2, 3])
    assert np.abs(found.point_data["motion_1"][ends, 1]) == pytest.approx([0, 1, 1, 0])
    force = found.point_data["selfstress_1_normal_force"][found.points_of_elements]
    assert np.abs(force) == pytest.approx(1.0, abs=1e-15)
    assert np.ptp(force) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("suffix", [".vtu", ".vtp"])
def test_names_come_back_as_they_are(suffix: str, tmp_path: Path) -> None:
    """Text is text, whatever it contains."""
    names = (
        "<script>alert(1)</script>",
        "m\u00e4rz \u65e5\u672c \U0001f980 & \"quoted\" 'so'",
        "",
        "]]> --> </DataArray>",
        "a %d {} \\0 \\n &amp; &#65;",
    )
    model = flexact.Model()
    points = [model.node(i, 0, 0) for i in range(len(names) + 1)]
    for i, name in enumerate(names):
        model.truss(points[i], points[i + 1], name=name)
    found = written(flexact.analyse(model), suffix, tmp_path)
    assert found.names == dict(enumerate(names, start=1))
    if suffix == ".vtp":
        numbers = found.cell_data["element"].tolist()
        assert found.cell_data["name"] == [names[number - 1] for number in numbers]


def test_many_names_come_back(tmp_path: Path) -> None:
    """More than one compressed block of them."""
    model = flexact.Model()
    points = [model.node(i, 0, 0) for i in range(1001)]
    for i in range(1000):
        model.truss(points[i], points[i + 1], name=f"truss {i} \u00e9 of a thousand")
    model.fix(*points[:1])
    made = content.Meshes(flexact.analyse(model, method="sparse")).still()
    path = tmp_path / "many.vtu"
    path.write_bytes(mesh_bytes(made, find_format("vtu")))
    expected = {i + 1: f"truss {i} \u00e9 of a thousand" for i in range(1000)}
    assert vtk_files.read(path).names == expected


@pytest.mark.parametrize("hidden", [1, 2])
def test_what_is_not_drawn_has_its_line_and_numbers_alone(
    hidden: int, analyse: Read, tmp_path: Path
) -> None:
    text = "PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 1 -1 0\nX 3 1 0\nFIX 1\nFIX 3\nEND\nHALT\n"
    whole = written(analyse(text), ".vtu", tmp_path)
    analysis = analyse(f"{text}VISUALIZATION\nDONOTDRAW {hidden}\nEND\n")
    assert analysis.data.appearance.drawn.tolist() == [hidden != 1, hidden != 2]
    found = written(analysis, ".vtu", tmp_path)
    drawn = 3 - hidden
    assert len(found.cells_of(hidden, QUAD)) == 0
    for number, shape in ((hidden, LINE), (drawn, LINE), (drawn, QUAD)):
        one, other = found.points_of(number, shape), whole.points_of(number, shape)
        assert one.size == other.size > 0
        np.testing.assert_array_equal(found.points[one], whole.points[other])
        for key, values in found.point_data.items():
            np.testing.assert_array_equal(values[one], whole.point_data[key][other])


def test_very_many_elements_have_lines_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    analysis = flexact.analyse(ROOT / "input_decks" / "linkages" / "four_bar_in_space.dat")
    assert np.count_nonzero(written(analysis, ".vtu", tmp_path).shape == QUAD) > 0
    monkeypatch.setattr(content, "MOST_SURFACES", 8)
    few = written(analysis, ".vtu", tmp_path)
    monkeypatch.setattr(content, "MOST_SURFACES", len(analysis.data.element_names) - 1)
    many = written(analysis, ".vtu", tmp_path)
    assert set(few.shape.tolist()) == {VERTEX, LINE, QUAD}
    assert set(many.shape.tolist()) == {VERTEX, LINE}
    for number in few.cell_data["element"].tolist():
        for shape in (VERTEX, LINE):
            one, other = few.points_of(number, shape), many.points_of(number, shape)
            np.testing.assert_array_equal(few.points[one], many.points[other])
            for key, values in many.point_data.items():
                np.testing.assert_array_equal(values[other], few.point_data[key][one])


@pytest.mark.parametrize("suffix", [".vtk", ".xdmf"])
@pytest.mark.parametrize("name", ["paper/six_folded_sheets", "linkages/sarrus"])
def test_other_files_hold_the_same_but_names(suffix: str, name: str, tmp_path: Path) -> None:
    analysis = flexact.analyse(ROOT / "input_decks" / f"{name}.dat")
    grid, other = (written(analysis, each, tmp_path) for each in (".vtu", suffix))
    assert "element_names" in grid.field_data and not other.field_data
    assert grid.cells == other.cells
    np.testing.assert_array_equal(grid.points, other.points)
    assert set(other.point_data) == set(grid.point_data)
    for key, values in other.point_data.items():
        np.testing.assert_array_equal(values, grid.point_data[key])
    for key in ("element", "kind", "form"):
        np.testing.assert_array_equal(other.cell_data[key], grid.cell_data[key])


def test_a_mesh_of_python_is_that_of_the_file(tmp_path: Path) -> None:
    analysis = flexact.analyse(ROOT / "input_decks" / "linkages" / "sarrus.dat")
    made, found = analysis.to_meshio(), written(analysis, ".vtu", tmp_path)
    np.testing.assert_array_equal(made.points, found.points)
    assert sum(len(block.data) for block in made.cells) == len(found.cells)
    assert list(made.point_data) == list(mesh_of(analysis).point_data)
    for key, values in made.point_data.items():
        np.testing.assert_array_equal(values, found.point_data[key])
