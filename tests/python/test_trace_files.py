# SPDX-License-Identifier: BSD-3-Clause
"""The verb trace and its files: tables, pictures, cycles that play, and what is refused."""

import csv
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import vtk_files
from reference_decks import ROOT

import flexact
from flexact.apps.cli.main import main
from flexact.tracing.output import plot_bytes
from flexact.util.rotations import vector_of

DECKS = ROOT / "input_decks"
TRUSSES, WIRES = DECKS / "paper" / "twelve_trusses.dat", DECKS / "paper" / "five_wires.dat"


def traced(*words: object) -> int:
    return main(["trace", *map(str, words)])


def table_of(path: Path) -> dict[str, list[str]]:
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}


def test_a_table_has_a_row_a_step(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "path.csv"
    assert traced(TRUSSES, "--motion", 1, "--steps", 20, "-o", target) == 0
    told = capsys.readouterr().out
    assert f"written to {target}\n" in told
    table = table_of(target)
    path = flexact.trace(TRUSSES, motion=1, steps=20)
    assert [float(each) for each in table["arc [m]"]] == path.arc.tolist()
    assert table["step"].index("0") == path.reference
    assert max(map(float, table["residual [size]"])) == path.residual < 1e-14
    for name in "EFGH":
        place = np.array([table[f"{name} {axis} [m]"] for axis in "xyz"], float).T
        assert np.array_equal(place, path.positions(name))
    assert table["under_constrained"] == [str(step.under_constrained) for step in path.steps]
    dead = [told for told in table["dead_point"] if told]
    assert len(dead) == 2 and all("turn back" in told for told in dead)
    assert float(table["sigma 1"][0]) < 1e-12 < float(table["sigma 2"][0])


def test_a_table_of_a_freedom_has_it_and_the_bodies_rotations(tmp_path: Path) -> None:
    target = tmp_path / "path.csv"
    assert traced(WIRES, "--freedom", 1, "--length", 0.05, "--steps", 10, "-o", target) == 0
    table = table_of(target)
    drive = "centre of the body z [m]"
    path = flexact.trace(WIRES, freedom=1, length=0.05, steps=10)
    assert [float(each) for each in table[drive]] == pytest.approx(
        [step.drive for step in path.steps], abs=1e-16
    )
    (turned,) = {name.removesuffix(" rx [rad]") for name in table if name.endswith(" rx [rad]")}
    node = path.result.given.node_index[2]
    vectors = vector_of(np.array([step.pose.rotation[node] for step in path.steps]))
    for k, axis in enumerate(("rx", "ry", "rz")):
        assert np.array([table[f"{turned} {axis} [rad]"]], float)[0] == pytest.approx(vectors[:, k])


def test_a_planar_table_has_two_coordinates(tmp_path: Path) -> None:
    target = tmp_path / "path.csv"
    deck = DECKS / "linkages" / "four_bar_planar.dat"
    assert traced(deck, "--steps", 5, "-o", target) == 0
    names = list(table_of(target))
    assert "B x [m]" in names and "B y [m]" in names and "B z [m]" not in names
    assert "crank AB rz [rad]" in names and "crank AB rx [rad]" not in names


def test_a_cycle_begins_and_ends_at_rest_and_reaches_both_ends(tmp_path: Path) -> None:
    target = tmp_path / "path.pvd"
    assert traced(TRUSSES, "--length", 0.4, "--steps", 4, "-o", target) == 0
    path = flexact.trace(TRUSSES, length=0.4, steps=4)
    shown = ElementTree.parse(target).getroot().findall("./Collection/DataSet")
    times = [float(each.get("timestep", "")) for each in shown]
    files = [tmp_path / each.get("file", "") for each in shown]
    assert times[0] == 0.0 and np.all(np.diff(times) > 0.0)
    assert times[-1] == pytest.approx(2.0 * np.ptp(path.arc))
    assert len(set(files)) == len(path.steps) == len(list((tmp_path / "path_files").iterdir()))
    assert files[0] == files[-1]
    still = vtk_files.read(files[0])
    assert not still.point_data["displacement"].any()
    end = vtk_files.read(files[len(path.steps) - 1 - path.reference])
    node = path.result.given.node_index[5]
    number = path.result.given.arrays.node_number[node]
    place = end.points[list(end.point_data["node"]).index(number)]
    assert place == pytest.approx(path.steps[-1].pose.position[node], abs=1e-12)


def test_a_picture_is_drawn_and_always_the_same() -> None:
    pytest.importorskip("matplotlib")
    path = flexact.trace(WIRES, freedom=1, steps=5)
    drawn = plot_bytes(path)
    assert drawn.startswith(b"\x89PNG") and drawn == plot_bytes(path)


def test_without_a_file_the_words_are_all(capsys: pytest.CaptureFixture[str]) -> None:
    assert traced(DECKS / "linkages" / "sarrus.dat", "--steps", 5, "--length", 0.3) == 0
    told = capsys.readouterr().out
    assert told.startswith("Motion 1 of 1") and "below 1e-14" in told
    assert flexact.trace(DECKS / "linkages" / "sarrus.dat", steps=5, length=0.3).describe() in told


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--motion", "2"], "there is no motion 2: the analysis gives 1 motion"),
        (["--freedom", "1"], "there is no degree of freedom 1"),
        (["-o", "path.txt"], "is to be .pvd, .csv, .png, .svg or .pdf"),
        (["-o", "path"], "is to be .pvd, .csv, .png, .svg or .pdf"),
        (["-o", f"{TRUSSES}/path.csv"], "twelve_trusses.dat"),
    ],
)
def test_wrong_choices_are_told(
    words: list[str],
    reason: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert traced(TRUSSES, *words) == (2 if "-o" in words else 1)
    assert reason in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("words", [["--length", "0"], ["--length", "x"], ["--steps", "0"], []])
def test_wrong_usage_is_told(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert traced(*([TRUSSES, *words] if words else [])) == 2
    assert "Usage: flexact trace" in capsys.readouterr().err


def test_the_deck_is_not_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = tmp_path / "deck.csv"
    deck.write_bytes(TRUSSES.read_bytes())
    assert traced(deck, "-o", deck) == 2
    assert "would overwrite the deck" in capsys.readouterr().err
    with pytest.raises(flexact.FlexactError, match="overwrite"):
        flexact.trace(deck, steps=2).save(deck)
    assert deck.read_bytes() == TRUSSES.read_bytes()


@pytest.mark.parametrize("suffix", ["csv", "png", "pvd"])
def test_what_cannot_be_traced_leaves_no_file(
    suffix: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / f"path.{suffix}"
    assert traced(DECKS / "frameworks" / "collinear_bars_plane.dat", "-o", target) == 1
    assert "the path cannot be begun" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_wrong_deck_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = tmp_path / "deck.dat"
    deck.write_text("TRUSS 1 1 2\nX 1 0 0 0\nX 2 0 0 0\nEND\n")
    assert traced(deck) == 1
    assert "error" in capsys.readouterr().err
