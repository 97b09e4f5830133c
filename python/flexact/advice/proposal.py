# SPDX-License-Identifier: BSD-3-Clause
"""Proposals: changes that were tried before they are said."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from ..analysis.change import Change
from ..analysis.decomposition import Asked
from ..analysis.result import Result, result_of
from ..analysis.verdict import Verdict
from ..util.records import Frozen


class Purpose(str, Enum):
    """What a proposal is to do."""

    UNDECLARE = "take back what is driven against a constraint"
    RELEASE = "release what is stopped twice"
    DECLARE = "declare what moves"
    HOLD = "hold what moves"
    MEND = "turn a constraint that repeats another so that it stops what is free"
    ADD_WIRE = "add a wire that stops what moves"
    ADD_SHEET = "add a sheet that stops what moves"


class After(NamedTuple):
    """What an analysis says of the changed mechanism."""

    verdict: Verdict
    under_constrained: int
    over_constrained: int
    smallest: float | None
    """The smallest singular value of the scaled D(c) that is not zero; None where all are."""


@dataclass(frozen=True)
class Proposal(Frozen):
    """A change that was tried.

    Attributes:
        purpose: What it is to do.
        change: What is done.
        condition: By how much it may amplify what is off: 1 is the best [1].
        after: What the analysis of the changed mechanism says.
        alternatives: Other changes that symmetry makes equal to this one.
    """

    purpose: Purpose
    change: Change
    condition: float
    after: After
    alternatives: tuple[Change, ...] = ()


def nothing(result: Result, purpose: Purpose) -> Proposal:
    """The empty set: what does it where there is nothing to be done."""
    return Proposal(purpose, Change(), 1.0, after(result))


def tried(result: Result, change: Change) -> After:
    """What an analysis of the mechanism says once it is changed so.

    Raises:
        KeyError: it has no such element, deformation, node or coordinate.
        FlexactError: the changed mechanism cannot be analysed.
    """
    return after(analysed(result, change))


def analysed(result: Result, change: Change) -> Result:
    """The analysis of the mechanism once it is changed so; raises as `tried`."""
    model = change.apply(result.given)
    made: Result = result_of(model.data, Asked(result.asked.method, result.asked.tolerance))
    return made


def after(result: Result) -> After:
    """What an analysis says, in short."""
    return After(
        *(result.verdict, result.under_constrained, result.over_constrained),
        result.gap.smallest_nonzero,
    )
