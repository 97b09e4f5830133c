# SPDX-License-Identifier: BSD-3-Clause
"""Pairs of a self-stress and a motion that share a singular value, and what moves that value.

A change dD of D(c) changes the singular value of a pair (u, v) by u' dD v, to first order;
where several are zero it is the block of all their pairs that counts: theory.md (20), (21).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..core import calls
from ..core.arrays import FloatArray, IntArray
from ..core.basis import Basis
from ..core.raw import RawSensitivities
from .decomposition import Outcome

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


def of_nonzeros(outcome: Outcome) -> tuple[Pair, ...]:
    """The smallest values that are not zero, ascending, as far as the core gives their vectors."""
    raw = outcome.raw
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
    return _named(outcome, raw.pair_value[:most], found)


def of_zeros(outcome: Outcome) -> tuple[tuple[Pair, ...], ...]:
    """For each zero, at most 8, its pairs with the vectors of the other side.

    A singular value is zero where there is a self-stress and a motion; those that are in
    excess belong to no singular value.
    """
    raw = outcome.raw
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
    named = _named(outcome, values, found)
    return tuple(tuple(named[i] for i in np.flatnonzero(of_zero == k)) for k in range(zeros))


def affordable_pairs(outcome: Outcome) -> int:
    """How many pairs may be looked at; each takes as long as there are nodes and elements."""
    arrays = outcome.data.arrays
    return MOST_WORK // (arrays.node_number.size + arrays.element_number.size)


def _unscaled(basis: Basis, scale: FloatArray, most: int) -> FloatArray:
    """The first vectors of a null space of D(c), of unit norm in the scaled matrix."""
    vectors = np.stack([basis.vector(k) for k in range(min(most, basis.vectors))], axis=1)
    norms = np.linalg.norm(vectors / scale[:, None], axis=0)
    made: FloatArray = vectors / norms
    return made


def _named(outcome: Outcome, value: FloatArray, found: RawSensitivities) -> tuple[Pair, ...]:
    """Pairs with the numbers of nodes and elements in place of their indices."""
    arrays = outcome.data.arrays
    return tuple(
        Pair(
            float(value[k]),
            float(found.lift_of_bits[k]),
            float(found.lift_of_digits[k]),
            float(found.lift_of_storing[k]),
            float(found.by_move[k]),
            float(found.by_turn[k]),
            _number(arrays.node_number, found.node[k]),
            _number(arrays.element_number, found.element[k]),
        )
        for k in range(value.size)
    )


def _number(numbers: IntArray, index: int) -> int | None:
    return int(numbers[index]) if index >= 0 else None
