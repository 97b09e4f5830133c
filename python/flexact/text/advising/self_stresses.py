# SPDX-License-Identifier: BSD-3-Clause
"""What is stopped twice: a self-stress in a sentence, as a designer would put it."""

from __future__ import annotations

from ...result.modes import SelfStress
from ...result.result import Result
from ..motions import joined
from ..self_stresses import conflict_in_words, stress_in_parts
from ..sentences import Pieces
from .sentences import begun, ended

#: How many parts are told.
_MOST_PARTS = 4


def stress_in_sentence(result: Result, stress: SelfStress) -> Pieces:
    """Which parts fight over what; where that cannot be said in short, what they carry."""
    conflict = conflict_in_words(stress)
    if conflict:
        return ended(begun(conflict))
    parts = joined(stress_in_parts(stress, _MOST_PARTS))
    return ended(begun(parts))
