# SPDX-License-Identifier: BSD-3-Clause
"""Numbered steps: changes that were tried, in words, and as models that they make."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from itertools import chain

from ..analysis.change import Change
from ..analysis.naming import Pieces, counts_in_words, plain
from ..analysis.result import Result
from ..deck.rendering import model_error
from ..model.model import Model
from ..util.records import Frozen, cached_property
from .causes.words import mend_in_words
from .proposal import After, Proposal, Purpose
from .releases.words import declaration_in_words, release_in_words
from .spaces.words import wire_in_words
from .undeclaring import undeclaration_in_words
from .words import sentence

_WORDS: dict[Purpose, Callable[[Result, Proposal], Pieces]] = {
    Purpose.MEND: mend_in_words,
    Purpose.UNDECLARE: undeclaration_in_words,
    Purpose.RELEASE: release_in_words,
    Purpose.DECLARE: declaration_in_words,
    Purpose.HOLD: declaration_in_words,
    Purpose.ADD_WIRE: wire_in_words,
    Purpose.ADD_SHEET: wire_in_words,
}


def together(changes: Iterable[Change]) -> Change:
    """Several changes as one."""
    every = tuple(changes)
    parts = ([getattr(each, field.name) for each in every] for field in fields(Change))
    return Change(*(tuple(chain.from_iterable(part)) for part in parts))


@dataclass(frozen=True, repr=False)
class Step(Frozen):
    """One way to mend a mechanism, which was analysed before it is shown.

    Attributes:
        analysis: The analysis of the mechanism as it is.
        number: Its number, from 1, as the advice shows it.
        proposal: What is done, and what comes of it.
    """

    analysis: Result
    number: int
    proposal: Proposal

    @property
    def purpose(self) -> Purpose:
        """What it is to do."""
        return self.proposal.purpose

    @property
    def change(self) -> Change:
        """What is done."""
        return self.proposal.change

    @property
    def alternatives(self) -> tuple[Change, ...]:
        """Other changes that symmetry makes equal to this one."""
        return self.proposal.alternatives

    @property
    def condition(self) -> float:
        """By how much it may amplify what is off: 1 is the best [1]."""
        return self.proposal.condition

    @property
    def after(self) -> After:
        """What the analysis of the changed mechanism said."""
        return self.proposal.after

    @cached_property
    def pieces(self) -> Pieces:
        """What is done."""
        words = _WORDS[self.purpose](self.analysis, self.proposal)
        is_added = self.purpose in (Purpose.ADD_WIRE, Purpose.ADD_SHEET)
        return sentence(("add ", *words) if is_added else words)

    @property
    def outcome(self) -> str:
        """What the mechanism is then, such as "exactly constrained"."""
        return counts_in_words(self.after.under_constrained, self.after.over_constrained)

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
