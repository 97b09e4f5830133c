# SPDX-License-Identifier: BSD-3-Clause
"""What is found in decks, in the form that a service or a person wants: the option --format."""

from __future__ import annotations

import argparse
from typing import Any

from ...analysis.result import Result
from ...analysis.verdict import Verdict
from ...deck.errors import DeckError
from ...model.reading import read_deck
from ...util.decks import DeckFile
from ...util.errors import BatchError
from ...util.loading import load
from . import failures
from .decks import report_problems
from .mesh_format import FormatOrMesh, FormsOrMeshes
from .outcome import ExitCode, Outcome
from .terminal import give

TEXT, GITHUB, SARIF = FORMS = ("text", "github", "sarif")


def add_format(parser: argparse.ArgumentParser, *, was_mesh: bool = False) -> None:
    """Add to a verb's parser for whom it writes.

    Args:
        parser: The parser.
        was_mesh: Whether the option stood for what is `--mesh` now.
    """
    parser.add_argument(
        "--format",
        action=FormatOrMesh if was_mesh else "store",
        choices=FormsOrMeshes(FORMS) if was_mesh else FORMS,
        default=TEXT,
        help="words for people (default), annotations of a GitHub workflow, or SARIF 2.1.0",
    )


def require_one_form(chosen: argparse.Namespace) -> None:
    """Raise where several options say what stdout holds.

    Raises:
        BatchError: They do.
    """
    given = [f"--{name}" for name in ("summary", "json", "log") if getattr(chosen, name, None)]
    if chosen.format != TEXT:
        given.append(f"--format {chosen.format}")
    if "--summary" in given and len(given) > 1:
        raise BatchError(f"--summary is in place of {given[1]}; choose one")
    if len(given) > 1 and not ("--log" in given and chosen.output):
        mend = ", or give -o DIR for the log" if "--log" in given else ""
        raise BatchError(f"{given[0]} and {given[1]} both go to stdout: choose one{mend}")


class Findings:
    """Writes what is found: annotations deck by deck, SARIF when all decks are done."""

    def __init__(self, form: str) -> None:
        """Keep the form, one of `FORMS` that is for programs."""
        self._form = form
        self._kept: list[Any] = []

    def checked(self, deck: DeckFile) -> Outcome:
        """Read a deck, and write its problems."""
        model = read_deck(deck)
        report_problems(model)
        module = load("flexact.apps.checks.problems")
        self._add(module.findings_of(deck.name, model.problems, model.source))
        return Outcome(deck.name, ExitCode.ANALYSED, "without errors")

    def analysed(self, deck: DeckFile, result: Result, expected: Verdict | None) -> None:
        """Write what is found in a deck that was analysed."""
        module = load("flexact.apps.checks.findings")
        self._add(module.findings_about(deck.name, result, expected))

    def failed(self, deck: DeckFile, error: Exception) -> None:
        """Write why a deck failed."""
        source = error.source if isinstance(error, DeckError) else None
        module = load("flexact.apps.checks.problems")
        self._add(module.findings_of(deck.name, failures.problems_of(error), source))

    def _add(self, findings: list[Any]) -> None:
        if self._form == SARIF:
            self._kept += findings
            return
        lines = map(load("flexact.apps.checks.outputs").annotation, findings)
        if text := "\n".join(lines):
            give(text)

    def finish(self, code: ExitCode) -> ExitCode:
        """Write what waits until all decks are done; gives back the code."""
        if self._form == SARIF:
            ended_well = code is not ExitCode.OTHER
            module = load("flexact.apps.checks.findings_sarif")
            log = module.log_of(self._kept, int(code), ended_well=ended_well)
            give(load("json").dumps(log, indent=1))
        return code
