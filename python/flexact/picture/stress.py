# SPDX-License-Identifier: BSD-3-Clause
"""A self-stress on the members: colours along them, and bending diagrams beside them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..base.frozen import Frozen
from ..core.arrays import FloatArray
from ..drawing import BENDING, QUANTITIES, Drawing, Resultants, Strip, stations
from ..drawing.colours import diverging
from ..model.parts.directions import signs_of
from .canvas import Canvas
from .surfaces import OUTLINE

#: Height of the largest bending moment in a diagram, a part of the drawing's size.
_HEIGHT = 0.08
#: A diagram in the plane of a sheet is seen on it: it counts as nearer to the eye by this part
#: and half the thickness, along the line of sight, of which the cosine is at least so large.
_ABOVE, _OBLIQUE = 0.006, 0.25
#: Its pieces end beside those of the members, whose rims would be seen where they met; by this
#: part of a piece.
_BESIDE = 0.42
#: Values below this part of the largest are not drawn.
_LEAST = 1.0e-6
#: Peaks below this part of the largest are not named, and no more than so many are.
_NAMED, _MOST_NAMED = 0.3, 8
#: Values that differ by less than this part of the largest have one colour.
_EVEN = 0.01
#: Of very many members those above this part of the largest value are drawn thicker.
_LOUD = 0.05
#: Pieces of a member for its colours.
PIECES = 36


@dataclass(frozen=True, eq=False)
class Stress(Frozen):
    """One quantity of a self-stress.

    Attributes:
        values: The resultants.
        quantity: One of `QUANTITIES`.
        largest: Its largest magnitude, of members and hinges [N] or [N m].
    """

    values: Resultants
    quantity: str
    largest: float

    def colours(self, member: np.ndarray, at: FloatArray) -> FloatArray:
        """(k, s - 1, 3) of the pieces between stations (s,) of members (k,)."""
        middle = (at[1:] + at[:-1]) / 2
        return self.colours_of(self.values.along(self.quantity, member, middle))

    def member_colours(self) -> FloatArray:
        """(k, 3) of the members by the larger of the values at their ends."""
        ends = self.values[self.quantity]
        high, low = ends.max(axis=1), ends.min(axis=1)
        return self.colours_of(np.where(high >= -low * (1.0 - _EVEN), high, low))

    def is_loud(self) -> np.ndarray:
        """(k,) whether a member has more than a small part of the largest value."""
        return np.asarray(np.abs(self.values[self.quantity]).max(axis=1) > _LOUD * self.largest)

    def hinge_colours(self) -> FloatArray:
        """(h, 3) of the hinges."""
        return self.colours_of(self.values.hinges[:, QUANTITIES.index(self.quantity)])

    def colours_of(self, values: FloatArray) -> FloatArray:
        """(..., 3) of values (...)."""
        return diverging(values / self.largest if self.largest > 0.0 else np.zeros_like(values))

    @property
    def pieces(self) -> int:
        """Of how many pieces a member is, so that its colours change smoothly along it."""
        ends = self.values[self.quantity]
        uneven = np.abs(ends[:, 0] - ends[:, 1]).max(initial=0.0)
        return PIECES if uneven > _EVEN * self.largest else 1

    @property
    def has_diagram(self) -> bool:
        """Whether it is a bending moment."""
        return self.quantity in BENDING


@dataclass(frozen=True)
class Peak:
    """The largest value of a member's diagram: where the outline is there, and its foot."""

    place: tuple[float, float, float]
    foot: tuple[float, float, float]
    value: float


def stress_of(values: Resultants, quantity: str | None) -> Stress:
    """One quantity of resultants, by default the dominant one."""
    chosen = quantity or values.dominant
    return Stress(values, chosen, values.largest(chosen))


def add_diagrams(canvas: Canvas, drawing: Drawing, stress: Stress) -> list[Peak]:
    """Draw bending diagrams beside the members; where their peaks are.

    The diagram stands off the axis in the plane of bending, on the side that is stretched.
    """
    if not stress.has_diagram or not stress.largest > 0.0:
        return []
    peaks: list[Peak] = []
    row_across = BENDING[stress.quantity]
    height = _HEIGHT * drawing.size / stress.largest
    for strip in stations(drawing.members, drawing.reference, PIECES, drawing.seen):
        value = stress.values.along(stress.quantity, strip.member, strip.at)
        rows = np.flatnonzero(np.abs(value).max(axis=1) > _LEAST * stress.largest)
        if not rows.size:
            continue
        part = _Diagram.of(drawing, stress, strip, rows)
        centre, value = part.centre, part.value
        tops = centre + height * value[..., None] * part.off
        member = strip.member[rows]
        colour = stress.colours_of((value[:, 1:] + value[:, :-1]) / 2)
        above = _ABOVE * drawing.size + _depth(canvas, drawing, member, 1 - row_across)
        _add_outlined(canvas, centre, tops, colour, above, part.ends)
        for row, peak in enumerate(_peaks(value)):
            place, foot = (tuple(each[row, peak].tolist()) for each in (tops, centre))
            peaks.append(Peak(place, foot, float(value[row, peak])))
    return _to_be_named(peaks, stress.largest)


class _Diagram(NamedTuple):
    """Diagrams from the same end, whichever is called p."""

    centre: FloatArray
    """(k, s, 3) axes [m]."""
    off: FloatArray
    """(k, s, 3) unit vectors to the side that a positive moment stretches."""
    value: FloatArray
    """(k, s) moments."""
    ends: np.ndarray
    """(k, 2) which ends are those of the whole sheet or wire."""

    @classmethod
    def of(cls, drawing: Drawing, stress: Stress, strip: Strip, rows: np.ndarray) -> _Diagram:
        """Those of some rows of a strip."""
        member = strip.member[rows]
        across = drawing.members.across[member, BENDING[stress.quantity]]
        centre = strip.centre[rows][:, [0, -1]]
        off = np.einsum("ksxd,kd->ksx", strip.frame[rows][:, [0, -1], :, 1:], across)
        value = stress.values[stress.quantity][member]
        at = np.concatenate(([0.0], (np.arange(PIECES) + _BESIDE) / PIECES, [1.0]))
        turned = signs_of(centre[:, 1] - centre[:, 0]) < 0.0
        ends = np.concatenate((centre, off, value[..., None]), axis=2)
        ends[turned] = ends[turned, ::-1]
        last = ~drawing.members.joined[member]
        last[turned] = last[turned, ::-1]
        every = (1 - at)[None, :, None] * ends[:, :1] + at[None, :, None] * ends[:, 1:]
        return cls(every[..., :3], every[..., 3:6], every[..., 6], last)


def _peaks(value: FloatArray) -> list[int]:
    """(k,) the station of the largest value; where a moment is constant the middle."""
    size = np.abs(value)
    first = size >= (1.0 - _EVEN) * size.max(axis=1, keepdims=True)
    constant = first.all(axis=1)
    made: list[int] = np.where(constant, value.shape[1] // 2, first.argmax(axis=1)).tolist()
    return made


def _depth(canvas: Canvas, drawing: Drawing, member: np.ndarray, row: int) -> FloatArray:
    """(k,) how far behind a member's surface its axis lies, along a direction across it."""
    across = drawing.members.across[member, row]
    normal = np.einsum("kxd,kd->kx", drawing.members.frame[member][..., 1:], across)
    cosine = np.maximum(np.abs(normal @ canvas.view.axes[2]), _OBLIQUE)
    thick = np.sum(np.abs(across) * drawing.members.section[member], axis=1)
    return np.asarray(thick / 2 / cosine)


def _add_outlined(
    canvas: Canvas,
    centre: FloatArray,
    tops: FloatArray,
    colour: FloatArray,
    above: FloatArray,
    ends: np.ndarray,
) -> None:
    """Strips between an axis and the tops, with their outlines; `above` is (k,), `ends` (k, 2)."""
    quads = np.stack((centre[:, :-1], centre[:, 1:], tops[:, 1:], tops[:, :-1]), axis=2)
    pale = 0.55 + 0.45 * colour.reshape(-1, 3)
    canvas.polygons(quads.reshape(-1, 4, 3), pale, nearer=np.repeat(above, quads.shape[1]))
    ink = np.array(OUTLINE)
    ribs = np.stack((centre, tops), axis=2)[:, ::4]
    canvas.lines(ribs.reshape(-1, 2, 3), ink, 0.3, nearer=np.repeat(above, ribs.shape[1]))
    for line, width in ((centre, 0.5), (tops, 1.1)):
        pieces = np.stack((line[:, :-1], line[:, 1:]), axis=2)
        nearer = np.repeat(above, pieces.shape[1])
        canvas.lines(pieces.reshape(-1, 2, 3), ink, width, nearer=nearer)
    sides = np.stack((centre[:, [0, -1]], tops[:, [0, -1]]), axis=2).reshape(-1, 2, 3)
    chosen = ends.ravel()
    canvas.lines(sides[chosen], ink, 1.1, nearer=np.repeat(above, 2)[chosen])


def _to_be_named(peaks: list[Peak], largest: float) -> list[Peak]:
    """The peaks whose values are told; of many, each value once."""
    peaks = [peak for peak in peaks if abs(peak.value) >= _NAMED * largest]
    if len(peaks) > _MOST_NAMED // 2:
        alike: dict[str, list[Peak]] = {}
        for peak in peaks:
            alike.setdefault(f"{peak.value:.2g}", []).append(peak)
        peaks = [every[len(every) // 2] for every in alike.values()]
    return peaks if len(peaks) <= _MOST_NAMED else []
