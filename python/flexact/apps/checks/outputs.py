# SPDX-License-Identifier: BSD-3-Clause
"""What was found, for other programs: GitHub's annotations, SARIF, the JSON of check, JUnit XML.

What each code of a finding means is said here too, whatever the deck: a title, and what mends it.

Annotations are "Workflow commands for GitHub Actions" of GitHub's documentation.
"""

from __future__ import annotations

import hashlib
import re
import socket
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import PurePath
from typing import Any
from urllib.parse import quote
from xml.etree import ElementTree

from ...deck.diagnostics import Diagnostic, Place, Problems, Severity
from ...util.decks import DeckFile
from ...util.loading import VERSION
from ...util.text import harmless
from .comparison import Comparison, State
from .findings import Finding, Region, from_root

HOME = "https://github.com/flexact/flexact"
_DOCS = f"{HOME}/blob/main/docs"
_DECKS, _VERDICT, _COMMAND = "decks.md", "verdict.md", "command.md#check"


#: By the code; verdicts and doubts stand behind mistakes of decks.
_RULES: dict[str, tuple[str, str]] = {
    "bad-colour": (
        "A colour of a picture option is none.",
        "Give three numbers from 0 to 1, for red, green and blue.",
    ),
    "bad-comment": (
        "A semicolon opens a comment in the picture block alone.",
        "Open the comment with % or #.",
    ),
    "bad-number": ("A word stands where a number is wanted.", "Write a number, such as 1.5e-3."),
    "bad-opacity": (
        "The opacity of a picture option is none.",
        "Give a number from 0, which cannot be seen, to 1.",
    ),
    "bad-orientation": (
        "Euler parameters describe no orientation, or their norm is not 1.",
        "Write four parameters whose squares add up to 1, or 1 0 0 0 for none.",
    ),
    "bad-size": (
        "A size of a cross-section is not positive, so that the option is left out.",
        "Give every size of the cross-section in the units of the deck, above zero.",
    ),
    "bad-units": ("The units of a deck are none.", "Write UNITS m, or UNITS mm."),
    "beside-rigid-link": (
        "An element lies beside a rigid link and joins what that joins already.",
        "Take one of the two away, or join the element to other nodes.",
    ),
    "class-conflict": (
        "One coordinate or deformation is given two classes.",
        "Keep one of the two statements, or name other components.",
    ),
    "coincident-nodes": (
        "Two nodes at one place are not joined.",
        "Let the elements share one node if they are meant to be joined there.",
    ),
    "component-out-of-range": (
        "A node or an element has no component of this number.",
        "See which coordinates the node, or deformations the element, has.",
    ),
    "duplicate-element": (
        "The number of an element is used twice.",
        "Give each element a number of its own.",
    ),
    "inconsistent-model": (
        "The arrays of a model do not fit together.",
        "Give every element nodes of the kinds that it joins.",
    ),
    "length-out-of-range": (
        "An element is too long or too short to compute with.",
        "Look at its coordinates; lengths are in m.",
    ),
    "lengths-differ": (
        "Lengths of elements differ by many powers of ten.",
        "Look whether all coordinates are in m.",
    ),
    "long-sheet": (
        "A sheet or wire is longer than 5 m.",
        "Look whether its coordinates are in m, and not in mm.",
    ),
    "missing-end": (
        "END is missing before a statement of the next block.",
        "Write END in the line before.",
    ),
    "missing-operand": (
        "A statement needs more operands.",
        "Give all operands that the keyword takes.",
    ),
    "nearly-equal-components": (
        "A difference of rounding chooses the local y axis of an element.",
        "Give the vector that the axis is towards.",
    ),
    "negative-number": (
        "A quantity that is not negative as a rule is less than zero.",
        "Correct it, unless it is meant.",
    ),
    "no-coordinate": (
        "Component 1 of an orientation is no coordinate of its own.",
        "Name the rotations 2, 3 and 4.",
    ),
    "no-meaning": (
        "A statement has no meaning where it stands, and is not used.",
        "Remove it, or name what it is meant for.",
    ),
    "no-such-element": (
        "A statement names an element that no statement makes.",
        "Correct the number, or make the element.",
    ),
    "no-such-node": (
        "A statement names a node that no element uses.",
        "Correct the number, or join an element to the node.",
    ),
    "no-support": (
        "Nothing is fixed, so that the mechanism can move as a whole.",
        "Fix the points that are clamped (FIX).",
    ),
    "not-covered": (
        "A statement states something that Flexact does not analyse.",
        "Leave the statement out, or put elements that Flexact knows in its place.",
    ),
    "not-finite": (
        "A coordinate or an axis is not finite.",
        "Give finite numbers.",
    ),
    "not-read": (
        "What stands behind the second END is not read.",
        "Move the statements before it, or remove them.",
    ),
    "not-text": ("The file is no text.", "Save the deck as UTF-8 or plain ASCII text."),
    "not-used": (
        "Statements that the analysis has no use for are not used.",
        "Nothing need be done: they are for other programs.",
    ),
    "not-whole": ("A number that counts is not whole.", "Write a whole number."),
    "nothing-to-analyse": (
        "There are no elements.",
        "State at least one element, such as TRUSS 1 1 2.",
    ),
    "number-too-large": ("A number is too large.", "Give a number that can be stored."),
    "parallel-vector": (
        "The y vector of an element is parallel to it.",
        "Give a vector across the line from p to q.",
    ),
    "repeated-name": (
        "Two parts or points have one name.",
        "Give each a name of its own, so that words tell them apart.",
    ),
    "repeated-value": (
        "The same is given twice; the last one counts.",
        "Remove one of the two statements.",
    ),
    "same-node": ("Both ends of an element are one node.", "Give the two ends different nodes."),
    "same-part-twice": (
        "Two elements are the same part twice.",
        "Remove one of them, unless both are there.",
    ),
    "surplus-operand": (
        "A statement has more operands than its keyword takes.",
        "Remove what is too much, or begin a comment with %.",
    ),
    "thick-section": (
        "An element is thicker than it is long.",
        "Look whether its section is in m.",
    ),
    "two-kinds-of-node": (
        "One node is used as a position and as an orientation.",
        "Give positions and orientations nodes of their own.",
    ),
    "unknown-cross-section": (
        "A cross-section is not known; the option is left out.",
        "Name one of those that the deck language has.",
    ),
    "unknown-keyword": (
        "A word is no keyword of its block.",
        "Correct it, or make the line a comment with %.",
    ),
    "unlikely-density": (
        "A density is that of no solid.",
        "Give densities in kg/m3, and EM of a beam in kg/m.",
    ),
    "unlikely-expansion": (
        "A coefficient of expansion is that of no solid.",
        "Give it in 1/K, such as 12e-6.",
    ),
    "unlikely-gravity": (
        "Free fall is a thousand times that on Earth, or a thousandth.",
        "Give it in m/s2, or in mm/s2 where the deck is in mm.",
    ),
    "unlikely-modulus": (
        "A modulus of elasticity is that of no solid.",
        "Give E in Pa, and EA in N.",
    ),
    "unlikely-strength": (
        "A strength is that of no solid, or below that of fatigue.",
        "Give strengths in Pa, or in MPa where the deck is in mm.",
    ),
    "unused-node": (
        "A fixed point that no element uses is left out.",
        "Remove it, or join an element to it.",
    ),
    "warping": (
        "A beam with warping is analysed as one without.",
        "Nothing need be done where warping holds no motion.",
    ),
    "wrong-block": (
        "A statement stands in another block than it belongs in.",
        "Move it before or behind END.",
    ),
    "zero-length": ("An element has zero length.", "Give its ends different places."),
    "zero-vector": ("A vector is zero.", "Give a vector that has a direction."),
    "cannot-read": ("A deck or a folder cannot be read.", "Check that it may be read."),
    "empty-deck": ("The deck is empty.", "State at least one element, such as TRUSS 1 1 2."),
    "is-a-folder": ("A folder stands where a deck is wanted.", "Name a deck in it."),
    "no-decks": ("A folder holds no decks.", "Name a folder with decks, *.dat."),
    "no-such-file": ("There is no such file.", "Check its name and its folder."),
    "not-a-file": ("This is no regular file.", "Write the deck to a file first."),
    "step-file": ("A STEP file stands where a deck is wanted.", "Make a deck: flexact convert."),
    "too-large": ("The deck is too large.", "Divide the mechanism, or use more memory."),
    "more-problems": ("There are more problems.", "Mend those that are shown first."),
    "not-analysed": ("The deck could not be analysed.", "The message says what to do."),
    "out-of-memory": ("There is not enough memory.", "Analyse with --method sparse."),
    "unforeseen": ("Flexact stumbles over the deck.", "Report it, with the deck."),
    "not-written": ("Results could not be written.", "Look at the folder that was named."),
    "failed": ("The deck could not be taken.", "The message says what to do."),
}
_VERDICTS: dict[str, tuple[str, str]] = {
    "under-constrained": (
        "A motion is held by nothing and is not declared as a degree of freedom.",
        "Stop the motion, or declare it independent (DYNX, DYNE). "
        "flexact advise finds and tries what mends it.",
    ),
    "over-constrained": (
        "A self-stress can exist without any load: one motion is stopped more than once.",
        "Release one deformation (RLSE), or free a support, for each self-stress. "
        "flexact advise finds and tries what mends it.",
    ),
    "not-as-expected": (
        "The verdict is not the expected one.",
        "Correct the design, or what is expected (--expect).",
    ),
    "small-margin": (
        "The mechanism is exactly constrained by less than the workshop can hold.",
        "Move away from the place where a small misalignment changes the verdict.",
    ),
    "close-decision": (
        "The rank of D(c) is decided by a singular value close to the limit.",
        "Look at the margin, and at the geometry; far from the origin, move it there.",
    ),
    "given-tolerance": (
        "Singular values count as zero because of the tolerance that was given.",
        "Leave --tolerance out, or look whether it is meant.",
    ),
    "rounded-coordinates": (
        "Singular values count as zero because the coordinates have few digits.",
        "Give the coordinates with all their digits.",
    ),
    "rounded-geometry": (
        "A rounding of the deck's own digits explains the verdict.",
        "Give the geometry with all its digits.",
    ),
    "unconfirmed-rank": (
        "No second route confirmed the rank.",
        "Analyse with the method svd.",
    ),
}
#: Codes of which this module says what they mean.
CODES = frozenset((*_RULES, *_VERDICTS))
#: Mistakes that no deck has, so that the page of the command tells more of them.
_OF_FILES = frozenset(
    ("cannot-read", "is-a-folder", "no-decks", "no-such-file", "not-a-file", "failed")
)


SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)
#: What relative addresses start from, as CodeQL calls it.
_ROOT = "%SRCROOT%"
_HEX = 16


def log_of(findings: Sequence[Finding], exit_code: int, *, ended_well: bool) -> dict[str, Any]:
    """The log of one run.

    Args:
        findings: All that was found, deck after deck.
        exit_code: What the command exits with.
        ended_well: Whether nothing but the decks themselves stood in the way.
    """
    codes = list(dict.fromkeys(finding.code for finding in findings))
    seen: Counter[str] = Counter()
    run = {
        "tool": {
            "driver": {
                "name": "Flexact",
                "version": VERSION,
                "semanticVersion": VERSION,
                "informationUri": HOME,
                "rules": [_rule(code, findings) for code in codes],
            }
        },
        "invocations": [{"executionSuccessful": ended_well, "exitCode": exit_code}],
        "originalUriBaseIds": {
            _ROOT: {"description": {"text": "The root of the repository that holds the decks."}}
        },
        "columnKind": "utf16CodeUnits",
        "results": [_result(finding, codes.index(finding.code), seen) for finding in findings],
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _rule(code: str, findings: Sequence[Finding]) -> dict[str, Any]:
    """What a code means."""
    page = _VERDICT if code in _VERDICTS else _COMMAND if code in _OF_FILES else _DECKS
    other = f"{code.replace('-', ' ').capitalize()}.", "See the message."
    title, help_ = {**_RULES, **_VERDICTS}.get(code, other)
    gravest = {finding.severity for finding in findings if finding.code == code}
    level = next(severity for severity in Severity if severity in gravest)
    return {
        "id": code,
        "shortDescription": {"text": title},
        "fullDescription": {"text": title},
        "help": {"text": help_, "markdown": help_},
        "helpUri": f"{_DOCS}/{page}",
        "defaultConfiguration": {"level": level.value},
    }


def _result(finding: Finding, index: int, seen: Counter[str]) -> dict[str, Any]:
    words = f"{finding.message}\nHelp: {finding.help}" if finding.help else finding.message
    made = {
        "ruleId": finding.code,
        "ruleIndex": index,
        "level": finding.severity.value,
        "message": _text(words),
        "locations": [_location(finding, finding.region)],
        "partialFingerprints": {"primaryLocationLineHash": _fingerprint(finding, seen)},
    }
    if finding.related:
        made["relatedLocations"] = [
            {"id": number, **_location(finding, region), "message": _text(message)}
            for number, (region, message) in enumerate(finding.related, start=1)
        ]
    return made


def _text(words: str) -> dict[str, str]:
    """Words as they are: what stands in brackets would be a link (SARIF 2.1.0, 3.11.6)."""
    return {"text": re.sub(r"([\\\[\]])", r"\\\1", words)}


def _location(finding: Finding, region: Region | None) -> dict[str, Any]:
    path = from_root(finding.deck)
    # A colon in the first part would make it a scheme.
    uri = {"uri": quote(path.encode("utf-8", "surrogateescape")), "uriBaseId": _ROOT}
    if PurePath(path).is_absolute():
        uri = {"uri": PurePath(path).as_uri()}
    # GitHub shows no result without a line.
    where = {"startLine": 1}
    if region is not None:
        where = dict(zip(("startLine", "startColumn", "endColumn"), region, strict=True))
    return {"physicalLocation": {"artifactLocation": uri, "region": where}}


def _fingerprint(finding: Finding, seen: Counter[str]) -> str:
    """The same when lines move and blanks or comments change; equal ones of a deck are counted."""
    text = "\0".join((finding.code, finding.statement))
    made = hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()[:_HEX]
    seen[f"{finding.deck}\0{made}"] += 1
    return f"{made}:{seen[f'{finding.deck}{chr(0)}{made}']}"


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
        f"line {region.line}: {message}"
        for region, message in finding.related
        if message not in finding.message
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
    (State.DIFFERENT,),
    (State.FAILED, State.MISSING),
)


def junit_xml(found: Sequence[tuple[DeckFile, Comparison]], seconds: float, start: float) -> bytes:
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
    return bytes(ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)) + b"\n"


def _add(suite: ElementTree.Element, deck: DeckFile, finding: Comparison) -> None:
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
        lines = finding.reasons
        about = ElementTree.SubElement(case, kind, type=finding.state.value, message=lines[0])
        about.text = "\n".join(lines)
