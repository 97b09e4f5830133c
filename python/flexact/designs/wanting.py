# SPDX-License-Identifier: BSD-3-Clause
"""The wanted motions of a problem: from sentences and tables to independent twists."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..advice.spaces.spaces import Spaces
from ..advice.spaces.wanted_motion import (
    Written,
    numbers,
    pitch_of,
    place_of,
    read_all,
    wanted_of,
)
from ..analysis.result import Result
from ..analysis.screws import ScrewKind
from ..core.arrays import FloatArray
from ..deck.rendering import ProblemsError, model_error
from ..util.quantities import QuantityError
from ..util.text import in_short
from .entries import Entries
from .problem import Motion
from .texts import Path

#: Motions that are looked at; a body has six.
_MOST_MOTIONS = 100
#: Motions are dependent where the least singular value of them, each of unit size with L, is at
#: most the first; up to the second it is asked whether they are.
_DEPENDENT, _NEARLY_DEPENDENT = 1.0e-9, 1.0e-4
#: Pitches in parts of L: up to the first a screw is taken as a rotation, and beyond its inverse as
#: a translation; up to the second it is asked whether it is one.
_ROTATION, _NEARLY_ROTATION = 1.0e-6, 1.0e-4

_AXES = dict(zip("xyz", np.eye(3), strict=True))
_KINDS = {str(each): each for each in ScrewKind if each is not ScrewKind.NONE}


class Line(NamedTuple):
    """A wanted motion as it is read, before there is a centre."""

    path: Path
    kind: ScrewKind
    direction: FloatArray
    """(3,) of any length."""
    point: FloatArray | None
    """(3,) [m]; None for the centre."""
    pitch: float
    """[m/rad]"""
    text: str


def lines_of(
    entries: Entries,
    path: Path,
    given: object,
    result: Result | None = None,
    held: Spaces | None = None,
) -> list[Line]:
    """The wanted motions of an entry: a sentence, a table, or several.

    Args:
        entries: Where errors are kept.
        path: Its keys.
        given: It.
        result: The analysis of the model that the stage is of, whose points have names.
        held: What the stage can do in it: as in `advise`, a rotation without a point is about the
            line nearest to its middle which it can turn about.
    """
    listed = [(path, given)] if isinstance(given, (str, dict)) else given
    if not isinstance(listed, list):
        message = f"wanted motions are a list, not {in_short(given)}"
        entries.wrong(path, message, code="bad-wanted")
        return []
    if listed is given:
        listed = [((*path, k), each) for k, each in enumerate(listed)]
    if len(listed) > _MOST_MOTIONS:
        message = f"{len(listed)} motions are wanted: a body has six"
        entries.wrong(path, message, code="bad-wanted")
        return []
    made: list[Line] = []
    for place, each in listed:
        if isinstance(each, dict):
            made += _of_table(entries, place, each, result)
        elif isinstance(each, str):
            made += _of_sentence(entries, place, each, result, held)
        else:
            message = f"a wanted motion is a text or a table, not {in_short(each)}"
            hint = 'write "rotation about (0, 0, 0) along x", or a table with kind and direction'
            entries.wrong(place, message, hint, code="bad-wanted")
    return made


def _of_sentence(
    entries: Entries, path: Path, text: str, result: Result | None, held: Spaces | None
) -> Iterator[Line]:
    try:
        for each in read_all(text, units=entries.units):
            point = None
            if each.kind in (ScrewKind.ROTATION, ScrewKind.SCREW):
                if each.point:
                    point = _point(entries, each, result)
                elif each.point is None and result is not None and held is not None:
                    point = wanted_of(result, held.freedom, each).point
            if each.kind is not ScrewKind.NONE:
                yield Line(path, each.kind, each.direction, point, each.pitch, each.text.strip())
    except ProblemsError as error:
        entries.told(path, error)


def _point(entries: Entries, written: Written, result: Result | None) -> FloatArray:
    """(3,) the point of a motion [m].

    Raises:
        ModelError: it is none.
    """
    word = written.point or ""
    if word.startswith("("):
        return numbers(written.text, word, (3,), entries.units)
    if result is None:
        what = f"{in_short(word)} in {in_short(written.text)} is no point"
        raise model_error("no-such-point", what, "write it as (x, y, z)")
    return place_of(result, written)


def _of_table(
    entries: Entries, path: Path, given: dict[str, Any], result: Result | None
) -> Iterator[Line]:
    """The motion of a table with kind, direction, point and pitch; none if any is wrong."""
    count = entries.total
    entries.known_keys(path, given, "a wanted motion", ("kind", "direction", "point", "pitch"))
    named, direction, point, pitch = map(given.get, ("kind", "direction", "point", "pitch"))
    kind = _KINDS.get(named.strip().lower()) if isinstance(named, str) else None
    if kind is None:
        message = f"{in_short(named)} is no kind of motion"
        message = "a wanted motion has no kind" if named is None else message
        entries.no_such((*path, "kind"), message, named, _KINDS, code="bad-wanted")
        return

    def wrong(key: str, message: str, hint: str) -> None:
        entries.wrong((*path, key), message, hint, code="bad-wanted")

    sense = -1.0 if isinstance(direction, str) and direction.startswith("-") else 1.0
    axis = _AXES.get(direction.lower().lstrip("+-")) if isinstance(direction, str) else None
    if direction is None:
        wrong("direction", f"the {kind} has no direction", "write direction = [1, 0, 0]")
    elif axis is None:
        axis = entries.three((*path, "direction"), direction, "the direction", "")
        if axis is not None and not axis.any():
            wrong("direction", "the direction is zero", "write that of its axis, as [1, 0, 0]")
    place = None
    if isinstance(point, str) and kind is not ScrewKind.TRANSLATION:
        try:
            written = Written(point, None, kind, np.zeros(3), point.strip(), 0.0)
            place = _point(entries, written, result)
        except ProblemsError as error:
            entries.told((*path, "point"), error)
    elif point is not None:
        place = entries.three((*path, "point"), point, "the point")
    length = 0.0
    if kind is ScrewKind.SCREW:
        if pitch is None:
            wrong("pitch", "a screw needs a pitch", "write pitch = 0.01, in m/rad, or a rotation")
        elif isinstance(pitch, str):
            try:
                length = pitch_of(pitch, entries.units)
            except QuantityError as error:
                wrong("pitch", f"the pitch: {error}", "")
        else:
            length = entries.number((*path, "pitch"), pitch, "the pitch", "m")
    elif pitch not in (None, 0, math.inf if kind is ScrewKind.TRANSLATION else 0):
        wrong("pitch", f"a {kind} has no pitch", "write screw, or leave it out")
    if entries.total == count and axis is not None:
        yield Line(path, kind, sense * axis, place, length, "")


def motions_of(
    entries: Entries, lines: Sequence[Line], centre: FloatArray, size: float
) -> tuple[Motion, ...]:
    """The motions about the centre; those that depend on each other are wrong.

    A screw of hardly any pitch is taken as a rotation, and one of an enormous pitch as a
    translation, with a remark. Of several motions the pitch of one decides nothing by itself: what
    counts is the space of all, of which `possible` tells whether it is nearly special.
    """
    made: list[Motion] = []
    least = _NEARLY_ROTATION if len(lines) == 1 else 0.0
    for each in lines:
        point = centre if each.point is None else each.point
        kind, part = each.kind, abs(each.pitch) / size
        if kind is ScrewKind.SCREW and not least < part < 1.0 / _NEARLY_ROTATION:
            said = Motion.of(kind, each.direction, point, each.pitch, centre, each.text).text
            near = ScrewKind.ROTATION if part < 1.0 else ScrewKind.TRANSLATION
            told = f"{part:.2g} times L, {entries.units.said(size, 'm')}"
            if part <= _ROTATION or part >= 1.0 / _ROTATION:
                kind = near
                entries.remarks.append(
                    f"{in_short(said)} is taken as a {near}: its pitch is {told}"
                )
            elif math.isfinite(part):
                entries.wrong(
                    each.path,
                    f"the pitch of {in_short(said)} is {told}",
                    f"is it a {near}? write {near}, or a pitch between 1e-4 and 1e4 times L",
                    code="bad-wanted",
                )
        made.append(Motion.of(kind, each.direction, point, each.pitch, centre, each.text))
    rows = np.array([each.twist for each in made]).reshape(-1, 6) * np.repeat((size, 1.0), 3)
    if np.isfinite(rows).all():
        _require_independent(entries, lines, made, rows)
    return tuple(made)


def _require_independent(
    entries: Entries, lines: Sequence[Line], made: Sequence[Motion], rows: FloatArray
) -> None:
    """Keep which motion is the first that follows from those before it, or nearly does.

    Args:
        entries: Where errors are kept.
        lines: The motions as they were read.
        made: The motions.
        rows: (n, 6) their twists, rotations times L.
    """
    # Of unit size each: what turns about a line far away is nearly a translation.
    rows = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    for last in range(1, len(rows)):
        left, values, _ = np.linalg.svd(rows[: last + 1])
        least = float(values[-1]) if last < 6 else 0.0
        if least > _NEARLY_DEPENDENT:
            continue
        shares = np.abs(left[:-1, -1])
        others = np.flatnonzero(shares > 1.0e-3 * shares.max()).tolist()
        names = [in_short(made[k].text) for k in others]
        before = f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else names[0]
        nearly = "" if least <= _DEPENDENT else "nearly "
        how = f"is {nearly}the same motion as" if len(names) == 1 else f"{nearly}follows from"
        message = f"{in_short(made[last].text)} {how} {before}"
        hint = "leave one of them out: motions that are wanted are independent"
        if nearly:
            message += f": only {least:.2g} of it is another one"
            hint = "are they meant to be one? leave one of them out, or put them further apart"
        other = lines[others[0]].path
        entries.wrong(lines[last].path, message, hint, code="dependent-motions", other=other)
        return


def require_free(
    entries: Entries,
    lines: Sequence[Line],
    made: Sequence[Motion],
    centre: FloatArray,
    held: Spaces,
) -> None:
    """Keep which motions are stopped by the model that the stage is of."""
    away = held.freedom.about - centre
    for line, motion in zip(lines, made, strict=True):
        turn, velocity = motion.twist[:3], motion.twist[3:]
        if not held.freedom.has(np.concatenate((turn, velocity + np.cross(turn, away)))):
            entries.wrong(
                line.path,
                f"{in_short(motion.text)} is stopped by what holds "
                f"{in_short(held.subject.name)} already",
                "take that out of the deck, or want something else",
                code="bad-wanted",
            )
