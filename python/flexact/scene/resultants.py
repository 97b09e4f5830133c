"""A self-stress along the members: normal force, torsion and bending moments.

The moments of a beam are linear between its ends. A rigid link carries a force alone to its far
end q, so its moments fall to zero there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..elements import kind_of
from ..exchange import FloatArray
from ..frozen import Frozen
from ..modes import SelfStress
from .colours import QUANTITIES
from .forms import LINKS, TRUSSES, Form, is_one_of
from .scene import Scene

#: A quantity below this part of the largest one, moments over the length, is rounding.
_NOISE = 1.0e-10


@dataclass(frozen=True, eq=False)
class Resultants(Frozen):
    """Stress resultants of a self-stress; only their ratios have a meaning.

    Attributes:
        members: (k, 4, 2) N [N], T, My and Mz [N m] at both ends of the scene's members, linear
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


def resultants(scene: Scene, stress: SelfStress) -> Resultants:
    """The stress resultants of a self-stress along the members of a scene."""
    return Resultants(
        of_members(scene, stress),
        of_hinges(scene, stress),
        np.isin(scene.members.form, (Form.SHEET, Form.WIRE, Form.BAR)),
        stress.analysis.characteristic_length,
    )


def of_members(scene: Scene, stress: SelfStress) -> FloatArray:
    """(k, 4, 2); see `Resultants`."""
    members = scene.members
    kind = scene.data.arrays.element_kind[members.index]
    force, moment = stress.forces[members.index], stress.moments[members.index]
    made = np.zeros((len(members), 4, 2))
    beam, planar_beam = (kind == kind_of(keyword).number for keyword in ("BEAM", "PLBEAM"))
    straight = beam | planar_beam | is_one_of(kind, TRUSSES)
    made[straight, 0] = force[straight, :1]
    made[beam, 1] = moment[beam, 1:2]
    made[beam, 2] = moment[beam, 2:4]
    made[beam, 3] = moment[beam, 4:6]
    # Planar bending is defined with the other sign.
    made[planar_beam, 3] = -moment[planar_beam, 1:3]
    link = is_one_of(kind, LINKS)
    made[link, 0] = force[link, :1]
    made[link, 2, 0] = -members.length[link] * force[link, 2]
    made[link, 3, 0] = members.length[link] * force[link, 1]
    return made


def of_hinges(scene: Scene, stress: SelfStress) -> FloatArray:
    """(h, 4); see `Resultants`."""
    kind = scene.data.arrays.element_kind[scene.hinges.index]
    moment = stress.moments[scene.hinges.index]
    made = np.zeros((len(scene.hinges), 4))
    spatial = kind == kind_of("HINGE").number
    made[spatial, 1:] = moment[spatial, :3]
    made[~spatial, 3] = moment[~spatial, 0]
    return made
