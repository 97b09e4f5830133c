# SPDX-License-Identifier: BSD-3-Clause
"""How the mechanism moves in each declared degree of freedom.

A degree of freedom is an independent coordinate or deformation, eq. (6). Its motion is a
velocity of the dependent coordinates that solves eq. (12) with that one independent velocity
equal to one and the others zero. Many are found from one further decomposition, of the D(c)
that is left when none of them is declared: in its null space the independent velocities are
solved for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind, coordinate_name
from ..core.raw import RawAnalysis
from ..model.data import ModelData
from ..util.records import Frozen, cached_property
from .body_motions import Moves, Velocities
from .decomposition import Asked, Decomposition, decompose
from .limits import DEPENDENT_VELOCITIES, NOT_ONE
from .mode_basis import coordinate_key, ranked

#: How many degrees of freedom one further decomposition serves.
_AT_ONCE = 64

#: Whether it is a coordinate; its axis and node, or deformation and element.
_Place = tuple[bool, int, int]


@dataclass(frozen=True, eq=False)
class FreeMotion(Moves, Frozen):
    """The velocities of all nodes in a declared degree of freedom.

    Attributes:
        analysis: The analysis that it belongs to.
        analysed: The velocities of the nodes of the model as it was analysed; its model is
            without this declaration.
        is_natural: Whether it is the one in which what nothing determines bends least.
    """

    analysis: Decomposition
    analysed: Velocities
    is_natural: bool = False


@dataclass(frozen=True, eq=False, repr=False)
class Freedom(Frozen):
    """A declared degree of freedom: an independent coordinate or deformation, eq. (6).

    Attributes:
        analysis: The analysis that it belongs to.
        place: Axis and node, or deformation and element, all from 0.
        is_coordinate: Which of the two.
        block: What finds the motions of some degrees of freedom together.
    """

    analysis: Decomposition
    place: tuple[int, int]
    is_coordinate: bool
    block: Block

    @property
    def owner(self) -> tuple[str, int]:
        """What has it, "node" or "element", and its number."""
        arrays, owner = self.analysis.data.arrays, self.place[1]
        if self.is_coordinate:
            return "node", int(arrays.node_number[owner])
        return "element", int(arrays.element_number[owner])

    @property
    def part(self) -> str:
        """Such as "z" or "e6"."""
        part, owner = self.place
        if self.is_coordinate:
            return coordinate_name(int(self.analysis.data.arrays.node_kind[owner]), part)
        return f"e{part + 1}"

    @cached_property
    def label(self) -> str:
        """Such as "stage z" or "sheet 3 e6": its body, point or part, and which part of it."""
        condensed, parts = self.analysis.condensed, self.analysis.parts
        if not self.is_coordinate:
            name = parts.of_element(int(condensed.elements[self.place[1]])).name
            return f"{name} {self.part}"
        node = int(condensed.nodes[self.place[1]])
        position, body = parts.place_of(node), parts.body_at.get(node)
        name = "" if position is None else parts.name_of_point(position)
        if body is not None and not name:
            name = parts.of_body(body).name
        return f"{name or f'node {self.owner[1]}'} {self.part}"

    @cached_property
    def motion(self) -> FreeMotion | None:
        """Its motion, with a velocity of one; None where the mechanism cannot move so.

        Where motions are left that nothing determines, it is the one with the least part in
        them.

        Raises:
            AnalysisError: the motion cannot be found.
        """
        data = self.analysis.data
        both = self.block.motion((self.is_coordinate, *self.place))
        if both is None:
            return None
        placed = (data.arrays.node_kind <= NodeKind.POSITION)[:, None]
        without = _undeclared(data, [(self.is_coordinate, *self.place)])
        return FreeMotion(
            self.analysis,
            Velocities(without, np.where(placed, both, 0.0), np.where(placed, 0.0, both)),
        )

    def largest(self, k: int = 6) -> list[tuple[int, str, float]]:
        """Node number, coordinate and value [m, rad] of the k largest parts of its motion.

        Rotations are compared with displacements by the characteristic length; empty where
        the mechanism cannot move so.

        Raises:
            AnalysisError: the motion cannot be found.
        """
        if self.motion is None:
            return []
        motion = self.motion.analysed
        arrays, length = self.analysis.data.arrays, self.analysis.characteristic_length
        sizes = (motion.displacement + length * motion.rotation).reshape(-1)
        values = (motion.displacement + motion.rotation).reshape(-1)
        return [
            (
                int(arrays.node_number[place // 3]),
                coordinate_name(int(arrays.node_kind[place // 3]), place % 3),
                float(values[place]),
            )
            for place in ranked(
                sizes, k, lambda place: coordinate_key(self.analysis, *divmod(place, 3))
            )
        ]

    def __repr__(self) -> str:
        """Such as "<Freedom node 1 z>"."""
        return f"<Freedom {self.label}>"


class Block:
    """Some degrees of freedom, and the null space in which none of them is declared."""

    def __init__(self, outcome: Decomposition, places: Sequence[_Place]) -> None:
        """Keep what is asked; it is found when the first motion is asked for."""
        self._outcome = outcome
        self.places = tuple(places)

    @cached_property
    def freed(self) -> RawAnalysis:
        """The decomposition with none of them declared.

        Raises:
            AnalysisError: it cannot be made.
        """
        data = _undeclared(self._outcome.data, self.places)
        return decompose(data, Asked(self._outcome.asked.method))

    @cached_property
    def _rates(self) -> FloatArray:
        """(freedoms, vectors) the independent velocities in each motion of the null space."""
        basis = self.freed.motions
        node, axis = self.freed.column_label - 1
        # From the entries of the basis: as many motions as there may be, kept one by one at all
        # nodes, would take gigabytes.
        of_entry = basis.of_entries()
        rows = (self._row(place)[node, axis] for place in self.places)
        return np.stack(
            [np.bincount(of_entry, row[basis.place] * basis.value, basis.vectors) for row in rows]
        )

    def _row(self, place: _Place) -> FloatArray:
        """(nodes, 3) by which velocities are multiplied to give an independent one."""
        is_coordinate, part, owner = place
        made = np.zeros((self._outcome.data.arrays.node_kind.size, 3))
        if is_coordinate:
            made[owner, part] = 1.0
        else:
            raw = self._outcome.assembly
            mine = raw.row_of == 6 * owner + part
            np.add.at(made.reshape(-1), raw.column_of[mine], raw.value[mine])
        return made

    def motion(self, place: _Place) -> FloatArray | None:
        """(nodes, 3) velocities of all nodes, of displacement and rotation; None without any."""
        rates, wanted = self._rates, np.array([place == other for other in self.places], float)
        size = np.linalg.norm(rates, axis=1)
        if not (size @ wanted > 0.0):
            return None
        scale = 1.0 / np.where(size > 0.0, size, 1.0)
        shares = np.linalg.lstsq(
            scale[:, None] * rates, scale * wanted, rcond=DEPENDENT_VELOCITIES
        )[0]
        if np.abs(scale * (rates @ shares - wanted)).max() > NOT_ONE * (scale @ wanted):
            return None
        basis = self.freed.motions
        node, axis = self.freed.column_label - 1
        both = np.zeros((self._outcome.data.arrays.node_kind.size, 3))
        both[node, axis] = np.bincount(
            basis.place, basis.value * shares[basis.of_entries()], basis.size
        )
        return both


def _undeclared(data: ModelData, places: Sequence[_Place]) -> ModelData:
    """The model in which some freedoms are dependent or released instead of independent."""
    arrays = data.arrays
    coordinates = arrays.coordinate_class.copy(order="F")
    deformations = arrays.deformation_class.copy(order="F")
    for is_coordinate, part, owner in places:
        (coordinates if is_coordinate else deformations)[part, owner] = Class.DEPENDENT
    return ModelData(
        arrays._replace(coordinate_class=coordinates, deformation_class=deformations),
        data.planar,
        data.name,
        data.element_names,
        given_appearance=data.given_appearance,
        has_long_numbers=data.has_long_numbers,
    )


def together(moved: Sequence[tuple[Freedom, float]]) -> FreeMotion | None:
    """The motion in which degrees of freedom of one analysis move at once.

    Args:
        moved: Each with its velocity; at least one.

    Returns:
        None where one of them cannot move.

    Raises:
        AnalysisError: a motion cannot be found.
    """
    motions = [(freedom.motion, velocity) for freedom, velocity in moved]
    found = [(each.analysed, velocity) for each, velocity in motions if each is not None]
    if len(found) < len(motions):
        return None
    outcome = moved[0][0].analysis
    places = [(freedom.is_coordinate, *freedom.place) for freedom, _ in moved]
    displacement, rotation = (
        np.sum([velocity * getattr(each, name) for each, velocity in found], axis=0)
        for name in ("displacement", "rotation")
    )
    return FreeMotion(
        outcome, Velocities(_undeclared(outcome.data, places), displacement, rotation)
    )


def freedoms_of(outcome: Decomposition) -> tuple[Freedom, ...]:
    """The declared degrees of freedom, coordinates first."""
    arrays = outcome.data.arrays
    places: list[_Place] = [
        (is_coordinate, part, owner)
        for classes, is_coordinate in (
            (arrays.coordinate_class, True),
            (arrays.deformation_class, False),
        )
        for owner, part in np.argwhere(classes.T == Class.INDEPENDENT).tolist()
    ]
    firsts = range(0, len(places), _AT_ONCE)
    blocks = (Block(outcome, places[first : first + _AT_ONCE]) for first in firsts)
    return tuple(
        Freedom(outcome, place[1:], place[0], block) for block in blocks for place in block.places
    )
