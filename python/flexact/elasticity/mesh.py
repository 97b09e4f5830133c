# SPDX-License-Identifier: BSD-3-Clause
"""Into how many beams each beam of a deck is divided."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Literal

import numpy as np

from ..core.arrays import BoolArray, FloatArray, IntArray, ModelArrays
from ..core.elements import (
    Class,
    Dual,
    Member,
    NodeKind,
    Role,
    dual_table,
    member_table,
    role_table,
)
from ..model.data import Appearance, ModelData
from ..model.parts.chains import Chain
from ..model.parts.forms import AT_P, AT_Q
from ..util.records import Frozen, cached_property
from ..util.text import in_short
from .errors import ElasticError

Beams = int | Literal["auto"]

#: The coarser number of beams a sheet of "auto"; the finer one is twice that.
COARSE = 8
#: More beams a sheet than these are surely a mistake.
_MOST = 1000

#: A beam whose shear, EI/(G A k), is more than this in its length squared stays straight.
_STRAIGHT = 10.0
#: Deformations, from 0, that are stiff or held together, spatial and planar.
_GROUPS = {False: ((0,), (1,), (2, 3), (4, 5)), True: ((0,), (1, 2))}


def beams_given(beams: object) -> Beams:
    """The number of beams a sheet that is asked for.

    Raises:
        TypeError: it is neither a whole number nor "auto".
        ValueError: it is not positive, or far too large.
    """
    if beams == "auto" and isinstance(beams, str):
        return "auto"
    if isinstance(beams, bool) or not isinstance(beams, (int, np.integer)):
        raise TypeError(f'beams must be a whole number or "auto", not {in_short(beams)}')
    if not 1 <= beams <= _MOST:
        raise ElasticError(f"beams must be from 1 to {_MOST}, not {in_short(int(beams))}")
    return int(beams)


def divisible(data: ModelData, stiff: BoolArray, rigid: BoolArray) -> BoolArray:
    """Which elements are flexible beams whose pieces stay together, (elements,).

    Each deformation must have a stiffness or be rigid all along, and a bending must be elastic:
    else the nodes between the pieces could move without any stiffness.

    Args:
        data: The model as given.
        stiff: (6, elements) which deformations have a stiffness of their own.
        rigid: (6, elements) which are rigid.
    """
    arrays = data.arrays
    found = member_table()[arrays.element_kind] == Member.BEAM
    planar = arrays.deformation_class[3] == Class.NONE
    for is_planar, groups in _GROUPS.items():
        fits, bends = np.ones(found.shape, np.bool_), np.zeros(found.shape, np.bool_)
        for group in map(list, groups):
            is_stiff, is_rigid = stiff[group].all(axis=0), rigid[group].all(axis=0)
            fits &= is_stiff | is_rigid
            if len(group) == 2:
                bends |= is_stiff & ~is_rigid
        found &= (planar != is_planar) | (fits & bends)
    return np.asarray(found & (data.frames.length > 0.0) & ~stays_straight(data))


def stays_straight(data: ModelData) -> BoolArray:
    """Which beams shear far more than they bend, (elements,), as do the halves of a notch.

    Pieces of them tell nothing new, and they have no stress that says anything.
    """
    if data.properties is None:
        return np.zeros(data.arrays.element_kind.shape, np.bool_)
    numbers = data.properties.stiffness
    planar = data.arrays.deformation_class[3] == Class.NONE
    shear = np.where(planar, numbers[:, 2], np.fmin(numbers[:, 4], numbers[:, 5]))
    found = member_table()[data.arrays.element_kind] == Member.BEAM
    return np.asarray(found & (shear > _STRAIGHT * data.frames.length**2))


def divisions(data: ModelData, beams: Beams, which: BoolArray) -> tuple[IntArray, ...]:
    """(elements,) pieces of each element, of one mesh or of "auto" of two, the coarser first.

    A sheet that the deck divides into k beams counts as k of them.
    """
    there = np.ones(which.shape, np.int32)
    if beams == 1:
        return (there,)
    for chain in data.chains:
        rows = list(_uniform_rows(data, chain))
        # Of a tapered sheet no two beams are alike: many of them are a mesh already.
        for row in [list(chain.elements)] if len(rows) >= COARSE else rows:
            there[row] = len(row)
    wanted = COARSE if beams == "auto" else beams
    pieces = np.where(which, -(-wanted // there), 1).astype(np.int32)
    if beams != "auto" or not which.any():
        return (pieces,)
    return pieces, np.where(which, 2 * pieces, 1).astype(np.int32)


def _uniform_rows(data: ModelData, chain: Chain) -> Iterator[list[int]]:
    """Elements of a sheet that the deck divides; others begin where `ESTIFF` or `EM` change."""
    said = data.properties
    row = [chain.elements[0]]
    for element in chain.elements[1:]:
        if said is not None and not all(
            np.array_equal(numbers[element], numbers[row[-1]], equal_nan=True)
            for numbers in (said.stiffness, said.mass)
        ):
            yield row
            row = []
        row.append(element)
    yield row


def bending_pairs(kinds: IntArray) -> tuple[tuple[int, int, BoolArray], ...]:
    """Deformations p and q, from 0, that bend about one axis, and (elements,) where they do."""
    return tuple((p, q, bends[kinds]) for p, q, bends in _bending_kinds())


@cache
def _bending_kinds() -> tuple[tuple[int, int, BoolArray], ...]:
    """The same by kind of element."""
    roles = role_table().T
    return tuple(
        (p, q, np.asarray(np.isin(roles[p], list(AT_P)) & np.isin(roles[q], list(AT_Q))))
        for p, q in ((2, 3), (4, 5), (1, 2))
    )


def _shape(x: FloatArray, p: FloatArray, q: FloatArray) -> FloatArray:
    """The cubic that is 0 at 0 and 1 with these slopes there."""
    return np.asarray(p * (x - 2 * x**2 + x**3) + q * (x**3 - x**2))


def _slope(x: FloatArray, p: FloatArray, q: FloatArray) -> FloatArray:
    return np.asarray(p * (1 - 4 * x + 3 * x**2) + q * (3 * x**2 - 2 * x))


@dataclass(frozen=True, eq=False)
class Mesh(Frozen):
    """A model with its beams divided; the deck's nodes come first, in their order.

    Attributes:
        own: The model as given.
        pieces: (elements,) how many beams stand for each element of it.
    """

    own: ModelData
    pieces: IntArray

    @cached_property
    def data(self) -> ModelData:
        """The model of the pieces; those of one element are in a row, from p to q."""
        return self.own if (self.pieces == 1).all() else _divided(self)

    @cached_property
    def first(self) -> IntArray:
        """(elements,) index of the piece at p."""
        return np.asarray(np.cumsum(self.pieces) - self.pieces, np.int32)

    @cached_property
    def owner(self) -> IntArray:
        """(pieces,) the element that each is of."""
        return np.repeat(np.arange(self.pieces.size, dtype=np.int32), self.pieces)

    @property
    def nodes(self) -> int:
        """How many nodes the model as given has."""
        return int(self.own.arrays.node_number.size)

    @property
    def last(self) -> IntArray:
        """(elements,) index of the piece at q."""
        return np.asarray(self.first + self.pieces - 1)

    @property
    def place(self) -> IntArray:
        """(pieces,) which of its element's pieces each is, from 0 at p."""
        return np.arange(self.owner.size) - self.first[self.owner]

    @property
    def ends(self) -> tuple[BoolArray, BoolArray]:
        """(pieces,) which are at p of their element, and which are at q."""
        return self.place == 0, self.place == self.pieces[self.owner] - 1

    def rigid(self, own: BoolArray) -> BoolArray:
        """(6, pieces) which deformations of the pieces are rigid, of those of elements.

        A bending that is rigid at both ends is so all along; at one end alone it is that of the
        end piece.
        """
        made = own[:, self.owner]
        is_first, is_last = self.ends
        for p, q, bends in bending_pairs(self.own.arrays.element_kind):
            one = bends[self.owner] & (made[p] != made[q])
            made[p] &= ~one | is_first
            made[q] &= ~one | is_last
        return made

    def misfit(self, own: FloatArray) -> FloatArray:
        """(6, pieces) what the pieces are made off where the elements are, (6, elements).

        A length is shared out; a twist too, where e2 is a length times an angle; a bending is
        that of the cubic with these slopes at its ends.
        """
        owner, kinds = self.owner, self.own.arrays.element_kind
        count = self.pieces[owner].astype(np.float64)
        made = own[:, owner].copy()
        made[0] /= count
        twists = (role_table()[kinds][:, 1] == Role.TORSION)[owner]
        made[1] = np.where(twists, made[1] / count**2, made[1])
        low, high = self.place / count, (self.place + 1) / count
        for p, q, there in bending_pairs(kinds):
            at_p, at_q = own[p][owner], -own[q][owner]
            chord = count * (_shape(high, at_p, at_q) - _shape(low, at_p, at_q))
            fits = there[owner]
            made[p] = np.where(fits, (_slope(low, at_p, at_q) - chord) / count, made[p])
            made[q] = np.where(fits, -(_slope(high, at_p, at_q) - chord) / count, made[q])
        return np.asfortranarray(made)

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


def _divided(mesh: Mesh) -> ModelData:
    """The model of the pieces."""
    own, pieces, owner, place = mesh.own, mesh.pieces, mesh.owner, mesh.place
    a = own.arrays
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
    free = np.full((3, 2 * new), Class.DEPENDENT, np.int32)
    if own.planar:
        free[2, :new] = free[:2, new:] = Class.NONE
    # The first piece keeps the number of its element.
    number = a.element_number[owner].astype(np.int32)
    number[inner] = a.element_number.max(initial=0) + 1 + np.arange(new, dtype=np.int32)
    node_number = a.node_number.max(initial=0) + 1 + np.arange(2 * new, dtype=np.int32)
    arrays = ModelArrays(
        node_number=np.concatenate([a.node_number, node_number]),
        node_kind=np.concatenate([a.node_kind, [sits] * new, [turns] * new]).astype(np.int32),
        node_value=value,
        coordinate_class=np.asfortranarray(np.hstack([a.coordinate_class, free])),
        element_number=number,
        element_kind=a.element_kind[owner],
        element_node=np.asfortranarray(ends, np.int32),
        element_vector=np.asfortranarray(vector[:, owner]),
        deformation_class=np.asfortranarray(a.deformation_class[:, owner]),
    )
    names = own.element_names
    look, given = own.given_appearance, own.properties
    if look is not None:
        look = Appearance(*(getattr(look, name)[owner] for name in Appearance.__dataclass_fields__))
    if given is not None:
        given = given.of_elements(owner, 2 * new)
    return replace(
        own,
        arrays=arrays,
        element_names=tuple(names[i] for i in owner.tolist()),
        node_names=(*own.node_names, *("",) * (2 * new)),
        source=None,
        found=own.problems,
        given_appearance=look,
        # Of a state the loads of the deck's nodes are what counts.
        loads=None,
        properties=given,
    )
