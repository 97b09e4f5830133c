# SPDX-License-Identifier: BSD-3-Clause
"""One thing that is found in a deck, at its place, counted as services count."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ...deck.diagnostics import Severity


class Region(NamedTuple):
    """Part of one line: the columns count UTF-16 code units from 1, the last one is not in it."""

    line: int
    column: int
    end_column: int


class Related(NamedTuple):
    """Another place of a finding, and what is said of it."""

    region: Region
    message: str


@dataclass(frozen=True)
class Finding:
    """A problem, or a verdict that is not the expected one.

    Attributes:
        deck: Path of the deck as a person wrote it.
        code: Short name that stays the same between versions.
        severity: Error, warning or note.
        message: What is wrong, in one line or several.
        region: Where; None where it has no place in the deck.
        statement: The words of the line that it stands in, without blanks and comments that may
            change; empty without a place.
        related: Other places that take part.
        help: How to mend it; may be empty.
    """

    deck: str
    code: str
    severity: Severity
    message: str
    region: Region | None = None
    statement: str = ""
    related: tuple[Related, ...] = ()
    help: str = ""
