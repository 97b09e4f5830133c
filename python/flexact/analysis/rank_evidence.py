# SPDX-License-Identifier: BSD-3-Clause
"""Whether zeros may be tiny singular values that the arithmetic cannot tell from zero.

What is left of a value that is not zero is u' D v of a self-stress u and a motion v: even
where it is far below the rounding of the decomposition it is as exact as the entries of D(c)
are, for errors of u and v enter it multiplied by each other. Below that a tiny value shows in
its vectors, as each element passes on a part of the motion of the last: the components of
both fade evenly through many powers of ten, where those of true zeros end: theory.md (23).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..core import calls
from ..core.arrays import Basis, FloatArray, IndexArray, IntArray
from ..core.elements import NodeKind, Role, length_table, role_table
from ..util.records import cached_property
from .decomposition import Decomposition
from .limits import LAST_POWER, LONGEST_STEP, ROUNDINGS, STORED
from .sparse_basis import Sparse, index_of

#: How many zeros are looked at, and each against how many vectors of the other side.
MOST_ZEROS = 8
MOST_OTHERS = 64
#: Pairs times nodes and elements: what may be spent (a good second for a large model).
MOST_WORK = 1_000_000


class Pair(NamedTuple):
    """What moves one singular value of the scaled D(c), or one entry of the block of zeros."""

    value: float
    lift_of_bits: float
    """What rounding in the last bits of the geometry can make of it."""
    lift_of_digits: float
    """What half a unit of the last digits typed can make of it."""
    lift_of_storing: float
    """What storing it, or printing it with ten digits or a few more, can make of it."""
    by_move: float
    """Its largest change where one node is moved [1/m]."""
    by_turn: float
    """Its largest change where one element is turned [1/rad]."""
    node: int | None
    """Number of that node; None where no node moves it."""
    element: int | None
    """Number of that element, likewise."""


def affordable_pairs(outcome: Decomposition) -> int:
    """How many pairs may be looked at; each takes as long as there are nodes and elements."""
    arrays = outcome.data.arrays
    return MOST_WORK // (arrays.node_number.size + arrays.element_number.size)


def _unscaled(basis: Basis, scale: FloatArray, most: int) -> FloatArray:
    """The first vectors of a null space of D(c), of unit norm in the scaled matrix."""
    vectors = np.stack([basis.vector(k) for k in range(min(most, basis.vectors))], axis=1)
    norms = np.linalg.norm(vectors / scale[:, None], axis=0)
    return np.asarray(vectors / norms)


def _named(
    outcome: Decomposition, value: FloatArray, effect: FloatArray, place: IntArray
) -> tuple[Pair, ...]:
    """Pairs with the numbers of nodes and elements in place of their indices."""
    arrays = outcome.data.arrays
    node, element = (
        [int(numbers[k]) if k >= 0 else None for k in row.tolist()]
        for numbers, row in zip((arrays.node_number, arrays.element_number), place, strict=True)
    )
    every = zip(value.tolist(), *effect.tolist(), node, element, strict=True)
    return tuple(map(Pair._make, every))


_EPSILON = float(np.finfo(np.float64).eps)
#: What the errors of both vectors, multiplied by each other, may leave: eps**2 over the smallest
#: singular value that is told from zero.
_LEAST = _EPSILON / 1024

#: Components are sorted into so many bins for a power of ten.
_BINS = 4

# What is looked at: so many vectors of each side, of so many numbers in all; so many terms of
# the entries of D(c) and the motions; and so many pairs with what rounding makes of them.
_MOST_VECTORS, _MOST_NUMBERS = 256, 4_000_000
_MOST_TERMS = 16_000_000
_MOST_PAIRS = 16


class _Vectors(NamedTuple):
    """Some vectors of a basis, of unit norm in the scaled matrix, at the places they reach."""

    support: IndexArray
    """(places,) ascending."""
    value: FloatArray
    """(places, vectors)."""

    def in_full(self, chosen: IndexArray, size: int) -> FloatArray:
        """(size, chosen) some of them with their zeros."""
        made = np.zeros((size, chosen.size))
        made[self.support] = self.value[:, chosen]
        return made


class Evidence:
    """What small changes and rounding may make of singular values; found when asked for."""

    def __init__(self, outcome: Decomposition) -> None:
        """Keep the outcome that it is about."""
        self._outcome = outcome

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        """What moves the smallest singular values that are not zero, ascending."""
        outcome, raw = self._outcome, self._outcome.raw
        most = min(raw.pair_value.size, max(1, affordable_pairs(outcome)))
        if not most:
            return ()
        each = np.arange(most, dtype=np.int32)
        found = calls.find_sensitivities(
            outcome.data.packed,
            raw.row_scale[:, None] * raw.pair_stress[:, :most],
            raw.column_scale[:, None] * raw.pair_motion[:, :most],
            np.stack((each, each)),
        )
        return _named(outcome, raw.pair_value[:most], *found)

    @cached_property
    def zero_pairs(self) -> tuple[tuple[Pair, ...], ...]:
        """For each zero, at most 8, its pairs with the vectors of the other side.

        A singular value is zero where there is a self-stress and a motion; those that are in
        excess belong to no singular value.
        """
        outcome, raw = self._outcome, self._outcome.raw
        stresses, motions = outcome.over_constrained, outcome.under_constrained
        most_pairs = affordable_pairs(outcome)
        zeros = min(stresses, motions, raw.stresses.vectors, raw.motions.vectors, MOST_ZEROS)
        zeros = min(zeros, max(1, math.isqrt(most_pairs)))
        if not zeros:
            return ()
        most = max(zeros, min(MOST_OTHERS, most_pairs // zeros))
        left = _unscaled(raw.stresses, raw.row_scale, zeros if stresses <= motions else most)
        right = _unscaled(raw.motions, raw.column_scale, most if stresses <= motions else zeros)
        pairs = np.indices((left.shape[1], right.shape[1]), np.int32).reshape(2, -1)
        found = calls.find_sensitivities(outcome.data.packed, left, right, pairs)
        values = np.zeros(pairs.shape[1])
        of_zero = pairs[0 if stresses <= motions else 1]
        given = raw.scaled_values[::-1][: min(stresses, motions)][::-1][:zeros]
        values[of_zero < given.size] = given[of_zero[of_zero < given.size]]
        named = _named(outcome, values, *found)
        return tuple(tuple(named[i] for i in np.flatnonzero(of_zero == k)) for k in range(zeros))


def largest_remainder(outcome: Decomposition) -> tuple[float, float] | None:
    """Of a self-stress and a motion what is left of u' D v, and what rounding explains of it.

    Of the pair that exceeds most what rounding makes of it, in the scaled matrix.
    Of the first vectors of each side, as far as that takes little time; None where there is
    no pair, or none exceeds what rounding the entries of D(c) makes.
    """
    raw = outcome.raw
    stresses = _first_of(raw.stresses, raw.row_scale, np.arange(raw.stresses.vectors))
    if stresses is None:
        return None
    matrix, rounding = _entries(outcome, stresses.support)
    reached = np.zeros(raw.column_scale.size, np.bool_)
    reached[matrix.column_of] = True
    # Plain np.unique would import numpy.ma, which takes as long as the outcome of a deck.
    touching = np.flatnonzero(np.bincount(raw.motions.of_entries()[reached[raw.motions.place]]))
    touching = touching[: max(1, _MOST_TERMS // max(1, matrix.value.size))]
    motions = _first_of(raw.motions, raw.column_scale, touching)
    if motions is None:
        return None
    left = np.abs(_products(matrix, stresses, motions))
    added = stresses._replace(value=np.abs(stresses.value))
    moved = motions._replace(value=np.abs(motions.value))
    made = ROUNDINGS * _EPSILON * _products(matrix._replace(value=rounding), added, moved)
    explained = np.maximum(made, _LEAST)
    ratio = (left / explained).ravel()
    most = max(1, min(_MOST_PAIRS, affordable_pairs(outcome)))
    worst = np.argsort(-ratio)[:most]
    worst = worst[ratio[worst] > 1.0]
    if not worst.size:
        return None
    u, v = np.divmod(worst, left.shape[1])
    # What the last bits of the geometry may make of these pairs.
    of_left, left_place = np.unique(u, return_inverse=True)
    of_right, right_place = np.unique(v, return_inverse=True)
    lifts = calls.find_sensitivities(
        outcome.data.packed,
        stresses.in_full(of_left, outcome.rows),
        motions.in_full(of_right, outcome.columns),
        np.stack((left_place, right_place)).astype(np.int32),
    )[0][0]
    found = explained[u, v] + STORED * lifts
    worst_of_all = int(np.argmax(left[u, v] / found))
    return float(left[u, v][worst_of_all]), float(found[worst_of_all])


def powers_faded(basis: Basis, scale: FloatArray) -> float:
    """Powers of ten from the largest component down to the end of small steps, of any vector.

    The core cuts off what is below 1e-11 of a vector's largest component where it may.
    """
    vectors = int(np.searchsorted(basis.start, _MOST_NUMBERS, "right")) - 1
    entries = int(basis.start[vectors])
    if not entries:
        return 0.0
    vector, place = basis.of_entries()[:entries], basis.place[:entries]
    scaled = np.abs(basis.value[:entries] / scale[place])
    largest = np.maximum.reduceat(scaled, basis.start[:vectors])
    part = scaled / largest[vector]
    there = part > 10.0**-LAST_POWER
    bins = int(LAST_POWER * _BINS) + 1
    depth = (-_BINS * np.log10(part[there])).astype(np.int64)
    filled = np.bincount(vector[there] * bins + depth, minlength=vectors * bins) > 0
    each = np.arange(bins)
    last = np.maximum.accumulate(np.where(filled.reshape(vectors, bins), each, 0), axis=1)
    torn = np.maximum.accumulate(each - last > LONGEST_STEP * _BINS, axis=1)
    return float(np.where(torn, 0, last).max()) / _BINS


def _first_of(basis: Basis, scale: FloatArray, chosen: IndexArray) -> _Vectors | None:
    """The first of some vectors, as many as are held in full."""
    chosen = chosen[:_MOST_VECTORS]
    if not chosen.size:
        return None
    sizes = np.diff(basis.start)[chosen]
    # Together they reach no more places than they have entries.
    numbers = np.minimum(np.cumsum(sizes), basis.size) * np.arange(1, chosen.size + 1)
    chosen = chosen[: max(1, int(np.searchsorted(numbers, _MOST_NUMBERS, "right")))]
    parts = [np.arange(basis.start[k], basis.start[k + 1]) for k in chosen]
    entry, vector = np.concatenate(parts), np.repeat(np.arange(chosen.size), sizes[: chosen.size])
    support, place = np.unique(basis.place[entry], return_inverse=True)
    value = np.zeros((support.size, chosen.size))
    value[place, vector] = basis.value[entry]
    return _Vectors(support, value / np.linalg.norm(value / scale[support, None], axis=0))


def _entries(outcome: Decomposition, rows: IndexArray) -> tuple[Sparse, FloatArray]:
    """Entries of some rows of D(c), and what each of them is rounded in proportion to.

    An elongation changes with the positions by the direction alone, each entry to its own last
    bit; the others come from products, of which a small entry may be no more than the rounding.
    """
    arrays, raw = outcome.data.arrays, outcome.raw
    element, deformation = raw.row_label[:, rows] - 1
    node, axis = raw.column_label - 1
    used = np.flatnonzero(np.bincount(element, minlength=arrays.element_number.size))
    # The Jacobian of these elements alone, of which there may be few among very many.
    packed = outcome.data.packed
    some = packed._replace(
        elements=np.asfortranarray(packed.elements[:, used]),
        vectors=np.asfortranarray(packed.vectors[:, used]),
    )
    whole = calls.assemble(some, arrays.node_value, np.zeros(used.size))
    here = np.searchsorted(used, element)
    row_of = index_of(6 * here + deformation, 6 * used.size)[whole.row_of]
    column_of = index_of(3 * node + axis, 3 * arrays.node_number.size)[whole.column_of]
    chosen = (row_of >= 0) & (column_of >= 0) & (whole.value != 0.0)
    matrix = Sparse(row_of, column_of, whole.value, rows.size).only(chosen)
    kind = arrays.element_kind[element]
    along = np.isin(role_table()[kind, deformation], (Role.ELONGATION, Role.OFFSET_X))
    elongation = along & (length_table()[kind] == 1)
    position = arrays.node_kind[node] <= NodeKind.POSITION
    direction = elongation[matrix.row_of] & position[matrix.column_of]
    scale = raw.column_scale[matrix.column_of]
    largest = np.zeros(rows.size)
    np.maximum.at(largest, matrix.row_of, np.abs(matrix.value) * scale)
    of_row = largest[matrix.row_of] / scale
    return matrix, np.where(direction, np.abs(matrix.value), of_row)


def _products(matrix: Sparse, stresses: _Vectors, motions: _Vectors) -> FloatArray:
    """(stresses, motions) u' D v; `matrix` has the rows that the self-stresses reach."""
    place = index_of(
        motions.support, int(matrix.column_of.max(initial=0)) + 1 + motions.support[-1]
    )
    used = matrix.only(place[matrix.column_of] >= 0)
    moved = motions.value[place[used.column_of]]
    images = np.stack(
        [np.bincount(used.row_of, used.value * part, used.rows) for part in moved.T], axis=1
    )
    return stresses.value.T @ images
