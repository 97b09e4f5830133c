# SPDX-License-Identifier: BSD-3-Clause
"""A motion as it is drawn: poses from one end of a swing to the other."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...analysis.body_motions import Velocities
from ...analysis.decomposition import Decomposition
from ...analysis.freedoms import FreeMotion
from ...analysis.result import Motion
from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import STIFFNESS_NUMBER, Class, NodeKind, Role, role_table
from ...model.configuration import Configuration
from ...model.parts.condensing import Condensed
from ...model.parts.parts import bodies_of
from ...motion.constraints import Held, Place, is_followed
from ...motion.stations import onward, settle
from ...util.loading import load
from ...util.records import Frozen, kept
from ...util.rotations import between, matrix_of, screw_matrix, vector_of
from .drawing import Drawing
from .pose import Pose, axes_along, field_along, pose_of, poses_of, reference_pose

#: A motion at the nodes: of an analysis, or of a declared degree of freedom.
Moving = Motion | FreeMotion


def poses_with_inner_nodes(condensed: Condensed, poses: Iterable[Pose]) -> tuple[Pose, ...]:
    """Poses of the model as it was given, from those of the model as it was analysed.

    Between its ends a divided sheet or wire is cubic about its chord, as one beam is.
    """
    if not condensed.chains:
        return tuple(poses)
    nodes, made = condensed.given.arrays.node_number.size, []
    for pose in poses:
        position, rotation = np.zeros((nodes, 3)), np.broadcast_to(np.eye(3), (nodes, 3, 3)).copy()
        position[condensed.nodes], rotation[condensed.nodes] = pose.position, pose.rotation
        for inner in condensed.inner:
            ends, turns = position[inner.ends[[0, 2]]], rotation[inner.ends[[1, 3]]]
            way = ends[1] - ends[0]
            carried = _carried(inner.chord, way, turns)
            local = vector_of(np.swapaxes(carried, -1, -2) @ turns)
            moved, turned = inner.between(np.zeros((2, 3)), local)
            beside = inner.share[:, None] * inner.chord + inner.offset + moved
            stretch = inner.share[:, None] * (way - carried @ inner.chord)
            position[inner.positions] = ends[0] + beside @ carried.T + stretch
            rotation[inner.orientations] = carried @ matrix_of(turned)
        made.append(Pose(position, rotation))
    return tuple(made)


def _carried(chord: FloatArray, now: FloatArray, turns: FloatArray) -> FloatArray:
    """(3, 3) the rotation that the beam makes as a whole: with its ends, and with its chord."""
    half = vector_of(turns[0].T @ turns[1]) / 2.0
    mean = turns[0] @ matrix_of(half)
    along = mean @ chord / np.linalg.norm(chord)
    length = float(np.linalg.norm(now))
    if length > 0.0:
        axis = np.cross(along, now / length)
        sine = float(np.linalg.norm(axis))
        if sine > 0.0:
            turn = np.arctan2(sine, float(along @ (now / length)))
            mean = matrix_of(axis / sine * turn) @ mean
    return np.asarray(mean)


#: More coordinates than these are not followed: it would take seconds.
MOST_COORDINATES = 300


def follow(motion: Velocities, shares: FloatArray, size: float) -> tuple[list[Pose], float] | None:
    """The poses at shares of a motion that grow from the reference on.

    Args:
        motion: The motion; what its model holds stays zero, what it fixes stays.
        shares: (k,) by which the motion is multiplied, of one sign.
        size: Of the drawing [m].

    Returns:
        The poses, one a share, and the largest deformation in them that the motion holds, as a
        part of the drawing's size; None where there is no path near.
    """
    held = Held(motion.data, size)
    direction = held.direction(motion)
    length = float(np.linalg.norm(direction))
    if not length > 0.0:
        return None
    direction *= np.sign(shares[0]) / length
    here: Place | None = held.at(held.reference)
    places, deviation = [], 0.0
    for step in np.abs(np.diff(shares, prepend=0.0)).tolist():
        here = settle(here, direction, step * length) if here else None
        if here is None:
            return None
        deviation = max(deviation, here.residual)
        places.append(here.configuration)
        direction = onward(here, direction)
    return poses_in(held, places), deviation


def poses_in(held: Held, places: Sequence[Configuration]) -> list[Pose]:
    """The poses that configurations mean, which `Held` has, where the model stands."""
    values = np.array([held.outside(each).value for each in places])
    there = poses_of(held.data.arrays, values)
    return list(map(Pose, there.position, there.rotation))


def moved_by_screws(motion: Velocities, shares: Iterable[float]) -> tuple[Pose, ...]:
    """The poses after a motion times each of `shares`.

    Every node of a rigid body moves on the body's screw, so that the body keeps its shape. A
    node of no body moves straight and turns about its own axis.
    """
    reference, handles = reference_pose(motion.data.arrays), _handles_of(motion.data.arrays)
    placed, made = motion.data.arrays.node_kind <= NodeKind.POSITION, []
    for share in shares:
        moved, turned = share * motion.displacement, share * motion.rotation
        rotation = matrix_of(turned)
        rotation[placed] = np.eye(3)
        there = reference.position + moved
        position = _carried_by_bodies(handles, reference.position, there, turned)
        made.append(Pose(position, rotation))
    return tuple(made)


def _handles_of(arrays: ModelArrays) -> tuple[np.ndarray, np.ndarray]:
    """(nodes,) each: of position nodes of rigid bodies a position and an orientation of the body.

    Both are -1 of nodes of no body.
    """
    centre, turn = (np.full(arrays.node_kind.size, -1) for _ in range(2))
    for body in bodies_of(arrays):
        rows = [node for node in body.positions if centre[node] < 0]
        centre[rows], turn[rows] = (arrays.element_node[:2, body.elements[0]] - 1).tolist()
    return centre, turn


def _carried_by_bodies(
    handles: tuple[np.ndarray, np.ndarray],
    start: FloatArray,
    moved: FloatArray,
    turned: FloatArray,
) -> FloatArray:
    """Positions (nodes, 3) after velocities that last for a time of one.

    Args:
        handles: As of `_handles_of`.
        start: (nodes, 3) where they were [m].
        moved: (nodes, 3) where they would be, had all gone straight [m].
        turned: (nodes, 3) rotation vectors of orientations [rad].
    """
    made = moved.copy()
    body = np.flatnonzero(handles[0] >= 0)
    centre, about = handles[0][body], turned[handles[1][body]]
    gone = np.einsum("kxy,ky->kx", screw_matrix(about), (moved - start)[centre])
    arm = np.einsum("kxy,ky->kx", matrix_of(about), start[body] - start[centre])
    made[body] = start[centre] + gone + arm
    return made


#: More motions that nothing determines are not looked at together.
_MOST = 200
#: Stiffness below this part of the largest is none; changes below it are none.
_NOTHING = 1.0e-10
#: Bending at both ends of a beam, which are stiff together: 4, -2; -2, 4.
_PAIRS = (
    (Role.BENDING_XZ_P, Role.BENDING_XZ_Q),
    (Role.BENDING_XY_P, Role.BENDING_XY_Q),
    (Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q),
)
_JOINTS: dict[int, int] = {Role.ROTATION: 0, Role.ANGLE: 0, Role.TILT_Y: 1, Role.TILT_Z: 2}


def natural_shape(outcome: Decomposition, motion: FreeMotion) -> FreeMotion:
    """A motion of a degree of freedom with the least bending of what is free.

    It is the motion itself where everything is determined, or bends least as it is.
    """
    motions = getattr(outcome, "motions", ())
    if not 0 < len(motions) <= _MOST:
        return motion
    data = motion.analysed.data
    placed = (data.arrays.node_kind <= NodeKind.POSITION)[:, None]
    *free_motions, start = (
        each.analysed.displacement + each.analysed.rotation for each in (*motions, motion)
    )
    free, weight = np.array(free_motions), np.where(placed, 1.0, outcome.characteristic_length)
    # Orthonormal in lengths, so that what stores nothing is told apart from what does.
    basis = np.linalg.qr((free * weight).reshape(len(free), -1).T)[0].T.reshape(free.shape) / weight
    rates = np.array([_rates(outcome, each) for each in (*basis, start)])
    stiff = np.array([_stress(outcome, each) for each in rates])
    energy = stiff.reshape(len(stiff), -1) @ rates.reshape(len(rates), -1).T
    # Stiffness of any size may be given.
    if not np.isfinite(energy).all():
        return motion
    inner, outer = energy[:-1, :-1], energy[:-1, -1]
    shares = np.linalg.lstsq((inner + inner.T) / 2, -outer, rcond=_NOTHING)[0]
    if np.linalg.norm(shares) <= _NOTHING * np.linalg.norm(start * weight):
        return motion
    made = start + np.einsum("k,knx->nx", shares, basis)
    velocities = Velocities(data, np.where(placed, made, 0.0), np.where(placed, 0.0, made))
    return replace(motion, analysed=velocities, is_natural=True)


def _rates(outcome: Decomposition, velocity: FloatArray) -> FloatArray:
    """(elements, 6) of the deformations that are released; the others are 0."""
    raw, arrays = outcome.assembly, outcome.data.arrays
    count = arrays.element_number.size
    made = np.bincount(
        raw.row_of, raw.value * velocity.reshape(-1)[raw.column_of], minlength=6 * count
    ).reshape(count, 6)
    return np.where(arrays.deformation_class.T == Class.DEPENDENT, made, 0.0)


def _stiffness(outcome: Decomposition) -> FloatArray | None:
    """(elements, 6) of ESTIFF, where every element with released deformations has it.

    What is not given is 0: rigid bodies have no stiffness, and no rates that it would multiply.
    """
    condensed, arrays = outcome.condensed, outcome.data.arrays
    if condensed.given.properties is None:
        return None
    made = np.nan_to_num(condensed.given.properties.stiffness[condensed.elements])
    released = np.any(arrays.deformation_class == Class.DEPENDENT, axis=0)
    return made if np.all(made[released].any(axis=1)) else None


def _stress(outcome: Decomposition, rates: FloatArray) -> FloatArray:
    """(elements, 6) K e; deformations of beams are lengths, their length times an angle."""
    data = outcome.data
    role, length = role_table()[data.arrays.element_kind], data.frames.length
    size = np.where(length > 0.0, length, 1.0)
    given = _stiffness(outcome)
    made = np.zeros_like(rates)
    for each, column in {**STIFFNESS_NUMBER, **_JOINTS}.items():
        rows, places = np.nonzero(role == each)
        joint = each in _JOINTS
        stiff = np.ones(rows.size) if given is None else given[rows, column]
        power = 0 if joint else (2 if given is None else (1 if each == Role.ELONGATION else 3))
        made[rows, places] = stiff / size[rows] ** power * rates[rows, places]
    for first, second in _PAIRS:
        rows, p = np.nonzero(role == first)
        _, q = np.nonzero(role[rows] == second)
        one, other = made[rows, p].copy(), made[rows, q].copy()
        made[rows, p], made[rows, q] = 4 * one - 2 * other, 4 * other - 2 * one
    return made


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
        poses: 17, at even phases from -1 to 1, fewer of a shape that is elastic; at 0 is the
            reference.
        about: What is to be said of them where that is no path; may be empty.
        part: Size of what moves, as a part of the drawing's, where it is drawn to that; else 1.
        natural: Whether what nothing determines has the shape in which it bends least.
        farthest: The largest displacement at both ends [m], and the largest rotation [rad].
    """

    scale: float
    deviation: float
    poses: tuple[Pose, ...]
    about: str = ""
    part: float = 1.0
    natural: bool = False
    farthest: tuple[float, float] = (0.0, 0.0)

    @property
    def remark(self) -> str:
        """What is to be said of the poses, sentences."""
        told = f"Held deformations stay below {self.deviation:.1e} of the model's size."
        if self.deviation <= _TRUE:
            told = "On its path: no held deformation changes."
        elif not np.isfinite(self.deviation):
            what = "A large model" if np.isnan(self.deviation) else "Infinitesimal"
            told = f"{what}: drawn along its velocities, rigid bodies on screws."
        told = self.about or told
        if self.part < 1.0:
            told += " Drawn to the size of the part that moves."
        if self.natural:
            told += " What nothing determines is drawn where it bends least."
        return told

    def pose(self, phase: float) -> Pose:
        """The pose at a phase from -1 to 1, between the two nearest ones."""
        place = np.clip((phase + 1) / 2, 0.0, 1.0) * (len(self.poses) - 1)
        first = min(int(place), len(self.poses) - 2)
        share = float(place - first)
        one, other = self.poses[first], self.poses[first + 1]
        position = (1 - share) * one.position + share * other.position
        turned = between(one.rotation, other.rotation, np.array([share]))[:, 0]
        return Pose(position, turned)


def move(drawing: Drawing, motion: Moving, most: int = MOST_COORDINATES) -> Movement:
    """The poses of a motion on both sides of the reference; of more coordinates by velocities.

    They lie on a path on which the deformations that the motion holds stay zero, or so small
    that nobody sees them, where there is one and the model is not large. The larger of the two
    farthest displacements is a tenth of the drawing's size, unless rotations are too large.
    Of a page with pictures each is found once.
    """

    def found() -> Movement:
        # Matrices are so small that more threads would slow them down.
        with load("threadpoolctl").threadpool_limits(1):
            return _movement(drawing, motion, most)

    return kept(drawing, (motion, most), found)


def _movement(drawing: Drawing, motion: Moving, most: int) -> Movement:
    far, part = amplitude_of(drawing, motion.displacement, motion.rotation)
    scale = reach = scale_of(drawing, motion.displacement, motion.rotation, far)
    sides, deviation = _swung(motion, reach, drawing.size, most)
    farthest = reach_of(drawing, [side[-1] for side in sides])
    for _ in range(_MOST_FITS):
        # By how much poses are too near to the reference, to be as far as they may.
        factor = _least(far, farthest[0], _LARGEST_ROTATION, farthest[1])
        factor = min(max(factor, 0.5), 2.0) if factor > 0.0 else 1.0
        if abs(factor - 1.0) < _FITS:
            break
        reach *= factor
        fitted, there = _swung(motion, reach, drawing.size, most)
        if np.isinf(there) and np.isfinite(deviation):
            # The path ends before.
            break
        sides, deviation = fitted, there
        farthest = reach_of(drawing, [side[-1] for side in sides])
    poses = (*sides[0][::-1], reference_pose(drawing.data.arrays), *sides[1])
    natural = isinstance(motion, FreeMotion) and motion.is_natural
    return Movement(scale, deviation, poses, part=part, natural=natural, farthest=farthest)


def _swung(
    motion: Moving, reach: float, size: float, most: int
) -> tuple[list[tuple[Pose, ...]], float]:
    """The poses to both sides, up to the motion times `reach`; the deviation."""
    shares = reach * np.arange(1, _STEPS + 1) / _STEPS
    analysed = motion.analysed
    followed = is_followed(analysed.data, most)
    if followed:
        sides = [follow(analysed, sign * shares, size) for sign in (-1.0, 1.0)]
        found = [side for side in sides if side is not None and side[1] <= _UNSEEN]
        if len(found) == len(sides):
            paths = [poses_with_inner_nodes(motion.condensed, poses) for poses, _ in found]
            return paths, max(deviation for _, deviation in found)
    swings = [moved_by_screws(analysed, (sign * shares).tolist()) for sign in (-1.0, 1.0)]
    whole = [poses_with_inner_nodes(motion.condensed, swing) for swing in swings]
    return whole, np.inf if followed else np.nan


def reach_of(drawing: Drawing, poses: Sequence[Pose]) -> tuple[float, float]:
    """The largest displacement, of nodes and along members [m], and the largest rotation [rad]."""
    ways, angles = [np.zeros(1)], [np.zeros(1)]
    for pose in poses:
        ways.append(np.linalg.norm(pose.position - drawing.reference.position, axis=1))
        for here, there in zip(axes_along(drawing.members, pose), drawing.axes, strict=True):
            ways.append(np.linalg.norm(here - there, axis=-1).ravel())
        angles.append(np.linalg.norm(vector_of(pose.rotation), axis=1))
    return float(np.concatenate(ways).max()), float(np.concatenate(angles).max())


def scale_of(
    drawing: Drawing,
    displacement: FloatArray,
    rotation: FloatArray,
    far: float | None = None,
    angle: float = _LARGEST_ROTATION,
) -> float:
    """What a motion is multiplied by when it is drawn, to first order; 0 of one without any.

    Args:
        drawing: The drawing.
        displacement: (nodes, 3) of the motion.
        rotation: (nodes, 3) likewise.
        far: The largest displacement that is drawn [m]; by default as of `amplitude_of`.
        angle: The largest rotation [rad].
    """
    if far is None:
        far, _ = amplitude_of(drawing, displacement, rotation)
    along = field_along(drawing.members, displacement, rotation)
    ways = [np.linalg.norm(each, axis=-1).max(initial=0.0) for _, each, _ in along]
    largest = float(max([*ways, np.linalg.norm(displacement, axis=1).max(initial=0.0)]))
    turned = float(np.linalg.norm(rotation, axis=1).max(initial=0.0))
    return _least(far, largest, angle, turned)


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
    for member, way, _ in field_along(members, displacement, rotation):
        reach[member] = np.linalg.norm(way, axis=-1).max(axis=1)
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


#: Poses from one end to the other, of which the middle one is the state itself.
_POSES = 5
#: The largest rotation that is drawn [rad].
_SWING_LARGEST_ROTATION = 0.4


def swing(
    drawing: Drawing, state: Configuration, displacement: FloatArray, about: str = "Enlarged."
) -> Movement:
    """The poses of a vibrating or buckled shape.

    The largest displacement along the members is a tenth of the drawing's size, or a quarter of
    the size of what moves where that is less, unless a rotation would be larger than 0.4 rad.
    Rigid bodies keep their shapes.

    Args:
        drawing: The drawing of the model whose nodes are displaced.
        state: Where its nodes are without the shape.
        displacement: (nodes, 3) of positions, and rotations (spins) of orientations; only their
            ratios matter.
        about: What is said of it, a sentence.
    """
    arrays = drawing.data.arrays
    placed = (arrays.node_kind <= NodeKind.POSITION)[:, None]
    moved, turned = np.where(placed, displacement, 0.0), np.where(placed, 0.0, displacement)
    amplitude, part = amplitude_of(drawing, moved, turned)
    scale = scale_of(drawing, moved, turned, amplitude, _SWING_LARGEST_ROTATION)
    start, handles = pose_of(arrays, state), _handles_of(arrays)

    def pose(share: float) -> Pose:
        there = pose_of(arrays, state.moved(share * (moved + turned)))
        way = start.position, there.position, share * turned
        position = _carried_by_bodies(handles, *way)
        return Pose(np.where(placed, position, 0.0), there.rotation)

    poses = tuple(pose(scale * phase) for phase in np.linspace(-1.0, 1.0, _POSES).tolist())
    return Movement(scale, np.nan, poses, about, part)
