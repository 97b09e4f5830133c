# SPDX-License-Identifier: BSD-3-Clause
"""What a stroke and given misalignments do, in plain English and tables."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..elasticity.stiffness_drives import is_far
from ..util.plain_text import harmless
from .designs import CostValues, Design, Effect, StrokeCurve
from .quantities import in_words, scale_of
from .told import Row, Table, Told
from .values import Number, Numbers, unit_of_direction


def stroke(cost: CostValues) -> Iterator[Told]:
    """What the stroke costs, a line a design at its worst."""
    asked = cost.stroke
    if asked is None:
        return
    factor, unit = scale_of(max(map(abs, asked.asked)), asked.unit)
    reached = [value / factor for value in asked.reached]
    words = f"Stroke of {harmless(asked.words)} from {reached[0]:.6g} to {reached[1]:.6g} {unit}"
    rest = f"{asked.rest / factor:.6g} {unit}"
    yield Row(f"{words}; it rests at {rest}.")
    if is_far(asked.asked, asked.rest):
        yield Row("It is far from there: += in place of = counts from where it rests.")
    if asked.why:
        yield Row(f"{asked.beyond[:1].upper()}{asked.beyond[1:]}.")
    rows: list[Sequence[str]] = [
        ("design", "stiffness kept", "at", "lowest parasitic", "drive force"),
    ]
    for design in cost.designs:
        curve = design.stroke
        if curve is None:
            continue
        k = int(np.argmin(curve.kept.value))
        where = in_words(Number(float(curve.values[k])), asked.unit)
        rows.append(
            (design.label, in_words(_at(curve.kept, k)), where, _parasitic(curve), _force(curve))
        )
    yield _without_empty(rows)
    for design in cost.designs:
        yield from _along(design)


def _parasitic(curve: StrokeCurve) -> str:
    if curve.parasitic is None or not curve.parasitic.value.size:
        return ""
    first = Numbers(curve.parasitic.value[:, 0], curve.parasitic.uncertainty[:, 0])
    return in_words(_at(first, int(np.argmin(first.value))), "Hz")


def _force(curve: StrokeCurve) -> str:
    k = int(np.argmax(np.abs(curve.force.value)))
    return f"{abs(float(curve.force.value[k])):.4g}"


def _along(design: Design) -> Iterator[Told]:
    """Where a design buckles or its counts change on the way."""
    curve = design.stroke
    if curve is None:
        return
    lost = [float(v) for v, fine in zip(curve.values, curve.is_stable, strict=True) if not fine]
    if lost:
        yield Row(
            f"{design.label}: a stiffness is negative from {min(lost):.6g} to {max(lost):.6g}: it "
            "has buckled there."
        )
    counts = set(zip(curve.under_constrained, curve.over_constrained, strict=True))
    if len(counts) > 1:
        yield Row(
            f"{design.label}: the verdict changes on the way; the table that -o writes says where."
        )


def effects(cost: CostValues) -> Iterator[Told]:
    """What the given misalignments do, with all of the nonlinearity."""
    if not cost.misaligned:
        return
    given = " and ".join(
        f"{harmless(each.words)} by {in_words(Number(value), each.unit)}"
        for each, value in cost.misaligned
    )
    yield Row(f"With {given}, all of the nonlinearity:")
    rows: list[Sequence[str]] = [
        ("design", "first frequency", "stiffness kept", "moment", "stress"),
    ]
    for design in cost.designs:
        if design.effect is not None:
            rows.append((design.label, *_effect(design.effect)))
    yield _without_empty(rows)
    for design in cost.designs:
        yield from _state(design)


def _effect(effect: Effect) -> tuple[str, ...]:
    first = effect.frequencies
    frequency = "" if first is None else f"{first.value[0, 0]:.4g} -> {first.value[1, 0]:.4g} Hz"
    moment = f"{float(np.max(effect.resultants.value[1, 1:])):.3g} N m"
    peak = "" if effect.peak is None else in_words(Number(float(effect.peak.value[1])), "Pa")
    return frequency, in_words(effect.kept), moment, peak


def _state(design: Design) -> Iterator[Told]:
    effect = design.effect
    if effect is None:
        return
    told = []
    if effect.reached < 1.0:
        told.append(f"no equilibrium was found beyond {100.0 * effect.reached:.4g} % of it")
    if not effect.is_stable:
        told.append("it has buckled: a stiffness is negative")
    if effect.where:
        told.append(f"most stressed: {harmless(effect.where)}")
    if told:
        yield Row(f"{design.label}: {'; '.join(told)}.", "  ")


def _at(numbers: Numbers, *place: int) -> Number:
    return Number(float(numbers.value[place]), float(numbers.uncertainty[place]))


def _without_empty(rows: list[Sequence[str]]) -> Table:
    """A table; columns in which nothing stands are left out."""
    kept = [k for k in range(len(rows[0])) if k == 0 or any(row[k] for row in rows[1:])]
    return Table(tuple(tuple(row[k] for k in kept) for row in rows))


def stiffness_words(value: float, direction: str) -> str:
    """A stiffness with its unit, such as "3.503 N/um"."""
    unit = "N m/rad" if unit_of_direction(direction) == "rad" else "N/m"
    return in_words(Number(value), unit)
