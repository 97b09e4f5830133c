# SPDX-License-Identifier: BSD-3-Clause
"""Deformation functions, eq. (5), and their Jacobian, eq. (8), of a model in a configuration."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..core import calls
from ..core.arrays import FloatArray, IntArray, ModelArrays, floats
from ..core.elements import Class
from ..core.raw import RawAssembly
from ..util.errors import require_kind
from ..util.records import Frozen, cached_property
from .configuration import Configuration
from .data import Labels, column_labels, row_labels
from .model import Model


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
        TypeError: something is of another kind than it must be.
        ValueError: the configuration or `c_t` is of another shape, or a number is too large.
    """
    require_kind(model, Model, "deformations are those of a Model")
    raw = assembled(model, configuration, c_t)
    exists = model.data.arrays.deformation_class != Class.NONE
    return np.asarray(raw.deformation.T[exists.T])


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
        TypeError: something is of another kind than it must be.
        ValueError: the configuration or `c_t` is of another shape, or a number is too large.
    """
    require_kind(model, Model, "the Jacobian is that of a Model")
    placed = model.reference() if configuration is None else configuration
    raw = assembled(model, placed, c_t)
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
    require_kind(configuration, Configuration, "nodes are placed by a Configuration")
    elements = data.arrays.element_number.size
    coupling = floats(c_t, "c_t")
    if coupling.shape not in ((), (elements,)):
        raise ValueError(f"c_t has shape {coupling.shape}, not {(elements,)}")
    return calls.assemble(
        data.packed,
        configuration.value.T,
        np.broadcast_to(coupling, (elements,)),
    )
