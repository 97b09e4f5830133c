# SPDX-License-Identifier: BSD-3-Clause
"""What is not as designed: clamps moved or turned, elements of other lengths, warmth."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Class, Dual, NodeKind, Role, dual_table, role_table
from ..model.data import ModelData
from ..util.quantities import without_units
from ..util.records import Frozen
from ..util.rotations import matrix_of, turned
from ..util.text import in_short
from .errors import ElasticError, require_within
from .points import Points


class Angle(float):
    """An angle [rad]: a number, and a vector of one where positions are gone through alike."""

    def __getitem__(self, index: int) -> float:
        """The number."""
        return (float(self),)[index]

    def __iter__(self) -> Iterator[float]:
        """The number, once."""
        yield float(self)

    def __len__(self) -> int:
        """One."""
        return 1


def dual_to_parameters(euler: FloatArray, moment: FloatArray) -> FloatArray:
    """(3,) what does work on twice the changes of lambda1..3, of a moment (3,) on the spin.

    The spin is 2 (l0 dl - dl0 l - dl x l) with dl0 = -(l . dl)/l0.
    """
    unit = euler / np.linalg.norm(euler)
    scalar, vector = unit[0], unit[1:]
    return np.asarray(
        scalar * moment + (vector @ moment) / scalar * vector - np.cross(vector, moment)
    )


_LENGTHS = (Role.ELONGATION, Role.OFFSET_X, Role.OFFSET_Y, Role.OFFSET_Z)


@dataclass(frozen=True, eq=False)
class Imperfection(Frozen):
    """What moves the supports of a model or changes its elements, by a value.

    Attributes:
        words: What it is, such as "x of clamp 11".
        value: How much: m, rad, K, or the unit of a deformation.
        axis: Along or about which of the global axes supports move; -1 where they do not.
        is_turn: Whether they turn.
        centre: (3,) about which they do.
        moved: (3, nodes) which of the held coordinates follow, as the deck numbers nodes.
        misfit: (6, elements) by how much the deck's elements are off for each unit.
    """

    words: str
    value: float
    axis: int
    is_turn: bool
    centre: FloatArray
    moved: FloatArray
    misfit: FloatArray

    @property
    def label(self) -> str:
        """Such as "off: x of clamp 11 by 5e-05"."""
        return f"off: {self.words} by {self.value:g}"

    def shift(self, data: ModelData) -> FloatArray:
        """(3, nodes) velocity of the supports for each unit."""
        made = np.zeros(self.moved.shape, order="F")
        if self.axis < 0:
            return made
        direction = np.eye(3)[self.axis]
        turns = data.arrays.node_kind > NodeKind.POSITION
        if not self.is_turn:
            made[:, ~turns] = direction[:, None]
        else:
            arm = data.arrays.node_value[:3, ~turns] - self.centre[:, None]
            made[:, ~turns] = np.cross(direction, arm.T).T
            made[:, turns] = direction[:, None]
        return np.asfortranarray(made * self.moved)

    def moved_to(self, value: FloatArray, data: ModelData) -> FloatArray:
        """(4, nodes) where the supports are at `value` (4, nodes) after it."""
        made = value.copy(order="F")
        if self.axis < 0:
            return made
        direction = np.eye(3)[self.axis]
        for node in np.flatnonzero(self.moved.any(axis=0)).tolist():
            kind, there = data.arrays.node_kind[node], self.moved[:, node] > 0.0
            if kind == NodeKind.ANGLE:
                made[0, node] += self.value
            elif kind == NodeKind.ORIENTATION:
                # Of single Euler parameters those that are held count.
                rotation = self.value * direction[None]
                made[:, node] = turned(value[:, node][None], rotation)[0]
            else:
                old = value[:3, node]
                new = old + self.value * direction
                if self.is_turn:
                    turn = matrix_of(self.value * direction)
                    new = self.centre + turn @ (old - self.centre)
                made[:3, node][there] = new[there]
        return made


def number_given(value: object, what: str) -> float:
    """A finite number.

    Raises:
        ElasticError: it is none.
    """
    if (
        isinstance(value, bool)
        or not isinstance(value, (int, float, np.number))
        or not math.isfinite(value)
    ):
        raise ElasticError(f"{what} must be a finite number, not {in_short(value)}")
    return float(value)


def _none(data: ModelData, words: str, value: float) -> Imperfection:
    nodes, elements = data.arrays.node_number.size, data.arrays.element_number.size
    return Imperfection(
        words, value, -1, False, np.zeros(3), np.zeros((3, nodes)), np.zeros((6, elements))
    )


def misalignment(
    points: Points,
    node: object,
    name: object,
    value: object,
    about: object = None,
    beyond: bool = False,
) -> Imperfection:
    """A clamp that is moved along, or turned about, a global axis.

    Raises:
        UnknownError: there is no such node or coordinate.
        ElasticError: the coordinate is not held, or the value is no finite number; or it is
            larger than the model, and not `beyond`.
    """
    coordinate = points.coordinate(node, name)
    data = points.data
    is_turn = data.arrays.node_kind[coordinate.node] > NodeKind.POSITION
    size = number_given(without_units(value, "rad" if is_turn else "m"), "a misalignment")
    # The clamp has the number that was given for it.
    words = f"{points.name(coordinate)} of clamp {points.number(points.node(node))}"
    if not beyond:
        require_within(size, data.size, bool(is_turn), f"the misalignment {words}")
    point = points.of(node)
    fixed = (data.arrays.coordinate_class == Class.FIXED).astype(np.float64)
    nodes = [point.position]
    if is_turn:
        # Orientations that turn with the clamp: of a position all that are held there.
        index = points.node(node)
        nodes = [index]
        if points.kinds[index] <= NodeKind.POSITION:
            every = points.turned_at(index)
            nodes = [each for each in every if fixed[:, each].any()] or every[:1]
        if point.position >= 0:
            nodes.append(point.position)
    moved = np.zeros_like(fixed)
    moved[:, nodes] = fixed[:, nodes]
    centre = np.zeros(3)
    if is_turn:
        if about is not None:
            centre = points.place(about)
        elif point.position >= 0:
            centre = points.place(points.number(point.position))
    elif about is not None:
        raise ElasticError("only a turn is about a point: leave out `about` of a displacement")
    made = replace(
        _none(data, words, size),
        axis=coordinate.axis,
        is_turn=bool(is_turn),
        centre=centre,
        moved=moved,
    )
    held = moved[coordinate.axis, [n for n in nodes if n != point.position or not is_turn]]
    if not held.any() and not (about is not None and made.shift(data).any()):
        raise ElasticError(
            f"{points.words(coordinate)} is not held: a misalignment is that of a coordinate that "
            f"the deck fixes (FIX); drive a declared one with along()"
        )
    return made


def misfit(
    points: Points, element: object, k: object, value: object, beyond: bool = False
) -> Imperfection:
    """An element made too long, twisted or bent, in the deck's units.

    Raises:
        UnknownError: there is no such element or deformation.
        ElasticError: the value is no finite number; or it is larger than the model, and not
            `beyond`.
    """
    index, number = points.deformation(element, k)
    data = points.data
    off = np.zeros((6, data.arrays.element_number.size))
    off[number, index] = 1.0
    words = f"deformation {number + 1} of element {int(data.arrays.element_number[index])}"
    size = number_given(value, "a misfit")
    if not beyond:
        is_angle = dual_table()[data.arrays.element_kind[index], number] == Dual.MOMENT
        require_within(size, data.size, bool(is_angle), f"the misfit, {words},")
    return replace(_none(data, words, size), misfit=off)


def warmth(
    points: Points, kelvin: object, expansion: object, elements: object = None
) -> Imperfection:
    """Elements that are warmer than the ground: e0 = expansion times kelvin times l0.

    Raises:
        UnknownError: there is no such element.
        ElasticError: a value is no finite number.
    """
    step = number_given(kelvin, "a temperature step")
    alpha = number_given(expansion, "an expansion")
    data = points.data
    if elements is None:
        which = np.arange(data.arrays.element_number.size)
    elif isinstance(elements, (list, tuple, set, frozenset, range, np.ndarray)):
        which = np.array([e for each in elements for e in points.elements(each)], np.intp)
    else:
        which = np.array(points.elements(elements), np.intp)
    roles = role_table()[data.arrays.element_kind].T
    frames, nodes = data.frames, data.arrays.element_node - 1
    way = (data.arrays.node_value[:3, nodes[2]] - data.arrays.node_value[:3, nodes[0]]).T
    offset = np.einsum("eij,ei->ej", frames.frame, way)
    size = np.zeros(roles.shape)
    for role in _LENGTHS:
        axis = role - Role.OFFSET_X
        value = frames.length if role == Role.ELONGATION else offset[:, axis]
        size += np.where(roles == role, value, 0.0)
    off = np.zeros(size.shape)
    off[:, which] = alpha * size[:, which]
    return replace(_none(data, "temperature", step), misfit=off)
