# SPDX-License-Identifier: BSD-3-Clause
"""What freedoms take: classes against tables and against a search for lines by numbers alone.

Tables: the twenty problems of tests/reference/design_problems.json; the principal screws of all
systems of two and three screws (Hunt, *Kinematic Geometry of Mechanisms*, 1978, chapter 12; Gibson
and Hunt, Mechanism and Machine Theory 25, 1990), of which 26 of 50 are those of parallel systems
(Hopkins and Culpepper, Precision Engineering 34, 2010). The search knows nothing of signatures: it
walks from random members of a space to forces along lines, and takes the rank of what it found.
"""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import numpy as np
import pytest

from flexact.advice.spaces.screws import ScrewSpace
from flexact.designs.possible import Possible, layers_of, possible

PROBLEMS = {
    each["id"]: each
    for each in json.loads(
        (Path(__file__).parents[1] / "reference" / "design_problems.json").read_text()
    )["problems"]
}
X, Y, Z = np.eye(3)
NOWHERE = np.zeros(3)


def turn(axis: np.ndarray, pitch: float = 0.0, point: np.ndarray = NOWHERE) -> np.ndarray:
    """A rotation about a line, or a screw, as (w, v) at the origin."""
    return np.concatenate((axis, np.cross(point, axis) + pitch * axis))


def move(axis: np.ndarray) -> np.ndarray:
    return np.concatenate((np.zeros(3), axis))


def space_of(rows: object, about: np.ndarray = NOWHERE, length: float = 1.0) -> ScrewSpace:
    """The space of some twists (w, v) at the origin."""
    made = np.array(rows, float).reshape(-1, 6)
    made = np.concatenate((made[:, :3], made[:, 3:] + np.cross(made[:, :3], about)), axis=1)
    factors = np.repeat((length, 1.0), 3)
    if not len(made):
        return ScrewSpace(made, about, length)
    return ScrewSpace(np.linalg.qr((made * factors).T)[0].T / factors, about, length)


def problem_rows(problem: dict) -> list[np.ndarray]:
    rows = []
    for each in problem["wanted"]:
        axis = np.array(each["direction"], float) / np.linalg.norm(each["direction"])
        point = np.array(each.get("point", NOWHERE), float)
        is_move = each["kind"] == "translation"
        rows.append(move(axis) if is_move else turn(axis, each.get("pitch", 0.0), point))
    return rows


def problem_space(problem: dict) -> ScrewSpace:
    return space_of(problem_rows(problem), np.array(problem["centre"], float), problem["size"])


# Tables ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", PROBLEMS)
def test_problems_with_known_answers(name: str) -> None:
    problem = PROBLEMS[name]
    found, expect = possible(problem_space(problem)), problem["expect"]
    assert found.dimension == expect["dimension"]
    assert found.parallel is expect["parallel_wires"]
    assert found.wires == expect["least_wires"]
    assert (found.sheet is not None) is expect["sheet"]
    assert (None if found.with_sheet is None else list(found.with_sheet)) == expect["with_sheet"]
    assert found.least_layers == expect["least_layers"]
    assert found.extra_dimension == expect["extra_freedom_of_wires_alone"]
    assert list(found.signature_freedom) == expect["signature_freedom"]
    assert list(found.signature_constraint) == expect["signature_constraint"]
    if "folded_sheets" in expect:
        assert found.wires == expect["folded_sheets"]


SLANT = np.array((0.6, 0.8, 0.0))
#: Twists of each kind: signature, couples, whether wires can, whether a sheet fits.
ONE = {
    "rotation": ([turn(X)], (0, 0, 1), 0, True, True),
    "translation": ([move(X)], (0, 0, 1), 1, True, True),
    "screw": ([turn(X, 0.3)], (1, 0, 0), 0, True, False),
}
TWO = {
    "two rotations that meet": ([turn(X), turn(Y)], (0, 0, 2), 0, True, True),
    "rotations in a plane, move across": ([turn(X), move(Z)], (0, 0, 2), 1, True, True),
    "two translations": ([move(X), move(Y)], (0, 0, 2), 2, False, False),
    "two skew rotations": ([turn(X), turn(Y, 0, 0.3 * Z)], (1, 1, 0), 0, True, False),
    "rotation and move along it": ([turn(X), move(X)], (1, 1, 0), 1, True, False),
    "rotation and oblique move": ([turn(X), move(SLANT)], (1, 1, 0), 1, True, False),
    "two screws of one sense": ([turn(X, 0.2), turn(Y, 0.5)], (2, 0, 0), 0, True, False),
    "two equal screws": ([turn(X, 0.2), turn(Y, 0.2)], (2, 0, 0), 0, True, False),
    "rotation and screw that meet": ([turn(X), turn(Y, 0.4)], (1, 0, 1), 0, True, False),
    "screw and move across": ([turn(X, 0.4), move(Y)], (1, 0, 1), 1, True, False),
}


def axes(*pitches: float) -> list[np.ndarray]:
    """Screws of these pitches along x, y, z through the origin."""
    return [turn(axis, pitch) for axis, pitch in zip(np.eye(3), pitches, strict=False)]


#: Signature, couples, how many freedoms wires alone leave besides, whether a sheet fits.
THREE = {
    "ball joint": (axes(0, 0, 0), (0, 0, 3), 0, 0, False),
    "two rotations, screw": (axes(0, 0, 0.3), (1, 0, 2), 0, 1, False),
    "rotation, two equal screws": (axes(0, 0.3, 0.3), (2, 0, 1), 0, 2, False),
    "rotation, screws of one sense": (axes(0, 0.2, 0.5), (2, 0, 1), 0, 2, False),
    "rotation, screws of both senses": (axes(0, 0.3, -0.2), (1, 1, 1), 0, 0, False),
    "three equal screws": (axes(0.3, 0.3, 0.3), (3, 0, 0), 0, 3, False),
    "two equal screws, third": (axes(0.3, 0.3, 0.5), (3, 0, 0), 0, 3, False),
    "three screws of one sense": (axes(0.2, 0.3, 0.5), (3, 0, 0), 0, 3, False),
    "three skew rotations, round": (axes(0.3, 0.3, -0.2), (2, 1, 0), 0, 0, False),
    "three skew rotations": (axes(0.2, 0.4, -0.3), (2, 1, 0), 0, 0, False),
    "tip, tilt, piston": ([*axes(0, 0), move(Z)], (0, 0, 3), 1, 0, True),
    "rotation, screw, move across": ([*axes(0, 0.3), move(Z)], (1, 0, 2), 1, 1, False),
    "two equal screws, move across": ([*axes(0.3, 0.3), move(Z)], (2, 0, 1), 1, 3, False),
    "screws of one sense, move across": ([*axes(0.2, 0.5), move(Z)], (2, 0, 1), 1, 3, False),
    "screws of both senses, move across": ([*axes(0.3, -0.2), move(Z)], (1, 1, 1), 1, 0, False),
    "rotation, move along it, rotation": ([turn(Z), turn(X), move(Z)], (1, 1, 1), 1, 0, False),
    "rotation, move along it, screw": ([turn(Z), turn(X, 0.4), move(Z)], (2, 1, 0), 1, 0, False),
    "x, y and rotation about z": ([turn(Z), move(X), move(Y)], (0, 0, 3), 2, 0, False),
    "x, y and screw along z": ([turn(Z, 0.3), move(X), move(Y)], (1, 0, 2), 2, 3, False),
    "x, y and rotation about x": ([turn(X), move(X), move(Y)], (1, 1, 1), 2, 1, False),
    "x, y and oblique rotation": (
        *([turn(np.array((0.6, 0.0, 0.8))), move(X), move(Y)], (1, 1, 1), 2, 1, False),
    ),
    "x, y and z": ([move(X), move(Y), move(Z)], (0, 0, 3), 3, 3, False),
}


def reciprocal(rows: list[np.ndarray]) -> np.ndarray:
    """The twists that do no work on the wrenches of which some twists have the numbers."""
    made = np.array(rows).reshape(-1, 6)
    return np.linalg.svd(np.roll(made, 3, axis=1))[2][len(made) :] if len(made) else np.eye(6)


@pytest.mark.parametrize("name", [*ONE, *TWO])
def test_freedoms_of_one_and_two_motions(name: str) -> None:
    rows, signature, couples, wires, sheet = {**ONE, **TWO}[name]
    found = possible(space_of(rows))
    assert found.signature_freedom == signature
    assert len(found.freedom.directions) == couples
    assert (found.parallel, found.sheet is not None) == (wires, sheet)
    assert found.extra_dimension == (0 if wires else 1)


@pytest.mark.parametrize("name", THREE)
def test_freedoms_of_three_motions(name: str) -> None:
    rows, signature, couples, extra, sheet = THREE[name]
    found = possible(space_of(rows))
    assert found.signature_freedom == signature
    # Of three dimensions freedom and constraint have as many translations as couples.
    assert len(found.freedom.directions) == len(found.constraint.directions) == couples
    assert found.extra_dimension == extra
    assert (found.sheet is not None) is sheet


NAMED = {
    "nothing": [],
    **{name: rows for name, (rows, *_) in {**ONE, **TWO, **THREE}.items()},
    **{
        f"left by: {name}": reciprocal(rows)
        for name, (rows, *_) in reversed(list({**ONE, **TWO}.items()))
    },
    "every motion": np.eye(6),
}
KINDS = list(NAMED.values())


def test_twenty_six_of_fifty_freedoms_are_those_of_parallel_wires() -> None:
    """1 + 3 + 9 + 9 + 3 + 1, as in the chart of Hopkins and Culpepper, and all held one none."""
    able: dict[int, int] = {}
    for rows in KINDS:
        found = possible(space_of(rows))
        able[found.dimension] = able.get(found.dimension, 0) + found.parallel
    assert len(KINDS) == 50
    assert able == {0: 1, 1: 3, 2: 9, 3: 9, 4: 3, 5: 1, 6: 1}


def table_row(name: str, found: Possible) -> str:
    """What docs/theory.md has of a freedom."""
    cells = (
        *(name, found.dimension, " ".join(map(str, found.signature_freedom))),
        *(len(found.freedom.directions), "no" if found.wires is None else found.wires),
        *(found.extra_dimension, "no" if found.sheet is None else "yes", found.least_layers),
    )
    return f"| {' | '.join(map(str, cells))} |"


def test_the_table_of_all_freedoms_is_that_of_the_theory() -> None:
    text = (Path(__file__).parents[2] / "docs" / "theory.md").read_text("utf-8")
    for name, rows in NAMED.items():
        assert table_row(name, possible(space_of(rows))) in text


# The search ------------------------------------------------------------------------------


def lines_in(rows: np.ndarray, draws: np.random.Generator, count: int = 40) -> np.ndarray:
    """(n, 6) lines in the span of orthonormal rows, (direction, moment), by Newton's steps.

    q is walked to zero from random members; where it does not get there, there is none near.
    """
    if not len(rows):
        return np.zeros((0, 6))
    form = rows[:, :3] @ rows[:, 3:].T
    form = form + form.T
    shares = draws.normal(size=(count, len(rows)))
    for _ in range(45):
        shares /= np.linalg.norm(shares, axis=1, keepdims=True)
        slope = shares @ form
        size = np.sum(slope * slope, axis=1)
        value = np.sum(slope * shares, axis=1) / 2.0
        step = np.where(size > 1e-26, value / np.where(size > 1e-26, size, 1.0), 0.0)
        shares = shares - step[:, None] * slope
    shares /= np.linalg.norm(shares, axis=1, keepdims=True)
    found = shares @ rows
    value = np.abs(np.sum(found[:, :3] * found[:, 3:], axis=1))
    return found[(value < 1e-13) & (np.linalg.norm(found[:, :3], axis=1) > 1e-3)]


def rank(rows: np.ndarray) -> int:
    return int(np.sum(np.linalg.svd(rows, compute_uv=False) > 1e-4)) if len(rows) else 0


def held_by(rows: np.ndarray) -> np.ndarray:
    """(6 - d, 6) orthonormal wrenches that do no work on orthonormal twists."""
    swapped = np.roll(rows, 3, axis=1)
    return np.linalg.svd(swapped)[2][len(rows) :] if len(rows) else np.eye(6)


def has_sheet(rows: np.ndarray) -> bool:
    """Whether all twists turn about lines of one plane and move across it.

    At its nearest point c n the velocity is along n, and the rotation across it.
    """
    count = len(rows)
    turns = rank(rows[:, :3])
    if count == 0 or (count == 1 and turns == 0):
        return True
    left, _, right = np.linalg.svd(rows[:, :3])
    free = left.T[turns:] @ rows
    if turns == 3 or len(free) > 1:
        return False
    if turns == 2:
        normal = right[2]
    elif len(free):
        normal = free[0, 3:] / np.linalg.norm(free[0, 3:])
    else:
        return bool(abs(rows[0, :3] @ rows[0, 3:]) < 1e-9)
    if np.abs(rows[:, :3] @ normal).max() > 1e-7:
        return False
    arms = np.cross(np.cross(rows[:, :3], normal), normal).ravel()
    speeds = np.cross(rows[:, 3:], normal).ravel()
    height = -(arms @ speeds) / (arms @ arms)
    return bool(np.abs(speeds + height * arms).max() < 1e-7)


def moved(rows: np.ndarray, turned: np.ndarray, shift: np.ndarray, scale: float) -> np.ndarray:
    """Twists (w, v) at the origin, turned, shifted and made larger."""
    turns, moves = rows[:, :3] @ turned.T, scale * rows[:, 3:] @ turned.T
    return np.concatenate((turns, moves + np.cross(shift, turns)), axis=1)


def rotation(draws: np.random.Generator) -> np.ndarray:
    made = np.linalg.qr(draws.normal(size=(3, 3)))[0]
    return made * np.linalg.det(made)


def random_freedom(kind: int, draws: np.random.Generator) -> np.ndarray:
    """A freedom of a kind: other pitches of the same signs, in a mirror or not, moved and mixed."""
    rows = np.array(KINDS[kind], float).reshape(-1, 6)
    # Pitches and distances all grow alike, or change sign in a mirror.
    rows = rows * np.repeat((1.0, draws.choice((-1.0, 1.0)) * draws.uniform(0.4, 2.0)), 3)
    rows = moved(rows, rotation(draws), draws.uniform(-0.7, 0.7, 3), 1.0)
    return draws.normal(size=(len(rows), len(rows))) @ rows


def test_a_thousand_random_freedoms_have_the_class_that_a_search_finds() -> None:
    draws = np.random.default_rng(33)
    for number in range(1000):
        kind = number % (len(KINDS) + 2)
        rows = (
            random_freedom(kind, draws)
            if kind < len(KINDS)
            # Of no kind in particular: random screws.
            else draws.normal(size=(int(draws.integers(1, 6)), 6))
        )
        space = space_of(rows)
        found = possible(space)
        wrenches = held_by(space.scaled)
        forces = lines_in(wrenches, draws)
        lines = rank(forces)
        assert found.extra_dimension == len(wrenches) - lines, (number, kind)
        assert found.parallel is (lines == len(wrenches))
        assert (found.sheet is not None) is has_sheet(space.scaled), (number, kind)
        # What they leave is the freedom and what is besides.
        both = np.concatenate((found.freedom.scaled, found.extra.scaled))
        assert rank(both) == len(both) == found.alone.dimension
        assert all(found.alone.has(twist, 1e-9) for twist in (*space.basis, *found.extra.basis))
        wires, couples, pitched = found.limbs
        free = np.linalg.svd(wrenches[:, :3])[0].T[rank(wrenches[:, :3]) :] @ wrenches
        spanned = rank(np.concatenate((forces, free)))
        assert (wires, couples, pitched) == (lines, spanned - lines, len(wrenches) - spanned)


def outcome(found: Possible) -> tuple[object, ...]:
    return (
        *(found.dimension, found.signature_freedom, found.parallel, found.extra_dimension),
        *(found.with_sheet, found.waisted, found.notch, found.rod, found.limbs),
        tuple(sorted(each.kind for each in found.freedom.families)),
        tuple(sorted(each.kind for each in found.constraint.families)),
    )


@pytest.mark.parametrize("scale", [1.0, 1e-3, 1e3])
def test_the_class_does_not_depend_on_place_and_size(scale: float) -> None:
    draws = np.random.default_rng(5)
    for kind, rows in enumerate(KINDS):
        given = np.array(rows, float).reshape(-1, 6)
        one = possible(space_of(given))
        shift = scale * draws.uniform(-1, 1, 3)
        other = moved(given, rotation(draws), shift, scale)
        about = shift + scale * draws.uniform(-0.5, 0.5, 3)
        again = possible(space_of(other, about, scale * draws.uniform(0.5, 2.0)))
        assert outcome(one) == outcome(again), kind


# Near special ----------------------------------------------------------------------------


@pytest.mark.parametrize("name", [*ONE, *TWO, *THREE])
@pytest.mark.parametrize("off", [1e-12, 1e-10, 1e-8, 1e-7])
def test_what_is_a_little_off_a_special_freedom_is_taken_for_it(name: str, off: float) -> None:
    draws = np.random.default_rng(7)
    special = np.array({**ONE, **TWO, **THREE}[name][0])
    rows = special + off * draws.uniform(-1.0, 1.0, special.shape)
    found, exact = possible(space_of(rows)), possible(space_of(special))
    assert outcome(found)[:2] == outcome(exact)[:2]
    assert found.parallel is exact.parallel
    assert found.off < 20.0 * off
    assert found.freedom.sine_to(space_of(rows)) < 20.0 * off


@pytest.mark.parametrize(
    ("pitch", "signature", "is_off", "is_near"),
    [
        (1e-7, (0, 0, 1), True, False),
        (1e-5, (1, 0, 0), False, True),
        (1e-3, (1, 0, 0), False, False),
    ],
)
def test_a_screw_of_small_pitch_is_a_rotation_or_near_one(
    pitch: float, signature: tuple[int, int, int], is_off: bool, is_near: bool
) -> None:
    found = possible(space_of([turn(Z, pitch * 0.05, 0.01 * X)], length=0.05))
    assert found.signature_freedom == signature
    assert (found.off > 0.0) is is_off
    assert found.off == pytest.approx(pitch * is_off, rel=0.1)
    assert (found.nearly is not None) is is_near


# Flexures --------------------------------------------------------------------------------


def pencils_at(
    rows: np.ndarray, points: np.ndarray, draws: np.random.Generator
) -> list[np.ndarray]:
    """(2, 6) each: of each point, forces through it in a plane that stop nothing of some twists.

    A direction u at p stops nothing where it is across v + w x p of all twists.
    """
    made = []
    for point in points:
        velocities = rows[:, 3:] + np.cross(rows[:, :3], point)
        _, sizes, right = np.linalg.svd(np.concatenate((velocities, np.zeros((3, 3)))))
        able = right[int(np.sum(sizes > 1e-5)) :]
        if len(able) >= 2:
            mixed = np.linalg.qr(draws.normal(size=(len(able), 2)))[0].T @ able
            made.append(np.concatenate((mixed, np.cross(point, mixed)), axis=1))
    return made


def meeting_points(lines: np.ndarray) -> list[np.ndarray]:
    """Where pairs of lines (direction, moment) meet."""
    made = []
    for one, other in itertools.combinations(lines, 2):
        # A point p of both has p x a = b for each.
        form = np.concatenate([np.cross(np.eye(3), line[:3]).T for line in (one, other)])
        moments = np.concatenate((one[3:], other[3:]))
        point, _, count, _ = np.linalg.lstsq(form, moments, rcond=1e-6)
        if count == 3 and np.abs(form @ point - moments).max() < 1e-7:
            made.append(point)
    return made


@pytest.mark.parametrize("kind", range(len(KINDS)))
def test_as_many_waisted_sheets_as_a_search_finds(kind: int) -> None:
    """Pencils of forces at points of axes, where axes meet, and anywhere."""
    draws = np.random.default_rng(kind)
    rows = space_of(random_freedom(kind, draws)).scaled
    found = possible(space_of(rows))
    if not found.parallel:
        assert found.waisted is None
        return
    lines = lines_in(rows, draws, 10)
    feet = np.cross(lines[:, :3], lines[:, 3:]) / np.sum(lines[:, :3] ** 2, axis=1)[:, None]
    along = draws.normal(size=(len(lines), 1)) * lines[:, :3]
    places = [*(feet + along), *draws.normal(size=(10, 3)), *meeting_points(lines)]
    pencils = pencils_at(rows, np.array(places), draws)
    most = 0
    for _ in range(60):
        spanned, count = np.zeros((0, 6)), 0
        for number in draws.permutation(len(pencils))[:12]:
            more = np.concatenate((spanned, pencils[number]))
            if rank(more) == len(more):
                spanned, count = more, count + 1
        most = max(most, count)
    assert (found.waisted or (0, found.needed)) == (most, found.needed - 2 * most)


def test_flexures_of_a_hinge_a_guide_and_a_plate() -> None:
    hinge, guide = (possible(space_of(rows)) for rows in ([turn(X)], [move(Z)]))
    assert (hinge.notch, hinge.rod) == ((1, 0), (1, 1))
    assert (guide.notch, guide.rod) == (None, (1, 1))
    assert possible(space_of([turn(X), move(Z)])).rod == (1, 0)
    assert possible(space_of([turn(X), turn(Y)])).rod is None
    assert possible(space_of([move(X), move(Y)])).bellows == (3, 1)
    assert possible(space_of([move(X), move(Y), move(Z)])).bellows == (0, 3)
    assert possible(space_of(axes(0, 0.2, 0.3))).bellows is None


# Layers ----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", range(1, len(KINDS)))
def test_layers_add_up_and_wires_hold_each(kind: int) -> None:
    """Theorem 3: one or two layers, but of three translations three; each sum is direct."""
    draws = np.random.default_rng(kind)
    space = space_of(random_freedom(kind, draws))
    found = possible(space)
    for layers in itertools.islice(layers_of(space), 6):
        rows = np.concatenate([each.scaled for each in layers])
        assert rank(rows) == len(rows) == space.dimension
        assert all(space.has(twist, 1e-9) for each in layers for twist in each.basis)
        assert len(layers) in (found.least_layers, found.least_layers + 1)
        for each in layers:
            wrenches = held_by(each.scaled)
            assert rank(lines_in(wrenches, draws)) == len(wrenches)
    first = next(layers_of(space))
    is_xyz = space.dimension == 3 and not np.any(np.abs(space.basis[:, :3]) > 1e-9)
    assert len(first) == found.least_layers == (1 if found.parallel else 3 if is_xyz else 2)


def test_layers_as_they_are_typed_come_first() -> None:
    typed = [move(X), move(Y)]
    lower, upper = next(layers_of(space_of(typed), typed))
    assert lower.has(move(X), 1e-12)
    assert upper.has(move(Y), 1e-12)
    typed = [move(X), move(Y), move(Z), turn(Z)]
    lower, upper = next(layers_of(space_of(typed), typed))
    assert lower.dimension == 1
    assert lower.has(move(Z), 1e-12)
    assert upper.has(turn(Z), 1e-12)


def test_no_layers_are_told_twice() -> None:
    typed = problem_rows(PROBLEMS["schoenflies"])
    told = [
        tuple(np.round(each.scaled.T @ each.scaled, 6).tobytes() for each in layers)
        for layers in layers_of(space_of(typed), typed)
    ]
    assert len(told) == len(set(told)) > 10
