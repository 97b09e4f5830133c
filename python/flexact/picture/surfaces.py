"""Surfaces of solids as shaded facets, with their outlines.

A solid is a grid: corners of sections along stations. Only faces turned to the eye are drawn, and
only edges that are sharp or on the outline, so that no net of facets is seen.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..exchange import FloatArray
from ..frozen import Frozen
from ..scene.rotations import unit
from .drawing import SOLID, Drawing
from .light import SHADE, Light, light_of

#: Cosine of the angle from which on an edge is sharp.
_SHARP = 0.64
OUTLINE = (0.16, 0.18, 0.21)
#: Width of outlines [pt].
OUTLINE_WIDTH = 0.55


@dataclass(frozen=True, eq=False)
class Grid(Frozen):
    """Solids with equally many stations and corners.

    Attributes:
        points: (k, s, c, 3) corners, anticlockwise about the direction of the stations [m].
        colour: (k, s - 1, 3) or what fits that, one a piece between two stations.
        opacity: (k,) or (1,).
        outline: (k, 3) or (1, 3) colour of the edges.
    """

    points: FloatArray
    colour: FloatArray
    opacity: FloatArray
    outline: FloatArray


def add_grid(
    drawing: Drawing,
    grid: Grid,
    *,
    finest: float,
    layer: int = SOLID,
    shade: float = SHADE,
    outline_width: float = OUTLINE_WIDTH,
) -> None:
    """Draw solids.

    Args:
        drawing: Where to.
        grid: The solids.
        finest: Facets are divided until they are about so large [m].
        layer: Of the drawing.
        shade: The part of their colours that they keep where no light falls on them; 1: flat.
        outline_width: Of the edges [pt].
    """
    k, s, c, _ = grid.points.shape
    light = light_of(drawing.view, shade)
    colour = np.broadcast_to(grid.colour, (k, s - 1, 3))
    opacity = np.broadcast_to(grid.opacity, k)
    sides = _sides(grid.points)
    first, second = (sides[..., i + 2, :] - sides[..., i, :] for i in (0, 1))
    normal = unit(np.cross(first, second))
    front = normal @ drawing.view.axes[2] > 1.0e-9
    parts = _parts(_largest(sides[..., 1, :] - sides[..., 0, :], (0, 1)), finest)
    steps = int(_parts(_largest(sides[..., 3, :] - sides[..., 0, :], None), finest))
    for corner in range(c):
        member, station = np.nonzero(front[:, :, corner])
        _add_divided(
            drawing,
            sides[member, station, corner],
            colour[member, station] * light.on(normal[member, station, corner]),
            opacity[member],
            (int(parts[corner]), steps),
            layer,
        )
    _add_caps(drawing, grid, (colour, opacity), light, finest, layer)
    if outline_width > 0.0:
        _add_edges(drawing, grid, front, normal, steps, layer, outline_width)


def _sides(points: FloatArray) -> FloatArray:
    """(k, s - 1, c, 4, 3) corners of the faces along solids, from outside anticlockwise."""
    following = np.roll(points, -1, axis=2)
    around = (points[:, :-1], following[:, :-1], following[:, 1:], points[:, 1:])
    return np.stack(around, axis=3)


def _largest(edges: FloatArray, axes: tuple[int, int] | None) -> FloatArray:
    return np.asarray(np.linalg.norm(edges, axis=-1).max(axis=axes, initial=0.0))


def _parts(length: FloatArray, finest: float) -> np.ndarray:
    return np.clip(np.ceil(np.asarray(length) / finest), 1, 48).astype(np.int64)


def _add_divided(
    drawing: Drawing,
    quads: FloatArray,
    colour: FloatArray,
    opacity: FloatArray,
    counts: tuple[int, int],
    layer: int,
) -> None:
    """Facets, each divided into so many parts across and along if it is opaque."""
    clear = opacity < 1.0
    # A net of seams would be seen in what shines through.
    drawing.polygons(quads[clear], colour[clear], opacity=opacity[clear], layer=layer)
    quads, colour, opacity = (each[~clear] for each in (quads, colour, opacity))
    parts, steps = counts
    if parts * steps > 1:
        u, v = (np.linspace(0.0, 1.0, n + 1) for n in (parts, steps))
        first = quads[:, None, 0] + u[None, :, None] * (quads[:, 1] - quads[:, 0])[:, None]
        last = quads[:, None, 3] + u[None, :, None] * (quads[:, 2] - quads[:, 3])[:, None]
        net = first[:, None] + v[None, :, None, None] * (last - first)[:, None]
        quads = np.stack(
            (net[:, :-1, :-1], net[:, :-1, 1:], net[:, 1:, 1:], net[:, 1:, :-1]), axis=3
        ).reshape(-1, 4, 3)
        colour, opacity = (np.repeat(each, parts * steps, axis=0) for each in (colour, opacity))
    drawing.polygons(quads, colour, opacity=opacity, layer=layer)


def _add_caps(
    drawing: Drawing,
    grid: Grid,
    look: tuple[FloatArray, FloatArray],
    light: Light,
    finest: float,
    layer: int,
) -> None:
    """The two ends of solids; `look` is their colour (k, s - 1, 3) and their opacity (k,)."""
    for station, turn in ((0, -1), (-1, 1)):
        ring = grid.points[:, station, ::turn]
        normal = _normal_of_rings(ring)
        chosen = np.flatnonzero(normal @ drawing.view.axes[2] > 1.0e-9)
        if not chosen.size:
            continue
        ring = ring[chosen]
        colour = look[0][chosen, station] * light.on(normal[chosen])
        opacity = look[1][chosen]
        if ring.shape[1] == 4:
            sides = _largest(np.roll(ring, -1, axis=1) - ring, None)
            count = int(_parts(sides, finest))
            _add_divided(drawing, ring, colour, opacity, (count, count), layer)
        else:
            drawing.polygons(ring, colour, opacity=opacity, layer=layer)


def _normal_of_rings(ring: FloatArray) -> FloatArray:
    """(k, 3) unit normals of rings (k, c, 3); zero where a ring is one point."""
    centred = ring - ring.mean(axis=1, keepdims=True)
    area = np.cross(centred, np.roll(centred, -1, axis=1)).sum(axis=1)
    size = np.linalg.norm(centred, axis=-1).max(axis=1)
    flat = np.linalg.norm(area, axis=1) <= 1.0e-12 * size**2
    return unit(np.where(flat[:, None], 0.0, area))


def _add_edges(
    drawing: Drawing,
    grid: Grid,
    front: np.ndarray,
    normal: FloatArray,
    steps: int,
    layer: int,
    width: float,
) -> None:
    """Edges along the solids, between two sides, and round their ends.

    Args:
        drawing: Where to.
        grid: The solids.
        front: (k, s - 1, c) whether sides are turned to the eye.
        normal: (k, s - 1, c, 3) of the sides.
        steps: Pieces of an edge between two stations.
        layer: Of the drawing.
        width: Of the lines [pt].
    """
    k, _, c, _ = grid.points.shape
    outline = np.broadcast_to(grid.outline, (k, 3))
    before = np.roll(front, 1, axis=2)
    sharp = np.sum(normal * np.roll(normal, 1, axis=2), axis=-1) < _SHARP
    member, station, corner = np.nonzero((front | before) & (sharp | (front != before)))
    start, end = (grid.points[member, station + i, corner] for i in (0, 1))
    _add_lines(drawing, start, end, steps, outline[member], width, layer)
    for row, piece, turn in ((0, 0, -1), (-1, -1, 1)):
        ring = grid.points[:, row]
        cap = _normal_of_rings(ring[:, ::turn])
        open_ = (cap @ drawing.view.axes[2] > 1.0e-9)[:, None]
        there = np.any(cap != 0.0, axis=1)[:, None]
        member, corner = np.nonzero((front[:, piece] | open_) & there)
        start, end = ring[member, corner], ring[member, (corner + 1) % c]
        _add_lines(drawing, start, end, 1, outline[member], width, layer)


def _add_lines(
    drawing: Drawing,
    start: FloatArray,
    end: FloatArray,
    steps: int,
    colour: FloatArray,
    width: float,
    layer: int,
) -> None:
    share = np.linspace(0.0, 1.0, steps + 1)[None, :, None]
    points = start[:, None] + share * (end - start)[:, None]
    pieces = np.stack((points[:, :-1], points[:, 1:]), axis=2).reshape(-1, 2, 3)
    drawing.lines(pieces, np.repeat(colour, steps, axis=0), width, layer=layer)
