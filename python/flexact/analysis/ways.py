# SPDX-License-Identifier: BSD-3-Clause
"""How far coordinates and deformations reach into the null spaces of D(c).

In a null space of several dimensions single vectors are arbitrary; what counts is how
far each coordinate or deformation reaches into the space, its leverage: the norm of its
row in an orthonormal basis, with rotations and moments made comparable by the
characteristic length. A coordinate that is no column of D(c) reaches into the
self-stresses by the reaction that they cause there.

Of thousands of vectors that hang together the leverage is not exact; see `subspace`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from enum import Enum
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import Basis, BoolArray, FloatArray, IndexArray
from ..core.elements import AXES, Class, Dual, NodeKind, coordinate_name, dual_table
from ..model.parts.parts import surplus_of
from .decomposition import Decomposition, column_weights, row_weights
from .limits import NO_LEVERAGE
from .mode_basis import column_key, coordinate_key, deformation_key, ranked, row_key
from .result import Result
from .sparse_basis import Sparse, index_of, norms_of_product, row_norms, support_of

#: By what equals are sorted, of an index.
Key = Callable[[int], Any]
#: Index of an element from 0 and number of its deformation from 1.
Deformations = list[tuple[int, int]]
#: Index of a node and axis, both from 0.
Coordinates = list[tuple[int, int]]


def releases(result: Result) -> list[int]:
    """Rows of D(c) that can be released to remove a self-stress, the largest leverage first.

    Rows of independent deformations are not among them; see `driven_deformations`.
    """
    able = is_of_class(result, Class.FIXED) & is_releasable(result)
    leverage = np.where(able, row_norms(result.stress_space), 0.0)
    return _largest(leverage, lambda row: row_key(result, row))


def release_set(result: Result) -> list[int]:
    """Rows of D(c) that remove all self-stresses when all of them are released."""
    able = is_of_class(result, Class.FIXED) & is_releasable(result)
    return _independent_rows(result.stress_space, lambda row: row_key(result, row), able)


def driven_set(result: Result) -> list[int]:
    """Rows of independent deformations that remove self-stresses, as many as they can.

    To release all of them in place of their declarations does so.
    """
    able = is_of_class(result, Class.INDEPENDENT)
    return _independent_rows(result.stress_space, lambda row: row_key(result, row), able)


def driven_deformations(result: Result) -> Deformations:
    """Independent deformations in a self-stress: driven against a constraint.

    To release one in place of its declaration removes a self-stress.
    """
    able = is_of_class(result, Class.INDEPENDENT)
    leverage = np.where(able, row_norms(result.stress_space), 0.0)
    return _of_rows(result, _largest(leverage, lambda row: row_key(result, row)))


def driven_coordinates(result: Result) -> Coordinates:
    """Independent coordinates whose declaration can be taken away to remove a self-stress."""
    return _with_reaction(result, Class.INDEPENDENT)


def supports(result: Result) -> Coordinates:
    """Fixed coordinates that can be freed to remove a self-stress."""
    return _with_reaction(result, Class.FIXED)


def coordinates(result: Result) -> list[int]:
    """Columns of D(c) that can be fixed or made independent to remove a motion."""
    return _largest(row_norms(result.motion_space), lambda column: column_key(result, column))


def coordinate_set(result: Result) -> list[int]:
    """Columns of D(c) that remove all motions when all are fixed or made independent."""
    return _independent_rows(result.motion_space, lambda column: column_key(result, column))


def deformations(result: Result) -> Deformations:
    """Released deformations that the motions change.

    To hold one, or to make it independent, removes a motion.
    """
    if not np.any(result.data.arrays.deformation_class == Class.DEPENDENT):
        return []
    matrix, length = released_rates(result)
    value = matrix.value / column_weights(result)[matrix.column_of]
    leverage = length * norms_of_product(matrix._replace(value=value), result.motion_space)
    order = _largest(leverage, lambda row: deformation_key(result, *divmod(row, 6)))
    return [(row // 6, row % 6 + 1) for row in order]


def entry_rows(result: Decomposition) -> IndexArray:
    """(entries,) the row of D(c) of each entry of the assembly; -1 of what is none."""
    element, deformation = result.raw.row_label - 1
    size = 6 * result.data.arrays.element_number.size
    return np.asarray(index_of(6 * element + deformation, size)[result.assembly.row_of])


def entry_columns(result: Decomposition) -> IndexArray:
    """(entries,) the column of D(c) of each entry of the assembly, likewise."""
    node, axis = result.raw.column_label - 1
    size = 3 * result.data.arrays.node_number.size
    return np.asarray(index_of(3 * node + axis, size)[result.assembly.column_of])


def released_rates(result: Result) -> tuple[Sparse, FloatArray]:
    """Rates of the released deformations by the columns of D(c), and lengths of their angles.

    The lengths, (6 elements,), make angles comparable: 1 of what is no angle.
    """
    arrays, whole = result.data.arrays, result.assembly
    released = (arrays.deformation_class.T == Class.DEPENDENT).ravel()
    column = entry_columns(result)
    matrix = Sparse(whole.row_of, column, whole.value, released.size)
    angle = (dual_table()[arrays.element_kind] == Dual.MOMENT).ravel()
    length = np.where(angle, result.characteristic_length, 1.0)
    return matrix.only(released[whole.row_of] & (column >= 0)), length


def reaction_entries(result: Result, able: BoolArray) -> Sparse:
    """Reactions at some coordinates, (3 nodes,), by the rows of D(c), moments as forces."""
    arrays, whole, row = result.data.arrays, result.assembly, entry_rows(result)
    matrix = Sparse(whole.column_of, row, whole.value, able.size)
    matrix = matrix.only(able[whole.column_of] & (row >= 0))
    turned = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)
    weight = 1.0 / np.where(turned, result.characteristic_length, 1.0)
    value = matrix.value * weight[matrix.row_of] / row_weights(result)[matrix.column_of]
    return matrix._replace(value=value)


def is_of_class(result: Result, wanted: Class) -> BoolArray:
    """(m,) whether the deformation of a row is of a class."""
    element, deformation = result.raw.row_label - 1
    return np.asarray(result.data.arrays.deformation_class[deformation, element] == wanted)


def is_releasable(result: Result) -> BoolArray:
    """(m,) whether a row is of a part that can be made soft: not of a rigid body.

    Where there is nothing else all are, of bodies of several members those with a name first.
    """
    element = result.condensed.elements[result.raw.row_label[0] - 1]
    stressed = row_norms(result.stress_space) > NO_LEVERAGE
    for rigid in (
        [index for body in result.parts.bodies for index in body.elements],
        list(result.parts.links),
    ):
        inside = np.zeros(result.given.arrays.element_number.size, bool)
        inside[rigid] = True
        made: BoolArray = ~inside[element]
        if made[stressed].any():
            return made
    return np.ones(element.size, bool)


def _with_reaction(result: Result, wanted: Class) -> Coordinates:
    """Coordinates of a class on which the self-stresses act, the largest reaction first."""
    able = np.equal(result.data.arrays.coordinate_class.T, wanted).ravel()
    if not able.any():
        return []
    # Zero where nothing is left of what the elements contribute: sigma^T D.
    matrix, space = reaction_entries(result, able), result.stress_space
    reaction = norms_of_product(matrix, space)
    contributed = norms_of_product(
        matrix._replace(value=np.abs(matrix.value)), space._replace(value=np.abs(space.value))
    )
    reaction = np.where(reaction > NO_LEVERAGE * contributed, reaction, 0.0)
    order = _largest(reaction, lambda place: coordinate_key(result, *divmod(place, 3)))
    return [(place // 3, place % 3) for place in order]


def _largest(leverage: FloatArray, key: Key) -> list[int]:
    order = np.array(ranked(leverage, leverage.size, key), np.int64)
    rows: list[int] = order[leverage[order] > NO_LEVERAGE].tolist()
    return rows


def _independent_rows(basis: Basis, key: Key, able: BoolArray | None = None) -> list[int]:
    """Rows that span the space together, each as far from the ones before as can be.

    Only of `able` rows, if given.
    """
    rows, support = rows_of(basis, able)
    return [int(support[i]) for i in spanning(rows, lambda i: key(int(support[i])))]


def rows_of(basis: Basis, able: BoolArray | None = None) -> tuple[FloatArray, IndexArray]:
    """Those rows of a basis that are not zero, and which they are; of `able` ones, if given."""
    support = support_of(basis)
    if able is not None:
        support = support[able[support]]
    place = index_of(support, basis.size)[basis.place]
    there = place >= 0
    made = np.zeros((support.size, basis.vectors))
    made[place[there], basis.of_entries()[there]] = basis.value[there]
    return made, support


def spanning(rows: FloatArray, key: Key) -> list[int]:
    """Rows of (n, k) that span the space together, each as far from those before as can be.

    Fewer than k where there are not so many.
    """
    rest, chosen = rows.copy(), []
    for _ in range(rows.shape[1]):
        norms = np.sqrt(np.einsum("ij,ij->i", rest, rest))
        first = ranked(norms, 1, key)
        if not first or norms[first[0]] < NO_LEVERAGE:
            break
        direction = rest[first[0]] / norms[first[0]]
        rest -= np.outer(rest @ direction, direction)
        chosen.append(first[0])
    return chosen


#: How many parts, the best first, an advice has at most.
_MOST_PARTS = 12


class Step(str, Enum):
    """What is to be done with one of the parts, or with all of them."""

    DECLARE_INTERNAL = "declare what is inside divided sheets and wires"
    DECLARE_FOLDS = "declare the folds of folded sheets"
    DECLARE_OR_HOLD = "declare or hold one coordinate"
    DECLARE_OR_HOLD_RELEASED = "declare or hold one released deformation"
    DECLARE_OR_HOLD_ALL = "declare or hold all coordinates"
    RELEASE = "release one deformation"
    UNDECLARE = "take one declaration away"
    FREE_SUPPORT = "free one support"
    RELEASE_ALL = "release all deformations"


class Coordinate(NamedTuple):
    """A coordinate of a node."""

    node: int
    """Number of the node."""
    name: str
    """Such as x or rz."""
    operands: str
    """Number of the node and component, as a deck names them."""


class Deformation(NamedTuple):
    """A deformation of an element."""

    element: int
    """Number of the element."""
    number: int
    """Number of the deformation, from 1."""
    operands: str
    """Numbers of the element and the deformation, as a deck names them."""


Part = Coordinate | Deformation


class Way(NamedTuple):
    """One way to remove motions or self-stresses."""

    step: Step
    parts: tuple[Part, ...]
    """The best first; at most twelve, or all where all belong together."""
    more: bool
    """Whether there are more parts."""
    keywords: tuple[str, ...] = ()
    """Statements of a deck of which one does it with a part; none where there is none."""
    instead: bool = False
    """Whether that takes the place of a statement that is there."""


def on_motions(result: Result) -> Iterator[Way]:
    """What may be declared or held so that there are fewer motions, the best first.

    Where folds of folded sheets turn, these are declared first; the rest is of what is left then.
    """
    if not result.under_constrained:
        return
    # What makes each divided sheet or wire one beam, as far as a deck or model does not yet.
    numbers = result.given.arrays.element_number
    inside = [
        Deformation(number, deformations[0], " ".join(map(str, (number, *deformations))))
        for element, deformations in surplus_of(result.given)
        for number in (int(numbers[element]),)
    ]
    if inside:
        yield Way(Step.DECLARE_INTERNAL, tuple(inside), False, ("DYNE",), instead=True)
    whole = result.with_folds_declared
    if whole is not None:
        folds = tuple(_deformations(result, list(result.folds)))
        yield Way(Step.DECLARE_FOLDS, folds, False, ("DYNE", "RLSE"), True)
        yield from on_motions(whole)
        return
    labels = result.raw.column_label.T - 1
    yield _some(
        Step.DECLARE_OR_HOLD,
        _coordinates(result, labels[coordinates(result)].tolist()),
        ("DYNX", "FIX"),
    )
    changed = _deformations(result, deformations(result))
    held = _some(Step.DECLARE_OR_HOLD_RELEASED, changed, ("DYNE", "RLSE"), True)
    if held.parts:
        yield held
    if 1 < result.under_constrained <= _MOST_PARTS:
        every = _coordinates(result, labels[coordinate_set(result)].tolist())
        together = _some(Step.DECLARE_OR_HOLD_ALL, every)
        if together.parts:
            yield together


def on_self_stresses(result: Result) -> Iterator[Way]:
    """What may be released, freed or taken away so that there are fewer self-stresses."""
    if not result.over_constrained:
        return
    able = _deformations(result, _of_rows(result, releases(result)))
    released = _some(Step.RELEASE, able, ("RLSE",))
    driven = _some(
        Step.UNDECLARE, _deformations(result, driven_deformations(result)), ("RLSE",), True
    )
    moved = _some(Step.UNDECLARE, _coordinates(result, driven_coordinates(result)))
    both = driven._replace(parts=driven.parts + moved.parts, more=driven.more or moved.more)
    held = _some(Step.FREE_SUPPORT, _coordinates(result, supports(result)))
    yield from (way for way in (released, both, held) if way.parts)
    count = result.over_constrained
    chosen = release_set(result) if 1 < count <= _MOST_PARTS else []
    if len(chosen) == count > 1:
        yield _some(Step.RELEASE_ALL, _deformations(result, _of_rows(result, chosen)))


def _some(
    step: Step, parts: Iterable[Part], keywords: tuple[str, ...] = (), instead: bool = False
) -> Way:
    some = tuple(islice(parts, _MOST_PARTS + 1))
    return Way(step, some[:_MOST_PARTS], len(some) > _MOST_PARTS, keywords, instead)


def _of_rows(result: Result, chosen: list[int]) -> Deformations:
    """Element index and number of the deformation of rows of D(c)."""
    return [(i - 1, mode) for i, mode in result.raw.row_label[:, chosen].T.tolist()]


def _coordinates(result: Result, places: Coordinates) -> Iterator[Coordinate]:
    return (coordinate_of(result, *place) for place in places)


def coordinate_of(result: Decomposition, node: int, axis: int) -> Coordinate:
    """The coordinate of a node along or about an axis, both by their index from 0."""
    arrays = result.data.arrays
    kind, number = int(arrays.node_kind[node]), int(arrays.node_number[node])
    first = 2 if kind == NodeKind.ORIENTATION else 1  # behind the first Euler parameter
    operands = f"{number} {AXES[kind].index(axis) + first}"
    return Coordinate(number, coordinate_name(kind, axis), operands)


def _deformations(result: Result, places: Deformations) -> Iterator[Deformation]:
    numbers, given = result.data.arrays.element_number, result.given.arrays.element_number
    for index, mode in places:
        element, own = result.condensed.in_given(index, mode)
        yield Deformation(int(numbers[index]), mode, f"{given[element]} {own}")
