# SPDX-License-Identifier: BSD-3-Clause
"""Diagrams of bending moments: beside the members as they are seen, on the stretched side.

A diagram stands on the outline of its member: on the side of the section that the moment
stretches, as far out as the member reaches in the picture, and a little off it. So neither a wide
sheet nor a thick beam hides it. Where the plane of bending would be seen edge-on, the diagram is
turned about the member, by as little as makes it as wide as is needed to see it.
`page/diagram.js` does the same whenever the eye moves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.directions import signs_of
from ...util.records import Frozen
from .drawing import Drawing
from .members import Members
from .quantities import BENDING
from .resultants import Resultants
from .rotations import unit

#: Height of the largest moment, and the gap between a member and its diagram: parts of the
#: drawing's size.
HEIGHT, GAP = 0.1, 0.012
#: The part of its height that a diagram shows at least, and how much of a member must be seen
#: across the line of sight for that.
SHOWN, _END_ON = 0.45, 0.05
#: Values below this part of the largest are not drawn.
_LEAST = 1.0e-6


@dataclass(frozen=True, eq=False)
class Diagrams(Frozen):
    """Diagrams from the same end of each member, whichever is called p.

    Attributes:
        member: (k,) which of the drawing's members; one whose moment changes its sign is there
            twice.
        value: (k, s) moments at stations [N m].
        base: (k, s, 3) where they are zero [m].
        top: (k, s, 3) where they are as they are [m].
        ends: (k, 2) which ends are those of a sheet or a wire, and not within it.
    """

    member: np.ndarray
    value: FloatArray
    base: FloatArray
    top: FloatArray
    ends: np.ndarray


def diagrams_of(
    drawing: Drawing, values: Resultants, quantity: str, towards: FloatArray, pieces: int = 36
) -> Diagrams:
    """The diagrams of a bending moment in the reference configuration.

    Args:
        drawing: The drawing.
        values: Of a self-stress along its members.
        quantity: One of `BENDING`; of another there are none.
        towards: (3,) unit vector to the eye.
        pieces: Of each diagram.
    """
    largest = values.largest(quantity)
    rows, sign = np.zeros(0, np.int64), np.zeros(0)
    if quantity in BENDING and largest > 0.0:
        signed = np.stack((values[quantity], -values[quantity]), axis=1)
        there = (signed.max(axis=2) > _LEAST * largest) & drawing.seen[:, None]
        rows, which = np.nonzero(there)
        sign = np.array((1.0, -1.0))[which]
    members = drawing.members
    ends = drawing.reference.position[members.nodes[rows][:, [0, 2]]]
    value, last = values[quantity][rows], ~members.joined[rows]
    turned = signs_of(ends[:, 1] - ends[:, 0]) < 0.0
    for each in (ends, value, last):
        each[turned] = each[turned, ::-1]
    share, cut = _interval(sign[:, None] * value)
    at = share[:, :1] + (share[:, 1:] - share[:, :1]) * np.linspace(0.0, 1.0, pieces + 1)
    along = (1 - at) * value[:, :1] + at * value[:, 1:]
    centre = (1 - at)[..., None] * ends[:, :1] + at[..., None] * ends[:, 1:]
    foot, way = stance(members, rows, sign, BENDING.get(quantity, 0), towards)
    base = centre + (foot + GAP * drawing.size * way)[:, None]
    height = HEIGHT * drawing.size / (largest or 1.0)
    top = base + (height * np.abs(along))[..., None] * way[:, None]
    return Diagrams(rows, along, base, top, last & ~cut)


def stance(
    members: Members, rows: np.ndarray, sign: FloatArray, bending: int, towards: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Where the diagrams of some members stand, and which way they go.

    Args:
        members: The members.
        rows: (k,) which of them.
        sign: (k,) of the moments.
        bending: Row of the directions across a member, as of `BENDING`.
        towards: (3,) unit vector to the eye.

    Returns:
        (k, 3) from the axes [m], and (k, 3) unit vectors.
    """
    frame = members.frame[rows]
    ex = frame[..., 0]
    stretched = sign[:, None] * np.einsum(
        "kxd,kd->kx", frame[..., 1:], members.across[rows, bending]
    )
    sideways = np.cross(ex, towards)
    end_on = np.linalg.norm(sideways, axis=1) < _END_ON
    sideways = np.where(end_on[:, None], stretched, unit(sideways))
    seen = np.sum(stretched * sideways, axis=1)
    side = np.where(seen < -1.0e-9, -1.0, 1.0)
    outward = side[:, None] * sideways
    depth = stretched - seen[:, None] * sideways
    away = np.where(np.abs(seen) < SHOWN, SHOWN, np.abs(seen))
    way = away[:, None] * outward + np.sqrt(1.0 - np.minimum(away, 1.0) ** 2)[:, None] * unit(depth)
    return _outermost(members, rows, outward, stretched), unit(way)


def _outermost(
    members: Members, rows: np.ndarray, outward: FloatArray, stretched: FloatArray
) -> FloatArray:
    """(k, 3) from axes to the points of sections that are farthest along a direction [m]."""
    across, half = members.frame[rows][..., 1:], members.section[rows] / 2
    part = np.einsum("kx,kxd->kd", outward, across)
    tie = np.einsum("kx,kxd->kd", stretched, across)
    corner = np.where(np.abs(part) > 1.0e-9, np.sign(part), np.sign(np.round(tie, 9))) * half
    size = np.linalg.norm(half * part, axis=1, keepdims=True)
    ellipse = half**2 * part / np.where(size > 0.0, size, 1.0)
    chosen = np.where(members.round[rows][:, None], ellipse, corner)
    return np.asarray(np.einsum("kxd,kd->kx", across, chosen))


def _interval(value: FloatArray) -> tuple[FloatArray, np.ndarray]:
    """(k, 2) shares between which linear values (k, 2) are positive, and which ends those cut."""
    first, last = value.T
    slope = np.where(last == first, 1.0, last - first)
    zero = np.clip(-first / slope, 0.0, 1.0)
    cut = value < 0.0
    return np.where(cut, zero[:, None], (0.0, 1.0)), cut
