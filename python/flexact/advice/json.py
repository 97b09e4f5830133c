# SPDX-License-Identifier: BSD-3-Clause
"""What advice is made of, as the JSON has it: `docs/advice.schema.json`."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from ..analysis.change import Change
from ..analysis.json import header
from ..analysis.naming import filled
from ..analysis.result import Result
from ..analysis.screws import ScrewKind
from ..core.arrays import FloatArray
from .causes.cause import Cause, CauseKind
from .motions import AdvisedMotion, AdvisedStress, MovingBody
from .releases.releases import Sets
from .spaces.screws import ScrewSpace
from .spaces.spaces import Spaces, spaces_lines
from .step import Purpose, Step

Entries = dict[str, Any]

#: What is said of the empty set.
_NOTHING = {
    Purpose.RELEASE: "Nothing is stopped twice.",
    Purpose.DECLARE: "Nothing is free that is not declared.",
}


def line_of(result: Result, advice: Entries) -> Entries:
    """What `flexact advise --json` prints of a deck."""
    return {
        **header(result.name),
        "verdict": result.verdict.value,
        "under_constrained": result.under_constrained,
        "over_constrained": result.over_constrained,
        "advice": advice,
    }


def of_spaces(result: Result, spaces: Spaces, wanted: Sequence[str]) -> Entries:
    """Freedom and constraint of a body."""
    return {
        "body": spaces.subject.name,
        "wanted": list(wanted),
        "freedom": of_space(spaces.freedom),
        "constraint": of_space(spaces.constraint),
        "statements": [" ".join(filled(line).split()) for line in spaces_lines(result, spaces)],
    }


def of_space(space: ScrewSpace) -> Entries:
    """A space: its basis and its families."""
    return {
        "dimension": space.dimension,
        "about": space.about.tolist(),
        "basis": space.basis.tolist(),
        "families": [
            {
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
            for family in space.families
        ],
    }


def _vector(vector: FloatArray) -> list[float] | None:
    return vector.tolist() if np.any(vector) else None


def of_sets(places: str, sets: Sets, told: Collection[tuple[Purpose, Change]]) -> Entries:
    """Sets of releases or declarations.

    Args:
        places: Of "deformations" or of "coordinates".
        sets: The sets.
        told: Purpose and change of the steps of which the words can be said.
    """
    return {
        "size": sets.size,
        "count": sets.count if sets.is_counted else None,
        "doubtful": sets.doubtful if sets.is_counted else None,
        "sets": [
            {
                places: [[number, place] for number, place, _ in getattr(one.change, places)],
                "condition": _finite(one.condition),
                "statement": one.statement
                if (one.purpose, one.change) in told
                else _NOTHING[one.purpose],
            }
            for one in sets.sets
        ],
    }


def of_motion(each: AdvisedMotion) -> Entries:
    """A motion."""
    return {
        "extent": each.extent.kind.value,
        "evidence": each.extent.evidence.value,
        "internal": each.internal,
        "bodies": [_body(body) for body in each.bodies],
        "cause": _cause(each.cause),
        "statement": each.statement,
    }


def _body(body: MovingBody) -> Entries:
    """A moving body; of a translation there is neither point nor pitch."""
    screw = body.screw
    turns = screw.kind is not ScrewKind.TRANSLATION
    return {
        "name": body.name,
        "kind": screw.kind.value,
        "axis": screw.direction.tolist(),
        "point": screw.point.tolist() if turns else None,
        "pitch": _finite(screw.pitch) if turns else None,
    }


def of_self_stress(each: AdvisedStress) -> Entries:
    """A self-stress."""
    return {"cause": _cause(each.cause), "statement": each.statement}


def _cause(cause: Cause) -> str | None:
    """Generic or special; None where it was not looked for."""
    return None if cause.kind is CauseKind.UNKNOWN else cause.kind.value


def of_step(step: Step) -> Entries:
    """A step."""
    return {
        "number": step.number,
        "purpose": step.purpose.value,
        "statement": step.statement,
        "condition": _finite(step.condition),
        "change": _change(step.change),
        "alternatives": [_change(each) for each in step.alternatives],
        "after": {**step.after._asdict(), "verdict": step.after.verdict.value},
    }


def _change(change: Change) -> Entries:
    return {
        "deformations": [[*place, given.name.lower()] for *place, given in change.deformations],
        "coordinates": [[*place, given.name.lower()] for *place, given in change.coordinates],
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


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
