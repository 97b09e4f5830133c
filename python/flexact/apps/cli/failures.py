# SPDX-License-Identifier: BSD-3-Clause
"""How a deck's failure is reported, to people and to programs."""

from __future__ import annotations

import sys

from ...deck.diagnostics import Diagnostic, Problems, Severity
from ...deck.errors import DeckError
from ...deck.rendering import render_problems
from ...util.decks import DeckFile, FolderError
from ...util.errors import BatchError, FlexactError
from ...util.loading import load
from ...util.partial import why
from ...util.plain_text import harmless
from .outcome import ExitCode, Outcome
from .terminal import ResultsError, columns_of, complain, give

_MEMORY = "out-of-memory"
#: Failures that are none of the deck's.
CODES = {
    "AnalysisError": "not-analysed",
    "OutputError": "not-written",
    "MeshFormatError": "not-written",
    "MemoryError": _MEMORY,
    "UnforeseenError": "unforeseen",
}
#: Codes of problems with a file that are not about what is stated in it.
NOT_READ = {
    "cannot-read",
    "is-a-folder",
    "no-such-file",
    "not-a-file",
    "not-text",
    "too-large",
    _MEMORY,
}


class UnforeseenError(BatchError):
    """One deck over which this program stumbles, which shall not cost the others."""


def foreseen(error: Exception) -> Exception:
    """An error that is raised on purpose: itself, or what stands for a mistake of Flexact's own.

    Raises:
        BrokenPipeError: Nobody reads on, so that going on has no use.
        ResultsError: Likewise.
        Exception: A mistake of Flexact's own, in tests (`flexact.util.partial`).
    """
    if isinstance(error, (BrokenPipeError, ResultsError)):
        raise error
    if isinstance(error, (FlexactError, MemoryError)):
        return error
    return UnforeseenError(why(error))


def report(deck: DeckFile, error: Exception, *, as_json: bool) -> Outcome:
    """Report why a deck failed: rendered on stderr, and as one JSON line on stdout if asked."""
    report_failure(deck, error)
    if as_json:
        problems = problems_of(error)
        records = [each.to_dict() for each in problems.kept if each.is_error]
        failure = {"diagnostics": records, "errors": problems.errors}
        # Loaded where it is wanted: a command that starts does not wait for it.
        head = load("flexact.analysis.json_result").header(deck.name)
        give(load("json").dumps({**head, "error": failure}))
    return outcome_of(deck, error)


def outcome_of(deck: DeckFile, error: Exception) -> Outcome:
    """What the command makes of a deck's failure."""
    is_other = type(error).__name__ in CODES or _MEMORY in _codes(error)
    code = ExitCode.OTHER if is_other else ExitCode.DECK_ERROR
    return Outcome(deck.name, code, "failed", _remark(error))


def report_failure(deck: DeckFile, error: Exception) -> None:
    """Report on stderr why a deck failed."""
    if isinstance(error, DeckError):
        width = columns_of(sys.stderr)
        complain(render_problems(error.problems, error.name, error.source, width))
    elif isinstance(error, FolderError):
        complain(_reason(error))
    else:
        complain(f"{harmless(deck.name)}: error: {_reason(error)}")


def _remark(error: Exception) -> str:
    if isinstance(error, FolderError):
        return error.remark
    if not isinstance(error, DeckError):
        return "failed"
    return "cannot be read" if _codes(error) & NOT_READ else ""


def _codes(error: Exception) -> set[str]:
    return {each.code for each in error.diagnostics} if isinstance(error, DeckError) else set()


def _reason(error: Exception) -> str:
    words = "not enough memory" if isinstance(error, MemoryError) else repr(error)
    return harmless(str(error) or words)


def problems_of(error: Exception) -> Problems:
    """Why a deck failed, as problems: those of the deck, else one without a place."""
    if isinstance(error, DeckError):
        return error.problems
    code = getattr(error, "code", CODES.get(type(error).__name__, "failed"))
    return Problems.of([Diagnostic(Severity.ERROR, code, _reason(error))])
