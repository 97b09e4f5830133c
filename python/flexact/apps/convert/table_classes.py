# SPDX-License-Identifier: BSD-3-Clause
"""What tables say of their nodes: what is fixed, what moves as it is told, masses, loads."""

from __future__ import annotations

from typing import NamedTuple

from ...core.elements import AXES, Class, NodeKind
from ...model.draft import Draft
from .fields import AXES as LETTERS
from .fields import LOADS, PRESCRIBED
from .problems import Found
from .remarks import Remarks
from .table_input import Entry, Tables


class NodeGiver(NamedTuple):
    """Gives the nodes of a draft what tables say of them.

    Attributes:
        tables: The tables.
        draft: The draft, with all its elements.
        position: Number of the position of each node of the tables.
        orientation: Likewise.
        used: Numbers of the nodes that an element uses.
        found: Where problems are noted.
        remarks: Where is noted what a model does not hold.
    """

    tables: Tables
    draft: Draft
    position: dict[int, int]
    orientation: dict[int, int]
    used: set[int]
    found: Found
    remarks: Remarks

    def add_classes(self) -> None:
        """What is fixed, and what is prescribed and so independent."""
        for point, entry in self.tables.nodes.items():
            if point > len(self.tables.places):
                continue
            stated: dict[tuple[int, int], Class] = {}
            self._fix(point, entry, stated)
            if self._prescribe(point, entry, stated):
                self.remarks.leave_out(PRESCRIBED)
            self.draft.coordinate_class.update(stated)

    def _axes(self, number: int) -> tuple[int, ...]:
        """Of a node that an element uses."""
        return AXES[self.draft.node_kind[number]] if number in self.used else ()

    def _fix(self, point: int, entry: Entry, stated: dict[tuple[int, int], Class]) -> None:
        position, orientation = self.position[point], self.orientation[point]
        for axis in self._axes(position):
            if any(entry.get(name) for name in ("fix", "fix_pos", f"fix_{LETTERS[axis]}")):
                stated[position, axis] = Class.FIXED
        for axis in self._axes(orientation):
            if any(entry.get(name) for name in ("fix", "fix_orien", f"fix_r{LETTERS[axis]}")):
                stated[orientation, axis] = Class.FIXED

    def _prescribe(self, point: int, entry: Entry, stated: dict[tuple[int, int], Class]) -> bool:
        """Make independent what moves as it is told; whether a value was told."""
        told = False
        for number, stem in ((self.position[point], "displ"), (self.orientation[point], "rot")):
            axes = self._axes(number)
            for start in (stem, f"{stem}_initial"):
                names = {f"{start}_{letter}": (axis,) for axis, letter in enumerate(LETTERS)}
                for name, wanted in {**names, start: axes}.items():
                    if name not in entry:
                        continue
                    value = entry[name]
                    told = told or bool(any(value) if isinstance(value, tuple) else value)
                    for axis in wanted:
                        self._state(point, name, (number, axis), stated)
        return told

    def _state(
        self, point: int, name: str, place: tuple[int, int], stated: dict[tuple[int, int], Class]
    ) -> None:
        where = f"nprops[{point}].{name}"
        if place[1] not in self._axes(place[0]):
            self.found.error(where, "no element gives the node this coordinate")
        elif stated.get(place) == Class.FIXED:
            self.found.error(where, "the coordinate is fixed, too: it cannot move as it is told")
        else:
            stated[place] = Class.INDEPENDENT

    def add_masses(self) -> None:
        """Masses of nodes."""
        for point, entry in self.tables.nodes.items():
            if point > len(self.tables.places):
                continue
            for name, number in (
                ("mass", self.position[point]),
                ("mominertia", self.orientation[point]),
            ):
                if name not in entry:
                    continue
                value = entry[name] if isinstance(entry[name], tuple) else (entry[name],)
                if self._require_use(point, name, number):
                    planar = self.draft.node_kind[number] == NodeKind.ANGLE
                    self.draft.give_node_mass(number, value[-1:] if planar else value)

    def add_loads(self) -> None:
        """Forces and moments of nodes, and gravity."""
        for point, entry in self.tables.nodes.items():
            if point > len(self.tables.places):
                continue
            for stem, number in (
                ("force", self.position[point]),
                ("moment", self.orientation[point]),
            ):
                for kind, end in LOADS.items():
                    name = f"{stem}{end}"
                    if name in entry and self._require_use(point, name, number):
                        axes = AXES[self.draft.node_kind[number]]
                        table: dict[int, tuple[float, ...]] = getattr(self.draft.loads, kind)
                        table[number] = self._in_scene(entry[name], axes)
        x, y, z = self._in_scene(self.tables.gravity, (0, 1) if self.tables.planar else (0, 1, 2))
        self.draft.loads.gravity = x, y, z

    def _in_scene(self, load: tuple[float, ...], axes: tuple[int, ...]) -> tuple[float, ...]:
        """A load without what is out of a plane."""
        made = tuple(value if axis in axes else 0.0 for axis, value in enumerate(load))
        self.remarks.leave_out("loads out of the plane", int(made != load))
        return made

    def _require_use(self, point: int, name: str, number: int) -> bool:
        if number in self.used:
            return True
        self.found.error(f"nprops[{point}].{name}", "no element uses this of the node")
        return False
