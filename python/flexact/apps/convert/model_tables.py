# SPDX-License-Identifier: BSD-3-Clause
"""Of a model's points: the table of nodes and what is said of each."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import ModelArrays
from ...core.elements import AXES, Class, Member, NodeKind, Vector, element_kinds
from ...core.raw import ElementKind
from ...deck.comments import comments_of
from ...model.attributes import CrossSection
from ...model.data import ModelData
from ...model.draft import Shape
from .table_input import Entry, density_of, is_ordinary, moduli_of
from .values import AXES as LETTERS
from .values import ELEMENT_FIELDS, LOADS, NODE_FIELDS, NODES_A_POINT, Remarks


class Points(NamedTuple):
    """Points by number from 1, in the order in which the elements name them.

    Attributes:
        nodes: Index of the position and of the orientation of each; -1 where it has none.
        ends: The two points of each element.
    """

    nodes: tuple[tuple[int, int], ...]
    ends: tuple[tuple[int, int], ...]

    @property
    def same_position(self) -> dict[int, int]:
        """Points that share their position with an earlier one, with the first that does."""
        return _shared([position for position, _ in self.nodes])

    @property
    def same_orientation(self) -> dict[int, int]:
        """Likewise of orientations."""
        return _shared([orientation for _, orientation in self.nodes])


def _shared(nodes: list[int]) -> dict[int, int]:
    first: dict[int, int] = {}
    made = {}
    for point, node in enumerate(nodes, start=1):
        if node >= 0 and first.setdefault(node, point) != point:
            made[point] = first[node]
    return made


def points_of(arrays: ModelArrays) -> Points:
    """The points of a sound model."""
    slots = (arrays.element_node.T - 1).tolist()
    pairs: dict[tuple[int, int], None] = {}
    for nodes in slots:
        for end in (nodes[:2], nodes[2:]):
            if min(end) >= 0:
                pairs[end[0], end[1]] = None
    of_position: dict[int, tuple[int, int]] = {}
    of_orientation: dict[int, tuple[int, int]] = {}
    for pair in pairs:
        of_position.setdefault(pair[0], pair)
        of_orientation.setdefault(pair[1], pair)
    _add_turned(arrays, slots, of_orientation)
    ends = []
    for nodes in slots:
        both = []
        for position, orientation in (nodes[:2], nodes[2:]):
            if min(position, orientation) >= 0:
                pair = position, orientation
            elif position >= 0:
                pair = of_position.setdefault(position, (position, -1))
            else:
                pair = of_orientation[orientation]
            both.append(pair)
        ends.append(both)
    order: dict[tuple[int, int], int] = {}
    for both in ends:
        for pair in both:
            order.setdefault(pair, len(order) + 1)
    return Points(tuple(order), tuple((order[p], order[q]) for p, q in ends))


def _add_turned(
    arrays: ModelArrays, slots: list[list[int]], known: dict[int, tuple[int, int]]
) -> None:
    """Orientations that stand nowhere are where those stand that a hinge joins them to."""
    kinds = element_kinds()
    hinges = [
        (nodes[1], nodes[3])
        for kind, nodes in zip(arrays.element_kind.tolist(), slots, strict=True)
        if not kinds[kind - 1].slots[0]
    ]
    waiting = hinges
    while waiting:
        left = []
        for one, other in waiting:
            if one in known:
                known.setdefault(other, (known[one][0], other))
            elif other in known:
                known[one] = known[other][0], one
            else:
                left.append((one, other))
        if len(left) == len(waiting):
            one, _ = left[0]
            known[one] = -1, one
        waiting = left


class NodeTables:
    """Places and fields of the points of a model."""

    def __init__(
        self, data: ModelData, points: Points, kinds: list[ElementKind], remarks: Remarks
    ) -> None:
        """Of a sound model, its points and the kinds of its elements."""
        self.data, self.points, self.kinds, self.remarks = data, points, kinds, remarks

    def places(self) -> list[list[float]]:
        """Coordinates of each node."""
        width = 2 if self.data.planar else 3
        values = self.data.arrays.node_value.T[:, :width].tolist()
        return [values[p] if p >= 0 else [0.0] * width for p, _ in self.points.nodes]

    def fields(self) -> list[Entry]:
        """What is said of each node."""
        a = self.data.arrays
        classes = a.coordinate_class.T.tolist()
        same_pos, same_orien = self.points.same_position, self.points.same_orientation
        hinged = self._hinged(same_pos)
        made: list[Entry] = []
        for point, (position, orientation) in enumerate(self.points.nodes, start=1):
            entry: Entry = {}
            if point in same_pos:
                entry["same_pos"] = same_pos[point]
            elif point in hinged:
                # Else a hinge between points at one place joins them there.
                entry["same_pos"] = point
            if point in same_orien:
                entry["same_orien"] = same_orien[point]
            own = (
                position if point not in same_pos else -1,
                orientation if point not in same_orien else -1,
            )
            self._add_fixed(entry, own, classes)
            self._add_independent(entry, own, classes)
            self._add_mass(entry, own)
            self._add_loads(entry, own)
            if own[0] >= 0 and (name := self.data.node_names[own[0]]):
                entry["name"] = name
            made.append(entry)
        return made

    def _hinged(self, same: dict[int, int]) -> set[int]:
        places = self.places()
        return {
            max(p, q)
            for (p, q), kind in zip(self.points.ends, self.kinds, strict=True)
            if kind.keyword == "HINGE"
            and places[p - 1] == places[q - 1]
            and same.get(p, p) != same.get(q, q)
        }

    def _of_class(self, node: int, classes: list[list[int]], wanted: Class) -> list[int]:
        """Axes of a node that have a class."""
        if node < 0:
            return []
        axes = AXES[int(self.data.arrays.node_kind[node])]
        return [axis for axis in axes if classes[node][axis] == wanted]

    def _add_fixed(self, entry: Entry, own: tuple[int, int], classes: list[list[int]]) -> None:
        whole = []
        for node, all_of_it, stem in zip(own, ("fix_pos", "fix_orien"), ("", "r"), strict=True):
            axes = self._of_class(node, classes, Class.FIXED)
            if node >= 0 and len(axes) == len(AXES[int(self.data.arrays.node_kind[node])]):
                whole.append(all_of_it)
            else:
                entry.update({f"fix_{stem}{LETTERS[axis]}": True for axis in axes})
        shares = not entry.keys().isdisjoint(("same_pos", "same_orien"))
        if whole and not shares and len(whole) == sum(node >= 0 for node in own):
            entry["fix"] = True
        else:
            entry.update(dict.fromkeys(whole, True))

    def _add_independent(
        self, entry: Entry, own: tuple[int, int], classes: list[list[int]]
    ) -> None:
        for node, stem in zip(own, ("displ", "rot"), strict=True):
            for axis in self._of_class(node, classes, Class.INDEPENDENT):
                entry[f"{stem}_{LETTERS[axis]}"] = 0.0

    def _add_mass(self, entry: Entry, own: tuple[int, int]) -> None:
        if self.data.properties is None:
            return
        for node, name, size in zip(own, ("mass", "mominertia"), (1, 6), strict=True):
            given = self.data.properties.node_mass[node] if node >= 0 else np.full(6, np.nan)
            if np.isnan(given[0]):
                continue
            numbers = given[~np.isnan(given)].tolist()
            given_as: Any = numbers[0] if size == 1 else numbers + [0.0] * (6 - len(numbers))
            try:
                fits = len(numbers) <= size and NODE_FIELDS[name].check(given_as) is not None
            except ValueError:
                fits = False
            if not fits:
                self.remarks.leave_out("masses of nodes that are no mass or six moments")
            elif size == 6 and self.data.arrays.node_kind[node] == NodeKind.ANGLE:
                entry[name] = [0.0] * 5 + numbers[:1]
            else:
                entry[name] = given_as

    def _add_loads(self, entry: Entry, own: tuple[int, int]) -> None:
        for kind, end in LOADS.items():
            for node, stem in zip(own, ("force", "moment"), strict=True):
                if self.data.loads is None or node < 0:
                    continue
                load = getattr(self.data.loads, kind)[node].tolist()
                if any(load):
                    entry[f"{stem}{end}"] = load


_CROSS_SECTIONS = {CrossSection.RECT: "rect", CrossSection.CIRC: "circ"}


class ElementTables:
    """Fields of the elements of a model."""

    def __init__(self, data: ModelData, kinds: list[ElementKind], remarks: Remarks) -> None:
        """Of a sound model, and the kinds of its elements."""
        self.data, self.kinds, self.remarks = data, kinds, remarks

    def sets(self) -> tuple[list[Entry], list[list[int]]]:
        """Elements that share all their fields, and what is released of each element."""
        classes = self.data.arrays.deformation_class.T
        alike: dict[str, Entry] = {}
        releases = []
        for i in range(len(self.kinds)):
            released = (np.flatnonzero(classes[i] == Class.DEPENDENT) + 1).tolist()
            releases.append(released)
            entry = self._set_of(i)
            key = repr(entry)
            alike.setdefault(key, {"elems": [], **entry})["elems"].append(i + 1)
        return list(alike.values()), releases

    def _set_of(self, i: int) -> Entry:
        kind = self.kinds[i]
        entry: Entry = {}
        if kind.keyword != ("PLBEAM" if self.data.planar else "BEAM"):
            entry["type"] = kind.keyword.lower()
        if name := self.data.element_names[i]:
            entry["name"] = name
        classes = self.data.arrays.deformation_class[:, i]
        flexible = (classes == Class.DEPENDENT) | (classes == Class.INDEPENDENT)
        if flexible.any():
            entry["flex"] = (np.flatnonzero(flexible) + 1).tolist()
        if (vector := self._vector(i, kind)) is not None:
            entry["orien"] = vector
        self._add_section(entry, i, kind)
        self._add_look(entry, i)
        return entry

    def _vector(self, i: int, kind: ElementKind) -> list[float] | None:
        given: list[float] = self.data.arrays.element_vector[:, i].tolist()
        if any(given):
            return given
        if kind.member == Member.BEAM and kind.vector != Vector.NONE:
            # The tables have another local y axis where none is given.
            axis: list[float] = self.data.frames.frame[i, :, 1].tolist()
            return axis
        return None

    def _add_section(self, entry: Entry, i: int, kind: ElementKind) -> None:
        look, given = self.data.appearance, self.data.properties
        section = CrossSection(int(look.cross_section[i]))
        sizes: list[float] = look.dimensions[i].tolist()
        shape = None
        if section in _CROSS_SECTIONS and is_ordinary(Shape(section, sizes[0], sizes[1])):
            shape = Shape(section, sizes[0], sizes[1])
            entry["cshape"] = _CROSS_SECTIONS[section]
            entry["dim"] = sizes[:1] if section is CrossSection.CIRC else sizes
        elif section or any(sizes):
            self.remarks.leave_out("cross-sections other than whole rectangles and circles")
        if given is None:
            return
        stiff, heavy = (row[~np.isnan(row)] for row in (given.stiffness[i], given.mass[i]))
        if stiff.size:
            found = None if shape is None else moduli_of(kind, shape, tuple(stiff.tolist()))
            if found is None:
                self.remarks.leave_out("stiffness that no moduli and cross-section give")
            else:
                entry.update(found[0])
                if found[1]:
                    self.remarks.leave_out("shear stiffness, which follows from the cross-section")
        if heavy.size:
            density = None if shape is None else density_of(kind, shape, tuple(heavy.tolist()))
            if density is None:
                self.remarks.leave_out("mass of elements that no density and cross-section give")
            else:
                entry["dens"] = density

    def _add_look(self, entry: Entry, i: int) -> None:
        look = self.data.appearance
        if not np.isnan(look.colour[i]).any():
            entry["color"] = look.colour[i].tolist()
        if not np.isnan(look.opacity[i]):
            entry["opacity"] = float(look.opacity[i])
        if not look.drawn[i]:
            entry["hide"] = True
        if not np.isnan(look.edge_colour[i]).any():
            self.remarks.leave_out("colours of edges")


def tables_with_remarks(data: ModelData) -> tuple[dict[str, Any], Remarks]:
    """The tables of a sound model, and what they do not hold."""
    remarks, points = Remarks(), points_of(data.arrays)
    every = element_kinds()
    kinds = [every[kind - 1] for kind in data.arrays.element_kind.tolist()]
    nodes = NodeTables(data, points, kinds, remarks)
    sets, releases = ElementTables(data, kinds, remarks).sets()
    made: dict[str, Any] = {
        "nodes": nodes.places(),
        "elements": [list(ends) for ends in points.ends],
        "nprops": nodes.fields(),
        "eprops": sets,
    }
    if any(releases):
        made["opt"] = {"rls": [{"def": modes} for modes in releases]}
    if data.loads is not None and data.loads.gravity.any():
        made.setdefault("opt", {})["gravity"] = data.loads.gravity.tolist()
    _note_the_rest(data, points, remarks)
    for fields, entries in ((NODE_FIELDS, made["nprops"]), (ELEMENT_FIELDS, sets)):
        for entry in entries:
            remarks.own.update(name for name in entry if fields[name].is_own)
    if data.planar:
        remarks.own["nodes with x and y"] = len(made["nodes"])
    return made, remarks


def _note_the_rest(data: ModelData, points: Points, remarks: Remarks) -> None:
    a = data.arrays
    elements = a.element_number.size
    numbered = a.element_number.tolist() == list(range(1, elements + 1)) and all(
        node < 0 or a.node_number[node] == NODES_A_POINT * (point - 1) + slot
        for point, nodes in enumerate(points.nodes, start=1)
        for slot, node in enumerate(nodes, start=1)
    )
    if not numbered:
        what = "numbers of elements and nodes are now those of their rows"
        remarks.leave_out(what, elements + a.node_number.size)
    turned = a.node_kind == NodeKind.ORIENTATION
    upright = np.array([1.0, 0.0, 0.0, 0.0]) == a.node_value.T
    angles = (a.node_kind == NodeKind.ANGLE) & (a.node_value[0] != 0.0)
    turned = (turned & ~upright.all(axis=1)) | angles
    remarks.leave_out("reference values of orientations", int(turned.sum()))
    comments = comments_of(data.source or data.began_as)
    lines = sum(map(len, (comments.top, comments.end, comments.rest)))
    lines += sum(len(x) for part in (comments.before, comments.behind) for x in part.values())
    remarks.leave_out("lines of comment", lines)
