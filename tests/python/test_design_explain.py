# SPDX-License-Identifier: BSD-3-Clause
"""What a freedom takes in words, as JSON and drawn; which symmetries wires for it can have."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from test_design_classes import (
    KINDS,
    NOWHERE,
    PROBLEMS,
    X,
    Y,
    Z,
    axes,
    move,
    problem_rows,
    problem_space,
    rotation,
    space_of,
    turn,
)

from flexact.designs.explain import Explanation, explained_json, nearby
from flexact.designs.explain_files import save
from flexact.designs.possible import possible
from flexact.designs.problem import Box
from flexact.designs.symmetry import mirror_possible, symmetry_possible
from flexact.util.errors import FlexactError
from flexact.util.units import MILLIMETRES

AXES = {"x": X, "y": Y, "z": Z}


def explanation(name: str) -> Explanation:
    problem = PROBLEMS[name]
    boxes = [np.array(each, float) for each in problem["stage"]["boxes"]]
    found = possible(problem_space(problem))
    typed = np.array(problem_rows(problem)).reshape(-1, 6)
    drawn = tuple(Box(low, high) for low, high in boxes)
    return Explanation(found, problem["title"], typed=typed, boxes=drawn)


def said(made: Explanation) -> str:
    return re.sub(r"\s+", " ", str(made))


# Words -----------------------------------------------------------------------------------


def test_a_hinge_in_words() -> None:
    words = said(explanation("hinge"))
    for part in (
        "Wanted of the stage: one independent motion: rotation about the line through (*, 0, 0) m",
        "It takes five constraints: forces along all lines that meet the line through (*, 0, 0) m",
        "Wires alone: five, on lines that meet the line",
        "A sheet in any plane that contains the line through (*, 0, 0) m along x, and two wires; "
        "or such a sheet and a waisted sheet.",
        "Two whole sheets: over-constrained by one.",
        "Two waisted sheets and a wire.",
        "A notch, or a cross hinge, with its axis on the line.",
    ):
        assert part in words


def test_x_and_y_alone_take_layers_or_a_couple() -> None:
    words = said(explanation("xy"))
    for part in (
        "Wires alone leave more: three wires along z, all that are independent, leave besides: "
        "rotation about the line through (0, 0, *) m along z",
        "Besides three wires it takes a couple, which no wire gives.",
        "Two layers, from the ground, each on wires: translation along x, on five wires; "
        "translation along y, on five wires",
        "More freedom is possible: x, y and rotation about z, with three wires along z.",
        "Less freedom is possible: translation along x, with five wires perpendicular to x.",
    ):
        assert part in words


def test_every_freedom_is_told_in_full_sentences() -> None:
    for rows in KINDS:
        words = said(Explanation(possible(space_of(rows)), wanted=("rotation x",)))
        assert words.startswith("Wanted of the stage: ")
        assert "nan" not in words
        assert "  " not in words
        assert "None" not in words


def test_lengths_are_told_in_the_unit_asked_for() -> None:
    found = possible(space_of([turn(Z, 0.01, 0.02 * X)], length=0.05))
    assert "(20, 0, *) mm along z, pitch 10 mm/rad" in said(Explanation(found, units=MILLIMETRES))


def test_what_is_taken_for_special_is_told() -> None:
    near = said(Explanation(possible(space_of([turn(Z, 1e-7)]))))
    assert "rotation about" in near
    assert "What was given is off this by 1e-07" in near
    doubtful = said(Explanation(possible(space_of([turn(Z, 1e-5)]))))
    assert "It is off a special freedom by no more than 1e-05" in doubtful
    assert "write it with more digits: rotation about" in doubtful


def test_freedoms_near_one_that_wires_cannot_leave_are_possible() -> None:
    for rows in KINDS:
        found = possible(space_of(rows))
        if found.parallel:
            continue
        near = nearby(found)
        for space, statement in near:
            assert possible(space).parallel
            assert "possible: " in statement
            larger = space.dimension > found.dimension
            inner, outer = (found.freedom, space) if larger else (space, found.freedom)
            assert all(outer.has(twist, 1e-9) for twist in inner.basis)
            assert statement.startswith("More" if larger else "Less")
        assert near


def test_json_has_the_keys_of_a_problem_s_answer() -> None:
    made = json.loads(json.dumps(explained_json(explanation("hinge").found), allow_nan=False))
    assert (made["parallel"], made["needed"], made["wanted"]["dimension"]) == (True, 5, 1)
    assert made["kinds"]["wires"] == 5
    assert made["kinds"]["sheet"] == [1, 2]
    assert made["kinds"]["layers"] == 1
    assert made["kinds"]["extra"] == 0
    (screw,) = made["wanted"]["principal_screws"]
    assert (screw["direction"], screw["pitch"]) == ([1.0, 0.0, 0.0], 0.0)
    made = json.loads(explanation("xy").to_json())
    assert [each["pitch"] for each in made["wanted"]["principal_screws"]] == [None, None]
    assert made["kinds"]["bellows"] == [3, 1]
    assert [each["dimension"] for each in made["nearby"]] == [3, 1, 1]


# Drawings --------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", ["png", "svg", "html"])
def test_freedom_and_constraint_are_drawn_without_a_mechanism(tmp_path: Path, suffix: str) -> None:
    pytest.importorskip("matplotlib")
    path = tmp_path / f"explain.{suffix}"
    save(explanation("planar"), path)
    content = path.read_bytes()
    if suffix == "png":
        assert content.startswith(b"\x89PNG")
        return
    text = content.decode()
    assert "Freedom of the stage" in text
    assert "Constraint of the stage" in text
    if suffix == "html":
        assert text.count('"freedom":true') == text.count('"freedom":false') == 1
        assert "Wires alone: three, along z." in text


def test_nothing_and_everything_are_drawn(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    for number, rows in enumerate(([], np.eye(6))):
        path = tmp_path / f"{number}.svg"
        save(Explanation(possible(space_of(rows))), path)
        assert "nothing" in path.read_text()


def test_a_file_of_no_kind_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FlexactError, match=r"is to be one of \.png"):
        save(explanation("hinge"), tmp_path / "explain.doc")


# Symmetries ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "which", "is_possible"),
    [
        (name, *item)
        for name, each in PROBLEMS.items()
        for item in each["expect"].get("symmetry", {}).items()
    ],
)
def test_symmetries_of_the_problems(name: str, which: str, is_possible: bool) -> None:
    order, axis = int(which.partition("-")[0]), AXES[which[-1]]
    assert (
        symmetry_possible(problem_space(PROBLEMS[name]), NOWHERE, axis, order).exact is is_possible
    )


def test_a_third_of_a_turn_allows_none_one_three_four_and_six_wires() -> None:
    """Three images of a line have rank three, and of the lines that are kept there is the axis."""
    able = set()
    for rows in KINDS:
        space = space_of(rows)
        for axis in np.eye(3):
            made = symmetry_possible(space, NOWHERE, axis, 3)
            if made.exact:
                able.add(6 - space.dimension)
    assert able == {0, 1, 3, 4, 6}


def test_symmetries_in_words() -> None:
    made = symmetry_possible(space_of([turn(X)]), NOWHERE, X, 3)
    assert (made.lines, made.wires) == (6, 6)
    assert made.statement == (
        "No exactly constrained set of wires for one motion has a 3-fold symmetry about x; "
        "over-constrained by one: six."
    )
    made = symmetry_possible(space_of([turn(X)]), NOWHERE, X, 2)
    assert (made.exact, made.lines) == (True, 5)
    assert "some wires run across, and are not their own images" in made.statement
    made = symmetry_possible(space_of([turn(X)]), NOWHERE, Z, 3)
    assert made.statement.startswith("What is wanted has no 3-fold symmetry about z itself")
    made = symmetry_possible(space_of([move(X), move(Y)]), NOWHERE, Z, 2)
    assert made.statement == "Wires alone cannot leave just these two motions."


def test_mirrors() -> None:
    """Three wires through a point: one in the mirror and two images; all along z: likewise."""
    for rows in (axes(0, 0, 0), [turn(Z), move(X), move(Y)]):
        made = mirror_possible(space_of(rows), NOWHERE, X)
        assert (made.exact, made.lines) == (True, 3)
    assert not mirror_possible(space_of([turn(X, 0.3)]), NOWHERE, X).exact


def test_symmetries_do_not_depend_on_place_and_direction() -> None:
    draws = np.random.default_rng(3)
    for rows, order in (([], 3), ([turn(Z)], 2), (axes(0, 0, 0), 3), ([turn(Z, 0.2)], 3)):
        given = np.array(rows, float).reshape(-1, 6)
        turned, shift = rotation(draws), draws.uniform(-1, 1, 3)
        turns, moves = given[:, :3] @ turned.T, given[:, 3:] @ turned.T
        other = np.concatenate((turns, moves + np.cross(shift, turns)), axis=1)
        one = symmetry_possible(space_of(given), NOWHERE, Z, order)
        about = draws.uniform(-1, 1, 3)
        again = symmetry_possible(space_of(other, about, 0.7), shift, turned @ Z, order)
        assert (one.exact, one.lines, one.wires) == (again.exact, again.lines, again.wires)
