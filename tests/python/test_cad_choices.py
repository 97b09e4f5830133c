# SPDX-License-Identifier: BSD-3-Clause
"""What is said of the parts of a STEP file is kept, and survives a new export of the CAD."""

from __future__ import annotations

import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from flexact.apps.cli.main import main
from flexact.apps.convert.cad.assembly import Assembly, Body, Flexure, Kind, Piece, Solid
from flexact.apps.convert.cad.kept_choices import (
    Kept,
    Said,
    choices_beside,
    choices_for,
    read_choices,
    said_of,
    say,
)
from flexact.deck.rendering import DeckError
from flexact.model.reading import read_bytes
from flexact.util.errors import BatchError

if sys.version_info < (3, 11):
    pytest.importorskip("tomli")


def solid(name: str, volume: float, *path: str) -> Solid:
    return Solid(name, path, volume, np.zeros(3), (), "", 0.0, False)


def body(name: str, solids: tuple[int, ...], x: float, volume: float, ground: bool = False) -> Body:
    """A cube, so that its radii of gyration are those of its side."""
    moment = volume * volume ** (2 / 3) / 6
    inertia = np.array([moment, 0, 0, moment, 0, moment])
    return Body(name, solids, volume, volume, np.array([x, 0, 0]), inertia, ground, False, ())


def sheet(name: str, x: float, thickness: float = 0.5e-3) -> Flexure:
    p, q = np.array([x, 0, 0]), np.array([x, 0.04, 0])
    way = np.eye(3)
    sizes = 0.04, 0.03, thickness
    ends = ("base", "stage")
    none = np.zeros((0, 3))
    return Flexure(
        Kind.SHEET,
        name,
        2,
        p,
        q,
        np.stack((p, q)),
        way[2],
        way[0],
        *sizes,
        0.0,
        0.0,
        "",
        ends,
        none,
        "",
        True,
    )


def assembly(*flexures: Flexure, one_piece: bool = False) -> Assembly:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) * 0.01
    triangle = np.array([[0, 1, 2]])
    solids = (solid("base", 8e-6, "fixed"), solid("stage", 1e-6, "moving"))
    bodies = body("base", (0,), 0.0, 8e-6, ground=True), body("stage", (1,), 0.5, 1e-6)
    owners = [(0, "base"), (1, "stage")]
    if one_piece:
        solids = (solid("part", 9e-6),)
        bodies = tuple(replace(each, solids=(0,)) for each in bodies)
        owners = [(0, "base"), (0, "stage")]
    pieces = tuple(Piece(row, name, False, corners, triangle) for row, name in owners)
    return Assembly("x.step", solids, pieces, flexures, (), bodies, (), (), ())


def test_a_step_file_that_is_taken_for_a_deck_is_told_in_one_error() -> None:
    with pytest.raises(DeckError) as raised:
        read_bytes(b"ISO-10303-21;\nHEADER;\nENDSEC;\n", "guide.step")
    (problem,) = raised.value.diagnostics
    assert "STEP file" in problem.message
    assert "flexact convert" in problem.help


def test_choices_are_kept_and_read(tmp_path: Path) -> None:
    step = tmp_path / "guide.step"
    assert read_choices(step) == Kept()
    said = [
        Said("moving/stage", "ground", ("x", "rz"), (1.0, 2.5, -3.0), (1000.0, 4.0, 4.0, 4.0)),
        Said('a "name"\\ with = and #', "body"),
        Said("Führung\x7f", "flexure"),
    ]
    for each in said:
        say(step, each)
    assert set(read_choices(step).parts) == set(said)
    assert choices_beside(step).name == "guide.flexact.toml"


def test_lines_of_others_stay(tmp_path: Path) -> None:
    step = tmp_path / "guide.step"
    path = choices_beside(step)
    path.write_text(
        '# Of the second prototype.\nmaterial = "titanium"\n\n[parts]\n'
        'base = { is = "ground" } # bolted to the table\n# not yet\nstage = { is = "body" }\n'
    )
    say(step, Said("stage", declared=("y",)))
    say(step, Said("sheet 1", "body"))
    assert path.read_text() == (
        '# Of the second prototype.\nmaterial = "titanium"\n\n[parts]\n'
        'base = { is = "ground" } # bolted to the table\n# not yet\n'
        '"stage" = { declared = ["y"] }\n"sheet 1" = { is = "body" }\n'
    )
    say(step, Said("stage"))
    assert [each.name for each in read_choices(step).parts] == ["base", "sheet 1"]


def test_what_is_written_in_another_way_is_understood_and_changed(tmp_path: Path) -> None:
    step = tmp_path / "guide.step"
    path = choices_beside(step)
    path.write_text('material = "steel"\n[parts."the base"]\nis = "ground"\n')
    say(step, Said("the base", "body"))
    kept = read_choices(step)
    assert kept == Kept((Said("the base", "body"),), "steel")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[parts]\nbase = ground\n", "no TOML"),
        ('[parts]\nbase = { is = "grund" }\n', "'grund'"),
        ('[parts]\nbase = { as = "ground" }\n', "no 'as'"),
        ('[part]\nbase = { is = "ground" }\n', "did you mean parts"),
        ("[parts]\nbase = 3\n", "is to be a table"),
        ('[parts]\nbase = { declared = ["u"] }\n', "out of x, y, z, rx, ry, rz"),
        ("[parts]\nbase = { at = [1, 2] }\n", "three numbers"),
        ("[parts]\nbase = { at = [nan, 1, 2] }\n", "list of numbers"),
        ("material = 3\n", "is a name"),
        ("\xff", "UTF-8"),
    ],
)
def test_wrong_files_are_told_in_words(tmp_path: Path, text: str, words: str) -> None:
    step = tmp_path / "guide.step"
    choices_beside(step).write_bytes(text.encode("latin-1"))
    with pytest.raises(BatchError, match=r"guide\.flexact\.toml: ") as raised:
        read_choices(step)
    assert words in str(raised.value)
    with pytest.raises(BatchError):
        say(step, Said("base", "body"))
    assert choices_beside(step).read_bytes() == text.encode("latin-1")


def test_parts_are_known_by_their_names() -> None:
    now = assembly(sheet("sheet 1", 0.0), sheet("sheet 2", 0.1))
    kept = Kept(
        (Said("moving/stage", "ground"), Said("base", declared=("x",)), Said("sheet 2", "body")),
        "titanium",
    )
    choices, told = choices_for(kept, now)
    assert choices.ground == ("stage",)
    assert choices.declared == (("base", ("x",)),)
    assert choices.bodies == ((0.1, 0.02, 0.0),)
    assert choices.material == "titanium"
    assert told == ()


def test_parts_are_known_by_their_shapes() -> None:
    """After an export in which all have other names, and other numbers."""
    before = assembly(sheet("sheet 1", 0.0), sheet("sheet 2", 0.1, 0.3e-3))
    said = (
        replace(said_of(before, before.bodies[1], before), taken_as="ground"),
        replace(said_of(before, before.flexures[1], before), taken_as="body"),
    )
    now = assembly(sheet("sheet 1", 0.1, 0.3e-3), sheet("sheet 2", 0.0))
    solids = tuple(replace(each, name=f"Body{k}") for k, each in enumerate(now.solids))
    bodies = tuple(replace(each, name=f"Body{k}") for k, each in enumerate(now.bodies))
    pieces = tuple(replace(each, owner=f"Body{each.solid}") for each in now.pieces)
    choices, told = choices_for(
        Kept(said), replace(now, solids=solids, bodies=bodies, pieces=pieces)
    )
    assert choices.ground == ("Body1",)
    assert choices.bodies == ((0.1, 0.02, 0.0),)
    assert len(told) == 2
    assert "'moving/stage' is taken for 'moving/Body1'" in told[0]


def test_bodies_of_one_piece_are_known_by_their_place() -> None:
    before = assembly(one_piece=True)
    said = replace(said_of(before, before.bodies[1], before), taken_as="ground")
    choices, told = choices_for(Kept((said,)), before)
    # Just below the triangle, within the material.
    assert np.allclose(choices.ground, [[0.01 / 3, 0.01 / 3, -1e-5]], atol=1e-6)
    assert told == ()


def test_parts_that_are_gone_are_told() -> None:
    kept = Kept((Said("lever", "body", (), (0.0, 0.0, 0.0), (5.0, 1.0, 1.0, 1.0)),))
    choices, told = choices_for(kept, assembly())
    assert choices.bodies == ()
    (words,) = told
    assert words.startswith("'lever'") and "not there any more" in words


def test_convert_reads_what_is_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is said with the command takes the place of what is kept."""
    pytest.importorskip("OCP")
    sys.path.append(str(Path(__file__).resolve().parents[1]))
    from cad.designs import CASES

    path = tmp_path / "guide.step"
    CASES["guide"]().write(path)
    say(path, Said("stage", "ground"))
    say(path, Said("base", declared=("x",)))
    told = []
    for more in ([], ["--ground", "base"]):
        assert main(["convert", str(path), "-o", str(tmp_path / "guide.dat"), *more]) == 0
        told.append(capsys.readouterr().out)
    assert "what guide.flexact.toml says of parts is taken" in told[0]
    assert "ground is stage: as was said" in told[0]
    assert "Over-constrained by 1" in told[0]
    assert "ground is base: as was said" in told[1]
    assert "motions of base are declared, which stands still" in told[1]


def test_the_file_of_the_docs_says_what_it_means(tmp_path: Path) -> None:
    page = Path(__file__).resolve().parents[2] / "docs" / "watching.md"
    (text,) = re.findall(r"```toml\n(.*?)```", page.read_text("utf-8"), re.S)
    step = tmp_path / "guide.step"
    choices_beside(step).write_text(text)
    assert read_choices(step) == Kept(
        (
            Said("frame/outer", "ground"),
            Said("sheet 2", "body", (), (20.0, 40.0, 15.0), (40.0, 30.0, 0.5)),
            Said("stage", "", ("x", "rz")),
        ),
        "titanium",
    )
