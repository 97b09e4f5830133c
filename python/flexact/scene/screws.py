"""A motion to a finite extent: rigid bodies on their screws, other nodes straight on."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..elements import NodeKind
from ..exchange import ModelArrays
from .forms import BEAMS, LINKS, all_held, is_one_of
from .groups import groups_of
from .moving import Moving
from .places import slots_of
from .pose import Pose, reference_pose
from .rotations import matrix_of, screw_matrix


def moved_by_screws(motion: Moving, shares: Iterable[float]) -> tuple[Pose, ...]:
    """The poses after a motion times each of `shares`.

    Every node of a rigid body moves on the body's screw, so that the body keeps its shape. A
    node of no body moves straight and turns about its own axis.
    """
    reference, bodies = reference_pose(motion.data.arrays), _bodies(motion.data.arrays)
    return tuple(_moved(motion, share, reference, *bodies) for share in shares)


def _moved(
    motion: Moving, share: float, reference: Pose, centre: np.ndarray, turn: np.ndarray
) -> Pose:
    moved, turned = share * motion.displacement, share * motion.rotation
    position = reference.position + moved
    rotation = matrix_of(turned)
    body = np.flatnonzero(centre >= 0)
    arm = reference.position[body] - reference.position[centre[body]]
    about = turned[turn[body]]
    carried = np.einsum("kxy,ky->kx", screw_matrix(about), moved[centre[body]])
    position[body] = (
        reference.position[centre[body]] + carried + np.einsum("kxy,ky->kx", matrix_of(about), arm)
    )
    rotation[motion.data.arrays.node_kind <= NodeKind.POSITION] = np.eye(3)
    return Pose(position, rotation)


def _bodies(arrays: ModelArrays) -> tuple[np.ndarray, np.ndarray]:
    """Of each position node of a rigid body, a position node and an orientation node of it.

    (nodes,) indices, -1 for nodes of no body.
    """
    rigid = is_one_of(arrays.element_kind, (*BEAMS, *LINKS)) & all_held(arrays)
    slots = slots_of(arrays)[rigid]
    # Members that share a position alone turn about it.
    body_of = groups_of(
        arrays.node_kind.size, ((oq, op) for _, op, _, oq in slots.tolist() if oq >= 0)
    )
    centre, turn = (np.full(arrays.node_kind.size, -1) for _ in range(2))
    first: dict[int, tuple[int, int]] = {}
    for p, op, q, _ in slots.tolist():
        body = first.setdefault(int(body_of[op]), (p, op))
        for node in (p, q):
            if centre[node] < 0:
                centre[node], turn[node] = body
    return centre, turn
