# SPDX-License-Identifier: BSD-3-Clause
"""The mesh: geometry, motions and self-stresses, and that files keep them.

Expected values come from statics and kinematics by hand, named in each test.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import flexact
from flexact.show.mesh import mesh_of, to_meshio
from flexact.show.mesh.file import MeshFormatError, find_format, mesh_bytes
from flexact.util.outputs import OutputError

meshio: Any = pytest.importorskip("meshio")

COLLINEAR = """\
PLTRUSS 7 1 2
PLTRUSS 9 2 3
X 1 -1 0
X 3 1 0
FIX 1
FIX 3
"""
CLAMPED_SHEET = """\
% one sheet in the xz plane between two clamps: no columns, three self-stresses
BEAM 1 1 2 3 4 0 1 0
X 3 2 0 0
FIX 1
FIX 2
FIX 3
FIX 4
RLSE 1 2 5 6
"""
HINGED = """\
% a rigid arm of length 2 on a hinge about z at (1, 0, 0), at the end of a rigid link to ground
HINGE 1 2 4 0 0 1
RBEAM 2 1 2 3
RBEAM 3 3 4 5
X 3 1 0 0
X 5 3 0 0
FIX 1
FIX 2
RLSE 1 1
"""
PLANAR_CLAMPED = "PLBEAM 1 1 2 3 4\nX 3 2 0\nFIX 1\nFIX 2\nFIX 3\nFIX 4\n"

Read = Callable[[str], flexact.Analysis]


@pytest.fixture
def analyse(tmp_path: Path) -> Read:
    def from_text(text: str) -> flexact.Analysis:
        path = tmp_path / "deck.dat"
        path.write_text(text)
        return flexact.analyse(path)

    return from_text


def at_ends(mesh: Any, name: str, element: int) -> tuple[Any, Any]:
    """Point data at both ends of an element's line."""
    lines = next(k for k, block in enumerate(mesh.cells) if block.type == "line")
    mine = mesh.cell_data["element"][lines] == element
    points = mesh.cells[lines].data[mine]
    return mesh.point_data[name][points[0, 0]], mesh.point_data[name][points[-1, 1]]


def test_collinear_bars(analyse: Read) -> None:
    """The middle joint moves across, both bars carry the same force."""
    mesh = to_meshio(analyse(COLLINEAR))
    assert [block.type for block in mesh.cells] == ["line", "quad"]
    assert mesh.cells[0].data.tolist() == [[0, 1], [2, 3]]
    np.testing.assert_array_equal(mesh.points[:4], [[-1, 0, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0]])
    np.testing.assert_array_equal(mesh.point_data["node"][:4], [1, 2, 2, 3])
    motion = mesh.point_data["motion_1"]
    np.testing.assert_allclose(np.abs(motion[:4, 1]), [0, 1, 1, 0], atol=1e-15)
    np.testing.assert_array_equal(motion[1], motion[2])
    np.testing.assert_array_equal(mesh.cell_data["element"][0], [7, 9])
    force = mesh.point_data["selfstress_1_normal_force"]
    mine = mesh.cells[1].data[mesh.cell_data["element"][1] > 0]
    np.testing.assert_allclose(np.abs(force[mine]), 1.0, atol=1e-15)


def test_moments_of_a_clamped_sheet(analyse: Read) -> None:
    """Its self-stresses span elongation and bending about y at both ends, l0 = 2.

    Each alone in one of them, and one: the squares of N sum up to 1; a moment is sigma l0.
    """
    analysis = analyse(CLAMPED_SHEET)
    mesh = to_meshio(analysis)
    names = [f"selfstress_{k}_" for k in (1, 2, 3)]
    forces = np.array([at_ends(mesh, name + "normal_force", 1)[0] for name in names])
    assert forces @ forces == pytest.approx(1.0, abs=1e-14)
    for name, stress in zip(names, analysis.self_stresses, strict=True):
        ends = 2.0 * stress.vector[[row[1] in (3, 4) for row in analysis.row_labels]]
        assert at_ends(mesh, name + "in_plane_moment", 1) == pytest.approx(tuple(ends), abs=1e-14)
        assert (
            not mesh.point_data[name + "twist_moment"].any()
            and not mesh.point_data[name + "out_of_plane_moment"].any()
        )


def test_a_hinge_is_a_vertex_that_its_parts_share(analyse: Read) -> None:
    """The arm turns about z: its end moves along y by its length, 2, times the rotation."""
    mesh = to_meshio(analyse(HINGED))
    assert [block.type for block in mesh.cells] == ["vertex", "line", "quad"]
    assert [blocks.tolist() for blocks in mesh.cell_data["element"][:2]] == [[1], [2, 3]]
    np.testing.assert_array_equal(mesh.points[0], [1, 0, 0])
    motion, rotation = mesh.point_data["motion_1"], mesh.point_data["motion_1_rotation"]
    turn = rotation[3, 2]
    assert abs(turn) == pytest.approx(1 / 2, abs=1e-14)
    np.testing.assert_allclose(motion[4], [0, 2 * turn, 0], atol=1e-14)
    np.testing.assert_array_equal(rotation[4], rotation[3])
    np.testing.assert_allclose(motion[:4], 0.0, atol=1e-14)


def test_a_hinge_has_a_cylinder_about_its_axis(analyse: Read) -> None:
    """About z through (1, 0, 0); in the plane it is a disc."""
    for text, faces, flat in (
        (HINGED, 8 + 2 * 3, False),
        ("PLHINGE 1 2 4\nPLRBEAM 2 1 2 3\nPLRBEAM 3 3 4 5\nX 3 1 0\nX 5 3 0\nFIX 1\n", 3, True),
    ):
        mesh = to_meshio(analyse(text))
        quads = mesh.cells[-1].data[mesh.cell_data["element"][-1] == 1]
        assert mesh.cells[-1].type == "quad" and len(quads) == faces
        corner = mesh.points[np.unique(quads)] - [1, 0, 0]
        radius = np.linalg.norm(corner[:, :2], axis=1)
        assert np.ptp(radius) == pytest.approx(0.0, abs=1e-14) and radius[0] > 0.01
        assert np.ptp(corner[:, 2]) == 0.0 if flat else np.ptp(corner[:, 2]) > 0.01


def test_both_hinges_of_a_cardan_joint_sit_at_its_centre(analyse: Read) -> None:
    """Node 10 stands between two hinges alone; the joint is at (1, 0, 0)."""
    cardan = HINGED.replace("HINGE 1 2 4 0 0 1", "HINGE 1 2 10 0 0 1\nHINGE 4 10 4 0 1 0")
    mesh = to_meshio(analyse(cardan))
    np.testing.assert_array_equal(mesh.cell_data["element"][0], [1, 4])
    np.testing.assert_array_equal(mesh.points[:2], [[1, 0, 0], [1, 0, 0]])


def test_planar_moments_count_as_in_space(analyse: Read) -> None:
    """A beam along x, clamped at both ends: positive where its upper side, to y, is stretched.

    Planar e2 = -l0 el.ey(p), references: deck language. Power M_z times rotation of the far end:
    a moment about +z there, which stretches the lower side, has -2 sigma_2 and -2 sigma_3.
    """
    analysis = analyse(PLANAR_CLAMPED)
    mesh = to_meshio(analysis)
    for k, stress in enumerate(analysis.self_stresses, start=1):
        bending = tuple(2.0 * stress.vector[1:])
        found = at_ends(mesh, f"selfstress_{k}_out_of_plane_moment", 1)
        assert found == pytest.approx(bending, abs=1e-14)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("vtk", COLLINEAR),
        ("vtk", HINGED),
        ("xdmf", COLLINEAR),
    ],
)
def test_files_keep_every_value(
    name: str, text: str, analyse: Read, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What meshio reads again; the tests of the export look at files with VTK's readers."""
    made = mesh_of(analyse(text))
    mesh, form = made.to_meshio(), find_format(name)
    path = tmp_path / f"mesh.{form}"
    path.write_bytes(mesh_bytes(made, form))
    if name == "xdmf":
        # meshio imports h5py to read any XDMF file, and uses it for HDF data only.
        monkeypatch.setitem(sys.modules, "h5py", ModuleType("h5py"))
    back = meshio.read(path, file_format=form)
    np.testing.assert_allclose(back.points, mesh.points, rtol=1e-12, atol=1e-12)
    assert [block.type for block in back.cells] == [block.type for block in mesh.cells]
    for block, again in zip(mesh.cells, back.cells, strict=True):
        np.testing.assert_array_equal(again.data, block.data)
    for key, values in mesh.point_data.items():
        np.testing.assert_allclose(back.point_data[key], values, rtol=1e-12, atol=1e-12)
    for key, blocks in mesh.cell_data.items():
        for values, again in zip(blocks, back.cell_data[key], strict=True):
            np.testing.assert_allclose(again.ravel(), values, rtol=1e-12, atol=1e-12)


def test_xdmf_with_vertices_is_as_its_standard_says(analyse: Read) -> None:
    """Polyline 2 and polyvertex 1, each behind its number of points; meshio reads no vertices."""
    content = ElementTree.fromstring(mesh_bytes(mesh_of(analyse(HINGED)), find_format("xdmf")))
    topology = content.find(".//Topology/DataItem")
    assert topology is not None and topology.text is not None
    numbers = topology.text.split()
    assert numbers[:11] == ["1", "1", "0", "2", "2", "1", "2", "2", "2", "3", "4"]
    # Quadrilaterals: 5, and four points.
    assert set(numbers[11::5]) == {"5"} and len(numbers[11:]) % 5 == 0
    assert {item.get("Format") for item in content.iter("DataItem")} == {"XML"}


@pytest.mark.parametrize("name", ["stl", ".ply", "gmsh", "dat", "nonsense"])
def test_other_formats_are_refused_with_those_that_there_are(name: str) -> None:
    """Most of meshio's formats lose cells or data; its own functions take the mesh."""
    with pytest.raises(MeshFormatError) as error:
        find_format(name)
    assert str(error.value).startswith(
        f"mesh format '{name.strip('.')}' is not known: it is one of vtu, vtk, xdmf, "
    )
    assert "analysis.to_meshio()" in str(error.value)


def test_without_meshio_the_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(MeshFormatError, match="package meshio: pip install meshio"):
        find_format("vtu")


def test_a_full_disk_is_not_the_formats_fault(
    analyse: Read, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fill_up(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    mesh = mesh_of(analyse(COLLINEAR))
    monkeypatch.setattr(meshio, "write", fill_up)
    form = find_format("vtk")
    with pytest.raises(OutputError, match="temporary folder: no space left on device") as error:
        mesh_bytes(mesh, form)
    assert not isinstance(error.value, MeshFormatError)


@pytest.mark.parametrize("name", ["vtu", ".VTU", "VTU"])
def test_formats_go_by_suffix_or_name(name: str) -> None:
    assert find_format(name) == "vtu"


def test_the_analysis_gives_its_mesh(analyse: Read) -> None:
    analysis = analyse(COLLINEAR)
    np.testing.assert_array_equal(analysis.to_meshio().points, to_meshio(analysis).points)


def test_hinges_without_any_position_are_vertices_at_the_origin() -> None:
    model = flexact.Model()
    point = model.node(0, 0, 0)
    for axis in ((0, 0, 1), (0, 1, 0), (1, 0, 0)):
        point = model.hinge(point, axis)
    mesh = flexact.analyse(model).to_meshio()
    assert mesh.cells[0].type == "vertex" and len(mesh.cells[0].data) == 3
    assert mesh.point_data["node"][:3].tolist() == [0, 0, 0]
    assert not mesh.points[:3].any()
