# SPDX-License-Identifier: BSD-3-Clause
"""The exact-constraint verdict in a configuration: counts of the deck's own classes."""

from __future__ import annotations

import math

import numpy as np

from ..analysis.decomposition import asked_for
from ..analysis.result import Result, result_of
from ..core import calls
from ..core.arrays import BoolArray, FloatArray
from ..core.elements import Class, NodeKind
from ..model.data import ModelData
from ..util.records import cached_property
from .errors import ElasticError

#: More rows times columns than these are not decomposed in full.
_MOST = 6_000_000


class Verdicts:
    """Judges configurations of a model."""

    def __init__(self, data: ModelData, c_t: FloatArray) -> None:
        """Keep the model as given, and its torsion-elongation constants (elements,)."""
        self.data, self._c_t = data, c_t

    @cached_property
    def result(self) -> Result:
        """The analysis of the reference configuration."""
        return result_of(self.data, asked_for("auto", None), None, None, Result)

    @cached_property
    def over_constrained(self) -> int:
        """Number of self-stresses in the reference configuration."""
        return int(self.result.over_constrained)

    def of(self, configuration: FloatArray) -> tuple[int, int, float]:
        """The verdict where the nodes are, (4, nodes).

        Returns:
            By how much it is under- and over-constrained, and the smallest singular value of D(c)
            in the deck's units, infinite where D(c) has no rows or no columns.

        Raises:
            ElasticError: the model is too large for it.
        """
        arrays = self.data.arrays
        held = np.isin(arrays.deformation_class.T.ravel(), (Class.FIXED, Class.INDEPENDENT))
        free = (arrays.coordinate_class == Class.DEPENDENT).T.ravel()
        m, n = int(held.sum()), int(free.sum())
        at_rest = np.array_equal(configuration, arrays.node_value)
        value = math.nan
        if m * n <= _MOST:
            dense = self._dense(configuration, held, free)
            value = float(np.linalg.svd(dense, compute_uv=False).min(initial=math.inf))
        if at_rest:
            return self.result.under_constrained, self.result.over_constrained, value
        if m * n > _MOST:
            raise ElasticError(
                f"D(c) has {m} rows and {n} columns: it is not decomposed away from the reference"
            )
        turns = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)[free]
        scaled = np.where(turns, dense / self._length, dense)
        norm = np.linalg.norm(scaled, axis=1, keepdims=True)
        values = np.linalg.svd(scaled / np.where(norm > 0.0, norm, 1.0), compute_uv=False)
        rank = int(np.count_nonzero(values > self.result.gap.zero_elsewhere(self.result.raw.noise)))
        return n - rank, m - rank, value

    def _dense(self, configuration: FloatArray, held: BoolArray, free: BoolArray) -> FloatArray:
        raw = calls.assemble(self.data.packed, configuration, self._c_t)
        row = np.cumsum(held) - 1
        column = np.cumsum(free) - 1
        there = held[raw.row_of] & free[raw.column_of]
        m, n = int(held.sum()), int(free.sum())
        place = row[raw.row_of[there]] * n + column[raw.column_of[there]]
        flat = np.bincount(place, raw.value[there], m * n)
        return np.asarray(flat.reshape(m, n), np.float64)

    @cached_property
    def _length(self) -> float:
        """The geometric mean of the lengths of elements [m]."""
        length = self.data.frames.length
        there = length[length > 0.0]
        return math.exp(float(np.log(there).mean())) if there.size else 1.0
