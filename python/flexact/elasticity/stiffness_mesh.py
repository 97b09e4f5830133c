# SPDX-License-Identifier: BSD-3-Clause
"""A model with its beams divided, and how its pieces belong to the deck's elements."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core.arrays import FloatArray, IntArray, ModelArrays
from ..core.elements import Class, Dual, NodeKind, dual_table
from ..model.attributes import Appearance
from ..model.data import ModelData
from ..model.properties import Properties
from ..util.cached import cached_property
from ..util.records import Frozen
from .mesh import bending_pairs, spread_misfit


@dataclass(frozen=True, eq=False)
class Mesh(Frozen):
    """A model with its beams divided; the deck's nodes come first, in their order.

    Attributes:
        own: The model as given.
        pieces: (elements,) how many beams stand for each element of it.
        data: The model of the pieces; those of one element are in a row, from p to q.
    """

    own: ModelData
    pieces: IntArray
    data: ModelData

    @classmethod
    def of(cls, own: ModelData, pieces: IntArray) -> Mesh:
        """A model with so many pieces of each element."""
        return cls(own, pieces, own if (pieces == 1).all() else _divided(own, pieces))

    @cached_property
    def first(self) -> IntArray:
        """(elements,) index of the piece at p."""
        made: IntArray = (np.cumsum(self.pieces) - self.pieces).astype(np.int32)
        return made

    @cached_property
    def owner(self) -> IntArray:
        """(pieces,) the element that each is of."""
        made: IntArray = np.repeat(np.arange(self.pieces.size, dtype=np.int32), self.pieces)
        return made

    @property
    def nodes(self) -> int:
        """How many nodes the model as given has."""
        return int(self.own.arrays.node_number.size)

    @property
    def last(self) -> IntArray:
        """(elements,) index of the piece at q."""
        made: IntArray = self.first + self.pieces - 1
        return made

    def misfit(self, own: FloatArray) -> FloatArray:
        """(6, pieces) what is off of each piece where elements are off by (6, elements)."""
        return spread_misfit(own, self.pieces, self.own.arrays.element_kind)

    def stress(self, of_pieces: FloatArray) -> FloatArray:
        """(6, elements) stresses of the deck's elements in their units, from (6, pieces).

        Forces are means along the element; so are torques. Moments are those at its ends. A
        stress that is a moment over a length is over that of the whole element.
        """
        kinds = self.own.arrays.element_kind
        mean = np.add.reduceat(of_pieces, self.first, axis=1) / self.pieces
        made = mean.copy()
        for p, q, there in bending_pairs(kinds):
            made[p] = np.where(there, of_pieces[p, self.first], made[p])
            made[q] = np.where(there, of_pieces[q, self.last], made[q])
        by_length = (dual_table()[kinds] == Dual.MOMENT_OVER_LENGTH).T
        return np.asfortranarray(np.where(by_length, made / self.pieces, made))

    def own_nodes(self, of_nodes: FloatArray) -> FloatArray:
        """What the deck's nodes have of something of all nodes, by the last axis."""
        return np.asfortranarray(of_nodes[..., : self.nodes])


def _divided(own: ModelData, pieces: IntArray) -> ModelData:
    """The model of the pieces."""
    a = own.arrays
    owner: IntArray = np.repeat(np.arange(pieces.size, dtype=np.int32), pieces)
    place = np.arange(owner.size) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    inner: IntArray = np.flatnonzero(place > 0).astype(np.int32)
    many, new = a.node_number.size, inner.size
    turns = NodeKind.ANGLE if own.planar else NodeKind.ORIENTATION
    sits = NodeKind.PLANAR_POSITION if own.planar else NodeKind.POSITION

    ends = a.element_node[:, owner].copy()
    positions, orientations = many + 1 + np.arange(new), many + 1 + new + np.arange(new)
    # A piece that is not the first begins at its own new node; the one before it ends there.
    ends[0, inner], ends[1, inner] = positions, orientations
    ends[2, inner - 1], ends[3, inner - 1] = positions, orientations

    p, q = a.element_node[0, owner[inner]] - 1, a.element_node[2, owner[inner]] - 1
    part = place[inner] / pieces[owner[inner]]
    value = np.zeros((4, many + 2 * new), order="F")
    value[:, :many] = a.node_value
    value[:3, many : many + new] = (1 - part) * a.node_value[:3, p] + part * a.node_value[:3, q]
    if not own.planar:
        value[0, many + new :] = 1.0

    vector = a.element_vector.copy(order="F")
    split = (pieces > 1) & (a.deformation_class[3] != Class.NONE)
    # Where none is given it may depend on the last digit of a direction.
    vector[:, split] = own.frames.frame[split, :, 1].T
    arrays = ModelArrays(
        node_number=np.concatenate([a.node_number, _free_numbers(a.node_number, 2 * new)]),
        node_kind=np.concatenate([a.node_kind, [sits] * new, [turns] * new]).astype(np.int32),
        node_value=value,
        coordinate_class=np.hstack([a.coordinate_class, _free_classes(own.planar, new)]),
        element_number=_element_numbers(a.element_number, owner, inner),
        element_kind=a.element_kind[owner],
        element_node=np.asfortranarray(ends, np.int32),
        element_vector=np.asfortranarray(vector[:, owner]),
        deformation_class=np.asfortranarray(a.deformation_class[:, owner]),
    )
    arrays = arrays._replace(coordinate_class=np.asfortranarray(arrays.coordinate_class))
    names = tuple(own.element_names)
    return replace(
        own,
        arrays=arrays,
        element_names=tuple(names[i] for i in owner.tolist()),
        node_names=(*own.node_names, *("",) * (2 * new)),
        source=None,
        found=own.problems,
        given_appearance=_appearance(own.given_appearance, owner),
        # Of a state the loads of the deck's nodes are what counts.
        loads=None,
        properties=_properties(own.properties, owner, 2 * new),
    )


def _free_numbers(taken: IntArray, count: int) -> IntArray:
    made: IntArray = taken.max(initial=0) + 1 + np.arange(count, dtype=np.int32)
    return made


def _element_numbers(numbers: IntArray, owner: IntArray, inner: IntArray) -> IntArray:
    """The first piece keeps the number of its element."""
    made = numbers[owner].astype(np.int32)
    made[inner] = _free_numbers(numbers, inner.size)
    return made


def _free_classes(planar: bool, new: int) -> IntArray:
    made = np.full((3, 2 * new), Class.DEPENDENT, np.int32)
    if planar:
        made[2, :new] = Class.NONE
        made[:2, new:] = Class.NONE
    return made


def _appearance(given: Appearance | None, owner: IntArray) -> Appearance | None:
    if given is None:
        return None
    return Appearance(*(getattr(given, name)[owner] for name in Appearance.__dataclass_fields__))


def _properties(given: Properties | None, owner: IntArray, new: int) -> Properties | None:
    if given is None:
        return None
    node_mass = np.vstack([given.node_mass, np.full((new, given.node_mass.shape[1]), np.nan)])
    return Properties(given.stiffness[owner], given.mass[owner], node_mass)
