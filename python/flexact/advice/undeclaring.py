# SPDX-License-Identifier: BSD-3-Clause
"""Declarations that are driven against a constraint, which makes a self-stress: to take back."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import chain

import numpy as np

from ..analysis import ways as leverage
from ..analysis.calls import taken_back
from ..analysis.change import Change
from ..analysis.deformation_words import deformation_words
from ..analysis.mode_basis import row_key
from ..analysis.mode_words import joined
from ..analysis.naming import Pieces, coordinate_in_words, named_element
from ..analysis.result import Result
from ..analysis.ways import Coordinate, Deformation, coordinate_of
from ..core.elements import AXES, Class, coordinate_name
from ..util.errors import FlexactError
from .proposal import Proposal, Purpose, tried
from .releases.words import outcome_as_given

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


def undeclaration_in_words(result: Result, proposal: Proposal) -> Pieces:
    """Such as "take back the declaration of sheet 1: ... (RLSE 1 5 instead of DYNE 1 5)"."""
    outcome, change = outcome_as_given(result), proposal.change
    what: list[Pieces] = [
        (
            named_element(outcome, element),
            f": {deformation_words(outcome, outcome.data.element_index[element], number)}",
        )
        for element, number, _ in change.deformations
    ]
    what += [coordinate_in_words(outcome, node, name) for node, name, _ in change.coordinates]
    s = "s" if len(what) > 1 else ""
    note = _note(result, proposal) if result.given.source is not None else _calls(result, proposal)
    return (
        f"take back the declaration{s} of ",
        *joined(what),
        ", which is driven against a constraint" if not s else "",
        f" ({note})" if note else "",
    )


def _calls(result: Result, proposal: Proposal) -> str:
    """The calls that do it; empty where there is none for one of them."""
    outcome, change = outcome_as_given(result), proposal.change
    made = [taken_back(outcome, Deformation(e, k, "")) for e, k, _ in change.deformations]
    made += [taken_back(outcome, Coordinate(n, name, "")) for n, name, _ in change.coordinates]
    return ", ".join(chain.from_iterable(made)) if all(made) else ""


def _note(result: Result, proposal: Proposal) -> str:
    """What becomes of the statements of a deck."""
    change = proposal.change
    made = [f"RLSE {e} {k} instead of DYNE {e} {k}" for e, k, _ in change.deformations]
    for node, name, _ in change.coordinates:
        index = result.data.node_index[node]
        kind = int(result.data.arrays.node_kind[index])
        axis = next(axis for axis in AXES[kind] if coordinate_name(kind, axis) == name)
        made.append(f"without DYNX {coordinate_of(result, index, axis).operands}")
    return ", ".join(made)
