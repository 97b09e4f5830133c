# SPDX-License-Identifier: BSD-3-Clause
"""What given misalignments do to a design, with all of the nonlinearity."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Dual, Role, dual_table, role_table
from ..model.data import ModelData
from ..model.parts.parts import Parts
from ..stiffness import Elastic, State
from ..text.places import part_words
from .designs import Effect
from .measuring import Measures, levels, number, numbers, over_levels
from .values import Misalignment, Number, Numbers

#: Roles of what is a force along a member, and a torque; other moments bend.
_NORMAL, _TORQUE = (Role.ELONGATION,), (Role.TORSION,)


def resultants(data: ModelData, state: State) -> FloatArray:
    """(elements, 3) normal force [N], torque and largest bending moment [N m] in size."""
    stress = np.abs(np.asarray(state.stresses, np.float64))
    kinds = data.arrays.element_kind
    roles, duals = role_table()[kinds].T, dual_table()[kinds].T
    length = np.where(duals == Dual.MOMENT_OVER_LENGTH, data.frames.length, 1.0)
    sizes = stress * length
    is_normal, is_torque = np.isin(roles, _NORMAL), np.isin(roles, _TORQUE)
    bends = (duals > Dual.FORCE) & ~is_torque
    return np.stack(
        [np.where(chosen, sizes, 0.0).max(axis=0) for chosen in (is_normal, is_torque, bends)],
        axis=1,
    )
