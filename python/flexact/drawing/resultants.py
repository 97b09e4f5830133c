# SPDX-License-Identifier: BSD-3-Clause
"""A self-stress along the members: normal force, torsion and bending moments.

The moments of a beam are linear between its ends. A rigid link carries a force alone to its far
end q, so its moments fall to zero there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.frozen import Frozen
from ..core.arrays import FloatArray
from ..core.elements import Role, role_table
from ..model.parts.forms import Form
from ..result.modes import SelfStress
from .colours import QUANTITIES
from .drawing import Drawing

#: A quantity below this part of the largest one, moments over the length, is rounding.
_NOISE = 1.0e-10

#: What a deformation's force or moment is along a member: quantity, end (0 at p, 1 at q) and
#: factor. Planar bending is defined with the other sign.
_AT_ENDS: dict[int, tuple[tuple[str, int, float], ...]] = {
    Role.ELONGATION: (("N", 0, 1.0), ("N", 1, 1.0)),
    Role.TORSION: (("T", 0, 1.0), ("T", 1, 1.0)),
    Role.BENDING_XZ_P: (("My", 0, 1.0),),
    Role.BENDING_XZ_Q: (("My", 1, 1.0),),
    Role.BENDING_XY_P: (("Mz", 0, 1.0),),
    Role.BENDING_XY_Q: (("Mz", 1, 1.0),),
    Role.PLANAR_BENDING_P: (("Mz", 0, -1.0),),
    Role.PLANAR_BENDING_Q: (("Mz", 1, -1.0),),
    Role.OFFSET_X: (("N", 0, 1.0), ("N", 1, 1.0)),
    Role.OFFSET_Y: (("Mz", 0, 1.0),),
    Role.OFFSET_Z: (("My", 0, -1.0),),
}
#: Forces at q across a link, which bend it by their arm to p.
_WITH_ARM = (Role.OFFSET_Y, Role.OFFSET_Z)
#: Likewise of a joint.
_OF_JOINTS: dict[int, str] = {
    Role.OFFSET_X: "N",
    Role.ROTATION: "T",
    Role.TILT_Y: "My",
    Role.TILT_Z: "Mz",
    Role.ANGLE: "Mz",
}


@dataclass(frozen=True, eq=False)
class Resultants(Frozen):
    """Stress resultants of a self-stress; only their ratios have a meaning.

    Attributes:
        members: (k, 4, 2) N [N], T, My and Mz [N m] at both ends of the drawing's members, linear
            between. N is positive in tension. My acts in the local xz plane (deformations 3
            and 4 of a beam), Mz in the local xy plane (5 and 6).
        hinges: (h, 4) likewise of the hinges: T about the axis, My and Mz across it.
        flexible: (k,) which members are sheets, wires or bars.
        length: The characteristic length [m] by which moments compare with forces.
    """

    members: FloatArray
    hinges: FloatArray
    flexible: np.ndarray
    length: float

    def __getitem__(self, quantity: str) -> FloatArray:
        """(k, 2) one of `QUANTITIES` at both ends of the members."""
        return np.asarray(self.members[:, QUANTITIES.index(quantity)])

    @property
    def _weight(self) -> FloatArray:
        """(4,) what makes the quantities comparable with forces."""
        return np.array([1.0, *[1.0 / self.length] * 3])

    def along(self, quantity: str, member: np.ndarray, at: FloatArray) -> FloatArray:
        """(rows, s) a quantity at stations (s,) of some members (rows,)."""
        ends = self[quantity][member]
        made: FloatArray = ends[:, :1] * (1 - at) + ends[:, 1:] * at
        made[:, at == 1.0] = ends[:, 1:]
        return made

    def largest(self, quantity: str) -> float:
        """Largest magnitude of a quantity, of members and hinges."""
        column, weight = QUANTITIES.index(quantity), self._weight
        sizes = np.abs(self.members).max(axis=(0, 2), initial=0.0)
        sizes = np.maximum(sizes, np.abs(self.hinges).max(axis=0, initial=0.0))
        # Rounding errors are no stress.
        noise = sizes[column] * weight[column] <= _NOISE * (sizes * weight).max()
        return 0.0 if noise else float(sizes[column])

    @property
    def dominant(self) -> str:
        """The quantity that is largest on the whole, moments over the characteristic length.

        By the root of the sum of squares, and of sheets, wires and bars as long as they carry
        anything: the stress in rigid bodies is what theirs asks for.
        """
        squares = np.sum(self.members[self.flexible] ** 2, axis=(0, 2))
        if not squares.any():
            squares = np.sum(self.members**2, axis=(0, 2)) + np.sum(self.hinges**2, axis=0)
        sizes = np.sqrt(squares) * self._weight
        # Of practically equal ones the first.
        return QUANTITIES[int(np.argmax(sizes >= sizes.max() * (1 - 1.0e-9)))]


def resultants(drawing: Drawing, stress: SelfStress) -> Resultants:
    """The stress resultants of a self-stress along the members of a drawing."""
    return Resultants(
        of_members(drawing, stress),
        of_hinges(drawing, stress),
        np.isin(drawing.members.form, (Form.SHEET, Form.WIRE, Form.BAR)),
        stress.analysis.characteristic_length,
    )


def of_members(drawing: Drawing, stress: SelfStress) -> FloatArray:
    """(k, 4, 2); see `Resultants`."""
    members = drawing.members
    kind = drawing.data.arrays.element_kind[members.index]
    value = (stress.forces + stress.moments)[members.index]
    made = np.zeros((len(members), 4, 2))
    for deformation, role in enumerate(role_table()[kind].T):
        for each in np.unique(role).tolist():
            chosen = role == each
            for quantity, end, factor in _AT_ENDS.get(each, ()):
                part = factor * value[chosen, deformation]
                arm = members.length[chosen] if each in _WITH_ARM else 1.0
                made[chosen, QUANTITIES.index(quantity), end] += arm * part
    return made


def of_hinges(drawing: Drawing, stress: SelfStress) -> FloatArray:
    """(h, 4); see `Resultants`."""
    kind = drawing.data.arrays.element_kind[drawing.hinges.index]
    value = (stress.forces + stress.moments)[drawing.hinges.index]
    made = np.zeros((len(drawing.hinges), 4))
    for deformation, role in enumerate(role_table()[kind].T):
        for each, quantity in _OF_JOINTS.items():
            chosen = role == each
            made[chosen, QUANTITIES.index(quantity)] += value[chosen, deformation]
    return made
