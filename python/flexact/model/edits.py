# SPDX-License-Identifier: BSD-3-Clause
"""Edits: methods of the builder that find, move, rename, delete, and say how parts look."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ..core.elements import Class, element_kinds
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from . import sections
from . import selection as appearance
from . import selection as arguments
from . import selection as points
from .draft import Draft
from .elements import Making, call
from .handles import Assembly, Element, FoldedSheet, Node, Part, Sheet
from .names import part_name, renamed
from .sections import MaterialLike
from .selection import PartLike, Point, Section, indices_of, is_chain, part


def delete_elements(draft: Draft, indices: Iterable[int]) -> None:
    """Delete elements, and the points between the beams of a chain that nobody else uses."""
    gone = set(indices)
    inner = _inner(draft, gone)
    kept = [i for i in range(len(draft.kinds)) if i not in gone]
    new = {old: k for k, old in enumerate(kept)}
    for name in ("kinds", "numbers", "slots", "vectors", "classes"):
        values = getattr(draft, name)
        values[:] = [values[i] for i in kept]
    draft.names = {new[i]: each for i, each in draft.names.items() if i in new}
    draft.properties.renumber(new)
    said = draft.appearance.said
    draft.appearance.said = {new[i]: each for i, each in said.items() if i in new}
    draft.stated = {(new[i], k): value for (i, k), value in draft.stated.items() if i in new}
    draft.rigid = {new[i] for i in draft.rigid if i in new}
    draft.elements_given = sum(i < draft.elements_given for i in kept)
    draft.changed_names_or_places()
    for number in inner - {node for slots in draft.slots for node in slots}:
        _drop_node(draft, number)


def _inner(draft: Draft, indices: set[int]) -> set[int]:
    """Nodes at which one of these elements ends and the next begins."""
    begins, ends = set(), set()
    for index in indices:
        p, op, q, oq = draft.slots[index]
        begins |= {p, op}
        ends |= {q, oq}
    stated = {number for number, _ in draft.coordinate_class}
    return (begins & ends) - stated - {0}


def delete_point(draft: Draft, point: Node) -> None:
    """Delete the nodes of a point.

    Raises:
        ModelError: an element uses them.
    """
    nodes = {point.position, point.orientation}
    users = [i for i, slots in enumerate(draft.slots) if nodes & set(slots)]
    if users:
        names = dict.fromkeys(_part_words(draft, i) for i in users)
        raise model_error(
            "in-use",
            f"{point.words} is used by {', '.join(names)}",
            "delete these parts first, or move the point",
        )
    for number in nodes:
        _drop_node(draft, number)
    draft.changed_names_or_places()


def _part_words(draft: Draft, index: int) -> str:
    name = part_name(draft.names.get(index, ""))
    return in_short(name) if name else draft.element_words(index)


def _drop_node(draft: Draft, number: int) -> None:
    for table in (draft.node_kind, draft.node_value, draft.node_names, draft.properties.node_mass):
        table.pop(number, None)
    draft.loads.drop(number)
    draft.coordinate_class = {
        place: value for place, value in draft.coordinate_class.items() if place[0] != number
    }
    draft.named = {place for place in draft.named if place[0] != number}
    draft.whole = [both for both in draft.whole if number not in both]
    draft.position_of.pop(number, None)
    draft.orientation_at.pop(number, None)
    draft.changed_names_or_places()


def move(draft: Draft, number: int, value: tuple[float, float, float, float]) -> None:
    """Move a position node, and the inner points of divided flexures that end there."""
    chains = _chains_at(draft, number)
    draft.node_value[number] = value
    for indices in chains:
        start = draft.node_value[draft.slots[indices[0]][0]]
        end = draft.node_value[draft.slots[indices[-1]][2]]
        for k, index in enumerate(indices[1:], 1):
            t = k / len(indices)
            x, y, z = (start[i] * (1.0 - t) + end[i] * t for i in range(3))
            draft.node_value[draft.slots[index][0]] = (x, y, z, 0.0)
    draft.changed_names_or_places()


def _chains_at(draft: Draft, number: int) -> list[list[int]]:
    """Flexures of several beams, by their names and classes, with an end at a position node."""
    found = []
    for indices in draft.parts_by_name.values():
        if len(indices) > 1 and is_chain(draft, indices):
            divided = Class.INDEPENDENT in draft.classes[indices[1]]
            ends = draft.slots[indices[0]][0], draft.slots[indices[-1]][2]
            if divided and number in ends:
                found.append(indices)
    return found


class EditMethods(Making):
    """Methods that change what there is."""

    def part(self, name: PartLike) -> Part | Element:
        """The part with this name, or the element with this number.

        Raises:
            ModelError: there is none, or several have this name; the nearest names are told.
        """
        return part(self._change(), name)

    def move(self, point: Point, to: Sequence[Quantity]) -> None:
        """Move a point to another place [m]; what ends there ends at the new place.

        A width or axis that was given stays as it is, and inner points of divided flexures
        are put on the straight line between their ends again.

        Raises:
            ModelError: there is no such point, or it is no place.
        """
        draft = self._change()
        with call("move", point):
            number = points.existing(draft, point).position
            value = points.place(draft, to)
        move(draft, number, value)

    def rename(self, target: Point | PartLike | FoldedSheet, name: str) -> None:
        """Give a point or a part another name; of a part every beam and link.

        Raises:
            ModelError: there is no such point or part, or the name is none.
        """
        draft = self._change()
        with call("rename", target):
            if self._names_part(target):
                name = arguments.text(name, "the name of a part")
                leaves = target.leaves if isinstance(target, FoldedSheet) else (target,)
                for k, leaf in enumerate(leaves, 1):
                    own = name if len(leaves) == 1 else f"{name}, leaf {k}"
                    for index in indices_of(draft, part(draft, leaf)):
                        draft.name_element(index, renamed(draft.names.get(index, ""), own))
            else:
                node = points.existing(draft, target)
                draft.name_node(node.position, points.checked_name(name))

    def delete(self, target: Point | PartLike | FoldedSheet | Assembly) -> None:
        """Delete a part with its inner points, or a point that no part uses.

        The ends of a deleted part stay; delete them, too, if they were fixed.

        Raises:
            ModelError: there is no such point or part, or parts use the point.
        """
        draft = self._change()
        with call("delete", target):
            if self._names_part(target):
                delete_elements(draft, appearance.drawn_elements(draft, target))
            else:
                delete_point(draft, points.existing(draft, target))

    def made_of(
        self,
        target: PartLike | FoldedSheet | Assembly,
        material: MaterialLike | None = None,
        *,
        section: Section | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        warping: bool | float = False,
    ) -> None:
        """Say what flexures are made of: section and material of parts that are there.

        Args:
            target: A part, its name, a folded sheet, or an assembly, all of whose flexures
                it is said of.
            material: See `wire`.
            section: Breadth and thickness of sheets; diameter or two sizes of others [m].
            thickness: Of a sheet, or the diameter of a wire [m].
            breadth: The size of a sheet along its width [m].
            warping: Of sheets, see `sheet`.
        """
        draft = self._change()
        with call("made_of", target):
            flexures = _flexures(self.part(target) if isinstance(target, str) else target)
            if not flexures:
                raise model_error("no-section", "there is no flexure in it to be made of something")
            for each in flexures:
                found = self.part(each)
                sheet = isinstance(found, Sheet)
                if sheet:
                    shape = sections.sheet_section(section, thickness, breadth)  # type: ignore[arg-type]
                else:
                    shape = sections.round_section(section, thickness)
                for index in indices_of(draft, found):
                    kind = element_kinds()[draft.kinds[index] - 1]
                    given = shape or draft.appearance.said.get(index, {}).get("shape")
                    what = "sheet" if sheet else "wire"
                    made = sections.made_of(kind, given, material, what)
                    if sheet:
                        made = made.with_warping(warping, _length(draft, indices_of(draft, found)))
                    draft.give_properties(index, made.stiffness, made.mass)
                    if made.shape is not None:
                        draft.appearance.give([index], {"shape": made.shape})

    def look(
        self,
        target: PartLike | Node | FoldedSheet | Assembly,
        *,
        section: Section | None = None,
        colour: Sequence[float] | None = None,
        edge_colour: Sequence[float] | None = None,
        opacity: float | None = None,
        drawn: bool | None = None,
    ) -> None:
        """Say how elements are drawn; the analysis does not use it.

        What is not given stays as it was.

        Args:
            target: A part (each of its elements), its name, the point beyond a hinge, or
                an element's number.
            section: A diameter, or the sizes along the local y and z axes [m]; of a sheet
                its width and its thickness, whatever its local axes are.
            colour: Red, green and blue, from 0 to 1.
            edge_colour: The same for edges.
            opacity: From 0, invisible, to 1.
            drawn: Whether it is drawn at all.

        Raises:
            ModelError: something of it is wrong; then nothing has changed.
        """
        draft = self._change()
        with call("look", target):
            if isinstance(target, str):
                target = self.part(target)
            indices = appearance.drawn_elements(draft, target)
            said = appearance.said(target, section, colour, edge_colour, opacity, drawn)
        draft.appearance.give(indices, said)

    def _names_part(self, target: object) -> bool:
        """Whether a target is a part rather than a point.

        Raises:
            ModelError: it is the name of both.
        """
        draft = self._change()
        if isinstance(target, str):
            a_part, a_point = target in draft.parts_by_name, target in draft.points_by_name
            if a_part and a_point:
                raise model_error(
                    "ambiguous-name",
                    "it is the name of a part and of a point",
                    "give a handle, such as model.part(name) or model.point(name)",
                )
            return a_part or not a_point
        return isinstance(target, (Part, Element, FoldedSheet, Assembly, int))


def _flexures(target: object) -> list[Part | Element | int]:
    """The flexures of an assembly or folded sheet, or the part itself."""
    if isinstance(target, FoldedSheet):
        return list(target.leaves)
    if isinstance(target, Assembly):
        return [each for made in target.parts.values() for each in _flexures(made)]
    if isinstance(target, Part) and not _is_flexure(target):
        return []
    return [target]  # type: ignore[list-item]


def _length(draft: Draft, indices: Sequence[int]) -> float:
    p, q = draft.slots[indices[0]][0], draft.slots[indices[-1]][2]
    return math.dist(draft.node_value[p][:3], draft.node_value[q][:3])


def _is_flexure(target: Part) -> bool:
    return type(target).__name__ in ("Sheet", "Wire")
