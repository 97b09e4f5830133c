"""Motions and self-stresses with their largest parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..deformation_words import deformation_word
from ..modes import Motion, SelfStress
from ..words import unit_of
from .limits import MOST_MODES, MOST_PARTS
from .markup import bar, link, number, row, section, table, text

if TYPE_CHECKING:
    from ..analysis import Analysis

#: So many tables are open at first.
_OPEN = 2


def motions_part(analysis: Analysis, drawn: int) -> str:
    """The motions; the first `drawn` of them can be seen in the scene."""
    if not analysis.under_constrained:
        return ""
    parts = [
        _mode(f"Motion {k}", f"movement {k - 1}" if k <= drawn else "", _of_motion(motion), k)
        for k, motion in enumerate(analysis.motions[:MOST_MODES], start=1)
    ]
    note = "Relative values: only their ratios matter." + _basis(
        analysis.under_constrained, "motions"
    )
    more = _more(analysis.under_constrained, "motion", "s")
    return section("motions", "Motions", f'<p class="note">{note}</p>', *parts, more)


def stresses_part(analysis: Analysis) -> str:
    """The self-stresses."""
    if not analysis.over_constrained:
        return ""
    parts = [
        _mode(f"Self-stress {k}", f"stress {k - 1}", _of_stress(analysis, stress), k)
        for k, stress in enumerate(analysis.self_stresses[:MOST_MODES], start=1)
    ]
    note = "Relative values: only their ratios matter." + _basis(
        analysis.over_constrained, "self-stresses"
    )
    more = _more(analysis.over_constrained, "self-stress", "es")
    return section("stresses", "Self-stresses", f'<p class="note">{note}</p>', *parts, more)


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
    parts = motion.largest(MOST_PARTS)
    length = motion.analysis.characteristic_length
    sizes = [value * (length if name.startswith("r") else 1.0) for _, name, value in parts]
    rows = (
        row(
            link("node", node, f"node {node}"),
            text(name),
            number(value),
            "rad" if name.startswith("r") else "m",
            bar(size / _largest(sizes)),
            about=f' data-node="{node}"',
        )
        for (node, name, value), size in zip(parts, sizes, strict=True)
    )
    return table(("node", "coordinate", "value", "unit", ""), rows, kind="parts")


def _of_stress(analysis: Analysis, stress: SelfStress) -> str:
    parts = stress.largest(MOST_PARTS)
    index_of, kinds = analysis.data.element_index, analysis.data.arrays.element_kind
    units = [unit_of(analysis, index_of[element], mode) for element, mode, _ in parts]
    length = analysis.characteristic_length
    sizes = [
        value / (1.0 if unit == "N" else length)
        for (_, _, value), unit in zip(parts, units, strict=True)
    ]
    rows = (
        row(
            link("element", element, f"element {element}") + _name(analysis, index_of[element]),
            text(f"e{mode} {deformation_word(kinds[index_of[element]], mode)}"),
            number(value),
            unit.replace(" ", "\N{NO-BREAK SPACE}"),
            bar(size / _largest(sizes)),
            about=f' data-element="{element}"',
        )
        for (element, mode, value), unit, size in zip(parts, units, sizes, strict=True)
    )
    return table(("element", "deformation", "value", "unit", ""), rows, kind="parts")


def _name(analysis: Analysis, index: int) -> str:
    name = analysis.data.element_names[index]
    return f'<span class="called">{text(name)}</span>' if name else ""


def _largest(sizes: list[float]) -> float:
    return max(map(abs, sizes), default=1.0) or 1.0


def _basis(count: int, what: str) -> str:
    if count == 1:
        return ""
    return f" These {what} are one basis of many: any combination of them is also one."


def _more(count: int, what: str, ending: str) -> str:
    if count <= MOST_MODES:
        return ""
    rest = count - MOST_MODES
    words = f"\N{HORIZONTAL ELLIPSIS} and {rest} more {what}{ending * (rest > 1)}."
    return f'<p class="note">{words}</p>'
