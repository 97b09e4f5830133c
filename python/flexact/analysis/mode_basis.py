# SPDX-License-Identifier: BSD-3-Clause
"""The basis in which motions and self-stresses are told: sparse over parts, largest entry one.

It follows from names and places alone, not from numbers, ends p and q, or the sense of a width.
Motions: as few bodies as can be, then joints, then folds, then insides of sheets and wires; of
those of one set of bodies the translations first, then the rotations across them, about as few
axes as can be.
Self-stresses: as few flexible parts as can be; of those of one set as few deformations.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Sequence
from functools import cache, partial
from typing import Any

import numpy as np

from ..core.arrays import Basis, BoolArray, FloatArray, IndexArray, IntArray
from ..core.elements import NodeKind, Role, role_table
from ..model.parts.forms import AT_P, AT_Q, LOCAL_AXIS
from ..model.parts.parts import Part, PartKind, natural
from ..util.groups import grouped
from ..util.matrices import complement, null_space
from .decomposition import Decomposition, column_weights, row_factors, row_weights
from .limits import NO_SENSE, ROUNDING, SAME_PLACE
from .sparse_basis import (
    MOST_DIMENSIONS,
    Cost,
    Groups,
    Piece,
    classes_of_rows,
    columns_of,
    index_of,
    pieces_of,
    support_of,
)

#: Bendings of both ends and planes together, behind elongation and torsion.
_BENDING = int(Role.BENDING_XZ_P)
#: Of values of practically one size, no more than so many are put in order.
_MOST_KEYS = 5_000


def ranked(weighted: FloatArray, most: int, key: Callable[[int], Any] | None = None) -> list[int]:
    """Indices of the largest entries, the largest first.

    Args:
        weighted: (n,) values of any sign.
        most: How many at most; entries below 1e-9 of the largest are none.
        key: Of an index, by which entries of practically one size are sorted; by default the
            index itself.
    """
    size = np.abs(weighted)
    largest = size.max(initial=0.0)
    if not largest > 0.0:
        return []
    rounded = np.round(size / largest, 9)
    least = np.partition(rounded, -most)[-most] if 0 < most < size.size else 0.0
    able = np.flatnonzero((rounded > ROUNDING) & (rounded >= least))
    order = able[np.argsort(-rounded[able], kind="stable")].tolist()
    if key is not None and len(order) <= _MOST_KEYS:
        order.sort(key=lambda i: (-rounded[i], key(i)))
    chosen: list[int] = order[:most]
    return chosen


def row_key(outcome: Decomposition, row: int, *, numbered: bool = True) -> Any:
    """By what a row of D(c) is sorted among equals: flexures first, part, what deforms, where.

    Parts without a name go by the number that they are called by, or by place alone.
    """
    element, deformation = (outcome.raw.row_label[:, row] - 1).tolist()
    return deformation_key(outcome, element, deformation, numbered=numbered)


def deformation_key(
    outcome: Decomposition, element: int, deformation: int, *, numbered: bool = True
) -> Any:
    """The same of a deformation, from 0, of an element, by its index in `outcome.data`."""
    data, given = outcome.data, int(outcome.condensed.elements[element])
    role = int(role_table()[data.arrays.element_kind[element], deformation])
    part = outcome.parts.of_element(given)
    axis = LOCAL_AXIS.get(role, 0)
    bends = role in AT_P or role in AT_Q
    wide = int(outcome.parts.wide[given])
    # A sheet's local z is in its plane where the bending about local y is held.
    of_sheet = 0 if not wide or not axis else 1 + (wide == axis)
    direction: tuple[float, ...] = ()
    if axis and not wide:
        # Without sense, and rounded.
        along = without_sense(data.frames.frame[element][:, axis])
        direction = tuple((np.round(along, 6) + 0.0).tolist())
    p, q = (data.arrays.element_node[[0, 2], element] - 1).tolist()
    nodes = [p] if role in AT_P else [q] if role in AT_Q else [p, q]
    places = [data.arrays.node_value[:3, node] for node in nodes if node >= 0]
    place = _place(outcome, np.mean(places, axis=0)) if places else ()
    kind = _BENDING if bends else role
    is_body = part.kind is PartKind.BODY
    end: Any = ()
    if bends:
        # What is there: ground before others, then by name, however the mechanism is turned.
        there = int(outcome.condensed.nodes[nodes[0]])
        end = not outcome.parts.is_held(there), natural(outcome.parts.name_of_point(there))
    return is_body, natural(_name(part, numbered)), kind, of_sheet, direction, end, place


def column_key(outcome: Decomposition, column: int, *, numbered: bool = True) -> Any:
    """By what a column of D(c) is sorted among equals: displacement or rotation, where, axis."""
    node, axis = (outcome.raw.column_label[:, column] - 1).tolist()
    return coordinate_key(outcome, node, axis, numbered=numbered)


def coordinate_key(outcome: Decomposition, node: int, axis: int, *, numbered: bool = True) -> Any:
    """The same of a coordinate of a node, by its index in `outcome.data`."""
    given = int(outcome.condensed.nodes[node])
    position = outcome.parts.place_of(given)
    turns = bool(outcome.data.arrays.node_kind[node] > NodeKind.POSITION)
    if position is None:
        return turns, (), (), axis
    value: FloatArray = outcome.given.arrays.node_value[:3, position]
    here = outcome.parts.at(position)
    names = (_name(part, numbered) for part in here)
    name = outcome.parts.name_of_point(position) or next(filter(None, names), "")
    return turns, natural(name), _place(outcome, value), axis


def _name(part: Part, numbered: bool) -> str:
    """A part's name; empty where it follows from a number that does not count."""
    return part.name if part.is_named or numbered else ""


def _place(outcome: Decomposition, value: FloatArray) -> tuple[float, ...]:
    step = SAME_PLACE * outcome.characteristic_length
    whole = np.round(value / step) if step > 0.0 else value
    return tuple((whole + 0.0).tolist())


def without_sense(axis: FloatArray) -> FloatArray:
    """An axis or its opposite: the first component that is not small beside others is positive."""
    first = int(np.argmax(np.abs(axis) >= 0.7 * np.abs(axis).max()))
    return axis if axis[first] > 0.0 else -axis


#: Larger spaces are given as the core has them: rows that are not zero, entries, and vectors.
_MOST_ROWS = 4_000
_MOST_ENTRIES = 400_000
_MOST_VECTORS = 200

Sense = Callable[[int], float]
Key = Callable[[int], Hashable]


def is_large(raw: Basis) -> bool:
    """Whether a space is so large that its vectors are told as the core gives them."""
    rows = support_of(raw).size
    many = rows > _MOST_ROWS or raw.vectors > _MOST_VECTORS
    return many or rows * raw.vectors > _MOST_ENTRIES


def scaled_motions(outcome: Decomposition) -> Basis:
    """The core's motions with the largest entry of each one."""
    weights = column_weights(outcome)
    return _scaled_as_they_are(outcome.raw.motions, weights, np.ones(weights.size))


def scaled_stresses(outcome: Decomposition) -> Basis:
    """The core's self-stresses with the largest force or moment of each one."""
    return _scaled_as_they_are(outcome.raw.stresses, row_weights(outcome), row_factors(outcome))


def motion_basis(outcome: Decomposition, space: Basis) -> Basis:
    """A basis of the motions, in metres and radians.

    Args:
        outcome: The analysis.
        space: An orthonormal basis of them, rotations in lengths.
    """
    key = cache(partial(column_key, outcome, numbered=False))
    support, dense = _held(space, key)
    groups = _MotionGroups(outcome, support)
    found = groups.basis(dense)
    if found is None:
        return scaled_motions(outcome)
    return _scaled(
        *(found, support, groups.owner, groups.outside),
        *(column_weights(outcome), np.ones(space.size), key, lambda row: 1.0),
    )


def stress_basis(outcome: Decomposition, space: Basis) -> Basis:
    """A basis of the self-stresses, dual to the deformations.

    Args:
        outcome: The analysis.
        space: An orthonormal basis of them, moments in forces.
    """
    key = cache(partial(row_key, outcome, numbered=False))
    support, dense = _held(space, key)
    each, every = np.arange(support.size), np.ones(support.size, bool)
    found = _part_stresses(outcome, support, dense)
    if found is None:
        return scaled_stresses(outcome)
    return _scaled(
        *(found, support, each, every, row_weights(outcome), row_factors(outcome)),
        *(key, partial(_sense_of_row, outcome)),
    )


def moves_within(outcome: Decomposition, basis: Basis, nodes: Collection[int]) -> BoolArray:
    """(vectors,) whether each vector of a basis of the motions moves nothing but some nodes.

    Args:
        outcome: The analysis.
        basis: The motions [m, rad].
        nodes: Indices in the model as given.
    """
    if not nodes:
        return np.zeros(basis.vectors, bool)
    node = outcome.condensed.nodes[outcome.raw.column_label[0] - 1]
    outside = ~np.isin(node, list(nodes))[basis.place]
    largest = np.zeros(basis.vectors)
    weighted = np.abs(basis.value * column_weights(outcome)[basis.place])
    np.maximum.at(largest, basis.of_entries(), np.where(outside, weighted, 0.0))
    return largest <= outcome.rounding


def _held(space: Basis, key: Key) -> tuple[IndexArray, FloatArray]:
    """The places that the vectors reach, in canonical order, and these rows in full."""
    support = support_of(space)
    order = sorted(support.tolist(), key=key)  # type: ignore[arg-type]
    places = index_of(support, space.size)[space.place].astype(np.int32)
    within = space._replace(size=support.size, place=places).toarray()
    return np.array(order, np.int64), within[np.searchsorted(support, order)]


# Scale and sign -------------------------------------------------------------


def _scaled(
    vectors: FloatArray,
    support: IndexArray,
    owner: IndexArray,
    outer: BoolArray,
    weights: FloatArray,
    units: FloatArray,
    key: Key,
    sense: Sense,
) -> Basis:
    """Weighted vectors as a basis without the weights; of each the largest is one in its unit.

    The largest displacement, rotation, force or moment, of equal ones the first by the key; its
    first component is positive by its sense.

    Args:
        vectors: (rows, k).
        support: (rows,) places of the rows.
        owner: (rows,) what each is a component of, from 0.
        outer: (rows,) whether the largest entry is to be sought there, if there is any.
        weights: (size,) what makes entries comparable.
        units: (size,) what makes displacements, rotations, forces and moments of them.
        key: Of places.
        sense: Of places.
    """
    made = np.zeros_like(vectors)
    for k, vector in enumerate(vectors.T):
        outside = np.where(outer, vector, 0.0)
        seen = outside if np.abs(outside).max() > ROUNDING * np.abs(vector).max() else vector
        sizes = np.sqrt(np.bincount(owner, seen**2))
        (largest,) = ranked(sizes, 1, lambda i: key(int(support[np.argmax(owner == i)])))
        mine = np.flatnonzero(owner == largest)
        first = mine[np.argmax(np.abs(vector[mine]) > NO_SENSE * sizes[largest])]
        plain = vector / weights[support]
        size = float(np.linalg.norm(plain[mine] * units[support[mine]]))
        made[:, k] = plain * (sense(int(support[first])) * np.sign(vector[first]) / size)
    order = np.argsort(support)
    basis = Basis.of_dense(made[order])
    places = support[order][basis.place].astype(np.int32)
    return basis._replace(size=weights.size, place=places)


def _scaled_as_they_are(raw: Basis, weights: FloatArray, units: FloatArray) -> Basis:
    """The core's vectors with the largest entry of each one; of equal ones the first positive."""
    if not raw.value.size:
        return raw
    weighted = np.abs(raw.value * weights[raw.place])
    start = raw.start[:-1].astype(np.int64)
    counts = np.diff(raw.start)
    largest = np.repeat(np.maximum.reduceat(weighted, start), counts)
    able = np.flatnonzero(weighted >= (1.0 - 1.0e-9) * largest)
    first = able[np.unique(raw.of_entries()[able], return_index=True)[1]]
    scale = units[raw.place[first]] * raw.value[first]
    return raw._replace(value=raw.value / np.repeat(scale, counts))


def _sense_of_row(outcome: Decomposition, row: int) -> float:
    """1 or -1: the sense of a stress resultant that does not depend on how its element is given.

    Tension and a torsion are positive as they are; of others the force or moment that the
    element exerts where it ends points along the first axis that it is not across.
    """
    element, deformation = (outcome.raw.row_label[:, row] - 1).tolist()
    role = int(role_table()[outcome.data.arrays.element_kind[element], deformation])
    if role in (Role.ELONGATION, Role.TORSION):
        return 1.0
    slots = (outcome.data.arrays.element_node[:, element] - 1).tolist()
    order = (slots[1], slots[0]) if role in AT_P else (slots[3], slots[2])
    whole = outcome.assembly
    mine = whole.row_of == 6 * element + deformation
    for node in order:
        here = mine & (whole.column_of // 3 == node) if node >= 0 else mine & False
        direction = np.zeros(3)
        np.add.at(direction, whole.column_of[here] % 3, -whole.value[here])
        size = np.abs(direction).max()
        if size > 0.0:
            first = int(np.argmax(np.abs(direction) > NO_SENSE * size))
            return float(np.sign(direction[first]))
    return 1.0


# Groups ---------------------------------------------------------------------


def _entries(space: FloatArray) -> FloatArray:
    """A basis with as few entries as can be; rows in canonical order."""
    if space.shape[1] < 2:
        return space
    classes = classes_of_rows(space)
    costs: list[Cost] = [(rows.size,) for rows in classes]
    return columns_of(pieces_of(space, classes, costs, lambda left: left), space.shape[0])


def _is_undivided(pieces: Sequence[Piece]) -> bool:
    """Whether many vectors of many groups were left as they are."""
    return any(
        len(piece.support) > 1 and piece.vectors.shape[1] > MOST_DIMENSIONS for piece in pieces
    )


class _MotionGroups:
    """Rows of the motions, columns of D(c), by what they belong to."""

    def __init__(self, outcome: Decomposition, support: IndexArray) -> None:
        node, self.axis = outcome.raw.column_label[:, support] - 1
        self.node = outcome.condensed.nodes[node]
        self.owner = np.unique(self.node, return_inverse=True)[1]
        kinds = outcome.given.arrays.node_kind[self.node]
        self.turns = kinds > NodeKind.POSITION
        self.carriers = outcome.carriers
        self.outside: BoolArray = ~np.isin(self.node, list(self.carriers.inner))

    def basis(self, space: FloatArray) -> FloatArray | None:
        """All vectors: bodies and joints before the insides of parts; None of a large space."""
        if space.shape[1] < 2:
            return space
        groups, costs, _ = self._groups(one_by_one=False)
        pieces = pieces_of(space, groups, costs, self._by_points)
        if _is_undivided(pieces):
            return None

        def order(piece: Piece) -> tuple[object, ...]:
            bodies, joints, folds, insides = piece.cost
            return not bodies + joints + folds, bodies, joints + folds, insides, piece.support

        # Few bodies first, then few joints, folds among them; insides of parts last.
        pieces.sort(key=order)
        return columns_of(pieces, space.shape[0])

    def _groups(self, *, one_by_one: bool) -> tuple[Groups, list[Cost], bool]:
        """Rows and costs of bodies, joints and insides, and whether there are insides.

        Args:
            one_by_one: Whether each node of an inside is a group.
        """
        place = grouped((node, row) for row, node in enumerate(self.node.tolist()))
        parts = self.carriers.parts
        bodies = [(body.positions + body.orientations) for body in parts.bodies]
        taken = {node for nodes in bodies for node in nodes}
        folds, joints = (
            [
                [node for node in joint.nodes if node not in taken]
                for joint in self.carriers.joints
                if joint.is_fold == is_fold
            ]
            for is_fold in (True, False)
        )
        # One by one the nodes of an inside are by the place where they are.
        insides = grouped(
            ((nodes, parts.place_of(node) if one_by_one else None), node)
            for _, nodes in self.carriers.insides
            for node in nodes
        )
        made: list[IntArray] = []
        costs: list[Cost] = []
        for kinds in (
            ((bodies, (1, 0, 0, 0)),),
            ((joints, (0, 1, 0, 0)), (folds, (0, 0, 1, 0))),
            ((list(insides.values()), (0, 0, 0, 1)),),
        ):
            found = (
                (sorted(row for node in nodes for row in place.get(node, ())), cost)
                for kind, cost in kinds
                for nodes in kind
            )
            # Rows are in canonical order, so that this orders bodies by it, too.
            for rows, cost in sorted(each for each in found if each[0]):
                made.append(np.array(rows, np.int32))
                costs.append(cost)
        return made, costs, any(cost[-1] for cost in costs)

    def _by_points(self, space: FloatArray) -> FloatArray:
        """A basis that moves as few inner points of sheets and wires as can be."""
        if space.shape[1] < 2:
            return space
        groups, costs, any_inside = self._groups(one_by_one=True)
        if not any_inside:
            return self._by_rotation(space)
        return columns_of(pieces_of(space, groups, costs, self._by_rotation), space.shape[0])

    def _by_rotation(self, space: FloatArray) -> FloatArray:
        """Translations, then what is across them: rotations about the middle of the points."""
        if space.shape[1] < 2:
            return space
        orthonormal = np.linalg.qr(space)[0]
        still = null_space(orthonormal[self.turns], ROUNDING)
        return np.concatenate(
            [
                self._along_axes(orthonormal @ still, ~self.turns),
                self._along_axes(orthonormal @ complement(still), self.turns),
            ],
            axis=1,
        )

    def _along_axes(self, space: FloatArray, rows: BoolArray) -> FloatArray:
        if space.shape[1] < 2:
            return space
        axes = [np.flatnonzero(rows & (self.axis == axis)) for axis in range(3)]
        return columns_of(pieces_of(space, axes, [(1,)] * 3, _entries), space.shape[0])


def _part_stresses(
    outcome: Decomposition, support: IndexArray, space: FloatArray
) -> FloatArray | None:
    """All self-stresses: of flexible parts, then inside of bodies; None of a large space."""
    if space.shape[1] < 2:
        return space
    element = outcome.condensed.elements[outcome.raw.row_label[0, support] - 1]
    parts = grouped(
        (outcome.parts.of_element(index), row) for row, index in enumerate(element.tolist())
    )
    # Rows are in canonical order, by names first.
    flexible, bodies = (
        [np.array(rows) for part, rows in parts.items() if (part.kind is PartKind.BODY) == is_body]
        for is_body in (False, True)
    )

    def by_bodies(space: FloatArray) -> FloatArray:
        if space.shape[1] < 2 or not bodies:
            return _entries(space)
        pieces = pieces_of(space, bodies, [(1,)] * len(bodies), _entries)
        return columns_of(pieces, space.shape[0])

    pieces = pieces_of(space, flexible, [(1,)] * len(flexible), by_bodies)
    if _is_undivided(pieces):
        return None
    pieces.sort(key=lambda piece: not piece.support)
    return columns_of(pieces, space.shape[0])
