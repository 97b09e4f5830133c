# SPDX-License-Identifier: BSD-3-Clause
"""The cycle that plays: time steps, what moves where, and that its files belong together."""

from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import vtk_files
from reference_decks import NAMES, ROOT
from test_export_values import written
from vtk_files import LINE, QUAD

import flexact
from flexact.show.drawing.selection import select_motion
from flexact.show.mesh.collection import cycle
from flexact.show.writers import write
from flexact.util.outputs import OutputError

pytestmark = pytest.mark.dear(8)

#: A rigid arm of length 2 that turns about z at (1, 0, 0).
ARM = """\
HINGE 1 2 4 0 0 1
RBEAM 2 1 2 3
BEAM 3 3 4 5 6
X 3 1 0 0
X 5 3 0 0
FIX 1
FIX 2
RLSE 1 1
"""


@pytest.fixture
def play(tmp_path: Path) -> Callable[[flexact.Analysis], Path]:
    def to_file(analysis: flexact.Analysis) -> Path:
        chosen = select_motion(analysis)
        target = tmp_path / "x.pvd"
        write(target, cycle(analysis, None if chosen is None else chosen.motion, target))
        return target

    return to_file


def steps_of(target: Path) -> list[tuple[float, Path]]:
    """Times and files, as ParaView's reader takes them."""
    root = ElementTree.parse(target).getroot()
    assert root.tag == "VTKFile" and root.get("type") == "Collection"
    steps = root.findall("./Collection/DataSet")
    return [(float(s.get("timestep", "")), target.parent / s.get("file", "")) for s in steps]


@pytest.mark.parametrize("name", [name for name in NAMES if name.startswith("paper/")])
def test_a_cycle_has_all_steps_from_0_to_1(
    name: str, play: Callable[[flexact.Analysis], Path], tmp_path: Path
) -> None:
    """Displacements lead from the reference to where the points are; all else is as there."""
    analysis = flexact.analyse(ROOT / "input_decks" / f"{name}.dat")
    steps = steps_of(play(analysis))
    still = written(analysis, ".vtu", tmp_path)
    times = [time for time, _ in steps]
    assert times == pytest.approx(np.linspace(0.0, 1.0, 25), abs=1e-15)
    assert len({path for _, path in steps}) == 25
    for _, path in steps:
        found = vtk_files.read(path)
        assert found.cells == still.cells
        moved = found.point_data["displacement"]
        assert np.abs(found.points - moved - still.points).max() <= 1e-12
        assert set(found.point_data) == set(still.point_data)
        for key in set(found.point_data) - {"displacement", "rotation"}:
            np.testing.assert_array_equal(found.point_data[key], still.point_data[key])
        assert found.names == still.names


@pytest.mark.grid
@pytest.mark.parametrize("name", [name for name in NAMES if not name.startswith("paper/")])
def test_a_cycle_goes_there_and_back(
    name: str, play: Callable[[flexact.Analysis], Path], tmp_path: Path
) -> None:
    """From rest to about the amplitude, back over the reference to the other side, and to rest."""
    analysis = flexact.analyse(ROOT / "input_decks" / f"{name}.dat")
    steps = steps_of(play(analysis))
    still = written(analysis, ".vtu", tmp_path)
    first = vtk_files.read(steps[0][1]).points
    if len(steps) == 1:
        assert not analysis.motions
        np.testing.assert_array_equal(first, still.points)
        return
    for at_rest in (0, 12, 24):
        np.testing.assert_array_equal(vtk_files.read(steps[at_rest][1]).points, first)
    assert np.abs(first - still.points).max() <= 1e-12
    there, other = (vtk_files.read(steps[i][1]).points for i in (6, 18))
    size = np.abs(still.point_data["displacement"]).max()
    assert np.abs(there - still.points).max() > 0.3 * size
    # To first order the two sides mirror each other.
    assert np.abs(there + other - 2 * still.points).max() < np.abs(there - other).max()


def test_an_arm_turns_on_its_circle(
    play: Callable[[flexact.Analysis], Path], tmp_path: Path
) -> None:
    """It turns by an angle times sin(2 pi t), stays as long as it is, and its end on the circle.

    The size is 3, so that the end, 2 from the hinge, turns by 0.15 to first order.
    """
    deck = tmp_path / "arm.dat"
    deck.write_text(ARM)
    steps = steps_of(play(flexact.analyse(deck)))
    sign = 0.0
    for time, path in steps:
        found = vtk_files.read(path)
        near, far = found.ends_of(3)
        arm = found.points[far] - found.points[near]
        assert np.linalg.norm(arm) == pytest.approx(2.0, abs=1e-12)
        # Between two poses points go straight: a chord instead of an arc of 0.15 / 8.
        assert found.points[near] == pytest.approx([1, 0, 0], abs=1e-4)
        angle = np.arctan2(arm[1], arm[0])
        sign = sign or (np.sign(angle) if time > 0.0 else 0.0)
        assert angle == pytest.approx(sign * 0.15 * np.sin(2 * np.pi * time), abs=2e-3)
        assert found.point_data["rotation"][far] == pytest.approx([0, 0, angle], abs=1e-4)
        body = found.points[found.points_of(3, QUAD)]
        assert np.abs(body[:, 2]).max() < 0.2 and len(body) == 8


def test_a_sheet_bends_on_a_cubic_curve(
    play: Callable[[flexact.Analysis], Path], tmp_path: Path
) -> None:
    """Small angles: deflection theta (x^2 / l - x^3 / l^2) of an end that turns, l = 2."""
    deck = tmp_path / "sheet.dat"
    deck.write_text("BEAM 1 1 2 3 4 0 1 0\nX 3 2 0 0\nFIX 1\nFIX 2\nFIX 3\nFIX 4 2 4\nRLSE 1 3 4\n")
    path = steps_of(play(flexact.analyse(deck)))[6][1]
    found = vtk_files.read(path)
    line = found.points_of(1, LINE)
    x, z = found.points[line, 0], found.points[line, 2]
    theta = found.point_data["rotation"][line[-1], 1]
    assert 0.1 < abs(theta) <= 1.0
    # The curve starts along the turned ends, so that its slope is sin(theta) in its parameter.
    at = np.arange(9) / 4
    assert z == pytest.approx(np.sin(theta) * (at**2 / 2 - at**3 / 4), abs=1e-9)
    assert z[4] == pytest.approx(np.sin(theta) * 2 / 8, abs=1e-9)
    assert np.all(np.diff(x) > 0.0)


def test_a_step_of_an_earlier_cycle_is_not_named(
    play: Callable[[flexact.Analysis], Path], tmp_path: Path
) -> None:
    moving = flexact.analyse(ROOT / "input_decks" / "linkages" / "sarrus.dat")
    assert len(steps_of(play(moving))) == 25
    still = flexact.analyse(ROOT / "input_decks" / "flexures" / "six_wires.dat")
    assert select_motion(still) is None
    ((time, path),) = steps_of(play(still))
    assert time == 0.0
    assert not vtk_files.read(path).point_data["displacement"].any()


def test_a_cycle_appears_whole_or_not_at_all(
    play: Callable[[flexact.Analysis], Path], tmp_path: Path
) -> None:
    analysis = flexact.analyse(ROOT / "input_decks" / "linkages" / "sarrus.dat")
    target = play(analysis)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    other = flexact.analyse(ROOT / "input_decks" / "linkages" / "bennett.dat")
    last = steps_of(target)[-1][1]
    last.chmod(0o444)
    with pytest.raises(OutputError, match="it is read-only"):
        play(other)
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_a_failing_cycle_leaves_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> bytes:
        raise OutputError("there is not enough memory for the mesh")

    analysis = flexact.analyse(ROOT / "input_decks" / "linkages" / "sarrus.dat")
    target = tmp_path / "x.pvd"
    files = cycle(analysis, analysis.motions[0], target)
    made = iter((b"first", b"second"))
    monkeypatch.setattr(
        "flexact.show.mesh.collection.mesh_bytes", lambda *given: next(made, None) or fail(*given)
    )
    with pytest.raises(OutputError, match="not enough memory"):
        write(target, files)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("stem", ["a & <b>", "m\u00e4rz \u65e5\u672c", 'it\'s "so"', "100%", "a.b"])
def test_a_cycle_names_its_files_whatever_it_is_called(stem: str, tmp_path: Path) -> None:
    analysis = flexact.analyse(ROOT / "input_decks" / "flexures" / "six_wires.dat")
    target = tmp_path / f"{stem}.pvd"
    write(target, cycle(analysis, None, target))
    ((_, path),) = steps_of(target)
    assert path.is_file()


@pytest.mark.parametrize("stem", ["a\x01b", "a\udcffb"])
def test_a_name_that_xml_cannot_spell_is_refused(stem: str, tmp_path: Path) -> None:
    analysis = flexact.analyse(ROOT / "input_decks" / "flexures" / "six_wires.dat")
    with pytest.raises(OutputError, match="that XML cannot spell"):
        cycle(analysis, None, tmp_path / f"{stem}.pvd")
    assert list(tmp_path.iterdir()) == []


def test_many_steps_of_a_large_mesh_hold_few_modes(
    play: Callable[[flexact.Analysis], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """All numbers of a cycle together are limited; one motion is always there."""
    analysis = flexact.analyse(ROOT / "input_decks" / "linkages" / "parallelogram_flat.dat")
    assert len(analysis.motions) == 2
    assert "motion_2" in vtk_files.read(steps_of(play(analysis))[0][1]).point_data
    monkeypatch.setattr("flexact.show.mesh.content._NUMBERS", 1)
    data = vtk_files.read(steps_of(play(analysis))[0][1]).point_data
    assert "motion_1" in data and "motion_2" not in data
