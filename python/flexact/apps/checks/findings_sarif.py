# SPDX-License-Identifier: BSD-3-Clause
"""Findings of a run as SARIF 2.1.0 (OASIS Standard, 2020), which services and editors show."""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from ...deck.diagnostics import Severity
from ...util.version import VERSION
from .finding import Finding, Region
from .paths import from_root
from .sarif import HOME, rule_of

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
    rule = rule_of(code)
    gravest = {finding.severity for finding in findings if finding.code == code}
    level = next(severity for severity in Severity if severity in gravest)
    return {
        "id": code,
        "shortDescription": {"text": rule.title},
        "fullDescription": {"text": rule.title},
        "help": {"text": rule.help, "markdown": rule.help},
        "helpUri": rule.page,
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
            {"id": number, **_location(finding, one.region), "message": _text(one.message)}
            for number, one in enumerate(finding.related, start=1)
        ]
    return made


def _text(words: str) -> dict[str, str]:
    """Words as they are: what stands in brackets would be a link (SARIF 2.1.0, 3.11.6)."""
    return {"text": re.sub(r"([\\\[\]])", r"\\\1", words)}


def _location(finding: Finding, region: Region | None) -> dict[str, Any]:
    physical: dict[str, Any] = {"artifactLocation": _artifact(from_root(finding.deck))}
    if region is None:
        # GitHub shows no result without a line.
        physical["region"] = {"startLine": 1}
    else:
        line, column, end = region
        physical["region"] = {"startLine": line, "startColumn": column, "endColumn": end}
    return {"physicalLocation": physical}


def _artifact(path: str) -> dict[str, str]:
    if PurePath(path).is_absolute():
        return {"uri": PurePath(path).as_uri()}
    # A colon in the first part would make it a scheme.
    return {"uri": quote(path.encode("utf-8", "surrogateescape")), "uriBaseId": _ROOT}


def _fingerprint(finding: Finding, seen: Counter[str]) -> str:
    """The same when lines move and blanks or comments change; equal ones of a deck are counted."""
    text = "\0".join((finding.code, finding.statement))
    made = hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()[:_HEX]
    seen[f"{finding.deck}\0{made}"] += 1
    return f"{made}:{seen[f'{finding.deck}{chr(0)}{made}']}"
