# SPDX-License-Identifier: BSD-3-Clause
"""What a design costs as one tidy table: a row a number."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..util.loading import VERSION
from .designs import (
    Clamp,
    CostValues,
    Design,
    Effect,
    Misalignment,
    Number,
    Numbers,
    StrokeCurve,
    Tolerance,
    unit_of_direction,
)

Cell = str | int | float

#: What the columns hold; a cell is empty where a column says nothing of a number.
HEADER = (
    *("design", "quantity", "clamp", "direction", "direction_2", "number"),
    *("stroke", "misalignment", "state", "value", "uncertainty", "unit"),
)


class Row(NamedTuple):
    """A number, and of what it is."""

    design: str
    quantity: str
    value: Cell
    uncertainty: float = 0.0
    unit: str = ""
    clamp: Cell = ""
    """Number of its node."""
    direction: str = ""
    direction_2: str = ""
    number: Cell = ""
    """From 1, of frequencies and stiffness ratios."""
    stroke: Cell = ""
    """Driven coordinate, absolute [m, rad]."""
    misalignment: Cell = ""
    """[m, rad]."""
    state: str = ""
    """"before" or "behind" given misalignments."""


def csv_text(cost: CostValues) -> str:
    """The table as CSV; numbers read back to the last bit, infinite ones are "inf"."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADER)
    for design in cost.designs:
        writer.writerows([getattr(row, name) for name in HEADER] for row in rows(cost, design))
    return text.getvalue()


def rows(cost: CostValues, design: Design) -> Iterator[Row]:
    """All numbers of a design."""
    label, directions = design.label, cost.directions
    yield Row(label, "under-constrained by", design.under_constrained)
    yield Row(label, "over-constrained by", design.over_constrained)
    for i, first in enumerate(directions):
        for j, second in enumerate(directions):
            unit = f"{'rad' if first.startswith('r') else 'm'}/{_force_unit(second)}"
            cell = _number(design.compliance, i, j)
            yield _row(label, "compliance", cell, unit, direction=first, direction_2=second)
    if design.kept is not None:
        for k, mu in enumerate(_numbers(design.kept.mu)):
            yield _row(label, "stiffness kept", mu, "1", number=k + 1)
    if design.frequencies is not None:
        for k, hertz in enumerate(_numbers(design.frequencies)):
            kind = "frequency of the drive" if design.is_drive[k] else "parasitic frequency"
            yield _row(label, kind, hertz, "Hz", number=k + 1)
    yield from _tolerances(design)
    if design.curve is not None:
        unit = "Hz" if cost.measure.endswith("frequency") else "N/m"
        for value, measure in zip(
            design.curve.values.tolist(), _numbers(design.curve.measure), strict=True
        ):
            where = _where(design.curve.misalignment)
            yield _row(label, cost.measure, measure, unit, misalignment=value, **where)
    if design.stroke is not None:
        yield from _stroke(cost, label, design.stroke)
    if design.effect is not None:
        yield from _effect(label, directions, design.effect)


def _tolerances(design: Design) -> Iterator[Row]:
    for each in design.tolerances:
        for quantity, number in (
            ("tolerance below zero", each.negative),
            ("tolerance above zero", each.positive),
            ("buckles below zero", each.critical_negative),
            ("buckles above zero", each.critical_positive),
        ):
            where = _where(each.misalignment)
            yield _row(design.label, quantity, number, each.misalignment.unit, **where)


def _where(each: Misalignment) -> dict[str, Cell]:
    return {"clamp": each.clamp.node, "direction": each.direction}


def _stroke(cost: CostValues, label: str, curve: StrokeCurve) -> Iterator[Row]:
    assert cost.stroke is not None
    along = cost.stroke.coordinate
    for k, value in enumerate(curve.values.tolist()):
        for i, direction in enumerate(cost.directions):
            stiffness = _number(curve.stiffness, k, i)
            unit = stiffness_unit(direction)
            yield _row(
                label, "support stiffness", stiffness, unit, direction=direction, stroke=value
            )
        for quantity, numbers, unit in (
            ("stiffness kept along the stroke", curve.kept, "1"),
            ("drive stiffness", curve.drive_stiffness, stiffness_unit(along)),
            ("drive force", curve.force, _force_unit(along)),
        ):
            yield _row(label, quantity, _number(numbers, k), unit, stroke=value)
        for quantity, found in (
            ("frequency", curve.frequencies),
            ("parasitic frequency", curve.parasitic),
        ):
            for j in range(0 if found is None else found.value.shape[1]):
                assert found is not None
                hertz = _number(found, k, j)
                yield _row(label, quantity, hertz, "Hz", number=j + 1, stroke=value)
        yield Row(label, "is stable", int(curve.is_stable[k]), stroke=value)
        yield Row(label, "under-constrained by", curve.under_constrained[k], stroke=value)
        yield Row(label, "over-constrained by", curve.over_constrained[k], stroke=value)


def _effect(label: str, directions: Sequence[str], effect: Effect) -> Iterator[Row]:
    for state, name in enumerate(("before", "behind")):
        for j in range(0 if effect.frequencies is None else effect.frequencies.value.shape[1]):
            assert effect.frequencies is not None
            hertz = _number(effect.frequencies, state, j)
            yield _row(label, "frequency", hertz, "Hz", number=j + 1, state=name)
        for i, direction in enumerate(directions):
            number, unit = _number(effect.stiffness, state, i), stiffness_unit(direction)
            yield _row(label, "support stiffness", number, unit, direction=direction, state=name)
        yield _row(label, "elastic energy", _number(effect.energy, state), "J", state=name)
        for j, (quantity, unit) in enumerate(
            (("normal force", "N"), ("torque", "N m"), ("bending moment", "N m"))
        ):
            number = _number(effect.resultants, state, j)
            yield _row(label, f"largest {quantity}", number, unit, state=name)
        if effect.peak is not None:
            yield _row(label, "largest stress", _number(effect.peak, state), "Pa", state=name)
    yield _row(label, "stiffness kept", effect.kept, "1", state="behind")
    yield Row(label, "is stable", int(effect.is_stable), state="behind")
    yield Row(label, "part reached", effect.reached, state="behind")


def _row(label: str, quantity: str, found: Number, unit: str, **more: Cell) -> Row:
    made = Row(label, quantity, found.value, found.uncertainty, unit)
    return made._replace(**more)  # type: ignore[arg-type]


def _number(numbers: Numbers, *place: int) -> Number:
    return Number(float(numbers.value[place]), float(numbers.uncertainty[place]))


def _numbers(numbers: Numbers) -> list[Number]:
    pair: tuple[FloatArray, FloatArray] = numbers
    return [Number(*each) for each in zip(*(side.tolist() for side in pair), strict=True)]


def stiffness_unit(direction: str) -> str:
    """Of the stiffness along or about a direction: N/m or N m/rad."""
    return "N m/rad" if unit_of_direction(direction) == "rad" else "N/m"


def _force_unit(direction: str) -> str:
    return "(N m)" if unit_of_direction(direction) == "rad" else "N"


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
        "stroke": None if cost.stroke is None else _stroke_of_json_cost(cost),
        "misaligned": [
            {**_where_of_json_cost(each), "value": value, "unit": each.unit}
            for each, value in cost.misaligned
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
        "compliance": _numbers_of_json_cost(design.compliance),
        "kept": None
        if kept is None
        else {
            "mu": _numbers_of_json_cost(kept.mu),
            "worst": kept.worst.tolist(),
            "words": kept.words,
        },
        "frequencies": None
        if design.frequencies is None
        else {
            **_numbers_of_json_cost(design.frequencies),
            "unit": "Hz",
            "is_drive": list(design.is_drive),
        },
        "tightest": _maybe(design.tightest),
        "buckles_at": _maybe(design.buckles_at),
        "tolerances": [_tolerance(each) for each in design.tolerances],
        "curve": None
        if design.curve is None
        else {
            **_where_of_json_cost(design.curve.misalignment),
            "unit": design.curve.misalignment.unit,
            "values": design.curve.values.tolist(),
            "measure": _numbers_of_json_cost(design.curve.measure),
        },
        "stroke": None if design.stroke is None else _along(cost, design.stroke),
        "effect": None if design.effect is None else _effect_of_json_cost(cost, design.effect),
        "remarks": list(design.remarks),
    }


def _stroke_of_json_cost(cost: CostValues) -> dict[str, Any]:
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
        "stiffness": {**_numbers_of_json_cost(curve.stiffness), "units": _units(cost)},
        "kept": _numbers_of_json_cost(curve.kept),
        "drive_stiffness": _numbers_of_json_cost(curve.drive_stiffness),
        "force": _numbers_of_json_cost(curve.force),
        "frequencies": _numbers_or_null(curve.frequencies),
        "parasitic": _numbers_or_null(curve.parasitic),
        "is_stable": list(curve.is_stable),
        "under_constrained": list(curve.under_constrained),
        "over_constrained": list(curve.over_constrained),
    }


def _effect_of_json_cost(cost: CostValues, effect: Effect) -> dict[str, Any]:
    return {
        "frequencies": _numbers_or_null(effect.frequencies),
        "stiffness": {**_numbers_of_json_cost(effect.stiffness), "units": _units(cost)},
        "energy": _numbers_of_json_cost(effect.energy),
        "resultants": _numbers_of_json_cost(effect.resultants),
        "peak": _numbers_or_null(effect.peak),
        "where": effect.where,
        "kept": _number_of_json_cost(effect.kept),
        "is_stable": effect.is_stable,
        "reached": effect.reached,
    }


def _units(cost: CostValues) -> list[str]:
    return [stiffness_unit(each) for each in cost.directions]


def _maybe(tolerance: Tolerance | None) -> dict[str, Any] | None:
    return None if tolerance is None else _tolerance(tolerance)


def _tolerance(each: Tolerance) -> dict[str, Any]:
    return {
        **_where_of_json_cost(each.misalignment),
        "unit": each.misalignment.unit,
        "negative": _number_of_json_cost(each.negative),
        "positive": _number_of_json_cost(each.positive),
        "critical_negative": _number_of_json_cost(each.critical_negative),
        "critical_positive": _number_of_json_cost(each.critical_positive),
    }


def _where_of_json_cost(each: Misalignment) -> dict[str, Any]:
    return {"clamp": each.clamp.node, "direction": each.direction, "about": each.about}


def _clamp(each: Clamp) -> dict[str, Any]:
    return {"node": each.node, "orientation": each.orientation, "words": each.words}


def _number_of_json_cost(number: Number) -> dict[str, Any]:
    value = number.value if math.isfinite(number.value) else None
    return {"value": value, "uncertainty": number.uncertainty}


def _numbers_of_json_cost(numbers: Numbers) -> dict[str, Any]:
    return {"value": _finite(numbers.value), "uncertainty": _finite(numbers.uncertainty)}


def _numbers_or_null(numbers: Numbers | None) -> dict[str, Any] | None:
    return None if numbers is None else _numbers_of_json_cost(numbers)


def _finite(array: FloatArray) -> list[Any]:
    """Nested lists, with null in place of what is infinite."""
    return np.where(np.isfinite(array), array, None).tolist()  # type: ignore[call-overload, no-any-return]
