# SPDX-License-Identifier: BSD-3-Clause
"""Sets of releases and declarations verified: counted on the deck as given, tried, and grouped.

Sets are tried before they are said; those that symmetry makes equal are one step.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.decomposition import Asked, decompose
from ...analysis.result import Result
from ...analysis.verdict import Alternative, AnalysisError
from ...analysis.ways import entry_columns, entry_rows
from ...core.arrays import FloatArray
from ...model.data import ModelData
from ...model.parts.condensing import as_given
from ...model.parts.parts import PartKind
from ...util.errors import FlexactError
from ..step import Purpose, after, analysed, together
from .candidates import Candidate, Kind, Reach, kind_of
from .matroid import Judge, Rows, TooManyError, count_bases
from .words import Release

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
    known: dict[Rows, bool] = {}
    doubtful: set[Rows] = set()

    def judge(chosen: Rows) -> bool | None:
        if chosen not in known:
            tries = len(known) + 1
            if tries > _MOST_JUDGED or tries * stands.rows > _MOST_ROWS_JUDGED:
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
            found = count_bases(reach.rows, error, judge)
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
MOST_SETS = 12
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
    result: Result, reach: Reach, purpose: Purpose, found: list[Candidate], most: int = MOST_SETS
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

    groups: dict[Hashable, list[Candidate]] = {}
    for candidate in found[:_MOST_GROUPED]:
        groups.setdefault((candidate.rank, kinds(candidate)), []).append(candidate)
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
