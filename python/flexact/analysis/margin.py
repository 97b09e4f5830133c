# SPDX-License-Identifier: BSD-3-Clause
"""How far the mechanism is from another verdict, in lengths and angles: theory.md (29)."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from ..core.arrays import FloatArray
from .decomposition import Decomposition
from .limits import NO_CHANGE
from .rank_evidence import Evidence, Pair
from .verdict import Margin

_NO_MARGIN = Margin(None, None, None, None, None)


def margins(outcome: Decomposition, evidence: Evidence) -> tuple[Margin, ...]:
    """One for each zero, at most 8, then one for each of the smallest other singular values.

    To first order: a value that is not zero is brought to zero by `value / change`, a zero
    above what can be told from zero likewise. A motion without self-stress, or a self-stress
    without motion, belongs to no singular value and is not lifted.
    """
    zeros = (_of_zero(outcome, group) for group in evidence.zero_pairs)
    others = (margin_of(outcome, pair, pair.value) for pair in evidence.pairs)
    return (*zeros, *others)


def _of_zero(outcome: Decomposition, group: tuple[Pair, ...]) -> Margin:
    """Of a zero that something lifts: none, but where a tolerance says what counts as zero.

    What else tells a value from zero is rounding, and no length of a machine.
    """
    noise, tolerance = outcome.raw.noise, outcome.asked.tolerance or 0.0
    told = max(tolerance, noise)
    found = least(margin_of(outcome, pair, told) for pair in group)
    found = found._replace(singular_value=group[0].value)
    if tolerance > noise or (found.length is None and found.angle is None):
        return found
    return found._replace(
        length=None if found.length is None else 0.0,
        angle=None if found.angle is None else 0.0,
        exact_alignment=True,
    )


def margin_of(outcome: Decomposition, pair: Pair, distance: float) -> Margin:
    """The misalignments that change the value of a pair by `distance`, to first order."""
    moves = pair.by_move * outcome.characteristic_length > NO_CHANGE
    turns = pair.by_turn > NO_CHANGE
    length = distance / pair.by_move if moves else math.inf
    angle = distance / pair.by_turn if turns else math.inf
    return Margin(
        length=length if math.isfinite(length) else None,
        angle=angle if math.isfinite(angle) else None,
        node=pair.node if math.isfinite(length) else None,
        element=pair.element if math.isfinite(angle) else None,
        singular_value=pair.value,
    )


def least_misalignments(
    values: FloatArray, by_move: FloatArray, by_turn: FloatArray, characteristic_length: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The least of `margin_of` over the pairs of each of many variants.

    Args:
        values: (variants, pairs) singular values that are not zero; NaN where there is none.
        by_move: (variants, pairs) what each changes by the move of one node [1/m].
        by_turn: (variants, pairs) by the turn of one element [1/rad].
        characteristic_length: (variants,) [m].

    Returns:
        Lengths [m] and angles [rad], (variants,) each; infinite where none changes a value.
    """
    moves = by_move * characteristic_length[:, None] > NO_CHANGE
    turns = by_turn > NO_CHANGE
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        lengths = np.where(moves, values / by_move, np.inf)
        angles = np.where(turns, values / by_turn, np.inf)
    return lengths.min(axis=1, initial=np.inf), angles.min(axis=1, initial=np.inf)


def least(of: Iterable[Margin]) -> Margin:
    """The smallest length and the smallest angle, each with its place."""
    every = list(of)
    every = [item for item in every if item.exact_alignment] or every
    by_length = min(every, key=lambda item: _last(item.length), default=_NO_MARGIN)
    by_angle = min(every, key=lambda item: _last(item.angle), default=_NO_MARGIN)
    first = by_length if by_angle.angle is None else by_angle
    return Margin(
        by_length.length,
        by_angle.angle,
        by_length.node,
        by_angle.element,
        first.singular_value,
        first.exact_alignment,
    )


def _last(misalignment: float | None) -> float:
    return math.inf if misalignment is None else misalignment
