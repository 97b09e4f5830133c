"""What could be released, held or declared independent, from the null spaces of D(c).

In a null space of several dimensions single vectors are arbitrary; what counts is how
far each coordinate or deformation reaches into the space, its leverage: the norm of its
row in an orthonormal basis, with rotations and moments made comparable by the
characteristic length. A coordinate that is no column of D(c) reaches into the
self-stresses by the reaction that they cause there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .configuration import assembled
from .elements import AXES, Class, Dual, NodeKind, dual_table
from .exchange import FloatArray, RawAssembly
from .modes import column_weights, ranked, row_weights

if TYPE_CHECKING:
    from .analysis import Analysis

#: Below this leverage a row does not reach into a space.
_NOTHING = 1.0e-7

#: Index of an element from 0 and number of its deformation from 1.
Deformations = list[tuple[int, int]]
#: Index of a node and axis, both from 0.
Coordinates = list[tuple[int, int]]


def releases(analysis: Analysis) -> list[int]:
    """Rows of D(c) that can be released to remove a self-stress, the largest leverage first.

    Rows of independent deformations are not among them; see `driven_deformations`.
    """
    return _largest(_norms(_rows_of_class(analysis, Class.FIXED)))


def release_set(analysis: Analysis) -> list[int]:
    """Rows of D(c) that remove all self-stresses when all of them are released."""
    return _independent_rows(_rows_of_class(analysis, Class.FIXED))


def driven_deformations(analysis: Analysis) -> Deformations:
    """Independent deformations in a self-stress: driven against a constraint.

    To release one in place of its declaration removes a self-stress.
    """
    rows = _largest(_norms(_rows_of_class(analysis, Class.INDEPENDENT)))
    labels = analysis.raw.row_label[:, rows].T.tolist()
    return [(element - 1, deformation) for element, deformation in labels]


def driven_coordinates(analysis: Analysis) -> Coordinates:
    """Independent coordinates whose declaration can be taken away to remove a self-stress."""
    return _with_reaction(analysis, Class.INDEPENDENT)


def supports(analysis: Analysis) -> Coordinates:
    """Fixed coordinates that can be freed to remove a self-stress."""
    return _with_reaction(analysis, Class.FIXED)


def coordinates(analysis: Analysis) -> list[int]:
    """Columns of D(c) that can be fixed or made independent to remove a motion."""
    return _largest(_norms(_motions(analysis)))


def coordinate_set(analysis: Analysis) -> list[int]:
    """Columns of D(c) that remove all motions when all are fixed or made independent."""
    return _independent_rows(_motions(analysis))


def deformations(analysis: Analysis) -> Deformations:
    """Released deformations that the motions change.

    To hold one, or to make it independent, removes a motion.
    """
    arrays = analysis.data.arrays
    whole = _assembled(analysis)
    motions = _motions(analysis) / column_weights(analysis)[:, None]
    node, axis = analysis.raw.column_label - 1
    velocity = np.zeros((3 * arrays.node_number.size, motions.shape[1]))
    velocity[3 * node + axis] = motions
    size = 6 * arrays.element_number.size
    rates = _norms_of_product(whole.row_of, whole.column_of, whole.value, velocity, size)
    angle = dual_table()[arrays.element_kind] == Dual.MOMENT
    weight = np.where(angle, analysis.characteristic_length, 1.0)
    released = arrays.deformation_class.T == Class.DEPENDENT
    leverage = np.where(released, weight, 0.0).ravel() * rates
    return [(row // 6, row % 6 + 1) for row in _largest(leverage)]


def coordinate_operands(analysis: Analysis, node: int, axis: int) -> str:
    """Number of a node and component of its coordinate, as a deck names them."""
    arrays = analysis.data.arrays
    kind = int(arrays.node_kind[node])
    first = 2 if kind == NodeKind.ORIENTATION else 1  # behind the first Euler parameter
    return f"{arrays.node_number[node]} {AXES[kind].index(axis) + first}"


def _assembled(analysis: Analysis) -> RawAssembly:
    """The whole Jacobian in the reference configuration."""
    model = analysis.model
    return assembled(model, model.reference())


def _motions(analysis: Analysis) -> FloatArray:
    """(n, motions) orthonormal basis of the motions, rotations in lengths."""
    return _orthonormal(column_weights(analysis), analysis.raw.motions.toarray())


def _stresses(analysis: Analysis) -> FloatArray:
    """(m, self-stresses) as `_motions`, moments in forces."""
    return _orthonormal(row_weights(analysis), analysis.raw.stresses.toarray())


def _rows_of_class(analysis: Analysis, wanted: Class) -> FloatArray:
    """`_stresses`, zero where the deformation is of another class."""
    element, deformation = analysis.raw.row_label - 1
    classes = analysis.data.arrays.deformation_class[deformation, element]
    return np.where((classes == wanted)[:, None], _stresses(analysis), 0.0)


def _with_reaction(analysis: Analysis, wanted: Class) -> Coordinates:
    """Coordinates of a class on which the self-stresses act, the largest reaction first."""
    classes = analysis.data.arrays.coordinate_class.T
    if not (classes == wanted).any():
        return []
    reaction = np.where((classes == wanted).ravel(), _reactions(analysis), 0.0)
    return [(place // 3, place % 3) for place in _largest(reaction)]


def _reactions(analysis: Analysis) -> FloatArray:
    """(3 nodes,) reactions to the self-stresses by coordinate, sigma^T D, moments in forces.

    Zero where nothing is left of what the elements contribute.
    """
    arrays = analysis.data.arrays
    whole = _assembled(analysis)
    sigma = _stresses(analysis) / row_weights(analysis)[:, None]
    element, deformation = analysis.raw.row_label - 1
    of_row = np.zeros((6 * arrays.element_number.size, sigma.shape[1]))
    of_row[6 * element + deformation] = sigma
    turned = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)
    weight = 1.0 / np.where(turned, analysis.characteristic_length, 1.0)
    value = whole.value * weight[whole.column_of]
    reaction, contributed = (
        _norms_of_product(whole.column_of, whole.row_of, entries, stresses, turned.size)
        for entries, stresses in ((value, of_row), (np.abs(value), np.abs(of_row)))
    )
    return np.where(reaction > _NOTHING * contributed, reaction, 0.0)


def _norms_of_product(
    row_of: NDArray[np.int32],
    column_of: NDArray[np.int32],
    value: FloatArray,
    basis: FloatArray,
    size: int,
) -> FloatArray:
    """(size,) norms of the rows of a sparse matrix times a basis, vector by vector."""
    total = np.zeros(size)
    for vector in basis.T:
        total += np.bincount(row_of, value * vector[column_of], size) ** 2
    return np.sqrt(total)


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
