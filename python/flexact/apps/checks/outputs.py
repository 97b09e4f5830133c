# SPDX-License-Identifier: BSD-3-Clause
"""Findings as commands of a workflow, by which GitHub marks lines of a pull request.

The form is that of "Workflow commands for GitHub Actions" in GitHub's documentation.
"""

from __future__ import annotations

from ...deck.diagnostics import Severity
from .finding import Finding
from .paths import from_root

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
