# SPDX-License-Identifier: BSD-3-Clause
"""What may be released, freed, declared or held, as rows over a null space of D(c).

To release or to hold some of them works exactly when their rows span the space. Sets of them are
counted on the deck as given, and tried before they are said; those that symmetry makes equal are
one step.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations
from time import monotonic
from typing import Any, NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.decomposition import Asked, column_weights, decompose
from ...analysis.mode_basis import column_key, coordinate_key, deformation_key, row_key
from ...analysis.result import Result
from ...analysis.sparse_basis import Sparse, index_of, support_of
from ...analysis.verdict import Alternative, AnalysisError
from ...analysis.ways import (
    entry_columns,
    entry_rows,
    is_of_class,
    reaction_entries,
    released_rates,
    rows_of,
    spanning,
)
from ...core.arrays import Basis, FloatArray, IndexArray
from ...core.elements import Class, NodeKind, Role, coordinate_name, role_table
from ...model.data import ModelData
from ...model.parts.condensing import as_given
from ...model.parts.parts import PartKind
from ...util.errors import FlexactError
from ...util.groups import grouped, values_in
from ...util.records import Frozen
from ..step import Purpose, after, analysed, together
from .matroid import Judge, Rows, TooManyError, count_bases
from .words import Release

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
Places = IndexArray


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


def of_rows(result: Result, space: Basis | None = None) -> Reach:
    """The fixed deformations among the rows of D(c), over the self-stresses or some of them."""
    able, space = is_of_class(result, Class.FIXED), space or result.stress_space

    def change(row: int) -> Change:
        return _of_deformation(result, *(result.raw.row_label[:, row] - 1).tolist())

    return Reach(*rows_of(space, able), lambda row: row_key(result, row), change)


def of_columns(result: Result, space: Basis | None = None) -> Reach:
    """The columns of D(c), over the motions or some of them."""

    def change(column: int) -> Change:
        node, axis = (result.raw.column_label[:, column] - 1).tolist()
        return _of_coordinate(result, node, axis, Class.INDEPENDENT)

    return Reach(
        *rows_of(space or result.motion_space), lambda column: column_key(result, column), change
    )


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
    index = values_in(matrix.row_of)
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
_MOST_SETS, _FEWEST_SETS, _MOST_IN_SETS = 20_000, 40, 2.0e7
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
    most_sets = max(_FEWEST_SETS, min(_MOST_SETS, int(_MOST_IN_SETS / count**3)))
    if math.comb(able.size, count) <= most_sets:
        yield from combinations(able.tolist(), count)
        return
    is_large = count > _MOST_EXCHANGED
    if able.size > _MOST_ROWS and not is_large:
        order = np.lexsort((place[able], -np.round(norms[able], 9)))
        able = able[order[:_MOST_ROWS]]
    known: dict[tuple[int, ...], None] = {}
    for most in values_in(wishes[able]).tolist():
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


# Verified ---------------------------------------------------------------------------

#: Rows and columns of D(c) up to which null vectors are computed that were left out.
_MOST_DENSE = 1_000


def as_it_stands(result: Result) -> Result:
    """The result of the model as given, without taking declared divided sheets for one beam.

    It is the result itself where there are none, and where each beam by itself gives other
    counts, as it can where inner nodes are off the line: what the verdict counts is counted.

    Raises:
        AnalysisError: the model cannot be analysed so.
    """
    if result.condensed.chains:
        made = standing(result, result.given)
        if all(left_of(each, made) == left_of(each, result) for each in _BOTH):
            return made
    return complete(result)


def changed(stands: Result, change: Change) -> Result:
    """The analysis of what `as_it_stands` gave, once it is changed, in the same way.

    Raises:
        FlexactError: the changed mechanism cannot be analysed.
    """
    if stands.condensed.chains:
        return analysed(stands, change)
    return standing(stands, change.apply(stands.given).data)


def complete(result: Result) -> Result:
    """The result with all its null vectors, where to compute those left out takes little time."""
    raw = result.raw
    left_out = result.under_constrained - raw.motions.vectors
    left_out += result.over_constrained - raw.stresses.vectors
    if not left_out or max(result.rows, result.columns) > _MOST_DENSE:
        return result
    try:
        raw = decompose(result.data, result.asked._replace(method="svd", prove=False))
    except AnalysisError:
        return result
    return result if raw.rank != result.rank else replace(result, raw=raw)


def standing(result: Result, data: ModelData) -> Result:
    """The result of another sound model as it stands, analysed as another one was.

    Raises:
        AnalysisError: the model cannot be analysed.
    """
    asked = Asked(result.asked.method, result.asked.tolerance)
    return complete(Result(result.name, as_given(data), decompose(data, asked), asked))


_BOTH = Purpose.RELEASE, Purpose.DECLARE


def left_of(purpose: Purpose, one: Result | Alternative) -> int:
    """What is left of what is to be removed: self-stresses, or motions."""
    is_release = purpose is Purpose.RELEASE
    return one.over_constrained if is_release else one.under_constrained


def removes_all(before: Result, after: Result, purpose: Purpose) -> bool:
    """Whether nothing is left, and what rounding of the geometry may have hidden neither.

    What may be left besides was in doubt before.
    """
    if left_of(purpose, after):
        return False
    most, most_after = (
        max(left_of(purpose, one), *(left_of(purpose, each) for each in one.alternatives), 0)
        for one in (before, after)
    )
    return most_after <= most - left_of(purpose, before)


# Counted ----------------------------------------------------------------------------

#: Larger counts are not given: readers of JSON may take them for other numbers.
_LARGEST = 2**53
#: For so long sets are counted.
COUNT_SECONDS = 10.0
#: Rows times vectors squared beyond which a count is not begun.
_MOST_WORK = 2.0e9
#: How many blocks are tried that the numbers leave in doubt, and rows of D(c) in all of them.
_MOST_JUDGED, _MOST_ROWS_JUDGED = 400, 40_000
#: Of a null vector so many times the noise over the gap may be rounding.
_OF_NOISE = 10.0


def counted(stands: Result, reach: Reach, purpose: Purpose) -> tuple[int | None, int | None]:
    """How many sets of rows span their space, and how many more may, for all that is known.

    The others do so for the numbers as they are, though rounding may hide that they do not. A
    block that the numbers leave in doubt is tried: the mechanism is changed so and analysed. Where
    that leaves doubts it is counted again with such blocks taken for regular.

    Args:
        stands: The result of the deck as it stands, whose rows they are.
        reach: The rows over the null space.
        purpose: What they are to do.

    Returns:
        None where they are too many to be counted.
    """
    rows, vectors = reach.rows.shape
    if not vectors:
        return 0, 0
    if float(rows) * vectors**2 > _MOST_WORK:
        return None, 0
    until = monotonic() + COUNT_SECONDS
    known: dict[Rows, bool] = {}
    doubtful: set[Rows] = set()

    def judge(chosen: Rows) -> bool | None:
        if chosen not in known:
            tries = len(known) + 1
            is_late = monotonic() > until
            if is_late or tries > _MOST_JUDGED or tries * stands.rows > _MOST_ROWS_JUDGED:
                return None
            change = together(reach.change(int(reach.index[i])) for i in sorted(chosen))
            try:
                after = changed(stands, change)
                known[chosen] = removes_all(stands, after, purpose)
                if not known[chosen] and not left_of(purpose, after):
                    doubtful.add(chosen)
            except FlexactError:
                known[chosen] = False
        return known[chosen]

    # By how much entries of the orthonormal null vectors may be off.
    zero, above = stands.gap.largest_zero or 0.0, stands.gap.smallest_nonzero or 1.0
    noise = max(stands.raw.noise, zero, float(np.finfo(np.float64).eps))
    error = _OF_NOISE * noise / min(above, 1.0)

    def count(judge: Judge) -> int | None:
        try:
            found = count_bases(reach.rows, error, judge, until)
        except TooManyError:
            return None
        return found if found <= _LARGEST else None

    certain = count(judge)
    if certain is None or not doubtful:
        return certain, 0

    def judge_kindly(chosen: Rows) -> bool | None:
        found = judge(chosen)
        return True if chosen in doubtful else found

    most = count(judge_kindly)
    return certain, None if most is None else max(0, most - certain)


# Tried ------------------------------------------------------------------------------

#: Rows and columns of D(c) up to which bodies are taken as what they are.
_MOST = 250
_ZERO = 1.0e-9
#: How many steps there are at most.
_MOST_STEPS = 12
#: How many sets are looked at, in their order.
_MOST_GROUPED = 5_000
#: How many others of a group are tried.
_MOST_ALTERNATIVES = 35
#: How many analyses are made of a small mechanism, and of any; and operations in all.
_MOST_TRIES, _FEWEST_TRIES, _MOST_OPERATIONS = 100, 4, 6.0e10
#: Singular values that differ by less than this part, or by this, are equal.
_EQUAL, _TINY = 1.0e-6, 1.0e-9


class _Works(NamedTuple):
    """A set that works."""

    candidate: Candidate
    step: Release
    spectrum: FloatArray
    is_certain: bool
    """Whether it does so however the geometry was rounded."""


def spectrum_of(result: Result) -> FloatArray:
    """Singular values of the scaled D(c) on motions that leave its bodies rigid.

    They do not depend on the links of which a body is made, but on its points alone. Of large
    models they are those of the scaled D(c) itself.
    """
    if max(result.rows, result.columns) > _MOST or not result.rows * result.columns:
        return result.scaled_singular_values
    raw, row, column = result.raw, entry_rows(result), entry_columns(result)
    there = (row >= 0) & (column >= 0)
    matrix = np.zeros((result.rows, result.columns))
    np.add.at(matrix, (row[there], column[there]), result.assembly.value[there])
    matrix = matrix * raw.row_scale[:, None] * raw.column_scale
    given = result.condensed.elements[raw.row_label[0] - 1].tolist()
    kinds = {i: result.parts.of_element(i).kind for i in set(given)}
    rigid = np.array([kinds[i] is PartKind.BODY for i in given], bool)
    if rigid.any():
        _, values, vectors = np.linalg.svd(matrix[rigid])
        rank = int(np.count_nonzero(values > _ZERO * values[0]))
        matrix = matrix[~rigid] @ vectors[rank:].T
    if not matrix.size:
        return np.zeros(0)
    return np.asarray(np.linalg.svd(matrix, compute_uv=False), np.float64)


def decades(condition: FloatArray) -> FloatArray:
    """(sets, 1) how many times ten each condition is worse than the best."""
    return np.asarray(np.floor(np.log10(condition / condition.min()) + 1.0e-6)[:, None])


def listed(
    result: Result, reach: Reach, purpose: Purpose, found: list[Candidate], most: int = _MOST_STEPS
) -> tuple[Release, ...]:
    """The best sets of rows that work, each tried.

    First one of each group that may be equal is tried, then the others of these groups: those
    of which the singular values of the changed D(c) are equal are one step.

    Args:
        result: The result.
        reach: The rows.
        purpose: What they are to do.
        found: Sets of them, the best first.
        most: How many steps there are at most.
    """
    kind_of_row: dict[int, Kind] = {}

    def change(row: int) -> Change:
        return reach.change(int(reach.index[row]))

    def kinds(candidate: Candidate) -> tuple[Kind, ...]:
        """Of what kinds its rows are; equal for those that symmetry may make equal."""
        for row in candidate.members:
            if row not in kind_of_row:
                kind_of_row[row] = kind_of(result, change(row))
        return tuple(sorted(kind_of_row[row] for row in candidate.members))

    def are_equal(one: _Works, other: _Works) -> bool:
        """Whether symmetry may make two sets equal."""
        mine, others = one.candidate, other.candidate
        return (
            mine.rank == others.rank
            and kinds(mine) == kinds(others)
            and one.spectrum.shape == other.spectrum.shape
            and np.allclose(one.spectrum, other.spectrum, _EQUAL, _TINY)
        )

    groups = grouped(((one.rank, kinds(one)), one) for one in found[:_MOST_GROUPED])
    # How many analyses may be made.
    operations = float(result.rows) * result.columns * min(result.rows, result.columns)
    tries = _MOST_OPERATIONS / max(operations, 1.0)
    left = int(np.clip(tries, _FEWEST_TRIES, _MOST_TRIES))
    works: list[_Works] = []

    def is_good(candidate: Candidate) -> bool:
        nonlocal left
        left -= 1
        one = _tried(result, purpose, candidate, together(map(change, candidate.members)))
        works.extend(() if one is None else (one,))
        return one is not None

    good: list[list[Candidate]] = []
    for group in groups.values():
        if len(good) == most or not left:
            break
        good += [group] if is_good(group[0]) else []
    for turn in range(1, 1 + _MOST_ALTERNATIVES):
        for group in good:
            if turn < len(group) and left:
                is_good(group[turn])
    place = {candidate.members: i for i, candidate in enumerate(found)}
    works.sort(key=lambda one: place[one.candidate.members])
    alike: list[list[_Works]] = []
    for one in [one for one in works if one.is_certain] or works:
        equal = next((each for each in alike if are_equal(each[0], one)), None)
        if equal is None:
            alike.append([one])
        else:
            equal.append(one)
    return tuple(
        replace(first.step, alternatives=tuple(other.step.change for other in others))
        for first, *others in alike[:most]
    )


def _tried(result: Result, purpose: Purpose, candidate: Candidate, change: Change) -> _Works | None:
    """What came of a candidate; None where it does not do what it is to do."""
    try:
        made = analysed(result, change)
    except FlexactError:
        return None
    other = Purpose.DECLARE if purpose is Purpose.RELEASE else Purpose.RELEASE
    if left_of(purpose, made) or left_of(other, made) > left_of(other, result):
        return None
    step = Release(result, purpose, change, candidate.condition, after(made))
    spectrum = spectrum_of(made.with_internal_declared or made)
    return _Works(candidate, step, spectrum, removes_all(result, made, purpose))
