# SPDX-License-Identifier: BSD-3-Clause
"""D(c) of a deck, its rank beyond doubt, and its null spaces.

Rank is decided on a scaled matrix (rotations times a characteristic length, rows of unit norm). A
deck whose singular values do not fall apart into clearly zero and clearly not zero raises, so that
no doubtful reference value is ever stored.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from oracle_deck import Deck, Label
from oracle_elements import ROTATIONS, Real, derivatives, length, reference_deformations

ZERO = 1e-9
GAP = 1e4


@dataclass(frozen=True)
class Outcome:
    """What the analysis of a deck gives.

    Attributes:
        row_labels: (element, deformation) of the m rows of D(c).
        column_labels: (node, coordinate) of its n columns.
        matrix: D(c), m x n.
        rank: its rank.
        singular_values: of D(c) as it stands, descending.
        motions: orthogonal projector on its null space, n x n.
        self_stresses: orthogonal projector on the null space of its transpose, m x m.
    """

    row_labels: list[Label]
    column_labels: list[Label]
    matrix: Real
    rank: int
    singular_values: Real
    motions: Real
    self_stresses: Real

    @property
    def under_constrained(self) -> int:
        """Number of independent motions that no declared degree of freedom accounts for."""
        return len(self.column_labels) - self.rank

    @property
    def over_constrained(self) -> int:
        """Number of independent states of self-stress."""
        return len(self.row_labels) - self.rank


def jacobian(deck: Deck) -> tuple[list[Label], list[Label], Real]:
    """Row labels, column labels and D(c) itself, equation (11), rows in the order of the deck."""
    rows = [label for label, name in deck.deformations.items() if name != "dependent"]
    columns = [label for label, name in deck.coordinates.items() if name == "dependent"]
    row_of = {label: index for index, label in enumerate(rows)}
    column_of = {label: index for index, label in enumerate(columns)}
    matrix = np.zeros((len(rows), len(columns)))
    for number, element in deck.elements.items():
        rounding = 1e-12 * max(1.0, length(deck, element))
        if np.max(np.abs(reference_deformations(deck, element))) > rounding:
            raise ValueError(f"element {number} is deformed in the reference configuration")
        for coordinate, values in derivatives(deck, element).items():
            for index, value in enumerate(values, start=1):
                label = (number, str(index))
                if label in row_of and coordinate in column_of:
                    matrix[row_of[label], column_of[coordinate]] += value
    return rows, columns, matrix


def scaled(deck: Deck, columns: list[Label], matrix: Real) -> Real:
    """Rotations times the mean length of the elements, then rows to unit norm."""
    lengths = [value for e in deck.elements.values() if (value := length(deck, e)) > 0]
    size = float(np.mean(lengths)) if lengths else 1.0
    factor = np.array([1 / size if axis in ROTATIONS else 1.0 for _, axis in columns])
    result = matrix * factor
    norms = np.linalg.norm(result, axis=1, keepdims=True)
    return np.array(result / np.where(norms > 0, norms, 1.0))


def clear_rank(values: Real, shape: tuple[int, int]) -> int:
    """Rank from singular values (descending) of a matrix of a given shape.

    Raises:
        ValueError: no gap of 1e4 between the smallest that counts and the largest that does not.
    """
    if values.size == 0 or values[0] == 0:
        return 0
    rank = int(np.sum(values > ZERO * values[0]))
    floor = max(shape) * np.finfo(float).eps * values[0]
    largest_zero = max(float(values[rank]) if rank < values.size else 0.0, floor)
    if values[rank - 1] < GAP * largest_zero:
        raise ValueError(f"the rank is in doubt: {values[rank - 1]:.3g} and {largest_zero:.3g}")
    return rank


def projector(basis: Real) -> Real:
    """Orthogonal projector on the space of orthonormal columns."""
    return np.array(basis @ basis.T)


def analyse(deck: Deck) -> Outcome:
    """Rank, singular values and null spaces of D(c).

    Raises:
        ValueError: the rank is in doubt, or depends on the units.
    """
    rows, columns, matrix = jacobian(deck)
    if 0 in matrix.shape:
        left, values, right = np.eye(len(rows)), np.zeros(0), np.eye(len(columns))
        rank = 0
    else:
        fair = np.linalg.svd(scaled(deck, columns, matrix))[1]
        rank = clear_rank(fair, matrix.shape)
        left, values, right = np.linalg.svd(matrix)
        if clear_rank(values, matrix.shape) != rank:
            raise ValueError("the rank depends on the units")
    motions, stresses = projector(right[rank:].T), projector(left[:, rank:])
    products = (matrix @ motions, matrix.T @ stresses)
    residue = max(float(np.max(np.abs(product), initial=0.0)) for product in products)
    if residue > 1e-12 * max(1.0, float(np.max(values, initial=0.0))):
        raise ValueError(f"a null space leaves a residue of {residue:.3g}")
    return Outcome(rows, columns, matrix, rank, values, motions, stresses)
