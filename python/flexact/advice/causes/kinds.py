# SPDX-License-Identifier: BSD-3-Clause
"""Which motions or self-stresses of a basis are generic, and which are special.

What no misalignment lifts is generic. Where the generic rank says that fewer remain than no
misalignment lifts to first order, the space that one random misalignment leaves tells more.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.bodies import groups_of
from ...util.records import Frozen
from .gradients import Gradients

#: What is below this part of the largest is none: differences are good to some 1e-8.
_NOTHING = 1.0e-6
#: Of vectors of unit length, what is beyond a space.
_OUTSIDE = 1.0e-4
_SEED = 20_110_720


class Told(NamedTuple):
    """What is known of a vector of a basis."""

    is_special: bool
    together: tuple[int, ...] = ()
    """Indices of those among which the choice is free; empty where it is not."""
    special: int = 0
    """How many of these are special."""


def all_alike(count: int, is_special: bool) -> list[Told]:
    """Where all of them are one or the other."""
    return [Told(is_special)] * count


def by_count(indices: Sequence[int], special: int) -> dict[int, Told]:
    """So many of some, nobody knows which: the last ones."""
    first = len(indices) - special
    together = tuple(indices)
    return {j: Told(k >= first, together, special) for k, j in enumerate(indices)}


def told_apart(
    told: FloatArray, never: FloatArray, groups: Sequence[tuple[Sequence[int], int]]
) -> list[Told]:
    """Which of some vectors are special.

    Args:
        told: (d, k) independent vectors of unit length in a null space, by an orthonormal basis.
        never: (d, g) orthonormal, those that nothing lifts.
        groups: Of vectors that no misalignment lifts together with others, and how many of
            each group are special; what is in no group is generic.
    """
    beyond = told - never @ (never.T @ told)
    made = all_alike(told.shape[1], False)
    for indices, special in groups:
        for k, found in _of_group(beyond, indices, special).items():
            made[k] = found
    return made


def _of_group(beyond: FloatArray, indices: Sequence[int], special: int) -> dict[int, Told]:
    rest = beyond[:, indices]
    lifted = [k for k in indices if float(np.linalg.norm(beyond[:, k])) > _OUTSIDE]
    chosen: list[int] = []
    # The last first: those that come first are the simpler ones, and rather wanted.
    for place, k in reversed(list(enumerate(indices))):
        size = float(np.linalg.norm(rest[:, place]))
        if len(chosen) < special and k in lifted and size > _OUTSIDE:
            unit = rest[:, [place]] / size
            rest = rest - unit @ (unit.T @ rest)
            chosen.append(k)
    if len(chosen) < special:
        # What is lifted to a higher order only, and was not looked at.
        return by_count(indices, special)
    if len(lifted) == len(chosen):
        return {k: Told(k in chosen) for k in indices}
    together = tuple(lifted)
    return {
        k: Told(k in chosen, together, len(chosen)) if k in lifted else Told(False) for k in indices
    }


class Groups(NamedTuple):
    """What misalignments lift together: which, and how many of them are special."""

    stresses: list[tuple[list[int], int]]
    motions: list[tuple[list[int], int]]


class Lifted(Frozen):
    """What misalignments make of the motions and self-stresses of a result.

    Attributes:
        gradients: The derivatives of all pairs.
        motions: (k, g) orthonormal combinations of the motions that nothing lifts.
        stresses: (s, g) likewise.
        special: How many of either are special.
    """

    def __init__(self, gradients: Gradients, generic_rank: int) -> None:
        """Find both spaces."""
        self.gradients = gradients
        result = gradients.result
        changes = self._lifts = self._changes()
        self.special = generic_rank - result.rank
        motions = _kernel(np.moveaxis(changes, 2, 0).reshape(changes.shape[2], -1))
        stresses = _kernel(np.moveaxis(changes, 1, 0).reshape(changes.shape[1], -1))
        of_motions, of_stresses = result.columns - generic_rank, result.rows - generic_rank
        if motions.shape[1] > of_motions or stresses.shape[1] > of_stresses:
            left = gradients.left_over(of_motions, of_stresses)
            if left is not None:
                motions = _within(motions, left[0], of_motions)
                stresses = _within(stresses, left[1], of_stresses)
        self.motions, self.stresses = motions, stresses

    def couplings(self, stresses: FloatArray, motions: FloatArray) -> FloatArray:
        """(a, b) how much all changes make of self-stresses (s, a) and motions (k, b)."""
        made: FloatArray = np.linalg.norm(self._blocks(stresses, motions), axis=2)
        return made

    def _blocks(self, stresses: FloatArray, motions: FloatArray) -> FloatArray:
        made: FloatArray = np.moveaxis(stresses.T @ self._lifts @ motions, 0, 2)
        return made

    def groups(self, stresses: FloatArray, motions: FloatArray) -> Groups | None:
        """What misalignments lift together, to first order, and how many of each are special.

        Args:
            stresses: (s, a) self-stresses.
            motions: (k, b) motions.

        Returns:
            None where not all that is special is lifted to first order.
        """
        blocks = self._blocks(stresses, motions)
        sizes = np.linalg.norm(blocks, axis=2)
        pairs = np.argwhere(sizes > _NOTHING * max(float(sizes.max(initial=0.0)), 1e-12))
        count = stresses.shape[1]
        owner = groups_of(count + motions.shape[1], ((i, count + j) for i, j in pairs.tolist()))
        weights = np.random.default_rng(_SEED).normal(size=blocks.shape[2])
        mixed = blocks @ weights
        made = []
        for group in np.unique(owner[pairs[:, 0]]).tolist() if len(pairs) else []:
            mine = np.flatnonzero(owner == group)
            rows, columns = mine[mine < count], mine[mine >= count] - count
            values = np.linalg.svd(mixed[np.ix_(rows, columns)], compute_uv=False)
            special = int(np.count_nonzero(values > _NOTHING * values[0]))
            made.append((rows.tolist(), columns.tolist(), special))
        if sum(special for _, _, special in made) != self.special:
            return None
        return Groups(
            [(rows, special) for rows, _, special in made],
            [(columns, special) for _, columns, special in made],
        )

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
