"""How the mechanism moves in each declared degree of freedom.

A degree of freedom is an independent coordinate or deformation, eq. (6). Its motion is a
velocity of the dependent coordinates that solves eq. (12) with that one independent velocity
equal to one and the others zero. It is found as what becomes indeterminate when the one is
no longer declared: in the null space of the D(c) that this leaves.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .elements import Class, NodeKind, coordinate_name
from .exchange import FloatArray
from .frozen import Frozen
from .model import Model
from .model_data import ModelData

if TYPE_CHECKING:
    from .analysis import Analysis


@dataclass(frozen=True, eq=False)
class FreeMotion(Frozen):
    """The velocities of all nodes in a declared degree of freedom.

    Attributes:
        data: The model without this declaration.
        displacement: (nodes, 3) of each position [m]; zero rows for orientations.
        rotation: (nodes, 3) of each orientation [rad]; zero rows for positions.
    """

    data: ModelData
    displacement: FloatArray
    rotation: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class Freedom(Frozen):
    """A declared degree of freedom: an independent coordinate or deformation, eq. (6).

    Attributes:
        analysis: The analysis that it belongs to.
        place: Axis and node, or deformation and element, all from 0.
        is_coordinate: Which of the two.
    """

    analysis: Analysis
    place: tuple[int, int]
    is_coordinate: bool

    @property
    def label(self) -> str:
        """Such as "node 1 z" or "element 3 e6"."""
        arrays = self.analysis.data.arrays
        part, owner = self.place
        if self.is_coordinate:
            name = coordinate_name(int(arrays.node_kind[owner]), part)
            return f"node {arrays.node_number[owner]} {name}"
        return f"element {arrays.element_number[owner]} e{part + 1}"

    @cached_property
    def motion(self) -> FreeMotion | None:
        """Its motion, with a velocity of one; None where the mechanism cannot move so.

        Where motions are left that nothing determines, it is the one with the least part in
        them.
        """
        from .analysis import analyse

        data = self._undeclared()
        freed = analyse(Model.from_data(data), method=self.analysis.asked.method)
        if freed.under_constrained <= self.analysis.under_constrained:
            return None
        # From the entries of the basis: as many motions as there may be, kept one by one at all
        # nodes, would take gigabytes.
        basis = freed.raw.motions
        node, axis = freed.raw.column_label - 1
        of_entry = basis.of_entries()
        rated = self._row(data)[node, axis][basis.place] * basis.value
        rates = np.bincount(of_entry, rated, basis.vectors)
        square = float(rates @ rates)
        if not square > 0.0:
            return None
        shares = rates / square
        both = np.zeros((data.arrays.node_kind.size, 3))
        both[node, axis] = np.bincount(basis.place, basis.value * shares[of_entry], basis.size)
        placed = (data.arrays.node_kind <= NodeKind.POSITION)[:, None]
        return FreeMotion(data, np.where(placed, both, 0.0), np.where(placed, 0.0, both))

    def _row(self, data: ModelData) -> FloatArray:
        """(nodes, 3) by which velocities are multiplied to give its own."""
        part, owner = self.place
        made = np.zeros((data.arrays.node_kind.size, 3))
        if self.is_coordinate:
            made[owner, part] = 1.0
        else:
            raw = self.analysis.assembly
            mine = raw.row_of == 6 * owner + part
            np.add.at(made.reshape(-1), raw.column_of[mine], raw.value[mine])
        return made

    def _undeclared(self) -> ModelData:
        """The model in which it is dependent or released instead of independent."""
        data = self.analysis.data
        field = "coordinate_class" if self.is_coordinate else "deformation_class"
        classes = getattr(data.arrays, field).copy(order="F")
        classes[self.place] = Class.DEPENDENT
        return ModelData(
            data.arrays._replace(**{field: classes}),
            data.planar,
            data.name,
            data.element_names,
            given_look=data.given_look,
        )


def freedoms_of(analysis: Analysis) -> tuple[Freedom, ...]:
    """The declared degrees of freedom, coordinates first."""
    arrays = analysis.data.arrays
    found = []
    for classes, is_coordinate in (
        (arrays.coordinate_class, True),
        (arrays.deformation_class, False),
    ):
        owner, part = np.nonzero(classes.T == Class.INDEPENDENT)
        places = zip(part.tolist(), owner.tolist(), strict=True)
        found += [Freedom(analysis, place, is_coordinate) for place in places]
    return tuple(found)
