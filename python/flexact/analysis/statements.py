# SPDX-License-Identifier: BSD-3-Clause
"""The statements of a deck without what means nothing: comments, blanks, spellings of numbers."""

from __future__ import annotations

import re
from difflib import SequenceMatcher
from typing import NamedTuple

from ..deck.source import decode
from ..util.plain_text import harmless

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([de][+-]?\d+)?$", re.IGNORECASE)


class Statement(NamedTuple):
    """A line of a deck that says something."""

    meant: str
    """What is compared."""
    written: str
    line: int


class Different(NamedTuple):
    """A statement that is on one side only."""

    added: bool
    written: str
    line: int


def statements_in(raw: bytes) -> tuple[Statement, ...]:
    """The statements of a deck."""
    made = []
    for number, line in enumerate(decode(raw).split("\n"), start=1):
        written = "" if line.startswith("*") else re.split("[%#]", line, maxsplit=1)[0]
        words = written.split()
        if words:
            meant = " ".join(map(_meant, words))
            made.append(Statement(meant, harmless(" ".join(words)), number))
    return tuple(made)


def differences(
    before: tuple[Statement, ...], after: tuple[Statement, ...]
) -> tuple[Different, ...]:
    """What went and what came, in the order of the decks."""
    one, other = ([each.meant for each in side] for side in (before, after))
    made: list[Different] = []
    matcher = SequenceMatcher(None, one, other, autojunk=False)
    for what, i, j, k, n in matcher.get_opcodes():
        if what != "equal":
            made += [Different(False, each.written, each.line) for each in before[i:j]]
            made += [Different(True, each.written, each.line) for each in after[k:n]]
    return tuple(made)


def _meant(word: str) -> str:
    if not _NUMBER.match(word):
        return word.upper()
    # Long numbers keep their digits: a float holds seventeen.
    value = float(re.sub("[dD]", "e", word))
    return repr(value + 0.0) if len(word) < 17 else word.upper()
