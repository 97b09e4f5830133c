# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses with their largest parts."""

from __future__ import annotations

from ...analysis.mode_words import conflict_in_words, stress_in_parts
from ...analysis.modes import Motion, SelfStress
from ...analysis.motions import motion_in_parts
from ...analysis.result import Result
from ...analysis.sentences import Line, Named, Pieces
from .limits import MOST_MODES, MOST_PARTS
from .markup import flowing, linked, row, section, table, text

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
        _mode(f"Self-stress {k}", f"stress {k - 1}", _of_stress(stress), k)
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
    """A row for all that moves as one."""
    rows = [_row(pieces) for pieces in motion_in_parts(motion, MOST_PARTS)[:MOST_PARTS]]
    return table(("what moves", "how"), rows, kind="parts")


def _of_stress(stress: SelfStress) -> str:
    """Which parts fight, and a row for each part that carries something."""
    conflict = conflict_in_words(stress)
    start = f"<p>{flowing(Line(conflict))}.</p>" if conflict else ""
    rows = [_row(pieces) for pieces in stress_in_parts(stress, MOST_PARTS)[:MOST_PARTS]]
    return start + table(("what is stressed", "with"), rows, kind="parts")


def _row(pieces: Pieces) -> str:
    """Names, and in a cell the words behind them."""
    *named, words = pieces if isinstance(pieces[-1], str) else (*pieces, "")
    first = next((piece for piece in named if isinstance(piece, Named)), None)
    about = f' data-{first.kind}="{first.number}"' if first is not None else ""
    return row(linked(tuple(named)), text(str(words).lstrip(": ")), about=about)
