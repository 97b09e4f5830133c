# SPDX-License-Identifier: BSD-3-Clause
"""The exact-constraint verdict in a configuration: counts of the deck's own classes."""

from __future__ import annotations

import math

import numpy as np

from ..analysis.decomposition import asked_for
from ..analysis.result import Result, result_of
from ..core import calls
from ..core.arrays import FloatArray
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
            raw = calls.assemble(self.data.packed, configuration, self._c_t)
            row, column = np.cumsum(held) - 1, np.cumsum(free) - 1
            there = held[raw.row_of] & free[raw.column_of]
            place = row[raw.row_of[there]] * n + column[raw.column_of[there]]
            dense = np.bincount(place, raw.value[there], m * n).reshape(m, n)
            value = float(np.linalg.svd(dense, compute_uv=False).min(initial=math.inf))
        if at_rest:
            return self.result.under_constrained, self.result.over_constrained, value
        if m * n > _MOST:
            raise ElasticError(
                f"D(c) has {m} rows and {n} columns: it is not decomposed away from the reference"
            )
        turns = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)[free]
        length = self.data.frames.length[self.data.frames.length > 0.0]
        mean = math.exp(float(np.log(length).mean())) if length.size else 1.0
        scaled = np.where(turns, dense / mean, dense)
        norm = np.linalg.norm(scaled, axis=1, keepdims=True)
        values = np.linalg.svd(scaled / np.where(norm > 0.0, norm, 1.0), compute_uv=False)
        rank = int(np.count_nonzero(values > self.result.gap.zero_elsewhere(self.result.raw.noise)))
        return n - rank, m - rank, value
