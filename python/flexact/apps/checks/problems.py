# SPDX-License-Identifier: BSD-3-Clause
"""Problems of decks as findings: all that `flexact check` says."""

from __future__ import annotations

from collections.abc import Iterable

from ...deck.diagnostics import Diagnostic, Place, Problems, Severity
from ...deck.source import Source
from ...util.plain_text import harmless
from .finding import Finding, Region, Related
from .lines import Lines

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
) -> Iterable[Finding]:
    """Diagnostics as findings, in their order."""
    lines = Lines(source)
    for item in diagnostics:
        yield _finding(deck, item, lines)


def _finding(deck: str, item: Diagnostic, lines: Lines) -> Finding:
    region: Region | None = None
    statement, related = "", []
    if item.line > 0:
        region = lines.region(Place(item.line, item.column, item.last_column))
        statement = lines.statement(item.line)
    if item.other is not None:
        is_before = item.other < (item.line, item.column)
        words = "first here" if is_before else "and here"
        related.append(Related(lines.region(item.other), words))
    message = harmless(item.message)
    if item.label:
        message = f"{message}: {harmless(item.label)}"
    return Finding(
        *(deck, item.code, item.severity, message, region, statement),
        tuple(related),
        harmless(item.help),
    )
