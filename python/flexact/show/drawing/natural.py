# SPDX-License-Identifier: BSD-3-Clause
"""Declared degrees of freedom in their natural shape: where what is free bends least.

Beside a declared degree of freedom there may be motions that nothing determines, such as the turn
of a wire's end that no part holds. Of all velocities v0 + N z of that degree of freedom, with such
motions as the columns of N, the one is drawn that minimises e'K e, with the rates e = D v of the
released deformations (`docs/theory.md`, natural shape). What stores nothing keeps the part that v0
has in it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...analysis.decomposition import Outcome
from ...analysis.freedoms import FreeMotion
from ...analysis.velocities import Velocities
from ...core.arrays import FloatArray
from ...core.elements import Class, NodeKind, Role, role_table
from ...model.data import ModelData

#: More motions that nothing determines are not looked at together.
_MOST = 200
#: Stiffness below this part of the largest is none; changes below it are none.
_NOTHING = 1.0e-10
#: The column of ESTIFF that stiffens a deformation, by its role in a beam or a bar.
_COLUMN = {
    Role.ELONGATION: 0,
    Role.TORSION: 1,
    Role.BENDING_XZ_P: 2,
    Role.BENDING_XZ_Q: 2,
    Role.BENDING_XY_P: 3,
    Role.BENDING_XY_Q: 3,
    Role.PLANAR_BENDING_P: 1,
    Role.PLANAR_BENDING_Q: 1,
}
#: Bending at both ends of a beam, which are stiff together: 4, -2; -2, 4.
_PAIRS = (
    (Role.BENDING_XZ_P, Role.BENDING_XZ_Q),
    (Role.BENDING_XY_P, Role.BENDING_XY_Q),
    (Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q),
)
_JOINTS = {Role.ROTATION: 0, Role.ANGLE: 0, Role.TILT_Y: 1, Role.TILT_Z: 2}


class Natural(FreeMotion):
    """The motion of a degree of freedom in which what nothing determines bends least."""


def natural_shape(outcome: Outcome, motion: FreeMotion) -> FreeMotion:
    """A motion of a degree of freedom with the least bending of what is free.

    It is the motion itself where everything is determined, or bends least as it is.
    """
    motions = getattr(outcome, "motions", ())
    if not 0 < len(motions) <= _MOST:
        return motion
    data, length = motion.analysed.data, outcome.characteristic_length
    given = motion.analysed
    free = np.array([_both(each.analysed) for each in motions])
    start = _both(given)
    weight = np.where(_placed(data)[:, None], 1.0, length)
    # Orthonormal in lengths, so that what stores nothing is told apart from what does.
    basis = np.linalg.qr((free * weight).reshape(len(free), -1).T)[0].T.reshape(free.shape) / weight
    rates = np.array([_rates(outcome, each) for each in (*basis, start)])
    stiff = np.array([_stress(outcome, each) for each in rates])
    energy = stiff.reshape(len(stiff), -1) @ rates.reshape(len(rates), -1).T
    # Stiffness of any size may be given.
    if not np.isfinite(energy).all():
        return motion
    inner, outer = energy[:-1, :-1], energy[:-1, -1]
    shares = np.linalg.lstsq((inner + inner.T) / 2, -outer, rcond=_NOTHING)[0]
    if np.linalg.norm(shares) <= _NOTHING * np.linalg.norm(start * weight):
        return motion
    made = start + np.einsum("k,knx->nx", shares, basis)
    placed = _placed(data)[:, None]
    velocities = Velocities(data, np.where(placed, made, 0.0), np.where(placed, 0.0, made))
    return Natural(**{**vars(replace(motion)), "analysed": velocities})


def _placed(data: ModelData) -> np.ndarray:
    return np.asarray(data.arrays.node_kind <= NodeKind.POSITION)


def _both(velocities: Velocities) -> FloatArray:
    return velocities.displacement + velocities.rotation


def _rates(outcome: Outcome, velocity: FloatArray) -> FloatArray:
    """(elements, 6) of the deformations that are released; the others are 0."""
    raw, arrays = outcome.assembly, outcome.data.arrays
    count = arrays.element_number.size
    made = np.bincount(
        raw.row_of, raw.value * velocity.reshape(-1)[raw.column_of], minlength=6 * count
    ).reshape(count, 6)
    return np.where(arrays.deformation_class.T == Class.DEPENDENT, made, 0.0)


def _stiffness(outcome: Outcome) -> FloatArray | None:
    """(elements, 6) of ESTIFF, where every element with released deformations has it.

    What is not given is 0: rigid bodies have no stiffness, and no rates that it would multiply.
    """
    condensed, arrays = outcome.condensed, outcome.data.arrays
    if condensed.given.properties is None:
        return None
    made = np.nan_to_num(condensed.given.properties.stiffness[condensed.elements])
    released = np.any(arrays.deformation_class == Class.DEPENDENT, axis=0)
    return made if np.all(made[released].any(axis=1)) else None


def _stress(outcome: Outcome, rates: FloatArray) -> FloatArray:
    """(elements, 6) K e; deformations of beams are lengths, their length times an angle."""
    data = outcome.data
    role, length = role_table()[data.arrays.element_kind], data.frames.length
    size = np.where(length > 0.0, length, 1.0)
    given = _stiffness(outcome)
    made = np.zeros_like(rates)
    for each, column in {**_COLUMN, **_JOINTS}.items():
        rows, places = np.nonzero(role == each)
        joint = each in _JOINTS
        stiff = np.ones(rows.size) if given is None else given[rows, column]
        power = 0 if joint else (2 if given is None else (1 if each == Role.ELONGATION else 3))
        made[rows, places] = stiff / size[rows] ** power * rates[rows, places]
    for first, second in _PAIRS:
        rows, p = np.nonzero(role == first)
        _, q = np.nonzero(role[rows] == second)
        one, other = made[rows, p].copy(), made[rows, q].copy()
        made[rows, p], made[rows, q] = 4 * one - 2 * other, 4 * other - 2 * one
    return made
