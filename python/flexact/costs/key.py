# SPDX-License-Identifier: BSD-3-Clause
"""The table that tells the designs of a picture apart, and from which one is chosen."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

import numpy as np

from ..util.plain_text import file_name, harmless
from .designs import CostValues, Design
from .names import short_labels
from .quantities import in_words, percent
from .values import Misalignment, Number, Tolerance

#: What stands where a misalignment does nothing to first order.
ANY, NEVER = "any error", "never"
#: Up to this part a number is told in three digits alone; values within it are alike by symmetry.
_CERTAIN, _ALIKE = 0.02, 1.01
#: "about x and about z".
_TWICE = re.compile(r"(along|about) (\w+) and \1 (\w+)")


class KeyRow(NamedTuple):
    """A design in the table."""

    series: int
    label: str
    """What stands at its curves."""
    words: str
    """What is released."""
    cells: tuple[str, ...]
    """As many as there are headings."""


class Key(NamedTuple):
    """The table.

    Attributes:
        heads: Of the columns for which there are values.
        rows: A design each.
    """

    heads: tuple[str, ...]
    rows: tuple[KeyRow, ...]


def key_of(cost: CostValues) -> Key:
    """The table of a cost: columns of which the deck allows nothing are left out."""
    shift = f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")
    place = None if cost.tightest is None else cost.tightest.misalignment
    columns = {
        f"tolerance ({shift})": [_tightest(each, place) for each in cost.designs],
        "buckles at": [_buckles(each, place) for each in cost.designs],
        "worst stiffness kept": [_kept(each) for each in cost.designs],
        "frequency": [_frequency(each) for each in cost.designs],
        "lowest parasitic": [_parasitic(each) for each in cost.designs],
    }
    shown = {head: cells for head, cells in columns.items() if any(cells[1:] or cells)}
    if len(cost.designs) > 1 and len(set(shown.get("frequency", "12"))) == 1:
        # The same of all: it is told once, and tells nothing here.
        del shown["frequency"]
    rows = (
        KeyRow(
            series,
            label,
            _words(design),
            tuple(cells[series] for cells in shown.values()),
        )
        for series, (label, design) in enumerate(zip(short_labels(cost), cost.designs, strict=True))
    )
    return Key(tuple(shown), tuple(rows))


def choices_of(cost: CostValues) -> tuple[str, ...]:
    """What was asked for, in parts: of what, where, and how."""
    beams = "8 and 16 beams a sheet" if cost.beams == "auto" else f"{cost.beams} beams a sheet"
    told = (
        file_name(cost.name),
        f"at {cost.point.words}",
        f"held deformations {cost.held}",
        f"drive {cost.drive}",
        beams,
        f"lowest frequency {_frequency(cost.as_built)}" if _frequency(cost.as_built) else "",
    )
    return tuple(harmless(each) for each in told if each)


def typeset(words: str) -> str:
    """Words of quantities as they are set in pictures."""
    for plain, proper in (
        (" um", " \N{MICRO SIGN}m"),
        ("/um", "/\N{MICRO SIGN}m"),
        (" urad", " \N{MICRO SIGN}rad"),
        ("+-", "\N{PLUS-MINUS SIGN}"),
        (" -> ", " \N{RIGHTWARDS ARROW} "),
    ):
        words = words.replace(plain, proper)
    return _TWICE.sub(r"\1 \2 and \3", words)


def _words(design: Design) -> str:
    """What is released, and what is alike."""
    words = design.words.removeprefix("released: ")
    many = len(design.alike)
    return f"{words} (and {many} alike)" if many else words


def _tightest(design: Design, place: Misalignment | None) -> str:
    found = design.tightest
    if found is None:
        return ANY if design.tolerances else ""
    return _with_place(found.tightest, found, place)


def _buckles(design: Design, place: Misalignment | None) -> str:
    """Where it buckles; the place is told if no other column tells it."""
    found = design.buckles_at
    if found is None:
        return NEVER if design.tolerances else ""
    told = place if design.tightest is None else design.tightest.misalignment
    if _critical(design, told) <= _ALIKE * found.critical.value:
        return typeset(in_words(_rounded(found.critical), found.misalignment.unit))
    return _with_place(found.critical, found, place)


def _critical(design: Design, place: Misalignment | None) -> float:
    """At which error of a place it buckles; infinite where none does."""
    found = (each for each in design.tolerances if each.misalignment == place)
    return next((each.critical.value for each in found), math.inf)


def _with_place(number: Number, found: Tolerance, place: Misalignment | None) -> str:
    """A misalignment in words; that of which the headline speaks by its size alone."""
    where = found.misalignment
    size = typeset(in_words(_rounded(number), where.unit))
    if where == place:
        return size
    direction = where.direction.replace("r", "about ")
    return f"{size} ({where.clamp.label}, {direction})"


def _rounded(number: Number) -> Number:
    """To three digits where it is that certain; a table is for comparing."""
    if abs(number.uncertainty) < _CERTAIN * abs(number.value):
        return Number(float(f"{number.value:.3g}"))
    return number


def _kept(design: Design) -> str:
    if design.kept is None:
        return "" if design.released else "100 %"
    return f"{percent(round(design.kept.smallest.value, 3))} {typeset(design.kept.words)}"


def _frequency(design: Design) -> str:
    if design.frequencies is None or not design.frequencies.value.size:
        return ""
    first = Number(*(float(part[0]) for part in design.frequencies))
    return in_words(_rounded(first), "Hz") if first.value > 0.0 else "buckled"


def _parasitic(design: Design) -> str:
    """At rest, and where the stroke makes it lowest."""
    first = design.first_parasitic
    if first is None:
        return ""
    told = in_words(_rounded(first), "Hz")
    along = None if design.stroke is None else design.stroke.parasitic
    if along is None or not along.value.size:
        return told
    k = int(np.argmin(along.value[:, 0]))
    least = Number(float(along.value[k, 0]), float(along.uncertainty[k, 0]))
    if least.value > 0.99 * first.value:
        return told
    lowest = in_words(_rounded(least), "Hz")
    if told.endswith(" Hz") and lowest.endswith(" Hz"):
        told = told.removesuffix(" Hz")
    return typeset(f"{told} -> {lowest}")
