# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of a cost in the units of its model, for tables and JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from ..core.arrays import FloatArray
from ..util.units import Units
from .designs import (
    FREQUENCY,
    CostValues,
    Design,
    Effect,
    MisalignmentCurve,
    Number,
    Numbers,
    StrokeCurve,
    Tolerance,
    force_unit,
    stiffness_unit,
    unit_of_direction,
)

Cost = TypeVar("Cost", bound=CostValues)


def in_units(cost: Cost) -> Cost:
    """The same with all numbers in the units of the model; itself where these are SI."""
    units = cost.data.units
    if not units.power:
        return cost
    stroke, strength = cost.stroke, cost.strength
    if stroke is not None:
        low, high = (units.shown(np.array(p), stroke.unit) for p in (stroke.asked, stroke.reached))
        stroke = replace(
            stroke,
            rest=units.shown(stroke.rest, stroke.unit),
            asked=tuple(low.tolist()),
            reached=tuple(high.tolist()),
        )
    if strength is not None:
        strength = strength._replace(rest=units.shown(strength.rest, strength.unit))
    return replace(
        cost,
        designs=tuple(_design(cost, each, units) for each in cost.designs),
        misaligned=tuple((m, units.shown(value, m.unit)) for m, value in cost.misaligned),
        stroke=stroke,
        strength=strength,
    )


def _design(cost: CostValues, design: Design, units: Units) -> Design:
    turns = np.array([unit_of_direction(each) == "rad" for each in cost.directions])
    length = units.factor("m")
    # Displacements for forces, turns for moments.
    compliance = np.outer(np.where(turns, 1.0, length), np.where(turns, 1.0 / length, 1.0))
    return replace(
        design,
        compliance=_times(design.compliance, compliance),
        tolerances=tuple(_tolerance(each, units) for each in design.tolerances),
        size=units.shown(design.size, "m"),
        curve=design.curve and _curve(cost, design.curve, units),
        stroke=design.stroke and _stroke(cost, design.stroke, units),
        effect=design.effect and _effect(cost.directions, design.effect, units),
        limits=design.limits and design.limits.shown(units),
    )


def _times(numbers: Numbers, factor: FloatArray | float) -> Numbers:
    return Numbers(numbers.value * factor, numbers.uncertainty * np.abs(factor))


def _maybe(numbers: Numbers | None, factor: FloatArray | float) -> Numbers | None:
    return None if numbers is None else _times(numbers, factor)


def _tolerance(each: Tolerance, units: Units) -> Tolerance:
    factor = units.factor(each.misalignment.unit)
    made = (Number(value * factor, off * factor) for value, off in each[1:])
    return Tolerance(each.misalignment, *made)


def _curve(cost: CostValues, curve: MisalignmentCurve, units: Units) -> MisalignmentCurve:
    measured = 1.0 if cost.measure == FREQUENCY else units.factor("N/m")
    values = units.shown(curve.values, curve.misalignment.unit)
    return replace(curve, values=values, measure=_times(curve.measure, measured))


def _supports(directions: Sequence[str], units: Units) -> FloatArray:
    return np.array([units.factor(stiffness_unit(each)) for each in directions])


def _stroke(cost: CostValues, curve: StrokeCurve, units: Units) -> StrokeCurve:
    assert cost.stroke is not None
    along = cost.stroke.coordinate
    return replace(
        curve,
        values=units.shown(curve.values, unit_of_direction(along)),
        stiffness=_times(curve.stiffness, _supports(cost.directions, units)),
        drive_stiffness=_times(curve.drive_stiffness, units.factor(stiffness_unit(along))),
        force=_times(curve.force, units.factor(force_unit(along))),
        stress=_maybe(curve.stress, units.factor("Pa")),
    )


def _effect(directions: Sequence[str], effect: Effect, units: Units) -> Effect:
    moment, stress = units.factor("N m"), units.factor("Pa")
    return replace(
        effect,
        stiffness=_times(effect.stiffness, _supports(directions, units)),
        energy=_times(effect.energy, units.factor("J")),
        resultants=_times(effect.resultants, np.array([1.0, moment, moment])),
        peak=_maybe(effect.peak, stress),
        von_mises=_maybe(effect.von_mises, stress),
    )
