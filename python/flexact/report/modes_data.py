"""Movements and self-stresses as data of a page."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np

from ..deformation_words import deformation_word
from ..elements import NodeKind, coordinate_name
from ..freedoms import Freedom
from ..rendering import harmless
from ..scene import QUANTITIES, Movement, Moving, Pose, Scene, move, reach_of, resultants
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
#: Displacements (parts of the scene's size) and rotations [rad] that nobody sees.
_UNSEEN = 1.0e-5


def movements(analysis: Analysis, frame: Frame) -> list[dict[str, Any]]:
    """The motions, then the declared degrees of freedom; as many as fit."""
    made: list[dict[str, Any]] = []
    size = 0
    for kind, label, title, motion in chain(_motions(analysis), _freedoms(analysis)):
        data, added = _movement(frame, move(frame.scene, motion))
        size += added
        if made and size > MOST_POSES:
            break
        made.append({"kind": kind, "label": label, "title": title, **data})
    return made


def _motions(analysis: Analysis) -> Iterator[tuple[str, str, str, Moving]]:
    for number, motion in enumerate(analysis.motions[:MOST_MODES], start=1):
        yield "motion", f"Motion {number}", f"Motion {number}", motion


def _freedoms(analysis: Analysis) -> Iterator[tuple[str, str, str, Moving]]:
    for freedom in looked_at(analysis):
        if (motion := freedom.motion) is not None:
            yield "freedom", freedom.label, f"Degree of freedom: {_in_words(freedom)}", motion


def looked_at(analysis: Analysis) -> tuple[Freedom, ...]:
    """The declared degrees of freedom whose motions are asked for."""
    if analysis.data.arrays.element_number.size > MOST_ELEMENTS:
        return ()
    return analysis.freedoms[:MOST_MODES]


def _in_words(freedom: Freedom) -> str:
    """Such as "bending at q in the local xy plane of element 1 (upper 90, ground to fold)"."""
    data, (part, owner) = freedom.analysis.data, freedom.place
    arrays = data.arrays
    if freedom.is_coordinate:
        name = coordinate_name(int(arrays.node_kind[owner]), part)
        what = (
            f"rotation about {name[1:]}" if name.startswith("r") else f"displacement along {name}"
        )
        return f"{what} of node {arrays.node_number[owner]}"
    word = deformation_word(int(arrays.element_kind[owner]), part + 1)
    name = harmless(data.element_names[owner])
    return f"{word} of element {arrays.element_number[owner]}" + (f" ({name})" if name else "")


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
        "note": _note(frame.scene, movement),
        "phases": len(movement.poses),
        "moved": integers(moved),
        "position": floats(position[:, moved]),
        "turned": integers(turned),
        "rotation": floats(rotation[:, turned]),
    }
    return data, 4 * len(movement.poses) * (3 * moved.size + 4 * turned.size)


def _note(scene: Scene, movement: Movement) -> str:
    """On what the poses lie, and how far they go."""
    largest, angle = reach_of(scene, (movement.poses[0], movement.poses[-1]))
    share = largest / scene.size
    far = "no displacements"
    if share > _UNSEEN:
        far = f"displacements up to {100 * share:.2g}\N{NO-BREAK SPACE}% of the model's size"
    turned = f" and rotations up to {angle:.2g}\N{NO-BREAK SPACE}rad" * (angle > _UNSEEN)
    return f"{movement.remark} Drawn with {far}{turned}."


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
