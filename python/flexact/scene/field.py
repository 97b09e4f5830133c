"""A motion along the members: velocities of the points of their axes, to first order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..exchange import FloatArray
from ..frozen import Frozen
from .members import Members
from .shapes import by_shape, hermite


@dataclass(frozen=True, eq=False)
class Field(Frozen):
    """A motion at the stations of members.

    Attributes:
        member: (k,) which of the scene's members.
        at: (s,) stations, from 0 at p to 1 at q.
        displacement: (k, s, 3) of the axis, in the unit of the motion [m].
        rotation: (k, s, 3) of the cross-sections [rad].
    """

    member: np.ndarray
    at: FloatArray
    displacement: FloatArray
    rotation: FloatArray


def field_along(
    members: Members, displacement: FloatArray, rotation: FloatArray, segments: int = 8
) -> Iterator[Field]:
    """A motion, given at the nodes (nodes, 3), along the members; strips as of `stations`.

    It is the derivative of the shapes of `stations` with respect to the pose, except that a
    rigid member whose ends move apart shows that they do. At the ends it is what it is at the
    nodes.
    """
    for chosen, at in by_shape(members, segments):
        yield (_bent if at.size > 2 else _straight)(members, displacement, rotation, chosen, at)


def _bent(
    members: Members, moved: FloatArray, turned: FloatArray, chosen: np.ndarray, at: FloatArray
) -> Field:
    p, op, q, oq = members.nodes[chosen].T
    ex = members.frame[chosen, :, 0]
    length = members.length[chosen, None]
    given = np.stack(
        (
            moved[p],
            length * np.cross(turned[op], ex),
            moved[q],
            length * np.cross(turned[oq], ex),
        )
    )
    value, slope = hermite(at)
    displacement = np.einsum("as,akx->ksx", value, given)
    bending = np.cross(ex[:, None], np.einsum("as,akx->ksx", slope, given) / length[:, None])
    even = (1 - at)[:, None] * turned[op][:, None] + at[:, None] * turned[oq][:, None]
    twist = np.sum(even * ex[:, None], axis=-1, keepdims=True) * ex[:, None]
    rotation = twist + bending
    # To the last bit what the nodes have.
    displacement[:, 0], displacement[:, -1] = moved[p], moved[q]
    rotation[:, 0], rotation[:, -1] = turned[op], turned[oq]
    return Field(chosen, at, displacement, rotation)


def _straight(
    members: Members, moved: FloatArray, turned: FloatArray, chosen: np.ndarray, at: FloatArray
) -> Field:
    p, op, q, oq = members.nodes[chosen].T
    first, last = moved[p], moved[q]
    displacement = first[:, None] + at[None, :, None] * (last - first)[:, None]
    displacement[:, 0], displacement[:, -1] = first, last
    length = np.where(members.length[chosen] > 0.0, members.length[chosen], 1.0)
    swing = np.cross(members.frame[chosen, :, 0], last - first) / length[:, None]
    start = np.where((op >= 0)[:, None], turned[op], swing)
    end = np.where((oq >= 0)[:, None], turned[oq], start)
    return Field(chosen, at, displacement, np.stack((start, end), axis=1))
