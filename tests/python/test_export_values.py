# SPDX-License-Identifier: BSD-3-Clause
"""The numbers in mesh files against those of the analysis, and against statics and kinematics.

VTK's readers read the files. Expected values are looked up by node and element here, and come
from formulas named in each test; nothing of the drawing is used for them.
"""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
import vtk_files
from reference_decks import NAMES, ROOT
from vtk_files import LINE, QUAD, VERTEX, Read

import flexact
from flexact.core.elements import Member, Role, element_kinds
from flexact.show.drawing import Moving
from flexact.show.mesh import mesh_of
from flexact.show.mesh.file import find_format, mesh_bytes, polydata_bytes

pytestmark = pytest.mark.dear(150)

KINDS = {kind.keyword: kind for kind in element_kinds()}
BEAMS, LINKS, BARS, JOINTS = (
    {word for word, kind in KINDS.items() if kind.member == member}
    for member in (Member.BEAM, Member.LINK, Member.BAR, Member.HINGE)
)
ARRAYS = ("normal_force", "twist_moment", "in_plane_moment", "out_of_plane_moment")
FORMS = {**dict.fromkeys(BARS, 3), **dict.fromkeys(LINKS, 5), **dict.fromkeys(JOINTS, 0)}


def written(analysis: flexact.Analysis, suffix: str, folder: Path) -> Read:
    path = folder / f"mesh{suffix}"
    mesh = mesh_of(analysis)
    content = polydata_bytes(mesh) if suffix == ".vtp" else mesh_bytes(mesh, find_format(suffix))
    path.write_bytes(content)
    return vtk_files.read(path)


@cache
def analysis_of(name: str) -> flexact.Analysis:
    return flexact.analyse(ROOT / "input_decks" / f"{name}.dat")


def elements(analysis: flexact.Analysis) -> list[tuple[int, str, list[int]]]:
    """Number, keyword and node indices p, op, q, oq of each element; -1 where there is none."""
    arrays = analysis.given.arrays
    words = ["", *(kind.keyword for kind in element_kinds())]
    return [
        (number, words[kind], nodes)
        for number, kind, nodes in zip(
            arrays.element_number.tolist(),
            arrays.element_kind.tolist(),
            (arrays.element_node.T - 1).tolist(),
            strict=True,
        )
    ]


def is_rigid(analysis: flexact.Analysis, index: int) -> bool:
    """No deformation is released (2) or independent (3)."""
    return not np.any(analysis.given.arrays.deformation_class[:, index] >= 2)


@pytest.mark.parametrize("name", NAMES)
def test_nodes_and_members_have_the_numbers_of_the_analysis(name: str, tmp_path: Path) -> None:
    analysis = analysis_of(name)
    found = written(analysis, ".vtu", tmp_path)
    arrays = analysis.given.arrays
    for index, (number, keyword, (p, op, q, oq)) in enumerate(elements(analysis)):
        if keyword in JOINTS:
            check_hinge(found, analysis, index, number, keyword, (op, oq))
            continue
        bends = keyword in BEAMS and not is_rigid(analysis, index)
        assert len(found.cells_of(number, LINE)) == (8 if bends else 1)
        first, last = found.ends_of(number)
        inner = np.setdiff1d(found.points_of(number, LINE), (first, last))
        assert not found.point_data["node"][inner].any()
        for point, node, turn in ((first, p, op), (last, q, oq if oq >= 0 else op)):
            assert found.point_data["node"][point] == arrays.node_number[node]
            assert np.abs(found.points[point] - arrays.node_value[:3, node]).max() <= 1e-12
            for k, motion in enumerate(analysis.motions, start=1):
                moved = found.point_data[f"motion_{k}"][point]
                np.testing.assert_array_equal(moved, motion.displacement[node])
                if turn >= 0:
                    turned = found.point_data[f"motion_{k}_rotation"][point]
                    np.testing.assert_array_equal(turned, motion.rotation[turn])
        for k, stress in enumerate(analysis.self_stresses, start=1):
            expected = resultants(keyword, stress.forces[index], stress.moments[index])
            if keyword in LINKS:
                length = np.linalg.norm(found.points[last] - found.points[first])
                expected = link_resultants(length, stress.forces[index])
            for quantity, (at_p, at_q) in shared(analysis, index, expected).items():
                values = found.point_data[f"selfstress_{k}_{quantity}"]
                assert values[first] == pytest.approx(at_p, abs=1e-12)
                assert values[last] == pytest.approx(at_q, abs=1e-12)
                line = values[found.cells_of(number, LINE)[:, 0]]
                share = np.arange(len(line)) / len(line)
                assert line == pytest.approx(at_p + share * (at_q - at_p), abs=1e-12)


def check_hinge(
    found: Read,
    analysis: flexact.Analysis,
    index: int,
    number: int,
    keyword: str,
    turns: tuple[int, int],
) -> None:
    ((point,),) = found.cells_of(number, VERTEX)
    around = found.points[found.points_of(number, QUAD)]
    assert np.abs(around.mean(axis=0) - found.points[point]).max() <= 1e-12
    for k, motion in enumerate(analysis.motions, start=1):
        turned = found.point_data[f"motion_{k}_rotation"][point]
        np.testing.assert_array_equal(turned, motion.rotation[turns[0]])
    for k, stress in enumerate(analysis.self_stresses, start=1):
        m = dict(zip(KINDS[keyword].role, stress.moments[index], strict=True))
        about = (Role.ROTATION, Role.TILT_Y, Role.TILT_Z)
        moment = analysis.given.frames.frame[index] @ [m.get(role, 0.0) for role in about]
        moment[2] += m.get(Role.ANGLE, 0.0)
        axis = analysis.given.frames.frame[index][:, 0]
        for quantity, value in sizes(analysis.given.across[index], axis, moment).items():
            array = found.point_data[f"selfstress_{k}_{quantity}"]
            assert array[point] == pytest.approx(value, abs=1e-12)
            assert array[found.points_of(number, QUAD)] == pytest.approx(value, abs=1e-12)


def sizes(across: np.ndarray, axis: np.ndarray, moment: np.ndarray) -> dict[str, float]:
    """Of a hinge: about its axis, and as it bends to the directions across it."""
    one, two = np.cross(across, axis) @ moment
    made = {"twist_moment": axis @ moment, "in_plane_moment": one, "out_of_plane_moment": two}
    return {name: abs(value) for name, value in made.items()}


def resultants(keyword: str, f: np.ndarray, m: np.ndarray) -> dict[str, tuple[float, float]]:
    """N, T and moments about ey and ez by the definition of the deformations.

    Deck language, eqs. (3) and (4).
    """
    zero = (0.0, 0.0)
    if keyword == "BEAM":
        torsion = (m[1], m[1])
        return {"N": (f[0], f[0]), "T": torsion, "My": (m[2], m[3]), "Mz": (m[4], m[5])}
    if keyword == "PLBEAM":
        return {"N": (f[0], f[0]), "T": zero, "My": zero, "Mz": (-m[1], -m[2])}
    return {"N": (f[0], f[0]), "T": zero, "My": zero, "Mz": zero}


def link_resultants(length: float, f: np.ndarray) -> dict[str, tuple[float, float]]:
    """A cantilever from p with a force at q: no moment at q."""
    return {
        "N": (f[0], f[0]),
        "T": (0.0, 0.0),
        "My": (-length * f[2], 0.0),
        "Mz": (length * f[1], 0.0),
    }


def shared(
    analysis: flexact.Analysis, index: int, local: dict[str, tuple[float, float]]
) -> dict[str, tuple[float, float]]:
    """The arrays of a mesh from moments about local axes.

    A moment M on the face with the outward normal ex stretches the side of d by M . (d x ex).
    """
    ex, ey, ez = analysis.given.frames.frame[index].T
    one, two = np.cross(analysis.given.across[index], ex)
    ends = [my * ey + mz * ez for my, mz in zip(local["My"], local["Mz"], strict=True)]
    return {
        "normal_force": local["N"],
        "twist_moment": local["T"],
        "in_plane_moment": (one @ ends[0], one @ ends[1]),
        "out_of_plane_moment": (two @ ends[0], two @ ends[1]),
    }


@pytest.mark.parametrize("name", NAMES)
def test_both_kinds_of_files_hold_the_same(name: str, tmp_path: Path) -> None:
    analysis = analysis_of(name)
    grid, surface = (written(analysis, suffix, tmp_path) for suffix in (".vtu", ".vtp"))
    assert grid.vectors == surface.vectors == "displacement"
    assert grid.cells == surface.cells
    np.testing.assert_array_equal(grid.shape, surface.shape)
    np.testing.assert_array_equal(grid.points, surface.points)
    for one, other in (
        (grid.point_data, surface.point_data),
        (grid.cell_data, surface.cell_data),
        (grid.field_data, surface.field_data),
    ):
        assert {*one, "name"} == {*other, "name"}
        for key, values in one.items():
            np.testing.assert_array_equal(other[key], values)


@pytest.mark.parametrize("name", NAMES)
def test_arrays_have_their_names_sizes_and_components(name: str, tmp_path: Path) -> None:
    analysis = analysis_of(name)
    found = written(analysis, ".vtu", tmp_path)
    count = len(found.points)
    shapes = {"displacement": (count, 3), "rotation": (count, 3), "node": (count,)}
    for k in range(1, len(analysis.motions) + 1):
        shapes |= {f"motion_{k}": (count, 3), f"motion_{k}_rotation": (count, 3)}
    for k in range(1, len(analysis.self_stresses) + 1):
        shapes |= {f"selfstress_{k}_{q}": (count,) for q in ARRAYS}
    assert {key: values.shape for key, values in found.point_data.items()} == shapes
    assert set(found.cell_data) == {"element", "kind", "form"}
    arrays, data = analysis.given.arrays, analysis.given
    of_element = {
        number: (kind, name)
        for number, kind, name in zip(
            arrays.element_number.tolist(),
            arrays.element_kind.tolist(),
            data.element_names,
            strict=True,
        )
    }
    cells = found.cell_data
    pairs = set(zip(cells["element"].tolist(), cells["kind"].tolist(), strict=True))
    assert pairs - {(0, 0)} == {(number, kind) for number, (kind, _) in of_element.items()}
    assert found.names == {number: name for number, (_, name) in of_element.items()}
    for number, keyword, _ in elements(analysis):
        forms = set(cells["form"][cells["element"] == number].tolist())
        assert len(forms) == 1 and forms <= {FORMS.get(keyword, f) for f in (1, 2, 4, 5)}


@pytest.mark.parametrize("name", NAMES)
def test_no_two_parts_share_a_point(name: str, tmp_path: Path) -> None:
    """Each point belongs to the cells of one shape of one element."""
    found = written(analysis_of(name), ".vtu", tmp_path)
    owner: dict[int, tuple[int, int]] = {}
    for number, shape, points in zip(
        found.cell_data["element"].tolist(), found.shape.tolist(), found.cells, strict=True
    ):
        for point in points:
            assert owner.setdefault(point, (number, shape)) == (number, shape)
    assert len(owner) == len(found.points)


@pytest.mark.parametrize("name", NAMES)
def test_rigid_bodies_move_as_such_with_their_surfaces(name: str, tmp_path: Path) -> None:
    """The velocities of two points of a body differ across the line between them."""
    analysis = analysis_of(name)
    found = written(analysis, ".vtu", tmp_path)
    for index, (number, _, _) in enumerate(elements(analysis)):
        points = found.points_of(number, QUAD)
        if not is_rigid(analysis, index) or not points.size:
            continue
        points = np.append(points, found.points_of(number, LINE))
        arm = found.points[points][:, None] - found.points[points][None]
        for k in range(1, len(analysis.motions) + 1):
            velocity = found.point_data[f"motion_{k}"][points]
            growth = np.sum((velocity[:, None] - velocity[None]) * arm, axis=-1)
            assert np.abs(growth).max() <= 1e-12


@pytest.mark.parametrize("name", NAMES)
def test_the_shown_motion_is_a_tenth_of_the_size(name: str, tmp_path: Path) -> None:
    """Of the first motion, else of the first degree of freedom; rotations at most 1 rad."""
    analysis = analysis_of(name)
    found = written(analysis, ".vtu", tmp_path)
    moved, turned = (found.point_data[key] for key in ("displacement", "rotation"))
    motion = analysis.motions[0] if analysis.motions else None
    if motion is None:
        motions = [freedom.motion for freedom in analysis.freedoms]
        motion = next((each for each in motions if each is not None), None)
    if motion is None:
        assert not moved.any() and not turned.any()
        return
    arrays = analysis.given.arrays
    positions = arrays.node_value[:3, arrays.node_kind <= 2]
    size = np.linalg.norm(np.ptp(positions, axis=1))
    scale = scale_by_nodes(analysis, found, motion)
    axis = np.unique(
        np.concatenate(
            [found.points_of(n, LINE) for n, word, _ in elements(analysis) if word not in JOINTS]
        )
    )
    largest = np.linalg.norm(moved[axis], axis=1).max() / (0.1 * size)
    largest_turn = scale * np.linalg.norm(motion.rotation, axis=1).max()
    assert max(largest, largest_turn) == pytest.approx(1.0, abs=1e-9)
    if analysis.motions:
        of_motion = found.point_data["motion_1"], found.point_data["motion_1_rotation"]
        np.testing.assert_allclose(moved, scale * of_motion[0], rtol=0, atol=1e-12)
        np.testing.assert_allclose(turned, scale * of_motion[1], rtol=0, atol=1e-12)


def scale_by_nodes(analysis: flexact.Analysis, found: Read, motion: Moving) -> float:
    """What the motion of the nodes was multiplied by; the same for all."""
    given, shown = [], []
    for number, keyword, (p, op, q, oq) in elements(analysis):
        if keyword in JOINTS:
            continue
        ends = zip(found.ends_of(number), ((p, op), (q, oq)), strict=True)
        for point, (node, turn) in ends:
            given.append(motion.displacement[node])
            shown.append(found.point_data["displacement"][point])
            if turn >= 0:
                given.append(motion.rotation[turn])
                shown.append(found.point_data["rotation"][point])
    one, other = np.concatenate(given), np.concatenate(shown)
    scale = float(one @ other / (one @ one))
    np.testing.assert_allclose(other, scale * one, rtol=0, atol=1e-12)
    return scale
