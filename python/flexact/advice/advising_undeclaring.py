# SPDX-License-Identifier: BSD-3-Clause
"""Declarations to be taken back, in words."""

from __future__ import annotations

from itertools import chain

from ..analysis.advice_ways import Coordinate, Deformation, coordinate_of
from ..analysis.calls import taken_back
from ..analysis.deformation_words import deformation_words
from ..analysis.motions import joined
from ..analysis.naming import coordinate_in_words, named_element
from ..analysis.result import Result
from ..analysis.sentences import Pieces
from ..core.elements import AXES, coordinate_name
from .proposal import Proposal
from .releases.words import outcome_as_given


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
