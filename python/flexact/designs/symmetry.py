# SPDX-License-Identifier: BSD-3-Clause
"""Which symmetries a set of wires can have that is exactly constrained (theorem 4 of docs/theory.md).

A set is made of orbits, the images of one line. They are independent only where the images of each
are; a third of a turn leaves of three images just rank three, and a fifth of a turn never five.
What can be is found by looking: orbits of lines of W at random, of every number that adds up.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..advice.spaces.screws import ScrewSpace
from ..analysis.places import axis_words
from ..core.arrays import FloatArray, floats
from ..util.records import Frozen
from ..util.rotations import matrix_of
from ..util.text import number_in_words
from .possible import orthonormal, possible, q_of

#: How many sets of lines are drawn of each kind, and how many points of a cone for one line.
_SETS, _POINTS = 16, 60
#: Of unit rows: what is no line but a couple; what is dependent; what is outside a space.
_COUPLE, _DEPENDENT, _OUTSIDE = 1.0e-3, 1.0e-6, 1.0e-7
#: Names of n-fold symmetries' turns.
_TURNS = {
    2: "half a turn",
    3: "a third of a turn",
    4: "a quarter of a turn",
    6: "a sixth of a turn",
}


@dataclass(frozen=True, eq=False)
class Symmetric(Frozen):
    """Whether wires that leave a freedom can be their own image.

    Attributes:
        exact: Whether an exactly constrained set of them can: of their lines, not their ends.
        wires: The least number of wires that can, over-constrained ones too; None where none can.
        alone: How many of these are their own image, or share it with fewer than the order says:
            on the axis, across it, in the mirror.
        statement: The same in words.
    """

    exact: bool
    wires: int | None
    alone: int
    statement: str


class Lone(NamedTuple):
    """Lines whose orbit is shorter than that of others: within what space, and how long it is."""

    space: ScrewSpace
    size: int


def symmetry_possible(
    freedom: ScrewSpace, point: ArrayLike, direction: ArrayLike, order: int
) -> Symmetric:
    """Whether wires can leave a freedom and be their own image after a part of a turn.

    Args:
        freedom: As of `flexact.designs.possible.possible`.
        point: (3,) on the axis [m].
        direction: (3,) along it.
        order: 2 for half a turn, 3 for a third, and so on.
    """
    wanted = possible(freedom)
    axis = floats(direction, "a direction")
    axis = axis / np.linalg.norm(axis)
    image = image_of(freedom, point, matrix_of(2.0 * np.pi / order * axis))
    held = wanted.constraint
    arm = (floats(point, "a point") - freedom.about) / freedom.length
    lone = [Lone(_common(held, np.concatenate((axis, np.cross(arm, axis)))[None]), 1)]
    if order % 2 == 0:
        across = np.linalg.svd(axis[None])[2][1:]
        forces = np.concatenate((across, np.cross(arm, across)), axis=1)
        couples = np.concatenate((np.zeros((2, 3)), across), axis=1)
        lone.append(Lone(_common(held, np.concatenate((forces, couples))), order // 2))
    what = f"{order}-fold symmetry about {axis_words(axis)}"
    turn = _TURNS.get(order, f"1/{order} of a turn")
    return _symmetric(freedom, image, order, lone, (what, f"{turn} about {axis_words(axis)}"))


def mirror_possible(freedom: ScrewSpace, point: ArrayLike, normal: ArrayLike) -> Symmetric:
    """Whether wires can leave a freedom and be their own image in a mirror.

    Args:
        freedom: As of `flexact.designs.possible.possible`.
        point: (3,) of the mirror [m].
        normal: (3,) across it.
    """
    axis = floats(normal, "a normal")
    axis = axis / np.linalg.norm(axis)
    image = image_of(freedom, point, np.eye(3) - 2.0 * np.outer(axis, axis))
    values, vectors = np.eye(6) + image, np.eye(6) - image
    held = possible(freedom).constraint
    lone = [Lone(_common(held, orthonormal(each.T)), 1) for each in (values, vectors)]
    what = f"mirror across {axis_words(axis)}"
    return _symmetric(freedom, image, 2, lone, (what, f"the mirror across {axis_words(axis)}"))


def image_of(space: ScrewSpace, point: ArrayLike, matrix: FloatArray) -> FloatArray:
    """(6, 6) what a rotation or a mirror about a point makes of scaled wrenches, or twists.

    The sense of twists is the other one in a mirror.
    """
    arm = (floats(point, "a point") - space.about) / space.length
    shift = np.eye(6)
    shift[3:, :3] = np.cross(np.eye(3), arm).T @ -np.eye(3)
    turn = np.kron(np.diag((1.0, np.linalg.det(matrix))), matrix)
    return np.asarray(shift @ turn @ np.linalg.inv(shift))


def is_kept(space: ScrewSpace, image: FloatArray) -> bool:
    """Whether a space is its own image."""
    rows = space.scaled
    rest = rows @ image.T
    return bool(np.abs(rest - (rest @ rows.T) @ rows).max(initial=0.0) < _OUTSIDE)


def _common(space: ScrewSpace, rows: FloatArray) -> ScrewSpace:
    """What a space has in common with the one of some rows."""
    rows = orthonormal(rows)
    if not len(rows) or not space.dimension:
        return space.of_scaled(rows[:0])
    left, cosines, _ = np.linalg.svd(space.scaled @ rows.T)
    both = cosines > 1.0 - _OUTSIDE**2 * 1.0e4
    return space.of_scaled(left.T[: both.size][both] @ space.scaled)


def _symmetric(
    freedom: ScrewSpace, image: FloatArray, order: int, lone: list[Lone], words: tuple[str, str]
) -> Symmetric:
    wanted = possible(freedom)
    what, turned = words
    count, many = wanted.needed, f"the {number_in_words(wanted.dimension)} wanted motions"
    many = {0: "a body that is held", 1: "the wanted motion"}.get(wanted.dimension, many)
    if not wanted.parallel:
        said = f"Wires alone cannot leave {many} and nothing else, with or without a {what}."
        return Symmetric(False, None, 0, said)
    if not is_kept(wanted.freedom, image):
        said = f"No {what}: it takes {many} to another freedom."
        return Symmetric(False, None, 0, said)
    for total in range(count, count + 2 * order + 1):
        for generic, numbers in _numbers(total, order, lone):
            if _spans(wanted.constraint, image, order, lone, generic, numbers):
                return _found(count, total, sum(numbers), order, what, wanted.dimension, lone)
    said = f"No set of wires for {many} has a {what}."
    return Symmetric(False, None, 0, said)


def _found(
    count: int, total: int, alone: int, order: int, what: str, motions: int, lone: list[Lone]
) -> Symmetric:
    wires = f"{number_in_words(total)} wire{'s' * (total != 1)}"
    own = f", {number_in_words(alone)} of them on an orbit of fewer" if alone else ""
    if total == count:
        said = f"{wires[:1].upper()}{wires[1:]} can have a {what}{own}."
        return Symmetric(True, total, alone, said)
    held = {0: "a body that is held", 1: "one motion"}.get(motions, "")
    held = held or f"these {number_in_words(motions)} motions"
    said = (
        f"No exactly constrained set of wires for {held} has a {what}; "
        f"over-constrained by {number_in_words(total - count)}: {number_in_words(total)}."
    )
    return Symmetric(False, total, alone, said)


def _numbers(total: int, order: int, lone: list[Lone]) -> Iterator[tuple[int, tuple[int, ...]]]:
    """Orbits of the full length, and of each shorter one, that make a total; few short ones first."""
    for generic in range(total // order, -1, -1):
        rest = total - generic * order
        for first in range(rest // lone[0].size + 1):
            if len(lone) == 1:
                if first * lone[0].size == rest:
                    yield generic, (first,)
                continue
            second, over = divmod(rest - first * lone[0].size, lone[1].size)
            if not over:
                yield generic, (first, second)


def _spans(
    held: ScrewSpace,
    image: FloatArray,
    order: int,
    lone: list[Lone],
    generic: int,
    numbers: tuple[int, ...],
) -> bool:
    """Whether so many orbits of lines can span what holds the body."""
    draws = np.random.default_rng(0)
    for _ in range(_SETS):
        rows = [np.zeros((0, 6))]
        for space, size, number in (
            (held, order, generic),
            *((*each, number) for each, number in zip(lone, numbers, strict=True)),
        ):
            lines = some_lines(space, number, draws)
            if len(lines) < number:
                return False
            for line in lines:
                orbit = [line]
                for _ in range(size - 1):
                    orbit.append(image @ orbit[-1])
                rows.append(np.array(orbit))
        made = np.concatenate(rows)
        made = made / np.linalg.norm(made, axis=1, keepdims=True)
        if int(np.sum(np.linalg.svd(made, compute_uv=False) > _DEPENDENT)) == held.dimension:
            return True
    return False


def some_lines(space: ScrewSpace, count: int, draws: np.random.Generator) -> FloatArray:
    """(count, 6) lines of a space at random, scaled; fewer where it has none."""
    spans, made = space.spans, np.zeros((0, 6))
    for _ in range(_POINTS * count if spans else 0):
        if len(made) == count:
            break
        span = spans[int(draws.integers(len(spans)))]
        one, other = (share @ span for share in draws.normal(size=(2, len(span))))
        # Zeros of q on the line of all one + t other; a flat family is zeros all over.
        a, b, c = q_of(other, other), 2.0 * q_of(one, other), q_of(one, one)
        if max(abs(a), abs(b), abs(c)) > space.tolerance:
            if b * b < 4.0 * a * c or a == 0.0:
                continue
            one = one + (np.sqrt(b * b - 4.0 * a * c) - b) / (2.0 * a) * other
        one = one / np.linalg.norm(one)
        if np.linalg.norm(one[:3]) > _COUPLE:
            made = np.concatenate((made, one[None]))
    return made
