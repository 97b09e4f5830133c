# SPDX-License-Identifier: BSD-3-Clause
"""Declarations that are driven against a constraint, which makes a self-stress: to take back."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from ..analysis import ways as leverage
from ..analysis.change import Change
from ..analysis.order import row_key
from ..analysis.result import Result
from ..core.elements import Class, coordinate_name
from ..util.errors import FlexactError
from .proposal import Proposal, Purpose, tried

#: Of more self-stresses no sets are looked for; so many proposals there are at most.
_MOST_STRESSES, _MOST = 60, 4


def undeclarations_of(result: Result) -> tuple[Proposal, ...]:
    """What declarations can be taken back so that no self-stress is left, each tried.

    A single one where there is one self-stress, deformations or coordinates; else a set of
    deformations. None where what is declared takes no part in the self-stresses.
    """
    count = result.over_constrained
    if not 0 < count <= _MOST_STRESSES or result.stress_space.vectors < count:
        return ()
    made = (_tried(result, change, condition) for change, condition in _changes(result, count))
    return tuple(one for one in made if one is not None)[:_MOST]


def _changes(result: Result, count: int) -> Iterator[tuple[Change, float]]:
    if count == 1:
        deformations = leverage.driven_deformations(result)[:_MOST]
        yield from ((_of_deformations(result, [one]), 1.0) for one in deformations)
        coordinates = leverage.driven_coordinates(result)[:_MOST]
        yield from ((_of_coordinate(result, *one), 1.0) for one in coordinates)
        return
    rows = sorted(leverage.driven_set(result), key=partial(row_key, result))
    if len(rows) == count:
        block = result.stress_space.toarray()[rows]
        condition = 1.0 / float(np.linalg.svd(block, compute_uv=False)[-1])
        labels = [(e - 1, number) for e, number in result.raw.row_label[:, rows].T.tolist()]
        yield _of_deformations(result, labels), condition


def _of_deformations(result: Result, labels: leverage.Deformations) -> Change:
    numbers = result.given.arrays.element_number
    given = (result.condensed.in_given(*label) for label in labels)
    return Change(tuple((int(numbers[e]), number, Class.DEPENDENT) for e, number in given))


def _of_coordinate(result: Result, node: int, axis: int) -> Change:
    arrays = result.data.arrays
    name = coordinate_name(int(arrays.node_kind[node]), axis)
    return Change(coordinates=((int(arrays.node_number[node]), name, Class.DEPENDENT),))


def _tried(result: Result, change: Change, condition: float) -> Proposal | None:
    """The proposal, if no self-stress is left and nothing more moves."""
    try:
        then = tried(result, change)
    except FlexactError:
        return None
    if then.over_constrained or then.under_constrained > result.under_constrained:
        return None
    return Proposal(Purpose.UNDECLARE, change, condition, then)
