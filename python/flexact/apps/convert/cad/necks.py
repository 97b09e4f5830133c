# SPDX-License-Identifier: BSD-3-Clause
"""Necks of solids, which may be notches: between two bores, and of other shapes.

Loaded in the child process alone.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from ....core.arrays import FloatArray
from . import brep
from .assembly import Kind
from .brep import NEAR, PARALLEL, Face, Part, are_parallel
from .thin import Scene, Thin, rounds


def _has_arc(group: Sequence[Face], centre: FloatArray, towards: FloatArray) -> bool:
    """Whether a bore is there on both sides of a direction: where a fillet begins, it is not."""
    along = np.cross(group[0].axis, towards)
    places = [
        centre + group[0].radius * (np.cos(turn) * towards + np.sin(turn) * along)
        for turn in (-0.15, 0.15)
    ]
    return all(
        any(brep.distance(brep.vertex(place), face.shape) < 1e-3 for face in group)
        for place in places
    )


def necks(scene: Scene, row: int) -> list[Thin]:
    """The circular notches of a solid: what is left between two bores side by side."""
    part = scene.parts[row]
    bores: list[tuple[list[Face], float, float]] = []
    for group in rounds(part, convex=False):
        ends = np.concatenate([part.edges[e].ends for face in group for e in face.edges])
        levels = ends @ group[0].axis
        bores.append((group, float(levels.min()), float(levels.max())))
    found: list[Thin] = []
    for (as_, low_a, high_a), (bs, low_b, high_b) in itertools.combinations(bores, 2):
        a, b = as_[0], bs[0]
        if not are_parallel(a.axis, b.axis):
            continue
        away = b.at - a.at
        away = away - away @ a.axis * a.axis
        d = float(np.linalg.norm(away))
        neck = d - a.radius - b.radius
        if not NEAR < neck < min(a.radius, b.radius) * 1.2:
            continue
        if float(a.axis @ b.axis) < 0:
            low_b, high_b = -high_b, -low_b
        low, high = max(low_a, low_b), min(high_a, high_b)
        if high - low < neck / 2:
            continue
        normal = away / d
        level = (low + high) / 2
        on_axis = a.at + (level - a.at @ a.axis) * a.axis
        middle = on_axis + (a.radius + neck / 2) * normal
        faces = (on_axis + a.radius * normal, on_axis + (a.radius + neck) * normal)
        # Both bores have to be there, at the neck, and material between them.
        inside = part.holds(middle)
        open_ = not part.holds(faces[0] - 0.05 * neck * normal) and not part.holds(
            faces[1] + 0.05 * neck * normal
        )
        if not (inside and open_) or any(
            np.linalg.norm(each.middle - middle) < NEAR for each in found
        ):
            continue
        if not all(
            _has_arc(group, on_axis_, sign * normal)
            for group, on_axis_, sign in (
                (as_, on_axis, 1.0),
                (bs, faces[1] + b.radius * normal, -1.0),
            )
        ):
            continue
        axis = np.cross(a.axis, normal)
        radius = min(a.radius, b.radius)
        doubts = []
        if abs(a.radius - b.radius) > 0.02 * radius:
            doubts.append(f"its bores have radii of {a.radius:.3g} and {b.radius:.3g} mm")
        breadth = high - low
        outline = np.array(
            [
                middle + s * radius / 2 * axis + z * breadth / 2 * a.axis
                for s, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))
            ]
        )
        found.append(
            Thin(
                part=row,
                kind=Kind.NOTCH,
                p=middle - radius * axis,
                q=middle + radius * axis,
                cuts=(middle,),
                width=a.axis,
                normal=normal,
                breadth=breadth,
                thickness=neck,
                span=(-0.52 * breadth, 0.52 * breadth),
                outline=outline,
                radius=radius,
                contour="circular",
                doubts=doubts,
            )
        )
    return found


def odd_necks(scene: Scene, row: int) -> list[Thin]:
    """Necks of a solid that are not between two bores: elliptic, one-sided, or of another shape."""
    part = scene.parts[row]
    swept = [
        (face, direction)
        for face in part.faces
        if face.kind == "other" and (direction := brep.swept_along(face.shape)) is not None
    ]
    hollow = [(f, f.axis) for f in part.faces if f.kind == "cylinder" and not f.is_convex]
    flat = [f for f in part.faces if f.kind == "plane"]
    found: list[Thin] = []
    wide, close = (np.array([[-s], [s]]) * part.size for s in (0.1, 0.03))
    for (a, axis), (b, other) in itertools.combinations([*swept, *hollow], 2):
        if a.kind == b.kind == "cylinder" or not are_parallel(axis, other):
            continue
        if brep.boxes_meet(a.box + wide, b.box):
            found += _odd_neck(part, row, a, b, axis)
    for (a, axis), plane in itertools.product([*hollow, *swept], flat):
        if abs(plane.axis @ axis) > PARALLEL:
            continue
        gap = float((plane.at - a.at) @ plane.axis) - a.radius
        near = NEAR < gap < 0.5 * a.radius
        if near if a.kind == "cylinder" else brep.boxes_meet(a.box + close, plane.box):
            found += _odd_neck(part, row, a, plane, axis)
    kept: list[Thin] = []
    for thin in found:
        if not any(np.linalg.norm(thin.middle - each.middle) < each.thickness for each in kept):
            kept.append(thin)
    return kept


def _odd_neck(part: Part, row: int, a: Face, b: Face, axis: FloatArray) -> list[Thin]:
    """The neck between two faces that are swept along one axis, where there is one."""
    if set(a.edges) & set(b.edges):
        return []
    near = brep.nearest(a.shape, b.shape)
    if near is None:
        return []
    levels = []
    for face in (a, b):
        places = np.concatenate([part.edges[k].places for k in face.edges]) @ axis
        levels.append((float(places.min()), float(places.max())))
    low, high = max(x for x, _ in levels), min(x for _, x in levels)
    away = near[1] - near[0]
    away = away - away @ axis * axis
    neck, breadth = float(np.linalg.norm(away)), high - low
    if neck < NEAR or breadth < neck / 2:
        return []
    normal = away / neck
    middle = near[0] + away / 2
    middle = middle + ((low + high) / 2 - middle @ axis) * axis
    half = neck / 2 * normal
    if not part.holds(middle) or any(part.holds(middle + s * 1.1 * half) for s in (-1, 1)):
        return []
    along = np.cross(axis, normal)
    # What begins at the neck, as the inside of a bend does, makes no notch: behind a curved face
    # there is more material on both sides.
    for face, place in ((a, middle - half), (b, middle + half)):
        if face.kind != "plane" and not all(
            part.holds(place + step * neck * along) for step in (-0.5, 0.5)
        ):
            return []
    one, other = brep.ellipse_of(a.shape), brep.ellipse_of(b.shape)
    contour, length = "", neck
    if one is not None and other is not None and np.allclose(one[:2], other[:2], rtol=0.01):
        major, minor, direction = one
        along_major = are_parallel(direction, along, 1e-2)
        if along_major or are_parallel(direction, normal, 1e-2):
            contour, length = "elliptic", 2 * (major if along_major else minor)
            radius = minor if along_major else major
    doubts = (
        [] if contour else ["its shape is not known: it is taken as a hinge, without stiffness"]
    )
    if not contour:
        radius = 0.0
    p, q = middle - length / 2 * along, middle + length / 2 * along
    return [
        Thin(
            part=row,
            kind=Kind.NOTCH,
            p=p,
            q=q,
            cuts=(middle,),
            width=axis,
            normal=normal,
            breadth=breadth,
            thickness=neck,
            span=(-0.52 * breadth, 0.52 * breadth),
            outline=np.array([p - half, q - half, q + half, p + half]),
            radius=radius,
            contour=contour,
            doubts=doubts,
        )
    ]
