# SPDX-License-Identifier: BSD-3-Clause
"""Findings as JUnit XML, which servers of continuous integration show.

Both common schemas hold, that of Apache Ant and that of Jenkins' xUnit plugin.
"""

from __future__ import annotations

import socket
import time
from collections.abc import Iterable, Sequence
from xml.etree import ElementTree

from ...util.decks import DeckFile
from ...util.plain_text import harmless
from .comparison import Finding, State, reasons

#: States that are failures of a test, and errors in it.
_FAILURES, _ERRORS = (State.DIFFERENT,), (State.FAILED, State.MISSING)


def junit_xml(found: Sequence[tuple[DeckFile, Finding]], seconds: float, start: float) -> bytes:
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
        failures=str(_count(found, _FAILURES)),
        errors=str(_count(found, _ERRORS)),
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


def _count(found: Iterable[tuple[DeckFile, Finding]], states: tuple[State, ...]) -> int:
    return sum(finding.state in states for _, finding in found)


def _add(suite: ElementTree.Element, deck: DeckFile, finding: Finding) -> None:
    case = ElementTree.SubElement(
        suite,
        "testcase",
        name=harmless(deck.name),
        classname=harmless(".".join(("decks", *_name(deck.relative.parent).split("/")))).strip("."),
        time=f"{finding.seconds:.6f}",
    )
    if finding.state in (*_FAILURES, *_ERRORS):
        kind = "failure" if finding.state in _FAILURES else "error"
        lines = reasons(finding)
        about = ElementTree.SubElement(case, kind, type=finding.state.value, message=lines[0])
        about.text = "\n".join(lines)


def _name(folder: object) -> str:
    text = str(folder).encode("utf-8", "backslashreplace").decode("utf-8")
    return "" if text == "." else text.replace("\\", "/")
