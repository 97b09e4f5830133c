# SPDX-License-Identifier: BSD-3-Clause
"""What a design costs as numbers: one tidy table, a row a number, and JSON."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, fields
from typing import Any

import numpy as np

from ..elasticity.limits import Limits
from ..util.loading import VERSION
from .designs import (
    CostValues,
    Design,
    Effect,
    Misalignment,
    Number,
    Numbers,
    Released,
    StrokeCurve,
    Tolerance,
    force_unit,
    stiffness_unit,
)
from .in_units import in_units

Cell = str | int | float

#: What the columns hold; a cell is empty where a column says nothing of a number.
HEADER = (
    *("design", "quantity", "clamp", "direction", "direction_2", "number"),
    *("stroke", "misalignment", "state", "value", "uncertainty", "unit"),
)


#: A number by the columns that say something of it: number: from 1, of frequencies and stiffness
#: ratios; stroke: driven coordinate, absolute [m, rad]; misalignment: [m, rad]; state: "before" or
#: "behind" given misalignments.
Row = dict[str, Cell]


def csv_text(cost: CostValues) -> str:
    """The table as CSV; numbers read back to the last bit, infinite ones are "inf"."""
    text, cost = io.StringIO(), in_units(cost)
    writer = csv.DictWriter(text, HEADER, lineterminator="\n")
    writer.writeheader()
    for design in cost.designs:
        for row in rows(cost, design):
            writer.writerow({**row, "unit": _symbol(cost, str(row["unit"]))})
    return text.getvalue()


def _symbol(cost: CostValues, unit: str) -> str:
    """A unit, or one unit over another, in the units of the model."""
    whole = cost.data.units.symbol(unit)
    if whole != unit or "/(" not in unit:
        return whole
    above, below = unit.split("/(")
    symbol = cost.data.units.symbol
    return f"{symbol(above)}/({symbol(below[:-1])})"


def rows(cost: CostValues, design: Design) -> Iterator[Row]:
    """All numbers of a design."""
    label, directions = design.label, cost.directions
    yield _row(label, "under-constrained by", design.under_constrained)
    yield _row(label, "over-constrained by", design.over_constrained)
    for i, first in enumerate(directions):
        for j, second in enumerate(directions):
            unit = f"{'rad' if first.startswith('r') else 'm'}/{_force_unit(second)}"
            both = {"direction": first, "direction_2": second}
            yield _row(label, "compliance", design.compliance.at(i, j), unit, **both)
    if design.kept is not None:
        for k, mu in enumerate(design.kept.mu.each()):
            yield _row(label, "stiffness kept", mu, "1", number=k + 1)
    if design.frequencies is not None:
        for k, hertz in enumerate(design.frequencies.each()):
            kind = "frequency of the drive" if design.is_drive[k] else "parasitic frequency"
            yield _row(label, kind, hertz, "Hz", number=k + 1)
    for each in design.tolerances:
        for quantity, number in (
            ("tolerance below zero", each.negative),
            ("tolerance above zero", each.positive),
            ("buckles below zero", each.critical_negative),
            ("buckles above zero", each.critical_positive),
        ):
            where = _where(each.misalignment)
            yield _row(label, quantity, number, each.misalignment.unit, **where)
        if (safety := design.safety(each)) is not None:
            yield _row(label, "safety at the tolerance", safety, "1", **where)
    if design.limits is not None:
        yield from _limits(cost, label, design.limits)
    if design.curve is not None:
        unit = "Hz" if cost.measure.endswith("frequency") else "N/m"
        for value, measure in zip(
            design.curve.values.tolist(), design.curve.measure.each(), strict=True
        ):
            where = _where(design.curve.misalignment)
            yield _row(label, cost.measure, measure, unit, misalignment=value, **where)
    if design.stroke is not None:
        yield from _stroke(cost, label, design.stroke)
    if design.effect is not None:
        yield from _effect(label, directions, design.effect)


def _limits(cost: CostValues, label: str, limits: Limits) -> Iterator[Row]:
    """Each limit, a stroke from rest, and what stresses most along the path."""
    for each in limits.limits:
        end = "below" if math.copysign(1.0, each.stroke) < 0.0 else "above"
        more: Row = {"direction": each.direction} if each.direction else {}
        quantity = f"stroke at the limit of {each.criterion}"
        yield _row(label, quantity, each.stroke, limits.unit, state=end, **more)
    for k, stroke in enumerate((limits.rest + limits.strokes).tolist()):
        yield _row(label, "part of the strength", float(limits.usage[k]), "1", stroke=stroke)
        if cost.stroke is None:
            yield _row(label, "von Mises stress", float(limits.stress[k]), "Pa", stroke=stroke)


def _where(each: Misalignment) -> dict[str, Cell]:
    return {"clamp": each.clamp.node, "direction": each.direction}


def _stroke(cost: CostValues, label: str, curve: StrokeCurve) -> Iterator[Row]:
    assert cost.stroke is not None
    along = cost.stroke.coordinate
    for k, value in enumerate(curve.values.tolist()):
        for i, direction in enumerate(cost.directions):
            stiffness = curve.stiffness.at(k, i)
            unit = stiffness_unit(direction)
            yield _row(
                label, "support stiffness", stiffness, unit, direction=direction, stroke=value
            )
        for quantity, numbers, unit in (
            ("stiffness kept along the stroke", curve.kept, "1"),
            ("drive stiffness", curve.drive_stiffness, stiffness_unit(along)),
            ("drive force", curve.force, _force_unit(along)),
        ):
            yield _row(label, quantity, numbers.at(k), unit, stroke=value)
        for quantity, found in (
            ("frequency", curve.frequencies),
            ("parasitic frequency", curve.parasitic),
        ):
            for j, hertz in enumerate(() if found is None else found.row(k)):
                yield _row(label, quantity, hertz, "Hz", number=j + 1, stroke=value)
        for quantity, given, unit in (
            ("von Mises stress", curve.stress, "Pa"),
            ("safety", curve.safety, "1"),
        ):
            if given is not None:
                yield _row(label, quantity, given.at(k), unit, stroke=value)
        yield _row(label, "is stable", int(curve.is_stable[k]), stroke=value)
        yield _row(label, "under-constrained by", curve.under_constrained[k], stroke=value)
        yield _row(label, "over-constrained by", curve.over_constrained[k], stroke=value)


def _effect(label: str, directions: Sequence[str], effect: Effect) -> Iterator[Row]:
    for state, name in enumerate(("before", "behind")):
        for j, hertz in enumerate(effect.frequencies.row(state) if effect.frequencies else ()):
            yield _row(label, "frequency", hertz, "Hz", number=j + 1, state=name)
        for i, direction in enumerate(directions):
            number, unit = effect.stiffness.at(state, i), stiffness_unit(direction)
            yield _row(label, "support stiffness", number, unit, direction=direction, state=name)
        yield _row(label, "elastic energy", effect.energy.at(state), "J", state=name)
        for j, (quantity, unit) in enumerate(
            (("normal force", "N"), ("torque", "N m"), ("bending moment", "N m"))
        ):
            number = effect.resultants.at(state, j)
            yield _row(label, f"largest {quantity}", number, unit, state=name)
        if effect.peak is not None:
            yield _row(label, "largest stress", effect.peak.at(state), "Pa", state=name)
        if effect.von_mises is not None and effect.safety is not None:
            yield _row(label, "von Mises stress", effect.von_mises.at(state), "Pa", state=name)
            yield _row(label, "safety", effect.safety.at(state), "1", state=name)
    yield _row(label, "stiffness kept", effect.kept, "1", state="behind")
    yield _row(label, "is stable", int(effect.is_stable), state="behind")
    yield _row(label, "part reached", effect.reached, state="behind")


def _row(label: str, quantity: str, found: Number | Cell, unit: str = "", **more: Cell) -> Row:
    value, off = found if isinstance(found, Number) else (found, 0.0)
    return {
        **{"design": label, "quantity": quantity, "value": value, "uncertainty": off},
        **{"unit": unit, **more},
    }


def _force_unit(direction: str) -> str:
    unit = force_unit(direction)
    return f"({unit})" if " " in unit else unit


def _released(each: Released) -> dict[str, Any]:
    notch = each.notch if each.shown is None else each.shown
    return {**_of_fields(each, "element", "deformation"), "notch": notch, "words": each.words}


#: Of the JSON of a cost; raised where an entry is taken away, renamed, or means something else.
FORMAT = 1


def dictionary_of(cost: CostValues) -> dict[str, Any]:
    """The names and values of the JSON, in their order; what is infinite is null."""
    cost = in_units(cost)
    deck = cost.name.encode("utf-8", "backslashreplace").decode("utf-8")
    return {
        "format": FORMAT,
        "deck": deck,
        "flexact": VERSION,
        "units": cost.data.units.name,
        "choice": {
            "held": cost.held,
            "drive": cost.drive,
            "beams": cost.beams,
            "shift": cost.shift,
            "measure": cost.measure,
        },
        "point": cost.point._asdict(),
        "directions": list(cost.directions),
        "clamps": [_of_fields(each, "node", "orientation", "words") for each in cost.clamps],
        "stroke": cost.stroke
        and {
            **_of_fields(
                cost.stroke,
                *("node", "coordinate", "words", "unit", "rest", "asked", "reached", "why"),
            ),
            "unit": cost.data.units.symbol(cost.stroke.unit),
        },
        "misaligned": [
            {**_place(each), "value": value, "unit": cost.data.units.symbol(each.unit)}
            for each, value in cost.misaligned
        ],
        "designs": [_design(cost, each) for each in cost.designs],
        "left_out": list(cost.left_out),
        **({} if cost.strength is None else {"strength": cost.strength._asdict()}),
    }


def text_of(cost: CostValues) -> str:
    """The same as one line of text."""
    return json.dumps(dictionary_of(cost), allow_nan=False)


def _design(cost: CostValues, design: Design) -> dict[str, Any]:
    kept, hertz, curve = design.kept, design.frequencies, design.curve
    return {
        "label": design.label,
        "released": [_released(each) for each in design.released],
        "alike": list(design.alike),
        "under_constrained": design.under_constrained,
        "over_constrained": design.over_constrained,
        "compliance": _plain(design.compliance),
        "kept": kept and _of_fields(kept, "mu", "worst", "words"),
        "frequencies": hertz and {**_plain(hertz), "unit": "Hz", "is_drive": list(design.is_drive)},
        "tightest": _told(cost, design, design.tightest),
        "buckles_at": _told(cost, design, design.buckles_at),
        "tolerances": [_told(cost, design, each) for each in design.tolerances],
        "curve": curve
        and {
            **_place(curve.misalignment),
            "unit": cost.data.units.symbol(curve.misalignment.unit),
            **_of_fields(curve, "values", "measure"),
        },
        "stroke": design.stroke and _with_units(cost, design.stroke),
        "effect": design.effect and _with_units(cost, design.effect),
        "remarks": list(design.remarks),
        **({} if cost.strength is None else {"limits": _of_limits(design.limits)}),
    }


def _of_limits(limits: Limits | None) -> dict[str, Any] | None:
    """How far it may go each way, everything that ends it, and the path."""
    if limits is None:
        return None
    names = ("low", "high", "reason", "part", "unit", "rest", "drive")
    along = ("strokes", "stress", "parts", "usage", "directions", "supports")
    return {
        **_of_fields(limits, *names),
        "limits": [asdict(each) for each in limits.limits],
        "path": _of_fields(limits, *along),
        "notes": list(limits.notes),
    }


def _with_units(cost: CostValues, given: StrokeCurve | Effect) -> dict[str, Any]:
    """All fields, and the units of the stiffness."""
    # Without a strength there is nothing of it.
    of_strength = ("stress", "safety", "von_mises")
    names = (each.name for each in fields(given))
    names = (name for name in names if name not in of_strength or getattr(given, name) is not None)
    made = _of_fields(given, *names)
    units = map(stiffness_unit, cost.directions)
    made["stiffness"]["units"] = [cost.data.units.symbol(each) for each in units]
    return made


def _told(cost: CostValues, design: Design, each: Tolerance | None) -> dict[str, Any] | None:
    """A tolerance, with its safety where a strength was asked for."""
    if each is None:
        return None
    safety = design.safety(each)
    numbers = ("negative", "positive", "critical_negative", "critical_positive")
    return {
        **_place(each.misalignment),
        "unit": cost.data.units.symbol(each.misalignment.unit),
        **_of_fields(each, *numbers),
        **({} if safety is None else {"safety": _plain(safety)}),
    }


def _place(each: Misalignment) -> dict[str, Any]:
    return {"clamp": each.clamp.node, **_of_fields(each, "direction", "about")}


def _of_fields(given: object, *names: str) -> dict[str, Any]:
    return {name: _plain(getattr(given, name)) for name in names}


def _plain(value: Any) -> Any:
    """A value as JSON has it: null in place of what is infinite, lists in place of arrays."""
    if isinstance(value, (Number, Numbers)):
        return _of_fields(value, "value", "uncertainty")
    if isinstance(value, np.ndarray):
        return np.where(np.isfinite(value), value, None).tolist()  # type: ignore[call-overload]
    if isinstance(value, tuple):
        return list(value)
    return None if isinstance(value, float) and not math.isfinite(value) else value
