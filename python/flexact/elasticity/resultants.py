# SPDX-License-Identifier: BSD-3-Clause
"""Forces and moments in an element, and the largest stress in its section."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Dual, Member, Role, dual_table, member_table, role_table
from ..model.attributes import CrossSection
from ..model.data import ModelData
from ..util.records import Frozen
from .stiffness_errors import ElasticError

_BENDINGS = {
    # The axis about which it bends (1: y, 2: z), and the end.
    Role.BENDING_XZ_P: (1, 0),
    Role.BENDING_XZ_Q: (1, 1),
    Role.BENDING_XY_P: (2, 0),
    Role.BENDING_XY_Q: (2, 1),
    Role.PLANAR_BENDING_P: (2, 0),
    Role.PLANAR_BENDING_Q: (2, 1),
}


@dataclass(frozen=True, eq=False)
class Resultants(Frozen):
    """What an element carries, in its own axes.

    Attributes:
        normal_force: N [N], positive where it pulls.
        torque: T [N m]; of a hinge the moment about its axis.
        moment_y: (2,) M about y at p and q [N m], in the local xz plane.
        moment_z: (2,) M about z at p and q [N m], in the local xy plane.
        shear_y: [N] along y, the difference of the moments about z over the length.
        shear_z: [N] along z, likewise about y.
    """

    normal_force: float
    torque: float
    moment_y: FloatArray
    moment_z: FloatArray
    shear_y: float
    shear_z: float


def resultants_of(data: ModelData, element: int, stress: FloatArray) -> Resultants:
    """Of an element, by its index, with its stresses (6,)."""
    kind = int(data.arrays.element_kind[element])
    length = float(data.frames.length[element])
    moments = np.zeros((3, 2))
    normal = torque = 0.0
    for k, role in enumerate(role_table()[kind].tolist()):
        lever = length if dual_table()[kind, k] == Dual.MOMENT_OVER_LENGTH else 1.0
        value = float(stress[k]) * lever
        if role in (Role.ELONGATION, Role.OFFSET_X):
            normal = value
        elif role in (Role.TORSION, Role.ROTATION, Role.ANGLE):
            torque = value
        elif role in _BENDINGS:
            moments[_BENDINGS[Role(role)]] = value
    slope = (moments[:, 0] - moments[:, 1]) / length if length > 0.0 else np.zeros(3)
    return Resultants(normal, torque, moments[1], moments[2], float(slope[2]), float(slope[1]))


def peak_stress(data: ModelData, element: int, every: list[Resultants]) -> float:
    """The largest normal stress [Pa] in the pieces of a member with a known section.

    |N|/A + |My| h/2Iy + |Mz| b/2Iz at a corner; of a circle the moments add as vectors.

    Raises:
        ElasticError: it is no member, or its section is not known.
    """
    number = int(data.arrays.element_number[element])
    kind = int(data.arrays.element_kind[element])
    if member_table()[kind] not in (Member.BAR, Member.BEAM):
        raise ElasticError(f"element {number} is neither a bar nor a beam: it has no section")
    shape = int(data.appearance.cross_section[element])
    b, h = (float(size) for size in data.appearance.dimensions[element])
    if shape not in (CrossSection.RECT, CrossSection.CIRC) or not (b > 0.0 and h > 0.0):
        raise ElasticError(
            f"the section of element {number} is not known: give BEAMPROPS with CROSSTYPE RECT or "
            "CIRC and CROSSDIM in the deck's picture block, or a section in Python"
        )
    largest = 0.0
    for each in every:
        my, mz = np.abs(each.moment_y), np.abs(each.moment_z)
        if shape == CrossSection.CIRC:
            area, bending = math.pi * b * b / 4.0, np.hypot(my, mz) * 32.0 / (math.pi * b**3)
        else:
            area, bending = b * h, 6.0 * my / (b * h * h) + 6.0 * mz / (h * b * b)
        largest = max(largest, abs(each.normal_force) / area + float(bending.max()))
    return largest
