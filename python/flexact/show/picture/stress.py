# SPDX-License-Identifier: BSD-3-Clause
"""A self-stress on the members: colours along them, and bending diagrams beside them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen
from ...util.rotations import unit
from ..drawing import QUANTITIES, Drawing, Resultants
from ..drawing.diagrams import PIECES, diagrams_of
from ..drawing.members import diverging
from ..drawing.presses import Press
from ..drawing.view import View
from .canvas import OVER, SOLID, Canvas

#: Cosine of the angle from which on an edge is sharp.
_SHARP = 0.64
OUTLINE = (0.16, 0.18, 0.21)
#: Width of outlines [pt].
OUTLINE_WIDTH = 0.55
#: A facet in the shade keeps this part of its colour.
SHADE = 0.66
#: The light is to the left of the eye and above it: to the right, upwards, towards the eye.
_LIGHT = np.array((-0.353, 0.504, 0.788))


def lit(normal: FloatArray, view: View, shade: float = SHADE) -> FloatArray:
    """(n, 1) what colours are multiplied by on surfaces with unit normals (n, 3)."""
    bright = np.clip(normal @ (_LIGHT @ view.axes), 0.0, 1.0)
    return np.asarray(shade + (1.0 - shade) * bright)[:, None]


def add_grid(
    canvas: Canvas,
    points: FloatArray,
    colour: FloatArray,
    opacity: FloatArray | float = 1.0,
    outline: FloatArray | tuple[float, ...] = OUTLINE,
    joined: np.ndarray | bool = False,
    *,
    layer: int = SOLID,
    shade: float = SHADE,
) -> None:
    """Draw solids with equally many stations and corners.

    Args:
        canvas: Where to.
        points: (k, s, c, 3) corners, anticlockwise about the direction of the stations [m].
        colour: (k, s - 1, 3) or what fits that, one a piece between two stations.
        opacity: (k,) or one for all.
        outline: (k, 3) or (3,) colour of the edges.
        joined: (k, 2) which ends, first and last, have no edges.
        layer: Of the canvas.
        shade: The part of their colours that they keep where no light falls on them; 1: flat.
    """
    k, s, c, _ = points.shape
    colour = np.broadcast_to(colour, (k, s - 1, 3))
    opacity, joined = np.broadcast_to(opacity, k), np.broadcast_to(joined, (k, 2))
    following = np.roll(points, -1, axis=2)
    around = (points[:, :-1], following[:, :-1], following[:, 1:], points[:, 1:])
    sides = np.stack(around, axis=3)
    normal = unit(
        np.cross(sides[..., 2, :] - sides[..., 0, :], sides[..., 3, :] - sides[..., 1, :])
    )
    front = normal @ canvas.view.axes[2] > 1.0e-9
    member, station, _ = np.nonzero(front)
    shaded = colour[member, station] * lit(normal[front], canvas.view, shade)
    canvas.polygons(sides[front], shaded, opacity=opacity[member], layer=layer)

    before = np.roll(front, 1, axis=2)
    sharp = np.sum(normal * np.roll(normal, 1, axis=2), axis=-1) < _SHARP
    member, station, corner = np.nonzero((front | before) & (sharp | (front != before)))
    edges = [np.stack([points[member, station + i, corner] for i in (0, 1)], axis=1)]
    owners = [member]
    for end, turn in ((0, -1), (-1, 1)):
        ring = points[:, end]
        cap = _ring_normal(ring[:, ::turn])
        faces = cap @ canvas.view.axes[2] > 1.0e-9
        shaded = colour[faces, end] * lit(cap[faces], canvas.view, shade)
        canvas.polygons(ring[faces], shaded, opacity=opacity[faces], layer=layer)
        there = (np.any(cap != 0.0, axis=1) & ~joined[:, end])[:, None]
        member, corner = np.nonzero((front[:, end] | faces[:, None]) & there)
        edges.append(np.stack((ring[member, corner], ring[member, (corner + 1) % c]), axis=1))
        owners.append(member)
    every = np.broadcast_to(outline, (k, 3))[np.concatenate(owners)]
    canvas.lines(np.concatenate(edges), every, OUTLINE_WIDTH, layer=layer)


def _ring_normal(ring: FloatArray) -> FloatArray:
    """(k, 3) unit normals of rings (k, c, 3); zero where a ring is one point."""
    centred = ring - ring.mean(axis=1, keepdims=True)
    area = np.cross(centred, np.roll(centred, -1, axis=1)).sum(axis=1)
    size = np.linalg.norm(centred, axis=-1).max(axis=1)
    flat = np.linalg.norm(area, axis=1) <= 1.0e-12 * size**2
    return unit(np.where(flat[:, None], 0.0, area))


#: How much of a diagram shines through what hides it.
_THROUGH = 0.3
#: Peaks below this part of the largest are not named, and no more than so many are.
_NAMED, _MOST_NAMED = 0.3, 8
#: Values that differ by less than this part of the largest have one colour.
_EVEN = 0.01


@dataclass(frozen=True, eq=False)
class Stress(Frozen):
    """One quantity of a self-stress.

    Attributes:
        values: The resultants.
        quantity: One of `QUANTITIES`.
        largest: Its largest magnitude, of members and hinges [N] or [N m].
        presses: What parts press on bodies.
    """

    values: Resultants
    quantity: str
    largest: float
    presses: tuple[Press, ...] = ()

    def colours(self, member: np.ndarray, at: FloatArray) -> FloatArray:
        """(k, s - 1, 3) of the pieces between stations (s,) of members (k,)."""
        middle = (at[1:] + at[:-1]) / 2
        return self.colours_of(self.values.along(self.quantity, member, middle))

    def member_colours(self) -> FloatArray:
        """(k, 3) of the members by the larger of the values at their ends."""
        ends = self.values[self.quantity]
        high, low = ends.max(axis=1), ends.min(axis=1)
        return self.colours_of(np.where(high >= -low * (1.0 - _EVEN), high, low))

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


#: The largest value of a member's diagram: (3,) where the outline is there, (3,) its foot, and
#: the value.
Peak = tuple[FloatArray, FloatArray, float]


def add_diagrams(canvas: Canvas, drawing: Drawing, stress: Stress) -> list[Peak]:
    """Draw bending diagrams beside the members, on the stretched sides.

    Returns:
        The peaks whose values are told; of many, each value once.
    """
    made = diagrams_of(drawing, stress.values, stress.quantity, canvas.view.axes[2])
    _, value, base, top, ends = made
    if not len(value):
        return []
    colour = stress.colours_of((value[:, 1:] + value[:, :-1]) / 2)
    _add_outlined(canvas, base, top, colour, ends)
    size = np.abs(value)
    first = size >= (1.0 - _EVEN) * size.max(axis=1, keepdims=True)
    # Where a moment is constant, in the middle.
    stations = np.where(first.all(axis=1), value.shape[1] // 2, first.argmax(axis=1))
    peaks: list[Peak] = [
        (top[row, station], base[row, station], float(value[row, station]))
        for row, station in enumerate(stations.tolist())
        if size[row, station] >= _NAMED * stress.largest
    ]
    if len(peaks) > _MOST_NAMED // 2:
        alike: dict[str, list[Peak]] = {}
        for peak in peaks:
            alike.setdefault(f"{peak[2]:.2g}", []).append(peak)
        peaks = [every[len(every) // 2] for every in alike.values()]
    return peaks if len(peaks) <= _MOST_NAMED else []


def _add_outlined(
    canvas: Canvas, base: FloatArray, top: FloatArray, colour: FloatArray, ends: np.ndarray
) -> None:
    """Strips from a base to the tops, with their outlines and the ends (k, 2) that they have."""
    quads = np.stack((base[:, :-1], base[:, 1:], top[:, 1:], top[:, :-1]), axis=2)
    pale = 0.55 + 0.45 * colour.reshape(-1, 3)
    canvas.polygons(quads.reshape(-1, 4, 3), pale)
    ink = np.array(OUTLINE)
    ribs = np.stack((base, top), axis=2)[:, ::4]
    canvas.lines(ribs.reshape(-1, 2, 3), ink, 0.3)
    for line, width in ((base, 0.5), (top, 1.1)):
        canvas.lines(line, ink, width)
    sides = np.stack((base[:, [0, -1]], top[:, [0, -1]]), axis=2).reshape(-1, 2, 3)
    canvas.lines(sides[ends.ravel()], ink, 1.1)
    # What is behind other parts shines through them.
    canvas.polygons(quads.reshape(-1, 4, 3), pale, opacity=_THROUGH, layer=OVER)
    around = np.concatenate((base[:, :1], top, base[:, -1:]), axis=1)
    canvas.lines(around, ink, 0.4, layer=OVER)
