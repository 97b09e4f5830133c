# SPDX-License-Identifier: BSD-3-Clause
"""A self-stress along the members: normal force, twist moment and the moments of bending.

They are those of `flexact.analysis.resultants`, whose signs depend on geometry alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...analysis.modes import SelfStress
from ...analysis.resultants import QUANTITIES, shared_resultants
from ...core.arrays import FloatArray
from ...model.parts.forms import Form
from ...util.records import Frozen
from .drawing import Drawing

#: A quantity below this part of the largest one, moments over the length, is rounding.
_NOISE = 1.0e-10


@dataclass(frozen=True, eq=False)
class Resultants(Frozen):
    """Stress resultants of a self-stress; only their ratios have a meaning.

    Attributes:
        members: (k, 4, 2) the `QUANTITIES` [N, N m] at both ends of the drawing's members, linear
            between.
        hinges: (h, 4) their sizes in the hinges.
        flexible: (k,) which members are sheets, wires or bars.
        shown: (k,) which members are drawn themselves, and not a body in their place.
        length: The characteristic length [m] by which moments compare with forces.
    """

    members: FloatArray
    hinges: FloatArray
    flexible: np.ndarray
    shown: np.ndarray
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
        """Largest magnitude of a quantity, of members that are shown and of hinges."""
        column, weight = QUANTITIES.index(quantity), self._weight
        sizes = np.abs(self.members[self.shown]).max(axis=(0, 2), initial=0.0)
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
            squares = np.sum(self.members[self.shown] ** 2, axis=(0, 2))
            squares += np.sum(self.hinges**2, axis=0)
        sizes = np.sqrt(squares) * self._weight
        # Of practically equal ones the first.
        return QUANTITIES[int(np.argmax(sizes >= sizes.max() * (1 - 1.0e-9)))]


def resultants(drawing: Drawing, stress: SelfStress) -> Resultants:
    """The stress resultants of a self-stress along the members of a drawing."""
    value = stress.forces + stress.moments
    members, hinges = (
        shared_resultants(drawing.data, index, value[index])
        for index in (drawing.members.index, drawing.hinges.index)
    )
    return Resultants(
        members,
        hinges[..., 0],
        np.isin(drawing.members.form, (Form.SHEET, Form.WIRE, Form.BAR)),
        ~drawing.in_solid,
        stress.analysis.characteristic_length,
    )
