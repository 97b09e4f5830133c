# SPDX-License-Identifier: BSD-3-Clause
"""Symmetries of frameworks that are enough for a self-stress, as of rings (Tarnai 1980).

They are rotations and reflections that take the bars that carry onto each other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ...analysis.order import without_sense
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.parts.parts import Part
from .cause import LineKind, Relation, RelationKind

#: Of more joints no symmetry is looked for.
_MOST_JOINTS = 36
#: How many times a rotation may bring all back in one turn.
_FOLDS = (2, 3, 4, 5, 6, 8)
_SAME = 1.0e-6


class _Operation(NamedTuple):
    """A rotation or reflection about the middle of the joints."""

    matrix: FloatArray
    axis: FloatArray
    fold: int
    """0 of a reflection."""
    image: tuple[int, ...]
    """Which joint each one goes to."""


def symmetries_of(result: Result, parts: Sequence[Part]) -> Iterator[Relation]:
    """Symmetries of the bars that carry, the simplest first.

    Args:
        result: The result.
        parts: Bars that carry something in a self-stress.
    """
    nodes = sorted({p for part in parts for p in part.ends})
    if len(nodes) > _MOST_JOINTS:
        return
    index = {node: k for k, node in enumerate(nodes)}
    bars = {frozenset(index[p] for p in part.ends) for part in parts}
    places = result.given.arrays.node_value[:3, nodes].T
    middle = places.mean(axis=0)
    held = [result.parts.is_held(node) for node in nodes]
    for operation in _operations(places - middle, bars, held, result.given.planar):
        kind = RelationKind.ROTATION if operation.fold else RelationKind.REFLECTION
        axis, fold = without_sense(operation.axis), max(operation.fold, 1)
        of = LineKind.MEMBER
        yield Relation(kind, of, tuple(parts), tuple(nodes), axis, middle, fold=fold)


def _operations(
    places: FloatArray, bars: set[frozenset[int]], held: list[bool], planar: bool
) -> Iterator[_Operation]:
    """Half-turns, then reflections, then other rotations, that take bars onto bars."""
    size = float(np.abs(places).max())
    axes = _candidates(places / size, planar)
    folds = ((2,), (0,), _FOLDS[1:])
    for some in folds:
        for fold in some:
            for axis in axes if fold or not planar else _in_plane(axes):
                matrix = _rotation(axis, 2.0 * np.pi / fold) if fold else _reflection(axis)
                image = _image(places @ matrix.T, places, size)
                if image is None or image == tuple(range(len(places))):
                    continue
                moved = {frozenset(image[k] for k in bar) for bar in bars}
                if moved == bars and all(held[k] == held[image[k]] for k in range(len(image))):
                    yield _Operation(matrix, axis, fold, image)


def _candidates(places: FloatArray, planar: bool) -> list[FloatArray]:
    """Axes that a symmetry may have: global and principal ones, and those to and between joints."""
    found = list(np.eye(3)[::-1])
    if planar:
        found = found[:1]
    found += list(np.linalg.svd(places, full_matrices=True)[2][::-1])
    found += list(places)
    for a, b in combinations(range(len(places)), 2):
        found += [places[a] + places[b], places[b] - places[a]]
    made: list[FloatArray] = []
    seen: set[tuple[float, ...]] = set()
    for axis in found:
        length = float(np.linalg.norm(axis))
        if length <= _SAME:
            continue
        unit = without_sense(axis / length)
        key = tuple((np.round(unit, 5) + 0.0).tolist())
        if key not in seen:
            seen.add(key)
            made.append(unit)
    return made


def _in_plane(axes: list[FloatArray]) -> list[FloatArray]:
    return [axis for axis in axes if abs(float(axis[2])) <= _SAME]


def _rotation(axis: FloatArray, angle: float) -> FloatArray:
    cross = np.cross(np.eye(3), axis)
    made: FloatArray = np.eye(3) - np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return made


def _reflection(normal: FloatArray) -> FloatArray:
    made: FloatArray = np.eye(3) - 2.0 * np.outer(normal, normal)
    return made


def _image(moved: FloatArray, places: FloatArray, size: float) -> tuple[int, ...] | None:
    """Which place each moved one is at; None where one is at none."""
    apart = np.linalg.norm(moved[:, None] - places[None], axis=2)
    nearest = np.argmin(apart, axis=1)
    if apart[np.arange(len(places)), nearest].max() > _SAME * size:
        return None
    image = tuple(nearest.tolist())
    return image if len(set(image)) == len(image) else None


def make_symmetric(result: Result, one: Relation, places: FloatArray) -> None:
    """Put the joints of a symmetry, in the model as analysed, to places (nodes, 3) that have it."""
    is_turn = one.kind is RelationKind.ROTATION
    matrix = _rotation(one.direction, 2.0 * np.pi / one.fold)
    matrix = matrix if is_turn else _reflection(one.direction)
    own = np.searchsorted(result.condensed.nodes, one.nodes)
    now = result.given.arrays.node_value[:3, list(one.nodes)].T - one.point
    image = _image(now @ matrix.T, now, float(np.abs(now).max()))
    assert image is not None, "the joints have the symmetry"
    done: set[int] = set()
    for first in range(len(image)):
        if first in done:
            continue
        orbit = [first]
        while image[orbit[-1]] != first:
            orbit.append(image[orbit[-1]])
        done.update(orbit)
        turn = np.linalg.matrix_power(matrix, len(orbit))
        point = places[own[first]] - one.point
        order = (one.fold if is_turn else 2) // len(orbit)
        images = [np.linalg.matrix_power(turn, k) @ point for k in range(max(order, 1))]
        point = np.mean(images, axis=0)
        for node in orbit:
            places[own[node]] = one.point + point
            point = matrix @ point
