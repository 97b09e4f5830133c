"""What could be released, held or declared independent, from the null spaces of D(c).

In a null space of several dimensions single vectors are arbitrary; what counts is how
far each coordinate or deformation reaches into the space, its leverage: the norm of its
row in an orthonormal basis, with rotations and moments made comparable by the
characteristic length.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .configuration import jacobian
from .elements import Class, Dual, dual_table
from .exchange import FloatArray
from .modes import column_weights, ranked, row_weights

if TYPE_CHECKING:
    from .analysis import Analysis

#: Below this leverage a row does not reach into a space.
_NOTHING = 1.0e-7


def releases(analysis: Analysis) -> list[int]:
    """Rows of D(c) that can be released to remove a self-stress, the largest leverage first.

    Rows of independent deformations are not among them.
    """
    basis, _ = _orthonormal(row_weights(analysis), analysis.raw.stresses)
    element, deformation = analysis.raw.row_label - 1
    classes = analysis.data.arrays.deformation_class[deformation, element]
    return _largest(np.where(classes == Class.FIXED, _norms(basis), 0.0))


def release_set(analysis: Analysis) -> list[int]:
    """Rows of D(c) that remove all self-stresses when all of them are released."""
    basis, _ = _orthonormal(row_weights(analysis), analysis.raw.stresses)
    element, deformation = analysis.raw.row_label - 1
    classes = analysis.data.arrays.deformation_class[deformation, element]
    return _independent_rows(np.where((classes == Class.FIXED)[:, None], basis, 0.0))


def coordinates(analysis: Analysis) -> list[int]:
    """Columns of D(c) that can be fixed or made independent to remove a motion."""
    basis, _ = _orthonormal(column_weights(analysis), analysis.raw.motions)
    return _largest(_norms(basis))


def coordinate_set(analysis: Analysis) -> list[int]:
    """Columns of D(c) that remove all motions when all are fixed or made independent."""
    basis, _ = _orthonormal(column_weights(analysis), analysis.raw.motions)
    return _independent_rows(basis)


def deformations(analysis: Analysis) -> list[tuple[int, int]]:
    """Released deformations that the motions change, as element index from 0 and number.

    To hold one, or to make it independent, removes a motion.
    """
    arrays = analysis.data.arrays
    whole = jacobian(analysis.model)
    element, mode = np.nonzero((arrays.deformation_class != Class.NONE).T)
    released = arrays.deformation_class[mode, element] == Class.DEPENDENT
    node, axis = np.nonzero((arrays.coordinate_class != Class.NONE).T)
    column = np.full(whole.shape[1], -1)
    column[arrays.coordinate_class[axis, node] == Class.DEPENDENT] = np.arange(analysis.columns)
    kept = released[whole.rows] & (column[whole.columns] >= 0)
    _, triangle = _orthonormal(column_weights(analysis), analysis.raw.motions)
    motions = np.linalg.solve(triangle.T, analysis.raw.motions.T).T
    rates = np.zeros((whole.shape[0], motions.shape[1]))
    parts = whole.values[kept, None] * motions[column[whole.columns[kept]]]
    np.add.at(rates, whole.rows[kept], parts)
    angle = dual_table()[arrays.element_kind[element], mode] == Dual.MOMENT
    weight = np.where(angle, analysis.characteristic_length, 1.0)
    order = _largest(_norms(rates) * weight)
    return [(int(element[row]), int(mode[row]) + 1) for row in order]


def _orthonormal(weights: FloatArray, basis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Orthonormal basis Q of the weighted space, and R of `weights * basis` = Q R."""
    q, r = np.linalg.qr(weights[:, None] * basis)
    return q, r


def _norms(rows: FloatArray) -> FloatArray:
    norms: FloatArray = np.sqrt(np.einsum("ij,ij->i", rows, rows))
    return norms


def _largest(leverage: FloatArray) -> list[int]:
    return [i for i in ranked(leverage, leverage.size) if leverage[i] > _NOTHING]


def _independent_rows(basis: FloatArray) -> list[int]:
    """Rows that span the space together, each as far from the ones before as can be."""
    rest = basis.copy()
    chosen: list[int] = []
    for _ in range(basis.shape[1]):
        first = ranked(_norms(rest), 1)
        if not first or _norms(rest)[first[0]] < _NOTHING:
            break
        direction = rest[first[0]] / np.linalg.norm(rest[first[0]])
        rest -= np.outer(rest @ direction, direction)
        chosen.append(first[0])
    return chosen
