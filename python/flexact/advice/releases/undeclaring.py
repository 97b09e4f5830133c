# SPDX-License-Identifier: BSD-3-Clause
"""Declarations that are driven against a constraint, which makes a self-stress: to take back."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import chain

import numpy as np

from ...analysis import ways
from ...analysis.calls import taken_back
from ...analysis.change import Change
from ...analysis.deformation_words import deformation_words
from ...analysis.mode_basis import row_key
from ...analysis.mode_words import joined
from ...analysis.naming import Pieces, coordinate_in_words, named_element
from ...analysis.result import Result
from ...analysis.ways import Coordinate, Deformation
from ...core.elements import Class, coordinate_name
from ...util.errors import FlexactError
from ..step import Purpose, Step, tried
from .words import coordinate_named, outcome_as_given

#: Of more self-stresses no sets are looked for; so many steps there are at most.
_MOST_STRESSES, _MOST = 60, 4


@dataclass(frozen=True, eq=False, repr=False)
class TakenBack(Step):
    """Declarations that are taken back."""

    def words(self) -> Pieces:
        """Such as "take back the declaration of sheet 1: ... (RLSE 1 5 instead of DYNE 1 5)"."""
        outcome, change = outcome_as_given(self.analysis), self.change
        what: list[Pieces] = [
            (
                named_element(outcome, element),
                f": {deformation_words(outcome, outcome.data.element_index[element], number)}",
            )
            for element, number, _ in change.deformations
        ]
        what += [coordinate_in_words(outcome, node, name) for node, name, _ in change.coordinates]
        if self.analysis.given.source is not None:
            notes = [f"RLSE {e} {k} instead of DYNE {e} {k}" for e, k, _ in change.deformations]
            for node, name, _ in change.coordinates:
                place = coordinate_named(self.analysis, node, name)
                notes.append(f"without DYNX {place.operands}")
        else:
            made = [taken_back(outcome, Deformation(e, k, "")) for e, k, _ in change.deformations]
            made += [
                taken_back(outcome, Coordinate(n, name, "")) for n, name, _ in change.coordinates
            ]
            notes = list(chain.from_iterable(made)) if all(made) else []
        is_one = len(what) == 1
        return (
            f"take back the declaration{'' if is_one else 's'} of ",
            *joined(what),
            ", which is driven against a constraint" if is_one else "",
            f" ({', '.join(notes)})" if notes else "",
        )


def undeclarations_of(result: Result) -> tuple[TakenBack, ...]:
    """What declarations can be taken back so that no self-stress is left, each tried.

    A single one where there is one self-stress, deformations or coordinates; else a set of
    deformations. None where what is declared takes no part in the self-stresses.
    """
    count = result.over_constrained
    if not 0 < count <= _MOST_STRESSES or result.stress_space.vectors < count:
        return ()
    made = []
    for change, condition in _changes(result, count):
        try:
            then = tried(result, change)
        except FlexactError:
            continue
        if not then.over_constrained and then.under_constrained <= result.under_constrained:
            made.append(TakenBack(result, Purpose.UNDECLARE, change, condition, then))
    return tuple(made[:_MOST])


def _changes(result: Result, count: int) -> Iterator[tuple[Change, float]]:
    """What may be taken back, and its condition."""
    if count == 1:
        for label in ways.driven_deformations(result)[:_MOST]:
            yield _of_deformations(result, [label]), 1.0
        arrays = result.data.arrays
        for node, axis in ways.driven_coordinates(result)[:_MOST]:
            name = coordinate_name(int(arrays.node_kind[node]), axis)
            place = int(arrays.node_number[node]), name, Class.DEPENDENT
            yield Change(coordinates=(place,)), 1.0
        return
    rows = sorted(ways.driven_set(result), key=partial(row_key, result))
    if len(rows) == count:
        block = result.stress_space.toarray()[rows]
        labels = [(e - 1, number) for e, number in result.raw.row_label[:, rows].T.tolist()]
        condition = 1.0 / float(np.linalg.svd(block, compute_uv=False)[-1])
        yield _of_deformations(result, labels), condition


def _of_deformations(result: Result, labels: ways.Deformations) -> Change:
    numbers = result.given.arrays.element_number
    given = (result.condensed.in_given(*label) for label in labels)
    return Change(tuple((int(numbers[e]), number, Class.DEPENDENT) for e, number in given))
