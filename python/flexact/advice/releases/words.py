# SPDX-License-Identifier: BSD-3-Clause
"""What is done to a part so that it lets a deformation go, or holds it, as a designer says it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...analysis.calls import HOLD, calls_of_change, method_of
from ...analysis.change import Change
from ...analysis.decomposition import Outcome
from ...analysis.deformation_words import bending_of, deformation_words, role_of
from ...analysis.naming import (
    Named,
    Piece,
    Pieces,
    coordinate_in_words,
    in_words,
    named_element,
    plain,
)
from ...analysis.places import end_words, listed, place_words, with_article
from ...analysis.result import Result
from ...analysis.ways import Coordinate, coordinate_of
from ...core.elements import AXES, Class, NodeKind, Role, coordinate_name, planar_table
from ...model.names import part_name
from ...model.parts.condensing import as_given
from ...model.parts.forms import Form
from ...model.parts.parts import Part, PartKind
from ...util.text import harmless
from ..step import Purpose, Step
from ..words import row_of

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


def outcome_as_given(result: Result) -> Outcome:
    """The outcome on the elements and nodes of the model as given, for words alone."""
    if not result.condensed.chains:
        return result
    return Outcome(result.name, as_given(result.given), result.raw, result.asked)


def released(outcome: Outcome, deformations: Iterable[Deformation]) -> tuple[Phrase, ...]:
    """What is done to release deformations, part by part.

    Args:
        outcome: That on the model as given; see `outcome_as_given`.
        deformations: What is released.
    """
    return tuple(
        phrase
        for part, mine in _by_part(outcome, deformations)
        for phrase in _of_part(outcome, part, mine)
    )


def held(outcome: Outcome, deformations: Iterable[Deformation]) -> tuple[Phrase, ...]:
    """What is done to hold released deformations, one by one."""
    return tuple(_held(outcome, *one) for one in deformations)


def _by_part(
    outcome: Outcome, deformations: Iterable[Deformation]
) -> Iterator[tuple[Part, list[Deformation]]]:
    """Deformations by part; those of a body by its members."""
    made: dict[tuple[Part, int], list[Deformation]] = {}
    for element, number in deformations:
        part = outcome.parts.of_element(outcome.data.element_index[element])
        member = element if part.kind is PartKind.BODY else 0
        made.setdefault((part, member), []).append((element, number))
    for (part, _), mine in made.items():
        yield part, mine


def _of_part(outcome: Outcome, part: Part, mine: list[Deformation]) -> Iterator[Phrase]:
    name = named_element(outcome, mine[0][0])
    if part.kind is PartKind.HINGE:
        yield from _of_hinge(outcome, part, name, mine)
        return
    if _holds_nothing_else(outcome, part, mine) and _can_go(outcome, part):
        yield _taken_out(outcome, part, name, mine)
        return
    in_plane = [one for one in mine if _is_in_plane(outcome, *one)]
    left = {_role(outcome, mine[0][0], number) for number in _held_without(outcome, part, mine)}
    is_wire = len(in_plane) == 2 and left == {Role.ELONGATION}
    if is_wire:
        yield Phrase(
            "replace ", name, " by a wire", "", " (in-plane bending free at both its ends)"
        )
    for one in mine:
        if one in in_plane and not is_wire:
            where = f" at {_place(outcome, part, *one)}"
            yield Phrase("cut ", name, " to a waist", where, " (in-plane bending free there)")
        elif one not in in_plane:
            yield _one(outcome, part, name, *one)


def _one(outcome: Outcome, part: Part, name: Named, element: int, number: int) -> Phrase:
    """A deformation that is no in-plane bending of a sheet."""
    if part.kind is PartKind.BODY:
        return _of_body(outcome, name, element, number)
    role, word = _role(outcome, element, number), _word(outcome, element, number)
    if role == Role.ELONGATION:
        # No notch, cut or fold frees this alone: a sheet with a fold holds one thing, not two.
        return Phrase("let ", name, " slide along its length", "", " (elongation free)")
    if role == Role.TORSION:
        return Phrase("make ", name, " soft in torsion", "", " (twist free)")
    if bending_of(outcome, outcome.data.element_index[element], number) is not None:
        kind = word.partition(" at ")[0]
        where, free = f" at {_place(outcome, part, element, number)}", f" ({kind} free there)"
        if part.kind is PartKind.SHEET and not _is_planar(outcome, element):
            return Phrase("let ", name, " bend out of its plane", where, free)
        return Phrase("give ", name, " a notch", where, free)
    return Phrase("let ", name, " give", "", f" ({word} free)")


def _of_body(outcome: Outcome, name: Named, element: int, number: int) -> Phrase:
    """A deformation of a rigid member, which is one of several of its body or the body itself."""
    index = outcome.data.element_index[element]
    role, word = _role(outcome, element, number), _word(outcome, element, number)
    own = harmless(part_name(outcome.data.element_names[index])).strip()
    between = ""
    if index in outcome.parts.links:
        nodes = (outcome.data.arrays.element_node[[0, 2], index] - 1).tolist()
        ends = dict.fromkeys(place_words(outcome.parts, node) for node in nodes if node >= 0)
        # A body is no place on itself.
        is_told = len(ends) == 2 and name.words not in ends
        between = f" between {' and '.join(ends)}" if is_told else ""
    elif own:
        name = name._replace(words=with_article(own))
    if role == Role.TORSION:
        return Phrase("make ", name, " soft in torsion", between)
    if role == Role.ELONGATION:
        return Phrase("make ", name, " soft along its length", between)
    if bending_of(outcome, index, number) is not None:
        kind, _, place = word.partition(" at ")
        axis = kind.removeprefix("bending")
        return Phrase("make ", name, " soft in bending", f"{axis}{between or f' at {place}'}")
    return Phrase("let ", name, " give", f" {word.removeprefix('displacement ')}{between}")


def _of_hinge(
    outcome: Outcome, part: Part, name: Named, mine: list[Deformation]
) -> Iterator[Phrase]:
    roles = {_role(outcome, *one) for one in mine}
    is_bearing = bool(roles & {Role.OFFSET_X, Role.OFFSET_Y, Role.OFFSET_Z})
    if _holds_nothing_else(outcome, part, mine) and len(mine) > 1 and _can_go(outcome, part):
        if is_bearing:
            yield Phrase("take ", name, " out")
        else:
            yield Phrase("replace ", name, " by a ball joint", "", " (all its rotations free)")
        return
    for one in mine:
        role, word = _role(outcome, *one), _word(outcome, *one)
        if role in (Role.ROTATION, Role.ANGLE):
            yield Phrase("let ", name, " turn", " about its axis" * (role == Role.ROTATION))
        elif role in (Role.TILT_Y, Role.TILT_Z):
            yield Phrase("let ", name, " tilt", word.removeprefix("tilt"))
        else:
            yield Phrase("let ", name, " slide", word.removeprefix("displacement"))


def _taken_out(outcome: Outcome, part: Part, name: Named, mine: list[Deformation]) -> Phrase:
    """A part that holds nothing else."""
    if len(mine) > 1:
        return Phrase("take ", name, " out")
    free = f" ({_word(outcome, *mine[0])} free)"
    if _role(outcome, *mine[0]) != Role.ELONGATION:
        return Phrase("take ", name, " out", "", free)
    is_bar = part.kind is PartKind.BAR
    instead = "make it adjustable in length" if is_bar else "let it slide along its length"
    return Phrase("take ", name, f" out, or {instead}", "", free)


def _holds_nothing_else(outcome: Outcome, part: Part, mine: Sequence[Deformation]) -> bool:
    """Whether these are all that a part, other than a body, holds."""
    return part.kind is not PartKind.BODY and not _held_without(outcome, part, mine)


def _held_without(outcome: Outcome, part: Part, mine: Sequence[Deformation]) -> list[int]:
    """What a part holds, or has declared, without some: deformations of one beam, from 1."""
    index = outcome.data.element_index
    row = next((c for c in outcome.data.chains if c.elements[0] == part.elements[0]), None)
    if row is None:
        classes = outcome.data.arrays.deformation_class[:, part.elements[0]].tolist()
        gone = {number for _, number in mine}
    else:
        # What one of its beams releases, a row of beams does not hold.
        classes = [max(each, key=_is_free) for each in zip(*row.classes, strict=True)]
        beams = [(row.elements.index(index[element]), number) for element, number in mine]
        gone = {row.own(beam, number) for beam, number in beams}
    return [
        k
        for k, given in enumerate(classes, 1)
        if k not in gone and given != Class.NONE and not _is_free(given)
    ]


def _can_go(outcome: Outcome, part: Part) -> bool:
    """Whether every node at an end of a part that can move is one of another part as well."""
    arrays = outcome.given.arrays
    slots = arrays.element_node - 1
    used = np.bincount(slots[slots >= 0], minlength=arrays.node_kind.size)
    own = slots[:, list(part.elements)]
    alone = [node for node in own[own >= 0].tolist() if used[node] == 1]
    classes = arrays.coordinate_class[:, alone]
    return not np.any((classes == Class.DEPENDENT) | (classes == Class.INDEPENDENT))


def _is_free(given: int) -> bool:
    return given == Class.DEPENDENT


def _held(outcome: Outcome, element: int, number: int) -> Phrase:
    """What is done to hold a released deformation."""
    index = outcome.data.element_index[element]
    part, name = outcome.parts.of_element(index), named_element(outcome, element)
    role, word = _role(outcome, element, number), _word(outcome, element, number)
    if part.kind is PartKind.HINGE:
        return Phrase("lock ", name, "", "", f" ({word} held)")
    if role == Role.TORSION:
        return Phrase("stiffen ", name, " against twist", "", " (twist held)")
    if role == Role.ELONGATION:
        return Phrase("make ", name, " stiff along its length", "", " (elongation held)")
    if bending_of(outcome, index, number) is not None:
        kind = word.partition(" at ")[0]
        where = f" at {_place(outcome, part, element, number)}"
        return Phrase("stiffen ", name, "", where, f" ({kind} held there)")
    return Phrase("stiffen ", name, "", "", f" ({word} held)")


def _word(outcome: Outcome, element: int, number: int) -> str:
    return deformation_words(outcome, outcome.data.element_index[element], number)


def _role(outcome: Outcome, element: int, number: int) -> int:
    return role_of(outcome, outcome.data.element_index[element], number)


def _is_planar(outcome: Outcome, element: int) -> bool:
    kind = outcome.data.arrays.element_kind[outcome.data.element_index[element]]
    return bool(planar_table()[kind])


def _is_in_plane(outcome: Outcome, element: int, number: int) -> bool:
    """Whether a deformation is the bending of a sheet in its own plane."""
    index = outcome.data.element_index[element]
    if outcome.parts.form[index] != Form.SHEET or _is_planar(outcome, element):
        return False
    bending = bending_of(outcome, index, number)
    return bending is not None and bending.word == "in-plane bending"


def _place(outcome: Outcome, part: Part, element: int, number: int) -> str:
    """The end at which a part bends."""
    bending = bending_of(outcome, outcome.data.element_index[element], number)
    if bending is None or bending.position not in part.ends:
        return "a place inside it"
    return place_words(outcome.parts, bending.position, part)


#: How many alternatives of several parts each are named, and how many of one part.
_MOST_SETS, _MOST_NAMED = 3, 11
#: Of more statements or calls it is told how many there are.
_MOST_STATEMENTS = 24
#: Parts that are counted in the plural.
_PLURALS = {str(kind): f"{kind}s" for kind in PartKind if kind is not PartKind.BODY}


@dataclass(frozen=True, eq=False, repr=False)
class Release(Step):
    """Deformations or coordinates of another class: released, freed, declared, or held."""

    def words(self) -> Pieces:
        """What is done, how, and where else symmetry makes it the same.

        Such as "cut sheet 1 to a waist at its clamp (in-plane bending free there) (RLSE 1 3);
        likewise sheet 2", or "declare E along y independent (DYNX 5 2), or hold it (FIX 5 2);
        likewise F along x".
        """
        outcome, purpose = outcome_as_given(self.analysis), self.purpose
        if purpose is Purpose.DECLARE and not self.change.deformations:
            return self._declared(outcome)
        phrases, *others = (
            _phrases(outcome, purpose, each) for each in (self.change, *self.alternatives)
        )
        if purpose is not Purpose.HOLD:
            is_freed = not self.change.deformations
            note = "" if is_freed else _statements(outcome, self.change, "RLSE")
        elif outcome.given.source is not None:
            note = _statements(outcome, self.change, "RLSE", "without ")
        else:
            note = _statements(outcome, self.change, HOLD)
        told = _told(phrases)
        return (*told, *((f" ({note})",) if note else ()), *_likewise(phrases, others))

    def _declared(self, outcome: Outcome) -> Pieces:
        """What is declared or held."""
        change = self.change
        declared, fixed = (_statements(outcome, change, word) for word in ("DYNX", "FIX"))
        it = "it" if len(change.coordinates) == 1 else "them"
        own, *others = (_coordinates(outcome, each) for each in (change, *self.alternatives))
        more = [each for each in others if plain(each) != plain(own)]
        pieces: list[Piece] = ["declare ", *own, " independent"]
        pieces.append(f" ({declared})" if declared else "")
        # To hold a fold that turns is to clamp it in mid-air.
        folds = outcome.carriers.between_ends.difference(outcome.carriers.inner)
        nodes = {outcome.given.node_index[place[0]] for place in change.coordinates}
        if not (self.analysis.folds and nodes <= folds):
            pieces.append(f", or hold {it}{f' ({fixed})' if fixed else ''}")
        if more:
            pieces += ["; likewise ", *_shortened(more, len(change.coordinates))]
        return tuple(piece for piece in pieces if piece)


def _phrases(outcome: Outcome, purpose: Purpose, change: Change) -> tuple[Phrase, ...]:
    deformations = [(element, number) for element, number, _ in change.deformations]
    made = (held if purpose is Purpose.HOLD else released)(outcome, deformations)
    return made + tuple(_freed(outcome, node, name) for node, name, _ in change.coordinates)


def _freed(outcome: Outcome, node: int, name: str) -> Phrase:
    """A support that lets a coordinate go."""
    where = coordinate_in_words(outcome, node, name)[0]
    assert isinstance(where, Named)
    where = where._replace(words=where.words + _which_end(outcome, node))
    if name.startswith("r"):
        return Phrase("let ", where, " turn", f" about {name[1:]}")
    return Phrase("let ", where, " slide", f" along {name}")


def _which_end(outcome: Outcome, node: int) -> str:
    """Where a support is, if the part that it holds has another that is called the same."""
    place = outcome.parts.place_of(outcome.given.node_index[node])
    here = () if place is None else outcome.parts.at(place)
    if place is None or len(here) != 1:
        return ""
    words, _, at = place_words(outcome.parts, place, here[0]).rpartition(" at (")
    return f" at ({at}" if words else ""


def _coordinates(outcome: Outcome, change: Change) -> Pieces:
    """Coordinates by their points and bodies; those inside of sheets and wires are counted."""
    names: dict[str, Named] = {}
    ways: dict[str, dict[str, list[str]]] = {}
    inside: dict[Part, int] = {}
    insides = {node: each.part for each in outcome.carriers.insides for node in each.nodes}
    own = {node for node, _ in outcome.carriers.own_ends}
    part_of = {node: part for node, part in insides.items() if node not in own}
    shared = _of_several_points(outcome, change)
    for node, name, _ in change.coordinates:
        index = outcome.given.node_index[node]
        if len(change.coordinates) > 1 and index in part_of:
            inside[part_of[index]] = inside.get(part_of[index], 0) + 1
            continue
        where = coordinate_in_words(outcome, node, name)[0]
        assert isinstance(where, Named)
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


def _of_several_points(outcome: Outcome, change: Change) -> dict[str, set[int]]:
    """Positions by what they are called, of those where several are called the same."""
    data = outcome.given.arrays
    called: dict[str, set[int]] = {}
    for node, name, _ in change.coordinates:
        if data.node_kind[outcome.given.node_index[node]] <= NodeKind.POSITION:
            where = coordinate_in_words(outcome, node, name)[0]
            assert isinstance(where, Named)
            called.setdefault(where.words, set()).add(node)
    return {words: nodes for words, nodes in called.items() if len(nodes) > 1}


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
        return (f"; likewise{at} ", *_named([each[0].part for each in others]))
    else:
        sets = [each[0].short for each in others]
    return (f"; likewise{at} ", *_shortened(sets, len(phrases)))


def _told(phrases: Sequence[Phrase]) -> Pieces:
    """What is done; where the same is done with several parts, the first of them in full."""
    groups: dict[tuple[str, ...], list[Phrase]] = {}
    for phrase in phrases:
        groups.setdefault((*phrase.frame, phrase.free), []).append(phrase)
    items: list[Pieces] = []
    for first, *more in groups.values():
        names = list(dict.fromkeys(phrase.short for phrase in more))
        rest = row_of(names, _MOST_NAMED)
        items.append((*first.pieces, *((", and so ", *rest) if rest else ())))
    return row_of(items)


def _shortened(sets: Sequence[Pieces], size: int) -> Pieces:
    """Alternatives, one behind the other; of many the first."""
    if size == 1:
        return row_of(sets, _MOST_NAMED)
    made: list[Piece] = []
    for k, each in enumerate(sets[:_MOST_SETS]):
        made += ["; or " if k else "", *each]
    more = len(sets) - _MOST_SETS
    return (*(piece for piece in made if piece), *((f"; or {more} more",) if more > 0 else ()))


def _named(parts: Sequence[Named]) -> Pieces:
    """Names, such as "sheets 2, 4 and 6"."""
    heads = {part.words.rpartition(" ")[0] for part in parts}
    numbers = [part.words.rpartition(" ")[2] for part in parts]
    head = heads.pop() if len(heads) == 1 else ""
    if len(parts) > 1 and head in _PLURALS and all(map(str.isdigit, numbers)):
        short = [
            (Named(part.kind, part.number, n),) for part, n in zip(parts, numbers, strict=True)
        ]
        return (f"{_PLURALS[head]} ", *row_of(short))
    return row_of([(part,) for part in parts])


def _statements(outcome: Outcome, change: Change, keyword: str, before: str = "") -> str:
    """Statements of a deck, or calls; empty where there is no call for one of them."""
    if outcome.given.source is not None:
        statements = [f"{keyword} {operands}" for operands in _operands(outcome, change)]
        if len(statements) > _MOST_STATEMENTS:
            return "" if keyword == "FIX" else f"{len(statements)} statements: --apply does it"
        return f"{before}{', '.join(statements)}"
    calls = [each.in_words() for each in calls_of_change(outcome, change, method_of(keyword))]
    if len(calls) > _MOST_STATEMENTS:
        return "" if keyword == "FIX" else f"{len(calls)} calls: apply() of the step does it"
    return ", ".join(calls)


def _operands(outcome: Outcome, change: Change) -> list[str]:
    """Numbers of elements and their deformations, and of nodes and their components."""
    of_element: dict[int, list[int]] = {}
    for element, number, _ in change.deformations:
        of_element.setdefault(element, []).append(number)
    made = [" ".join(map(str, (e, *sorted(mine)))) for e, mine in of_element.items()]
    of_node: dict[str, list[str]] = {}
    for node, name, _ in change.coordinates:
        place, component = coordinate_named(outcome, node, name).operands.split()
        of_node.setdefault(place, []).append(component)
    return made + [" ".join((node, *sorted(mine))) for node, mine in of_node.items()]


def coordinate_named(outcome: Outcome, node: int, name: str) -> Coordinate:
    """The coordinate of a name of a node, by the number of the node."""
    index = outcome.data.node_index[node]
    kind = int(outcome.data.arrays.node_kind[index])
    axis = next(axis for axis in AXES[kind] if coordinate_name(kind, axis) == name)
    return coordinate_of(outcome, index, axis)
