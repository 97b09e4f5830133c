# SPDX-License-Identifier: BSD-3-Clause
"""Turning a limb as a whole: which nodes and vectors it takes along."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import Vector, element_kinds
from ...model.parts.parts import PartKind
from ...result.result import Result
from ..change import Change
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
    made = {}
    for node in sorted(found):
        place = turn.point + matrix @ (places[node] - turn.point)
        step = _TOO_NEAR * result.characteristic_length
        if float(np.linalg.norm(place - places[node])) <= _ZERO * result.characteristic_length:
            continue
        if not _is_own(result, limbs, turn.limb, node):
            return None
        others = [n for n in _positions(result) if n not in found]
        apart = np.linalg.norm(places[others] - place, axis=1)
        if apart.min(initial=np.inf) < step:
            return None
        made[node] = _rounded(place, result.characteristic_length)
    if not made:
        return None
    numbers = arrays.node_number
    return Change(
        places=tuple((int(numbers[node]), place) for node, place in made.items()),
        vectors=tuple(_vectors(result, elements, matrix)),
    )


def _positions(result: Result) -> list[int]:
    slots = result.given.arrays.element_node[[0, 2]]
    return sorted(set((slots - 1).ravel().tolist()) - {-1})


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
