# SPDX-License-Identifier: BSD-3-Clause
"""From a model to tables: its points and what is said of them, its elements in sets."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.arrays import ModelArrays
from ...core.elements import AXES, Class, Member, NodeKind, Vector, element_kinds
from ...core.raw import ElementKind
from ...deck.tokens import comments_of
from ...model.data import CrossSection, ModelData
from ...model.draft import Shape
from .table_input import (
    INDEPENDENT,
    LETTERS,
    LOADS,
    NODE_FIELDS,
    NODES_A_POINT,
    OWN_FIELDS,
    Entry,
    Remarks,
    density_of,
    is_ordinary,
    moduli_of,
)

#: Index of the position and of the orientation of a point, -1 where it has none; or the two points
#: of an element, by numbers from 1.
Pairs = tuple[tuple[int, int], ...]


def _shared(points: Pairs, which: int) -> dict[int, int]:
    """Points that share their position (0), or orientation (1), with the first that has it."""
    first: dict[int, int] = {}
    made = {}
    for point, nodes in enumerate(points, start=1):
        if nodes[which] >= 0 and first.setdefault(nodes[which], point) != point:
            made[point] = first[nodes[which]]
    return made


def points_of(arrays: ModelArrays) -> tuple[Pairs, Pairs]:
    """The points of a sound model as the elements name them, and the two ends of each element."""
    slots = (arrays.element_node.T - 1).tolist()
    of_position: dict[int, tuple[int, int]] = {}
    of_orientation: dict[int, tuple[int, int]] = {}
    for p, turned_p, q, turned_q in slots:
        for pair in ((p, turned_p), (q, turned_q)):
            if min(pair) >= 0:
                of_position.setdefault(pair[0], pair)
                of_orientation.setdefault(pair[1], pair)
    _add_turned(arrays, slots, of_orientation)
    order: dict[tuple[int, int], int] = {}

    def point(position: int, orientation: int) -> int:
        """The number of the point where an element ends."""
        pair = position, orientation
        if position < 0:
            pair = of_orientation[orientation]
        elif orientation < 0:
            pair = of_position.setdefault(position, pair)
        return order.setdefault(pair, len(order) + 1)

    ends = tuple((point(*nodes[:2]), point(*nodes[2:])) for nodes in slots)
    return tuple(order), ends


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


def _places(data: ModelData, points: Pairs) -> list[list[float]]:
    """Coordinates of each point."""
    width = 2 if data.planar else 3
    values = data.arrays.node_value.T[:, :width].tolist()
    return [values[p] if p >= 0 else [0.0] * width for p, _ in points]


def _points_said(
    data: ModelData, points: Pairs, ends: Pairs, kinds: list[ElementKind], remarks: Remarks
) -> list[Entry]:
    """What is said of each point."""
    same_pos, same_orien = _shared(points, 0), _shared(points, 1)
    places = _places(data, points)
    # Else a hinge between points at one place joins them there.
    hinged = {
        max(p, q)
        for (p, q), kind in zip(ends, kinds, strict=True)
        if kind.keyword == "HINGE"
        and places[p - 1] == places[q - 1]
        and same_pos.get(p, p) != same_pos.get(q, q)
    }
    made: list[Entry] = []
    for point, (position, orientation) in enumerate(points, start=1):
        entry: Entry = {}
        if point in same_pos or point in hinged:
            entry["same_pos"] = same_pos.get(point, point)
        if point in same_orien:
            entry["same_orien"] = same_orien[point]
        own = (
            position if point not in same_pos else -1,
            orientation if point not in same_orien else -1,
        )
        entry |= _classes(data, own, bool(entry))
        entry |= _masses(data, own, remarks)
        entry |= _loads(data, own)
        if own[0] >= 0 and (name := data.node_names[own[0]]):
            entry["name"] = name
        made.append(entry)
    return made


def _classes(data: ModelData, own: tuple[int, int], shares: bool) -> Entry:
    """What is fixed of the nodes of a point, and what is independent."""
    entry: Entry = {}
    whole = []
    axes = [AXES[int(data.arrays.node_kind[node])] if node >= 0 else () for node in own]
    classes = [data.arrays.coordinate_class[:, node] for node in own]
    for of_node, given, name, stem in zip(
        axes, classes, ("fix_pos", "fix_orien"), ("", "r"), strict=True
    ):
        fixed = [axis for axis in of_node if given[axis] == Class.FIXED]
        if of_node and len(fixed) == len(of_node):
            whole.append(name)
        else:
            entry |= {f"fix_{stem}{LETTERS[axis]}": True for axis in fixed}
    if whole and not shares and len(whole) == sum(map(bool, axes)):
        whole = ["fix"]
    entry |= dict.fromkeys(whole, True)
    for of_node, given, stem in zip(axes, classes, ("displ", "rot"), strict=True):
        free = (axis for axis in of_node if given[axis] == Class.INDEPENDENT)
        entry |= {f"{stem}_{LETTERS[axis]}": 0.0 for axis in free}
    return entry


def _masses(data: ModelData, own: tuple[int, int], remarks: Remarks) -> Entry:
    entry: Entry = {}
    if data.properties is None:
        return entry
    for node, name, size in zip(own, ("mass", "mominertia"), (1, 6), strict=True):
        given = data.properties.node_mass[node] if node >= 0 else np.full(6, np.nan)
        if np.isnan(given[0]):
            continue
        numbers = given[~np.isnan(given)].tolist()
        given_as: Any = numbers[0] if size == 1 else numbers + [0.0] * (6 - len(numbers))
        try:
            fits = len(numbers) <= size and NODE_FIELDS[name](given_as) is not None
        except ValueError:
            fits = False
        if not fits:
            remarks.leave_out("masses of nodes that are no mass or six moments")
        elif size == 6 and data.arrays.node_kind[node] == NodeKind.ANGLE:
            entry[name] = [0.0] * 5 + numbers[:1]
        else:
            entry[name] = given_as
    return entry


def _loads(data: ModelData, own: tuple[int, int]) -> Entry:
    if data.loads is None:
        return {}
    return {
        f"{stem}{end}": load
        for kind, end in LOADS.items()
        for node, stem in zip(own, ("force", "moment"), strict=True)
        if node >= 0 and any(load := getattr(data.loads, kind)[node].tolist())
    }


_CROSS_SECTIONS = {CrossSection.RECT: "rect", CrossSection.CIRC: "circ"}


def _sets(data: ModelData, kinds: list[ElementKind], remarks: Remarks) -> list[Entry]:
    """Elements that share all their fields."""
    alike: dict[str, Entry] = {}
    for i, kind in enumerate(kinds):
        entry: Entry = {}
        if kind.keyword != ("PLBEAM" if data.planar else "BEAM"):
            entry["type"] = kind.keyword.lower()
        if name := data.element_names[i]:
            entry["name"] = name
        classes = data.arrays.deformation_class[:, i]
        flexible = np.isin(classes, (Class.DEPENDENT, Class.INDEPENDENT))
        if flexible.any():
            entry["flex"] = (np.flatnonzero(flexible) + 1).tolist()
        vector = data.arrays.element_vector[:, i]
        if vector.any():
            entry["orien"] = vector.tolist()
        elif kind.member == Member.BEAM and kind.vector != Vector.NONE:
            # The tables have another local y axis where none is given.
            entry["orien"] = data.frames.frame[i, :, 1].tolist()
        entry |= _section(data, i, kind, remarks)
        look = data.appearance
        if not np.isnan(look.colour[i]).any():
            entry["color"] = look.colour[i].tolist()
        if not np.isnan(look.opacity[i]):
            entry["opacity"] = float(look.opacity[i])
        if not look.drawn[i]:
            entry["hide"] = True
        if not np.isnan(look.edge_colour[i]).any():
            remarks.leave_out("colours of edges")
        alike.setdefault(repr(entry), {"elems": [], **entry})["elems"].append(i + 1)
    return list(alike.values())


def _section(data: ModelData, i: int, kind: ElementKind, remarks: Remarks) -> Entry:
    """Cross-section, moduli and density of an element."""
    entry: Entry = {}
    look, given = data.appearance, data.properties
    section = CrossSection(int(look.cross_section[i]))
    sizes: list[float] = look.dimensions[i].tolist()
    shape = None
    if section in _CROSS_SECTIONS and is_ordinary(Shape(section, sizes[0], sizes[1])):
        shape = Shape(section, sizes[0], sizes[1])
        entry["cshape"] = _CROSS_SECTIONS[section]
        entry["dim"] = sizes[:1] if section is CrossSection.CIRC else sizes
    elif section or any(sizes):
        remarks.leave_out("cross-sections other than whole rectangles and circles")
    if given is None:
        return entry
    for name, words in (
        ("strength", "strengths"),
        ("expansion", "coefficients of expansion"),
        ("fillet", "radii of fillets"),
    ):
        remarks.leave_out(words, int(not np.isnan(getattr(given, name)[i, 0])))
    stiff, heavy = (
        tuple(row[~np.isnan(row)].tolist()) for row in (given.stiffness[i], given.mass[i])
    )
    moduli = moduli_of(kind, shape, stiff) if stiff and shape is not None else None
    if moduli is not None:
        entry |= moduli[0]
        times = int(moduli[1])
        remarks.leave_out("shear stiffness, which follows from the cross-section", times)
    elif stiff:
        remarks.leave_out("stiffness that no moduli and cross-section give")
    density = density_of(kind, shape, heavy) if heavy and shape is not None else None
    if density is not None:
        entry["dens"] = density
    elif heavy:
        remarks.leave_out("mass of elements that no density and cross-section give")
    return entry


def tables_with_remarks(data: ModelData) -> tuple[dict[str, Any], Remarks]:
    """The tables of a sound model, and what they do not hold."""
    remarks = Remarks()
    points, ends = points_of(data.arrays)
    every = element_kinds()
    kinds = [every[kind - 1] for kind in data.arrays.element_kind.tolist()]
    sets = _sets(data, kinds, remarks)
    is_released = data.arrays.deformation_class == Class.DEPENDENT
    releases = [(np.flatnonzero(modes) + 1).tolist() for modes in is_released.T]
    made: dict[str, Any] = {
        "nodes": _places(data, points),
        "elements": [list(both) for both in ends],
        "nprops": _points_said(data, points, ends, kinds, remarks),
        "eprops": sets,
    }
    if any("flex" in entry or "hinge" in entry.get("type", "") for entry in sets):
        # By section they would be read as a designer means them, and not as a deck says.
        made["flexible"] = INDEPENDENT
        remarks.own["flexible"] = 1
    if any(releases):
        made["opt"] = {"rls": [{"def": modes} for modes in releases]}
    if data.loads is not None and data.loads.gravity.any():
        made.setdefault("opt", {})["gravity"] = data.loads.gravity.tolist()
    _note_the_rest(data, points, remarks)
    for entry in (*made["nprops"], *sets):
        remarks.own.update(name for name in entry if name in OWN_FIELDS)
    if data.planar:
        remarks.own["nodes with x and y"] = len(made["nodes"])
    return made, remarks


def _note_the_rest(data: ModelData, points: Pairs, remarks: Remarks) -> None:
    a = data.arrays
    elements = a.element_number.size
    numbered = a.element_number.tolist() == list(range(1, elements + 1)) and all(
        node < 0 or a.node_number[node] == NODES_A_POINT * (point - 1) + slot
        for point, nodes in enumerate(points, start=1)
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
