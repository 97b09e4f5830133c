# SPDX-License-Identifier: BSD-3-Clause
"""What is done to a part so that it lets a deformation go, or holds it, as a designer says it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...analysis.calls import HOLD, calls_of_change, method_of
from ...analysis.change import Change
from ...analysis.decomposition import Decomposition
from ...analysis.naming import (
    Named,
    Piece,
    Pieces,
    in_words,
    named_element,
    named_node,
    plain,
    row_of,
    together_in_words,
)
from ...analysis.places import (
    bending_of,
    deformation_words,
    end_words,
    listed,
    place_words,
    role_of,
    with_article,
)
from ...analysis.result import Result
from ...analysis.ways import Coordinate, coordinate_of
from ...core.elements import AXES, Class, NodeKind, Role, coordinate_name, planar_table
from ...model.names import part_name
from ...model.parts.condensing import as_given
from ...model.parts.forms import Form
from ...model.parts.parts import Part, PartKind
from ...util.groups import grouped
from ...util.text import harmless
from ..step import Purpose, Step

#: Number of an element and a deformation of it, from 1, of the model as given.
Deformation = tuple[int, int]


class Phrase(NamedTuple):
    """What is done with a part: words before its name, the name, and words behind."""

    before: str
    part: Named
    what: str = ""
    where: str = ""
    """At which end, or about or along which axis."""
    free: str = ""
    """Which deformation it is."""

    @property
    def pieces(self) -> Pieces:
        """All of it."""
        return self.before, self.part, f"{self.what}{self.where}{self.free}"

    @property
    def short(self) -> Pieces:
        """The part and where, in a list of places where the same is done."""
        return (self.part, self.where) if self.where else (self.part,)

    @property
    def frame(self) -> tuple[str, str]:
        """What is the same where the same is done."""
        return self.before, self.what


def outcome_as_given(result: Result) -> Decomposition:
    """The outcome on the elements and nodes of the model as given, for words alone."""
    if not result.condensed.chains:
        return result
    return Decomposition(result.name, as_given(result.given), result.raw, result.asked)


#: Words before and behind the name of a part, and what is free or held then, by role.
_RELEASED = {
    # No notch, cut or fold frees this alone: a sheet with a fold holds one thing, not two.
    Role.ELONGATION: ("let ", " slide along its length", " (elongation free)"),
    Role.TORSION: ("make ", " soft in torsion", " (twist free)"),
}
_HELD = {
    Role.ELONGATION: ("make ", " stiff along its length", " (elongation held)"),
    Role.TORSION: ("stiffen ", " against twist", " (twist held)"),
}
_SOFT = {Role.ELONGATION: " soft along its length", Role.TORSION: " soft in torsion"}
#: What a hinge or a bearing does that is released.
_HINGE = {
    Role.ROTATION: " turn",
    Role.ANGLE: " turn",
    Role.TILT_Y: " tilt",
    Role.TILT_Z: " tilt",
}


class _Deformation:
    """A deformation of an element of the model as given, and what words are made of."""

    def __init__(self, outcome: Decomposition, element: int, number: int) -> None:
        """Of the number of an element, and of a deformation of it, from 1."""
        self.outcome, self.element, self.number = outcome, element, number
        self.index = outcome.data.element_index[element]
        self.part, self.name = outcome.parts.of_element(self.index), named_element(outcome, element)
        self.role = Role(role_of(outcome, self.index, number))
        self.word = deformation_words(outcome, self.index, number)
        self.bending = bending_of(outcome, self.index, number)
        self.is_planar = bool(planar_table()[outcome.data.arrays.element_kind[self.index]])

    @property
    def is_in_plane(self) -> bool:
        """Whether it is the bending of a sheet in its own plane."""
        is_sheet = self.outcome.parts.form[self.index] == Form.SHEET and not self.is_planar
        return is_sheet and self.bending is not None and self.bending.word == "in-plane bending"

    @property
    def place(self) -> str:
        """The end at which a part bends."""
        if self.bending is None or self.bending.position not in self.part.ends:
            return " at a place inside it"
        return f" at {place_words(self.outcome.parts, self.bending.position, self.part)}"

    def released(self) -> Phrase:
        """How it is released, of what is no hinge and no in-plane bending of a sheet."""
        if self.part.kind is PartKind.BODY:
            return self._of_body()
        if self.role in _RELEASED:
            before, what, free = _RELEASED[self.role]
            return Phrase(before, self.name, what, "", free)
        if self.bending is not None:
            free = f" ({self.word.partition(' at ')[0]} free there)"
            if self.part.kind is PartKind.SHEET and not self.is_planar:
                return Phrase("let ", self.name, " bend out of its plane", self.place, free)
            return Phrase("give ", self.name, " a notch", self.place, free)
        return Phrase("let ", self.name, " give", "", f" ({self.word} free)")

    def _of_body(self) -> Phrase:
        """Of a rigid member, which is one of several of its body or the body itself."""
        data, parts, name = self.outcome.data, self.outcome.parts, self.name
        between = ""
        if self.index in parts.links:
            nodes = (data.arrays.element_node[[0, 2], self.index] - 1).tolist()
            ends = dict.fromkeys(place_words(parts, node) for node in nodes if node >= 0)
            # A body is no place on itself.
            if len(ends) == 2 and name.words not in ends:
                between = f" between {' and '.join(ends)}"
        elif own := harmless(part_name(data.element_names[self.index])).strip():
            name = name._replace(words=with_article(own))
        if self.role in _SOFT:
            return Phrase("make ", name, _SOFT[self.role], between)
        if self.bending is not None:
            kind, _, place = self.word.partition(" at ")
            where = f"{kind.removeprefix('bending')}{between or f' at {place}'}"
            return Phrase("make ", name, " soft in bending", where)
        return Phrase("let ", name, " give", f" {self.word.removeprefix('displacement ')}{between}")

    def held(self) -> Phrase:
        """How it is held that is released."""
        if self.part.kind is PartKind.HINGE:
            return Phrase("lock ", self.name, "", "", f" ({self.word} held)")
        if self.role in _HELD:
            before, what, held = _HELD[self.role]
            return Phrase(before, self.name, what, "", held)
        if self.bending is not None:
            held = f" ({self.word.partition(' at ')[0]} held there)"
            return Phrase("stiffen ", self.name, "", self.place, held)
        return Phrase("stiffen ", self.name, "", "", f" ({self.word} held)")


def released(outcome: Decomposition, deformations: Iterable[Deformation]) -> Iterator[Phrase]:
    """What is done to release deformations, part by part; those of a body by its members.

    Args:
        outcome: That on the model as given; see `outcome_as_given`.
        deformations: What is released.
    """
    every = (_Deformation(outcome, *each) for each in deformations)
    by_part = grouped(
        ((one.part, one.element if one.part.kind is PartKind.BODY else 0), one) for one in every
    )
    for (part, _), mine in by_part.items():
        for one in mine:
            one.name = mine[0].name
        yield from _of_part(outcome, part, mine)


def _of_part(outcome: Decomposition, part: Part, mine: list[_Deformation]) -> Iterator[Phrase]:
    name, (first, *more) = mine[0].name, mine
    is_hinge, is_body = part.kind is PartKind.HINGE, part.kind is PartKind.BODY
    rest = [] if is_body else _held_without(outcome, part, mine)
    can_go = not is_body and not rest and _can_go(outcome, part)
    in_plane = [one for one in mine if one.is_in_plane]
    roles = {one.role for one in mine}
    is_wire = {role_of(outcome, first.index, number) for number in rest} == {Role.ELONGATION}
    if can_go and more and is_hinge and not roles & {Role.OFFSET_X, Role.OFFSET_Y, Role.OFFSET_Z}:
        yield Phrase("replace ", name, " by a ball joint", "", " (all its rotations free)")
    elif can_go and more:
        yield Phrase("take ", name, " out")
    elif is_hinge:
        for one in mine:
            what = _HINGE.get(one.role, " slide")
            where = one.word.removeprefix("tilt").removeprefix("displacement")
            if what == " turn":
                where = " about its axis" * (one.role == Role.ROTATION)
            yield Phrase("let ", name, what, where)
    elif can_go:
        out = " out"
        if first.role == Role.ELONGATION:
            is_bar = part.kind is PartKind.BAR
            out += ", or make it adjustable in length" if is_bar else _SLIDES
        yield Phrase("take ", name, out, "", f" ({first.word} free)")
    else:
        is_wire = is_wire and len(in_plane) == 2
        if is_wire:
            both = " (in-plane bending free at both its ends)"
            yield Phrase("replace ", name, " by a wire", "", both)
        for one in mine:
            if not one.is_in_plane:
                yield one.released()
            elif not is_wire:
                free = " (in-plane bending free there)"
                yield Phrase("cut ", name, " to a waist", one.place, free)


_SLIDES = ", or let it slide along its length"


def _held_without(outcome: Decomposition, part: Part, mine: Sequence[_Deformation]) -> list[int]:
    """What a part holds, or has declared, without some: deformations of one beam, from 1."""
    row = next((c for c in outcome.data.chains if c.elements[0] == part.elements[0]), None)
    if row is None:
        classes = outcome.data.arrays.deformation_class[:, part.elements[0]].tolist()
        gone = {one.number for one in mine}
    else:
        # What one of its beams releases, a row of beams does not hold.
        beams = zip(*row.classes, strict=True)
        classes = [max(each, key=lambda given: given == Class.DEPENDENT) for each in beams]
        gone = {row.own(row.elements.index(one.index), one.number) for one in mine}
    free = Class.NONE, Class.DEPENDENT
    return [k for k, given in enumerate(classes, 1) if k not in gone and given not in free]


def _can_go(outcome: Decomposition, part: Part) -> bool:
    """Whether every node at an end of a part that can move is one of another part as well."""
    arrays = outcome.given.arrays
    slots = arrays.element_node - 1
    used = np.bincount(slots[slots >= 0], minlength=arrays.node_kind.size)
    own = slots[:, list(part.elements)]
    alone = [node for node in own[own >= 0].tolist() if used[node] == 1]
    classes = arrays.coordinate_class[:, alone]
    return not np.any((classes == Class.DEPENDENT) | (classes == Class.INDEPENDENT))


#: How many alternatives of several parts each are named, and how many of one part.
_MOST_SETS, _MOST_NAMED = 3, 11
#: Of more statements or calls it is told how many there are.
MOST_STATEMENTS_WRITTEN = 24


@dataclass(frozen=True, eq=False, repr=False)
class Release(Step):
    """Deformations or coordinates of another class: released, freed, declared, or held."""

    def words(self) -> Pieces:
        """What is done, how, and where else symmetry makes it the same.

        Such as "cut sheet 1 to a waist at its clamp (in-plane bending free there) (RLSE 1 3);
        or instead sheet 2", or "declare E along y independent (DYNX 5 2), or hold it (FIX 5 2);
        or instead F along x".
        """
        outcome, purpose = outcome_as_given(self.analysis), self.purpose
        if purpose is Purpose.DECLARE and not self.change.deformations:
            return self._declared(outcome)
        phrases, *others = (
            _phrases(outcome, purpose, each) for each in (self.change, *self.alternatives)
        )
        told, note = self.in_short()
        return (*told, *((f" ({note})",) if note else ()), *_likewise(phrases, others))

    def in_short(self) -> tuple[Pieces, str]:
        """What is done, and the statements or calls that do it."""
        outcome, purpose = outcome_as_given(self.analysis), self.purpose
        if purpose is Purpose.DECLARE and not self.change.deformations:
            words = ("declare ", *coordinates_in_words(outcome, self.change))
            return words, statements_in_words(outcome, self.change, "DYNX")
        if purpose is not Purpose.HOLD:
            is_freed = not self.change.deformations
            note = "" if is_freed else statements_in_words(outcome, self.change, "RLSE")
        elif outcome.given.source is not None:
            note = statements_in_words(outcome, self.change, "RLSE", "without ")
        else:
            note = statements_in_words(outcome, self.change, HOLD)
        return _told(_phrases(outcome, purpose, self.change)), note

    def _declared(self, outcome: Decomposition) -> Pieces:
        """What is declared or held."""
        change = self.change
        declared, fixed = (statements_in_words(outcome, change, word) for word in ("DYNX", "FIX"))
        it = "it" if len(change.coordinates) == 1 else "them"
        own, *others = (
            coordinates_in_words(outcome, each) for each in (change, *self.alternatives)
        )
        more = [each for each in others if plain(each) != plain(own)]
        pieces: list[Piece] = ["declare ", *own, " independent"]
        pieces.append(f" ({declared})" if declared else "")
        # To hold a fold that turns is to clamp it in mid-air.
        folds = outcome.carriers.between_ends.difference(outcome.carriers.inner)
        nodes = {outcome.given.node_index[place[0]] for place in change.coordinates}
        if not (self.analysis.folds and nodes <= folds):
            pieces.append(f", or hold {it}{f' ({fixed})' if fixed else ''}")
        if more:
            pieces += ["; or instead ", *_shortened(more, len(change.coordinates))]
        return tuple(piece for piece in pieces if piece)


def _phrases(outcome: Decomposition, purpose: Purpose, change: Change) -> list[Phrase]:
    deformations = [(element, number) for element, number, _ in change.deformations]
    if purpose is Purpose.HOLD:
        made = [_Deformation(outcome, *one).held() for one in deformations]
    else:
        made = list(released(outcome, deformations))
    return made + [_freed(outcome, node, name) for node, name, _ in change.coordinates]


def _freed(outcome: Decomposition, node: int, name: str) -> Phrase:
    """A support that lets a coordinate go."""
    where = named_node(outcome, node)
    where = where._replace(words=where.words + _which_end(outcome, node))
    if name.startswith("r"):
        return Phrase("let ", where, " turn", f" about {name[1:]}")
    return Phrase("let ", where, " slide", f" along {name}")


def _which_end(outcome: Decomposition, node: int) -> str:
    """Where a support is, if the part that it holds has another that is called the same."""
    place = outcome.parts.place_of(outcome.given.node_index[node])
    here = () if place is None else outcome.parts.at(place)
    if place is None or len(here) != 1:
        return ""
    words, _, at = place_words(outcome.parts, place, here[0]).rpartition(" at (")
    return f" at ({at}" if words else ""


def coordinates_in_words(outcome: Decomposition, change: Change) -> Pieces:
    """Coordinates by their points and bodies; those inside of sheets and wires are counted."""
    names: dict[str, Named] = {}
    ways: dict[str, dict[str, list[str]]] = {}
    inside: dict[Part, int] = {}
    insides = {node: part for part, nodes in outcome.carriers.insides for node in nodes}
    own = {node for node, _ in outcome.carriers.own_ends}
    part_of = {node: part for node, part in insides.items() if node not in own}
    shared = _of_several_points(outcome, change)
    for node, name, _ in change.coordinates:
        index = outcome.given.node_index[node]
        if len(change.coordinates) > 1 and index in part_of:
            inside[part_of[index]] = inside.get(part_of[index], 0) + 1
            continue
        where = named_node(outcome, node)
        if where.words in shared and node in shared[where.words]:
            where = where._replace(words=end_words(outcome.parts, index))
        names.setdefault(where.words, where)
        turns = name.startswith("r")
        mine = ways.setdefault(where.words, {})
        mine.setdefault("about" if turns else "along", []).append(name[turns:])
    items: list[Pieces] = [
        (names[words], " and".join(f" {way} {listed(axes)}" for way, axes in mine.items()))
        for words, mine in ways.items()
    ]
    for part, count in inside.items():
        number = int(outcome.given.arrays.element_number[part.elements[0]])
        within = named_element(outcome, number)
        items.append((f"{in_words(count)} coordinate{'s' * (count > 1)} inside ", within))
    return row_of(items, _MOST_NAMED)


def _of_several_points(outcome: Decomposition, change: Change) -> dict[str, set[int]]:
    """Positions by what they are called, of those where several are called the same."""
    data = outcome.given.arrays
    called = grouped(
        (named_node(outcome, node).words, node)
        for node, _, _ in change.coordinates
        if data.node_kind[outcome.given.node_index[node]] <= NodeKind.POSITION
    )
    return {words: set(nodes) for words, nodes in called.items() if len(set(nodes)) > 1}


def _likewise(phrases: Sequence[Phrase], others: Sequence[Sequence[Phrase]]) -> Pieces:
    """Where the same may be done."""
    own = plain(row_of([phrase.pieces for phrase in phrases]))
    others = [each for each in others if plain(row_of([one.pieces for one in each])) != own]
    if not others:
        return ()
    frames = sorted(phrase.frame for phrase in phrases)
    if any(sorted(phrase.frame for phrase in each) != frames for each in others):
        sets = [row_of([phrase.pieces for phrase in each]) for each in others]
        return ("; just as well ", *_shortened(sets, 2))
    at = " at" if phrases[0].before in ("cut ", "give ") else ""
    every = [*phrases, *(phrase for each in others for phrase in each)]
    is_all_said = len({(phrase.frame, phrase.where) for phrase in every}) == 1
    if len(phrases) > 1:
        sets = [row_of(list(dict.fromkeys(phrase.short for phrase in each))) for each in others]
    elif is_all_said:
        return (
            f"; or instead{at} ",
            *together_in_words([each[0].part for each in others], last="or"),
        )
    else:
        sets = [each[0].short for each in others]
    return (f"; or instead{at} ", *_shortened(sets, len(phrases)))


def _told(phrases: Sequence[Phrase]) -> Pieces:
    """What is done; where the same is done with several parts, the first of them in full."""
    groups = grouped(((phrase.frame, phrase.free), phrase) for phrase in phrases)
    items: list[Pieces] = []
    for first, *more in groups.values():
        names = list(dict.fromkeys(phrase.short for phrase in more))
        rest = row_of(names, _MOST_NAMED)
        items.append((*first.pieces, *((", and so ", *rest) if rest else ())))
    return row_of(items)


def _shortened(sets: Sequence[Pieces], size: int) -> Pieces:
    """Alternatives, one behind the other; of many the first."""
    if size == 1:
        return row_of(sets, _MOST_NAMED, "or")
    made: list[Piece] = []
    for k, each in enumerate(sets[:_MOST_SETS]):
        made += ["; or " if k else "", *each]
    more = len(sets) - _MOST_SETS
    return (*(piece for piece in made if piece), *((f"; or {more} more",) if more > 0 else ()))


def statements_in_words(
    outcome: Decomposition, change: Change, keyword: str, before: str = ""
) -> str:
    """Statements of a deck, or calls; empty where there is no call for one of them."""
    return written(statements_of_change(outcome, change, keyword), outcome, before, keyword)


def statements_of_change(outcome: Decomposition, change: Change, keyword: str) -> list[str]:
    """Statements of a deck that begin with a keyword, or calls of Python that do the same."""
    if outcome.given.source is not None:
        return [f"{keyword} {operands}" for operands in _operands(outcome, change)]
    return [each.in_words() for each in calls_of_change(outcome, change, method_of(keyword))]


def written(
    made: Sequence[str], outcome: Decomposition, before: str = "", keyword: str = ""
) -> str:
    """Statements or calls in a row; of many how many there are, but of what may be held."""
    if len(made) <= MOST_STATEMENTS_WRITTEN:
        return before + ", ".join(made) if made else ""
    if keyword == "FIX":
        return ""
    if outcome.given.source is not None:
        return f"{len(made)} statements: --apply does it"
    return f"{len(made)} calls: apply() of the step does it"


def _operands(outcome: Decomposition, change: Change) -> list[str]:
    """Numbers of elements and their deformations, and of nodes and their components."""
    of_element = grouped((element, number) for element, number, _ in change.deformations)
    made = [" ".join(map(str, (e, *sorted(mine)))) for e, mine in of_element.items()]
    of_node: dict[str, list[str]] = {}
    for node, name, _ in change.coordinates:
        place, component = coordinate_named(outcome, node, name).operands.split()
        of_node.setdefault(place, []).append(component)
    return made + [" ".join((node, *sorted(mine))) for node, mine in of_node.items()]


def coordinate_named(outcome: Decomposition, node: int, name: str) -> Coordinate:
    """The coordinate of a name of a node, by the number of the node."""
    index = outcome.data.node_index[node]
    kind = int(outcome.data.arrays.node_kind[index])
    axis = next(axis for axis in AXES[kind] if coordinate_name(kind, axis) == name)
    return coordinate_of(outcome, index, axis)
