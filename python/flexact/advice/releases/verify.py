# SPDX-License-Identifier: BSD-3-Clause
"""Candidates are tried before they are said; those that symmetry makes equal are one proposal."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.result import Result
from ...analysis.sparse_basis import index_of
from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind
from ...util.errors import FlexactError
from ..proposal import After, Proposal, Purpose, after, analysed
from .candidates import Candidate, Kind, Reach, kind_of
from .counting import Left, joined, removes_all

#: Rows and columns of D(c) up to which bodies are taken as what they are.
_MOST = 250
_ZERO = 1.0e-9


def spectrum_of(result: Result) -> FloatArray:
    """Singular values of the scaled D(c) on motions that leave its bodies rigid.

    They do not depend on the links of which a body is made, but on its points alone. Of large
    models they are those of the scaled D(c) itself.
    """
    if max(result.rows, result.columns) > _MOST or not result.rows * result.columns:
        return result.scaled_singular_values
    matrix = _scaled(result)
    given = result.condensed.elements[result.raw.row_label[0] - 1].tolist()
    kinds = {i: result.parts.of_element(i).kind for i in set(given)}
    rigid = np.array([kinds[i] is PartKind.BODY for i in given], bool)
    if rigid.any():
        _, values, vectors = np.linalg.svd(matrix[rigid])
        rank = int(np.count_nonzero(values > _ZERO * values[0]))
        matrix = matrix[~rigid] @ vectors[rank:].T
    if not matrix.size:
        return np.zeros(0)
    return np.asarray(np.linalg.svd(matrix, compute_uv=False), np.float64)


def _scaled(result: Result) -> FloatArray:
    """(m, n) the matrix on which the rank is decided."""
    arrays, raw, whole = result.data.arrays, result.raw, result.assembly
    element, deformation = raw.row_label - 1
    node, axis = raw.column_label - 1
    row = index_of(6 * element + deformation, 6 * arrays.element_number.size)[whole.row_of]
    column = index_of(3 * node + axis, 3 * arrays.node_number.size)[whole.column_of]
    there = (row >= 0) & (column >= 0)
    made = np.zeros((result.rows, result.columns))
    np.add.at(made, (row[there], column[there]), whole.value[there])
    return made * raw.row_scale[:, None] * raw.column_scale


#: How many proposals there are at most.
MOST_SETS = 12
#: How many sets are looked at, in their order.
_MOST_GROUPED = 5_000
#: How many others of a group are tried.
_MOST_ALTERNATIVES = 35
#: How many analyses are made of a small mechanism, and of any; and operations in all.
_MOST_TRIES, _FEWEST_TRIES, _MOST_OPERATIONS = 100, 4, 6.0e10
#: Singular values that differ by less than this part, or by this, are equal.
_EQUAL, _TINY = 1.0e-6, 1.0e-9


class LeftOut(NamedTuple):
    """What was not looked at, or did not work."""

    untried: int = 0
    """Sets that look right and were not tried, of those that were looked at."""
    failed: int = 0
    """Sets that were tried and did not work."""
    doubtful: int = 0
    """Sets that work for the numbers as they are, though rounding may hide that they do not."""
    is_too_large: bool = False
    """Whether the model is so large that one set at most was looked for."""


class Outcome(NamedTuple):
    """What came of trying candidates."""

    proposals: tuple[Proposal, ...]
    left_out: LeftOut


#: Nothing was left out.
NOTHING_LEFT_OUT = LeftOut()


class _Try(NamedTuple):
    candidate: Candidate
    change: Change
    after: After
    spectrum: FloatArray
    is_certain: bool
    """Whether it does so however the geometry was rounded."""


def tries_of(result: Result) -> int:
    """How many analyses may be made."""
    operations = float(result.rows) * result.columns * min(result.rows, result.columns)
    return int(np.clip(_MOST_OPERATIONS / max(operations, 1.0), _FEWEST_TRIES, _MOST_TRIES))


def decades(condition: FloatArray) -> FloatArray:
    """(sets, 1) how many times ten each condition is worse than the best."""
    made: FloatArray = np.floor(np.log10(condition / condition.min()) + 1.0e-6)[:, None]
    return made


def listed(
    result: Result, reach: Reach, purpose: Purpose, found: list[Candidate], most: int = MOST_SETS
) -> Outcome:
    """The best sets of rows that work, each tried.

    First one of each group that may be equal is tried, then the others of these groups: those
    of which the singular values of the changed D(c) are equal are one proposal.

    Args:
        result: The result.
        reach: The rows.
        purpose: What they are to do.
        found: Sets of them, the best first.
        most: How many proposals there are at most.
    """
    ones = _Ones(result, reach)
    change, kinds = ones.change, ones.kinds
    groups: dict[Hashable, list[Candidate]] = {}
    for candidate in found[:_MOST_GROUPED]:
        groups.setdefault((candidate.rank, kinds(candidate)), []).append(candidate)
    left, failed = tries_of(result), 0
    works: list[_Try] = []
    good: list[list[Candidate]] = []
    for group in groups.values():
        if len(good) == most or not left:
            break
        left -= 1
        one = _tried(result, purpose, group[0], change(group[0]))
        if one is None:
            failed += 1
        else:
            works.append(one)
            good.append(group)
    for turn in range(1, 1 + _MOST_ALTERNATIVES):
        for group in good:
            if turn < len(group) and left:
                left -= 1
                one = _tried(result, purpose, group[turn], change(group[turn]))
                works += [] if one is None else [one]
                failed += one is None
    untried = len(found) - len(works) - failed
    place = {candidate.members: i for i, candidate in enumerate(found)}
    works.sort(key=lambda one: place[one.candidate.members])
    certain = [one for one in works if one.is_certain]
    doubtful = len(works) - len(certain) if certain else 0
    made = _together(purpose, certain or works, kinds)[:most]
    return Outcome(tuple(made), LeftOut(untried, failed, doubtful))


def _tried(result: Result, purpose: Purpose, candidate: Candidate, change: Change) -> _Try | None:
    """What came of a candidate; None where it does not do what it is to do."""
    try:
        made = analysed(result, change)
    except FlexactError:
        return None
    left = _left_of(purpose)
    if left(made) or _other(purpose, made) > _other(purpose, result):
        return None
    whole = made.with_internal_declared or made
    is_certain = removes_all(result, made, left)
    return _Try(candidate, change, after(made), spectrum_of(whole), is_certain)


class _Ones:
    """What is done with single rows, and of what kinds they are."""

    def __init__(self, result: Result, reach: Reach) -> None:
        self.result = result
        self.reach = reach
        self._change: dict[int, Change] = {}
        self._kind: dict[int, Kind] = {}

    def change(self, candidate: Candidate) -> Change:
        """What a candidate is."""
        return joined([self._one(row) for row in candidate.members])

    def kinds(self, candidate: Candidate) -> tuple[Kind, ...]:
        """Of what kinds it is; equal for those that symmetry may make equal."""
        for row in candidate.members:
            if row not in self._kind:
                self._kind[row] = kind_of(self.result, self._one(row))
        return tuple(sorted(self._kind[row] for row in candidate.members))

    def _one(self, row: int) -> Change:
        if row not in self._change:
            self._change[row] = self.reach.change(int(self.reach.index[row]))
        return self._change[row]


def _left_of(purpose: Purpose) -> Left:
    """What is left of what is to be removed."""
    if purpose is Purpose.RELEASE:
        return lambda one: one.over_constrained
    return lambda one: one.under_constrained


def _other(purpose: Purpose, result: Result) -> int:
    """What must not become more."""
    return result.under_constrained if purpose is Purpose.RELEASE else result.over_constrained


def _together(
    purpose: Purpose, works: Sequence[_Try], kinds: Callable[[Candidate], Hashable]
) -> list[Proposal]:
    made: list[list[_Try]] = []
    for one in works:
        equal = next((group for group in made if _are_equal(group[0], one, kinds)), None)
        if equal is None:
            made.append([one])
        else:
            equal.append(one)
    return [
        Proposal(
            *(purpose, first.change, first.candidate.condition, first.after),
            tuple(other.change for other in others),
        )
        for first, *others in made
    ]


def _are_equal(one: _Try, other: _Try, kinds: Callable[[Candidate], Hashable]) -> bool:
    """Whether symmetry may make two sets equal."""
    return (
        one.candidate.rank == other.candidate.rank
        and kinds(one.candidate) == kinds(other.candidate)
        and one.spectrum.shape == other.spectrum.shape
        and np.allclose(one.spectrum, other.spectrum, _EQUAL, _TINY)
    )
