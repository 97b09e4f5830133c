# SPDX-License-Identifier: BSD-3-Clause
"""Colour in a terminal: whether it is wanted, and of what."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TextIO

CHOICES = ("auto", "always", "never")

_STYLES = {
    "good": "1;32",
    "bad": "1;31",
    "unsure": "1;33",
    "error": "1;31",
    "warning": "1;33",
    "note": "1;36",
    "mark": "1;31",
    "faint": "2",
    "strong": "1",
}
_FORCING = ("CLICOLOR_FORCE", "FORCE_COLOR")
_HEADS = re.compile(
    r"^(?P<where>(?!error|warning|note|tip)[^\s:][^:]*: )?(?P<kind>error|warning|note|tip)"
    r"(?P<code>\[[\w-]+\])?(?=:)"
)
_PLACE = re.compile(r"^ *(-->|:::)")
_MARKS = re.compile(r"^( *\| *)([\^]+|-+)( .*)?$")
_HELP = re.compile(r"^( *= )(help|note)(?=:)")


def is_wanted(stream: TextIO | None, choice: str, environment: Mapping[str, str]) -> bool:
    """Whether a stream is to be coloured.

    `--color` decides; else NO_COLOR, if it is not empty, forbids colour (no-color.org), and
    CLICOLOR_FORCE or FORCE_COLOR wants it; else it is for terminals that are not dumb.
    """
    if choice != "auto":
        return choice == "always"
    if environment.get("NO_COLOR"):
        return False
    if any(environment.get(name, "0") not in ("", "0") for name in _FORCING):
        return True
    seen = stream is not None and stream.isatty()
    return seen and environment.get("TERM") != "dumb"


def painted(text: str, style: str) -> str:
    """A text in a colour; each row by itself, so that a pager shows it."""
    rows = text.split("\n")
    return "\n".join(f"\x1b[{_STYLES[style]}m{row}\x1b[0m" if row else row for row in rows)


def painted_problems(text: str) -> str:
    """Diagnostics as they were rendered, with kinds, places and carets in colour."""
    return "\n".join(map(_painted_row, text.split("\n")))


def _painted_row(row: str) -> str:
    if found := _HEADS.match(row):
        kind = found["kind"]
        where, code = found["where"] or "", found["code"] or ""
        style = kind if kind in _STYLES else "note"
        return f"{where}{painted(kind + code, style)}{row[found.end() :]}"
    if _PLACE.match(row):
        return painted(row, "faint")
    if found := _MARKS.match(row):
        style = "mark" if "^" in found[2] else "note"
        return found[1] + painted(found[2] + (found[3] or ""), style)
    if found := _HELP.match(row):
        return f"{found[1]}{painted(found[2], 'note')}{row[found.end() :]}"
    return row
