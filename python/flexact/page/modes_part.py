# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses with their largest parts."""

from __future__ import annotations

from ..result.modes import Motion, SelfStress
from ..result.result import Result
from ..text.naming import (
    coordinate_in_words,
    deformation_in_words,
    unit_of,
    unit_of_coordinate,
)
from .limits import MOST_MODES, MOST_PARTS
from .markup import bar, linked, number, row, section, table

#: How many tables are open at first.
_OPEN = 2


def motions_part(analysis: Result, drawn: int) -> str:
    """The motions; the first `drawn` of them can be seen in the drawing."""
    parts = [
        _mode(f"Motion {k}", f"movement {k - 1}" if k <= drawn else "", _of_motion(motion), k)
        for k, motion in enumerate(analysis.motions[:MOST_MODES], start=1)
    ]
    return _modes("Motion", "s", analysis.under_constrained, parts)


def stresses_part(analysis: Result) -> str:
    """The self-stresses."""
    parts = [
        _mode(f"Self-stress {k}", f"stress {k - 1}", _of_stress(analysis, stress), k)
        for k, stress in enumerate(analysis.self_stresses[:MOST_MODES], start=1)
    ]
    return _modes("Self-stress", "es", analysis.over_constrained, parts)


def _modes(what: str, ending: str, count: int, parts: list[str]) -> str:
    """Some of so many motions or self-stresses, and what is to be known of all."""
    if not count:
        return ""
    title = f"{what}{ending}"
    note = "Relative values: only their ratios matter."
    if count > 1:
        note += (
            f" These {title.lower()} are one basis of many: any combination of them is also one."
        )
    more, rest = "", count - MOST_MODES
    if rest > 0:
        words = f"and {rest} more {what.lower()}{ending * (rest > 1)}."
        more = f'<p class="note">\N{HORIZONTAL ELLIPSIS} {words}</p>'
    # Such as "stresses".
    name = title.lower().rpartition("-")[2]
    return section(name, title, f'<p class="note">{note}</p>', *parts, more)


def _mode(title: str, shown_by: str, content: str, place: int) -> str:
    show = (
        f'<button type="button" class="show" data-show="{shown_by}">Show '
        f'<span class="unseen">{title}</span></button>'
        if shown_by
        else ""
    )
    opened = " open" if place <= _OPEN else ""
    return (
        f'<div class="mode">{show}<details{opened}><summary>{title}</summary>{content}'
        "</details></div>"
    )


def _of_motion(motion: Motion) -> str:
    parts, analysis = motion.largest(MOST_PARTS), motion.analysis
    length = analysis.characteristic_length
    sizes = [value * (length if name.startswith("r") else 1.0) for _, name, value in parts]
    rows = (
        row(
            linked(coordinate_in_words(analysis, node, name)),
            number(value),
            unit_of_coordinate(name),
            bar(size / _largest(sizes)),
            about=f' data-node="{node}"',
        )
        for (node, name, value), size in zip(parts, sizes, strict=True)
    )
    return table(("what moves", "value", "unit", ""), rows, kind="parts")


def _of_stress(analysis: Result, stress: SelfStress) -> str:
    parts = stress.largest(MOST_PARTS)
    units = [unit_of(analysis, element, mode) for element, mode, _ in parts]
    length = analysis.characteristic_length
    sizes = [
        value / (1.0 if unit == "N" else length)
        for (_, _, value), unit in zip(parts, units, strict=True)
    ]
    rows = (
        row(
            linked(deformation_in_words(analysis, element, mode)),
            number(value),
            unit.replace(" ", "\N{NO-BREAK SPACE}"),
            bar(size / _largest(sizes)),
            about=f' data-element="{element}"',
        )
        for (element, mode, value), unit, size in zip(parts, units, sizes, strict=True)
    )
    return table(("what is stressed", "value", "unit", ""), rows, kind="parts")


def _largest(sizes: list[float]) -> float:
    return max(map(abs, sizes), default=1.0) or 1.0
