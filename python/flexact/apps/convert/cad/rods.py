# SPDX-License-Identifier: BSD-3-Clause
"""Round bars of solids, which may be wires.

Loaded in the child process alone.
"""

from __future__ import annotations

import numpy as np

from ....core.arrays import FloatArray
from . import brep
from .assembly import Kind
from .brep import NEAR, Face, Part, are_parallel
from .thin import GLUED, LEAST_SLENDER, Scene, Thin, rounds


def wires(scene: Scene, row: int) -> list[Thin]:
    """The round wires of a solid."""
    part = scene.parts[row]
    found = []
    for group in rounds(part, convex=True):
        found += _wires_of(scene, row, group)
    return found


def _wires_of(scene: Scene, row: int, group: list[Face]) -> list[Thin]:
    part = scene.parts[row]
    axis, at, radius = group[0].axis, group[0].at, group[0].radius
    spans = []
    for face in group:
        ends = np.concatenate([part.edges[k].ends for k in face.edges])
        levels = (ends - at) @ axis
        spans.append((float(levels.min()), float(levels.max()), face.area))
    spans.sort()
    merged: list[list[float]] = []
    for low, high, area in spans:
        if merged and low < merged[-1][1] - NEAR:
            merged[-1] = [merged[-1][0], max(high, merged[-1][1]), merged[-1][2] + area]
        else:
            merged.append([low, high, area])
    found = []
    for low, high, area in merged:
        if high - low < LEAST_SLENDER * 2 * radius:
            continue
        if area < 0.9 * 2 * np.pi * radius * (high - low):
            continue
        if not part.holds(at + (low + high) / 2 * axis):
            continue
        line = at + low * axis, at + high * axis
        made = _free_wires(scene, row, line, axis, radius, min(0.02, 0.05 * radius))
        if not made and high - low > 20 * radius:
            made = _free_wires(scene, row, line, axis, radius, min(GLUED, 0.5 * radius))
        found += made
    return found


def _free_wires(
    scene: Scene,
    row: int,
    line: tuple[FloatArray, FloatArray],
    axis: FloatArray,
    radius: float,
    gap: float,
) -> list[Thin]:
    """What of a round bar no other solid holds, where its ends are fastened."""
    part = scene.parts[row]
    at, low, high = line[0], 0.0, float((line[1] - line[0]) @ axis)
    u = brep.across(axis)
    v = np.cross(axis, u)
    ends = np.array([at + low * axis, at + high * axis])
    box = np.array([ends.min(0) - radius - gap, ends.max(0) + radius + gap])
    others = scene.near(box, row)
    turns = np.arange(6) * np.pi / 3
    ring = [(radius + gap) * (np.cos(turn) * u + np.sin(turn) * v) for turn in turns]
    around = [np.zeros(3), *ring]

    def covered(level: float) -> bool:
        place = at + level * axis
        if scene.where(place, others) is not None:
            return True
        return sum(scene.where(place + d, others) is not None for d in ring) >= 3

    count = 96
    levels = low + (np.arange(count) + 0.5) / count * (high - low)
    flags = [covered(level) for level in levels] if others else [False] * count
    borders: list[tuple[float, float, bool, bool]] = []
    start = low
    held = False
    for k in range(count + 1):
        now = flags[k] if k < count else None
        before = flags[k - 1] if k else None
        if before is None or now == before:
            continue
        if now is None:
            border = high
        else:
            a, b = levels[k - 1], levels[k]
            for _ in range(40):
                half = (a + b) / 2
                a, b = (half, b) if covered(half) == before else (a, half)
            border = (a + b) / 2
        if not before:
            borders.append((start, border, held, bool(now)))
        held, start = bool(before), border
    found = []
    for first, last, held_first, held_last in borders:
        if last - first < LEAST_SLENDER * 2 * radius:
            continue
        made, radii, is_open = [], [], []
        for level, sign, is_held in ((first, -1.0, held_first), (last, 1.0, held_last)):
            place = at + level * axis
            more, stops = 0.0, False
            if not is_held:
                outside = place + sign * max(0.05 * radius, gap) * axis
                fastened = part.holds(outside) or any(
                    scene.where(outside + 0.5 * d, others) is not None for d in around
                )
                if not fastened:
                    break
                stops = not part.holds(outside)
                more = _fillet_round(part, place, axis, radius)
            made.append(place + sign * more * axis)
            radii.append(more)
            is_open.append(stops)
        if len(made) < 2:
            continue
        cuts = (at + first * axis, at + last * axis)
        outline = np.array(
            [made[0] + radius * v, made[0] - radius * v, made[1] - radius * v, made[1] + radius * v]
        )
        found.append(
            Thin(
                part=row,
                kind=Kind.WIRE,
                p=made[0],
                q=made[1],
                cuts=cuts,
                width=v,
                normal=u,
                breadth=2 * radius,
                thickness=2 * radius,
                span=(-1.05 * radius, 1.05 * radius),
                outline=outline,
                radius=min(radii),
                contour="round",
                is_open=(is_open[0], is_open[1]),
            )
        )
    return found


def _fillet_round(part: Part, end: FloatArray, axis: FloatArray, radius: float) -> float:
    """Radius of the fillet at the end of a round wire, or 0."""
    for face in part.faces:
        if face.kind == "torus" and not face.is_convex and are_parallel(face.axis, axis, 1e-3):
            away = face.at - end
            off = np.linalg.norm(away - away @ axis * axis)
            # That of a neck, which gets thinner, has its middle further on.
            if off < NEAR and abs(away @ axis) < 0.2 * face.radius + NEAR:
                return face.radius
    return 0.0
