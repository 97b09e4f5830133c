"""Configurations, deformation functions eq. (5), and their Jacobian eq. (8)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _boundary
from .elements import Class, NodeKind, coordinate_name
from .exchange import FloatArray, IntArray, ModelArrays, RawAssembly
from .frozen import Frozen

if TYPE_CHECKING:
    from .model import Model


@dataclass(frozen=True, eq=False)
class Configuration(Frozen):
    """Where all nodes of a model are.

    Attributes:
        kinds: (nodes,) `NodeKind` of each node.
        value: (nodes, 4) position [m]; Euler parameters, of any length but zero; or the
            angle [rad] of a planar node.
    """

    kinds: IntArray
    value: FloatArray

    def __post_init__(self) -> None:
        """Take read-only copies and check their shape."""
        kinds, value = np.array(self.kinds, np.int32), np.array(self.value, np.float64)
        if value.shape != (kinds.size, 4):
            raise ValueError(f"value has shape {value.shape}, not {(kinds.size, 4)}")
        object.__setattr__(self, "kinds", kinds)
        object.__setattr__(self, "value", value)
        super().__post_init__()

    def moved(self, delta: ArrayLike) -> Configuration:
        """This configuration moved by displacements and rotations.

        Args:
            delta: (nodes, 3) displacement of a position [m] along x, y, z; rotation vector
                [rad] about the global axes of an orientation, applied after the rotation
                that it has; a planar angle takes the third.

        Raises:
            ValueError: `delta` has another shape.
        """
        move = np.asarray(delta, np.float64)
        if move.shape != (self.kinds.size, 3):
            raise ValueError(f"delta has shape {move.shape}, not {(self.kinds.size, 3)}")
        value = self.value.copy()
        places = self.kinds <= NodeKind.POSITION
        value[places, :3] += move[places]
        angles = self.kinds == NodeKind.ANGLE
        value[angles, 0] += move[angles, 2]
        turned = self.kinds == NodeKind.ORIENTATION
        value[turned] = _turned(value[turned], move[turned])
        return Configuration(self.kinds, value)


def _turned(euler: FloatArray, rotation: FloatArray) -> FloatArray:
    """Euler parameters (k, 4) after a further rotation by vectors (k, 3)."""
    angle = np.linalg.norm(rotation, axis=1)[:, None]
    scalar = np.cos(angle / 2)
    vector = rotation * np.sinc(angle / (2 * np.pi)) / 2
    old_scalar, old_vector = euler[:, :1], euler[:, 1:]
    made: FloatArray = np.hstack(
        [
            scalar * old_scalar - np.sum(vector * old_vector, axis=1, keepdims=True),
            scalar * old_vector + old_scalar * vector + np.cross(vector, old_vector),
        ]
    )
    return made


@dataclass(frozen=True, eq=False)
class Jacobian(Frozen):
    """All deformations differentiated with respect to all coordinates, eq. (8).

    Attributes:
        rows: (entries,) row of each stored entry, from 0.
        columns: (entries,) column of each stored entry, from 0.
        values: (entries,) the entries; those at one place add up.
        shape: Number of deformations and of coordinates.
    """

    rows: IntArray
    columns: IntArray
    values: FloatArray
    shape: tuple[int, int]
    _arrays: ModelArrays = field(repr=False)
    _row_label: IntArray = field(repr=False)
    _column_label: IntArray = field(repr=False)

    @cached_property
    def row_labels(self) -> tuple[tuple[int, int], ...]:
        """Element number and deformation (from 1) of each row."""
        return row_labels(self._arrays, self._row_label)

    @cached_property
    def column_labels(self) -> Labels:
        """Node number and coordinate name of each column."""
        return column_labels(self._arrays, self._column_label)

    def toarray(self) -> FloatArray:
        """The matrix in full, (deformations, coordinates)."""
        full = np.zeros(self.shape)
        np.add.at(full, (self.rows, self.columns), self.values)
        return full


Labels = tuple[tuple[int, str], ...]


def row_labels(arrays: ModelArrays, label: NDArray[np.integer]) -> tuple[tuple[int, int], ...]:
    """Element numbers and deformations from 1 of (2, m) their indices, both from 0."""
    numbers = arrays.element_number[label[0]].tolist()
    return tuple(zip(numbers, (label[1] + 1).tolist(), strict=True))


def column_labels(arrays: ModelArrays, label: NDArray[np.integer]) -> Labels:
    """Node numbers and coordinate names of (2, n) node indices and axes, both from 0."""
    numbers = arrays.node_number[label[0]].tolist()
    kinds = arrays.node_kind[label[0]].tolist()
    axes = label[1].tolist()
    return tuple(
        (number, coordinate_name(kind, axis))
        for number, kind, axis in zip(numbers, kinds, axes, strict=True)
    )


def deformations(
    model: Model, configuration: Configuration, c_t: float | ArrayLike = 0.0
) -> FloatArray:
    """The deformations in a configuration: eqs. (2) to (4), and the planar ones.

    Args:
        model: The model.
        configuration: Where its nodes are.
        c_t: Constant of the torsion-elongation coupling in eq. (3) [m^2], polar second
            moment of area over area; one for all elements or one each.

    Returns:
        (deformations,) values in the order of the rows of `jacobian` [m, or rad of a hinge].

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        ValueError: the configuration or `c_t` is of another shape.
    """
    raw = assembled(model, configuration, c_t)
    exists = model.data.arrays.deformation_class != Class.NONE
    values: FloatArray = raw.deformation.T[exists.T]
    return values


def jacobian(
    model: Model, configuration: Configuration | None = None, c_t: float | ArrayLike = 0.0
) -> Jacobian:
    """The derivatives of `deformations`, by default in the reference configuration.

    A column of a rotation is the derivative with respect to an instantaneous rotation
    [rad] about a global axis.

    Args:
        model: The model.
        configuration: Where its nodes are.
        c_t: As for `deformations`.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        ValueError: the configuration or `c_t` is of another shape.
    """
    raw = assembled(model, configuration or model.reference(), c_t)
    arrays = model.data.arrays
    row_index, row_label = _compact(arrays.deformation_class)
    column_index, column_label = _compact(arrays.coordinate_class)
    return Jacobian(
        row_index[raw.row_of],
        column_index[raw.column_of],
        raw.value,
        (row_label.shape[1], column_label.shape[1]),
        arrays,
        row_label,
        column_label,
    )


def _compact(classes: IntArray) -> tuple[IntArray, IntArray]:
    """Index of each part of each owner, -1 where it has none; owner and part (2, k) of each."""
    exists = (classes != Class.NONE).T
    index = np.where(exists, np.cumsum(exists).reshape(exists.shape) - 1, -1)
    return index.ravel().astype(np.int32), np.argwhere(exists).T.astype(np.int32)


def assembled(
    model: Model, configuration: Configuration, c_t: float | ArrayLike = 0.0
) -> RawAssembly:
    """What `deformations` and `jacobian` give, as the core numbers it; see there."""
    data = model.data
    data.require_sound()
    elements = data.arrays.element_number.size
    coupling = np.asarray(c_t, np.float64)
    if coupling.shape not in ((), (elements,)):
        raise ValueError(f"c_t has shape {coupling.shape}, not {(elements,)}")
    return _boundary.assemble(
        data.arrays,
        data.count.entries,
        configuration.value.T,
        np.broadcast_to(coupling, (elements,)),
    )
