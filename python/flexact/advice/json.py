# SPDX-License-Identifier: BSD-3-Clause
"""Advice as the JSON has it: `docs/advice.schema.json`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis.change import Change
from ..analysis.json import header
from ..analysis.naming import filled
from ..analysis.result import Result
from ..core.arrays import FloatArray
from ..core.elements import Class
from .causes.cause import Cause, CauseKind
from .left_out import left_out
from .motions import AdvisedMotion, dictionary_of_body
from .proposal import Proposal, Purpose
from .spaces.screws import Family, ScrewSpace
from .spaces.spaces import Spaces
from .spaces.words import spaces_lines
from .steps import Step

if TYPE_CHECKING:
    from .advice import Advice


Entries = dict[str, Any]


def dictionary_of_spaces(result: Result, spaces: Spaces, wanted: Sequence[str]) -> Entries:
    """The names and values of the JSON, in their order."""
    return {
        "body": spaces.subject.name,
        "wanted": list(wanted),
        "freedom": _space(spaces.freedom),
        "constraint": _space(spaces.constraint),
        "statements": [" ".join(filled(line).split()) for line in spaces_lines(result, spaces)],
    }


def _space(space: ScrewSpace) -> Entries:
    return {
        "dimension": space.dimension,
        "about": space.about.tolist(),
        "basis": space.basis.tolist(),
        "families": [_family(family) for family in space.families],
    }


def _family(family: Family) -> Entries:
    return {
        "kind": family.kind.value,
        "point": family.point.tolist(),
        "direction": _vector(family.direction),
        "normal": _vector(family.normal),
        "pitch": family.pitch,
        "lines": [
            [point.tolist(), along.tolist()]
            for point, along in zip(family.points, family.directions, strict=True)
        ],
    }


def _vector(vector: FloatArray) -> list[float] | None:
    made: list[float] = vector.tolist()
    return made if np.any(vector) else None


#: What is said of the empty set.
_NOTHING = {
    Purpose.RELEASE: "Nothing is stopped twice.",
    Purpose.DECLARE: "Nothing is free that is not declared.",
}


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
            "doubtful": releases.doubtful,
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
            "doubtful": declarations.doubtful,
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
            {"cause": _cause(each.cause), "statement": each.statement}
            for each in advice.self_stresses
        ],
        "spaces": _spaces(advice),
        "steps": [_step(each) for each in advice.steps],
        "left_out": list(left_out(advice)),
    }


def _said(one: Proposal, step_of: dict[int, Step]) -> Entries:
    step = step_of.get(id(one))
    statement = step.statement if step is not None else _NOTHING[one.purpose]
    return {"condition": _finite(one.condition), "statement": statement}


def _motion(each: AdvisedMotion) -> Entries:
    return {
        "extent": each.extent.kind.value,
        "evidence": each.extent.evidence.value,
        "internal": each.internal,
        "bodies": [dictionary_of_body(body) for body in each.bodies],
        "cause": _cause(each.cause),
        "statement": each.statement,
    }


def _cause(cause: Cause) -> str | None:
    """Generic or special; None where it was not looked for."""
    return None if cause.kind is CauseKind.UNKNOWN else cause.kind.value


def _spaces(advice: Advice) -> Entries | None:
    spaces = advice.spaces
    if spaces is None:
        return None
    return dictionary_of_spaces(advice.analysis, spaces, advice.wanted)


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
        "deformations": [[e, number, _class(given)] for e, number, given in change.deformations],
        "coordinates": [[node, name, _class(given)] for node, name, given in change.coordinates],
        "places": [[node, list(place)] for node, place in change.places],
        "vectors": [[element, list(vector)] for element, vector in change.vectors],
        "wires": [
            {"node": wire.position, "end": list(wire.end), "ground": list(wire.ground)}
            for wire in change.wires
        ],
        "sheets": [
            {
                "node": sheet.position,
                "end": list(sheet.end),
                "ground": list(sheet.ground),
                "width": list(sheet.width),
            }
            for sheet in change.sheets
        ],
    }


def _class(given: Class) -> str:
    return given.name.lower()


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
