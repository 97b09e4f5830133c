# SPDX-License-Identifier: BSD-3-Clause
"""What came of each deck, and the exit codes of all verbs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum


class ExitCode(IntEnum):
    """What a command returns to the shell: as ruff has it, 1 is about decks, 2 about the run.

    Attributes:
        ANALYSED: All is well.
        DECK_ERROR: A deck has errors, cannot be read, or has not what was asked of it.
        OTHER: Wrong usage, output that cannot be written, too little memory, and the like.
        DIFFERENT: The verdict is not the expected one, or an answer differs.
    """

    ANALYSED = 0
    DECK_ERROR = 1
    OTHER = 2
    DIFFERENT = 3


@dataclass(frozen=True)
class Outcome:
    """What came of one deck.

    Attributes:
        deck: Its name.
        code: The exit code that it asks for.
        result: A word or two, counted over the batch.
        remark: Why it wants attention; empty where the code says enough.
    """

    deck: str
    code: ExitCode
    result: str
    remark: str = ""


def exit_code(outcomes: Iterable[Outcome]) -> ExitCode:
    """The exit code of a batch: the gravest of its decks, in the order 2, 1, 3, 0."""
    codes = {outcome.code for outcome in outcomes}
    for code in (ExitCode.OTHER, ExitCode.DECK_ERROR, ExitCode.DIFFERENT):
        if code in codes:
            return code
    return ExitCode.ANALYSED
