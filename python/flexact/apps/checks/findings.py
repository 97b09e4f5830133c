# SPDX-License-Identifier: BSD-3-Clause
"""A verdict as findings: each motion and self-stress at the statement of what takes part first."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ...advice.describe import lines_on_motions, lines_on_self_stresses, verdict_in_words
from ...analysis.mode_words import (
    conflict_in_words,
    internal_in_words,
    motion_in_parts,
    stress_in_parts,
)
from ...analysis.naming import Line, Named, Pieces, counted, counts_in_words, plain
from ...analysis.result import Result
from ...analysis.verdict import Verdict
from ...analysis.verdict_words import but_only, margin_line, warnings_of
from ...deck.diagnostics import Diagnostic, Place, Problems, Severity, Source, decode
from ...deck.tokens import tokens_of
from ...util.records import cached_property
from ...util.text import harmless
from ..editor.deck import Index, Key, units


def from_root(path: str, environment: Mapping[str, str] = os.environ) -> str:
    """A path from the root of the repository, or from the working folder.

    The root is what GitHub's runner says, in GITHUB_WORKSPACE; without, the working folder. What
    lies elsewhere keeps its whole path.
    """
    if path.startswith("<"):
        return path
    start = environment.get("GITHUB_WORKSPACE") or os.getcwd()
    try:
        found = os.path.relpath(os.path.abspath(path), start)
        if found.split(os.sep)[0] == os.pardir:
            found = os.path.relpath(os.path.realpath(path), os.path.realpath(start))
    except (OSError, ValueError):
        # Another drive, or a name that no file can have.
        return path.replace(os.sep, "/")
    if found.split(os.sep)[0] == os.pardir:
        found = os.path.abspath(path)
    return found.replace(os.sep, "/")


class Region(NamedTuple):
    """Part of one line: the columns count UTF-16 code units from 1, the last one is not in it."""

    line: int
    column: int
    end_column: int


#: Another place of a finding, and what is said of it.
Related = tuple[Region, str]


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


class Lines:
    """The lines of a deck.

    Attributes:
        source: The text; None of a deck that cannot be read.
    """

    def __init__(self, source: Source | None) -> None:
        """Keep the text; what is read off it is read when it is asked for."""
        self.source = source

    def region(self, place: Place) -> Region:
        """A place in UTF-16 units."""
        text = decode(self.source.line(place.line)) if self.source is not None else ""
        first = max(place.column, 1)
        last = max(place.last_column, first)
        start = units(text[: first - 1], "utf-16") + 1
        return Region(place.line, start, start + max(1, units(text[first - 1 : last], "utf-16")))

    def statement(self, number: int) -> str:
        """The words of a line in capitals, one blank between them, without the comment."""
        tokens = self._index.tokens if self._index is not None else ()
        words = tokens[number - 1].words if number <= len(tokens) else ()
        return " ".join(word.text for word in words).upper()

    def definition(self, key: Key) -> Region | None:
        """Where an element is made or a node gets its place; None where the text does not say."""
        where = self._index.definition(key) if self._index is not None else []
        if not where:
            return None
        (line, first), (_, behind) = where[0]
        return self.region(Place(line + 1, first + 1, max(behind, first + 1)))

    @cached_property
    def _index(self) -> Index | None:
        return None if self.source is None else Index(tokens_of(self.source))


#: Code of the finding that says how many more there are.
MORE = "more-problems"


def findings_of(deck: str, problems: Problems, source: Source | None) -> list[Finding]:
    """All problems that were kept, and how many more there are.

    Args:
        deck: Path of the deck.
        problems: What was found in it.
        source: Its text, if it could be read.
    """
    made = list(of_diagnostics(deck, problems.kept, source))
    more = problems.total - len(problems.kept)
    if more > 0:
        words = f"{more} more problem{'s' if more > 1 else ''} in this deck"
        severity = Severity.ERROR if problems.errors else Severity.WARNING
        made.append(Finding(deck, MORE, severity, words))
    return made


def of_diagnostics(
    deck: str, diagnostics: Iterable[Diagnostic], source: Source | None
) -> Iterator[Finding]:
    """Diagnostics as findings, in their order."""
    lines = Lines(source)
    for item in diagnostics:
        region: Region | None = None
        statement, related = "", []
        if item.line > 0:
            region = lines.region(Place(item.line, item.column, item.last_column))
            statement = lines.statement(item.line)
        if item.other is not None:
            words = "first here" if item.other < (item.line, item.column) else "and here"
            related.append((lines.region(item.other), words))
        message = harmless(f"{item.message}: {item.label}" if item.label else item.message)
        yield Finding(
            *(deck, item.code, item.severity, message, region, statement),
            tuple(related),
            harmless(item.help),
        )


UNDER, OVER = "under-constrained", "over-constrained"
MARGINAL, OTHERWISE = "small-margin", "not-as-expected"
#: Motions, and self-stresses, that are said one by one; what takes part in each; ways to mend.
_MOST, _PARTS, _WAYS = 4, 8, 6


def findings_about(deck: str, result: Result, expected: Verdict | None) -> list[Finding]:
    """Problems of a deck, doubts about its verdict, and the verdict where it is not as expected.

    Args:
        deck: Path of the deck.
        result: Its analysis.
        expected: The verdict that is expected; None where none is, so that one that is not exact
            is a note.
    """
    problems, source = result.data.problems, result.data.source
    made = findings_of(deck, problems, source)
    made += of_diagnostics(deck, warnings_of(result)[len(problems.kept) :], source)
    return made + list(_Verdict(deck, result, expected).findings())


#: A motion or a self-stress in words: the head, and what takes part.
_Mode = tuple[Pieces, Sequence[Pieces]]


class _Verdict:
    """What is said of one verdict."""

    def __init__(self, deck: str, result: Result, expected: Verdict | None) -> None:
        self.deck, self.result, self.expected = deck, result, expected
        self.severity = Severity.NOTE if expected is None else Severity.ERROR
        self.lines = Lines(result.data.source)

    def findings(self) -> Iterator[Finding]:
        """What is not as it is expected, where anything is."""
        result, expected = self.result, self.expected or Verdict.EXACT
        if result.verdict is expected:
            if expected is Verdict.EXACT and result.is_marginal:
                head = margin_line(result).head
                words = f"{verdict_in_words(result).start}. {plain(head)}"
                yield self._made(MARGINAL, words, self._where(head))
            return
        made = []
        if result.under_constrained and expected not in (Verdict.UNDER, Verdict.BOTH):
            made += list(self._motions())
        if result.over_constrained and expected not in (Verdict.OVER, Verdict.BOTH):
            modes = (
                (conflict_in_words(stress), stress_in_parts(stress, _PARTS))
                for stress in result.self_stresses[:_MOST]
            )
            count, ways = result.over_constrained, lines_on_self_stresses(result)
            made += list(self._modes("self-stress", OVER, count, modes, ways))
        if not made:
            words = f"{verdict_in_words(result).start}; expected {expected.value}"
            made = [self._made(OTHERWISE, words, None)]
        yield from made

    def _motions(self) -> Iterator[Finding]:
        result = self.result
        internal = internal_in_words(result)
        told = [one for one in result.motions if not (internal and one.is_internal)]
        modes = (((), motion_in_parts(motion, _PARTS)) for motion in told[:_MOST])
        if internal:
            yield self._made(UNDER, self._counts(UNDER, internal), None)
        rest = result.under_constrained - (len(result.motions) - len(told) if internal else 0)
        yield from self._modes("motion", UNDER, rest, modes, lines_on_motions(result))

    def _modes(
        self, what: str, code: str, count: int, modes: Iterable[_Mode], ways: Iterable[Line]
    ) -> Iterator[Finding]:
        """Modes one by one, the first with what can be done, and how many there are besides."""
        mend = "\n".join(map(_way, ways))
        number = 0
        for number, (head, parts) in enumerate(modes, start=1):
            some = [*map(plain, parts[:_PARTS]), *["..."] * (len(parts) > _PARTS)]
            words = f"{what} {number}: {f'{plain(head)}: ' if head else ''}{'; '.join(some)}"
            # Of each part its statement, the first of those that have one the place of all.
            related: dict[Region, str] = {}
            for pieces in parts[:_PARTS]:
                if (region := self._where(pieces)) is not None:
                    related.setdefault(region, harmless(plain(pieces)))
            first = next(iter(related), None)
            places = tuple(related.items())
            yield self._made(code, self._counts(code, words), first, places, mend)
            mend = ""
        if number and count > number:
            more = counted(count - number, f"more {what}", "", "s" if what == "motion" else "es")
            yield self._made(MORE, self._counts(code, f"and {more}"), None)

    def _counts(self, code: str, words: str) -> str:
        result = self.result
        under = result.under_constrained if code == UNDER else 0
        over = result.over_constrained if code == OVER else 0
        only = but_only(result.margin, result.accuracy)
        return f"{counts_in_words(under, over).capitalize()}{only}: {words}"

    def _where(self, pieces: Pieces) -> Region | None:
        """Where what is named first is defined."""
        named = next((piece for piece in pieces if isinstance(piece, Named)), None)
        return self.lines.definition((named.kind, named.number)) if named else None

    def _made(
        self,
        code: str,
        words: str,
        region: Region | None,
        related: tuple[Related, ...] = (),
        mend: str = "",
    ) -> Finding:
        statement = self.lines.statement(region.line) if region is not None else ""
        words = harmless(words)
        return Finding(self.deck, code, self.severity, words, region, statement, related, mend)


def _way(line: Line) -> str:
    short = line.shortened(_WAYS)
    items = [plain(item) + behind for item, behind in short.listed()] + ["..."] * short.more
    return harmless(plain(short.head) + "; ".join(items))
