# SPDX-License-Identifier: BSD-3-Clause
"""What a design costs in plain English: what matters most first, then a table of the designs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..elasticity.drives import is_far
from ..util.text import columns, harmless
from .designs import (
    FREQUENCY,
    CostValues,
    Design,
    Effect,
    Misalignment,
    Number,
    Numbers,
    StrokeCurve,
    Tolerance,
    in_words,
    percent,
    scale_of,
    unit_of_direction,
    words_of_direction,
)
from .request import WIDTH, Row, Table, Told, shown
from .tolerances import FAR


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


_HEADINGS = ("design", "worst stiffness", "first parasitic", "tightest", "buckles at")
_SECOND = ("", "kept", "frequency", "tolerance", "")
#: A part of a stiffness from which all of it is kept.
_ALL = 0.9999
#: The longest label of a design, and behind which column "not limited" is an answer.
_LONGEST, _KNOWN = 16, 2
#: Between columns.
_GAP = 2


def describe(cost: CostValues, width: int = WIDTH) -> str:
    """The cost for people, in rows of a width."""
    blocks = (
        _first(cost),
        _choices(cost),
        _table(cost, width),
        _where(cost),
        _legend(cost),
        stroke(cost),
        effects(cost),
        _left_out(cost),
    )
    told = ([shown(each, width) for each in block] for block in blocks)
    return "\n\n".join("\n".join(block) for block in told if block)


def first_line(cost: CostValues) -> str:
    """What the tightest clamp costs, such as "It costs: clamp 11 off by 50 um along x ..."."""
    built = cost.as_built
    if built.tightest is not None:
        return f"{costs(built.tightest, cost.measure, cost.shift, built.over_constrained > 0)}."
    if built.tolerances:
        return f"{costs_nothing(cost.measure, cost.shift, built.size)}."
    if not cost.clamps:
        return "It costs nothing: no clamp is there that could be off."
    return "What a clamp that is off costs has no answer here; the reasons stand below."


def costs(tightest: Tolerance, measure: str, shift: float, is_over: bool) -> str:
    """What the tightest clamp costs, without a full stop."""
    lead = "It costs" if is_over else "It costs little"
    return f"{lead}: {off(tightest.misalignment, tightest.tightest)} {_changes(measure, shift)}"


def costs_nothing(measure: str, shift: float, size: float) -> str:
    """The same where no tolerance is within a tenth of the size."""
    most = in_words(Number(FAR * size), "m")
    return (
        f"It costs nothing: no clamp that is off by up to {most} (a tenth of the size) or turned "
        f"by up to {FAR} rad {_changes(measure, shift)}, to first order"
    )


def _changes(measure: str, shift: float) -> str:
    return f"{'lowers' if shift < 0 else 'raises'} the {measure} by {percent(abs(shift))}"


def off(where: Misalignment, by: Number) -> str:
    """Such as "clamp 11 off by 50 um along x"."""
    turn = "turned" if where.unit == "rad" else "off"
    pivot = "" if where.about is None else f" through node {where.about}"
    size = in_words(by, where.unit)
    direction = words_of_direction(where.direction)
    return f"{harmless(where.clamp.words)} {turn} by {size} {direction}{pivot}"


def _first(cost: CostValues) -> Iterator[Told]:
    if cost.name:
        yield Row(harmless(cost.name))
    yield Row(first_line(cost))
    if cost.tightest is not None and not cost.as_built.over_constrained:
        yield Row("It is not over-constrained: only what is compliant is stressed.")


def _choices(cost: CostValues) -> Iterator[Told]:
    beams = (
        "8 and 16 beams a sheet, extrapolated"
        if cost.beams == "auto"
        else "the deck's own elements, uncertainty not known"
        if cost.beams == 1
        else f"{cost.beams} beams a sheet, uncertainty not known"
    )
    yield Row(
        f"At {harmless(cost.point.words)}, {cost.point.reason}. Held deformations {cost.held}, "
        f"drive {cost.drive}, {beams}."
    )


def _table(cost: CostValues, width: int) -> Iterator[Told]:
    """The designs, with as many uncertainties as there is room for: the last columns first."""
    for first in range(len(_HEADINGS) + 1):
        rows = [_SECOND, *(_row(design, first) for design in cost.designs)]
        widths = (max(map(columns, cells)) for cells in zip(_HEADINGS, *rows, strict=True))
        if sum(widths) + _GAP * (len(_HEADINGS) - 1) <= width:
            break
    else:
        # A list has room for all of them.
        rows = [_SECOND, *(_row(design, 0) for design in cost.designs)]
    yield Table((_HEADINGS, *rows), second=True)


def _row(design: Design, first: int) -> tuple[str, ...]:
    """A row, with uncertainties from a column on."""
    label = design.label
    if len(label) > _LONGEST:
        label = f"{label[: _LONGEST - 3]}..."
    kept = None if design.kept is None else design.kept.smallest
    tightest, buckles = design.tightest, design.buckles_at
    columns: tuple[tuple[Number | None, str], ...] = (
        (kept, ""),
        (design.first_parasitic, "Hz"),
        (tightest and tightest.tightest, tightest.misalignment.unit if tightest else ""),
        (buckles and buckles.critical, buckles.misalignment.unit if buckles else ""),
    )
    cells = [label]
    for k, (number, unit) in enumerate(columns, start=1):
        if number is None:
            cells.append("not limited" if k > _KNOWN and design.tolerances else "")
        else:
            cells.append(in_words(number if k >= first else Number(number.value), unit))
    return tuple(cells)


def _where(cost: CostValues) -> Iterator[Told]:
    """Which clamp and direction, which weakest direction, and what is alike."""
    for design in cost.designs:
        told = []
        if design.kept is not None:
            is_all = design.kept.smallest.value > _ALL
            told.append("keeps all stiffness" if is_all else f"weakest {design.kept.words}")
        tightest, buckles = design.tightest, design.buckles_at
        if tightest is not None:
            told.append(f"tightest {harmless(tightest.misalignment.words)}")
        if buckles is not None and (
            tightest is None or buckles.misalignment != tightest.misalignment
        ):
            told.append(f"buckles by {harmless(buckles.misalignment.words)}")
        if design.alike:
            shown = ", ".join(design.alike[:4])
            more = f" and {len(design.alike) - 4} more" if len(design.alike) > 4 else ""
            told.append(f"the same by symmetry: {shown}{more}")
        what = "" if not design.released else f" ({harmless(design.words)})"
        text = f"{design.label}{what}: {'; '.join(told)}." if told else f"{design.label}{what}."
        yield Row(" ".join((text, *design.remarks)), "  ")


def _legend(cost: CostValues) -> Iterator[Told]:
    kept = "worst stiffness kept: the smallest mu of C_before v = mu C_after v at the point; "
    shift = percent(abs(cost.shift))
    way = "fall" if cost.shift < 0 else "rise"
    what = FREQUENCY if cost.measure == FREQUENCY else "lowest stiffness of that point"
    yield Row(
        f"{kept if len(cost.designs) > 1 else ''}tightest tolerance: the smallest error of one "
        f"clamp that makes the {what} {way} by {shift}; buckles at: the smallest error at which "
        "a stiffness is lost. Stress is taken in proportion to the error, about the undeformed "
        f"state.{_not_limited(cost)}"
    )


def _not_limited(cost: CostValues) -> str:
    if all(each.tightest and each.buckles_at for each in cost.designs if each.tolerances):
        return ""
    most = in_words(Number(FAR * cost.as_built.size), "m")
    return f" Not limited: more than {most} (a tenth of the size), or {FAR} rad."


def _left_out(cost: CostValues) -> Iterator[Told]:
    for sentence in cost.left_out:
        yield Row(f"Note: {sentence}")
