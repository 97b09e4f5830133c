# SPDX-License-Identifier: BSD-3-Clause
"""Compliance and stiffness of a point, where directions may be held or without any stiffness."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray

#: Below this part of the largest, with rotations times a length, a compliance is none.
_NONE = 1.0e-13
#: Components of unit vectors below this are rounding.
_ROUNDING = 1.0e-9
#: A point rests in a motion without stiffness that moves others by 1 and it by less.
_RESTS = 1.0e-8


class Compliance(NamedTuple):
    """What a point does under unit loads, rotations times a length of the model.

    Attributes:
        finite: (n, n) the compliance but for motions without stiffness.
        loose: (n, l) orthonormal motions of the point without any stiffness.
        scale: (n,) what makes a length of each coordinate.
        is_held: (n,) which are held.
    """

    finite: FloatArray
    loose: FloatArray
    scale: FloatArray
    is_held: BoolArray

    @property
    def matrix(self) -> FloatArray:
        """Compliance in SI units; 0 for what is held, infinite for motions without stiffness."""
        made = self.finite / np.outer(self.scale, self.scale)
        return _with_infinity(made, self.loose @ self.loose.T)

    @property
    def stiffness(self) -> FloatArray:
        """Stiffness in SI units: infinite for what is held, 0 for motions without stiffness."""
        across = _complement(self.loose)
        inner = across.T @ self.finite @ across
        values, vectors = np.linalg.eigh((inner + inner.T) / 2.0)
        none = np.abs(values) <= _NONE * np.abs(values).max(initial=0.0)
        turned = across @ vectors
        some = turned[:, ~none]
        made = (some / values[~none]) @ some.T * np.outer(self.scale, self.scale)
        return _with_infinity(made, turned[:, none] @ turned[:, none].T)


def compliance_at(
    moved: FloatArray, loose: FloatArray, scale: FloatArray, is_held: BoolArray, least: float
) -> Compliance:
    """Of displacements (n, n) under unit loads, and motions without stiffness (n, m).

    Args:
        moved: Displacements and turns.
        loose: Displacements and turns.
        scale: (n,) what makes a length of each.
        is_held: (n,) which are held.
        least: A compliance [m/N] below which all of it is rounding.
    """
    finite = moved * np.outer(scale, scale)
    finite = (finite + finite.T) / 2.0
    finite[is_held] = 0.0
    finite[:, is_held] = 0.0
    if np.abs(finite).max(initial=0.0) < least:
        finite[:] = 0.0
    free = np.where(is_held[:, None], 0.0, loose * scale[:, None])
    return Compliance(finite, _span(free), scale, is_held)


def kept(before: Compliance, after: Compliance) -> FloatArray:
    """All mu of C_before v = mu C_after v, ascending, without held directions.

    A motion that the release leaves without stiffness gives 0; one without stiffness before,
    too, is left out.
    """
    free = ~after.is_held
    scale = before.scale / after.scale
    across = _complement(after.loose[free])
    inner = across.T @ after.finite[np.ix_(free, free)] @ across
    values, vectors = np.linalg.eigh((inner + inner.T) / 2.0)
    some = values > _NONE * np.abs(values).max(initial=0.0)
    root = across @ (vectors[:, some] / np.sqrt(values[some]))
    first = (before.finite * np.outer(1.0 / scale, 1.0 / scale))[np.ix_(free, free)]
    reduced = root.T @ first @ root
    made = np.linalg.eigvalsh((reduced + reduced.T) / 2.0)
    lost = max(after.loose.shape[1] - before.loose.shape[1], 0)
    return np.sort(np.concatenate([np.zeros(lost), np.maximum(made, 0.0)]))


def _span(vectors: FloatArray) -> FloatArray:
    """(n, r) an orthonormal basis of what columns (n, m) span."""
    if not vectors.size:
        return np.zeros((vectors.shape[0], 0))
    left, values, _ = np.linalg.svd(vectors, full_matrices=False)
    made: FloatArray = left[:, values > _RESTS]
    return made


def _complement(basis: FloatArray) -> FloatArray:
    """(n, n - r) an orthonormal basis of what is across another one."""
    left, _, _ = np.linalg.svd(basis, full_matrices=True)
    made: FloatArray = left[:, basis.shape[1] :]
    return made


def _with_infinity(finite: FloatArray, along: FloatArray) -> FloatArray:
    """The matrix with infinity, signed, where a projector has entries."""
    there = np.abs(along) > _ROUNDING
    return np.where(there, np.copysign(np.inf, along), finite)
