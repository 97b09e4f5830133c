# SPDX-License-Identifier: BSD-3-Clause
"""Text of decks, made fit to be shown."""

from __future__ import annotations

import os

#: Bits of a number, and letters of what is given, beyond which a message leaves them out.
_LONG_NUMBER, _LONG_TEXT = 64, 60

#: What our own words and tables hold beyond ASCII, and what people write for it.
_STAND_INS = {
    **{"\N{RIGHTWARDS ARROW}": "->", "\N{LEFTWARDS ARROW}": "<-", "\N{LEFT RIGHT ARROW}": "<->"},
    **{"\N{HORIZONTAL ELLIPSIS}": "...", "\N{NO-BREAK SPACE}": " ", "\N{MINUS SIGN}": "-"},
    **{"\N{EN DASH}": "-", "\N{EM DASH}": "-", "\N{MIDDLE DOT}": ".", "\N{CHECK MARK}": "ok"},
    **{"\N{MICRO SIGN}": "u", "\N{GREEK SMALL LETTER MU}": "u", "\N{DEGREE SIGN}": " deg"},
    **{"\N{PLUS-MINUS SIGN}": "+-", "\N{MULTIPLICATION SIGN}": "x", "\N{ALMOST EQUAL TO}": "~"},
    **{"\N{SUPERSCRIPT TWO}": "^2", "\N{SUPERSCRIPT THREE}": "^3", "\N{SUPERSCRIPT FOUR}": "^4"},
    **{"\N{LESS-THAN OR EQUAL TO}": "<=", "\N{GREATER-THAN OR EQUAL TO}": ">="},
    **{"\N{LEFT DOUBLE QUOTATION MARK}": '"', "\N{RIGHT DOUBLE QUOTATION MARK}": '"'},
    **{"\N{LEFT SINGLE QUOTATION MARK}": "'", "\N{RIGHT SINGLE QUOTATION MARK}": "'"},
    **{"\N{BOX DRAWINGS LIGHT HORIZONTAL}": "-", "\N{BOX DRAWINGS LIGHT VERTICAL}": "|"},
}

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


def spelled(error: UnicodeError) -> tuple[str, int]:
    """Stand-ins for characters that an encoding lacks, as an error handler of codecs."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    given = error.object[error.start : error.end]
    made = (
        _STAND_INS.get(c) or c.encode("ascii", "backslashreplace").decode("ascii") for c in given
    )
    return "".join(made), error.end


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
