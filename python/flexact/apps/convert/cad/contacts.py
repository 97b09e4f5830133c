# SPDX-License-Identifier: BSD-3-Clause
"""Whether and how two solids touch.

Loaded in the child process alone.
"""

from __future__ import annotations

import itertools

import numpy as np
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common

from . import brep
from .brep import Part, are_parallel

#: Solids that are no further apart touch [mm].
TOUCHING = 0.02


def contact(a: Part, b: Part) -> str:
    """How two solids touch: "face", "line" (or in a point), or "" where they do not."""
    gap = np.array([[-TOUCHING] * 3, [TOUCHING] * 3])
    near_a = [face for face in a.faces if brep.boxes_meet(face.box + gap, b.box)]
    near_b = [face for face in b.faces if brep.boxes_meet(face.box + gap, a.box)]
    if not near_a or not near_b:
        return "face" if _contains(a, b) else ""
    for one, other in itertools.product(near_a, near_b):
        if one.kind != other.kind or one.kind not in ("plane", "cylinder"):
            continue
        if not are_parallel(one.axis, other.axis, 1e-3):
            continue
        if not brep.boxes_meet(one.box + 2 * gap, other.box):
            continue
        away = other.at - one.at
        if one.kind == "plane":
            far = float(away @ one.axis)
            if one.axis @ other.axis > 0 or abs(far) > 2 * TOUCHING:
                continue
            over = brep.common([brep.moved(one.shape, far * one.axis)], [other.shape])
            if sum(map(brep.area_of, over)) > 1e-3 * min(one.area, other.area):
                return "face"
        elif one.is_convex != other.is_convex:
            off = float(np.linalg.norm(away - away @ one.axis * one.axis))
            if off < TOUCHING and abs(one.radius - other.radius) < 2 * TOUCHING:
                return "face"
    far = brep.distance(
        brep.compound(f.shape for f in near_a), brep.compound(f.shape for f in near_b)
    )
    if far > TOUCHING:
        return "face" if _contains(a, b) else ""
    return "face" if far < TOUCHING / 4 and _overlap(a, b) else "line"


def _contains(a: Part, b: Part) -> bool:
    """Whether one of two solids whose surfaces do not meet lies in the other."""
    return any(one.edges and other.holds(one.edges[0].ends[0]) for one, other in ((a, b), (b, a)))


def _overlap(a: Part, b: Part) -> bool:
    """Whether two solids have something of their inside in common."""
    if any(
        other.holds(place)
        for one, other in ((a, b), (b, a))
        for edge in one.edges
        for place in (*edge.ends, edge.ends.mean(0))
        if np.all(place > other.box[0]) and np.all(place < other.box[1])
    ):
        return True
    shape = BRepAlgoAPI_Common(a.shape, b.shape).Shape()
    if shape is None or shape.IsNull():
        return False
    return Part(shape).volume > 1e-6 * min(a.volume, b.volume)
