# SPDX-License-Identifier: BSD-3-Clause
"""What a design costs as the JSON has it: `docs/cost.schema.json`."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from ..core.arrays import FloatArray
from ..util.version import VERSION
from .designs import CostValues, Design, Effect, StrokeCurve
from .json import stiffness_unit
from .values import Clamp, Misalignment, Number, Numbers, Tolerance

#: Of the JSON of a cost; raised where an entry is taken away, renamed, or means something else.
FORMAT = 1


def dictionary_of(cost: CostValues) -> dict[str, Any]:
    """The names and values of the JSON, in their order; what is infinite is null."""
    deck = cost.name.encode("utf-8", "backslashreplace").decode("utf-8")
    return {
        "format": FORMAT,
        "deck": deck,
        "flexact": VERSION,
        "choice": {
            "held": cost.held,
            "drive": cost.drive,
            "beams": cost.beams,
            "shift": cost.shift,
            "measure": cost.measure,
        },
        "point": cost.point._asdict(),
        "directions": list(cost.directions),
        "clamps": [_clamp(each) for each in cost.clamps],
        "stroke": None if cost.stroke is None else _stroke(cost),
        "misaligned": [
            {**_where(each), "value": value, "unit": each.unit} for each, value in cost.misaligned
        ],
        "designs": [_design(cost, each) for each in cost.designs],
        "left_out": list(cost.left_out),
    }


def text_of(cost: CostValues) -> str:
    """The same as one line of text."""
    return json.dumps(dictionary_of(cost), allow_nan=False)


def _design(cost: CostValues, design: Design) -> dict[str, Any]:
    kept = design.kept
    return {
        "label": design.label,
        "released": [each._asdict() for each in design.released],
        "alike": list(design.alike),
        "under_constrained": design.under_constrained,
        "over_constrained": design.over_constrained,
        "compliance": _numbers(design.compliance),
        "kept": None
        if kept is None
        else {"mu": _numbers(kept.mu), "worst": kept.worst.tolist(), "words": kept.words},
        "frequencies": None
        if design.frequencies is None
        else {**_numbers(design.frequencies), "unit": "Hz", "is_drive": list(design.is_drive)},
        "tightest": _maybe(design.tightest),
        "buckles_at": _maybe(design.buckles_at),
        "tolerances": [_tolerance(each) for each in design.tolerances],
        "curve": None
        if design.curve is None
        else {
            **_where(design.curve.misalignment),
            "unit": design.curve.misalignment.unit,
            "values": design.curve.values.tolist(),
            "measure": _numbers(design.curve.measure),
        },
        "stroke": None if design.stroke is None else _along(cost, design.stroke),
        "effect": None if design.effect is None else _effect(cost, design.effect),
        "remarks": list(design.remarks),
    }


def _stroke(cost: CostValues) -> dict[str, Any]:
    made = cost.stroke
    assert made is not None
    return {
        "node": made.node,
        "coordinate": made.coordinate,
        "words": made.words,
        "unit": made.unit,
        "rest": made.rest,
        "asked": list(made.asked),
        "reached": list(made.reached),
        "why": made.why,
    }


def _along(cost: CostValues, curve: StrokeCurve) -> dict[str, Any]:
    return {
        "values": curve.values.tolist(),
        "stiffness": {**_numbers(curve.stiffness), "units": _units(cost)},
        "kept": _numbers(curve.kept),
        "drive_stiffness": _numbers(curve.drive_stiffness),
        "force": _numbers(curve.force),
        "frequencies": _numbers_or_null(curve.frequencies),
        "parasitic": _numbers_or_null(curve.parasitic),
        "is_stable": list(curve.is_stable),
        "under_constrained": list(curve.under_constrained),
        "over_constrained": list(curve.over_constrained),
    }


def _effect(cost: CostValues, effect: Effect) -> dict[str, Any]:
    return {
        "frequencies": _numbers_or_null(effect.frequencies),
        "stiffness": {**_numbers(effect.stiffness), "units": _units(cost)},
        "energy": _numbers(effect.energy),
        "resultants": _numbers(effect.resultants),
        "peak": _numbers_or_null(effect.peak),
        "where": effect.where,
        "kept": _number(effect.kept),
        "is_stable": effect.is_stable,
        "reached": effect.reached,
    }


def _units(cost: CostValues) -> list[str]:
    return [stiffness_unit(each) for each in cost.directions]


def _maybe(tolerance: Tolerance | None) -> dict[str, Any] | None:
    return None if tolerance is None else _tolerance(tolerance)


def _tolerance(each: Tolerance) -> dict[str, Any]:
    return {
        **_where(each.misalignment),
        "unit": each.misalignment.unit,
        "negative": _number(each.negative),
        "positive": _number(each.positive),
        "critical_negative": _number(each.critical_negative),
        "critical_positive": _number(each.critical_positive),
    }


def _where(each: Misalignment) -> dict[str, Any]:
    return {"clamp": each.clamp.node, "direction": each.direction, "about": each.about}


def _clamp(each: Clamp) -> dict[str, Any]:
    return {"node": each.node, "orientation": each.orientation, "words": each.words}


def _number(number: Number) -> dict[str, Any]:
    value = number.value if math.isfinite(number.value) else None
    return {"value": value, "uncertainty": number.uncertainty}


def _numbers(numbers: Numbers) -> dict[str, Any]:
    return {"value": _finite(numbers.value), "uncertainty": _finite(numbers.uncertainty)}


def _numbers_or_null(numbers: Numbers | None) -> dict[str, Any] | None:
    return None if numbers is None else _numbers(numbers)


def _finite(array: FloatArray) -> list[Any]:
    """Nested lists, with null in place of what is infinite."""
    return np.where(np.isfinite(array), array, None).tolist()  # type: ignore[call-overload, no-any-return]
