# SPDX-License-Identifier: BSD-3-Clause
"""What is done to a part so that it lets a deformation go, or holds it, as a designer says it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from ...core.elements import Class, Role, planar_table
from ...model.parts.condensing import as_given
from ...model.parts.forms import Form
from ...model.parts.parts import Part, PartKind
from ...result.outcome import Outcome
from ...result.result import Result
from ..deformation import bending_of, deformation_words, role_of
from ..naming import named_element
from ..places import place_words
from ..sentences import Named, Pieces

#: Number of an element and a deformation of it, from 1, of the model as given.
Deformation = tuple[int, int]


class Phrase(NamedTuple):
    """What is done with a part: words before its name, the name, and words behind."""

    before: str
    part: Named
    behind: str

    @property
    def pieces(self) -> Pieces:
        """All of it."""
        return self.before, self.part, self.behind

    @property
    def frame(self) -> tuple[str, str]:
        """The words around the name: the same where the same is done."""
        return self.before, self.behind


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
    roles = [_role(outcome, *one) for one in mine]
    if _holds_nothing_else(outcome, part, mine):
        yield _taken_out(outcome, part, name, mine)
        return
    in_plane = [one for one in mine if _is_in_plane(outcome, *one)]
    rest = [one for one in mine if one not in in_plane]
    if len(in_plane) == 2:
        yield Phrase("replace ", name, " by a wire (in-plane bending free at both its ends)")
        in_plane = []
    for element, number in in_plane:
        place = _place(outcome, part, element, number)
        behind = f" to a waist at {place} (in-plane bending free there)"
        yield Phrase("cut ", name, behind)
    for element, number in rest:
        yield _one(outcome, part, name, element, number, roles[mine.index((element, number))])


def _one(
    outcome: Outcome, part: Part, name: Named, element: int, number: int, role: int
) -> Phrase:
    """A deformation that is no in-plane bending of a sheet."""
    if part.kind is PartKind.BODY:
        return _of_body(outcome, part, name, element, number, role)
    word = deformation_words(outcome, outcome.data.element_index[element], number)
    if role == Role.ELONGATION:
        if part.kind is PartKind.SHEET:
            behind = " across, so that it gives along its length (elongation free)"
            return Phrase("fold ", name, behind)
        return Phrase("let ", name, " give along its length (elongation free)")
    if role == Role.TORSION:
        return Phrase("make ", name, " soft in torsion (twist free)")
    bending = bending_of(outcome, outcome.data.element_index[element], number)
    if bending is not None:
        place = _place(outcome, part, element, number)
        kind = word.partition(" at ")[0]
        if part.kind is PartKind.SHEET and not _is_planar(outcome, element):
            return Phrase("let ", name, f" bend out of its plane at {place} ({kind} free there)")
        return Phrase("give ", name, f" a notch at {place} ({kind} free there)")
    if part.kind is PartKind.HINGE:
        turn = {Role.ROTATION: "turn about its axis", Role.ANGLE: "turn"}.get(Role(role))
        return Phrase("let ", name, f" {turn}" if turn else f" give ({word} free)")
    return Phrase("let ", name, f" give ({word} free)")


def _of_body(
    outcome: Outcome, part: Part, name: Named, element: int, number: int, role: int
) -> Phrase:
    """A deformation of a rigid member, which is one of several of its body or the body itself."""
    index = outcome.data.element_index[element]
    word = deformation_words(outcome, index, number)
    of_link = ""
    if index in outcome.parts.links:
        p, q = (outcome.data.arrays.element_node[[0, 2], index] - 1).tolist()
        ends = [place_words(outcome.parts, node) for node in (p, q) if node >= 0]
        of_link = f" between {' and '.join(ends)}"
    if role == Role.TORSION:
        return Phrase("make ", name, f" soft in torsion{of_link}")
    if role == Role.ELONGATION:
        return Phrase("make ", name, f" soft along its length{of_link}")
    if bending_of(outcome, index, number) is not None:
        kind, _, place = word.partition(" at ")
        return Phrase("make ", name, f" soft in {kind}{of_link or f' at {place}'}")
    return Phrase("let ", name, f" give{of_link} ({word} free)")


def _taken_out(outcome: Outcome, part: Part, name: Named, mine: list[Deformation]) -> Phrase:
    """A part that holds nothing else."""
    words = [
        deformation_words(outcome, outcome.data.element_index[element], number)
        for element, number in mine
    ]
    free = f" ({words[0]} free)" if len(words) == 1 else ""
    if len(words) > 1 or _role(outcome, *mine[0]) != Role.ELONGATION:
        if part.kind is PartKind.HINGE:
            return Phrase("let ", name, f" go{free}")
        return Phrase("take ", name, f" out{free}")
    if part.kind is PartKind.BAR:
        return Phrase("take ", name, f" out, or make it adjustable in length{free}")
    if part.kind is PartKind.WIRE:
        return Phrase("take ", name, f" out, or give it a soft joint{free}")
    return Phrase("take ", name, f" out, or let it give along its length{free}")


def _holds_nothing_else(outcome: Outcome, part: Part, mine: Sequence[Deformation]) -> bool:
    if part.kind is PartKind.BODY:
        return False
    numbers = outcome.data.arrays.element_number
    for index in part.elements:
        classes = outcome.data.arrays.deformation_class[:, index].tolist()
        for k, given in enumerate(classes):
            if given != Class.DEPENDENT and given != Class.NONE:
                if (int(numbers[index]), k + 1) not in mine:
                    return False
    return True


def _held(outcome: Outcome, element: int, number: int) -> Phrase:
    """What is done to hold a released deformation."""
    index = outcome.data.element_index[element]
    part, name = outcome.parts.of_element(index), named_element(outcome, element)
    role, word = _role(outcome, element, number), deformation_words(outcome, index, number)
    if part.kind is PartKind.HINGE or role in (Role.ROTATION, Role.ANGLE):
        return Phrase("lock ", name, f" ({word} held)")
    if role == Role.TORSION:
        return Phrase("stiffen ", name, " against twist (twist held)")
    if role == Role.ELONGATION:
        return Phrase("make ", name, " stiff along its length (elongation held)")
    if bending_of(outcome, index, number) is not None:
        kind = word.partition(" at ")[0]
        place = _place(outcome, part, element, number)
        return Phrase("stiffen ", name, f" at {place} ({kind} held there)")
    return Phrase("stiffen ", name, f" ({word} held)")


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
