# SPDX-License-Identifier: BSD-3-Clause
"""Text of decks, made fit to be shown."""

from __future__ import annotations

import os

#: Bits of a number, and letters of what is given, beyond which a message leaves them out.
_LONG_NUMBER, _LONG_TEXT = 64, 60

#: A decimal of more digits cannot be told from a number that was computed.
MOST_TYPED = 15


def harmless(text: str, keep_tabs: bool = False) -> str:
    """The text with nothing in it that could move a cursor: one character for one."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(_harmless(c, keep_tabs) for c in text)


def _harmless(c: str, keep_tabs: bool) -> str:
    if c.isprintable() or (c == "\t" and keep_tabs):
        return c
    if c == "\t":
        return " "
    if ord(c) < 0x20:
        return chr(0x2400 + ord(c))
    return "\u2421" if c == "\x7f" else "\ufffd"


def file_name(name: str) -> str:
    """The last part of a path: where a deck lies is nobody's concern."""
    return os.path.basename(name.replace("\\", "/"))


def in_short(given: object) -> str:
    """A wrong argument as a message names it, on one line; there are numbers of any length."""
    if isinstance(given, int) and given.bit_length() > _LONG_NUMBER:
        return "a number of so many digits"
    try:
        text = harmless(" ".join(repr(given).split()))
    except (ValueError, RecursionError):
        # Python writes no number of thousands of digits, in a list either, nor lists in lists
        # without end.
        text = type(given).__name__
    return text if len(text) <= _LONG_TEXT else f"{text[: _LONG_TEXT - 3]}..."


def significant_digits(value: float) -> int:
    """How many digits the shortest decimal of a number has; none for zero."""
    mantissa = repr(abs(value)).split("e")[0].replace(".", "")
    return len(mantissa.strip("0"))
