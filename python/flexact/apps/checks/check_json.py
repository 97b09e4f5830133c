# SPDX-License-Identifier: BSD-3-Clause
"""What `flexact check --json` says of a deck: `docs/check.schema.json`."""

from __future__ import annotations

from typing import Any

from ...deck.diagnostics import Diagnostic, Place, Problems
from ...util.version import VERSION

#: Of the JSON; see `docs/command.md` for when it is raised.
FORMAT = 1


def dictionary_of(deck: str, problems: Problems) -> dict[str, Any]:
    """The names and values of the object of a deck, in their order."""
    return {
        "format": FORMAT,
        "deck": deck,
        "flexact": VERSION,
        "errors": problems.errors,
        "warnings": problems.warnings,
        "notes": problems.notes,
        "diagnostics": [_diagnostic(item) for item in problems.kept],
    }


def _diagnostic(item: Diagnostic) -> dict[str, Any]:
    return {
        "code": item.code,
        "severity": item.severity.value,
        "message": item.message,
        **_place(Place(item.line, item.column, item.last_column)),
        "label": item.label,
        "help": item.help,
        "other": None if item.other is None else _place(item.other),
    }


def _place(place: Place) -> dict[str, int]:
    line, first, last = place
    return {"line": line, "column": first, "end_column": max(first, last) + 1 if line else 0}
