# SPDX-License-Identifier: BSD-3-Clause
"""Geometry of flexures: the normal of a sheet, and points between its ends."""

from __future__ import annotations

import math

from ..deck.errors import model_error
from ..util.plain_text import in_short
from .arguments import Direction, cross, direction, unit, whole
from .draft import LARGEST, NO_VECTOR, Draft, Vector
from .handles import Node

#: As the core's check of a y vector.
_PARALLEL = 1.0e-6


def place_of(draft: Draft, point: Node) -> Vector:
    """Where a point is [m]."""
    x, y, z = draft.node_value[point.position][:3]
    return x, y, z


def span(draft: Draft, p: Node, q: Node) -> Vector:
    """The vector from p to q [m]."""
    (x0, y0, z0), (x1, y1, z1) = place_of(draft, p), place_of(draft, q)
    return x1 - x0, y1 - y0, z1 - z0


def normal_to(a: Vector, b: Vector) -> Vector:
    """The unit normal of the plane of two vectors; zero where they are parallel."""
    made = cross(unit(a), unit(b))
    if math.hypot(*made) <= _PARALLEL:
        return NO_VECTOR
    x, y, z = unit(made)
    return x + 0.0, y + 0.0, z + 0.0


def sheet_normal(draft: Draft, p: Node, q: Node, width: Direction | None) -> Vector | None:
    """The y vector of a sheet's beams: normal to the sheet, so that z lies in its plane.

    A sheet of no length has none; that is left to the check of the model.
    """
    if draft.planar:
        if width is not None and any(direction(width, "width")[:2]):
            raise model_error("surplus-vector", "the width of a sheet in a planar model is along z")
        return None
    if width is None:
        raise model_error(
            "missing-vector",
            "a sheet needs the direction of its width",
            'give width=(x, y, z), or "x", "y" or "z"',
        )
    wide = direction(width, "width")
    along = unit(span(draft, p, q))
    if along == NO_VECTOR:
        return wide
    normal = normal_to(wide, along)
    if normal == NO_VECTOR:
        raise model_error(
            "parallel-vector",
            "the width of the sheet is parallel to it",
            "give a direction across the sheet, from edge to edge",
        )
    return normal


def between(draft: Draft, p: Node, q: Node, parts: int) -> list[Vector]:
    """Points that divide the way from p to q into equal parts."""
    parts = whole(parts, "the number of beams must be a whole number")
    if not 1 <= parts <= LARGEST:
        raise model_error(
            "out-of-range", f"a flexure cannot be divided into {in_short(parts)} beams"
        )
    start, end = place_of(draft, p), place_of(draft, q)
    made = []
    for i in range(1, parts):
        t = i / parts
        x, y, z = (start[k] * (1.0 - t) + end[k] * t for k in range(3))
        made.append((x, y, z))
    return made
