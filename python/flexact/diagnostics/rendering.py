# SPDX-License-Identifier: BSD-3-Clause
"""Diagnostics as text, like a modern compiler's: place, source line, caret, help."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence

from ..base.plain_text import harmless
from .diagnostic import Diagnostic, Place, Problems
from .source import Source, decode

MOST_SHOWN = 20
_WIDTH = 110
_BEFORE = 40
_CUT = "..."


def render_problems(problems: Problems, name: str = "", source: Source | None = None) -> str:
    """All problems: the first twenty, how many more there are, and a closing count.

    Errors go before warnings and notes when not all can be shown; what is shown
    stands in the order of the text.
    """
    shown = _choose(problems.kept)
    blocks = [render(item, name, source) for item in shown]
    if problems.total > len(shown):
        more = problems.total - len(shown)
        blocks.append(f"... and {more} more problem{'s' if more > 1 else ''}")
    blocks.append(_closing(problems, name))
    return "\n\n".join(blocks)


def _choose(kept: Sequence[Diagnostic]) -> list[Diagnostic]:
    ranked = sorted(range(len(kept)), key=lambda i: not kept[i].is_error)
    return [kept[i] for i in sorted(ranked[:MOST_SHOWN])]


def _closing(problems: Problems, name: str) -> str:
    words = [
        f"{count} {word}{'s' if count != 1 else ''}"
        for count, word in (
            (problems.errors, "error"),
            (problems.warnings, "warning"),
            (problems.notes, "note"),
        )
        if count
    ]
    where = f"{harmless(name)}: " if name else ""
    return where + (", ".join(words) or "no problems")


def render(item: Diagnostic, name: str = "", source: Source | None = None) -> str:
    """One diagnostic; without a source it has no source lines."""
    lines = [f"{item.severity}[{harmless(item.code)}]: {harmless(item.message)}"]
    numbers = [item.line] + ([item.other.line] if item.other else [])
    gutter = " " * len(str(max(numbers)))
    name = harmless(name)
    if item.line > 0:
        place = Place(item.line, item.column, item.last_column)
        lines.append(f"{gutter}--> {name}:{item.line}:{item.column}")
        lines += _excerpt(source, place, gutter, "^", harmless(item.label))
        if item.other is not None:
            lines.append(f"{gutter}::: {name}:{item.other.line}:{item.other.column}")
            label = "first here" if item.other < place else "and here"
            lines += _excerpt(source, item.other, gutter, "-", label)
    else:
        if name:
            lines.append(f"{gutter}--> {name}")
        if item.label:
            lines.append(f"{gutter} = {harmless(item.label)}")
    if item.help:
        lines.append(f"{gutter} = help: {harmless(item.help)}")
    return "\n".join(lines)


def _excerpt(source: Source | None, place: Place, gutter: str, mark: str, label: str) -> list[str]:
    if source is None:
        return [f"{gutter} = {label}"] if label else []
    text, first, last = _window(decode(source.line(place.line)), place)
    padding = "".join("\t" if c == "\t" else " " * _columns(c) for c in text[: first - 1])
    carets = mark * max(1, sum(_columns(c) for c in text[first - 1 : last]))
    number = str(place.line).rjust(len(gutter))
    return [
        f"{gutter} |",
        f"{number} | {text}".rstrip(),
        f"{gutter} | {padding}{carets} {label}".rstrip(),
    ]


def _window(text: str, place: Place) -> tuple[str, int, int]:
    """The line, or of a very long one the part around the place; and the place in it."""
    first = min(place.column, len(text) + 1)
    last = min(max(place.last_column, first), max(len(text), first))
    text = harmless(text, keep_tabs=True)
    if len(text) <= _WIDTH:
        return text, first, last
    start = max(0, min(first - 1 - _BEFORE, len(text) - _WIDTH))
    head = _CUT if start else ""
    tail = _CUT if start + _WIDTH < len(text) else ""
    shift = len(head) - start
    last = min(last, start + _WIDTH)
    return head + text[start : start + _WIDTH] + tail, first + shift, last + shift


def _columns(c: str) -> int:
    """How many columns of a terminal a character takes."""
    if c.isascii():
        return 1
    if unicodedata.combining(c):
        return 0
    return 2 if unicodedata.east_asian_width(c) in "WF" else 1
