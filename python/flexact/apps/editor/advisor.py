# SPDX-License-Identifier: BSD-3-Clause
"""Who advises: steps that mend a mechanism, as whoever starts the server has them found.

Advice stands above an editor's answers, which only offer it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from ...analysis.change import Change
from ...analysis.result import Result
from ...analysis.sentences import Pieces
from ...model.model import Model


class Step(Protocol):
    """One way to mend a mechanism, which was tried."""

    @property
    def number(self) -> int:
        """From 1."""

    @property
    def change(self) -> Change:
        """What is done."""

    @property
    def alternatives(self) -> tuple[Change, ...]:
        """Other changes that symmetry makes equal to this one."""

    @property
    def pieces(self) -> Pieces:
        """What is done, in words."""

    @property
    def outcome(self) -> str:
        """What the mechanism is then."""

    def apply(self, choice: int = 1) -> Model:
        """The changed model; choices from 2 on are the alternatives."""


class Advice(Protocol):
    """All steps that were found."""

    @property
    def analysis(self) -> Result:
        """The analysis of the mechanism as it is."""

    @property
    def steps(self) -> Sequence[Step]:
        """By their numbers."""


#: Gives the advice on a result.
Advisor = Callable[[Result], Advice]
