# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of solids as shaded facets, with their outlines.

A solid is a grid: corners of sections along stations. Only faces turned to the eye are drawn, and
only edges that are sharp or on the outline, so that no net of facets is seen. The light goes with
the eye, so that nothing turns dark.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen
from ..drawing.rotations import unit
from ..drawing.view import View
from .canvas import SOLID, Canvas

#: Cosine of the angle from which on an edge is sharp.
_SHARP = 0.64
OUTLINE = (0.16, 0.18, 0.21)
#: Width of outlines [pt].
OUTLINE_WIDTH = 0.55
#: A facet in the shade keeps this part of its colour.
SHADE = 0.66
#: The light is to the left of the eye and above it: to the right, upwards, towards the eye.
_LIGHT = np.array((-0.353, 0.504, 0.788))


@dataclass(frozen=True, eq=False)
class Grid(Frozen):
    """Solids with equally many stations and corners.

    Attributes:
        points: (k, s, c, 3) corners, anticlockwise about the direction of the stations [m].
        colour: (k, s - 1, 3) or what fits that, one a piece between two stations.
        opacity: (k,) or (1,).
        outline: (k, 3) or (1, 3) colour of the edges.
        joined: (k, 2) which ends, first and last, have no edges.
    """

    points: FloatArray
    colour: FloatArray
    opacity: FloatArray
    outline: FloatArray
    joined: np.ndarray | None = None


def lit(normal: FloatArray, view: View, shade: float = SHADE) -> FloatArray:
    """(n, 1) what colours are multiplied by on surfaces with unit normals (n, 3)."""
    bright = np.clip(normal @ (_LIGHT @ view.axes), 0.0, 1.0)
    return np.asarray(shade + (1.0 - shade) * bright)[:, None]


def add_grid(canvas: Canvas, grid: Grid, *, layer: int = SOLID, shade: float = SHADE) -> None:
    """Draw solids.

    Args:
        canvas: Where to.
        grid: The solids.
        layer: Of the canvas.
        shade: The part of their colours that they keep where no light falls on them; 1: flat.
    """
    k, s, c, _ = grid.points.shape
    colour = np.broadcast_to(grid.colour, (k, s - 1, 3))
    opacity = np.broadcast_to(grid.opacity, k)
    outline = np.broadcast_to(grid.outline, (k, 3))
    following = np.roll(grid.points, -1, axis=2)
    around = (grid.points[:, :-1], following[:, :-1], following[:, 1:], grid.points[:, 1:])
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
    edges = [np.stack([grid.points[member, station + i, corner] for i in (0, 1)], axis=1)]
    owners = [member]
    joined = np.zeros((k, 2), bool) if grid.joined is None else grid.joined
    for end, turn in ((0, -1), (-1, 1)):
        ring = grid.points[:, end]
        cap = _normal_of_rings(ring[:, ::turn])
        faces = cap @ canvas.view.axes[2] > 1.0e-9
        shaded = colour[faces, end] * lit(cap[faces], canvas.view, shade)
        canvas.polygons(ring[faces], shaded, opacity=opacity[faces], layer=layer)
        there = (np.any(cap != 0.0, axis=1) & ~joined[:, end])[:, None]
        member, corner = np.nonzero((front[:, end] | faces[:, None]) & there)
        edges.append(np.stack((ring[member, corner], ring[member, (corner + 1) % c]), axis=1))
        owners.append(member)
    every = outline[np.concatenate(owners)]
    canvas.lines(np.concatenate(edges), every, OUTLINE_WIDTH, layer=layer)


def _normal_of_rings(ring: FloatArray) -> FloatArray:
    """(k, 3) unit normals of rings (k, c, 3); zero where a ring is one point."""
    centred = ring - ring.mean(axis=1, keepdims=True)
    area = np.cross(centred, np.roll(centred, -1, axis=1)).sum(axis=1)
    size = np.linalg.norm(centred, axis=-1).max(axis=1)
    flat = np.linalg.norm(area, axis=1) <= 1.0e-12 * size**2
    return unit(np.where(flat[:, None], 0.0, area))
