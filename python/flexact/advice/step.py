# SPDX-License-Identifier: BSD-3-Clause
"""Numbered steps: changes that were tried before they are said, and the models that they make."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from enum import Enum
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from ..analysis.change import Change
from ..analysis.decomposition import Asked
from ..analysis.naming import Pieces, counts_in_words, plain, sentence_of
from ..analysis.result import Result, result_of
from ..analysis.verdict import Verdict
from ..deck.rendering import model_error
from ..util.records import Frozen, cached_property

if TYPE_CHECKING:
    from ..model.model import Model


class Purpose(str, Enum):
    """What a step is to do."""

    REPAIR = "declare what moves and release what is stopped twice"
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

    @property
    def outcome(self) -> str:
        """What the mechanism is then, such as "exactly constrained"."""
        return counts_in_words(self.under_constrained, self.over_constrained)


@dataclass(frozen=True, eq=False, repr=False)
class Step(Frozen):
    """One way to mend a mechanism, which was analysed before it is shown.

    Each kind of step says in `words` what is done.

    Attributes:
        analysis: The analysis of the mechanism as it is.
        purpose: What it is to do.
        change: What is done.
        condition: By how much it may amplify what is off: 1 is the best [1].
        after: What the analysis of the changed mechanism said.
        alternatives: Other changes that symmetry makes equal to this one.
        number: Its number, from 1, as the advice shows it; 0 of one that is not shown.
    """

    analysis: Result
    purpose: Purpose
    change: Change
    condition: float
    after: After
    alternatives: tuple[Change, ...] = ()
    number: int = 0

    def words(self) -> Pieces:
        """What is done, within a sentence."""
        raise NotImplementedError

    @cached_property
    def pieces(self) -> Pieces:
        """What is done, as a sentence."""
        return sentence_of(self.words())

    @property
    def outcome(self) -> str:
        """What the mechanism is then, such as "exactly constrained"."""
        return self.after.outcome

    @property
    def statement(self) -> str:
        """What is done, and what the mechanism is then, in sentences."""
        words = plain(self.pieces)
        # A mend says so itself.
        return words if self.purpose is Purpose.MEND else f"{words} Then it is {self.outcome}."

    def apply(self, choice: int = 1) -> Model:
        """The changed model; of a deck names and comments stay.

        Args:
            choice: 1 for the step itself, from 2 on for one of the `alternatives`.

        Raises:
            ModelError: there is no such choice.
        """
        return self.chosen(choice).apply(self.analysis.given)

    def chosen(self, choice: int = 1) -> Change:
        """What is done by one of its choices, as `apply` counts them; raises as that does."""
        choices = (self.change, *self.alternatives)
        if isinstance(choice, bool) or not isinstance(choice, int):
            raise TypeError(f"a choice is a whole number from 1, not {type(choice).__name__}")
        if not 1 <= choice <= len(choices):
            there = f"choices 1 to {len(choices)}" if len(choices) > 1 else "no other choice"
            raise model_error(
                "no-such-choice",
                f"there is no choice {choice} of step {self.number}: it has {there}",
            )
        return choices[choice - 1]

    def __repr__(self) -> str:
        """Number and words."""
        return f"<Step {self.number}: {self.statement}>"


def together(changes: Iterable[Change]) -> Change:
    """Several changes as one."""
    every = tuple(changes)
    parts = ([getattr(each, field.name) for each in every] for field in fields(Change))
    return Change(*(tuple(chain.from_iterable(part)) for part in parts))


def tried(result: Result, change: Change) -> After:
    """What an analysis of the mechanism says once it is changed so.

    Raises:
        KeyError: it has no such element, deformation, node or coordinate.
        FlexactError: the changed mechanism cannot be analysed.
    """
    return after(analysed(result, change))


def analysed(result: Result, change: Change) -> Result:
    """The analysis of the mechanism once it is changed so; raises as `tried`."""
    data = change.apply(result.given).data
    return result_of(data, Asked(result.asked.method, result.asked.tolerance))


def after(result: Result) -> After:
    """What an analysis says, in short."""
    return After(
        *(result.verdict, result.under_constrained, result.over_constrained),
        result.gap.smallest_nonzero,
    )
