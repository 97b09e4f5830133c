# SPDX-License-Identifier: BSD-3-Clause
"""A motion as it is drawn: poses from one end of a swing to the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen
from .drawing import Drawing
from .drawing_pose import Moving, Pose, reference_pose
from .inner_nodes import poses_with_inner_nodes
from .natural import Natural
from .path import follow, has_path, moved_by_screws
from .pose import field_along, stations
from .rotations import between, vector_of

#: The largest displacement that is drawn, as a part of the drawing's size, and of the size of what
#: moves, which it does not exceed.
AMPLITUDE, _OF_PART = 0.1, 0.25
#: What is displaced by less than this part of the largest displacement does not count as moving.
_MOVES = 0.02
#: The largest rotation that is drawn [rad].
_LARGEST_ROTATION = 1.0
#: Poses to each side of the reference.
_STEPS = 8
#: Deformations on a path, as a part of the drawing's size: up to here they are rounding, and up
#: to here nobody sees them.
_TRUE = 1.0e-9
_UNSEEN = 1.0e-3
#: How well the farthest displacement is to fit, and how often it is tried.
_FITS = 2.0e-3
_MOST_FITS = 6


@dataclass(frozen=True, eq=False)
class Movement(Frozen):
    """A motion as it is drawn.

    Attributes:
        scale: What the motion is multiplied by, so that to first order the largest displacement
            along the members is a tenth of the drawing's size, or a quarter of the size of what
            moves where that is less, and no rotation larger than 1 rad.
        deviation: The largest deformation in the poses that the motion holds, as a part of the
            drawing's size; infinite where there is no such path near, NaN where the model is too
            large to look for it. Then rigid bodies move on the screws of the motion.
        phases: (17,) from -1 to 1, fewer of a shape that is elastic; 0 is the reference.
        poses: One a phase.
        about: What is to be said of them where that is no path; may be empty.
        part: Size of what moves, as a part of the drawing's, where it is drawn to that; else 1.
        natural: Whether what nothing determines has the shape in which it bends least.
    """

    scale: float
    deviation: float
    phases: FloatArray
    poses: tuple[Pose, ...]
    about: str = ""
    part: float = 1.0
    natural: bool = False

    @property
    def true_path(self) -> bool:
        """Whether the mechanism can move so far: the held deformations stay zero."""
        return self.deviation <= _TRUE

    @property
    def remark(self) -> str:
        """What is to be said of the poses, sentences."""
        told = [self._path]
        if self.part < 1.0:
            told.append("Drawn to the size of the part that moves.")
        if self.natural:
            told.append("What nothing determines is drawn where it bends least.")
        return " ".join(told)

    @property
    def _path(self) -> str:
        if self.about:
            return self.about
        if self.true_path:
            return "On its path: no held deformation changes."
        if np.isnan(self.deviation):
            return "A large model: drawn along its velocities, rigid bodies on screws."
        if np.isinf(self.deviation):
            return "Infinitesimal: drawn along its velocities, rigid bodies on screws."
        return f"Held deformations stay below {self.deviation:.1e} of the model's size."

    def pose(self, phase: float) -> Pose:
        """The pose at a phase from -1 to 1, between the two nearest ones."""
        place = np.clip((phase + 1) / 2, 0.0, 1.0) * (len(self.poses) - 1)
        first = min(int(place), len(self.poses) - 2)
        share = float(place - first)
        one, other = self.poses[first], self.poses[first + 1]
        position = (1 - share) * one.position + share * other.position
        turned = between(one.rotation, other.rotation, np.array([share]))[:, 0]
        return Pose(position, turned)


def move(drawing: Drawing, motion: Moving) -> Movement:
    """The poses of a motion on both sides of the reference.

    They lie on a path on which the deformations that the motion holds stay zero, or so small
    that nobody sees them, where there is one and the model is not large. The larger of the two
    farthest displacements is a tenth of the drawing's size, unless rotations are too large.
    """
    far, part = amplitude_of(drawing, motion.displacement, motion.rotation)
    scale = reach = scale_of(drawing, motion)
    sides, deviation = _swung(motion, reach, drawing.size)
    for _ in range(_MOST_FITS):
        factor = _factor(drawing, [side[-1] for side in sides], far)
        if abs(factor - 1.0) < _FITS:
            break
        reach *= factor
        fitted, there = _swung(motion, reach, drawing.size)
        if np.isinf(there) and np.isfinite(deviation):
            # The path ends before.
            break
        sides, deviation = fitted, there
    poses = (*sides[0][::-1], reference_pose(drawing.data.arrays), *sides[1])
    phases = np.linspace(-1.0, 1.0, len(poses))
    natural = isinstance(motion, Natural)
    return Movement(scale, deviation, phases, poses, part=part, natural=natural)


def _swung(motion: Moving, reach: float, size: float) -> tuple[list[tuple[Pose, ...]], float]:
    """The poses to both sides, up to the motion times `reach`; the deviation."""
    shares = reach * np.arange(1, _STEPS + 1) / _STEPS
    analysed = motion.analysed
    followed = has_path(analysed.data)
    if followed:
        sides = [follow(analysed, sign * shares, size) for sign in (-1.0, 1.0)]
        found = [side for side in sides if side is not None and side.deviation <= _UNSEEN]
        if len(found) == len(sides):
            poses = [poses_with_inner_nodes(motion.condensed, side.poses) for side in found]
            return poses, max(side.deviation for side in found)
    swings = [moved_by_screws(analysed, (sign * shares).tolist()) for sign in (-1.0, 1.0)]
    whole = [poses_with_inner_nodes(motion.condensed, swing) for swing in swings]
    return whole, np.inf if followed else np.nan


def _factor(drawing: Drawing, ends: list[Pose], far: float) -> float:
    """By how much poses are too near to the reference, to be as far as they may."""
    largest, turned = reach_of(drawing, ends)
    factor = _least(far, largest, _LARGEST_ROTATION, turned)
    return min(max(factor, 0.5), 2.0) if factor > 0.0 else 1.0


def reach_of(drawing: Drawing, poses: Sequence[Pose]) -> tuple[float, float]:
    """The largest displacement, of nodes and along members [m], and the largest rotation [rad]."""
    reference = list(stations(drawing.members, drawing.reference))
    ways, angles = [np.zeros(1)], [np.zeros(1)]
    for pose in poses:
        ways.append(np.linalg.norm(pose.position - drawing.reference.position, axis=1))
        for here, there in zip(stations(drawing.members, pose), reference, strict=True):
            ways.append(np.linalg.norm(here.centre - there.centre, axis=-1).ravel())
        angles.append(np.linalg.norm(vector_of(pose.rotation), axis=1))
    return float(np.concatenate(ways).max()), float(np.concatenate(angles).max())


def scale_of(drawing: Drawing, motion: Moving) -> float:
    """What a motion is multiplied by when it is drawn, to first order."""
    far, _ = amplitude_of(drawing, motion.displacement, motion.rotation)
    along = field_along(drawing.members, motion.displacement, motion.rotation)
    largest = max(
        (float(np.linalg.norm(each.displacement, axis=-1).max(initial=0.0)) for each in along),
        default=0.0,
    )
    largest = max(largest, float(np.linalg.norm(motion.displacement, axis=1).max(initial=0.0)))
    turned = float(np.linalg.norm(motion.rotation, axis=1).max(initial=0.0))
    return _least(far, largest, _LARGEST_ROTATION, turned)


def amplitude_of(
    drawing: Drawing, displacement: FloatArray, rotation: FloatArray
) -> tuple[float, float]:
    """How far a motion is drawn [m], and the size of what moves as a part of the drawing's.

    A motion of a small part, as of the inside of a sheet, goes as far as that part's size lets it
    be seen as what it is; the second number is 1 of all others.

    Args:
        drawing: The drawing.
        displacement: (nodes, 3) of the motion.
        rotation: (nodes, 3) likewise.
    """
    members = drawing.members
    reach = np.zeros(len(members))
    for each in field_along(members, displacement, rotation):
        reach[each.member] = np.linalg.norm(each.displacement, axis=-1).max(axis=1)
    largest = float(reach.max(initial=0.0))
    nodes = np.unique(members.nodes[reach > _MOVES * largest][:, [0, 2]])
    far = AMPLITUDE * drawing.size
    if not largest > 0.0:
        return far, 1.0
    part = float(np.linalg.norm(np.ptp(drawing.reference.position[nodes], axis=0)))
    return (_OF_PART * part, part / drawing.size) if 0.0 < _OF_PART * part < far else (far, 1.0)


def _least(far: float, largest: float, angle: float, turned: float) -> float:
    """The smaller of two quotients whose divisors are not zero; 0 where both are."""
    bounds = [a / b for a, b in ((far, largest), (angle, turned)) if b > 0.0]
    return min(bounds, default=0.0)
