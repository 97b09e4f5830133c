"""Movements and self-stresses as data of a page."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np

from ..elements import NodeKind
from ..scene import QUANTITIES, Movement, Moving, Pose, move, resultants
from ..scene.rotations import euler_of
from .limits import MOST_ELEMENTS, MOST_MEMBERS, MOST_MODES, MOST_POSES
from .packing import floats, integers
from .scene_data import Frame, hinges_in

if TYPE_CHECKING:
    from ..analysis import Analysis

#: Below this part of the largest resultant a quantity is rounding.
_NOTHING = 1.0e-9
#: A node moves if it leaves its place by this part of the scene's size, or turns by so much.
_STILL = 1.0e-9

_AT_MOST = "at most 10\N{NO-BREAK SPACE}% of the size"
_ON_PATH = f"the held deformations stay zero on this path; {_AT_MOST}"
_ON_SCREWS = f"drawn from velocities, rigid parts on screws; {_AT_MOST}"


def movements(analysis: Analysis, frame: Frame) -> list[dict[str, Any]]:
    """The motions, then the declared degrees of freedom; as many as fit."""
    made: list[dict[str, Any]] = []
    size = 0
    for kind, label, motion in chain(_motions(analysis), _freedoms(analysis)):
        data, added = _movement(frame, move(frame.scene, motion))
        size += added
        if made and size > MOST_POSES:
            break
        title = label if kind == "motion" else f"Degree of freedom {label}"
        made.append({"kind": kind, "label": label, "title": title, **data})
    return made


def _motions(analysis: Analysis) -> Iterator[tuple[str, str, Moving]]:
    for number, motion in enumerate(analysis.motions[:MOST_MODES], start=1):
        yield "motion", f"Motion {number}", motion


def _freedoms(analysis: Analysis) -> Iterator[tuple[str, str, Moving]]:
    if analysis.data.arrays.element_number.size > MOST_ELEMENTS:
        return
    for freedom in analysis.freedoms[:MOST_MODES]:
        if (motion := freedom.motion) is not None:
            yield "freedom", freedom.label, motion


def _movement(frame: Frame, movement: Movement) -> tuple[dict[str, Any], int]:
    """A movement, and the bytes of its poses."""
    kept = frame.kept
    position = frame.places(np.stack([pose.position[kept] for pose in movement.poses]))
    rotation = np.stack([_euler(pose, kept) for pose in movement.poses])
    placed = frame.scene.data.arrays.node_kind[kept] <= NodeKind.POSITION
    still = len(movement.poses) // 2
    moved = np.flatnonzero((np.abs(position - position[still]).max(axis=(0, 2)) > _STILL) & placed)
    turned = np.flatnonzero(np.abs(rotation[..., 1:]).max(axis=(0, 2)) > _STILL)
    data = {
        "note": _ON_PATH if movement.true_path else _ON_SCREWS,
        "phases": len(movement.poses),
        "moved": integers(moved),
        "position": floats(position[:, moved]),
        "turned": integers(turned),
        "rotation": floats(rotation[:, turned]),
    }
    return data, 4 * len(movement.poses) * (3 * moved.size + 4 * turned.size)


def _euler(pose: Pose, kept: np.ndarray) -> np.ndarray:
    return euler_of(pose.rotation[kept])


def stresses(analysis: Analysis, frame: Frame) -> list[dict[str, Any]]:
    """The self-stresses, each with the quantities that it has."""
    rows = hinges_in(frame)
    made = []
    for number, stress in enumerate(analysis.self_stresses[:MOST_MODES], start=1):
        found = resultants(frame.scene, stress)
        weight = {each: 1.0 if each == "N" else 1.0 / found.length for each in QUANTITIES}
        sizes = {each: found.largest(each) * weight[each] for each in QUANTITIES}
        there = [each for each in QUANTITIES if sizes[each] > _NOTHING * max(sizes.values())]
        hinges = {each: found.hinges[rows, QUANTITIES.index(each)] for each in there}
        made.append(
            {
                "title": f"Self-stress {number}",
                "dominant": found.dominant,
                "largest": {each: found.largest(each) for each in there},
                "members": {each: floats(found[each][:MOST_MEMBERS]) for each in there},
                "hinges": {each: floats(values) for each, values in hinges.items()},
            }
        )
    return made
