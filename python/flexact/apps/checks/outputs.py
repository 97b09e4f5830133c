# SPDX-License-Identifier: BSD-3-Clause
"""Findings as commands of a workflow, by which GitHub marks lines of a pull request.

The form is that of "Workflow commands for GitHub Actions" in GitHub's documentation.
"""

from __future__ import annotations

from typing import Any

from ...deck.diagnostics import Diagnostic, Place, Problems, Severity
from ...util.loading import VERSION
from .findings import Finding, from_root

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}


def annotation(finding: Finding) -> str:
    """A finding as one line of a workflow's log."""
    entries = {"title": f"flexact ({finding.code})", "file": from_root(finding.deck)}
    words = [finding.message]
    if finding.region is not None:
        line, column, end = finding.region
        places = {"line": line, "endLine": line, "col": column, "endColumn": end}
        entries |= {name: str(value) for name, value in places.items()}
    words += [
        f"line {one.region.line}: {one.message}"
        for one in finding.related
        if one.message not in finding.message
    ]
    if finding.help:
        words.append(f"help: {finding.help}")
    listed = ",".join(f"{name}={_property(value)}" for name, value in entries.items())
    return f"::{_COMMANDS[finding.severity]} {listed}::{_data(chr(10).join(words))}"


def _data(text: str) -> str:
    """Text behind the second pair of colons."""
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    """The value of an entry, which commas and colons would end."""
    return _data(text).replace(":", "%3A").replace(",", "%2C")


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
