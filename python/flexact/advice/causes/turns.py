# SPDX-License-Identifier: BSD-3-Clause
"""Turning a limb as a whole: which nodes and vectors it takes along."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import Vector, element_kinds
from ...model.parts.parts import PartKind
from .limbs import Limb, Limbs

#: Components below this part of the size of the mechanism are zero.
_ZERO = 1.0e-12
#: Points nearer than this part of the characteristic length are one.
_TOO_NEAR = 1.0e-3


class Turn(NamedTuple):
    """A limb turned about a line."""

    limb: Limb
    end: int
    """Index of the position node of the body or point that it holds, in the model as given."""
    direction: FloatArray
    point: FloatArray
    """(3,) of the line [m]."""
    angle: float
    """[rad]."""


def change_of(result: Result, limbs: Limbs, turn: Turn) -> Change | None:
    """What a turn does to the model as given; None where the limb cannot be turned so.

    It cannot where a point that it shares with other limbs would move, or where it would come
    to stand on another point.
    """
    arrays = result.given.arrays
    elements = [index for part in turn.limb.parts for index in part.elements]
    found = set((arrays.element_node[[0, 2]][:, elements] - 1).ravel().tolist())
    matrix = _rotation(turn.direction, turn.angle)
    places = arrays.node_value[:3].T
    after = places.copy()
    made = {}
    for node in sorted(found):
        after[node] = turn.point + matrix @ (places[node] - turn.point)
        way = float(np.linalg.norm(after[node] - places[node]))
        if way <= _ZERO * result.characteristic_length:
            continue
        if not _is_own(result, limbs, turn.limb, node):
            return None
        made[node] = _rounded(after[node], result.characteristic_length)
    if not made or _is_in_the_way(result, turn.limb, after):
        return None
    numbers = arrays.node_number
    return Change(
        places=tuple((int(numbers[node]), place) for node, place in made.items()),
        vectors=tuple(_vectors(result, elements, matrix)),
    )


def _is_in_the_way(result: Result, limb: Limb, places: FloatArray) -> bool:
    """Whether a member of a limb goes through a point of another one, or the other way round.

    Of divided sheets and wires their ends count.
    """
    arrays, condensed = result.data.arrays, result.condensed
    mine = np.isin(condensed.elements, [index for part in limb.parts for index in part.elements])
    ends = arrays.element_node[[0, 2]] - 1
    both = (ends >= 0).all(axis=0)
    near = _TOO_NEAR * result.characteristic_length
    own = set(ends[:, mine & both].ravel().tolist())
    others = set(ends[:, ~mine & both].ravel().tolist()) - own
    at = places[condensed.nodes]
    for chosen, points in ((mine & both, others), (~mine & both, own)):
        for p, q in ends[:, chosen].T.tolist():
            beside = [node for node in points if node not in (p, q)]
            if beside and _distances(at[beside], at[p], at[q]).min() < near:
                return True
    return False


def _distances(points: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
    """(points,) from a segment."""
    way = last - first
    size = float(way @ way)
    share = np.clip((points - first) @ way / size, 0.0, 1.0) if size > 0.0 else 0.0 * points[:, 0]
    made: FloatArray = np.linalg.norm(points - first - share[:, None] * way, axis=1)
    return made


def _is_own(result: Result, limbs: Limbs, limb: Limb, node: int) -> bool:
    """Whether nothing but the limb and one body is at a node."""
    others = [part for part in limbs.parts.at(node) if part not in limb.parts]
    return all(part.kind is PartKind.BODY for part in others) and len(others) <= 1


def _vectors(
    result: Result, elements: list[int], matrix: FloatArray
) -> list[tuple[int, tuple[float, float, float]]]:
    """The vectors of elements that have one, or need one to be turned."""
    arrays, frames = result.given.arrays, result.given.frames.frame
    optional = [0, *(kind.vector for kind in element_kinds())]
    made = []
    for index in elements:
        given = arrays.element_vector[:, index]
        sheet = bool(result.parts.wide[index])
        if not given.any() and not (sheet and optional[arrays.element_kind[index]] != Vector.NONE):
            continue
        own = given if given.any() else frames[index][:, 1]
        turned = _rounded(matrix @ own, float(np.linalg.norm(own)))
        made.append((int(arrays.element_number[index]), turned))
    return made


def _rounded(vector: FloatArray, size: float) -> tuple[float, float, float]:
    """Twelve digits, so that a quarter turn leaves whole numbers whole."""
    digits = 12 - int(np.floor(np.log10(size)))
    x, y, z = (float(np.round(value, digits)) + 0.0 for value in vector)
    return x, y, z


def _rotation(axis: FloatArray, angle: float) -> FloatArray:
    cross = np.cross(np.eye(3), axis)
    made: FloatArray = np.eye(3) - np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return made
