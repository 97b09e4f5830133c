# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies as solids with flat faces: shaded in space, filled polygons in the plane."""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ..drawing import Drawing, Pose
from .canvas import SOLID, Canvas
from .surfaces import OUTLINE, OUTLINE_WIDTH, SHADE, lit

#: Above sheets and bars in the plane, a part of the drawing's size, and width of its outline [pt].
_HEIGHT, _LINE = 4.0, 0.7


def add_bodies(
    canvas: Canvas,
    drawing: Drawing,
    pose: Pose,
    *,
    face: FloatArray | None = None,
    edge: FloatArray | None = None,
    layer: int = SOLID,
    shade: float = SHADE,
) -> None:
    """Draw the bodies that are solids.

    Args:
        canvas: Where to.
        drawing: The drawing.
        pose: Where its nodes are.
        face: (3,) colour of all faces; by default their own.
        edge: (3,) of all edges; by default their own.
        layer: Of the canvas.
        shade: The part of their colours that they keep where no light falls on them; 1: flat.
    """
    for solid in drawing.solids:
        if not solid.opacity > 0.0:
            continue
        own = solid.colour if face is None else face
        given = np.where(np.isnan(solid.edge_colour), OUTLINE, solid.edge_colour)
        line = given if edge is None else edge
        corners, normal = solid.placed(drawing.members, drawing.reference, pose)
        if solid.hull is None:
            ring = corners[solid.outline][None]
            above = _HEIGHT * drawing.size
            canvas.polygons(ring, own, opacity=solid.opacity, nearer=above, layer=layer)
            around = np.concatenate((ring, ring[:, :1]), axis=1)
            canvas.lines(around, line, _LINE, nearer=above + 0.1 * drawing.size, layer=layer)
            continue
        front = normal @ canvas.view.axes[2] > 1.0e-9
        chosen = front[solid.hull.face]
        shaded = own * lit(normal[solid.hull.face[chosen]], canvas.view, shade)
        quads = solid.quads(corners, chosen)
        colours = np.repeat(shaded, 3, axis=0)
        canvas.polygons(quads, colours, opacity=solid.opacity, layer=layer)
        seen = solid.hull.edges[front[solid.hull.beside].any(axis=1)]
        canvas.lines(corners[seen], line, OUTLINE_WIDTH, layer=layer)
