# SPDX-License-Identifier: BSD-3-Clause
"""The verb export: its choices, its errors, and what it does to files."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
import vtk_files
from reference_decks import NAMES, ROOT
from small_decks import DECKS, files_in, write

import flexact
from flexact.apps.cli.main import main
from flexact.show.drawing.selection import select_motion

pytestmark = pytest.mark.dear(20)

PAPER = [name for name in NAMES if name.startswith("paper/")]
#: Two bars in line: two motions in space.
TWO_MOTIONS = "TRUSS 1 1 2\nTRUSS 2 2 3\nX 1 -1 0 0\nX 3 1 0 0\nFIX 1\nFIX 3\n"


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    return write(tmp_path / "deck.dat", TWO_MOTIONS)


@pytest.mark.parametrize("name", PAPER)
def test_each_deck_of_the_paper_opens(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = ROOT / "input_decks" / f"{name}.dat"
    for suffix in (".vtu", ".vtp", ".vtk", ".xdmf"):
        target = tmp_path / f"x{suffix}"
        assert main(["export", str(source), "-o", str(target)]) == 0
        assert f"written to {target}, showing " in capsys.readouterr().out
        assert len(vtk_files.read(target).cells) > 0
    assert main(["export", str(source), "-o", str(tmp_path / "x.pvd")]) == 0
    assert len(list((tmp_path / "x_files").iterdir())) == 25


@pytest.mark.parametrize("k", [1, 2])
def test_the_motion_that_was_asked_for_is_shown(
    k: int, deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "x.vtu"
    assert main(["export", str(deck), "-o", str(target), "--motion", str(k)]) == 0
    assert f"showing motion {k} of 2\n" in capsys.readouterr().out
    data = vtk_files.read(target).point_data
    # The size is 2 and the middle moves by 1.
    np.testing.assert_allclose(data["displacement"], 0.2 * data[f"motion_{k}"], atol=1e-15)
    assert np.abs(data["displacement"]).max() == pytest.approx(0.2, abs=0.06)


def test_a_degree_of_freedom_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A crank of a planar four-bar: without kinematically indeterminate motions."""
    source = ROOT / "input_decks" / "linkages" / "four_bar_planar_driven.dat"
    for chosen in ([], ["--freedom", "1"]):
        target = tmp_path / "x.vtu"
        assert main(["export", str(source), "-o", str(target), *chosen]) == 0
        said = capsys.readouterr().out
        assert "showing degree of freedom 1, the drive: rotation\n" in said
        data = vtk_files.read(target).point_data
        assert "motion_1" not in data and data["displacement"].any()


def test_a_mechanism_that_does_not_move_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = write(tmp_path / "still.dat", DECKS["exact"])
    assert main(["export", str(source), "-o", str(tmp_path / "x.pvd")]) == 0
    said, told = capsys.readouterr()
    assert said == f"{source}: written to {tmp_path / 'x.pvd'}\n"
    assert told == f"{source}: note: the mechanism does not move; displacements are zero\n"
    assert files_in(tmp_path / "x_files") == ["step_00.vtu"]


@pytest.mark.parametrize(
    ("chosen", "reason"),
    [
        (["--motion", "3"], "there is no motion 3: the analysis gives 2 motions"),
        (
            ["--freedom", "1"],
            "there is no degree of freedom 1: the analysis gives no degrees of freedom",
        ),
    ],
)
def test_what_is_not_there_is_told(
    chosen: list[str], reason: str, deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", str(deck), "-o", str(tmp_path / "x.vtu"), *chosen]) == 1
    assert capsys.readouterr().err == f"{deck}: error: {reason}\n"
    assert files_in(tmp_path) == ["deck.dat"]


def test_a_degree_of_freedom_that_cannot_move_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The joint of two bars from the ground cannot move; it is declared twice too often."""
    text = DECKS["exact"].replace("END", "INPUTX 3 1\nEND")
    source = write(tmp_path / "stuck.dat", text)
    assert main(["export", str(source), "-o", str(tmp_path / "x.vtu"), "--freedom", "1"]) == 1
    assert "error: degree of freedom 1, node 3 x, cannot move\n" in capsys.readouterr().err


@pytest.mark.parametrize(
    "wrong",
    [
        ["--motion", "0"],
        ["--motion", "x"],
        ["--freedom", "-1"],
        ["--motion", "1", "--freedom", "1"],
    ],
)
def test_wrong_numbers_are_refused(wrong: list[str], deck: Path, tmp_path: Path) -> None:
    assert main(["export", str(deck), "-o", str(tmp_path / "x.vtu"), *wrong]) == 2
    assert files_in(tmp_path) == ["deck.dat"]


def test_a_file_is_wanted(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(deck)]) == 2
    assert "-o" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("x.nonsense", "'nonsense' is not known: it is one of vtu, .*pvd, which plays, vtp, "),
        ("x.ply", "'ply' is not known: it is one of vtu, vtk, xdmf, "),
        ("x.dat", "'dat' is not known"),
        ("x", r"the suffix of .*x is to say what to write: \.vtu, \.step"),
    ],
)
def test_suffixes_that_cannot_be_are_refused(
    name: str, reason: str, deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", str(deck), "-o", str(tmp_path / name)]) == 2
    assert re.search(reason, capsys.readouterr().err)
    assert files_in(tmp_path) == ["deck.dat"]


def test_one_deck_at_a_time(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(decks), "-o", str(decks / "x.vtu")]) == 2
    assert f"{decks} holds 4 decks; this takes one at a time" in capsys.readouterr().err


def test_a_broken_deck_exits_with_2(tmp_path: Path) -> None:
    source = write(tmp_path / "broken.dat", "PLTRUS 1 1 2\n")
    assert main(["export", str(source), "-o", str(tmp_path / "x.vtu")]) == 1
    assert files_in(tmp_path) == ["broken.dat"]


@pytest.mark.posix
@pytest.mark.parametrize("suffix", [".vtu", ".vtp", ".pvd"])
def test_the_deck_is_not_overwritten(
    suffix: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = write(tmp_path / f"deck{suffix}", TWO_MOTIONS)
    other = tmp_path / f"link{suffix}"
    other.symlink_to(source)
    for target in (source, other):
        assert main(["export", str(source), "-o", str(target)]) == 2
        assert f"{target} would overwrite the deck {source}" in capsys.readouterr().err
    assert source.read_text() == TWO_MOTIONS


def test_a_step_of_a_cycle_does_not_overwrite_the_deck(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = write(tmp_path / "x_files" / "step_03.vtu", TWO_MOTIONS)
    assert main(["export", str(source), "-o", str(tmp_path / "x.pvd")]) == 2
    assert f"would overwrite the deck {source}" in capsys.readouterr().err
    assert source.read_text() == TWO_MOTIONS
    assert files_in(tmp_path) == ["x_files/step_03.vtu"]


@pytest.mark.parametrize("suffix", [".vtu", ".vtp", ".vtk"])
def test_an_existing_file_stays_until_the_new_one_is_complete(
    suffix: str, deck: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = write(tmp_path / f"x{suffix}", "old")
    with monkeypatch.context() as broken:
        broken.setattr("os.replace", _full)
        assert main(["export", str(deck), "-o", str(target)]) == 2
    assert target.read_text() == "old"
    assert files_in(tmp_path) == ["deck.dat", f"x{suffix}"]
    assert main(["export", str(deck), "-o", str(target)]) == 0
    found = vtk_files.read(target)
    assert np.count_nonzero(found.cell_data["element"]) == 2 * (1 + 8 + 2 * 3)


def _full(*_: object) -> None:
    raise OSError(28, "No space left on device")


def test_an_unwritable_place_is_told(
    deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "file", "")
    (tmp_path / "folder.vtu").mkdir()
    for target, reason in (
        (tmp_path / "file" / "x.vtu", f"{tmp_path / 'file'} is not a folder"),
        (tmp_path / "folder.vtu", f"cannot write {tmp_path / 'folder.vtu'}: it is a folder"),
    ):
        assert main(["export", str(deck), "-o", str(target)]) == 2
        assert reason in capsys.readouterr().err


def test_a_cycle_where_its_folder_is_a_file(
    deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "x_files", "mine")
    assert main(["export", str(deck), "-o", str(tmp_path / "x.pvd")]) == 2
    assert (
        f"cannot write to {tmp_path / 'x_files'}: {tmp_path / 'x_files'} is not a folder"
        in capsys.readouterr().err
    )
    assert files_in(tmp_path) == ["deck.dat", "x_files"]


def test_missing_packages_are_named(
    deck: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "vtkmodules.vtkIOXML", None)
    assert main(["export", str(deck), "-o", str(tmp_path / "x.vtp")]) == 2
    told = capsys.readouterr().err
    assert "mesh format vtp needs the package vtk: pip install vtk" in told
    assert main(["export", str(deck), "-o", str(tmp_path / "x.vtu")]) == 0
    monkeypatch.setitem(sys.modules, "meshio", None)
    for name in ("y.vtu", "y.pvd"):
        assert main(["export", str(deck), "-o", str(tmp_path / name)]) == 2
        assert "mesh files need the package meshio" in capsys.readouterr().err
    assert files_in(tmp_path) == ["deck.dat", "x.vtu"]


def test_a_motion_that_cannot_be_found_does_not_cost_the_results(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nobody asked for the degree of freedom; where it is asked for, the reason is told."""

    def fail(*_: object, **__: object) -> None:
        raise flexact.AnalysisError("the decomposition of D(c) did not converge")

    source = ROOT / "input_decks" / "linkages" / "four_bar_planar_driven.dat"
    analysis = flexact.analyse(source)
    monkeypatch.setattr("flexact.analysis.freedoms.Block.motion", fail)
    assert select_motion(analysis) is None
    assert not analysis.to_meshio().point_data["displacement"].any()
    with pytest.raises(flexact.AnalysisError, match="did not converge"):
        select_motion(analysis, freedom=1)
