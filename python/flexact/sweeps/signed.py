# SPDX-License-Identifier: BSD-3-Clause
"""The smallest singular value of D(c) with a sign that changes where a square D(c) is singular."""

from __future__ import annotations

import math
import zlib
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..analysis.failing import AnalysisError
from ..core import calls
from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind
from ..model.data import ModelData
from ..model.parts.condensing import condensed

#: Entries of D(c), as it is held in full, over all coordinates.
MOST_ENTRIES = 16_000_000


class Scaled(NamedTuple):
    """The scaled D(c) of a model."""

    matrix: FloatArray
    """(m, n) free of units, theory.md (2)."""
    topology: int
    """The same for models whose rows and columns are the same deformations and coordinates."""


class Signed(NamedTuple):
    """A singular value of the scaled D(c), with a sign."""

    value: float
    """Its sign is that of the determinant, where D(c) is square and all singular values count;
    NaN where there is no such singular value."""
    topology: int
    size: int
    """How many singular values there are."""


class SignedColumns(NamedTuple):
    """Of variants their `Signed`, each (variants,); the topology is -1 where there is none."""

    value: FloatArray
    topology: NDArray[np.int64]
    size: NDArray[np.int64]

    def taken(self, index: NDArray[np.integer]) -> SignedColumns:
        """Those of some variants."""
        return SignedColumns(*(each[index] for each in self))


def columns_of_signed(every: Sequence[Signed | None]) -> SignedColumns:
    """The columns of variants."""
    there = [each or Signed(math.nan, -1, 0) for each in every]
    return SignedColumns(
        np.array([each.value for each in there], np.float64),
        np.array([each.topology for each in there], np.int64),
        np.array([each.size for each in there], np.int64),
    )


def scaled_jacobian(data: ModelData) -> Scaled:
    """D(c) as rank is decided on, but for components of quite another size.

    Rotations are multiplied by the characteristic length, and each row, over all coordinates,
    is brought to the norm one. Scales are positive, so that they keep the determinant's sign.

    Raises:
        AnalysisError: it is too large.
    """
    one = condensed(data).data
    arrays = one.arrays
    raw = calls.assemble(one.packed, arrays.node_value, np.zeros(arrays.element_number.size))
    deformations, coordinates = arrays.deformation_class.T, arrays.coordinate_class.T
    rows = np.flatnonzero((deformations == Class.FIXED) | (deformations == Class.INDEPENDENT))
    columns = np.flatnonzero(coordinates == Class.DEPENDENT)
    _require_room(rows.size, coordinates.size)
    place = np.full(deformations.size, -1)
    place[rows] = np.arange(rows.size)
    there = place[raw.row_of] >= 0
    full = np.zeros((rows.size, coordinates.size))
    np.add.at(full, (place[raw.row_of[there]], raw.column_of[there]), raw.value[there])
    turns = np.repeat(arrays.node_kind > NodeKind.POSITION, coordinates.shape[1])
    full[:, turns] /= characteristic_length(one.frames.length)
    norm = np.linalg.norm(full, axis=1, keepdims=True)
    matrix = full[:, columns] / np.where(norm > 0.0, norm, 1.0)
    described = (arrays.element_kind, arrays.element_node, rows, columns)
    topology = 0
    for array in described:
        topology = zlib.crc32(np.ascontiguousarray(array).tobytes(), topology)
    return Scaled(matrix, topology)


def _require_room(rows: int, columns: int) -> None:
    if rows * columns > MOST_ENTRIES:
        raise AnalysisError(
            f"D(c) has {rows} rows and the model {columns} coordinates, too many to follow a "
            "singular value between variants"
        )


def characteristic_length(lengths: FloatArray) -> float:
    """The geometric mean of the lengths that are not zero; one without any."""
    positive = lengths[lengths > 0.0]
    return math.exp(float(np.log(positive).mean())) if positive.size else 1.0


def signed_value(data: ModelData, rank: int | None = None) -> Signed:
    """The smallest singular value of the scaled D(c), or that which ends a rank.

    Args:
        data: A sound model.
        rank: The singular value of this number, from 1, counts; by default the last.
    """
    matrix, topology = scaled_jacobian(data)
    size = min(matrix.shape)
    place = size if rank is None else rank
    if not 0 < place <= size:
        return Signed(math.nan, topology, size)
    value = float(np.linalg.svd(matrix, compute_uv=False)[place - 1])
    if matrix.shape[0] == matrix.shape[1] == place:
        value = math.copysign(value, np.linalg.slogdet(matrix).sign)
    return Signed(value, topology, size)
