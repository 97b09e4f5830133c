# SPDX-License-Identifier: BSD-3-Clause
"""Some results beside each other: a row each, with a picture in a notebook."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from functools import partial
from typing import overload

import numpy as np

from ...advice.describe import MOST_MODES, verdict_in_words
from ...analysis.mode_words import conflict_in_words, motion_in_parts, stress_in_parts
from ...analysis.naming import Pieces, counted, plain
from ...analysis.places import listed
from ...analysis.result import Modes, Motion, Result, SelfStress
from ...analysis.verdict_words import margin_in_short, verdict_word
from ...core.elements import Class, NodeKind
from ...deck.rendering import ProblemsError
from ...model.data import ModelData
from ...model.parts.parts import PartKind, Parts
from ...util.errors import require_kind
from ...util.partial import attempted, why
from ...util.text import file_name, harmless
from ..page.assets import text
from ..page.content import kind_of
from ..picture import has_packages, model_bytes
from .output import SMALL, WHOLE, shown, still, table, verdict

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


_PLURALS = {PartKind.BODY: "bodies"}


def html_of_model(data: ModelData) -> str:
    """What a model is made of so far, a picture of it, and what is wrong with it."""
    name = f"<b>{text(data.name)}</b><br>" if data.name else ""
    told = "".join(f"<br>{text(each)}" for each in _problems(data) if each)
    return f"<div><p>{name}{text(_made_of(data))}{told}</p>{_picture(data)}</div>"


def _made_of(data: ModelData) -> str:
    """Such as "2 sheets and 1 body; 8 nodes, 4 of them fixed; 1 degree of freedom declared."."""
    arrays = data.arrays
    elements, nodes = arrays.element_number.size, arrays.node_number.size
    if not elements:
        return "A model without elements so far."
    kinds = Counter(part.kind for part in Parts(data).all)
    parts = listed([_counted(count, kind) for kind, count in kinds.items()])
    classes = arrays.coordinate_class
    held = np.any(classes == Class.FIXED, axis=0) & (arrays.node_kind <= NodeKind.POSITION)
    supports = int(np.count_nonzero(held))
    free = int(np.count_nonzero(classes == Class.INDEPENDENT))
    free += int(np.count_nonzero(arrays.deformation_class == Class.INDEPENDENT))
    return (
        f"{parts} ({elements} elements, {nodes} nodes); "
        f"{counted(supports, 'point', '', 's')} held; "
        f"{counted(free, 'degree', '', 's')} of freedom declared. Not analysed yet."
    )


def _counted(count: int, kind: PartKind) -> str:
    return f"{count} {kind.value if count == 1 else _PLURALS.get(kind, f'{kind.value}s')}"


def _problems(data: ModelData) -> list[str]:
    """Errors that an analysis would end with."""
    try:
        data.require_sound()
    except ProblemsError as error:
        first = error.diagnostics[0]
        return [f"It cannot be analysed yet: {first.message}.", first.help or ""]
    return []


def _picture(data: ModelData) -> str:
    if not has_packages() or not data.arrays.element_number.size:
        return ""
    try:
        content = model_bytes(data, ".png", size=WHOLE)
    except Exception as error:
        # A model that is not sound may have no drawing.
        if not data.problems.errors:
            why(error)
        return ""
    return shown(content, WHOLE, "the model in its reference shape")


#: How many rows have a picture: each takes some tenths of a second.
MOST_PICTURES = 40
_HEADS = ("", "mechanism", "verdict", "motions", "self-stresses", "margin")


class Results(Sequence[Result]):
    """Results in a row, which a notebook shows as a table with pictures.

    Args:
        results: Results of `analyse`, such as those of some designs.

    Raises:
        TypeError: One of them is no result.
    """

    def __init__(self, results: Iterable[Result]) -> None:
        """Keep them in their order."""
        self._all = tuple(results)
        for each in self._all:
            require_kind(each, Result, "a table of results holds results of analyse()")

    def __len__(self) -> int:
        """How many there are."""
        return len(self._all)

    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> Results: ...
    def __getitem__(self, index: int | slice) -> Result | Results:
        """One of them, or several."""
        return Results(self._all[index]) if isinstance(index, slice) else self._all[index]

    def __repr__(self) -> str:
        """A line each."""
        rows = [_words(each) for each in self._all]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = (
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
            for row in rows
        )
        return "\n".join(lines) or "no results"

    def _repr_html_(self) -> str:
        rows = [_cells(each, k < MOST_PICTURES) for k, each in enumerate(self._all)]
        return table(_HEADS, rows) if rows else "<p>No results.</p>"


def _words(result: Result) -> tuple[str, ...]:
    name = harmless(file_name(result.name)) or "model"
    counts = str(result.under_constrained), str(result.over_constrained)
    return name, verdict_word(result), *counts, margin_in_short(result)


def _cells(result: Result, is_pictured: bool) -> tuple[str, ...]:
    name, word, *others = _words(result)
    picture = still(result, SMALL, str(verdict_in_words(result))) if is_pictured else ""
    told = verdict(result.colour, kind_of(result)[1], word)
    return picture, f"<b>{text(name)}</b>", told, *map(text, others)
