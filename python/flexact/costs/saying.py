# SPDX-License-Identifier: BSD-3-Clause
"""What is said about a cost as a whole: how far its stroke went, and what was left out."""

from __future__ import annotations

from collections.abc import Sequence

from ..analysis.result import Result
from .along import Along
from .along import Asked as StrokeValues
from .designs import Design, Stroke
from .measuring import Measures
from .request import Asked
from .resolve import Places
from .values import words_of_direction

#: From so many beams a sheet on, tolerances are right to some percent (stiffness of thin sheets to
#: lateral buckling hangs on what happens between elements).
ENOUGH = 8
#: How far off one beam a sheet was found to be.
_OPTIMISTIC = 80


def stroke_in_words(
    places: Places, values: StrokeValues | None, asked: Asked, ways: Sequence[Along]
) -> Stroke | None:
    """The stroke as far as every design could be followed; None where none was asked for."""
    if values is None:
        return None
    owner = places.words(values.node)
    words = f"node {values.node} ({owner}) {words_of_direction(values.coordinate)}"
    whole = (float(values.values[0]), float(values.values[-1]))
    low = max((way.ends[0] for way in ways), default=whole[0])
    high = min((way.ends[1] for way in ways), default=whole[1])
    why = next((way.why for way in ways if way.why), "")
    reached = (max(low, whole[0]), min(high, whole[1])) if why else whole
    return Stroke(values.node, values.coordinate, words, values.rest, whole, reached, why)


def left_out(
    places: Places,
    measures: Measures,
    asked: Asked,
    result: Result,
    designs: Sequence[Design],
) -> tuple[str, ...]:
    """What the deck's data do not allow, and what was not looked at."""
    made = []
    if isinstance(asked.beams, int) and asked.beams < ENOUGH:
        made.append(
            f"with so few beams a sheet tolerances come out too large, with one up to "
            f'{_OPTIMISTIC} times: --beams auto (beams="auto") refines by itself and shows what is '
            "left open"
        )
    if not measures.has_masses:
        made.append(
            "no masses are given (EM, XM): there are no frequencies, and tolerances are those for "
            "a shift of the lowest stiffness of the driven point"
        )
    elif not measures.drives and asked.drive == "free":
        made.append(
            "no coordinate is declared (DYNX): no frequency is known to be the drive's, and all of "
            "them count as parasitic"
        )
    if result.over_constrained and asked.release is None and len(designs) == 1:
        made.append("no proven release was found; name one with --release (release=)")
    whole = result.with_internal_declared or result
    if whole.under_constrained:
        made.append(
            f"under-constrained by {whole.under_constrained} as declared; what is elastic may "
            "hold these motions all the same"
        )
    return tuple(made)
