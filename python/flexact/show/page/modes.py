# SPDX-License-Identifier: BSD-3-Clause
"""Movements and self-stresses as data of a page."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import chain
from typing import Any

from ...analysis.freedoms import Freedom
from ...analysis.naming import freedom_in_words
from ...analysis.result import Result
from ...analysis.sentences import plain
from ...util.partial import attempted
from ..drawing import QUANTITIES, UNITS, Drawing, Movement, Moving, move, reach_of, resultants
from ..drawing.freedoms import way_of
from .drawing import Frame, hinges_in
from .limits import FEW_MODES, MANY_ELEMENTS, MOST_ELEMENTS, MOST_MEMBERS, MOST_MODES, MOST_POSES
from .packing import floats
from .tracks import Tracks

#: Below this part of the largest resultant a quantity is rounding.
_NOTHING = 1.0e-9
#: Displacements (parts of the drawing's size) and rotations [rad] that nobody sees.
_UNSEEN = 1.0e-5


def movements(analysis: Result, tracks: Tracks, missing: list[str]) -> list[dict[str, Any]]:
    """The motions, then the declared degrees of freedom; as many as fit and can be drawn.

    What cannot be drawn is told in `missing`; of motions none is drawn behind it, as their
    places are their numbers.
    """
    made: list[dict[str, Any]] = []
    size, drawing = 0, tracks.frame.drawing
    without: set[str] = set()

    def drawn(motion: Callable[[], Moving | None]) -> tuple[dict[str, Any], int] | None:
        if (found := motion()) is None:
            return None
        movement = move(drawing, found)
        data, added = tracks.movement(movement)
        return {"note": _note(drawing, movement), **data}, added

    for kind, label, title, motion in chain(_motions(analysis), _freedoms(analysis)):
        if kind == "motion" and kind in without:
            continue
        before = len(missing)
        data = attempted(f"The drawing of {title}", partial(drawn, motion), None, missing)
        if len(missing) > before:
            without.add(kind)
        if data is None:
            continue
        size += data[1]
        if made and size > MOST_POSES:
            break
        made.append({"kind": kind, "label": label, "title": title, **data[0]})
    return made


_Named = tuple[str, str, str, Callable[[], Moving | None]]


def _motions(analysis: Result) -> Iterator[_Named]:
    is_large = analysis.given.arrays.element_number.size > MANY_ELEMENTS
    most = FEW_MODES if is_large else MOST_MODES
    for number, motion in enumerate(analysis.motions[:most], start=1):
        yield "motion", f"Motion {number}", f"Motion {number}", partial(_itself, motion)


def _itself(motion: Moving) -> Moving:
    return motion


def _freedoms(analysis: Result) -> Iterator[_Named]:
    for freedom in looked_at(analysis):
        words = plain(freedom_in_words(freedom))
        yield "freedom", words, f"Degree of freedom: {words}", partial(way_of, freedom)


def looked_at(analysis: Result) -> tuple[Freedom, ...]:
    """The declared degrees of freedom whose motions are asked for."""
    if analysis.given.arrays.element_number.size > MOST_ELEMENTS:
        return ()
    return analysis.freedoms[:MOST_MODES]


def _note(drawing: Drawing, movement: Movement) -> str:
    """On what the poses lie, and how far they go."""
    largest, angle = reach_of(drawing, (movement.poses[0], movement.poses[-1]))
    share = largest / drawing.size
    far = "no displacements"
    if share > _UNSEEN:
        far = f"displacements up to {100 * share:.2g}\N{NO-BREAK SPACE}% of the model's size"
    turned = f" and rotations up to {angle:.2g}\N{NO-BREAK SPACE}rad" * (angle > _UNSEEN)
    return f"{movement.remark} Drawn with {far}{turned}."


def stresses(analysis: Result, frame: Frame, missing: list[str]) -> list[dict[str, Any]]:
    """The self-stresses, each with the quantities that it has, up to one that cannot be drawn."""
    rows = hinges_in(frame)
    made: list[dict[str, Any]] = []
    for number, stress in enumerate(analysis.self_stresses[:MOST_MODES], start=1):
        what = f"The drawing of self-stress {number}"
        found = attempted(what, partial(resultants, frame.drawing, stress), None, missing)
        if found is None:
            break
        weight = {each: 1.0 if UNITS[each] == "N" else 1.0 / found.length for each in QUANTITIES}
        sizes = {each: found.largest(each) * weight[each] for each in QUANTITIES}
        there = [each for each in QUANTITIES if sizes[each] > _NOTHING * max(sizes.values())]
        hinges = {each: found.hinges[rows, QUANTITIES.index(each)] for each in there}
        made.append(
            {
                "title": f"Self-stress {number}",
                "dominant": found.dominant,
                "largest": {each: found.largest(each) for each in there},
                "members": {each: floats(found[each][:MOST_MEMBERS]) for each in there},
                "hinges": {each: floats(values) for each, values in hinges.items()},
            }
        )
    return made
