# SPDX-License-Identifier: BSD-3-Clause
"""What is done to a part so that it lets a deformation go, or holds it, as a designer says it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...analysis.decomposition import Outcome
from ...analysis.deformation_words import bending_of, deformation_words, role_of
from ...analysis.naming import named_element
from ...analysis.places import place_words, with_article
from ...analysis.result import Result
from ...analysis.sentences import Named, Pieces
from ...core.elements import Class, Role, planar_table
from ...model.names import part_name
from ...model.parts.condensing import as_given
from ...model.parts.forms import Form
from ...model.parts.parts import Part, PartKind
from ...util.plain_text import harmless

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
