# SPDX-License-Identifier: BSD-3-Clause
"""Whether relations are enough: other geometries that have them, and nothing else, are tried.

A random geometry is led to the nearest that has the relations by Newton's method with the least
change; joints, axes and all else are anywhere. The relations are enough where almost every such
geometry has a lower rank than the generic one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from ...analysis.mode_basis import without_sense
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.parts.parts import Part
from ...util.groups import values_in
from ...util.records import Frozen
from ...util.rotations import matrix_of, unit
from .cause import Relation, RelationKind
from .conditions import Condition, Figures, condition_of
from .gradients import rank_at
from .lines import SAME

#: Of more joints no symmetry is looked for.
_MOST_JOINTS = 36
#: How many times a rotation may bring all back in one turn.
_FOLDS = (2, 3, 4, 5, 6, 8)


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
    places = places - middle
    size, planar = float(np.abs(places).max()), result.given.planar
    axes = _candidates(places / size, planar)
    in_plane = [axis for axis in axes if abs(float(axis[2])) <= SAME]
    # Half-turns, then reflections, of fold 0, then other rotations; about the middle of the joints.
    for fold in (_FOLDS[0], 0, *_FOLDS[1:]):
        for axis in axes if fold or not planar else in_plane:
            matrix = matrix_of(2.0 * np.pi / fold * axis) if fold else _reflection(axis)
            image = _image(places @ matrix.T, places, size)
            if image is None or image == tuple(range(len(places))):
                continue
            moved = {frozenset(image[k] for k in bar) for bar in bars}
            if moved == bars and all(held[k] == held[image[k]] for k in range(len(image))):
                where = tuple(parts), tuple(nodes), without_sense(axis), middle
                kind: RelationKind = "rotation" if fold else "reflection"
                yield Relation(kind, "member", *where, fold=max(fold, 1))


def _candidates(places: FloatArray, planar: bool) -> list[FloatArray]:
    """Axes that a symmetry may have: global and principal ones, and those to and between joints."""
    found = list(np.eye(3)[::-1])[: 1 if planar else 3]
    found += list(np.linalg.svd(places, full_matrices=True)[2][::-1])
    found += list(places)
    for a, b in combinations(range(len(places)), 2):
        found += [places[a] + places[b], places[b] - places[a]]
    made: dict[tuple[float, ...], FloatArray] = {}
    for axis in found:
        length = float(np.linalg.norm(axis))
        if length > SAME:
            way = without_sense(axis / length)
            made.setdefault(tuple((np.round(way, 5) + 0.0).tolist()), way)
    return list(made.values())


def _reflection(normal: FloatArray) -> FloatArray:
    return np.asarray(np.eye(3) - 2.0 * np.outer(normal, normal))


def _image(moved: FloatArray, places: FloatArray, size: float) -> tuple[int, ...] | None:
    """Which place each moved one is at; None where one is at none."""
    apart = np.linalg.norm(moved[:, None] - places[None], axis=2)
    nearest = np.argmin(apart, axis=1)
    if apart[np.arange(len(places)), nearest].max() > SAME * size:
        return None
    image = tuple(nearest.tolist())
    return image if len(set(image)) == len(image) else None


def make_symmetric(result: Result, one: Relation, places: FloatArray) -> None:
    """Put the joints of a symmetry, in the model as analysed, to places (nodes, 3) that have it."""
    order, matrix = 2, _reflection(one.direction)
    if one.kind == "rotation":
        order, matrix = one.fold, matrix_of(2.0 * np.pi / one.fold * one.direction)
    own = np.searchsorted(result.condensed.nodes, one.nodes)
    now = result.given.arrays.node_value[:3, list(one.nodes)].T - one.point
    image = _image(now @ matrix.T, now, float(np.abs(now).max()))
    assert image is not None, "the joints have the symmetry"
    # Of each joint the mean of what the symmetry makes of the places of its images.
    there, joints = places[own] - one.point, np.arange(len(image))
    made = np.zeros_like(there)
    for k in range(order):
        made += there[joints] @ np.linalg.matrix_power(matrix, k) / order
        joints = np.array(image)[joints]
    places[own] = one.point + made


#: Geometries that are tried of what may be enough; ranks that are found in all, by rows of D(c).
_TRIALS, _MOST_WORK, _FEWEST, _MOST = 3, 100_000, 20, 400
#: Steps of Newton's method; what is off in the end, and steps of differences.
_STEPS, _LEFT, _STEP, _FARTHEST = 40, 1.0e-13, 1.0e-6, 0.3
#: How far what is free besides is moved: direction, point over the length.
_MOVED = 0.3
#: Lengths and vectors that Newton's method has made smaller than this part are nearly none.
_SHRUNK = 0.05
_SEED = 19_800_101


class Trials(Frozen):
    """Random geometries of a mechanism that have relations.

    Attributes:
        result: The result that has them.
        generic: The rank of almost every geometry.
    """

    def __init__(self, result: Result, generic: int) -> None:
        """Keep the result."""
        self.result, self.generic = result, generic
        #: The lines and planes of its parts, and its places and vectors.
        self.figures = Figures(result)
        self.geometry = self.figures.geometry
        # How many ranks may still be found.
        self.left = [int(np.clip(_MOST_WORK // max(result.rows, 1), _FEWEST, _MOST))]

    def are_enough(self, relations: Sequence[Relation], special: int = 1) -> bool:
        """Whether what has all of these relations has so many special self-stresses.

        False, too, where that cannot be tried, or too much was tried already.
        """
        tried = 0
        for trial in range(2 * _TRIALS):
            if tried == _TRIALS:
                break
            if self.left[0] <= 0:
                return False
            if made := self.having(relations, trial):
                self.left[0] -= 1
                rank = rank_at(self.geometry, *made)
                if rank is None or rank > self.generic - special:
                    return False
                tried += 1
        return tried == _TRIALS

    def having(
        self, relations: Sequence[Relation], trial: int
    ) -> tuple[FloatArray, FloatArray] | None:
        """Places and vectors of a random geometry that has relations; None where none is found."""
        rng = np.random.default_rng((_SEED, trial))
        places, vectors = self.geometry.random(2 * trial)
        places = np.where(self.geometry.free, places, self.geometry.places)
        conditions = []
        turned = rng.uniform(-_MOVED, _MOVED, 3)
        for one in relations:
            if one.kind == "position":
                self._keep(one.parts, places, vectors)
                continue
            if one.of == "member" and one.kind in _SYMMETRIES:
                make_symmetric(self.result, one, places)
                continue
            about = one.couple + turned * bool(one.couple.any())
            made = condition_of(self.figures, one, unit(about))
            if made is None:
                return None
            conditions.append(made)
        return self._led(conditions, places, vectors, rng) if conditions else (places, vectors)

    def _keep(self, parts: Sequence[Part], places: FloatArray, vectors: FloatArray) -> None:
        """Put some parts back to where they are."""
        own = self.result.condensed.elements
        mine = np.flatnonzero(np.isin(own, [index for part in parts for index in part.elements]))
        slots = self.result.data.arrays.element_node[[0, 2]][:, mine] - 1
        near = slots.ravel()
        nodes = self.geometry.owner[near[near >= 0]]
        places[nodes] = self.geometry.places[nodes]
        vectors[mine] = self.geometry.vectors[mine]

    def _led(
        self,
        conditions: Sequence[Condition],
        places: FloatArray,
        vectors: FloatArray,
        rng: np.random.Generator,
    ) -> tuple[FloatArray, FloatArray] | None:
        length, owner, free = self.figures.length, self.geometry.owner, self.geometry.free
        nodes = values_in(owner[[node for one in conditions for node in one.nodes]])
        node, axis = np.nonzero(free[nodes])
        node = nodes[node]
        elements = values_in([e for one in conditions for e in one.elements])
        elements = elements[np.any(self.geometry.vectors[elements], axis=1)]
        sizes = [one.free.size for one in conditions]
        ends = np.cumsum([0, *sizes])
        besides = np.concatenate([one.free for one in conditions])
        besides = besides + _MOVED * rng.uniform(-1.0, 1.0, besides.size)
        # Of directions and points those across the plane of a mechanism are not free.
        across: list[int] = []
        for one, first in zip(conditions, ends.tolist(), strict=False):
            if one.is_directed and self.result.given.planar:
                across += range(first + 2, first + one.free.size, 3)
        besides[across] = 0.0
        value = np.concatenate((places[node, axis] / length, vectors[elements].ravel(), besides))
        split = node.size, node.size + 3 * elements.size

        def put(value: FloatArray) -> tuple[FloatArray, FloatArray]:
            at, turned = (np.repeat(each[None], len(value), axis=0) for each in (places, vectors))
            at[:, node, axis] = length * value[:, : split[0]]
            turned[:, elements] = value[:, split[0] : split[1]].reshape(len(value), -1, 3)
            return at[:, owner], turned

        def residual(value: FloatArray) -> FloatArray:
            at, turned = put(value)
            rest = value[:, split[1] :]
            made = [
                one.residual(at, turned, rest[:, ends[k] : ends[k + 1]])
                for k, one in enumerate(conditions)
            ]
            return np.concatenate(made, axis=1)

        held = [split[1] + k for k in across]
        before, done = value, 0
        steps = _STEP * np.eye(value.size)
        for _ in range(_STEPS):
            off, *sides = residual(np.concatenate((value[None], value + steps, value - steps)))
            if not np.all(np.isfinite(off)):
                return None
            done = done + 1 if float(np.abs(off).max(initial=0.0)) <= _LEFT else 0
            if done == 2:
                break
            slope = np.subtract(*np.split(np.array(sides), 2)).T / (2.0 * _STEP)
            slope[:, held] = 0.0
            change = np.linalg.lstsq(slope, off, rcond=1.0e-9)[0]
            # Far from the end it leads anywhere.
            value = value - change / max(1.0, float(np.abs(change).max(initial=0.0)) / _FARTHEST)
        if not done:
            return None
        # Whether no member and no vector has become nearly none.
        p, q = self.result.data.arrays.element_node[[0, 2]] - 1
        there = (p >= 0) & (q >= 0)
        at, turned = put(np.stack((before, value)))
        lengths = np.linalg.norm(at[:, q] - at[:, p], axis=2)[:, there]
        sizes = np.linalg.norm(turned, axis=2)
        is_sound = np.all(lengths[1] >= _SHRUNK * lengths[0]) and np.all(
            sizes[1] >= _SHRUNK * sizes[0]
        )
        return (at[1], turned[1]) if is_sound else None


_SYMMETRIES = ("rotation", "reflection")
