# SPDX-License-Identifier: BSD-3-Clause
"""Which motions or self-stresses of a basis are generic, and which are special.

What no misalignment lifts is generic. Where the generic rank says that fewer remain than no
misalignment lifts to first order, the space that one random misalignment leaves tells more.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base.frozen import Frozen
from ...core.arrays import FloatArray
from .gradients import Gradients

#: What is below this part of the largest is none: differences are good to some 1e-8.
_NOTHING = 1.0e-6
#: Of vectors of unit length, what is beyond a space.
_OUTSIDE = 1.0e-4


class Told(NamedTuple):
    """What is known of the vectors of a basis."""

    is_special: tuple[bool, ...]
    together: tuple[int, ...]
    """Indices of those among which the choice is free."""
    special: int
    """How many of these are special."""


def all_alike(count: int, is_special: bool) -> Told:
    """Where all of them are one or the other."""
    return Told((is_special,) * count, (), 0)


def by_count(count: int, special: int) -> Told:
    """So many of them, nobody knows which: the last ones."""
    labels = tuple(k >= count - special for k in range(count))
    return Told(labels, tuple(range(count)), special)


def told_apart(told: FloatArray, never: FloatArray, generic: int) -> Told:
    """Which of some vectors are special.

    Args:
        told: (d, k) independent vectors of unit length in a null space, by an orthonormal basis.
        never: (d, g) orthonormal, those that nothing lifts.
        generic: How many of the d dimensions are generic, at least g.
    """
    special = told.shape[0] - generic
    beyond = told - never @ (never.T @ told)
    is_lifted = np.linalg.norm(beyond, axis=0) > _OUTSIDE
    chosen: list[int] = []
    rest = beyond.copy()
    # The last first: those that come first are the simpler ones, and rather wanted.
    for k in range(told.shape[1])[::-1]:
        size = float(np.linalg.norm(rest[:, k]))
        if len(chosen) < special and is_lifted[k] and size > _OUTSIDE:
            unit = rest[:, [k]] / size
            rest = rest - unit @ (unit.T @ rest)
            chosen.append(k)
    if len(chosen) < special:
        # What is lifted to a higher order only, and was not looked at.
        return by_count(told.shape[1], special)
    group = tuple(np.flatnonzero(is_lifted).tolist())
    free = len(group) > len(chosen)
    labels = tuple(k in chosen for k in range(told.shape[1]))
    return Told(labels, group if free else (), len(chosen) if free else 0)


class Lifted(Frozen):
    """What misalignments make of the motions and self-stresses of a result.

    Attributes:
        gradients: The derivatives of all pairs.
        motions: (k, g) orthonormal combinations of the motions that nothing lifts.
        stresses: (s, g) likewise.
    """

    def __init__(self, gradients: Gradients, generic_rank: int) -> None:
        """Find both spaces."""
        self.gradients = gradients
        result = gradients.result
        changes = self._changes()
        motions = _kernel(np.moveaxis(changes, 2, 0).reshape(changes.shape[2], -1))
        stresses = _kernel(np.moveaxis(changes, 1, 0).reshape(changes.shape[1], -1))
        of_motions, of_stresses = result.columns - generic_rank, result.rows - generic_rank
        if motions.shape[1] > of_motions or stresses.shape[1] > of_stresses:
            left = gradients.left_over(of_motions, of_stresses)
            if left is not None:
                motions = _within(motions, left[0], of_motions)
                stresses = _within(stresses, left[1], of_stresses)
        self.motions, self.stresses = motions, stresses

    def _changes(self) -> FloatArray:
        """(changes, s, k) by every place, in lengths of the mechanism, and every vector."""
        gradients = self.gradients
        length = gradients.result.characteristic_length
        at_nodes, by_vector = length * gradients.at_nodes(), gradients.by_vector
        shape = (-1, *at_nodes.shape[2:])
        return np.concatenate((at_nodes.reshape(shape), by_vector.reshape(shape)))


def _kernel(rows: FloatArray) -> FloatArray:
    """(d, g) orthonormal: combinations of d rows that vanish."""
    values, vectors = np.linalg.eigh(rows @ rows.T)
    made: FloatArray = vectors[
        :, values <= _NOTHING**2 * max(float(values.max(initial=0.0)), 1e-12)
    ]
    return made


def _within(space: FloatArray, other: FloatArray, most: int) -> FloatArray:
    """(d, most) the part of a space that is nearest to another one."""
    if space.shape[1] <= most:
        return space
    turned = np.linalg.svd(space.T @ other)[0]
    made: FloatArray = space @ turned[:, :most]
    return made
