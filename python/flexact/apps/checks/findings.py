# SPDX-License-Identifier: BSD-3-Clause
"""A verdict as findings: each motion and self-stress at the statement of what takes part first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ...advice.describe import verdict_in_words
from ...advice.ways_words import lines_on_motions, lines_on_self_stresses
from ...analysis.mode_words import conflict_in_words, stress_in_parts
from ...analysis.motions import internal_in_words, motion_in_parts
from ...analysis.naming import counted, counts_in_words
from ...analysis.result import Result
from ...analysis.sentences import Line, Named, Pieces, plain
from ...analysis.text_margin import but_only, margin_line
from ...analysis.verdict import Verdict
from ...analysis.warnings import warnings_of
from ...deck.diagnostics import Severity
from ...util.plain_text import harmless
from .finding import Finding, Region, Related
from .lines import Lines
from .problems import MORE, findings_of, of_diagnostics

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


class _Mode(NamedTuple):
    """A motion or a self-stress in words."""

    head: Pieces
    parts: tuple[Pieces, ...]


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
                yield self._marginal()
            return
        made = []
        if result.under_constrained and expected not in (Verdict.UNDER, Verdict.BOTH):
            made += list(self._motions())
        if result.over_constrained and expected not in (Verdict.OVER, Verdict.BOTH):
            made += list(self._self_stresses())
        if not made:
            words = f"{verdict_in_words(result).start}; expected {expected.value}"
            made = [self._made(OTHERWISE, words, None)]
        yield from made

    def _motions(self) -> Iterator[Finding]:
        result = self.result
        internal = internal_in_words(result)
        told = [one for one in result.motions if not (internal and one.is_internal)]
        modes = (_Mode((), motion_in_parts(motion, _PARTS)) for motion in told[:_MOST])
        if internal:
            yield self._made(UNDER, self._counts(UNDER, internal), None)
        rest = result.under_constrained - (len(result.motions) - len(told) if internal else 0)
        yield from self._modes("motion", UNDER, rest, modes, lines_on_motions(result))

    def _self_stresses(self) -> Iterator[Finding]:
        result = self.result
        modes = (
            _Mode(conflict_in_words(stress), stress_in_parts(stress, _PARTS))
            for stress in result.self_stresses[:_MOST]
        )
        ways = lines_on_self_stresses(result)
        yield from self._modes("self-stress", OVER, result.over_constrained, modes, ways)

    def _modes(
        self, what: str, code: str, count: int, modes: Iterable[_Mode], ways: Iterable[Line]
    ) -> Iterator[Finding]:
        """Modes one by one, the first with what can be done, and how many there are besides."""
        mend = "\n".join(map(_way, ways))
        number = 0
        for number, mode in enumerate(modes, start=1):
            words = f"{what} {number}: {_words(mode)}"
            related = tuple(self._related(mode.parts))
            region = next((one.region for one in related), None)
            yield self._made(code, self._counts(code, words), region, related, mend)
            mend = ""
        if number and count > number:
            more = counted(count - number, f"more {what}", "", "s" if what == "motion" else "es")
            yield self._made(MORE, self._counts(code, f"and {more}"), None)

    def _counts(self, code: str, words: str) -> str:
        result = self.result
        under = result.under_constrained if code == UNDER else 0
        over = result.over_constrained if code == OVER else 0
        stated = counts_in_words(under, over).capitalize() + but_only(
            result.margin, result.accuracy
        )
        return f"{stated}: {words}"

    def _related(self, parts: tuple[Pieces, ...]) -> Iterator[Related]:
        """Of each part its statement, the first of those that have one the place of all."""
        seen = set()
        for pieces in parts[:_PARTS]:
            named = next((piece for piece in pieces if isinstance(piece, Named)), None)
            region = self.lines.definition((named.kind, named.number)) if named else None
            if region is not None and region not in seen:
                seen.add(region)
                yield Related(region, harmless(plain(pieces)))

    def _marginal(self) -> Finding:
        result = self.result
        words = f"{verdict_in_words(result).start}. {plain(margin_line(result).head)}"
        line = margin_line(result).head
        named = next((piece for piece in line if isinstance(piece, Named)), None)
        where = self.lines.definition((named.kind, named.number)) if named else None
        return self._made(MARGINAL, words, where)

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


def _words(mode: _Mode) -> str:
    """A mode in a sentence, and what takes part."""
    parts = [plain(pieces) for pieces in mode.parts[:_PARTS]]
    parts += ["..."] * (len(mode.parts) > _PARTS)
    listed = "; ".join(parts)
    return f"{plain(mode.head)}: {listed}" if mode.head else listed


def _way(line: Line) -> str:
    short = line.shortened(_WAYS)
    items = [plain(item) + behind for item, behind in short.listed()] + ["..."] * short.more
    return harmless(plain(short.head) + "; ".join(items))
