# SPDX-License-Identifier: BSD-3-Clause
"""What can be done about motions and self-stresses, as values: which step, with which parts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import Enum
from itertools import islice
from typing import NamedTuple

from ..core.elements import AXES, NodeKind, coordinate_name
from ..model.parts.declaring import surplus_of
from . import ways as leverage
from .decomposition import Outcome
from .result import Result

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
    yield from _if_any(_internal(result))
    whole = result.with_folds_declared
    if whole is not None:
        folds = tuple(_deformations(result, list(result.folds)))
        yield Way(Step.DECLARE_FOLDS, folds, False, ("DYNE", "RLSE"), True)
        yield from on_motions(whole)
        return
    able = _coordinates(result, _of_columns(result, leverage.coordinates(result)))
    yield _some(Step.DECLARE_OR_HOLD, able, ("DYNX", "FIX"))
    changed = _deformations(result, leverage.deformations(result))
    yield from _if_any(_some(Step.DECLARE_OR_HOLD_RELEASED, changed, ("DYNE", "RLSE"), True))
    if 1 < result.under_constrained <= _MOST_PARTS:
        every = _coordinates(result, _of_columns(result, leverage.coordinate_set(result)))
        yield from _if_any(_some(Step.DECLARE_OR_HOLD_ALL, every))


def on_self_stresses(result: Result) -> Iterator[Way]:
    """What may be released, freed or taken away so that there are fewer self-stresses."""
    if not result.over_constrained:
        return
    able = _deformations(result, _of_rows(result, leverage.releases(result)))
    yield from _if_any(_some(Step.RELEASE, able, ("RLSE",)))
    driven = _some(
        Step.UNDECLARE, _deformations(result, leverage.driven_deformations(result)), ("RLSE",), True
    )
    moved = _some(Step.UNDECLARE, _coordinates(result, leverage.driven_coordinates(result)))
    both = driven._replace(parts=driven.parts + moved.parts, more=driven.more or moved.more)
    yield from _if_any(both)
    held = _coordinates(result, leverage.supports(result))
    yield from _if_any(_some(Step.FREE_SUPPORT, held))
    count = result.over_constrained
    chosen = leverage.release_set(result) if 1 < count <= _MOST_PARTS else []
    if len(chosen) == count > 1:
        yield _some(Step.RELEASE_ALL, _deformations(result, _of_rows(result, chosen)))


def _some(
    step: Step, parts: Iterable[Part], keywords: tuple[str, ...] = (), instead: bool = False
) -> Way:
    some = tuple(islice(parts, _MOST_PARTS + 1))
    return Way(step, some[:_MOST_PARTS], len(some) > _MOST_PARTS, keywords, instead)


def _internal(result: Result) -> Way:
    """What makes each divided sheet or wire one beam, as far as a deck or model does not yet."""
    numbers = result.given.arrays.element_number
    parts = tuple(
        Deformation(number, deformations[0], " ".join(map(str, (number, *deformations))))
        for element, deformations in surplus_of(result.given)
        for number in (int(numbers[element]),)
    )
    return Way(Step.DECLARE_INTERNAL, parts, False, ("DYNE",), instead=True)


def _if_any(advice: Way) -> Iterator[Way]:
    if advice.parts:
        yield advice


def _of_columns(result: Result, chosen: list[int]) -> leverage.Coordinates:
    """Node index and axis of columns of D(c)."""
    return [(n, a) for n, a in (result.raw.column_label[:, chosen].T - 1).tolist()]


def _of_rows(result: Result, chosen: list[int]) -> leverage.Deformations:
    """Element index and number of the deformation of rows of D(c)."""
    return [(i - 1, mode) for i, mode in result.raw.row_label[:, chosen].T.tolist()]


def _coordinates(result: Result, places: leverage.Coordinates) -> Iterator[Coordinate]:
    return (coordinate_of(result, *place) for place in places)


def coordinate_of(result: Outcome, node: int, axis: int) -> Coordinate:
    """The coordinate of a node along or about an axis, both by their index from 0."""
    arrays = result.data.arrays
    kind, number = int(arrays.node_kind[node]), int(arrays.node_number[node])
    first = 2 if kind == NodeKind.ORIENTATION else 1  # behind the first Euler parameter
    operands = f"{number} {AXES[kind].index(axis) + first}"
    return Coordinate(number, coordinate_name(kind, axis), operands)


def _deformations(result: Result, places: leverage.Deformations) -> Iterator[Deformation]:
    numbers, given = result.data.arrays.element_number, result.given.arrays.element_number
    for index, mode in places:
        element, own = result.condensed.in_given(index, mode)
        yield Deformation(int(numbers[index]), mode, f"{given[element]} {own}")
