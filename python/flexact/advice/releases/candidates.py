# SPDX-License-Identifier: BSD-3-Clause
"""What may be released, freed, declared or held, as rows over a null space of D(c).

To release or to hold some of them works exactly when their rows span the space.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...analysis.change import Change
from ...analysis.decomposition import column_weights
from ...analysis.mode_basis import column_key, coordinate_key, deformation_key, row_key
from ...analysis.result import Result
from ...analysis.sparse_basis import Sparse, index_of, support_of
from ...analysis.ways import is_of_class, reaction_entries, released_rates, rows_of, spanning
from ...core.arrays import Basis, FloatArray
from ...core.elements import Class, NodeKind, Role, coordinate_name, role_table
from ...model.parts.parts import PartKind
from ...util.records import Frozen

#: What is changed first, last and in between.
FLEXURE, BODY, LINK = 0, 1, 2
#: What it is of, when it is changed, and two numbers that say what it is.
Kind = tuple[str, int, int, int]
_BENDINGS = {
    Role.BENDING_XZ_P: 2,
    Role.BENDING_XZ_Q: 2,
    Role.BENDING_XY_P: 1,
    Role.BENDING_XY_Q: 1,
}
_ENDS = {
    Role.BENDING_XZ_Q: Role.BENDING_XZ_P,
    Role.BENDING_XY_Q: Role.BENDING_XY_P,
    Role.PLANAR_BENDING_Q: Role.PLANAR_BENDING_P,
}


def tier_of_element(result: Result, given: int) -> int:
    """Flexures come before bodies, and links inside of bodies last; by index in the given."""
    if given in result.parts.links:
        return LINK
    return BODY if result.parts.of_element(given).kind is PartKind.BODY else FLEXURE


def tier_of_node(result: Result, given: int) -> int:
    """Bodies come before joints, and what is inside of sheets and wires last."""
    if given in result.carriers.inner:
        return LINK
    return FLEXURE if given in result.parts.body_at else BODY


def kind_of(result: Result, change: Change) -> Kind:
    """Of what kind the deformation or the coordinate of a change is, however it is turned."""
    for node, _, _ in change.coordinates[:1]:
        index = result.given.node_index[node]
        turns = int(result.given.arrays.node_kind[index] > NodeKind.POSITION)
        held = int(np.count_nonzero(result.given.arrays.coordinate_class[:, index] == 1))
        return "node", tier_of_node(result, index), turns, held
    element, number, _ = change.deformations[0]
    index = result.given.element_index[element]
    part = result.parts.of_element(index)
    role = int(role_table()[result.given.arrays.element_kind[index], number - 1])
    wide = int(result.parts.wide[index])
    in_plane = int(wide == _BENDINGS.get(Role(role), -1))
    if not wide and role in _BENDINGS:
        # Of a member that is wide in neither direction both are alike.
        return part.kind.value, 1, int(Role.BENDING_XY_P), 0
    tier = tier_of_element(result, index)
    return part.kind.value, tier, int(_ENDS.get(Role(role), role)), in_plane


#: Rows of a null space that are held in full, times vectors, and times vectors again.
MOST_ENTRIES, MOST_WORK = 4_000_000, 50_000_000
#: Below this part of the largest a row does not reach into the space.
_NOTHING = 1.0e-7

#: Rows or vectors, by their places.
Places = NDArray[np.integer]


@dataclass(frozen=True, eq=False)
class Reach(Frozen):
    """Rows over a null space.

    Attributes:
        rows: (n, k) of k orthonormal vectors.
        index: (n,) what each is: a row or column of D(c), or a place in the whole Jacobian.
        key: By what rows of practically one value are sorted, of an entry of `index`.
        change: What is done with it, of an entry of `index`.
    """

    rows: FloatArray
    index: Places
    key: Callable[[int], Any]
    change: Callable[[int], Change]

    @property
    def vectors(self) -> int:
        """Number of the vectors."""
        return int(self.rows.shape[1])

    def only(self, chosen: Places) -> Reach:
        """Some of the rows."""
        return replace(self, rows=self.rows[chosen], index=self.index[chosen])


def fits(basis: Basis) -> bool:
    """Whether the rows of a space can be held in full."""
    entries = support_of(basis).size * basis.vectors
    return entries <= MOST_ENTRIES and entries * basis.vectors <= MOST_WORK


def of_rows(result: Result, vectors: Places | None = None) -> Reach:
    """The fixed deformations among the rows of D(c), over the self-stresses or some of them."""
    able = is_of_class(result, Class.FIXED)
    space = result.stress_space
    if vectors is not None:
        space = space.only(vectors.astype(np.int32))

    def change(row: int) -> Change:
        return _of_deformation(result, *(result.raw.row_label[:, row] - 1).tolist())

    return Reach(*rows_of(space, able), lambda row: row_key(result, row), change)


def of_columns(result: Result, vectors: Places | None = None) -> Reach:
    """The columns of D(c), over the motions or some of them."""
    space = result.motion_space
    if vectors is not None:
        space = space.only(vectors.astype(np.int32))

    def change(column: int) -> Change:
        node, axis = (result.raw.column_label[:, column] - 1).tolist()
        return _of_coordinate(result, node, axis, Class.INDEPENDENT)

    return Reach(*rows_of(space), lambda column: column_key(result, column), change)


def of_supports(result: Result) -> Reach:
    """The fixed coordinates, over the self-stresses: the reactions, as forces."""
    able = (result.data.arrays.coordinate_class.T == Class.FIXED).ravel()
    return Reach(
        *_product(reaction_entries(result, able), result.stress_space),
        lambda place: coordinate_key(result, *divmod(place, 3)),
        lambda place: _of_coordinate(result, *divmod(place, 3), Class.DEPENDENT),
    )


def of_released(result: Result) -> Reach:
    """The released deformations, over the motions: their rates, angles as lengths."""
    matrix, length = released_rates(result)
    value = matrix.value * length[matrix.row_of] / column_weights(result)[matrix.column_of]
    return Reach(
        *_product(matrix._replace(value=value), result.motion_space),
        lambda place: deformation_key(result, *divmod(place, 6)),
        lambda place: _of_deformation(result, *divmod(place, 6), Class.FIXED),
    )


def _product(matrix: Sparse, basis: Basis) -> tuple[FloatArray, Places]:
    """Rows of a matrix times a basis that are not zero, up to what rounding leaves of them."""
    index = np.unique(matrix.row_of)
    row = index_of(index, matrix.rows)[matrix.row_of]
    vectors = basis.toarray()
    made = np.zeros((2, index.size, basis.vectors))
    np.add.at(made[0], row, matrix.value[:, None] * vectors[matrix.column_of])
    np.add.at(made[1], row, np.abs(matrix.value[:, None] * vectors[matrix.column_of]))
    size, contributed = np.linalg.norm(made, axis=2)
    left = size > _NOTHING * contributed
    return made[0][left], index[left]


def _of_deformation(
    result: Result, element: int, deformation: int, given: Class = Class.DEPENDENT
) -> Change:
    index, own = result.condensed.in_given(element, deformation + 1)
    number = int(result.given.arrays.element_number[index])
    return Change(deformations=((number, own, given),))


def _of_coordinate(result: Result, node: int, axis: int, given: Class) -> Change:
    arrays = result.data.arrays
    name = coordinate_name(int(arrays.node_kind[node]), axis)
    return Change(coordinates=((int(arrays.node_number[node]), name, given),))


#: Up to so many sets are looked at; of more those near a good one.
_MOST_SETS, _FEWEST_SETS, _MOST_OPERATIONS = 20_000, 40, 2.0e7
#: Of so many rows at most, those that reach furthest.
_MOST_ROWS = 400
#: Blocks worse than this are none; nor those so many times worse than the best.
_WORST, _MUCH_WORSE = 1.0e7, 1.0e5
#: How often a set is looked for near the best of those known, and near how many.
_ROUNDS, _NEAR = 2, 4
#: Of larger sets none are looked for near another.
_MOST_EXCHANGED = 60


class Candidate(NamedTuple):
    """A set of rows whose block is regular."""

    members: tuple[int, ...]
    """Places in the reach."""
    condition: float
    """The inverse of the smallest singular value of its block, 1 at best."""
    rank: tuple[float, ...]
    """By what it is sorted among others."""


#: Sizes by which sets are sorted before their condition, (sets, any), of (sets, k) rows.
Ranking = Callable[[Places, FloatArray], FloatArray]


def candidates(reach: Reach, ranking: Ranking, wishes: FloatArray) -> list[Candidate]:
    """Sets of rows whose blocks are regular, the best first.

    Args:
        reach: The rows over the space.
        ranking: Of sets and their conditions, what they are sorted by before.
        wishes: (n,) how unwelcome each row is; where sets are too many those of little are looked
            at.
    """
    count = reach.vectors
    # The place of each row among all by names and geometry.
    keys = [reach.key(int(i)) for i in reach.index]
    place = np.empty(len(keys), np.int64)
    place[sorted(range(len(keys)), key=keys.__getitem__)] = np.arange(len(keys))
    found = list(_sets(reach, place, count, wishes))
    if not found:
        return []
    sets = np.array(found, np.int64)
    condition = _conditions(reach.rows, sets)
    good = condition < min(_WORST, _MUCH_WORSE * float(condition.min()))
    sets, condition = sets[good], condition[good]
    if not sets.size:
        return []
    rounded = np.round(np.log(condition), 6)[:, None]
    ranks = np.concatenate([np.round(ranking(sets, condition), 6), rounded], axis=1).tolist()
    ties = [tuple(sorted(place[list(each)].tolist())) for each in sets.tolist()]
    order = sorted(range(len(ties)), key=lambda i: (tuple(ranks[i]), ties[i]))
    return [
        Candidate(
            tuple(sorted(sets[i].tolist(), key=lambda row: int(place[row]))),
            float(condition[i]),
            tuple(ranks[i]),
        )
        for i in order
    ]


def _conditions(rows: FloatArray, sets: Places) -> FloatArray:
    values = np.linalg.svd(rows[sets], compute_uv=False)[:, -1]
    with np.errstate(divide="ignore"):
        made: FloatArray = np.divide(1.0, values)
    return made


def _sets(reach: Reach, place: Places, count: int, wishes: FloatArray) -> Iterator[Sequence[int]]:
    norms = np.linalg.norm(reach.rows, axis=1)
    able = np.flatnonzero(norms > norms.max(initial=0.0) / _WORST)
    if able.size < count:
        return
    most_sets = max(_FEWEST_SETS, min(_MOST_SETS, int(_MOST_OPERATIONS / count**3)))
    if math.comb(able.size, count) <= most_sets:
        yield from combinations(able.tolist(), count)
        return
    is_large = count > _MOST_EXCHANGED
    if able.size > _MOST_ROWS and not is_large:
        order = np.lexsort((place[able], -np.round(norms[able], 9)))
        able = able[order[:_MOST_ROWS]]
    known: dict[tuple[int, ...], None] = {}
    for most in np.unique(wishes[able]).tolist():
        if known and is_large:
            break
        some = able[wishes[able] <= most]
        chosen = spanning(reach.rows[some], lambda i, some=some: int(place[some[i]]))  # type: ignore[misc]
        if len(chosen) == count:
            known[tuple(sorted(some[chosen].tolist()))] = None
    for _ in range(_ROUNDS if known and not is_large else 0):
        sets = list(known)
        best = np.argsort(np.round(_conditions(reach.rows, np.array(sets)), 9), kind="stable")
        near = (_exchanges(sets[i], able.tolist()) for i in best[:_NEAR].tolist())
        for each in chain.from_iterable(near):
            if len(known) >= most_sets:
                break
            known.setdefault(each)
    yield from known


def _exchanges(members: tuple[int, ...], able: list[int]) -> Iterator[tuple[int, ...]]:
    """The sets in which one row is another."""
    for k in range(len(members)):
        rest = members[:k] + members[k + 1 :]
        for other in able:
            if other not in members:
                yield tuple(sorted((*rest, other)))
