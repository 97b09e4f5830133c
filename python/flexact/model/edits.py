# SPDX-License-Identifier: BSD-3-Clause
"""What is said of what a draft has: classes, loads, looks, material; moving, renaming, deleting."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence

import numpy as np

from ..core.elements import (
    AXES,
    Class,
    NodeKind,
    coordinate_name,
    element_kinds,
    is_position,
)
from ..deck.rendering import model_error
from ..util.groups import grouped
from ..util.quantities import Quantity
from ..util.text import in_short
from .arguments import (
    Point,
    drawn_elements,
    indices_of,
    is_chain,
    named_part,
    nodes_of,
    numbers,
    part,
    several,
    vector,
)
from .draft import ROUNDING, Colour, Draft, Said
from .handles import (
    Assembly,
    Body,
    CutNotch,
    Element,
    FoldedSheet,
    Node,
    Part,
    ReinforcedSheet,
    Sheet,
    Wire,
)
from .names import is_coordinate, nearest, part_name
from .sections import (
    MaterialLike,
    Section,
    made_of,
    material_of,
    round_section,
    shape_of,
    sheet_section,
    sheet_shape,
)
from .transform import Transform, Vector


def fixed_targets(draft: Draft, given: Sequence[object]) -> tuple[list[object], list[object]]:
    """What is to be fixed: points or nodes, and names of coordinates.

    Raises:
        ModelError: there is no point, or a text is neither.
    """
    names = [each for each in given if is_coordinate(each)]
    targets = [each for each in given if not is_coordinate(each)]
    if not targets:
        raise model_error("not-a-node", "fix needs a point", 'such as fix("clamp 1", "x")')
    points, parts = draft.points_by_name, draft.parts_by_name
    for each in targets[1:]:
        if isinstance(each, str) and each not in points and each not in parts:
            near = nearest(each, [*points, *parts])
            hint = f"did you mean {' or '.join(map(in_short, near))}?" if near else ""
            raise model_error(
                "component-out-of-range",
                f"there is no coordinate or point {in_short(each)}",
                hint or "coordinates are x, y, z, rx, ry, rz",
            )
    return targets, names


def give_coordinates(
    draft: Draft, targets: Sequence[object], names: Sequence[object], value: Class
) -> None:
    """Give coordinates of points or nodes a class; all where none is named.

    Raises:
        ModelError: something of it is wrong; then nothing has changed.
    """
    nodes = [nodes_of(draft, target) for target in targets]
    places = [place for numbers in nodes for place in _places(draft, numbers, names)]
    draft.state_coordinates(places, value)
    if names:
        draft.named.update(places)
    else:
        draft.whole += [(numbers[0], numbers[-1]) for numbers in nodes]


def clear_coordinates(draft: Draft, target: object, names: Sequence[object]) -> None:
    """Take back the classes of coordinates, which are dependent then; all where none is named."""
    numbers = nodes_of(draft, target)
    places = _places(draft, numbers, names)
    for place in places:
        draft.coordinate_class.pop(place, None)
    draft.named.difference_update(places)
    if not names:
        draft.whole = [both for both in draft.whole if both[0] not in numbers]


def _places(draft: Draft, numbers: Sequence[int], names: Sequence[object]) -> list[tuple[int, int]]:
    """Nodes and axes of the coordinates of these names, of all where none is named."""
    every = {
        coordinate_name(draft.node_kind[n], k): (n, k)
        for n in numbers
        for k in AXES[draft.node_kind[n]]
    }
    if not names:
        return list(every.values())
    found = []
    for name in names:
        if not (isinstance(name, str) and name in every):
            raise model_error(
                "component-out-of-range",
                f"{draft.node_words(numbers[0])} has no coordinate {in_short(name)}",
                f"it has {', '.join(every)}",
            )
        found.append(every[name])
    return found if draft.frame is None else _of_frame(draft, found, draft.frame)


def _of_frame(
    draft: Draft, found: list[tuple[int, int]], frame: Transform
) -> list[tuple[int, int]]:
    """Coordinates of the model that are those of a frame.

    Raises:
        ModelError: they are none, as those along axes that lie askew.
    """
    made = []
    for number, axes in grouped(found).items():
        turned = frame.axes(set(axes))
        if turned is None:
            raise model_error(
                "turned-class",
                f"axes of this frame are askew: along them {draft.node_words(number)} "
                "has no coordinate",
                "name all three of a kind, or name coordinates of the model outside of the frame",
            )
        made += [(number, k) for k in sorted(turned)]
    return made


def node_with(draft: Draft, point: Point | int, wants_position: bool) -> int:
    """The node of a point that bears forces, its position, or moments, its orientation.

    Raises:
        ModelError: there is no such point, or the node of this number is of the other kind.
    """
    numbers = nodes_of(draft, point)
    for number in numbers:
        if is_position(draft.node_kind[number]) == wants_position:
            return number
    raise model_error(
        "two-kinds-of-node",
        f"node {numbers[0]} is {'an orientation' if wants_position else 'a position'}",
        "a position has a force, an orientation a moment",
    )


def load(
    draft: Draft,
    x: Quantity | Sequence[Quantity],
    y: Quantity | None,
    z: Quantity | None,
    what: str,
    unit: str,
) -> Vector:
    """Three numbers in the frame at hand; the last may be missing, in a plane must be nothing."""
    given: tuple[object, ...] = (x, y, 0.0 if z is None else z)
    if y is None and z is None:
        given = several(x, f"the components of a {what}") or given
    if len(given) == 2:
        given = (*given, 0.0)
    made = vector(given, what, draft.units.symbol(unit))  # type: ignore[arg-type]
    if draft.planar and made[2]:
        raise model_error("bad-number", f"the {what} has a z component in a planar model")
    return draft.turned(made)


def moment(
    draft: Draft,
    node: int,
    x: Quantity | Sequence[Quantity],
    y: Quantity | None,
    z: Quantity | None,
) -> Vector:
    """As `load`; at a planar orientation one number, the moment about z."""
    if draft.node_kind[node] != NodeKind.ANGLE:
        return load(draft, x, y, z, "moment", "N m")
    given = (x, y, z) if y is not None or z is not None else (0.0, 0.0, x)
    if any(given[:2]):
        raise model_error("bad-number", "a planar moment is one number, that about z")
    return vector((0.0, 0.0, given[2]), "moment", draft.units.symbol("N m"))  # type: ignore[arg-type]


def delete_elements(draft: Draft, indices: Iterable[int], ends: bool = False) -> None:
    """Delete elements, and the points between the beams of a chain that nobody else uses.

    With `ends` all their points that nobody else uses.
    """
    gone = set(indices)
    nodes = {n for index in gone for n in draft.slots[index]} - {0}
    # Nodes at which one of these elements ends and the next begins.
    begins = {n for index in gone for n in draft.slots[index][:2]}
    finishes = {n for index in gone for n in draft.slots[index][2:]}
    stated = {number for number, _ in draft.coordinate_class}
    inner = nodes if ends else (begins & finishes) - stated - {0}
    draft.keep_elements([i for i in range(len(draft.kinds)) if i not in gone])
    for number in inner - {node for slots in draft.slots for node in slots}:
        draft.drop_node(number)


def delete_point(draft: Draft, point: Node) -> None:
    """Delete the nodes of a point.

    Raises:
        ModelError: an element uses them.
    """
    nodes = {point.position, point.orientation}
    users = [i for i, slots in enumerate(draft.slots) if nodes & set(slots)]
    if users:
        parts = {i: part_name(draft.names.get(i, "")) for i in users}
        names = dict.fromkeys(
            in_short(name) if name else draft.element_words(i) for i, name in parts.items()
        )
        raise model_error(
            "in-use",
            f"{point.words} is used by {', '.join(names)}",
            "delete these parts first, or move the point",
        )
    for number in nodes:
        draft.drop_node(number)


def move_node(draft: Draft, number: int, value: tuple[float, float, float, float]) -> None:
    """Move a position node, and the inner points of divided flexures that end there."""
    divided = [
        indices
        for indices in draft.parts_by_name.values()
        if len(indices) > 1
        and is_chain(draft, indices)
        and Class.INDEPENDENT in draft.classes[indices[1]]
        and number in (draft.slots[indices[0]][0], draft.slots[indices[-1]][2])
    ]
    shares = {indices[0]: _shares(draft, indices) for indices in divided}
    draft.node_value[number] = value
    for indices in divided:
        start = draft.node_value[draft.slots[indices[0]][0]]
        end = draft.node_value[draft.slots[indices[-1]][2]]
        for t, index in zip(shares[indices[0]], indices[1:], strict=True):
            x, y, z = (start[i] * (1.0 - t) + end[i] * t for i in range(3))
            draft.node_value[draft.slots[index][0]] = (x, y, z, 0.0)
    draft.changed_names_or_places()


def _shares(draft: Draft, indices: list[int]) -> list[float]:
    """Where the inner points of beams in a row are, as shares of its length."""
    ends = [(draft.slots[index][0], draft.slots[index][2]) for index in indices]
    lengths = [math.dist(draft.node_value[p][:3], draft.node_value[q][:3]) for p, q in ends]
    whole, n = sum(lengths), len(indices)
    if max(lengths) - min(lengths) <= ROUNDING * whole:
        return [k / n for k in range(1, n)]
    return [reached / whole for reached in itertools.accumulate(lengths[:-1])]


def rename_part(draft: Draft, target: object, name: str) -> None:
    """Give a part another name: every beam and link of it."""
    if isinstance(target, (ReinforcedSheet, CutNotch)):
        for word, piece in target.pieces.items():
            rename_part(draft, piece, name if word == "hinge" else f"{name}, {word}")
        return
    leaves = target.leaves if isinstance(target, FoldedSheet) else (target,)
    for k, leaf in enumerate(leaves, 1):
        own = name if len(leaves) == 1 else f"{name}, leaf {k}"
        for index in indices_of(draft, part(draft, leaf)):
            old = draft.names.get(index, "")
            draft.name_element(index, own + old[len(part_name(old)) :])


def names_part(draft: Draft, target: object) -> bool:
    """Whether a target is a part rather than a point.

    Raises:
        ModelError: it is the name of both.
    """
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


def make_of(
    draft: Draft,
    target: object,
    material: MaterialLike | None,
    section: Section | None,
    thickness: Quantity | None,
    breadth: Quantity | None,
    warping: bool | float,
) -> None:
    """Say what flexures are made of; in place of a section that is not given stands the old one.

    Of a body it is how it expands.
    """
    if isinstance(target, str):
        target = named_part(draft, target)
    if isinstance(target, Body) and material is not None:
        found_material = material_of(material, draft.units)
        if found_material.expansion is None:
            raise model_error(
                "no-expansion",
                f"of the material {in_short(found_material.name)} no expansion is known",
                "give flexact.Material(name, E, G, density, expansion=12e-6)",
            )
        for index in indices_of(draft, target):
            draft.give_properties(index, expansion=(found_material.expansion,))
        return
    flexures = _flexures(target)
    if not flexures:
        raise model_error("no-section", "there is no flexure in it to be made of something")
    for each in flexures:
        found = part(draft, each)
        indices = indices_of(draft, found)
        sheet = isinstance(found, Sheet)
        if sheet:
            shape = sheet_section(draft.units, section, thickness, breadth)
        else:
            shape = round_section(draft.units, section, thickness)
        known = {draft.said.get(index, {}).get("shape") for index in indices}
        if shape is not None and len(known) > 1:
            raise model_error(
                "several-sections",
                f"{in_short(each.name)} has several sections",  # type: ignore[attr-defined]
                "leave the sizes out, or delete it and make it anew",
            )
        p, q = draft.slots[indices[0]][0], draft.slots[indices[-1]][2]
        for index in indices:
            kind = element_kinds()[draft.kinds[index] - 1]
            given = shape or draft.said.get(index, {}).get("shape")
            made = made_of(draft.units, kind, given, material, "sheet" if sheet else "wire")
            if sheet:
                length = math.dist(draft.node_value[p][:3], draft.node_value[q][:3])
                made = made.with_warping(warping, length)
            draft.give_properties(index, *made.numbers)
            if made.shape is not None:
                draft.say_looks([index], {"shape": made.shape})


def _flexures(target: object) -> list[object]:
    """The flexures of an assembly or folded sheet, or the part itself."""
    if isinstance(target, FoldedSheet):
        return list(target.leaves)
    if isinstance(target, ReinforcedSheet):
        return [each for each in target.pieces.values() if isinstance(each, Sheet)]
    if isinstance(target, Assembly):
        return [each for made in target.parts.values() for each in _flexures(made)]
    is_other = isinstance(target, Part) and not isinstance(target, (Sheet, Wire))
    return [] if is_other else [target]


def give_looks(
    draft: Draft,
    target: object,
    section: Section | None,
    colour: Sequence[float] | None,
    edge_colour: Sequence[float] | None,
    opacity: float | None,
    drawn: bool | None,
) -> None:
    """Say how elements are drawn.

    Raises:
        ModelError: something of it is wrong; then nothing has changed.
    """
    if isinstance(target, str):
        target = named_part(draft, target)
    indices = drawn_elements(draft, target)
    is_sheet = isinstance(target, (Sheet, FoldedSheet))
    said: Said = {
        "shape": (sheet_shape if is_sheet else shape_of)(draft.units, section),
        "colour": None if colour is None else _colour(colour, "colour"),
        "edge_colour": None if edge_colour is None else _colour(edge_colour, "colour of the edges"),
    }
    if opacity is not None:
        (said["opacity"],) = numbers([opacity], 1, "an opacity is a number")
        if not 0.0 <= said["opacity"] <= 1.0:
            raise model_error(
                "bad-opacity", "an opacity is out of range", "give 0 for invisible, 1 for opaque"
            )
    if drawn is not None:
        if not isinstance(drawn, (bool, np.bool_)):
            raise model_error("not-a-flag", "whether an element is drawn is True or False")
        said["drawn"] = bool(drawn)
    draft.say_looks(indices, {name: value for name, value in said.items() if value is not None})


def _colour(given: Sequence[float], what: str) -> Colour:
    """Red, green and blue from 0 to 1.

    Raises:
        ModelError: they are not.
    """
    red, green, blue = numbers(given, 3, f"the {what} is red, green and blue")
    if not all(0.0 <= part <= 1.0 for part in (red, green, blue)):
        raise model_error(
            "bad-colour", f"a part of the {what} is out of range", "give parts from 0 to 1"
        )
    return red, green, blue
