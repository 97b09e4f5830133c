"""What could be released, held or declared independent, from the null spaces of D(c).

In a null space of several dimensions single vectors are arbitrary; what counts is how
far each coordinate or deformation reaches into the space, its leverage: the norm of its
row in an orthonormal basis, with rotations and moments made comparable by the
characteristic length.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .configuration import assembled
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
    return _largest(_norms(_releasable(analysis)))


def release_set(analysis: Analysis) -> list[int]:
    """Rows of D(c) that remove all self-stresses when all of them are released."""
    return _independent_rows(_releasable(analysis))


def coordinates(analysis: Analysis) -> list[int]:
    """Columns of D(c) that can be fixed or made independent to remove a motion."""
    return _largest(_norms(_motions(analysis)))


def coordinate_set(analysis: Analysis) -> list[int]:
    """Columns of D(c) that remove all motions when all are fixed or made independent."""
    return _independent_rows(_motions(analysis))


def deformations(analysis: Analysis) -> list[tuple[int, int]]:
    """Released deformations that the motions change, as element index from 0 and number.

    To hold one, or to make it independent, removes a motion.
    """
    arrays = analysis.data.arrays
    whole = assembled(analysis.model, analysis.model.reference())
    motions = _motions(analysis) / column_weights(analysis)[:, None]
    node, axis = analysis.raw.column_label - 1
    velocity = np.zeros((arrays.node_number.size, 3, motions.shape[1]))
    velocity[node, axis] = motions
    of_column = velocity.reshape(-1, motions.shape[1])
    rates = np.zeros((6 * arrays.element_number.size, motions.shape[1]))
    np.add.at(rates, whole.row_of, whole.value[:, None] * of_column[whole.column_of])
    angle = dual_table()[arrays.element_kind] == Dual.MOMENT
    weight = np.where(angle, analysis.characteristic_length, 1.0)
    released = arrays.deformation_class.T == Class.DEPENDENT
    leverage = np.where(released, weight, 0.0).ravel() * _norms(rates)
    return [(row // 6, row % 6 + 1) for row in _largest(leverage)]


def _motions(analysis: Analysis) -> FloatArray:
    """(n, motions) orthonormal basis of the motions, rotations in lengths."""
    return _orthonormal(column_weights(analysis), analysis.raw.motions)


def _releasable(analysis: Analysis) -> FloatArray:
    """(m, self-stresses) as `_motions`, moments in forces; zero where nothing is to release."""
    basis = _orthonormal(row_weights(analysis), analysis.raw.stresses)
    element, deformation = analysis.raw.row_label - 1
    held = analysis.data.arrays.deformation_class[deformation, element] == Class.FIXED
    return np.where(held[:, None], basis, 0.0)


def _orthonormal(weights: FloatArray, basis: FloatArray) -> FloatArray:
    """Orthonormal basis of the weighted space."""
    q: FloatArray = np.linalg.qr(weights[:, None] * basis)[0]
    return q


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
