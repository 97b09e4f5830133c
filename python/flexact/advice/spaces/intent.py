# SPDX-License-Identifier: BSD-3-Clause
"""What a body is meant to do, where nobody says it: the declared degrees of freedom."""

from __future__ import annotations

import math

import numpy as np

from ...analysis.change import Change
from ...analysis.freedoms import Freedom
from ...analysis.result import Result
from ...analysis.screws import ScrewKind, screw_of
from ...core.arrays import FloatArray
from ...core.elements import Class
from .aims import Aim
from .freedom import Freed
from .screw_space import ScrewSpace
from .spaces_subjects import Subject
from .wanted import Wanted, wanted_of
from .wanted_motion import Written

#: A body whose part in a motion is less stands still.
_STILL = 1.0e-6
#: How many declared degrees of freedom are looked at.
_MOST = 64


def declared_of(result: Result, subject: Subject, space: ScrewSpace) -> tuple[Wanted, ...]:
    """What the declared degrees of freedom make of a body, those that do not move it left out.

    That of a coordinate of the body itself is the translation along it, or the rotation about
    it, if the body can do that; every other one is the motion in which the others stand still.
    """
    made = []
    left = Freed.as_declared(result)
    undeclared = left.space(subject) if left.is_known else None
    for freedom in result.freedoms[:_MOST]:
        found = _own(result, subject, space, freedom) or _moved(subject, space, freedom, undeclared)
        if found is not None:
            made.append(found)
    return tuple(made)


def not_wanted(result: Result, subject: Subject, aim: Aim) -> Change:
    """Takes the declarations back that move the body otherwise than is wanted."""
    coordinates, deformations = [], []
    for freedom in result.freedoms[:_MOST]:
        moved = _moved(subject, aim.freedom, freedom)
        if moved is None or not _is_beside(aim, moved.twist):
            continue
        kind, number = freedom.owner
        if kind == "node":
            coordinates.append((number, freedom.part, Class.DEPENDENT))
        else:
            part, element = freedom.place
            place, own = result.condensed.in_given(element, part + 1)
            given = int(result.given.arrays.element_number[place])
            deformations.append((given, own, Class.DEPENDENT))
    return Change(tuple(deformations), tuple(coordinates))


def _is_beside(aim: Aim, twist: FloatArray) -> bool:
    """Whether a twist has a part in what is unwanted."""
    row = twist * np.repeat((aim.freedom.length, 1.0), 3)
    size = float(np.linalg.norm(row))
    return float(np.linalg.norm(aim.unwanted @ row)) > 1.0e-3 * size


def _own(result: Result, subject: Subject, space: ScrewSpace, freedom: Freedom) -> Wanted | None:
    kind, number = freedom.owner
    node = result.given.node_index.get(number) if kind == "node" else None
    if node is None or node not in (*subject.positions, *subject.orientations):
        return None
    turns = freedom.part.startswith("r")
    direction = np.eye(3)["xyz".index(freedom.part[-1])]
    way = ScrewKind.ROTATION if turns else ScrewKind.TRANSLATION
    pitch = 0.0 if turns else math.inf
    written = Written(freedom.label, None, way, direction, None, pitch)
    made = wanted_of(result, space, written)
    return _declared(made) if made.is_free else None


def _moved(
    subject: Subject, space: ScrewSpace, freedom: Freedom, undeclared: ScrewSpace | None = None
) -> Wanted | None:
    """What a freedom makes of a body beside what it does undeclared; None where that is nothing."""
    motion = freedom.motion
    if motion is None:
        return None
    velocity = motion.displacement[list(subject.positions)].mean(axis=0)
    rotation = motion.rotation[list(subject.orientations)].mean(axis=0)
    most = np.abs(motion.displacement).max() + space.length * np.abs(motion.rotation).max()
    if undeclared is not None:
        both = np.concatenate((rotation, velocity))
        rotation, velocity = np.split(both - undeclared.nearest(both), 2)
    screw = screw_of(
        *(rotation, velocity, space.about, space.length), rest=_STILL * most, rounding=_STILL
    )
    if not screw:
        return None
    twist = space.nearest(np.concatenate((rotation, velocity)))
    return Wanted(
        *(freedom.label, screw.kind, screw.direction, screw.point, screw.pitch),
        *(twist, True, True),
    )


def _declared(one: Wanted) -> Wanted:
    return Wanted(
        *(one.text, one.kind, one.direction, one.point, one.pitch, one.twist, one.is_free, True)
    )
