# SPDX-License-Identifier: BSD-3-Clause
"""Problems of decks and models as values, and the exceptions that carry them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core.arrays import ByteArray, IndexArray, IntArray
from ..core.raw import RawDiagnostics
from ..util.records import Word, cached_property

_LINE_FEED = 10


def decode(raw: bytes) -> str:
    """Text of some bytes: UTF-8 where they are, else the old Windows code page."""
    return raw.decode(_codec(raw), "replace")


def _codec(raw: bytes) -> str:
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return "cp1252"
    return "utf-8"


@dataclass(frozen=True, eq=False)
class Source:
    """The text of a deck and the name it goes by.

    Attributes:
        text: The bytes as the core saw them.
        name: Path, or another name, for `name:line:column`.
    """

    text: bytes
    name: str

    @cached_property
    def _breaks(self) -> IndexArray:
        return np.flatnonzero(np.frombuffer(self.text, np.int8) == _LINE_FEED)

    def line(self, number: int) -> bytes:
        """Bytes of line 1, 2, ..., without its end; empty where there is no such line."""
        if not 1 <= number <= self._breaks.size + 1:
            return b""
        first = int(self._breaks[number - 2]) + 1 if number > 1 else 0
        last = int(self._breaks[number - 1]) if number <= self._breaks.size else len(self.text)
        return self.text[first:last].rstrip(b"\r")

    def character_columns(self, line: int, first: int, last: int) -> tuple[int, int]:
        """First and last character (from 1) of the bytes `first` to `last` of a line."""
        raw = self.line(line)
        if raw.isascii():
            return first, max(first, last)
        codec = _codec(raw)
        start = len(raw[: first - 1].decode(codec, "replace")) + 1
        return start, max(start, len(raw[:last].decode(codec, "replace")))


class Severity(Word):
    """How grave a diagnostic is: an error leaves nothing to analyse."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


_SEVERITIES = (Severity.ERROR, Severity.WARNING, Severity.NOTE)


class Place(NamedTuple):
    """A span of one line, counted in characters from 1."""

    line: int
    column: int
    last_column: int


@dataclass(frozen=True)
class Diagnostic:
    """One problem.

    Attributes:
        severity: Error, warning or note.
        code: Short name that stays the same between versions.
        message: What is wrong.
        line: Line of the deck from 1; 0 where the problem has no place.
        column: First character in the line from 1, or 0.
        last_column: Last character in the line, or 0.
        label: A few words that stand beside the caret.
        help: How to fix it.
        other: The second place, where a problem has two.
    """

    severity: Severity
    code: str
    message: str
    line: int = 0
    column: int = 0
    last_column: int = 0
    label: str = ""
    help: str = ""
    other: Place | None = None

    @property
    def is_error(self) -> bool:
        """Whether nothing can be analysed because of it."""
        return self.severity is Severity.ERROR

    def to_dict(self) -> dict[str, str | int]:
        """The entries that the JSON of a result has for a warning."""
        return {
            "code": self.code,
            "severity": self.severity.value,
            "line": self.line,
            "column": self.column,
            "message": self.message,
        }


def warning(code: str, message: str, hint: str = "") -> Diagnostic:
    """A warning without a place."""
    return Diagnostic(Severity.WARNING, code, message, help=hint)


@dataclass(frozen=True)
class Problems:
    """Diagnostics that were kept, and how many there were of each severity.

    Attributes:
        kept: The diagnostics, in the order of their places.
        errors: Number of errors, kept or not.
        warnings: Number of warnings.
        notes: Number of notes.
    """

    kept: tuple[Diagnostic, ...] = ()
    errors: int = 0
    warnings: int = 0
    notes: int = 0

    @property
    def total(self) -> int:
        """Number of all problems, kept or not."""
        return self.errors + self.warnings + self.notes

    @classmethod
    def of(cls, diagnostics: Sequence[Diagnostic]) -> Problems:
        """Problems that are all kept."""
        counts = [
            sum(item.severity is severity for item in diagnostics) for severity in _SEVERITIES
        ]
        return cls(tuple(diagnostics), *counts)

    def and_also(self, diagnostics: Sequence[Diagnostic]) -> Problems:
        """These problems, and further ones behind them that are all kept."""
        if not diagnostics:
            return self
        more = Problems.of(diagnostics)
        return Problems(
            self.kept + more.kept,
            self.errors + more.errors,
            self.warnings + more.warnings,
            self.notes + more.notes,
        )


NO_PROBLEMS = Problems()


def problems_of(raw: RawDiagnostics, source: Source | None = None) -> Problems:
    """The core's diagnostics as values; byte columns become characters of `source`."""
    counts, numbers, texts = raw
    errors, warnings, notes, kept = counts.tolist()
    if not kept:
        return NO_PROBLEMS
    items = (_diagnostic(numbers[:, i], texts[..., i], source) for i in range(kept))
    return Problems(tuple(items), errors, warnings, notes)


def _diagnostic(number: IntArray, text: ByteArray, source: Source | None) -> Diagnostic:
    severity, *places = number.tolist()
    code, message, label, hint = (decode(each.tobytes().rstrip(b" \0")) for each in text.T)
    place = _place(source, *places[:3])
    return Diagnostic(
        _SEVERITIES[severity - 1],
        code,
        message,
        *(place or (0, 0, 0)),
        label=label,
        help=hint,
        other=_place(source, *places[3:6]),
    )


def _place(source: Source | None, line: int, first: int, last: int) -> Place | None:
    if line < 1:
        return None
    if source is not None:
        first, last = source.character_columns(line, first, last)
    return Place(line, first, last)
