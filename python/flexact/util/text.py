# SPDX-License-Identifier: BSD-3-Clause
"""Text in columns of a terminal: how wide it is, and broken into rows."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterator, Sequence

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


def slug(words: str, between: str = "-") -> str:
    """Words in small letters and digits alone, as a file or a class of a page may be called."""
    return re.sub(r"[^a-z0-9]+", between, words.lower()).strip(between)


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


_NUMBERS = (
    *("no", "one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)


def number_in_words(count: int) -> str:
    """A number, as a word up to twelve."""
    return _NUMBERS[count] if count < len(_NUMBERS) else str(count)


#: Columns of text where nobody says how many there are.
USUAL = 100
#: Holds words together while rows are broken.
TIE = "\N{NO-BREAK SPACE}"
#: Columns between those of a table.
_GAP = 2


def columns(text: str) -> int:
    """How many columns of a terminal a text takes."""
    if text.isascii():
        return len(text)
    shown = [c for c in text if not unicodedata.combining(c)]
    return len(shown) + sum(unicodedata.east_asian_width(c) in "WF" for c in shown)


def wrapped(text: str, width: int, indent: str = "", *, torn: bool = False) -> str:
    """A text in rows of at most `width` columns; words tied by no-break spaces stay together.

    Args:
        text: One row; blanks at its start stay.
        width: Columns.
        indent: In front of the second row and further ones.
        torn: Whether words that are wider than a row are torn apart.
    """
    if columns(text) <= width:
        return text.replace(TIE, " ")
    if len(indent) > width // 3:
        indent = ""
    rows, row = [], ""
    for word in _words(text, width - len(indent), torn):
        if not row:
            row = word
        elif columns(row) + 1 + columns(word) <= width:
            row = f"{row} {word}"
        else:
            rows.append(row)
            row = indent + word
    return "\n".join((*rows, row)).replace(TIE, " ")


def _words(text: str, width: int, torn: bool) -> Iterator[str]:
    """The words; blanks at the start belong to the first. Tied words that are too wide are not."""
    start = text[: len(text) - len(text.lstrip(" "))]
    for word in text[len(start) :].split(" "):
        told = start + word
        start = ""
        if not torn or columns(told) <= width:
            yield told
            continue
        for part in told.split(TIE):
            yield from _parts(part, width)


def _parts(word: str, width: int) -> Iterator[str]:
    """A word that is wider than a row, in pieces."""
    piece = ""
    for c in word:
        if piece and columns(piece + c) > width:
            yield piece
            piece = ""
        piece += c
    yield piece


def refitted(text: str, width: int) -> str:
    """A text of several rows in which those that are too wide are broken, words too if need be."""
    return "\n".join(
        row if columns(row) <= width else wrapped(row, width, _hanging(row), torn=True)
        for row in text.split("\n")
    )


def _hanging(row: str) -> str:
    return " " * (len(row) - len(row.lstrip(" ")) + 2)


def table(rows: Sequence[Sequence[str]], width: int, *, second: bool = False) -> str:
    """A table whose first row has its headings: in columns, or as a list where they do not fit.

    The first column is aligned to the left, others to the right.

    Args:
        rows: Headings and cells.
        width: Columns that there are.
        second: Whether headings go on in the second row.
    """
    widths = [max(columns(row[k]) for row in rows) for k in range(len(rows[0]))]
    if sum(widths) + _GAP * (len(widths) - 1) <= width:
        return "\n".join(_aligned(row, widths) for row in rows)
    heads, *others = rows
    if second:
        behind, *others = others
        heads = [" ".join(both).strip() for both in zip(heads, behind, strict=True)]
    return "\n".join(line for row in others for line in _listed(heads, row, width))


def _aligned(row: Sequence[str], widths: Sequence[int]) -> str:
    cells = [
        cell + " " * (width - columns(cell)) if k == 0 else " " * (width - columns(cell)) + cell
        for k, (cell, width) in enumerate(zip(row, widths, strict=True))
    ]
    return (" " * _GAP).join(cells).rstrip()


def _listed(heads: Sequence[str], row: Sequence[str], width: int) -> Iterator[str]:
    """A row of the table: its name, and below it what stands in its columns."""
    yield wrapped(row[0], width, torn=True)
    for head, cell in zip(heads[1:], row[1:], strict=True):
        if cell:
            yield wrapped(f"  {head.strip()}: {cell}", width, "    ", torn=True)
