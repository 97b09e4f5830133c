# SPDX-License-Identifier: BSD-3-Clause
"""Purchased parts: screws, nuts, washers, pins and bearings, by name and by shape.

Loaded in the child process alone.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from OCP.TopoDS import TopoDS_Shape

from . import brep
from .brep import Face, Part, are_parallel
from .thin import rounds

#: Names of bearings.
_BEARING = re.compile(r"bearing|kugellager|w(?:ä|ae)lzlager|kogellager", re.I)
#: Names of purchased parts, in English, German and Dutch.
_PURCHASED = re.compile(
    r"(screw|bolt|\bnut\b|\bnuts\b|washer|dowel|bearing|circlip|rivet|\bpin\b|\bpins\b|"
    r"schraube|mutter\b|(?:unterleg|feder|sicherungs)?scheibe|stift\b|kugellager|"
    r"w(?:ä|ae)lzlager|niet\b|gewindestift|"
    r"schroef|\bmoer\b|\bbout\b|sluitring|paspen|kogellager|klinknagel|"
    r"\bdin[ _-]?\d+|\biso[ _-]?\d{3,}|\bm\d+(?:[.,]\d)?\s?x\s?\d+)",
    re.I,
)


def is_purchased(part: Part, count: int, total: float) -> bool:
    """Whether a solid is so by its name, or by its shape: small, round, and without a waist.

    Args:
        part: The solid.
        count: Of how many solids of an assembly.
        total: Their volume [mm3].
    """
    if _is_named_purchased(part):
        return part.volume < 0.05 * total and not _is_block(part)
    if count < 4 or part.volume > 0.01 * total or len(part.faces) < 4:
        return False
    round_ = [f for f in part.faces if f.kind in ("cylinder", "torus")]
    if not round_:
        return False
    axis, at = round_[0].axis, round_[0].at
    flats = 0
    for face in part.faces:
        if face.kind == "other":
            continue
        if face.kind == "plane":
            flat = abs(float(face.axis @ axis)) < 1e-3
            if not flat and not are_parallel(face.axis, axis, 1e-3):
                return False
            flats += flat
            continue
        away = face.at - at
        off = np.linalg.norm(away - away @ axis * axis)
        if not are_parallel(face.axis, axis, 1e-3) or off > 1e-2:
            return False
    # A nut, a socket, or both have six sides each.
    if flats not in (0, 6, 12):
        return False
    if len({round(f.radius, 3) for f in round_}) == 1 and round_[0].is_convex:
        return False
    if not any(_is_full(part, g) for c in (False, True) for g in rounds(part, convex=c)):
        return False
    return not _has_waists(part)


def _is_block(part: Part) -> bool:
    """Whether a part is no body of revolution but for a few flats, as a bearing block is none."""
    round_ = [face for face in part.faces if face.kind == "cylinder"]
    if not round_:
        return False
    axis = max(round_, key=lambda face: face.area).axis
    flats = sum(f.kind == "plane" and abs(float(f.axis @ axis)) < 1e-3 for f in part.faces)
    return flats not in (0, 1, 2, 3, 6, 12)


def is_bearing(part: Part) -> bool:
    """Whether the name of a part says that it turns within itself."""
    return bool(_BEARING.search(part.name))


def _is_named_purchased(part: Part) -> bool:
    return any(_PURCHASED.search(name) for name in (part.name, *part.path[1:]))


def _has_waists(part: Part) -> bool:
    """Whether a turned part is slender at two places, as a strut is, and no screw or pin."""
    spans = []
    for group in rounds(part, convex=True):
        for face in group:
            levels = np.concatenate([part.edges[k].ends for k in face.edges]) @ group[0].axis
            spans.append((group[0].radius, float(levels.min()), float(levels.max())))
    least = min((r for r, *_ in spans), default=0.0)
    largest = max((r for r, *_ in spans), default=0.0)
    slim = {round(low, 3) for r, low, high in spans if r < 1.01 * least and high - low > 4 * r}
    return least < 0.6 * largest and len(slim) >= 2


def _is_full(part: Part, group: Sequence[Face]) -> bool:
    """Whether the faces of one cylinder go all around it."""
    levels = np.concatenate([part.edges[k].ends for f in group for k in f.edges]) @ group[0].axis
    return bool(sum(f.area for f in group) > 0.9 * 2 * np.pi * group[0].radius * np.ptp(levels))


def bounding_cylinder(part: Part) -> TopoDS_Shape | None:
    """The cylinder about the largest round face of a part in which all of it lies."""
    round_ = [face for face in part.faces if face.kind == "cylinder"]
    if not round_:
        return None
    largest = max(round_, key=lambda face: face.area)
    axis, at = largest.axis, largest.at
    places = [edge.ends for edge in part.edges]
    if not places:
        return None
    ends = np.concatenate(places) - at
    levels = ends @ axis
    radial = np.linalg.norm(ends - levels[:, None] * axis, axis=1)
    radius = max(float(radial.max()), *(face.radius for face in round_ if face.is_convex), 0.0)
    low, high = float(levels.min()), float(levels.max())
    if radius <= 0 or high - low <= 0:
        return None
    return brep.cylinder(at + low * axis, axis, radius, high - low)
