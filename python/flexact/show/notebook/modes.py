# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses in a notebook: a picture of each, and what moves or is stressed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ...advice.describe import MOST_MODES
from ...analysis.mode_words import conflict_in_words, stress_in_parts
from ...analysis.modes import Modes, Motion, SelfStress
from ...analysis.motions import motion_in_parts
from ...analysis.result import Result
from ...analysis.sentences import Pieces, plain
from ...util.partial import attempted
from ..page.markup import text
from .stills import SMALL, still
from .tables import table

#: How many parts a row tells.
_PARTS = 6


def html_of(analysis: Result, what: object) -> str | None:
    """A motion, a self-stress, or a row of them as a table; None of anything else."""
    if isinstance(what, Modes):
        return _table(analysis, what.kind is Motion, tuple(what[:MOST_MODES]), len(what))
    if isinstance(what, (Motion, SelfStress)):
        return _table(analysis, isinstance(what, Motion), (what,), 1)
    return None


def _table(analysis: Result, moves: bool, modes: Sequence[Motion | SelfStress], count: int) -> str:
    what = "motion" if moves else "self-stress"
    if not count:
        return f"<p>No {what}{'s' if moves else 'es'}.</p>"
    missing: list[str] = []
    rows = [
        row
        for k, mode in enumerate(modes, start=1)
        if (row := attempted(f"Row {k}", partial(_row, analysis, mode), None, missing))
    ]
    heads = ("", "", "what moves, and how" if moves else "what is stressed, and with what")
    note = "Relative values: only their ratios matter."
    if count > len(rows):
        note += f" Of {count} the first {len(rows)} are shown."
    note += "".join(f" {each}" for each in missing)
    if len(modes) > 1:
        note += " They are one basis of many: any combination of them is also one."
    return f"{table(heads, rows)}<p><small>{text(note)}</small></p>"


def _row(analysis: Result, mode: Motion | SelfStress) -> tuple[str, str, str]:
    number = mode.index + 1
    if isinstance(mode, Motion):
        title, parts = f"Motion {number}", motion_in_parts(mode, _PARTS)
        lead: Pieces = ()
        picture = still(analysis, SMALL, title, motion=number)
    else:
        title, lead = f"Self-stress {number}", conflict_in_words(mode)
        parts = stress_in_parts(mode, _PARTS)
        picture = still(analysis, SMALL, title, stress=number)
    return f"<b>{title}</b>", picture, _told(lead, parts)


def _told(lead: Pieces, parts: Sequence[Pieces]) -> str:
    items = "".join(f"<li>{text(plain(each))}</li>" for each in parts[:_PARTS])
    more = "<li>\N{HORIZONTAL ELLIPSIS}</li>" if len(parts) > _PARTS else ""
    start = f"{text(plain(lead))}:" if lead else ""
    return f"{start}<ul style='margin:0;padding-left:1.2em'>{items}{more}</ul>"
