# SPDX-License-Identifier: BSD-3-Clause
"""What is stopped twice: a self-stress in a sentence, as a designer would put it."""

from __future__ import annotations

from ..analysis.mode_words import conflict_in_words, pressing_in_words, stress_in_parts
from ..analysis.modes import SelfStress
from ..analysis.motions import joined
from ..analysis.naming import in_words
from ..analysis.result import Result
from ..analysis.sentences import Pieces
from .sentences import begun, ended, sentence

#: How many deformations of a large model are told.
_MOST_TOLD = 4
#: How many names stand in a row; they may hold commas.
_MOST_NAMES = 8


def stress_in_sentence(result: Result, stress: SelfStress) -> Pieces:
    """Which parts fight over what; where that cannot be said in short, what they carry."""
    conflict = conflict_in_words(stress)
    if conflict:
        names = pressing_in_words(stress)
        return ended((*begun(conflict), *((f": {_row(names)}",) if names else ())))
    if not result.is_told_by_parts:
        told = stress_in_parts(stress, _MOST_TOLD)[:_MOST_TOLD]
        return ended(("Most stressed are ", *joined(told)))
    parts = stress_in_parts(stress, len(stress.parts))
    if len(parts) == 1:
        return sentence(("stressed in itself is ", *parts[0]))
    many = in_words(len(parts)).capitalize()
    return ended((f"{many} parts are stressed against each other: ", *joined(parts)))


def _row(names: tuple[str, ...]) -> str:
    rest = len(names) - _MOST_NAMES
    return "; ".join(names[:_MOST_NAMES]) + (f"; {rest} more" if rest > 0 else "")
