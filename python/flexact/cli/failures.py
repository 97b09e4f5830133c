"""How a deck's failure is told, to people and to programs."""

from __future__ import annotations

import json
from typing import Any

from flexact.batch import DeckFile, NoDecksError
from flexact.cli.terminal import complain, say
from flexact.diagnostics import DeckError, Severity
from flexact.model import Model

CODES = {
    "NoDecksError": "no-decks",
    "AnalysisError": "not-analysed",
    "OutputError": "not-written",
    "MeshFormatError": "not-written",
    "MemoryError": "out-of-memory",
}


def remark(model: Model) -> None:
    """Render the warnings and notes about a sound deck on stderr."""
    if model.diagnostics:
        from flexact.rendering import render_problems

        complain(render_problems(model.data.problems, model.name, model.data.source))


def tell(deck: DeckFile, error: Exception, as_json: bool) -> None:
    """Tell why a deck failed: rendered on stderr, and as one JSON line on stdout if asked."""
    if isinstance(error, DeckError | NoDecksError):
        complain(str(error))
    else:
        complain(f"{deck.path}: error: {_reason(error)}")
    if as_json:
        say(json.dumps({"deck": deck.path, "error": {"diagnostics": _records(error)}}))


def _reason(error: Exception) -> str:
    return str(error) or ("not enough memory" if isinstance(error, MemoryError) else repr(error))


def _records(error: Exception) -> list[dict[str, Any]]:
    if not isinstance(error, DeckError):
        code = CODES.get(type(error).__name__, "failed")
        return [{"code": code, "line": 0, "column": 0, "message": _reason(error)}]
    return [
        {"code": d.code, "line": d.line, "column": d.column, "message": d.message}
        for d in error.diagnostics
        if d.severity is Severity.ERROR
    ]
