# SPDX-License-Identifier: BSD-3-Clause
"""Tables in the style of SPACAR Light: nodes, elements, and properties of both.

    tables = {
        "nodes": [[0, 0, 0], [0, 0.1, 0]],
        "elements": [[1, 2]],
        "nprops": [{"fix": True}, {}],
        "eprops": [{"elems": [1], "flex": [2, 3, 4], "orien": [0, 0, 1]}],
        "opt": {"rls": [{"def": [2, 3, 4]}]},
    }

Nodes and elements are numbered by their rows, from 1. SPACAR Light and its documentation:
spacar.nl and github.com/precision-utwente/spalight, by M. Nijenhuis and M. Naves.
"""

from __future__ import annotations

import math
import shlex
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise, product
from typing import Any

import numpy as np

from ...core.elements import AXES, Class, Member, NodeKind, Vector
from ...core.raw import ElementKind
from ...deck.diagnostics import Diagnostic, Severity
from ...model.data import ModelData
from ...model.draft import Draft
from ...model.draft_arrays import data_of as data_of_draft
from ...model.model import Model
from ...model.names import one_line
from ...model.parts.parts import declared
from ...model.transform import NO_VECTOR
from ...util.errors import require_kind
from .by_section import kind_given, kind_in_words, name_by_rows, taken_by_section
from .model_tables import tables_with_remarks
from .table_input import (
    BY_SECTION,
    FLEXIBLE,
    INDEPENDENT,
    LETTERS,
    LOADS,
    NODES_A_POINT,
    PRESCRIBED,
    RELEASED,
    SIMULATED,
    TRANSFER,
    Entry,
    Found,
    Remarks,
    Tables,
    TablesError,
    Text,
    mass_of,
    shape_of,
    stiffness_of,
    tables_given,
    warped,
)


def _numbers(
    tables: Tables, name: str, offset: int, joined: dict[int, int], found: Found
) -> dict[int, int]:
    made: dict[int, int] = {}
    for point, place in enumerate(tables.places, start=1):
        where = f"nprops[{point}].{name}"
        other = tables.nodes.get(point, {}).get(name, joined.get(point, point))
        if other > point:
            found.error(where, f"an earlier node is wanted, not {other}")
            other = point
        if name == "same_pos" and tables.places[other - 1] != place:
            found.error(where, f"node {other} stands elsewhere")
        made[point] = made.get(other, NODES_A_POINT * (point - 1) + offset)
    return made


def numbers_of_points(tables: Tables, found: Found | None = None) -> tuple[dict[int, int], ...]:
    """Numbers of the position and of the orientation of each point; some share one.

    Args:
        tables: The tables.
        found: Where problems are noted.
    """
    noted = Found(None, tables.name) if found is None else found
    return (
        _numbers(tables, "same_pos", 1, _hinged(tables), noted),
        _numbers(tables, "same_orien", 2, {}, noted),
    )


#: An end of a state space: a point, such as "force" or "veloc", and an axis.
End = tuple[int, str, str]
_ENDS = ("transfer_in", "transfer_out")


def ends_of_transfer(tables: Tables) -> tuple[list[End], list[End]]:
    """Where a state space begins, and where it ends."""
    sources, sinks = (
        [
            (point, *each.split("_"))
            for point, entry in tables.nodes.items()
            for each in entry.get(name, ())
        ]
        for name in _ENDS
    )
    return sources, sinks


def end_in_words(position: Mapping[int, int], end: End) -> str:
    """Such as "4:x velocity"."""
    point, stem, axis = end
    return f"{position.get(point, 0)}:{axis}{' velocity' * (stem == 'veloc')}"


def _hinged(tables: Tables) -> dict[int, int]:
    """Of nodes at one place that a hinge joins the later one, with the earlier one."""
    made = {}
    for element, (p, q) in enumerate(tables.ends, start=1):
        kind = tables.entry_of(element).get("type")
        if kind == "hinge" and tables.places[p - 1] == tables.places[q - 1]:
            made[max(p, q)] = min(p, q)
    return made


#: Sine of the largest angle between what lies along each other, by rounding.
_ALONG = 1e-9
#: What flexible deformations are that are not released, where all are alike.
_CLASSES = {INDEPENDENT: Class.INDEPENDENT, RELEASED: Class.DEPENDENT}
#: What the local y axis of a beam points to where nothing is said.
_ORIEN = (0.0, 1.0, 0.0)


def data_of(tables: Tables, flexible: str, found: Found) -> ModelData:
    """The model of checked tables; what cannot be made is noted in `found`.

    Args:
        tables: The tables.
        flexible: What deformations in flex are, one of `FLEXIBLE`.
        found: Where problems are noted.
    """
    making = _Making(tables, flexible, found)
    making.add_nodes()
    for element in range(1, len(tables.ends) + 1):
        making.add_element(element)
    making.give_nodes()
    making.note_warping()
    asked = making.transfer()
    found.require_none()
    data = data_of_draft(making.draft, tables.name)
    told: tuple[Diagnostic, ...] = ()
    if making.taken is not None:
        if len(making.of_beam) > len(tables.ends):
            making.name_parts(data)
            data = data_of_draft(making.draft, tables.name)
        # What is divided, here or in the script, counts as one.
        data, told = declared(data), making.taken.remarks
    return replace(data, besides=(*data.besides, *told, *making.remarks.diagnostics(), *asked))


def _is_along(vector: tuple[float, ...], p: tuple[float, ...], q: tuple[float, ...]) -> bool:
    """Whether a vector lies along the line from p to q, in space, and so gives it no axes."""
    if len(p) < 3:
        return False
    way = np.subtract(q, p)
    across = np.linalg.norm(np.cross(way, vector))
    return bool(across <= _ALONG * np.linalg.norm(way) * np.linalg.norm(vector))


class _Making:
    """A draft that grows from tables."""

    def __init__(self, tables: Tables, flexible: str, found: Found) -> None:
        self.tables = tables
        #: What is released by section; None where `flex` and `rls` say it.
        self.taken = taken_by_section(tables) if flexible == BY_SECTION else None
        self.flexible = _CLASSES.get(flexible, Class.DEPENDENT)
        self.found = found
        #: The element of the tables that each beam is of.
        self.of_beam: list[int] = []
        self.draft = Draft(tables.planar)
        self.position, self.orientation = numbers_of_points(tables, found)
        self.remarks = Remarks(
            Counter(tables.left_out), Counter(tables.lost), renamed=Counter(tables.renamed)
        )
        self.used: set[int] = set()
        #: Flexible elements with warping by the points at which they end, and where rigid ones do.
        self.warping_at: dict[int, list[int]] = {}
        self.stiff_at: set[int] = set()
        for element, ends in enumerate(tables.ends, start=1):
            entry = tables.entry_of(element)
            if entry.get("warping") and not entry.get("flex"):
                self.stiff_at.update(ends)
            elif entry.get("warping"):
                for point in ends:
                    self.warping_at.setdefault(point, []).append(element)
        self.next_node = NODES_A_POINT * len(tables.places) + 1

    def add_nodes(self) -> None:
        """Positions; orientations come with the elements that need them."""
        kind = NodeKind.PLANAR_POSITION if self.tables.planar else NodeKind.POSITION
        given = {one_line(entry.get("name", "")) for entry in self.tables.nodes.values()}
        for point, place in enumerate(self.tables.places, start=1):
            number = self.position[point]
            self.draft.node_kind[number] = kind
            self.draft.node_value[number] = (*place, *(0.0,) * (4 - len(place)))
            name = one_line(self.tables.nodes.get(point, {}).get("name", ""))
            if not name and self.taken is not None and f"point {point}" not in given:
                # Nodes of the deck have other numbers than those of the script.
                name = f"point {point}"
            if name:
                self.draft.node_names.setdefault(number, name)

    def add_element(self, element: int) -> None:
        """The beams of an element, or the one element that it is."""
        entry, (p, q) = self.tables.entry_of(element), self.tables.ends[element - 1]
        where = f"eprops[{self.tables.set_of.get(element, 0)}]"
        kind = kind_given(self.tables, entry)
        if self.tables.planar and NodeKind.POSITION in kind.slots:
            self.found.error(f"{where}.type", "nodes with x and y have planar elements alone")
        count = entry.get("nbeams", 1)
        if count > 1 and kind.member != Member.BEAM:
            self.found.error(f"{where}.nbeams", "a beam alone is divided")
            count = 1
        flex = entry.get("flex", ())
        if self.taken is not None:
            flex = self.taken.released.get(element, ())
        is_rigid = not (entry.get("flex") or flex or self.tables.released.get(element))
        vector = self._vector(kind, element, where, is_rigid)
        for i, slots in enumerate(self._slots(kind, p, q, count)):
            is_last = i == count - 1 and self.taken is None
            released = self.tables.released.get(element, ()) if is_last else ()
            classes = self._classes(kind, flex, released, element)
            number = self.draft.append_element(kind.number, slots, vector, classes)
            self.of_beam.append(element)
            self._give(number - 1, kind, entry, element, (i, count))

    def name_parts(self, data: ModelData) -> None:
        """Call parts by the elements of the script: the beams of a divided one shift numbers."""
        released = {} if self.taken is None else self.taken.released
        kinds = [kind_in_words(released.get(each, ())) for each in self.of_beam]
        name_by_rows(self.draft, data.chains, self.of_beam, kinds)

    def _vector(
        self, kind: ElementKind, element: int, where: str, is_rigid: bool
    ) -> tuple[float, float, float]:
        entry = self.tables.entry_of(element)
        x, y, z = entry.get("orien", _ORIEN if kind.member == Member.BEAM else NO_VECTOR)
        if kind.vector == Vector.NONE:
            return NO_VECTOR
        if kind.vector == Vector.REQUIRED and not any((x, y, z)):
            self.found.error(where, f"a {entry['type']} needs its axis: give orien")
        p, q = (self.tables.places[point - 1] for point in self.tables.ends[element - 1])
        if kind.member == Member.BEAM and p == q:
            self.found.error(f"elements[{element}]", "its nodes are at one place: it has no length")
        elif kind.member == Member.BEAM and _is_along((x, y, z), p, q):
            if is_rigid:
                # It has no width; any axes will do.
                self.remarks.leave_out("orien along a rigid element", int("orien" in entry))
                return NO_VECTOR
            said = "it" if "orien" in entry else "(0, 1, 0), the default,"
            words = f"{said} lies along element {element}: give a vector along its width"
            self.found.error(f"{where}.orien", words)
        return x, y, z

    def _slots(
        self, kind: ElementKind, p: int, q: int, count: int
    ) -> Iterator[tuple[int, int, int, int]]:
        """Nodes of each beam; those between the ends come behind all points."""
        ends = [(self.position[p], self.orientation[p])]
        start, end = (np.array(self.tables.places[point - 1]) for point in (p, q))
        for i in range(1, count):
            value = (start + (end - start) / count * i).tolist()
            number = self.next_node
            self.next_node += NODES_A_POINT
            self.draft.node_kind[number] = self.draft.node_kind[ends[0][0]]
            self.draft.node_value[number] = (*value, *(0.0,) * (4 - len(value)))
            ends.append((number, number + 1))
        ends.append((self.position[q], self.orientation[q]))
        for (one, turned), (other, other_turned) in pairwise(ends):
            slots = [one, turned, other, other_turned]
            for k, slot in enumerate(kind.slots):
                if not slot:
                    slots[k] = 0
                elif k in (1, 3):
                    upright = 1.0 if slot == NodeKind.ORIENTATION else 0.0
                    self.draft.node_kind.setdefault(slots[k], slot)
                    self.draft.node_value.setdefault(slots[k], (upright, 0.0, 0.0, 0.0))
            self.used.update(slots)
            yield slots[0], slots[1], slots[2], slots[3]

    def _classes(
        self, kind: ElementKind, flex: Iterable[int], released: Iterable[int], element: int
    ) -> tuple[int, ...]:
        made = [int(Class.FIXED) if role else int(Class.NONE) for role in kind.role]
        for mode, value in (
            *((mode, self.flexible) for mode in flex),
            *((mode, Class.DEPENDENT) for mode in released),
        ):
            if made[mode - 1] == Class.NONE:
                self.found.error(
                    f"elements[{element}]",
                    f"a {kind.keyword.lower()} has no deformation {mode}, only 1 to "
                    f"{kind.deformations}: correct flex or def",
                )
            else:
                made[mode - 1] = int(value)
        return tuple(made)

    def _give(
        self, index: int, kind: ElementKind, entry: Entry, element: int, beam: tuple[int, int]
    ) -> None:
        """Name, look, stiffness and mass of one of the beams of an element."""
        if name := one_line(entry.get("name", "")):
            if len(entry["elems"]) > 1:
                name = f"{name} {entry['elems'].index(element) + 1}"
            if beam[1] > 1:
                name = f"{name}, part {beam[0] + 1} of {beam[1]}"
            self.draft.name_element(index, name)
        shape = shape_of(entry)
        said = {
            "shape": shape,
            "colour": entry.get("color"),
            "opacity": entry.get("opacity"),
            "drawn": False if entry.get("hide") else None,
        }
        self.draft.say_looks(
            [index], {key: value for key, value in said.items() if value is not None}
        )
        if shape is not None and kind.member in (Member.BAR, Member.BEAM):
            stiffness = stiffness_of(kind, shape, entry)
            if stiffness is not None and kind.member == Member.BEAM and not self.tables.planar:
                p, q = (self.tables.places[point - 1] for point in self.tables.ends[element - 1])
                stiffness = warped(stiffness, math.dist(p, q), self._warp_held(element))
            self.draft.give_properties(index, stiffness, mass_of(kind, shape, entry))
        elif shape is not None and "dens" in entry:
            self.remarks.leave_out(f"the density of a {kind.keyword.lower()}")

    def _warp_held(self, element: int) -> int:
        """At how many ends of an element its warping is held: of what is known alone.

        cw, of older versions, means that of both; else an end that is fixed holds it, and what
        another element with warping does there is not known.
        """
        entry = self.tables.entry_of(element)
        if entry.get("cshape") != "rect" or not (entry.get("cw") or entry.get("warping")):
            return 0
        if entry.get("cw"):
            return 2
        ends = self.tables.ends[element - 1]
        return sum(map(self._holds_warping, ends)) if self._meets(element) is None else 0

    def _holds_warping(self, point: int) -> bool:
        """A clamp does, and a rigid element that warps: SPACAR Light fixes it at both ends."""
        entry = self.tables.nodes.get(point, {})
        return bool(entry.get("fix") or entry.get("fix_warp")) or point in self.stiff_at

    def _meets(self, element: int) -> tuple[int, int] | None:
        """Another element with warping at a free end of this one, and where; None without."""
        for point in self.tables.ends[element - 1]:
            others = [other for other in self.warping_at.get(point, ()) if other != element]
            if others and not self._holds_warping(point):
                return others[0], point
        return None

    def note_warping(self) -> None:
        """Say, with its place, what of the warping is left out."""
        warps = False
        for element in range(1, len(self.tables.ends) + 1):
            entry, number = self.tables.entry_of(element), self.tables.set_of.get(element, 0)
            said = next((name for name in ("cw", "warping") if entry.get(name)), "")
            warps = warps or bool(said)
            why = ""
            if not entry.get("flex"):
                continue
            if said and (self.tables.planar or "emod" not in entry):
                why = "it has no stiffness in torsion"
            elif said == "warping" and (met := self._meets(element)) is not None:
                why = f"at node {met[1]} it depends on element {met[0]}"
            if why and entry.get("cshape") != "circ":
                place = f"eprops[{number}].{said} of element {element}"
                self.remarks.leave_out(f"warping: {place}: {why}")
        for point, entry in self.tables.nodes.items():
            if entry.get("fix_warp") and not warps:
                self.remarks.leave_out(f"warping: nprops[{point}].fix_warp: no element warps")

    def give_nodes(self) -> None:
        """Classes, masses and loads of the nodes that elements use, and gravity."""
        points = {
            point: (entry, (self.position[point], self.orientation[point]))
            for point, entry in self.tables.nodes.items()
            if point <= len(self.tables.places)
        }
        told: list[str] = []
        for point, (entry, own) in points.items():
            stated = self._fixed(entry, own)
            told += self._prescribe(point, entry, own, stated)
            self.draft.coordinate_class.update(stated)
        self.remarks.leave_out(f"{PRESCRIBED}: {', '.join(told)}", len(told))
        for point, (entry, own) in points.items():
            for name, number in zip(("mass", "mominertia"), own, strict=True):
                if self._is_given(point, entry, name, number):
                    value = entry[name] if isinstance(entry[name], tuple) else (entry[name],)
                    planar = self.draft.node_kind[number] == NodeKind.ANGLE
                    self.draft.give_node_mass(number, value[-1:] if planar else value)
        for point, (entry, own) in points.items():
            for (stem, number), (kind, end) in product(
                zip(("force", "moment"), own, strict=True), LOADS.items()
            ):
                if self._is_given(point, entry, f"{stem}{end}", number):
                    axes = AXES[self.draft.node_kind[number]]
                    table: dict[int, tuple[float, ...]] = getattr(self.draft, kind)
                    table[number] = self._in_scene(entry[f"{stem}{end}"], axes)
        gravity = self._in_scene(self.tables.gravity, (0, 1) if self.tables.planar else (0, 1, 2))
        self.draft.gravity = gravity

    def transfer(self) -> tuple[Diagnostic, ...]:
        """How the state space is found that opt.transfer asks for; ends alone are left out."""
        sources, sinks = ends_of_transfer(self.tables)
        for name, ends in zip(_ENDS, (sources, sinks), strict=True):
            for point, _, _ in ends:
                number = self.position.get(point, 0)
                self._is_given(point, self.tables.nodes[point], name, number)
        said = [[end_in_words(self.position, each) for each in ends] for ends in (sources, sinks)]
        damping = self.tables.transfer
        if damping is None or not (sources and sinks):
            self.remarks.leave_out("opt.transfer without ends", int(damping is not None))
            for name, ends in zip(_ENDS, (sources, sinks), strict=True):
                self.remarks.leave_out(f"{SIMULATED}: nprops.{name}", len(ends))
            return ()
        words = " ".join(
            f"--{option} {shlex.quote(end)}"
            for option, ends in zip(("from", "to"), said, strict=True)
            for end in ends
        )
        return (
            Diagnostic(
                Severity.NOTE,
                TRANSFER,
                f"opt.transfer: flexact transfer DECK {words} --damping {damping:g} --held rigid "
                f"--beams 1; in Python flexact.elastic(DECK, held='rigid', beams=1).state_space("
                f"{said[0]}, {said[1]}, damping={damping:g})",
            ),
        )

    def _axes(self, number: int) -> tuple[int, ...]:
        """Of a node that an element uses."""
        return AXES[self.draft.node_kind[number]] if number in self.used else ()

    def _fixed(self, entry: Entry, own: tuple[int, int]) -> dict[tuple[int, int], Class]:
        """What is fixed of a position and an orientation."""
        return {
            (number, axis): Class.FIXED
            for number, whole, stem in zip(own, ("fix_pos", "fix_orien"), ("", "r"), strict=True)
            for axis in self._axes(number)
            if any(entry.get(name) for name in ("fix", whole, f"fix_{stem}{LETTERS[axis]}"))
        }

    def _prescribe(
        self, point: int, entry: Entry, own: tuple[int, int], stated: dict[tuple[int, int], Class]
    ) -> list[str]:
        """Make independent what moves as it is told; the places of values that were told."""
        told = []
        for number, stem in zip(own, ("displ", "rot"), strict=True):
            axes = self._axes(number)
            names: dict[str, tuple[int, ...]] = {}
            for start in (stem, f"{stem}_initial"):
                names |= {f"{start}_{letter}": (axis,) for axis, letter in enumerate(LETTERS)}
                names[start] = axes
            for name in (each for each in names if each in entry):
                where = f"nprops[{point}].{name}"
                told += [where] if np.any(entry[name]) else []
                for place in ((number, axis) for axis in names[name]):
                    if place[1] not in axes:
                        self.found.error(where, "no element gives the node this coordinate")
                    elif stated.get(place) == Class.FIXED:
                        words = "the coordinate is fixed, too: it cannot move as it is told"
                        self.found.error(where, words)
                    else:
                        stated[place] = Class.INDEPENDENT
        return told

    def _is_given(self, point: int, entry: Entry, name: str, number: int) -> bool:
        """Whether a field is that of a node which an element uses; else that is said."""
        if name in entry and number not in self.used:
            self.found.error(f"nprops[{point}].{name}", "no element uses this of the node")
        return name in entry and number in self.used

    def _in_scene(
        self, load: tuple[float, ...], axes: tuple[int, ...]
    ) -> tuple[float, float, float]:
        """A load without what is out of a plane."""
        x, y, z = (value if axis in axes else 0.0 for axis, value in enumerate(load))
        self.remarks.leave_out("loads out of the plane", int((x, y, z) != load))
        return x, y, z


__all__ = ["FLEXIBLE", "TablesError", "model_of", "tables_of"]

#: No table has values in each other more deeply.
_DEEPEST = 10


def model_of(
    tables: Mapping[str, Any],
    *,
    flexible: str | None = None,
    name: str = "",
    text: Text | None = None,
) -> Model:
    """The model of tables; what it does not hold stands in `Model.diagnostics`, as notes.

    A node is a position and an orientation. An element is a beam, or `nbeams` of them in a row.
    `fix` and its like fix coordinates, `displ_x` and `rot_x` and their like make them independent,
    whatever their values. What is not flexible is held.

    Args:
        tables: `nodes`, `elements`, and perhaps `nprops`, `eprops`, `rls` and `opt`; lists or
            arrays, as of a JSON that MATLAB's jsonencode has made. Of `nprops`, `eprops` and
            `rls` each entry is an object; of few, an object by number will do.
        flexible: What deformations in `flex` are. "by-section", as a designer asks whether the
            mechanism is exactly constrained: released; where `flex` says all, those of the sheet,
            the wire or the body that the section makes (`taken_by_section`), and what is divided
            counts as one. "independent": degrees of freedom, as SPACAR Light has them, but for
            those in `rls(i).def`, which are released, of a divided beam those of its last one.
            "released": all of them are. By default what the tables say, else by section.
        name: What the model is called, where the tables do not say it.
        text: What the tables were read from, for the lines of problems.

    Raises:
        TablesError: anything is wrong with the tables; all of it, each with its place.
        TypeError: they are no mapping.
        ValueError: `flexible` is neither.
    """
    if flexible is not None and flexible not in FLEXIBLE:
        raise ValueError(f"flexible is one of {', '.join(FLEXIBLE)}, not {flexible!r}")
    found = Found(text, name)
    checked = checked_tables(tables, name, found)
    return Model.from_data(data_of(checked, flexible or checked.flexible or BY_SECTION, found))


def checked_tables(tables: Mapping[str, Any], name: str, found: Found) -> Tables:
    """Tables in one form.

    Raises:
        TablesError: anything is wrong with them.
        TypeError: they are no mapping.
    """
    require_kind(tables, Mapping, "tables are a mapping")
    checked = tables_given({key: _plain(value) for key, value in tables.items()}, found)
    found.require_none()
    checked.name = checked.name or name
    return checked


def _plain(value: Any, depth: int = 0) -> Any:
    """Lists and numbers in place of numpy's, as deep as tables go."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if depth < _DEEPEST and isinstance(value, Mapping):
        return {key: _plain(each, depth + 1) for key, each in value.items()}
    if depth < _DEEPEST and isinstance(value, (list, tuple)):
        return [_plain(each, depth + 1) for each in value]
    return value


def tables_of(model: Model, remarks: list[Diagnostic] | None = None) -> dict[str, Any]:
    """The tables of a model, of lists, numbers and text alone.

    D(c) of `model_of` them is that of the model but for the order of its rows and columns.

    Args:
        model: The model.
        remarks: Gets a note each of what the tables do not hold, and of fields that only
            Flexact knows.

    Raises:
        DeckError, ModelError: the model is wrong.
        TypeError: it is no model.
    """
    require_kind(model, Model, "tables are made of a model")
    model.check()
    made, noted = tables_with_remarks(model.data)
    if remarks is not None:
        remarks.extend(noted.diagnostics())
    return made
