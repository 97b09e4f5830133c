# SPDX-License-Identifier: BSD-3-Clause
"""What a design costs in plain English: what matters most first, then a table of the designs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ..elasticity.equilibria import is_far
from ..elasticity.limits import REACH, STABILITY, STRENGTH, SUPPORT, Limit, Limits, mirrored
from ..elasticity.points import words_of_direction
from ..util.text import columns, harmless, table, wrapped
from ..util.units import Units
from .designs import (
    FREQUENCY,
    CostValues,
    Design,
    Effect,
    Misalignment,
    Number,
    Stroke,
    StrokeCurve,
    Tolerance,
    force_unit,
    in_words,
    percent,
    scale_of,
)
from .elastic_design import FAR

#: Columns of text where nobody says how many there are.
WIDTH = 80

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
    paragraphs = (
        _opening(cost, width),
        (_choices(cost, width),),
        (_table(cost, width),),
        (wrapped(_weakest(design), width, "  ") for design in cost.designs),
        (wrapped(_legend(cost), width),),
        _stroke(cost, width),
        _effects(cost, width),
        (wrapped(f"Note: {sentence}", width) for sentence in cost.left_out),
    )
    made = ("\n".join(paragraph) for paragraph in paragraphs)
    return "\n\n".join(paragraph for paragraph in made if paragraph)


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


def _opening(cost: CostValues, width: int) -> Iterator[str]:
    if cost.name:
        yield wrapped(harmless(cost.name), width)
    # What is asked for by name is the point.
    if cost.strength is not None:
        yield from (*_strength(cost, width), "")
    yield wrapped(first_line(cost), width)
    if cost.tightest is not None and not cost.as_built.over_constrained:
        yield wrapped("It is not over-constrained: only what is compliant is stressed.", width)


def _choices(cost: CostValues, width: int) -> str:
    known = {
        "auto": "8 and 16 beams a sheet, extrapolated",
        1: "the deck's own elements, uncertainty not known",
    }
    beams = known.get(cost.beams, f"{cost.beams} beams a sheet, uncertainty not known")
    return wrapped(
        f"At {harmless(cost.point.words)}, {cost.point.reason}. Held deformations {cost.held}, "
        f"drive {cost.drive}, {beams}.",
        width,
    )


def _table(cost: CostValues, width: int) -> str:
    """The designs, with as many uncertainties as there is room for: the last columns first."""
    for first in range(len(_HEADINGS) + 1):
        rows = [_HEADINGS, _SECOND, *(_row(design, first) for design in cost.designs)]
        widths = (max(map(columns, cells)) for cells in zip(*rows, strict=True))
        if sum(widths) + _GAP * (len(_HEADINGS) - 1) <= width:
            return table(rows, width, second=True)
    # A list has room for all of them.
    rows = [_HEADINGS, _SECOND, *(_row(design, 0) for design in cost.designs)]
    return table(rows, width, second=True)


def _row(design: Design, first: int) -> tuple[str, ...]:
    """A row, with uncertainties from a column on."""
    label = design.label
    if len(label) > _LONGEST:
        label = f"{label[: _LONGEST - 3]}..."
    kept, tightest, buckles = design.kept, design.tightest, design.buckles_at
    columns: tuple[tuple[Number | None, str], ...] = (
        (kept and kept.smallest, ""),
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


def _weakest(design: Design) -> str:
    """Which clamp and direction, which weakest direction, and what is alike."""
    told = []
    if design.kept is not None:
        is_all = design.kept.smallest.value > _ALL
        told.append("keeps all stiffness" if is_all else f"weakest {design.kept.words}")
    tightest, buckles = design.tightest, design.buckles_at
    if tightest is not None:
        safety = design.safety(tightest)
        safe = "" if safety is None else f" (safety {in_words(safety)})"
        told.append(f"tightest {harmless(tightest.misalignment.words)}{safe}")
    if buckles is not None and (tightest is None or buckles.misalignment != tightest.misalignment):
        told.append(f"buckles by {harmless(buckles.misalignment.words)}")
    if design.alike:
        shown = ", ".join(design.alike[:4])
        more = f" and {len(design.alike) - 4} more" if len(design.alike) > 4 else ""
        told.append(f"the same by symmetry: {shown}{more}")
    what = "" if not design.released else f" ({harmless(design.words)})"
    text = f"{design.label}{what}: {'; '.join(told)}." if told else f"{design.label}{what}."
    return " ".join((text, *design.remarks))


_SAFETY = (
    " Safety: the strength, of fatigue where that counts, over the stress of von Mises, of the "
    "part where it is least."
)


def _legend(cost: CostValues) -> str:
    kept = "worst stiffness kept: the smallest mu of C_before v = mu C_after v at the point; "
    shift = percent(abs(cost.shift))
    way = "fall" if cost.shift < 0 else "rise"
    what = FREQUENCY if cost.measure == FREQUENCY else "lowest stiffness of that point"
    limited = ""
    if not all(each.tightest and each.buckles_at for each in cost.designs if each.tolerances):
        most = in_words(Number(FAR * cost.as_built.size), "m")
        limited = f" Not limited: more than {most} (a tenth of the size), or {FAR} rad."
    return (
        f"{kept if len(cost.designs) > 1 else ''}tightest tolerance: the smallest error of one "
        f"clamp that makes the {what} {way} by {shift}; buckles at: the smallest error at which "
        "a stiffness is lost. Stress is taken in proportion to the error, about the undeformed "
        f"state.{limited}{'' if cost.strength is None else _SAFETY}"
    )


def _stroke(cost: CostValues, width: int) -> Iterator[str]:
    """What the stroke costs, a line a design at its worst."""
    asked = cost.stroke
    if asked is None:
        return
    factor, unit = scale_of(max(map(abs, asked.asked)), asked.unit)
    reached = [value / factor for value in asked.reached]
    words = f"Stroke of {harmless(asked.words)} from {reached[0]:.6g} to {reached[1]:.6g} {unit}"
    yield wrapped(f"{words}; it rests at {asked.rest / factor:.6g} {unit}.", width)
    if is_far(asked.asked, asked.rest):
        yield wrapped("It is far from there: += in place of = counts from where it rests.", width)
    if asked.why:
        yield wrapped(f"{asked.beyond[:1].upper()}{asked.beyond[1:]}.", width)
    followed = [(each, each.stroke) for each in cost.designs if each.stroke is not None]
    units = cost.data.units
    rows = [(each.label, *_worst(curve, asked, units)) for each, curve in followed]
    headings = (
        *("design", "stiffness kept", "at", "lowest parasitic", "drive force"),
        *("stress", "safety"),
    )
    yield _without_empty((headings, *rows), width)
    for design, curve in followed:
        lost = [float(v) for v, fine in zip(curve.values, curve.is_stable, strict=True) if not fine]
        if lost:
            low, high = (units.shown(value, asked.unit) for value in (min(lost), max(lost)))
            yield wrapped(
                f"{design.label}: a stiffness is negative from {low:.6g} to {high:.6g}: "
                "it has buckled there.",
                width,
            )
        if len(set(zip(curve.under_constrained, curve.over_constrained, strict=True))) > 1:
            yield wrapped(
                f"{design.label}: the verdict changes on the way; the table that -o writes says "
                "where.",
                width,
            )


def _strength(cost: CostValues, width: int) -> Iterator[str]:
    """How far the drive may go, a line a design."""
    asked = cost.strength
    if asked is None:
        return
    along = words_of_direction(asked.coordinate)
    what = harmless(asked.words).removesuffix(f" {along}")
    yield wrapped(f"How far {what} may go {along} from rest, drive locked:", width)
    for design in cost.designs:
        if design.limits is not None:
            told = "; ".join(limits_in_words(design.limits))
            notes = (f"{note}." for note in design.limits.notes)
            yield wrapped(harmless(" ".join((f"{design.label}: {told}.", *notes))), width, "  ")


#: The order in which limits are told.
_ORDER = (STRENGTH, SUPPORT, STABILITY, REACH)


def limits_in_words(limits: Limits) -> list[str]:
    """Such as "half of the strength (240 MPa) at +-6.3 mm, in sheet 1 at its clamp"."""
    every = sorted(mirrored(limits.limits), key=lambda both: _ORDER.index(both[0].criterion))
    supports = [both for both in every if both[0].criterion == SUPPORT]
    others = [_limit_in_words(both, limits) for both in every if both not in supports]
    count = sum(both[0].criterion == STRENGTH for both in every)
    made = others[:count]
    if supports:
        # The same part of all of them: it is told once.
        first, *more = (_limit_in_words(both, limits) for both in supports)
        whole = supports[0][0].reason.removeprefix(words_of_direction(supports[0][0].direction))
        told = ", ".join((first, *(each.replace(whole, "", 1) for each in more)))
        made.append(f"{told} (drive {limits.drive})")
    return [*made, *others[count:]]


def _limit_in_words(both: Sequence[Limit], limits: Limits) -> str:
    last = both[-1]
    size = in_words(Number(abs(last.stroke)), limits.unit)
    sign = "+-" if len(both) == 2 else "-" if math.copysign(1.0, last.stroke) < 0.0 else "+"
    is_end = last.criterion == REACH and not last.part
    what = f"{last.reason} {'' if is_end else 'at '}{sign}{size}"
    return f"{what}{' ' if is_end else ', '}{last.place}" if last.place else what


def _worst(curve: StrokeCurve, asked: Stroke, units: Units) -> tuple[str, ...]:
    """The least that is kept and where, the lowest parasitic frequency, and the largest force.

    And the largest stress and the least safety, where a strength was asked for.
    """
    k = int(np.argmin(curve.kept.value))
    parasitic = ""
    if curve.parasitic is not None and curve.parasitic.value.size:
        first = curve.parasitic.column(0)
        parasitic = in_words(first.at(int(np.argmin(first.value))), "Hz")
    where = in_words(Number(float(curve.values[k])), asked.unit)
    largest = float(np.abs(curve.force.value).max())
    force = f"{units.shown(largest, force_unit(asked.coordinate)):.4g}"
    stress = safety = ""
    if curve.stress is not None and curve.safety is not None:
        k_least = int(np.argmin(curve.safety.value))
        stress = in_words(curve.stress.at(k_least), "Pa")
        safety = in_words(curve.safety.at(k_least))
    return in_words(curve.kept.at(k)), where, parasitic, force, stress, safety


def _effects(cost: CostValues, width: int) -> Iterator[str]:
    """What the given misalignments do, with all of the nonlinearity."""
    if not cost.misaligned:
        return
    given = " and ".join(
        f"{harmless(each.words)} by {in_words(Number(value), each.unit)}"
        for each, value in cost.misaligned
    )
    yield wrapped(f"With {given}, all of the nonlinearity:", width)
    found = [(each.label, each.effect) for each in cost.designs if each.effect is not None]
    headings = ("design", "first frequency", "stiffness kept", "moment", "stress", "safety")
    yield _without_empty(
        (headings, *((label, *_cells(each, cost.data.units)) for label, each in found)), width
    )
    for label, effect in found:
        told = []
        if effect.reached < 1.0:
            told.append(f"no equilibrium was found beyond {100.0 * effect.reached:.4g} % of it")
        if not effect.is_stable:
            told.append("it has buckled: a stiffness is negative")
        if effect.where:
            told.append(f"most stressed: {harmless(effect.where)}")
        if told:
            yield wrapped(f"{label}: {'; '.join(told)}.", width, "  ")


def _cells(effect: Effect, units: Units) -> tuple[str, ...]:
    first = effect.frequencies
    frequency = "" if first is None else f"{first.value[0, 0]:.4g} -> {first.value[1, 0]:.4g} Hz"
    largest = units.shown(float(np.max(effect.resultants.value[1, 1:])), "N m")
    moment = f"{largest:.3g} {units.symbol('N m')}"
    peak = "" if effect.peak is None else in_words(Number(float(effect.peak.value[1])), "Pa")
    safety = "" if effect.safety is None else in_words(effect.safety.at(1))
    return frequency, in_words(effect.kept), moment, peak, safety


def _without_empty(rows: Sequence[Sequence[str]], width: int) -> str:
    """A table; columns in which nothing stands are left out."""
    kept = [k for k in range(len(rows[0])) if k == 0 or any(row[k] for row in rows[1:])]
    return table([tuple(row[k] for k in kept) for row in rows], width)
