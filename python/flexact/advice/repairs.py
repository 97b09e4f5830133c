# SPDX-License-Identifier: BSD-3-Clause
"""The designer's repair: few statements, each of which does one thing to equal parts.

A statement releases the same at every part of an orbit (six struts, both sheets of a guide, every
second arm), changes one part, or leaves limbs out. Over the (n, k) rows of an orthonormal basis of
the self-stresses, statements leave no self-stress and free no motion exactly when their rows span
the k vectors and are k more than the columns of D(c) that go with what is left out. Motions that
are there besides are declared of bodies, as one more statement.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from itertools import chain
from typing import NamedTuple

import numpy as np

from ..analysis.calls import calls_of
from ..analysis.change import Change
from ..analysis.naming import Named, Pieces, named_element, row_of, together_in_words
from ..analysis.places import axis_words, part_words, place_words
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..analysis.ways import Step as Way
from ..analysis.ways import is_of_class, on_motions, rows_of
from ..core.arrays import FloatArray, IntArray
from ..core.elements import Class, Role, role_table
from ..deck.tokens import DeckComments
from ..model.editing import edited_to_the_letter
from ..model.parts.forms import AT_P, AT_Q, PLANAR, XZ
from ..model.parts.parts import Part, PartKind, natural, surplus_of
from ..model.writing import dynamics_of, statements_of
from ..util.errors import FlexactError
from ..util.groups import grouped, groups_of
from .causes.lines import Limb as LimbOfParts
from .causes.lines import Limbs
from .causes.realignment import change_of
from .releases.candidates import complete, fits
from .releases.releases import Called, TakenBack, called_of, called_of_place, coordinate_sets
from .releases.words import (
    Release,
    coordinates_in_words,
    outcome_as_given,
    released,
    statements_of_change,
    written,
)
from .step import Purpose, Step, after, analysed, together

#: Of more self-stresses, or more parts that carry them, no repair of few statements is looked for.
_MOST_STRESSES, _MOST_PARTS = 250, 400
#: How many statements a repair has at most.
MOST_STATEMENTS = 4
#: How many repairs are given, how many are tried, and how many of one kind.
_MOST_REPAIRS, _MOST_TRIED, _MOST_ALIKE = 3, 8, 3
#: Singular values below this of rows of an orthonormal basis are none.
_LEAST = 1.0e-6
#: Nor are those of many limbs below this, so that their block is a good one.
_CLEARLY = 1.0e-2
#: How many sets of statements are looked at, operations of all, and sets that are enough.
_MOST_SETS, _MOST_OPERATIONS, _ENOUGH = 6_000, 6.0e8, 24
#: Of an orbit of more parts the outermost are changed one by one.
_MOST_SINGLES = 8


class Hardware(IntEnum):
    """What is done to a part, the likeliest first."""

    WAIST = 0
    TWIST = 1
    WIRE = 2
    OUT = 3
    RELEASE = 4
    FOLD = 5
    SLIDE = 6


class Alike(IntEnum):
    """Which parts of an orbit are changed, the most regular first; one part is twice `SOME`."""

    ALL = 0
    GUIDE = 1
    SOME = 2
    ONE = 4
    REST = 5


#: A deformation of an element or a coordinate of a node, by their numbers, and its class.
Place = tuple[int, int | str, Class]
#: A body, or the point where parts meet that are on none, by its index; None is the ground.
Carrier = tuple[str, int] | None


class Limb(NamedTuple):
    """Flexible parts in a row, with the bodies between them that nothing else holds."""

    parts: tuple[Part, ...]
    elements: tuple[int, ...]
    """Indices in the model as given."""
    rows: tuple[int, ...]
    """Rows of D(c) that go with it."""
    columns: int
    """How many columns of D(c) go with it."""


class Flexure(NamedTuple):
    """A flexible part that carries self-stresses, and what it holds."""

    part: Part
    carriers: tuple[Carrier, Carrier]
    """What carries its ends, that nearer to the ground first."""
    positions: tuple[int, int]
    """Position nodes of these ends, by their indices in the model as given; -1 of none."""
    middle: tuple[float, ...]
    """Its middle [m]."""
    orbit: tuple[object, ...]
    """Equal for parts that are equal."""
    held: dict[tuple[str, int], int]
    """Rows of D(c) that it holds, by what they are and the end, 0 or 1, or -1."""
    limb: Limb


class Statement(NamedTuple):
    """One thing done to one part or to several equal ones."""

    hardware: Hardware
    what: str
    """What is released, where the hardware does not say it."""
    end: int
    """At which ends: 0 nearer to the ground, 1 farther, -1 of none."""
    alike: Alike
    flexures: tuple[int, ...]
    rows: tuple[int, ...]
    """Rows of D(c) that it releases."""
    size: int
    """How many self-stresses it removes."""


@dataclass(frozen=True, eq=False, repr=False)
class Repair(Step):
    """Few statements that make a mechanism exactly constrained.

    Attributes:
        told: What each statement does, within a sentence.
        how: Statements of a deck, or calls, that do it; empty where there are none for all of it.
        note: What else does the same, as a sentence without its full stop.
        effect: What is released and declared, also where limbs are left out.
    """

    told: tuple[Pieces, ...] = ()
    how: str = ""
    note: str = ""
    effect: frozenset[Place] = frozenset()

    def words(self) -> Pieces:
        """Such as "declare the inner stage along y and cut sheets 1 and 3 to a waist each"."""
        note = f". {self.note}" if self.note else ""
        return (*row_of(self.told), f" ({self.how})" if self.how else "", note)


def _inside_in_words(result: Result, left_out: Collection[int]) -> Iterator[tuple[str, list[str]]]:
    """What declares insides and folds, and the statements or calls that do.

    Not of elements that are left out.
    """
    is_deck, whole = result.given.source is not None, result
    numbers = result.given.arrays.element_number
    if result.with_internal_declared is not None:
        whole = result.with_internal_declared
        inside = [
            " ".join(map(str, (int(numbers[element]), *mine)))
            for element, mine in surplus_of(result.given)
            if int(numbers[element]) not in left_out
        ]
        made = [f"DYNE {each} instead of RLSE {each}" for each in inside]
        how = made if is_deck else ["model.declare_internal_motions()"]
        if how:
            yield "declare what is inside the divided parts", how
    for way in on_motions(whole) if whole.folds else ():
        if way.step is Way.DECLARE_FOLDS:
            parts = [each for each in way.parts if int(each.operands.split()[0]) not in left_out]
            made = [f"DYNE {each.operands} instead of RLSE {each.operands}" for each in parts]
            if not is_deck:
                made = [call for part in parts for call in calls_of(whole, way, part)]
            if made:
                yield "declare the folds", made


def _gone(result: Result, left_out: Sequence[int]) -> list[str] | None:
    """How elements are left out: statements of a deck that go, or calls.

    None where the deck speaks of them elsewhere, too, as a picture block does.
    """
    given = result.given
    if given.source is not None:
        changed = Change(left_out=tuple(left_out)).apply(given).data
        if edited_to_the_letter(given, changed) is None:
            return None
        before, behind = (
            [*dict(statements_of(each)).values(), *dynamics_of(each, DeckComments())]
            for each in (given, changed)
        )
        gone = (words.split() for words in before if words not in set(behind))
        return [" ".join(words[:2]) for words in gone]
    parts = dict.fromkeys(result.parts.of_element(given.element_index[n]) for n in left_out)
    names = [*(part.name for part in result.parts.all), *given.node_names]
    unique = {part: part.name for part in parts if part.is_named and names.count(part.name) == 1}
    numbers = given.arrays.element_number
    calls = [
        each
        for part in parts
        for each in ([f'"{unique[part]}"'] if part in unique else numbers[list(part.elements)])
    ]
    return [f"model.delete({each}, ends=True)" for each in calls]


def _how(result: Result, pieces: Sequence[list[str]], left_out: Sequence[int]) -> str:
    """Statements or calls that do it; empty where there are none for a piece of it."""
    if not all(pieces):
        return ""
    made = list(chain.from_iterable(pieces))
    gone = _gone(result, left_out) if left_out else []
    if gone is None:
        return "--apply does it"
    if gone and result.given.source is not None:
        gone[0] = f"without {gone[0]}"
    return written([*made, *gone], result)


#: Statements, and the inverse of the smallest singular value of their rows.
Plan = tuple[tuple[Statement, ...], float]


def repairs_of(result: Result) -> Iterator[Repair]:
    """Repairs of at most four statements that make a mechanism exactly constrained, the best first.

    Each was tried. None where one part changed in one way does it: sets of releases tell these,
    with all places where it may be done.
    """
    base, before = _one_beam_each(result)
    if base is None:
        return
    coordinates = Change()
    if base.under_constrained:
        reach, found = coordinate_sets(base)
        if not found:
            return
        # Those of bodies come first, also where those of other points are ten times as clear; what
        # a body has declared already is not said again of another point.
        known = _declared_of_bodies(base)
        best = min(
            found,
            key=lambda one: (
                one.rank[0] > 1.0,
                len(known.intersection(called_of(base, reach, one))),
                *one.rank[1:],
            ),
        )
        coordinates = together(reach.change(int(reach.index[i])) for i in best.members)
    declared = together((before, coordinates))
    is_left = declared != Change()
    purpose = Purpose.REPAIR if is_left else Purpose.RELEASE
    workshop = _Workshop(base)
    # Of repairs that differ in ends and in parts alone one is enough.
    by_kind = grouped(
        (tuple((one.hardware, one.alike) for one in plan[0]), plan)
        for plan in workshop.plans(MOST_STATEMENTS - is_left)
    )
    best_kinds = next(iter(by_kind), ())
    if not is_left and len(best_kinds) == 1:
        ((hardware, alike),) = best_kinds
        if alike is Alike.ONE and hardware is not Hardware.OUT:
            return
    made, tries = 0, 0
    for same in by_kind.values():
        for plan, condition in same[:_MOST_ALIKE]:
            if made == _MOST_REPAIRS or tries == _MOST_TRIED:
                return
            tries += 1
            step = _tried(result, purpose, (before, coordinates), workshop, plan, condition)
            if step is not None:
                yield step
                made += 1
                break


def _tried(
    result: Result,
    purpose: Purpose,
    declared: tuple[Change, Change],
    workshop: _Workshop,
    plan: tuple[Statement, ...],
    condition: float,
) -> Repair | None:
    """The repair that statements are; None where it does not leave it exactly constrained."""
    change = together((*declared, *(workshop.change_of(each) for each in plan)))
    outcome, coordinates = outcome_as_given(result), declared[1]
    inside = list(_inside_in_words(result, change.left_out))
    told: list[Pieces] = [(each,) for each, _ in inside]
    pieces = [each for _, each in inside]
    if coordinates.coordinates:
        told.append(("declare ", *coordinates_in_words(outcome, coordinates)))
        pieces.append(statements_of_change(outcome, coordinates, "DYNX"))
    told += [workshop.words_of(each) for each in workshop.merged(plan)]
    # What else stands there declares insides and folds.
    releases = Change(tuple(each for each in change.deformations if each[2] is Class.DEPENDENT))
    if releases.deformations:
        base = outcome_as_given(workshop.base)
        pieces.append(statements_of_change(base, releases, "RLSE"))
    how = _how(result, pieces, change.left_out)
    made = _if_exact(result, change, tuple(told), how, condition)
    if not made:
        return None
    note = next(filter(None, map(workshop.note_on, plan)), "")
    whole = together((*declared, *(workshop.released_by(each) for each in plan)))
    effect = frozenset[Place]((*whole.deformations, *whole.coordinates))
    return replace(made[0], purpose=purpose, effect=effect, note=note)


def turned_alike(result: Result) -> tuple[Repair, ...]:
    """Equal groups of limbs that meet at points of a body, each turned by 90 degrees.

    Such as the vees of a kinematic mount. Each is turned about the line in the middle of its
    limbs; given where that makes the mechanism exactly constrained.
    """
    if result.verdict is not Verdict.BOTH or not result.is_told_by_parts:
        return ()
    limbs, made = Limbs(result), list[Repair]()
    for _, ends in limbs.hubs:
        at = grouped((position, limb) for limb, position in ends)
        groups = [(position, mine) for position, mine in at.items() if len(mine) > 1]
        orbits = grouped((_shape(limbs, *one), one) for one in groups)
        for orbit in orbits.values() if len(orbits) < _MOST_TRIED else ():
            turns = [_turn(limbs, *one) for one in orbit]
            changes = [
                change_of(result, limb, axis, limbs.place(position), math.pi / 2)
                for (position, mine), axis in zip(orbit, turns, strict=True)
                for limb in mine
                if axis is not None
            ]
            known = [each for each in changes if each is not None]
            if len(orbit) < 2 or len(known) < sum(len(mine) for _, mine in orbit):
                continue
            made += _if_exact(result, together(known), (_turned_in_words(limbs, orbit, turns),))
    return tuple(made)


#: A position node where limbs meet, and they.
_Group = tuple[int, list[LimbOfParts]]


def _shape(limbs: Limbs, position: int, mine: list[LimbOfParts]) -> tuple[object, ...]:
    """Equal for groups that are equal."""
    ways = np.array([_way(limbs, position, limb) for limb in mine])
    lengths = np.linalg.norm(ways, axis=1)
    angles = (ways @ ways.T) / np.outer(lengths, lengths)
    rounded = [float(f"{value:.6g}") for value in sorted(lengths.tolist())]
    return len(mine), *rounded, *np.sort(np.round(angles, 6).ravel()).tolist()


def _way(limbs: Limbs, position: int, limb: LimbOfParts) -> FloatArray:
    """(3,) from where a limb meets others to its other end [m]."""
    other = next((end for end in limb.ends if end != position), position)
    return limbs.place(other) - limbs.place(position)


def _turn(limbs: Limbs, position: int, mine: list[LimbOfParts]) -> FloatArray | None:
    """(3,) unit vector in the middle of limbs; None where there is none."""
    ways = [_way(limbs, position, limb) for limb in mine]
    if not all(map(np.linalg.norm, ways)):
        return None
    middle = np.sum([way / np.linalg.norm(way) for way in ways], axis=0)
    size = float(np.linalg.norm(middle))
    return middle / size if size > _LEAST else None


def _turned_in_words(
    limbs: Limbs, orbit: Sequence[_Group], turns: Sequence[FloatArray | None]
) -> Pieces:
    """Such as "turn vees 1 to 3 by 90 degrees, each about the line along z through its point"."""
    outcome = limbs.outcome
    shared = [_shared_name([limb.name for limb in mine]) for _, mine in orbit]
    each = "each"
    if all(shared):
        numbers = [mine[0].parts[0].number for _, mine in orbit]
        names = [Named("element", *both) for both in zip(numbers, shared, strict=True)]
    else:
        every = [limb for _, mine in orbit for limb in mine]
        names = [Named("element", limb.parts[0].number, limb.name) for limb in every]
        each = "each pair" if len(every) == 2 * len(orbit) else "all at one point"
    axes = {axis_words(axis) for axis in turns if axis is not None}
    along = f" along {axes.pop()}" if len(axes) == 1 else " in the middle of its limbs"
    hub = outcome.parts.body_at.get(orbit[0][0])
    on = f" on {part_words(outcome.parts.of_body(hub))}" if hub is not None else ""
    line = f" by 90 degrees, {each} about the line{along} through its point{on}"
    return ("turn ", *together_in_words(names), line)


def _shared_name(names: Sequence[str]) -> str:
    """What names share: "vee 1" of "contact 1 of vee 1", "strut 2" of "strut 2, upper"; or none."""
    for shared in ({n.rpartition(" of ")[2] for n in names}, {n.partition(",")[0] for n in names}):
        if len(shared) == 1:
            return shared.pop()
    return ""


def _if_exact(
    result: Result,
    change: Change,
    told: tuple[Pieces, ...],
    how: str = "",
    condition: float = 1.0,
) -> tuple[Repair, ...]:
    """What a change is as a repair, if it makes the mechanism exactly constrained."""
    try:
        then = analysed(result, change)
    except FlexactError:
        return ()
    if then.verdict is not Verdict.EXACT:
        return ()
    effect = frozenset[Place]((*change.deformations, *change.coordinates))
    step = result, Purpose.REPAIR, change, condition, after(then)
    return (Repair(*step, told=told, how=how, effect=effect),)


def best_together(
    result: Result,
    taken_back: Sequence[TakenBack],
    sets: Callable[[], tuple[Sequence[Release], Sequence[Release]]],
) -> tuple[Repair, ...]:
    """What takes self-stresses away and what declares motions, as one step, if that makes it exact.

    Args:
        result: The analysis.
        taken_back: Declarations to take back.
        sets: Gives sets of releases, and of declarations.
    """
    releases, declarations = sets()
    both = [each[0] for each in (declarations, taken_back or releases) if each]
    if len(both) < 2:
        return ()
    condition = max(each.condition for each in both)
    told, how = zip(*(each.in_short() for each in both), strict=True)
    statements = ", ".join(how) if all(how) else ""
    return _if_exact(result, together(each.change for each in both), told, statements, condition)


def _declared_of_bodies(base: Result) -> set[Called]:
    """What coordinates are called that are declared."""
    nodes, axes = np.nonzero(base.data.arrays.coordinate_class.T == Class.INDEPENDENT)
    return {
        called_of_place(base, *place) for place in zip(nodes.tolist(), axes.tolist(), strict=True)
    }


def _one_beam_each(result: Result) -> tuple[Result | None, Change]:
    """The result with insides and folds declared, and what declares them.

    None where it has no self-stress, where not all of them are at hand, or they are too many.
    """
    before, base, numbers = Change(), result, result.given.arrays.element_number
    if result.with_internal_declared is not None:
        base = result.with_internal_declared
        inside = (
            (int(numbers[element]), each, Class.INDEPENDENT)
            for element, mine in surplus_of(result.given)
            for each in mine
        )
        before = Change(tuple(inside))
    if base.with_folds_declared is not None:
        folds = (base.condensed.in_given(*place) for place in base.folds)
        before = together(
            (before, Change(tuple((int(numbers[e]), k, Class.INDEPENDENT) for e, k in folds)))
        )
        base = base.with_folds_declared
    if not 0 < base.over_constrained <= _MOST_STRESSES or not base.is_told_by_parts:
        return None, before
    base = complete(base)
    is_whole = base.stress_space.vectors == base.over_constrained and fits(base.stress_space)
    return (base if is_whole else None), before


# What may be done --------------------------------------------------------------------


class _Workshop:
    """The flexures of a mechanism that carry self-stresses, and what may be done to them."""

    def __init__(self, base: Result) -> None:
        self.base = base
        self.element = base.condensed.elements[base.raw.row_label[0] - 1]
        rows, support = rows_of(base.stress_space)
        self.rows = np.zeros((base.rows, rows.shape[1]))
        self.rows[support] = rows
        self.flexures = _flexures(base, self.element, support.tolist())

    def change_of(self, statement: Statement) -> Change:
        """What a statement does to the model as given."""
        if statement.hardware is Hardware.OUT:
            numbers = self.base.given.arrays.element_number
            limbs = dict.fromkeys(self.flexures[k].limb for k in statement.flexures)
            return Change(left_out=tuple(int(numbers[i]) for limb in limbs for i in limb.elements))
        return self.released_by(statement)

    def merged(self, plan: Sequence[Statement]) -> list[Statement]:
        """The statements as they are told: what is left out first, what is the same as one."""
        order = sorted(plan, key=lambda one: one.hardware is not Hardware.OUT)
        same = grouped(
            ((one.hardware, one.what, one.end, k if one.end >= 0 else -1), one)
            for k, one in enumerate(order)
        )
        return [
            mine[0]._replace(flexures=tuple(sorted(k for one in mine for k in one.flexures)))
            for mine in same.values()
        ]

    def released_by(self, statement: Statement) -> Change:
        """What a statement releases, of the model as given."""
        numbers = self.base.given.arrays.element_number
        places = ((self.base.raw.row_label[:, row] - (1, 0)).tolist() for row in statement.rows)
        given = (self.base.condensed.in_given(*place) for place in places)
        return Change(tuple((int(numbers[e]), own, Class.DEPENDENT) for e, own in given))

    def plans(self, most: int) -> list[Plan]:
        """Sets of so many statements that leave no self-stress: of as few as can be."""
        statements = self.statements()
        size = self.rows.shape[1]
        left = int(min(_MOST_SETS, _MOST_OPERATIONS / (20.0 * size**3 + 1.0)))
        apart: dict[tuple[int, int], bool] = {}

        def smallest(chosen: Sequence[int], count: int) -> float:
            """The smallest singular value of so many, of the rows of some statements."""
            nonlocal left
            left -= 1
            rows = [row for k in chosen for row in statements[k].rows]
            return _singular(self.rows[rows], count)

        def are_apart(one: int, other: int) -> bool:
            """Whether two statements remove as much together as one by one."""
            a, b = statements[one], statements[other]
            if not set(a.flexures).isdisjoint(b.flexures):
                return False
            if (one, other) not in apart:
                apart[one, other] = smallest((one, other), a.size + b.size) > _LEAST
            return apart[one, other]

        def sets(chosen: tuple[int, ...], rest: int, more: int) -> Iterator[tuple[int, ...]]:
            """Statements that remove the rest together, in their order."""
            for k in range(chosen[-1] + 1 if chosen else 0, len(statements)):
                mine = statements[k].size
                fits_in = mine == rest if more == 1 else mine < rest
                if left <= 0 or not fits_in or not all(are_apart(one, k) for one in chosen):
                    continue
                if more == 1:
                    yield (*chosen, k)
                else:
                    yield from sets((*chosen, k), rest - mine, more - 1)

        for count in range(1, most + 1):
            found = []
            for chosen in sets((), size, count):
                value = smallest(chosen, size)
                if value > _LEAST:
                    found.append((tuple(statements[k] for k in chosen), 1.0 / value))
                if len(found) == _ENOUGH or left <= 0:
                    break
            if found:
                return sorted(found, key=_rank)
        return []

    def statements(self) -> list[Statement]:
        """All that remove as many self-stresses as they release rows, the likeliest first."""
        made: dict[tuple[int, ...], Statement] = {}
        actions = [_actions(one) for one in self.flexures]
        for alike, chosen in _selections(self.flexures):
            for action in actions[chosen[0]]:
                every = [actions[k].get(action) for k in chosen]
                taken = tuple(dict.fromkeys(chain.from_iterable(each or () for each in every)))
                size = len(taken)
                if action[0] is Hardware.OUT:
                    limbs = dict.fromkeys(self.flexures[k].limb for k in chosen)
                    if len(limbs) < len(chosen):
                        continue
                    size -= sum(limb.columns for limb in limbs)
                if alike is Alike.REST and action[0] is not Hardware.OUT:
                    continue
                if None in every or not 0 < size <= self.rows.shape[1]:
                    continue
                one = Statement(*action, alike, chosen, taken, size)
                known = made.get(tuple(sorted(taken)))
                if known is None and _singular(self.rows[list(taken)], size) > _LEAST:
                    made[tuple(sorted(taken))] = one
        for one in self._but_few():
            made.setdefault(tuple(sorted(one.rows)), one)
        return sorted(
            made.values(), key=lambda one: (one.alike, one.hardware, one.end, one.flexures)
        )

    def _but_few(self) -> Iterator[Statement]:
        """Of limbs of one kind as many left out as can be, the first ones being kept."""
        by_kind = grouped((one.part.kind, k) for k, one in enumerate(self.flexures))
        for some in by_kind.values():
            chosen, rows, size = list[int](), list[int](), 0
            spanned = np.zeros((self.rows.shape[1], 0))
            limbs = {self.flexures[k].limb: k for k in reversed(some)}
            for limb, k in sorted(limbs.items(), key=lambda each: -each[1]):
                off = self.rows[list(limb.rows)].T
                off = off - spanned @ (spanned.T @ off)
                left, values, _ = np.linalg.svd(off, full_matrices=False)
                new = int(np.count_nonzero(values > _CLEARLY))
                if new != len(limb.rows) - limb.columns:
                    continue
                spanned = np.concatenate([spanned, left[:, :new]], axis=1)
                chosen, rows, size = [k, *chosen], [*rows, *limb.rows], size + new
            if len(chosen) > 1:
                yield Statement(Hardware.OUT, "", -1, Alike.REST, tuple(chosen), tuple(rows), size)

    def words_of(self, statement: Statement) -> Pieces:
        """What a statement does, within a sentence."""
        base, hardware = self.base, statement.hardware
        flexures = [self.flexures[k] for k in statement.flexures]
        if hardware is Hardware.RELEASE:
            places = [(e, k) for e, k, _ in self.change_of(statement).deformations]
            return row_of([each.pieces for each in released(outcome_as_given(base), places)])
        named = [named_element(base, one.part.number) for one in flexures]
        if hardware is Hardware.OUT:
            limbs = dict.fromkeys(one.limb for one in flexures)
            named = [
                Named(
                    "element",
                    limb.parts[0].number,
                    _shared_name([part.name for part in limb.parts])
                    or " with ".join(part.name for part in limb.parts),
                )
                for limb in limbs
                if len(limb.parts) > 1
            ] or named
        many = len(flexures) > 1
        before, behind = _WORDS[hardware]
        if statement.end < 0:
            return (before, *together_in_words(named), behind[many])
        at_ends = [
            place_words(base.parts, one.positions[statement.end], one.part) for one in flexures
        ]
        by_place = grouped(zip(at_ends, named, strict=True))
        heads = {place.rpartition(" ")[0] for place in by_place}
        if len(by_place) > _MOST_PLACES or len(heads) < len(by_place):
            where = {one.carriers[statement.end] for one in flexures}
            ends = f"the ends {('nearer to', 'farther from')[statement.end]} the ground"
            at = _CLAMPS[1] if where == {None} else ends
            return (before, *together_in_words(named), behind[many], f" at {at}")
        items: list[Pieces] = []
        for place, mine in by_place.items():
            at = place.replace(*_CLAMPS) if len(mine) > 1 else place
            verb = behind[len(mine) > 1] if not items else ""
            items.append((*together_in_words(mine), f"{verb} at {at}"))
        return (before, *row_of(items))

    def note_on(self, statement: Statement) -> str:
        """What may stand for the one sheet of an orbit that is not left out."""
        orbit = self.flexures[statement.flexures[0]].orbit
        same = [k for k, one in enumerate(self.flexures) if one.orbit == orbit]
        kept = [self.flexures[k] for k in same if k not in statement.flexures]
        if statement.alike is not Alike.REST or len(kept) != 1:
            return ""
        if kept[0].part.kind is not PartKind.SHEET or len(kept[0].held) != 3:
            return ""
        words = f"Three wires in the plane of {part_words(kept[0].part)} do as well"
        places = self.base.parts.data.arrays.node_value[:3]
        ends = [places[:, self.flexures[k].positions].T for k in same]
        if not _meet(np.array(ends)):
            return f"{words} where they neither meet in one point nor are parallel"
        carrier = kept[0].carriers[1]
        body = "what they hold"
        if carrier is not None and carrier[0] == "body":
            body = part_words(self.base.parts.of_body(carrier[1]))
        return (
            f"{words}, but not along all these lines: they meet in one point, and {body} can turn"
        )


#: So many places are named one by one.
_MOST_PLACES = 2
_CLAMPS = "its clamp", "their clamps"
#: Words before and behind the names of what is changed, of one and of several.
_WORDS = {
    Hardware.WAIST: ("cut ", (" to a waist", " to a waist each")),
    Hardware.TWIST: ("make ", (" soft in torsion", " soft in torsion")),
    Hardware.WIRE: ("replace ", (" by a wire", " by wires")),
    Hardware.OUT: ("leave out ", ("", "")),
    Hardware.FOLD: (
        "replace ",
        (" by a folded sheet with its fold", " by folded sheets with folds"),
    ),
    Hardware.SLIDE: ("let ", (" slide along its length", " slide along their lengths")),
}


def _meet(ends: FloatArray) -> bool:
    """Whether lines between (n, 2, 3) ends meet in one point."""
    way = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(way, axis=1)
    across = np.eye(3) - way[:, :, None] * way[:, None, :] / length[:, None, None] ** 2
    point = np.linalg.lstsq(across.sum(axis=0), np.einsum("nij,nj->i", across, ends[:, 0]))[0]
    off = np.linalg.norm(np.einsum("nij,nj->ni", across, ends[:, 0] - point), axis=1)
    return bool(off.max() < _LEAST * length.max())


def _rank(plan: Plan) -> tuple[float, ...]:
    """By what plans of as many statements are sorted."""
    statements, condition = plan
    return (
        sum(one.alike for one in statements),
        sum(one.hardware for one in statements),
        math.floor(2.0 * math.log10(condition) + 1.0e-6),
        sum(len(one.flexures) for one in statements),
        round(math.log10(condition), 6),
    )


def _singular(block: FloatArray, count: int) -> float:
    """The singular value of a place, counted from the largest as 1; 0 where there is none."""
    if min(block.shape) < count:
        return 0.0
    return float(np.linalg.svd(block, compute_uv=False)[count - 1])


#: Rows that are released at a part, by what is done, what is released, and at which end.
_Actions = dict[tuple[Hardware, str, int], tuple[int, ...]]


def _actions(flexure: Flexure) -> _Actions:
    """What may be done to a part."""
    held, made = flexure.held, _Actions()
    length = held.get(("length", -1))
    plane = [held[place] for end in (0, 1) if (place := ("in-plane bending", end)) in held]
    # A sheet that holds its twist, too, is more than a wire or a folded sheet stands for.
    is_plain = len(held) == 3 == len(plane) + (length is not None)
    for (what, end), row in held.items() if len(held) > 1 else ():
        hardware = _HARDWARE.get(what, Hardware.RELEASE)
        made[hardware, what if hardware is Hardware.RELEASE else "", end] = (row,)
        if hardware is Hardware.WAIST and is_plain and length is not None:
            made[Hardware.FOLD, "", end] = (length, row)
    if is_plain:
        made[Hardware.WIRE, "", -1] = tuple(plane)
    made[Hardware.OUT, "", -1] = flexure.limb.rows
    return made


_HARDWARE = {
    "in-plane bending": Hardware.WAIST,
    "twist": Hardware.TWIST,
    "length": Hardware.SLIDE,
}


def _selections(flexures: Sequence[Flexure]) -> Iterator[tuple[Alike, tuple[int, ...]]]:
    """Which equal parts may be changed alike, each set once."""
    known: set[tuple[int, ...]] = set()
    sides = _sides(flexures)
    for orbit in grouped((one.orbit, k) for k, one in enumerate(flexures)).values():
        guides = list(grouped((_ends(flexures[k]), k) for k in orbit).values())
        by_side = list(grouped((sides[k], k) for k in orbit).values())
        made: list[tuple[Alike, list[int]]] = [(Alike.ALL, orbit)] if len(orbit) > 1 else []
        made += [(Alike.GUIDE, some) for some in (*by_side, *guides) if len(some) > 1]
        for some in (orbit, *by_side):
            mine = [[k for k in guide if k in some] for guide in guides]
            several = [guide for guide in mine if guide]
            if len(several) > 1 and all(len(guide) > 1 for guide in several):
                made += [(Alike.SOME, [guide[place] for guide in several]) for place in (0, -1)]
                # Of every second guide the last part, of the others the first.
                made.append((Alike.SOME, [guide[-(k % 2)] for k, guide in enumerate(several)]))
        for some in (orbit, *guides):
            if len(some) > 3:
                made += [(Alike.SOME, some[0::2]), (Alike.SOME, some[1::2])]
        singles = orbit
        if len(orbit) > _MOST_SINGLES:
            singles = sorted({orbit[0], orbit[1], _farthest(flexures, orbit), orbit[-1]})
        made += [(Alike.ONE, [k]) for k in singles]
        for some in (orbit, *guides):
            if len(some) < 3:
                continue
            first, far = some[0], _farthest(flexures, some)
            for kept in ({first}, {some[-1]}, {first, far}, {first, some[-1]}, {first, some[1]}):
                made.append((Alike.REST, [k for k in some if k not in kept]))
        for alike, some in made:
            if some and tuple(some) not in known:
                known.add(tuple(some))
                yield alike, tuple(some)


def _ends(flexure: Flexure) -> tuple[str, ...]:
    """Both carriers of a part, in one order."""
    return tuple(sorted(map(str, flexure.carriers)))


def _farthest(flexures: Sequence[Flexure], some: Sequence[int]) -> int:
    """The part that lies farthest from the first."""
    return max(some, key=lambda k: (_apart(flexures[some[0]], flexures[k]), -k))


def _apart(one: Flexure, other: Flexure) -> float:
    return float(np.round(np.linalg.norm(np.subtract(one.middle, other.middle)), 12))


def _sides(flexures: Sequence[Flexure]) -> list[int]:
    """Of each flexure a number of its side: what hangs together without ground and main body."""
    away = _distances([one.carriers for one in flexures])
    ends = [carrier for one in flexures for carrier in one.carriers if carrier is not None]
    main = max(
        ends, key=lambda carrier: (away.get(carrier, math.inf), ends.count(carrier)), default=None
    )
    at = grouped((c, k) for k, one in enumerate(flexures) for c in one.carriers)
    pairs = ((mine[0], k) for c, mine in at.items() if c not in (None, main) for k in mine)
    made: list[int] = groups_of(len(flexures), pairs).tolist()
    return made


def _distances(both: Iterable[tuple[Carrier, Carrier]]) -> dict[Carrier, int]:
    """How many flexures each carrier is away from the ground."""
    beside = grouped(pair for a, b in both for pair in ((a, b), (b, a)))
    away: dict[Carrier, int] = {None: 0}
    front = deque[Carrier]((None,))
    while front:
        one = front.popleft()
        for other in beside.get(one, ()):
            if other not in away:
                away[other] = away[one] + 1
                front.append(other)
    return away


def _flexures(base: Result, element: IntArray, stressed: Sequence[int]) -> tuple[Flexure, ...]:
    """The flexible parts that carry self-stresses, by name; none where they are too many.

    Args:
        base: The analysis.
        element: (rows,) index of the element of each row of D(c), in the model as given.
        stressed: Rows that self-stresses reach.
    """
    parts, given = base.parts, element.tolist()
    carrying = {part for row in stressed if (part := parts.of_element(given[row]))}
    if len(carrying) > _MOST_PARTS:
        return ()
    rows: dict[Part, list[int]] = {}
    for row in np.flatnonzero(is_of_class(base, Class.FIXED)).tolist():
        if (part := parts.of_element(given[row])).kind is not PartKind.BODY:
            rows.setdefault(part, []).append(row)
    index, deformation = base.raw.row_label - 1
    kinds = base.data.arrays.element_kind[index]
    roles = role_table()[kinds, deformation].tolist()
    ends = {part: _ends_of(base, part, int(index[mine[0]])) for part, mine in rows.items()}
    limbs, made = _limbs(base, ends, element), list[Flexure]()
    away = _distances(carriers for carriers, _ in ends.values())
    for part, mine in rows.items():
        if part not in carrying:
            continue
        carriers, positions = ends[part]
        if is_turned := away.get(carriers[0], math.inf) > away.get(carriers[1], math.inf):
            carriers, positions = carriers[::-1], positions[::-1]
        wide = int(parts.wide[part.elements[0]])
        held = {_what(roles[row], wide, is_turned): row for row in mine}
        if len(held) < len(mine):
            # Of several beams that are not one a designer changes nothing alone.
            held = {}
        places = base.given.arrays.node_value[:3, [n for n in positions if n >= 0]]
        length = float(np.linalg.norm(places[:, 0] - places[:, -1])) if places.size else 0.0
        orbit = part.kind.value, int(kinds[mine[0]]), *sorted(held), float(f"{length:.6g}")
        middle = tuple(places.mean(axis=1).tolist()) if places.size else (0.0, 0.0, 0.0)
        made.append(Flexure(part, carriers, positions, middle, orbit, held, limbs[part]))
    return tuple(sorted(made, key=lambda one: (natural(one.part.name), one.part.elements)))


def _what(role: int, wide: int, is_turned: bool) -> tuple[str, int]:
    """What a deformation is, and at which end: 0 nearer to the ground, 1 farther, -1 at none."""
    if role in (Role.ELONGATION, Role.TORSION):
        return ("length" if role == Role.ELONGATION else "twist"), -1
    if role not in AT_P and role not in AT_Q:
        return f"{Role(role).name.lower()}", -1
    end = int((role in AT_Q) != is_turned)
    if role in PLANAR:
        return "bending", end
    in_plane = wide == (2 if role in XZ else 1)
    return ("in-plane bending" if in_plane else f"bending {'xz' if role in XZ else 'xy'}"), end


#: What carries both ends of a part, and their position nodes.
_Ends = tuple[tuple[Carrier, Carrier], tuple[int, int]]


def _ends_of(base: Result, part: Part, index: int) -> _Ends:
    """Both ends of a part, by one of its elements in the model as analysed."""
    nodes = (
        int(base.condensed.nodes[n - 1]) if n else -1
        for n in base.data.arrays.element_node[:, index].tolist()
    )
    p, op, q, oq = nodes
    return (_carrier(base, p, op), _carrier(base, q, oq)), (p, q)


def _carrier(base: Result, position: int, orientation: int) -> Carrier:
    parts = base.parts
    body = parts.body_at.get(orientation, parts.body_at.get(position))
    if body is None:
        nodes = [node for node in (position, orientation) if node >= 0]
        return None if all(map(parts.is_held, nodes)) else ("joint", nodes[0])
    own = parts.bodies[body]
    is_held = any(map(parts.is_held, own.positions)) and any(map(parts.is_held, own.orientations))
    return None if is_held else ("body", body)


def _limbs(base: Result, ends: dict[Part, _Ends], element: IntArray) -> dict[Part, Limb]:
    """The limb that each part is in."""
    parts, arrays = base.parts, base.given.arrays
    at = grouped((carrier, part) for part, (both, _) in ends.items() for carrier in both)
    fixed_or_declared = np.isin(arrays.coordinate_class, (Class.FIXED, Class.INDEPENDENT))
    stated = set(np.flatnonzero(fixed_or_declared.any(axis=0)).tolist())

    def inside(carrier: Carrier) -> tuple[int, ...]:
        """The nodes of what carries."""
        if carrier is None:
            return ()
        kind, index = carrier
        if kind == "joint":
            return (index, *parts.orientations_at.get(index, ()))
        return (*parts.bodies[index].positions, *parts.bodies[index].orientations)

    between = {
        carrier
        for carrier, mine in at.items()
        if carrier is not None and len(set(mine)) == 2 and stated.isdisjoint(inside(carrier))
    }
    order = {part: k for k, part in enumerate(ends)}
    pairs = [(order[one], order[other]) for one, other in (at[c] for c in between)]
    rows = grouped((parts.of_element(i), row) for row, i in enumerate(element.tolist()))
    used = arrays.element_node - 1
    made: dict[Part, Limb] = {}
    for mine in grouped(zip(groups_of(len(order), pairs).tolist(), order, strict=True)).values():
        outer = [c for part in mine for c in ends[part][0] if c not in between]
        # A body that only hangs between the ground and itself is the body that is held.
        is_row = len(outer) == 2 and outer[0] != outer[1]
        for some in [mine] if is_row else [[part] for part in mine]:
            inner = {c for part in some for c in ends[part][0] if c in between} if is_row else set()
            bodies = [parts.of_body(c[1]) for c in inner if c is not None and c[0] == "body"]
            own = [*some, *bodies]
            elements = tuple(i for part in own for i in part.elements)
            others = np.delete(used, elements, axis=1)
            alone = np.setdiff1d(used[:, elements], others)
            columns = np.isin(base.condensed.nodes[base.raw.column_label[0] - 1], alone)
            limb = Limb(
                tuple(some),
                elements,
                tuple(r for part in own for r in rows[part]),
                int(columns.sum()),
            )
            made.update(dict.fromkeys(some, limb))
    return made
