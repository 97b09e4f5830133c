# SPDX-License-Identifier: BSD-3-Clause
"""Short decks that do as long ones do: delta debugging by lines, then by words, then by bytes.

A. Zeller, R. Hildebrandt, "Simplifying and isolating failure-inducing input", IEEE Transactions
on Software Engineering 28 (2002), 183-200.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

Fails = Callable[[bytes], bool]


def minimised(text: bytes, fails: Fails, most_tries: int = 2000) -> bytes:
    """A part of a failing text that fails as well, of which no piece can be left out.

    Args:
        text: A text that fails.
        fails: Whether a text does.
        most_tries: So often at most is it asked; what is short then is given.
    """
    left = most_tries

    def counted(pieces: Sequence[bytes]) -> bool:
        nonlocal left
        left -= 1
        return left >= 0 and fails(b"".join(pieces))

    for pattern in (rb"[^\n]*\n|[^\n]+", rb"\s+|\S+", rb"(?s)."):
        text = b"".join(_reduced(re.findall(pattern, text), counted))
    return text


def _reduced(pieces: Sequence[bytes], fails: Callable[[Sequence[bytes]], bool]) -> list[bytes]:
    """What is left of pieces when ever smaller groups of them are left out."""
    kept = list(pieces)
    size = len(kept)
    while size:
        first = 0
        while first < len(kept):
            without = kept[:first] + kept[first + size :]
            if fails(without):
                kept = without
            else:
                first += size
        size //= 2
    return kept
