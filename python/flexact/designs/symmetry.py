# SPDX-License-Identifier: BSD-3-Clause
"""Which symmetries an exactly constrained set of wires can have (theorem 4 of docs/theory.md).

A set is made of orbits, the images of one line each, and is exactly constrained only where each of
them is independent in itself. Three or more images by turns about one axis have rank three at
most, so that three are independent at best; shorter orbits are those of lines on the axis, across
it, or in the mirror. What adds up is tried with lines of W at random, and its rank taken.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..advice.spaces.screws import ScrewSpace
from ..analysis.places import axis_words
from ..core.arrays import FloatArray, floats
from ..util.records import Frozen
from ..util.rotations import matrix_of, unit
from ..util.text import number_in_words
from .possible import Possible, orthonormal, possible, q_of

#: How many sets of lines are drawn of each kind, and how often one draws for a line.
_SETS, _DRAWS = 16, 60
#: Of unit rows: what is a couple and no line, what is dependent, what is outside of a space.
_COUPLE, _DEPENDENT, _OUTSIDE = 1.0e-3, 1.0e-6, 1.0e-7


@dataclass(frozen=True, eq=False)
class Symmetric(Frozen):
    """Whether wires that leave a freedom can be their own image.

    A wire that runs across the axis of half a turn, or across a mirror, has a line that is its own
    image, but the wire itself, which ends on the body at one side, is not.

    Attributes:
        exact: Whether the lines of an exactly constrained set of wires can be.
        lines: The least number of wires whose lines can be, over-constrained or not; None where
            none can.
        wires: The least number of wires that can be themselves; None where none can.
        statement: In words.
    """

    exact: bool
    lines: int | None
    wires: int | None
    statement: str


@dataclass(frozen=True, eq=False)
class Orbit(Frozen):
    """Images of one line.

    Attributes:
        space: The line is one of these.
        size: How many they are.
        is_of_wires: Whether wires on them can be their own images.
    """

    space: ScrewSpace
    size: int
    is_of_wires: bool = True


def symmetry_possible(
    freedom: ScrewSpace, point: ArrayLike, direction: ArrayLike, order: int
) -> Symmetric:
    """Whether wires that leave a freedom can be their own image after a part of a turn.

    Args:
        freedom: As of `flexact.designs.possible.possible`.
        point: (3,) on the axis [m].
        direction: (3,) along it.
        order: 2 for half a turn, 3 for a third, and so on.
    """
    wanted, axis = possible(freedom), unit(floats(direction, "a direction"))
    held, arm = wanted.constraint, _arm(freedom, point)
    orbits = [Orbit(held, order), Orbit(_common(held, _lines(arm, axis[None])), 1)]
    if order % 2 == 0:
        across = np.linalg.svd(axis[None])[2][1:]
        couples = np.concatenate((np.zeros((2, 3)), across), axis=1)
        crossing = _common(held, np.concatenate((_lines(arm, across), couples)))
        orbits.append(Orbit(crossing, order // 2, is_of_wires=False))
    image = image_of(freedom, point, matrix_of(2.0 * np.pi / order * axis))
    return _symmetric(wanted, image, orbits, f"{order}-fold symmetry about {axis_words(axis)}")


def mirror_possible(freedom: ScrewSpace, point: ArrayLike, normal: ArrayLike) -> Symmetric:
    """Whether wires that leave a freedom can be their own image in a mirror.

    Args:
        freedom: As of `flexact.designs.possible.possible`.
        point: (3,) of the mirror [m].
        normal: (3,) across it.
    """
    wanted, axis = possible(freedom), unit(floats(normal, "a normal"))
    image = image_of(freedom, point, np.eye(3) - 2.0 * np.outer(axis, axis))
    # What is kept: forces in the mirror and couples across it; what is turned round: the others.
    within, across = (
        _common(wanted.constraint, orthonormal(each.T))
        for each in (np.eye(6) + image, np.eye(6) - image)
    )
    orbits = [Orbit(wanted.constraint, 2), Orbit(within, 1), Orbit(across, 1, is_of_wires=False)]
    return _symmetric(wanted, image, orbits, f"mirror across {axis_words(axis)}")


def image_of(space: ScrewSpace, point: ArrayLike, matrix: FloatArray) -> FloatArray:
    """(6, 6) what a rotation or a mirror through a point makes of scaled wrenches.

    Of twists too; in a mirror with the other sign.
    """
    shift = np.eye(6)
    shift[3:, :3] = -np.cross(np.eye(3), _arm(space, point)).T
    turn = np.kron(np.diag((1.0, round(float(np.linalg.det(matrix))))), matrix)
    return np.asarray(shift @ turn @ np.linalg.inv(shift))


def is_kept(space: ScrewSpace, image: FloatArray) -> bool:
    """Whether a space is its own image."""
    rows, moved = space.scaled, space.scaled @ image.T
    return bool(np.abs(moved - (moved @ rows.T) @ rows).max(initial=0.0) < _OUTSIDE)


def _arm(space: ScrewSpace, point: ArrayLike) -> FloatArray:
    return np.asarray((floats(point, "a point") - space.about) / space.length)


def _lines(arm: FloatArray, directions: FloatArray) -> FloatArray:
    return np.concatenate((directions, np.cross(arm, directions)), axis=1)


def _common(space: ScrewSpace, rows: FloatArray) -> ScrewSpace:
    """What a space has in common with that of some rows."""
    outside = space.scaled - space.scaled @ (other := orthonormal(rows)).T @ other
    left, sines, _ = np.linalg.svd(outside)
    within = np.concatenate((sines, np.zeros(space.dimension - len(sines)))) < _OUTSIDE
    return space.of_scaled(left.T[within] @ space.scaled)


def _symmetric(
    wanted: Possible, image: FloatArray, orbits: Sequence[Orbit], what: str
) -> Symmetric:
    count, many = wanted.needed, number_in_words(wanted.dimension)
    held = {0: "a body that is held in all six ways", 1: "one motion"}.get(wanted.dimension)
    held = held or f"these {many} motions"
    if not wanted.parallel:
        return Symmetric(False, None, None, f"Wires alone cannot leave just {held}.")
    if not is_kept(wanted.freedom, image):
        said = f"What is wanted has no {what} itself, so that no set of wires for it has."
        return Symmetric(False, None, None, said)
    lines, wires = (
        _least(wanted.constraint, image, some)
        for some in (orbits, [each for each in orbits if each.is_of_wires])
    )
    if lines is None:
        return Symmetric(False, None, None, f"No set of wires for {held} has a {what}.")
    said = f"An exactly constrained set of wires for {held} can have a {what}"
    if lines > count:
        said = (
            f"No exactly constrained set of wires for {held} has a {what}; over-constrained by "
            f"{number_in_words(lines - count)}: {number_in_words(lines)}"
        )
    if wires != lines:
        many = "no set of" if wires is None else number_in_words(wires)
        said += (
            ", of its lines: some wires run across, and are not their own images; of the wires "
            f"themselves {many} can"
        )
    return Symmetric(lines == count, lines, wires, f"{said}.")


def _least(held: ScrewSpace, image: FloatArray, orbits: Sequence[Orbit]) -> int | None:
    """The least number of lines, in whole orbits, that span what holds the body."""
    most = held.dimension + 2 * orbits[0].size
    return next(
        (
            total
            for total in range(held.dimension, most + 1)
            for numbers in _numbers(total, [orbit.size for orbit in orbits])
            if _spans(held, image, orbits, numbers)
        ),
        None,
    )


def _numbers(total: int, sizes: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """How many orbits of each size make a total, most of the first."""
    if len(sizes) == 1:
        if total % sizes[0] == 0:
            yield (total // sizes[0],)
        return
    for number in range(total // sizes[0], -1, -1):
        for others in _numbers(total - number * sizes[0], sizes[1:]):
            yield (number, *others)


def _spans(
    held: ScrewSpace, image: FloatArray, orbits: Sequence[Orbit], numbers: tuple[int, ...]
) -> bool:
    """Whether so many orbits can span what holds the body."""
    draws = np.random.default_rng(0)
    for _ in range(_SETS):
        rows = []
        for orbit, number in zip(orbits, numbers, strict=True):
            made = some_lines(orbit.space, number, draws)
            if len(made) < number:
                return False
            for _ in range(orbit.size):
                rows.append(made)
                made = made @ image.T
        every = unit(np.concatenate((held.scaled[:0], *rows)))
        if int(np.sum(np.linalg.svd(every, compute_uv=False) > _DEPENDENT)) == held.dimension:
            return True
    return False


def some_lines(space: ScrewSpace, count: int, draws: np.random.Generator) -> FloatArray:
    """(n, 6) lines of a space at random, scaled: as many as asked for, or fewer if it has none."""
    spans, made = space.spans, []
    for _ in range(_DRAWS * count if spans else 0):
        span = spans[int(draws.integers(len(spans)))]
        one, other = (share @ span for share in draws.normal(size=(2, len(span))))
        # Zeros of q on one + t other; in a flat family each of them is one.
        a, b, c = q_of(other, other), q_of(one, other), q_of(one, one)
        if max(abs(a), abs(b), abs(c)) > space.tolerance:
            if b * b < a * c or a == 0.0:
                continue
            one = one + (np.sqrt(b * b - a * c) - b) / a * other
        if np.linalg.norm(one[:3]) > _COUPLE * np.linalg.norm(one):
            made.append(one / np.linalg.norm(one))
        if len(made) == count:
            break
    return np.array(made).reshape(-1, 6)
