# SPDX-License-Identifier: BSD-3-Clause
"""Advice as the JSON has it: `docs/advice.schema.json`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..advice.change import Change
from ..advice.proposal import Proposal
from ..text.advising.spaces import spaces_lines
from ..text.json_result import header
from ..text.sentences import plain
from .motions import AdvisedMotion, dictionary_of_body
from .steps import Step

if TYPE_CHECKING:
    from .advice import Advice

Entries = dict[str, Any]


def line_of(advice: Advice) -> Entries:
    """What `flexact advise --json` prints of a deck."""
    result = advice.analysis
    return {
        **header(result.name),
        "verdict": result.verdict.value,
        "under_constrained": result.under_constrained,
        "over_constrained": result.over_constrained,
        "advice": dictionary_of(advice),
    }


def dictionary_of(advice: Advice) -> Entries:
    """The names and values of the JSON, in their order."""
    step_of = {id(step.proposal): step for step in advice.steps}
    releases, declarations = advice.releases, advice.declarations
    return {
        "releases": {
            "size": releases.size,
            "count": releases.count,
            "sets": [
                {
                    "deformations": [[e, number] for e, number, _ in one.change.deformations],
                    **_said(one, step_of),
                }
                for one in releases.sets
            ],
        },
        "declarations": {
            "size": declarations.size,
            "count": declarations.count,
            "sets": [
                {
                    "coordinates": [[node, name] for node, name, _ in one.change.coordinates],
                    **_said(one, step_of),
                }
                for one in declarations.sets
            ],
        },
        "motions": [_motion(each) for each in advice.motions],
        "self_stresses": [
            {"cause": each.cause.kind.value, "statement": each.statement}
            for each in advice.self_stresses
        ],
        "spaces": _spaces(advice),
        "steps": [_step(each) for each in advice.steps],
    }


def _said(one: Proposal, step_of: dict[int, Step]) -> Entries:
    return {"condition": _finite(one.condition), "statement": step_of[id(one)].statement}


def _motion(each: AdvisedMotion) -> Entries:
    return {
        "extent": each.extent.kind.value,
        "evidence": each.extent.evidence.value,
        "internal": each.internal,
        "bodies": [dictionary_of_body(body) for body in each.bodies],
        "cause": each.cause.kind.value,
        "statement": each.statement,
    }


def _spaces(advice: Advice) -> Entries | None:
    spaces = advice.spaces
    if spaces is None:
        return None
    return {
        "body": spaces.body.name,
        "wanted": list(advice.wanted),
        "freedom": _finite_rows(spaces.freedom.basis),
        "constraint": _finite_rows(spaces.constraint.basis),
        "lines": [plain(line.head) for line in spaces_lines(advice.analysis, spaces)],
    }


def _finite_rows(basis: Any) -> list[list[float]]:
    rows: list[list[float]] = basis.tolist()
    return rows


def _step(step: Step) -> Entries:
    return {
        "number": step.number,
        "purpose": step.purpose.value,
        "statement": step.statement,
        "condition": _finite(step.condition),
        "change": _change(step.change),
        "alternatives": [_change(each) for each in step.alternatives],
        "after": {
            "verdict": step.after.verdict.value,
            "under_constrained": step.after.under_constrained,
            "over_constrained": step.after.over_constrained,
            "smallest": step.after.smallest,
        },
    }


def _change(change: Change) -> Entries:
    return {
        "deformations": [[e, number, given.name.lower()] for e, number, given in change.deformations],
        "coordinates": [[node, name, given.name.lower()] for node, name, given in change.coordinates],
        "places": [[node, list(place)] for node, place in change.places],
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
