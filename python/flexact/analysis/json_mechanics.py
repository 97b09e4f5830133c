# SPDX-License-Identifier: BSD-3-Clause
"""Motions of bodies and stresses of parts as the JSON has them, and the parts themselves."""

from __future__ import annotations

from typing import Any

from ..core.arrays import FloatArray
from ..model.parts.parts import Part, PartKind
from .body_motions import BodyMotion
from .carriers import Joint
from .mode_words import moments_at_ends
from .part_stresses import Conflict, PartStress
from .places import place_words
from .result import Result
from .screws import Screw, ScrewKind
from .wrenches import Wrench

#: With more elements than these the parts are not listed.
_MOST_ELEMENTS = 10_000

Entries = dict[str, Any]


def parts(result: Result) -> list[Entries] | None:
    """Sheets, wires, bars, bodies and hinges by their names; None of a large model."""
    arrays = result.given.arrays
    if arrays.element_number.size > _MOST_ELEMENTS:
        return None
    return [
        {
            "name": part.name,
            "kind": part.kind.value,
            "elements": arrays.element_number[list(part.elements)].tolist(),
            "nodes": arrays.node_number[list(part.ends)].tolist(),
        }
        for part in result.parts.all
    ]


def taken_as_one(result: Result) -> list[Entries] | None:
    """Parts of several beams that are one beam each in D(c); None of a large model."""
    if not result.is_told_by_parts:
        return None
    number = result.given.arrays.element_number
    return [
        {
            "part": result.parts.of_element(chain.elements[0]).name,
            "elements": number[list(chain.elements)].tolist(),
        }
        for chain in result.condensed.chains
    ]


def internal_motions(result: Result) -> Entries | None:
    """Motions inside of divided sheets and wires; None where nothing of them is undeclared."""
    whole = result.with_internal_declared
    if whole is None:
        return None
    inside = {part.name: None for motion in result.motions for part in motion.internal_to}
    return {
        "count": result.internal_motions,
        "parts": list(inside),
        "declared": {
            "under_constrained": whole.under_constrained,
            "over_constrained": whole.over_constrained,
        },
    }


def of_motion(result: Result, index: int) -> Entries:
    """What bodies and joints do in a motion."""
    if not result.is_told_by_parts:
        return {}
    motion = result.motions[index]
    return {
        "bodies": [_moving(each) for each in motion.bodies],
        "internal_to": [part.name for part in motion.internal_to],
    }


def of_self_stress(result: Result, index: int) -> Entries:
    """What parts carry in a self-stress, and what they press on."""
    if not result.is_told_by_parts:
        return {}
    stress = result.self_stresses[index]
    return {
        "parts": [_stressed(result, index, each) for each in stress.parts],
        "conflicts": [_conflict(each) for each in stress.conflicts],
    }


def _moving(group: BodyMotion) -> Entries:
    return {
        "bodies": [part.name for part in group.bodies],
        "joints": [str(joint) for joint in group.joints],
        **_screw(group.screw),
    }


def _screw(screw: Screw) -> Entries:
    turns = screw.kind is not ScrewKind.TRANSLATION
    return {
        "kind": screw.kind.value,
        "direction": screw.direction.tolist(),
        "point": _vector(screw.point, "m") if turns else None,
        "pitch": {"value": screw.pitch, "unit": "m/rad"} if turns else None,
        "magnitude": {"value": screw.magnitude, "unit": "rad" if turns else "m"},
    }


def _stressed(result: Result, index: int, one: PartStress) -> Entries:
    moments: Entries = {}
    if one.part.kind is PartKind.SHEET and len(one.ends) == 2:
        moments = {
            quantity: [{"value": value, "unit": "N m"} for value in values]
            for quantity, values in moments_at_ends(result.self_stresses[index], one).items()
        }
    return {
        "part": one.part.name,
        "ends": [_end(result, one, end.position) for end in one.ends],
        "normal_force": {"value": one.normal_force, "unit": "N"},
        "twist_moment": {"value": one.twist_moment, "unit": "N m"},
        "shear_force": _vector(one.shear_force, "N"),
        "moments": [_vector(moment, "N m") for moment in one.moments],
        **moments,
    }


def _end(result: Result, one: PartStress, position: int | None) -> Entries:
    """An end of a part, in the order of its moments."""
    if position is None:
        return {"node": None, "words": ""}
    number = int(result.given.arrays.node_number[position])
    return {"node": number, "words": place_words(result.parts, position, one.part)}


def _conflict(conflict: Conflict) -> Entries:
    over = conflict.over
    return {
        "on": _called(conflict.on),
        "over": None
        if over is None
        else {
            "kind": over.kind.value,
            "direction": over.direction.tolist(),
            "point": _vector(over.point, "m"),
        },
        "loads": [
            {"part": None if load.part is None else load.part.name, **_wrench(load.wrench)}
            for load in conflict.loads
        ],
    }


def _called(on: Part | Joint) -> str:
    return str(on)


def _wrench(wrench: Wrench) -> Entries:
    return {
        "kind": wrench.kind.value,
        "force": _vector(wrench.force, "N"),
        "moment": _vector(wrench.moment, "N m"),
        "about": _vector(wrench.about, "m"),
    }


def _vector(vector: FloatArray, unit: str) -> Entries:
    return {"value": vector.tolist(), "unit": unit}
