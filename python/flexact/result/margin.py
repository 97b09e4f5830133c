# SPDX-License-Identifier: BSD-3-Clause
"""How far the mechanism is from another verdict, in lengths and angles: theory.md (29)."""

from __future__ import annotations

import math
from collections.abc import Iterable

from .outcome import Outcome
from .rank_evidence import Evidence
from .sensitivity import Pair
from .verdict import Margin

#: A change by less than this part of the scale of the whole matrix is none: no geometry has it.
_NOTHING = 1.0e-9
_NO_MARGIN = Margin(None, None, None, None, None)


def margins(outcome: Outcome, evidence: Evidence) -> tuple[Margin, ...]:
    """One for each zero, at most 8, then one for each of the smallest other singular values.

    To first order: a value that is not zero is brought to zero by `value / change`, a zero
    above what can be told from zero likewise. A motion without self-stress, or a self-stress
    without motion, belongs to no singular value and is not lifted.
    """
    told = max(outcome.tolerance, outcome.raw.noise)
    zeros = (
        least(margin_of(outcome, pair, told) for pair in group)._replace(
            singular_value=group[0].value
        )
        for group in evidence.zero_pairs
    )
    others = (margin_of(outcome, pair, pair.value) for pair in evidence.pairs)
    return (*zeros, *others)


def margin_of(outcome: Outcome, pair: Pair, distance: float) -> Margin:
    """The misalignments that change the value of a pair by `distance`, to first order."""
    moves = pair.by_move * outcome.characteristic_length > _NOTHING
    turns = pair.by_turn > _NOTHING
    length = distance / pair.by_move if moves else math.inf
    angle = distance / pair.by_turn if turns else math.inf
    return Margin(
        length=length if math.isfinite(length) else None,
        angle=angle if math.isfinite(angle) else None,
        node=pair.node if math.isfinite(length) else None,
        element=pair.element if math.isfinite(angle) else None,
        singular_value=pair.value,
    )


def least(of: Iterable[Margin]) -> Margin:
    """The smallest length and the smallest angle, each with its place."""
    every = list(of)
    by_length = min(every, key=lambda item: _last(item.length), default=_NO_MARGIN)
    by_angle = min(every, key=lambda item: _last(item.angle), default=_NO_MARGIN)
    first = by_length if by_angle.angle is None else by_angle
    return Margin(
        by_length.length, by_angle.angle, by_length.node, by_angle.element, first.singular_value
    )


def _last(misalignment: float | None) -> float:
    return math.inf if misalignment is None else misalignment
