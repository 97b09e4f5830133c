# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces, what is wanted, and wires to add, in words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...analysis.change import AddedSheet, AddedWire
from ...analysis.decomposition import Decomposition
from ...analysis.mode_words import line_words
from ...analysis.naming import (
    Line,
    Named,
    Pieces,
    coordinate_in_words,
    in_words,
    named_element,
    sentence,
)
from ...analysis.places import (
    axis_words,
    direction_words,
    joint_words,
    listed,
    node_words,
    others_words,
    part_words,
    place_words,
    with_article,
)
from ...analysis.result import Result
from ...analysis.screws import ScrewKind
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.parts.parts import Part, PartKind, natural
from ...util.records import cached_property
from ..proposal import Proposal
from .screws import SAME, Family, FamilyKind, ScrewSpace
from .spaces import Spaces
from .subjects import subjects_of
from .wanted_motion import Wanted


class Geometry:
    """Lines, planes and points of a mechanism in words: by names where something lies there."""

    def __init__(self, outcome: Decomposition) -> None:
        """Of the mechanism as it was given."""
        self.outcome = outcome
        self._values = outcome.given.arrays.node_value[:3].T

    def of(self, family: Family) -> str:
        """What belongs to a family, such as "all lines through A in the plane z = 0.04 m"."""
        planar = self.outcome.given.planar
        made = self._in_plane(family) if planar else ""
        return made or self._in_space(family)

    def _in_space(self, family: Family) -> str:
        kind, along = family.kind, axis_words(family.direction) if family.direction.any() else ""
        if kind is FamilyKind.PENCIL:
            return f"all lines through {self.point(family.point)} in {self.plane(family)}"
        if kind is FamilyKind.BUNDLE:
            return f"all lines through {self.point(family.point)}"
        if kind is FamilyKind.PLANE:
            return f"all lines in {self.plane(family)}"
        if kind is FamilyKind.PARALLELS_IN_PLANE:
            return f"all lines along {along} in {self.plane(family)}"
        lines = [self.line(*each) for each in zip(family.points, family.directions, strict=True)]
        if kind in (FamilyKind.LINE, FamilyKind.SCREW):
            return lines[0]
        if kind is FamilyKind.MEETING_TWO:
            return f"all lines that meet {listed(sorted(lines))}"
        if kind is FamilyKind.MEETING_ACROSS:
            return f"all lines that meet {lines[0]} and are perpendicular to {along}"
        if kind is FamilyKind.REGULUS:
            return self._regulus(family, along)
        return {
            FamilyKind.PARALLELS: f"all lines along {along}",
            FamilyKind.MEETING: f"all lines that meet {lines[0] if lines else ''} or are parallel "
            "to it",
            FamilyKind.ACROSS: f"all lines perpendicular to {along}",
            FamilyKind.CONGRUENCE: "the lines of a linear congruence, one through each point",
            FamilyKind.COMPLEX: f"the lines of a linear complex about {lines[0] if lines else ''}, "
            f"pitch {family.pitch:.4g} m",
            FamilyKind.EVERY: "every line",
            FamilyKind.DIRECTION: along,
            FamilyKind.DIRECTIONS_IN_PLANE: "every direction perpendicular to "
            + (axis_words(family.normal) if family.normal.any() else ""),
            FamilyKind.EVERY_DIRECTION: "every direction",
        }[kind]

    def _in_plane(self, family: Family) -> str:
        """The same where a rotation is one about a point; empty where there is no difference."""
        kind, about_z = family.kind, abs(family.direction[2]) > 0.5
        if kind is FamilyKind.PARALLELS:
            return "every point"
        if kind is FamilyKind.PARALLELS_IN_PLANE and about_z:
            across = np.cross(family.normal, family.direction)
            return f"every point of {self.line(family.point, across)}"
        if kind is FamilyKind.PARALLELS_IN_PLANE:
            return f"all lines along {axis_words(family.direction)}"
        if kind is FamilyKind.PENCIL:
            return f"all lines through {self.point(family.point)}"
        if kind is FamilyKind.PLANE:
            return "every line"
        if kind is FamilyKind.DIRECTIONS_IN_PLANE:
            return "every direction"
        return ""

    def _regulus(self, family: Family, along: str) -> str:
        if family.direction.any():
            where = self.point(family.point)
            return f"one set of lines on a hyperboloid about {where}, its axis along {along}"
        normal = axis_words(family.normal)
        return f"one set of lines on a hyperbolic paraboloid, all perpendicular to {normal}"

    # Names ------------------------------------------------------------------

    @property
    def _near(self) -> float:
        return SAME * self.outcome.characteristic_length

    @cached_property
    def _named(self) -> tuple[tuple[str, FloatArray], ...]:
        """Names of points as sentences have them, and where they are, by name.

        Without those inside divided sheets, and those that go by a part that ends on a body.
        """
        parts, kinds = self.outcome.parts, self.outcome.given.arrays.node_kind
        inner = self.outcome.carriers.inner
        nodes = [k for k in np.flatnonzero(kinds <= NodeKind.POSITION).tolist() if k not in inner]
        names = ((k, parts.name_of_point(k)) for k in nodes)
        able = [(name, k) for k, name in names if name and with_article(name) == self._words(k)]
        able.sort(key=lambda each: natural(each[0]))
        return tuple((with_article(name), self._values[k]) for name, k in able)

    def _words(self, node: int) -> str:
        return place_words(self.outcome.parts, node)

    def point(self, place: FloatArray) -> str:
        """A point by its name, or by its coordinates [m]."""
        for name, there in self._named:
            if np.linalg.norm(place - there) <= self._near:
                return name
        return self._coordinates(place)

    def _coordinates(self, place: FloatArray) -> str:
        count = 2 if self.outcome.given.planar else 3
        return f"({', '.join(self._number(value) for value in place[:count])}) m"

    def _number(self, value: float) -> str:
        return "0" if abs(value) < self._near else f"{value:.4g}"

    def line(self, point: FloatArray, direction: FloatArray) -> str:
        """A line by the wire, bar or hinge on it, by a point that has a name, or by numbers."""
        for part in self._members():
            ends = self._values[list(part.ends)]
            if part.kind is PartKind.HINGE:
                axis = self.outcome.given.frames.frame[part.elements[0]][:, 0]
                if abs(axis @ direction) > 1.0 - SAME and self._is_on(ends[0], point, direction):
                    return f"the axis of {part_words(part)}"
            elif all(self._is_on(end, point, direction) for end in ends):
                return f"the line of {part_words(part)}"
        planar = self.outcome.given.planar
        for name, there in self._named:
            if self._is_on(there, point, direction):
                if planar and abs(direction[2]) > 0.5:
                    return name
                return f"the line through {name} along {axis_words(direction)}"
        return line_words(self.outcome, point, direction)

    def _members(self) -> list[Part]:
        kinds = (PartKind.WIRE, PartKind.BAR, PartKind.HINGE)
        able = [part for part in self.outcome.parts.all if part.kind in kinds and part.ends]
        return sorted(able, key=lambda part: natural(part.name))

    def _is_on(self, place: FloatArray, point: FloatArray, direction: FloatArray) -> bool:
        return bool(np.linalg.norm(np.cross(place - point, direction)) <= self._near)

    def plane(self, family: Family) -> str:
        """The plane of a family, by the sheet in it, by an axis across it, or by numbers."""
        point, normal = family.point, family.normal
        for part in self._sheets():
            frame = self.outcome.given.frames.frame[part.elements[0]]
            own = np.cross(frame[:, 0], frame[:, int(self.outcome.parts.wide[part.elements[0]])])
            off = (self._values[list(part.ends)] - point) @ normal
            if abs(own @ normal) > 1.0 - SAME and np.abs(off).max() <= self._near:
                return f"the plane of {part_words(part)}"
        across = axis_words(normal)
        if across in ("x", "y", "z"):
            return f"the plane {across} = {self._number(float(point['xyz'.index(across)]))} m"
        return f"the plane through {self.point(point)} perpendicular to {across}"

    def _sheets(self) -> list[Part]:
        wide = self.outcome.parts.wide
        able = [
            part
            for part in self.outcome.parts.all
            if part.kind is PartKind.SHEET and int(wide[part.elements[0]])
        ]
        return sorted(able, key=lambda part: natural(part.name))


#: How many motions a sheet stops.
_HELD_BY_A_SHEET = 3


def spaces_lines(result: Result, spaces: Spaces | None, *, added: bool = True) -> tuple[Line, ...]:
    """What a body can do, what holds it, and what may be added to it.

    Without spaces it is said why, where there are bodies after all.

    Args:
        result: The result.
        spaces: Freedom and constraint of the body.
        added: Whether the wires and sheets to add are told; not where steps tell them.
    """
    if spaces is not None:
        return (*_lines(result, spaces), *(_added(result, spaces) if added else ()))
    if not subjects_of(result):
        return ()
    return (
        sentence(
            "What a body can do was left out: the mechanism has so many motions, with nothing "
            "declared, that not all of them are kept."
        ),
    )


def _lines(result: Result, spaces: Spaces) -> Iterator[Line]:
    geometry, body = Geometry(result), body_words(result, spaces)
    start = f"{body[:1].upper()}{body[1:]}"
    free, held = spaces.freedom.dimension, spaces.constraint.dimension
    if free:
        head = f"Freedom of {body}, with nothing declared: {_independent(free, 'motion')}: "
        yield Line((head,), _items(geometry, spaces.freedom, free))
    else:
        yield sentence(f"{start} cannot move, with nothing declared.")
    if held:
        head = f"Constraint of {body}: {_independent(held, 'force or moment')}: "
        yield Line((head,), _items(geometry, spaces.constraint, held))
    else:
        yield sentence(f"Nothing holds {body}.")
    lines = tuple((geometry.of(family),) for family in spaces.redundant)
    if lines and free:
        yield Line(("One more wire would be redundant along: ",), lines)
    elif lines:
        yield sentence("One more wire would be redundant along any line.")
    yield from _on_intent(result, geometry, spaces, body)


def _on_intent(result: Result, geometry: Geometry, spaces: Spaces, body: str) -> Iterator[Line]:
    """What is wanted, what moves besides, and what stops it."""
    had = [each for each in spaces.wanted if each.is_free]
    if had:
        word = "Wanted, as declared: " if had[0].is_declared else "Wanted: "
        yield Line((word,), tuple((_wanted(geometry, each),) for each in had))
    for each in spaces.wanted:
        if not each.is_free:
            yield sentence(f"Wanted, but stopped: {_wanted(geometry, each)}.")
    count = spaces.unwanted
    if not count:
        if had:
            yield sentence(f"Nothing else of {body} moves.")
        return
    besides = f"Besides, {body} moves" if had else f"{body[:1].upper()}{body[1:]} moves"
    others = "other " if had else ""
    yield sentence(f"{besides} in {in_words(count)} {others}independent way{'s' * (count > 1)}.")
    if spaces.stoppable < count:
        yield sentence(_impossible(spaces))
    if not spaces.tried and not result.is_told_by_parts:
        yield sentence("The mechanism is so large that no wires were tried.")
    if spaces.tried and spaces.stoppable and not spaces.proposals:
        yield sentence(
            "Of the wires that were tried none stops only that and causes no self-stress."
        )
    yield from _taken_back(result, spaces)


def _added(result: Result, spaces: Spaces) -> Iterator[Line]:
    """Wires and sheets that stop what is unwanted."""
    geometry, count = Geometry(result), spaces.unwanted
    what = " and nothing that is wanted" if any(each.is_free for each in spaces.wanted) else ""
    single = [each for each in spaces.proposals if len(each.change.wires) == 1]
    if single:
        which = "To stop it" if count == 1 else "To stop one of them"
        yield Line(
            (f"{which}{what}, add: ",),
            tuple(wire_in_words(result, each) for each in single),
        )
    for proposal in spaces.proposals:
        many = len(proposal.change.wires)
        if many > 1:
            which = "all" if many == count else in_words(many)
            items = tuple(_wire(geometry, wire) for wire in proposal.change.wires)
            yield Line((f"To stop {which} of them, add all of: ",), items)
    sheets = [each for each in spaces.proposals if each.change.sheets]
    if sheets:
        which = "all" if count == _HELD_BY_A_SHEET else "three"
        yield Line(
            (f"To stop {which} of them{what}, add: ",),
            tuple(wire_in_words(result, each) for each in sheets),
        )


def _taken_back(result: Result, spaces: Spaces) -> Iterator[Line]:
    """Which declarations of what is not wanted go with the wires."""
    changes = [proposal.change for proposal in spaces.proposals[:1]]
    items: list[Pieces] = []
    for change in changes:
        items += [coordinate_in_words(result, node, name) for node, name, _ in change.coordinates]
        items += [(named_element(result, element),) for element, _, _ in change.deformations]
    if items:
        yield Line(("As it is not wanted, the declaration is taken back of: ",), tuple(items))


def _impossible(spaces: Spaces) -> str:
    left = spaces.unwanted - spaces.stoppable
    if not spaces.stoppable:
        what = "it" if left == 1 else "any of them"
        return (
            f"No wire can stop {what}: a force along any line that does no work on what is "
            "wanted does none on it either; a moment would be needed."
        )
    return (
        f"Wires can stop {in_words(spaces.stoppable)} of them; for the other "
        f"{in_words(left)} a moment would be needed, which no force along a line gives without "
        "work on what is wanted."
    )


def wire_in_words(result: Result, proposal: Proposal) -> Pieces:
    """The wires or the sheet of a proposal: where they end on the body, along what they run."""
    geometry, change = Geometry(result), proposal.change
    added: list[AddedWire | AddedSheet] = [*change.wires, *change.sheets]
    wires = [_wire(geometry, each) for each in added]
    made: list[Named | str] = []
    for place, wire in enumerate(wires):
        before = "" if not place else " and " if place == len(wires) - 1 else ", "
        made += [before, *wire] if before else wire
    return tuple(made)


def _wire(geometry: Geometry, wire: AddedWire | AddedSheet) -> Pieces:
    """Such as "a wire from the stage, where sheet 1 ends, along y"."""
    result = geometry.outcome
    parts = result.parts
    node = parts.data.node_index[wire.position]
    end, ground = np.array(wire.end), np.array(wire.ground)
    along, word = f" along {direction_words(ground - end)}", "wire"
    if isinstance(wire, AddedSheet):
        along, word = f"{along}, wide along {axis_words(np.array(wire.width))}", "sheet"
    turned = parts.data.node_index[wire.orientation]
    owner = node_words(parts, turned) if turned in parts.body_at else ""
    there = node_words(parts, turned) if parts.is_shared(turned) else place_words(parts, node)
    if not np.array_equal(parts.data.arrays.node_value[:3, node], end):
        link = Named("node", wire.position, owner or there)
        return (f"a {word} from {geometry.point(end)}, on a link to ", link, f",{along}")
    here = [part for part in parts.at(node) if part.kind is not PartKind.BODY]
    if there != owner:
        where = ""
    elif here:
        where = f", where {others_words(here)} end{'s' * (len(here) == 1)},"
    else:
        where = f" at {geometry.point(end)}"
    return (f"a {word} from ", Named("node", wire.position, there), where + along)


def wrenches_in_words(result: Result, space: ScrewSpace) -> tuple[Pieces, ...]:
    """The forces and moments of a space, family by family."""
    return _items(Geometry(result), space, space.dimension)


def _items(geometry: Geometry, space: ScrewSpace, count: int) -> tuple[Pieces, ...]:
    """The families of a space, or that it is everything."""
    if count == (3 if space.planar else 6):
        return (("every force and moment" if space.of_wrenches else "every motion",),)
    order = list(dict.fromkeys(family.kind for family in space.families))
    found = [(order.index(each.kind), _family(geometry, each, space)) for each in space.families]
    return tuple((words,) for _, words in sorted(found, key=lambda one: (one[0], natural(one[1]))))


def _family(geometry: Geometry, family: Family, space: ScrewSpace) -> str:
    words = geometry.of(family)
    if family.is_of_directions:
        return f"moments about {words}" if space.of_wrenches else f"translation along {words}"
    if family.kind is FamilyKind.SCREW:
        pitch = f"{family.pitch:.4g}"
        if space.of_wrenches:
            return f"a force along {words} with a moment about it, pitch {pitch} m"
        return f"a screw about {words}, pitch {pitch} m/rad"
    if space.of_wrenches:
        one = family.kind is FamilyKind.LINE
        return f"a force along {words}" if one else f"forces along {words}"
    return f"rotation about {words}"


def _wanted(geometry: Geometry, wanted: Wanted) -> str:
    if wanted.kind is ScrewKind.TRANSLATION:
        return f"translation along {axis_words(wanted.direction)}"
    line = geometry.line(wanted.point, wanted.direction)
    if wanted.kind is ScrewKind.ROTATION:
        return f"rotation about {line}"
    return f"a screw about {line}, pitch {wanted.pitch:.4g} m/rad"


def dashed_in_words(wires: int) -> str:
    """What so many dashed wires of a drawing are; behind words on the space that is drawn."""
    return f"; dashed: {'a wire' if wires == 1 else 'wires'} to add" if wires else ""


def body_words(result: Result, spaces: Spaces) -> str:
    """What the body is called within a sentence, such as "the stage"."""
    body = spaces.body
    if isinstance(body, Part):
        return part_words(body)
    return joint_words(result.parts, body)


def _independent(count: int, word: str) -> str:
    if word == "force or moment":
        word = "independent force or moment" if count == 1 else "independent forces and moments"
        return f"{in_words(count)} {word}"
    return f"{in_words(count)} independent {word}{'s' * (count != 1)}"
