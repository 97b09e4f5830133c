# SPDX-License-Identifier: BSD-3-Clause
"""What was found, for other programs: GitHub's annotations, the JSON of check, and JUnit XML.

Annotations are "Workflow commands for GitHub Actions" of GitHub's documentation.
"""

from __future__ import annotations

import socket
import time
from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree

from ...deck.diagnostics import Diagnostic, Place, Problems, Severity
from ...util.decks import DeckFile
from ...util.loading import VERSION
from ...util.text import harmless
from . import comparison
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


#: States that are failures of a test, and errors in it.
_FAILURES, _ERRORS = (
    (comparison.State.DIFFERENT,),
    (comparison.State.FAILED, comparison.State.MISSING),
)


def junit_xml(
    found: Sequence[tuple[DeckFile, comparison.Finding]], seconds: float, start: float
) -> bytes:
    """The text of a JUnit XML file: a test case a deck.

    Args:
        found: The decks, and what came of each.
        seconds: What all took.
        start: When it began [s since 1970].
    """
    root = ElementTree.Element("testsuites")
    suite = ElementTree.SubElement(
        root,
        "testsuite",
        name="flexact regress",
        package="flexact",
        id="0",
        tests=str(len(found)),
        failures=str(sum(each.state in _FAILURES for _, each in found)),
        errors=str(sum(each.state in _ERRORS for _, each in found)),
        time=f"{seconds:.3f}",
        timestamp=time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(start)),
        hostname=socket.gethostname() or "localhost",
    )
    ElementTree.SubElement(suite, "properties")
    for deck, finding in found:
        _add(suite, deck, finding)
    ElementTree.SubElement(suite, "system-out")
    ElementTree.SubElement(suite, "system-err")
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)
    return bytes(text) + b"\n"


def _add(suite: ElementTree.Element, deck: DeckFile, finding: comparison.Finding) -> None:
    folder = str(deck.relative.parent).encode("utf-8", "backslashreplace").decode("utf-8")
    parts = [] if folder == "." else folder.replace("\\", "/").split("/")
    case = ElementTree.SubElement(
        suite,
        "testcase",
        name=harmless(deck.name),
        classname=harmless(".".join(("decks", *parts))).strip("."),
        time=f"{finding.seconds:.6f}",
    )
    if finding.state in (*_FAILURES, *_ERRORS):
        kind = "failure" if finding.state in _FAILURES else "error"
        lines = comparison.reasons(finding)
        about = ElementTree.SubElement(case, kind, type=finding.state.value, message=lines[0])
        about.text = "\n".join(lines)
