# SPDX-License-Identifier: BSD-3-Clause
"""Supports, declared freedoms and field data of meshes, as meshio and VTK read them."""

from collections import Counter
from pathlib import Path

import meshio
import numpy as np
import pytest
import vtk_files
from reference_decks import NAMES, ROOT
from small_decks import write
from test_export_values import analysis_of, written
from vtk_files import QUAD

import flexact
from flexact.apps.cli.main import main
from flexact.show.mesh.content import component_names, field_data_of

CLAMP, PIN, SLIDE, TURN, TRANSLATION, ROTATION = range(6, 12)
SOME = ["paper/six_folded_sheets", "linkages/sarrus", "flexures/planar_parallel_guide"]

#: A beam from a clamp to a node that is held along y and z, and about x; the rest is declared.
HELD = """\
BEAM 1 1 2 3 4 0 1 0
X 3 2 0 0
FIX 1
FIX 2
FIX 3 2 3
FIX 4 2
DYNX 3 1
DYNX 4 4
RLSE 1
"""


def text_of(array: np.ndarray) -> str:
    return bytes(array).decode()


def faces(found: vtk_files.Read, form: int) -> np.ndarray:
    mine = np.flatnonzero(found.cell_data["form"] == form)
    assert set(found.shape[mine].tolist()) == {QUAD}
    return np.array([found.cells[i] for i in mine.tolist()])


def volume(points: np.ndarray, quads: np.ndarray) -> float:
    a, b, c, d = (points[quads[:, i]] for i in range(4))
    return float(np.sum(a * (np.cross(b, c) + np.cross(c, d))) / 6)


def test_each_declaration_has_its_symbol(tmp_path: Path) -> None:
    """What the deck says, node by node; symbols are closed and have their outsides outside."""
    analysis = flexact.analyse(write(tmp_path / "held.dat", HELD))
    found = written(analysis, ".vtu", tmp_path)
    symbols = found.cell_data["form"][found.cell_data["element"] == 0]
    assert set(symbols.tolist()) == {CLAMP, SLIDE, TURN, TRANSLATION, ROTATION}
    assert not found.cell_data["kind"][found.cell_data["element"] == 0].any()
    for form, where in ((CLAMP, 0.0), (SLIDE, 2.0), (TURN, 2.0), (TRANSLATION, 2.0)):
        quads = faces(found, form)
        near = np.abs(found.points[quads] - [where, 0, 0]).max()
        assert 0.0 < near < 0.3, form
    for form in (CLAMP, SLIDE, TURN, TRANSLATION, ROTATION):
        quads = faces(found, form).tolist()
        edges = Counter((a, b) for q in quads for a, b in zip(q, q[1:] + q[:1], strict=True))
        assert set(edges.values()) == {1} and set(edges) == {(b, a) for a, b in edges}
        assert volume(found.points, np.array(quads)) > 0.0
    # A declared translation along x points along x, a rotation about z lies across z.
    arrow = found.points[faces(found, TRANSLATION)].reshape(-1, 3) - [2, 0, 0]
    assert arrow[:, 0].max() == pytest.approx(0.26) and np.abs(arrow[:, 1:]).max() < 0.03
    turn = found.points[faces(found, ROTATION)].reshape(-1, 3)
    assert np.abs(turn[:, 2]).max() < 0.03 < np.ptp(turn[:, 1])


def test_symbols_go_with_their_nodes(tmp_path: Path) -> None:
    """In each step of a cycle as far as the node that they stand at; at rest at first."""
    assert (
        main(["export", str(write(tmp_path / "d.dat", HELD)), "-o", str(tmp_path / "x.pvd")]) == 0
    )
    steps = [vtk_files.read(path) for path in sorted((tmp_path / "x_files").iterdir())]
    assert not steps[0].point_data["displacement"].any()
    assert steps[6].point_data["displacement"].any()
    for step in steps:
        (end,) = np.unique(step.points[step.ends_of(1)[1]][None], axis=0)
        moved = step.point_data["displacement"]
        for form in (SLIDE, TURN, TRANSLATION):
            away = moved[np.unique(faces(step, form))] - (end - [2, 0, 0])
            assert np.abs(away).max() < 1e-12
        assert not moved[np.unique(faces(step, CLAMP))].any()


@pytest.mark.parametrize("name", SOME)
def test_meshio_reads_what_vtk_reads_and_writes_it_again(name: str, tmp_path: Path) -> None:
    """Every array, name and number; meshio itself writes no field data."""
    analysis = analysis_of(name)
    found = written(analysis, ".vtu", tmp_path)
    read = meshio.read(tmp_path / "mesh.vtu")
    np.testing.assert_array_equal(read.points, found.points)
    assert [cell for block in read.cells for cell in block.data.tolist()] == found.cells
    assert set(read.point_data) == set(found.point_data)
    assert set(read.cell_data) == set(found.cell_data)
    assert set(read.field_data) == set(found.field_data) == set(field_data_of(analysis))
    for key, values in read.field_data.items():
        np.testing.assert_array_equal(values.ravel(), found.field_data[key].ravel())
    read.write(tmp_path / "again.vtu")
    again = vtk_files.read(tmp_path / "again.vtu")
    for key, values in found.point_data.items():
        np.testing.assert_array_equal(again.point_data[key], values)
        np.testing.assert_array_equal(read.point_data[key], values)
    for key, values in found.cell_data.items():
        np.testing.assert_array_equal(again.cell_data[key], values)


@pytest.mark.parametrize("name", NAMES[::7])
def test_field_data_say_what_the_analysis_says(name: str, tmp_path: Path) -> None:
    analysis = analysis_of(name)
    written(analysis, ".vtu", tmp_path)
    data = meshio.read(tmp_path / "mesh.vtu").field_data
    assert text_of(data["verdict"]) == analysis.verdict.value
    assert data["under_constrained"].tolist() == [analysis.under_constrained]
    assert data["over_constrained"].tolist() == [analysis.over_constrained]
    assert data["degrees_of_freedom"].tolist() == [analysis.degrees_of_freedom]
    length = np.inf if analysis.margin.length is None else analysis.margin.length
    assert data["margin"].tolist() == [length]
    units = dict(line.split(": ") for line in text_of(data["units"]).splitlines())
    assert units["selfstress_k_in_plane_moment"] == "N m" and units["displacement"] == "m"
    names = text_of(data["element_names"]).split("\n")[:-1]
    assert names == list(analysis.given.element_names)
    numbers = analysis.given.arrays.element_number.tolist()
    assert data["element_number"].ravel().tolist() == numbers
    told = component_names(data)
    assert told["element_number"] == names and told["verdict"] == [analysis.verdict.value]


def test_both_verbs_write_one_kind_of_file(tmp_path: Path) -> None:
    deck = str(ROOT / "input_decks" / "paper" / "six_folded_sheets.dat")
    assert main(["analyse", deck, "-o", str(tmp_path)]) == 0
    assert main(["export", deck, "-o", str(tmp_path / "other.vtu")]) == 0
    one, other = (tmp_path / f"{name}.vtu" for name in ("six_folded_sheets", "other"))
    assert one.read_bytes() == other.read_bytes()
