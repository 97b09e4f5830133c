# SPDX-License-Identifier: BSD-3-Clause
"""What a release costs of stiffness, where that is known.

Self-stresses take part of every load. Released deformations carry nothing, so that the
self-stresses change by what makes their stress zero, and the elastic energy under the load grows
by as much as that stores. Over loads that store, on average, one and the same energy in each
held deformation of its own, it grows by

    tr(G R^-1 K R^-T) - s     with  G = U^T F U,

where U holds the s self-stresses, F the flexibilities of the deformations, R the s rows of U
that are released and K their stiffness; of a single one by the inverse of the share of the energy
of the self-stress that it stores, minus one. What stores most costs least.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...analysis.result import Result
from ...analysis.weights import row_duals
from ...core.arrays import FloatArray
from ...core.elements import Dual, Role, dual_table, role_table
from ...model.parts.parts import PartKind
from .candidates import Places, Reach

#: Stresses below this part of the largest of a self-stress are none.
_NOTHING = 1.0e-7
#: Column of ESTIFF, and of the shear, by role; of planar beams those of `_PLANAR`.
_STIFFNESS: dict[int, int] = {
    Role.ELONGATION: 0,
    Role.TORSION: 1,
    **dict.fromkeys((Role.BENDING_XZ_P, Role.BENDING_XZ_Q), 2),
    **dict.fromkeys((Role.BENDING_XY_P, Role.BENDING_XY_Q), 3),
    **dict.fromkeys((Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q), 1),
}
_SHEAR: dict[int, int] = {
    **dict.fromkeys((Role.BENDING_XZ_P, Role.BENDING_XZ_Q), 4),
    **dict.fromkeys((Role.BENDING_XY_P, Role.BENDING_XY_Q), 5),
    **dict.fromkeys((Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q), 2),
}
_OTHER_END: dict[int, int] = {
    Role.BENDING_XZ_P: Role.BENDING_XZ_Q,
    Role.BENDING_XY_P: Role.BENDING_XY_Q,
    Role.PLANAR_BENDING_P: Role.PLANAR_BENDING_Q,
}
#: Costs below this are equal.
_LEAST = 1.0e-9

Cost = Callable[[Places], FloatArray]


def cost_of(result: Result, reach: Reach) -> Cost | None:
    """The cost of sets of rows, (sets, s) to (sets,), as a logarithm.

    None where the stiffness of what is stressed is not known; rigid bodies are so stiff that to
    release one of them costs more than all else.

    Args:
        result: The result whose rows they are.
        reach: The fixed rows over the self-stresses.
    """
    if result.given.properties is None:
        return None
    space = result.stress_space.toarray()
    moment = row_duals(result) != Dual.FORCE
    stresses = space * np.where(moment, result.characteristic_length, 1.0)[:, None]
    stressed = np.linalg.norm(space, axis=1) > _NOTHING
    flexibility = _flexibility(result, stressed)
    if flexibility is None:
        return None
    energy = stresses.T @ flexibility @ stresses
    if not np.linalg.eigvalsh(energy)[0] > 0.0:
        return None
    is_soft = np.diag(flexibility) > 0.0
    stiffness = np.zeros_like(flexibility)
    stiffness[np.ix_(is_soft, is_soft)] = np.linalg.inv(flexibility[np.ix_(is_soft, is_soft)])
    rows = reach.index

    def cost(sets: Places) -> FloatArray:
        chosen = rows[sets]
        inverse = np.linalg.inv(stresses[chosen])
        blocks = stiffness[chosen[:, :, None], chosen[:, None, :]]
        # Of G R^-1 K R^-T the trace.
        terms = np.einsum("nij,njk,nlk,li->n", inverse, blocks, inverse, energy)
        made = np.log(np.maximum(terms - energy.shape[0], _LEAST))
        return np.where(np.all(is_soft[chosen], axis=1), made, np.inf)

    return cost


def _flexibility(result: Result, stressed: np.ndarray) -> FloatArray | None:
    """(m, m) flexibilities of rows of D(c), [m/N] and [rad/(N m)]; zero of rigid bodies.

    None where that of a stressed row of another part is not known.
    """
    made = np.zeros((stressed.size, stressed.size))
    element, deformation = result.raw.row_label - 1
    kind = result.data.arrays.element_kind[element]
    roles, duals = role_table()[kind, deformation], dual_table()[kind, deformation]
    place = {
        (e, r): k for k, (e, r) in enumerate(zip(element.tolist(), roles.tolist(), strict=True))
    }
    for k in np.flatnonzero(stressed).tolist():
        e, role = int(element[k]), int(roles[k])
        value, shear = _given(result, e, role, int(deformation[k]))
        if value is None:
            if result.parts.of_element(int(result.condensed.elements[e])).kind is PartKind.BODY:
                continue
            return None
        length = float(result.data.frames.length[e])
        if duals[k] != Dual.MOMENT_OVER_LENGTH and role != Role.ELONGATION:
            made[k, k] = 1.0 / value
        elif role not in _SHEAR:
            made[k, k] = length / value
        else:
            phi = 12.0 * shear / length**2
            made[k, k] = length / (12.0 * value) * (4.0 + phi)
            other = place.get((e, _OTHER_END.get(role, -1)))
            if other is not None and stressed[other]:
                made[k, other] = made[other, k] = length / (12.0 * value) * (2.0 - phi)
    return made


def _given(result: Result, element: int, role: int, deformation: int) -> tuple[float | None, float]:
    """Stiffness of a deformation as ESTIFF gives it, and the shear, zero without."""
    assert result.given.properties is not None
    numbers = result.given.properties.stiffness[int(result.condensed.elements[element])]
    value = float(numbers[_STIFFNESS.get(role, deformation)])
    shear = float(numbers[_SHEAR[role]]) if role in _SHEAR else 0.0
    return (value if value > 0.0 else None), (shear if shear > 0.0 else 0.0)
