"""Motions and self-stresses: what the null spaces of D(c) mean at nodes and elements."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .elements import Dual, NodeKind, dual_table
from .exchange import FloatArray
from .frozen import Frozen

if TYPE_CHECKING:
    from .analysis import Analysis

#: Parts of a mode below this part of its largest are not named.
_UNNAMED = 1.0e-9


def column_weights(analysis: Analysis) -> FloatArray:
    """(n,) 1 for a displacement, the characteristic length for a rotation."""
    kinds = analysis.data.arrays.node_kind[analysis.raw.column_label[0] - 1]
    return np.where(kinds <= NodeKind.POSITION, 1.0, analysis.characteristic_length)


def row_duals(analysis: Analysis) -> NDArray[np.int32]:
    """(m,) `Dual` of each row of D(c)."""
    element, deformation = analysis.raw.row_label - 1
    table: NDArray[np.int32] = dual_table()[analysis.data.arrays.element_kind[element], deformation]
    return table


def row_factors(analysis: Analysis) -> FloatArray:
    """(m,) what makes a force or a moment of a stress resultant: 1, or l0 [m]."""
    over_length = row_duals(analysis) == Dual.MOMENT_OVER_LENGTH
    return np.where(over_length, analysis.raw.length[analysis.raw.row_label[0] - 1], 1.0)


def row_weights(analysis: Analysis) -> FloatArray:
    """(m,) what makes a stress resultant comparable with a force.

    A moment is divided by the characteristic length.
    """
    moment = row_duals(analysis) != Dual.FORCE
    return row_factors(analysis) / np.where(moment, analysis.characteristic_length, 1.0)


def ranked(weighted: FloatArray, most: int) -> list[int]:
    """Indices of the largest entries; those of practically one size in their order."""
    size = np.abs(weighted)
    largest = size.max(initial=0.0)
    if not largest > 0.0:
        return []
    rounded = np.round(size / largest, 9)
    order = np.argsort(-rounded, kind="stable")
    chosen: list[int] = order[rounded[order] > _UNNAMED][:most].tolist()
    return chosen


@dataclass(frozen=True, eq=False, repr=False)
class Motion(Frozen):
    """A kinematically indeterminate motion: velocities that nothing determines.

    Attributes:
        index: Which one of the analysis, from 0.
        analysis: The analysis it belongs to.
    """

    index: int
    analysis: Analysis

    @property
    def vector(self) -> FloatArray:
        """(n,) column of V: the dependent coordinates [m, rad], of unit norm."""
        column = self.analysis.raw.motions.vector(self.index)
        column.flags.writeable = False
        return column

    @cached_property
    def displacement(self) -> FloatArray:
        """(nodes, 3) displacement of each position [m]; zero rows for orientations."""
        return self._at_nodes(positions=True)

    @cached_property
    def rotation(self) -> FloatArray:
        """(nodes, 3) rotation of each orientation [rad]; zero rows for positions."""
        return self._at_nodes(positions=False)

    def _at_nodes(self, positions: bool) -> FloatArray:
        kinds = self.analysis.data.arrays.node_kind
        node, axis = self.analysis.raw.column_label - 1
        chosen = (kinds[node] <= NodeKind.POSITION) == positions
        made = np.zeros((kinds.size, 3))
        made[node[chosen], axis[chosen]] = self.vector[chosen]
        made.flags.writeable = False
        return made

    def largest(self, k: int = 6) -> list[tuple[int, str, float]]:
        """Node number, coordinate and value [m, rad] of the k largest parts.

        Rotations are compared with displacements by the characteristic length.
        """
        order = ranked(self.vector * column_weights(self.analysis), k)
        labels = self.analysis.column_labels
        return [(*labels[i], float(self.vector[i])) for i in order]

    def __repr__(self) -> str:
        """Its largest parts."""
        parts = ", ".join(f"node {n} {c} {v:.4g}" for n, c, v in self.largest(4))
        return f"<Motion {self.index + 1}: {parts}>"


@dataclass(frozen=True, eq=False, repr=False)
class SelfStress(Frozen):
    """A statically indeterminate stress: stress resultants that need no load.

    Attributes:
        index: Which one of the analysis, from 0.
        analysis: The analysis it belongs to.
    """

    index: int
    analysis: Analysis

    @property
    def vector(self) -> FloatArray:
        """(m,) column of U: stress resultants dual to the deformations, of unit norm."""
        column = self.analysis.raw.stresses.vector(self.index)
        column.flags.writeable = False
        return column

    @cached_property
    def forces(self) -> FloatArray:
        """(elements, 6) by deformation, where its stress resultant is a force [N]; else zero."""
        return self._at_elements(moments=False)

    @cached_property
    def moments(self) -> FloatArray:
        """(elements, 6) by deformation, where it is a moment [N m]; else zero.

        Of a beam's torsion and bending the moment is sigma l0.
        """
        return self._at_elements(moments=True)

    def _at_elements(self, moments: bool) -> FloatArray:
        element, deformation = self.analysis.raw.row_label - 1
        chosen = (row_duals(self.analysis) != Dual.FORCE) == moments
        values = self.vector * row_factors(self.analysis)
        made = np.zeros((self.analysis.data.arrays.element_number.size, 6))
        made[element[chosen], deformation[chosen]] = values[chosen]
        made.flags.writeable = False
        return made

    def largest(self, k: int = 6) -> list[tuple[int, int, float]]:
        """Element number, deformation and force [N] or moment [N m] of the k largest parts.

        Moments are compared with forces by the characteristic length.
        """
        order = ranked(self.vector * row_weights(self.analysis), k)
        values = self.vector * row_factors(self.analysis)
        labels = self.analysis.row_labels
        return [(*labels[i], float(values[i])) for i in order]

    def __repr__(self) -> str:
        """Its largest parts."""
        parts = ", ".join(f"element {e}, {d}: {v:.4g}" for e, d, v in self.largest(4))
        return f"<SelfStress {self.index + 1}: {parts}>"
