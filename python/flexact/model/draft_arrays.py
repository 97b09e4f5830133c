# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of a draft, and the draft that gives the arrays of a model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ..core.arrays import FloatArray, IntArray, model_arrays
from ..core.elements import AXES, Class, NodeKind, is_position, kind_of
from ..deck.diagnostics import Diagnostic, Problems, Severity, warning
from ..util.groups import groups_of, values_in
from ..util.text import in_short
from .data import NUMBERS, OF_ELEMENTS, Appearance, Loads, ModelData, Properties, rows_of
from .draft import Draft, Shape, classes_of
from .transform import Vector

#: Nodes that one message names.
_MOST_LISTED = 5
#: What is given in numbers about drawing an element, and how many they are.
_LOOKS: dict[str, tuple[int, ...]] = {
    "colour": (3,),
    "edge_colour": (3,),
    "opacity": (),
    "body_thickness": (),
    "contour": (4,),
}


def draft_of(data: ModelData) -> Draft:
    """The draft that gives the same arrays."""
    draft = Draft(data.planar, data.units)
    a = data.arrays
    numbers = a.node_number.tolist()
    draft.node_kind = dict(zip(numbers, a.node_kind.tolist(), strict=True))
    draft.node_value = dict(zip(numbers, map(tuple, a.node_value.T.tolist()), strict=True))
    for axis, node in np.argwhere(
        (a.coordinate_class != Class.NONE) & (a.coordinate_class != Class.DEPENDENT)
    ).tolist():
        draft.coordinate_class[numbers[node], axis] = int(a.coordinate_class[axis, node])
    with_zero = np.concatenate([np.zeros(1, np.int32), a.node_number])
    draft.kinds = a.element_kind.tolist()
    draft.numbers = a.element_number.tolist()
    draft.slots = list(map(tuple, with_zero[a.element_node].T.tolist()))
    draft.vectors = list(map(tuple, a.element_vector.T.tolist()))
    draft.classes = list(map(tuple, a.deformation_class.T.tolist()))
    draft.names = {i: name for i, name in enumerate(data.element_names) if name}
    draft.node_names = {
        number: name for number, name in zip(numbers, data.node_names, strict=True) if name
    }
    if data.properties is not None:
        for name in OF_ELEMENTS:
            setattr(draft, name, dict(rows_of(getattr(data.properties, name))))
        draft.node_mass = {numbers[i]: row for i, row in rows_of(data.properties.node_mass)}
    if data.loads is not None:
        draft.force, draft.increment = (
            {numbers[i]: tuple(table[i].tolist()) for i in np.flatnonzero(table.any(axis=1))}
            for table in (data.loads.force, data.loads.increment)
        )
        x, y, z = data.loads.gravity.tolist()
        draft.gravity = x, y, z
    if data.given_appearance is not None:
        _say_looks(draft, data.given_appearance)
    draft.has_long_numbers = data.has_long_numbers
    draft.began_as = data.source or data.began_as
    draft.elements_given = len(draft.kinds)
    draft.last_node = max(numbers, default=0)
    draft.last_element = max(draft.numbers, default=0)
    # Of several orientations at a place that with the lowest number was made with it.
    ends = [end for p, op, q, oq in draft.slots for end in ((p, op), (q, oq)) if all(end)]
    for position, orientation in sorted(ends, key=lambda end: end[1]):
        draft.join(position, orientation)
    return draft


def _say_looks(draft: Draft, appearance: Appearance) -> None:
    for i in np.flatnonzero(appearance.cross_section).tolist():
        sizes = appearance.dimensions[i].tolist()
        draft.say_looks([i], {"shape": Shape(int(appearance.cross_section[i]), *sizes)})
    for name in _LOOKS:
        values = getattr(appearance, name)
        rows = values.reshape(len(values), -1)[:, 0]
        for i in np.flatnonzero(~np.isnan(rows)).tolist():
            draft.say_looks([i], {name: values[i].tolist()})
    draft.say_looks(np.flatnonzero(~appearance.drawn).tolist(), {"drawn": False})
    for i in np.flatnonzero(appearance.body_shape).tolist():
        draft.say_looks([i], {"body_shape": int(appearance.body_shape[i])})


def data_of(draft: Draft, name: str) -> ModelData:
    """The model as it is now, with an error for each class of a node that nobody uses."""
    kinds, slots, classes = _decided(draft)
    used = values_in(slots[slots > 0])
    numbers = used.tolist()
    node_kind = np.array([draft.node_kind[n] for n in numbers], np.int32)
    value = np.array([draft.node_value[n] for n in numbers], np.float64).reshape(-1, 4)
    arrays = model_arrays(
        node_number=used,
        node_kind=node_kind,
        node_value=value.T,
        coordinate_class=_coordinate_classes(draft, used, node_kind),
        element_number=np.array(draft.numbers, np.int64),
        element_kind=kinds,
        element_node=np.where(slots > 0, np.searchsorted(used, slots) + 1, 0).T,
        element_vector=np.array(draft.vectors, np.float64).reshape(-1, 3).T,
        deformation_class=classes.T,
    )
    elements, in_use = len(draft.kinds), set(numbers)
    in_vain = {number for number, _ in draft.named if number not in in_use}
    in_vain.update(both[0] for both in draft.whole if in_use.isdisjoint(both))
    wrong = [
        Diagnostic(
            Severity.ERROR,
            "no-such-node",
            f"{draft.node_words(number)} is given a class, but no element uses it",
            help="name the node in an element, or leave its class out",
        )
        for number in sorted(in_vain)
    ]
    return ModelData(
        arrays,
        draft.planar,
        name,
        tuple(draft.names.get(i, "") for i in range(elements)),
        tuple(draft.node_names.get(n, "") for n in numbers) if draft.node_names else (),
        found=Problems.of(wrong) if wrong else None,
        besides=(*_left_over(draft, in_use), *_same_names(draft)),
        given_appearance=_appearance(draft, elements),
        properties=_properties(draft, elements, numbers),
        loads=_loads(draft, numbers),
        units=draft.units,
        has_long_numbers=draft.has_long_numbers,
        began_as=draft.began_as,
        called=frozenset(at for at, given in draft.stated.items() if given == Class.DEPENDENT),
    )


def _decided(draft: Draft) -> tuple[IntArray, IntArray, IntArray]:
    """Kinds, slots and classes, with the kind of every rigid element decided.

    A rigid element is an RBEAM unless somebody needs the orientation of its
    far end, which may have been given a class, as one of its deformations may.
    """
    kinds = np.array(draft.kinds, np.int32)
    slots = np.array(draft.slots, np.int64).reshape(-1, 4).astype(np.int32)
    classes = np.array(draft.classes, np.int32).reshape(-1, 6)
    if not draft.rigid:
        return kinds, slots, classes
    rigid = np.zeros(kinds.size, bool)
    rigid[list(draft.rigid)] = True
    needed = set(slots[~rigid][:, (1, 3)].ravel().tolist())
    # One that is fixed or declared holds or drives the body, also where its whole point is.
    needed.update(slots[rigid, 1].tolist(), (number for number, _ in draft.coordinate_class))
    needed.update(draft.loaded)
    # Two links that end at one point carry it both, so that they are one body.
    far, times = np.unique(slots[rigid, 3], return_counts=True)
    needed.update(far[times > 1].tolist())
    stated = {index for index, _ in draft.stated}
    short = kind_of("PLRBEAM" if draft.planar else "RBEAM")
    for index in draft.rigid:
        if slots[index, 3] not in needed and index not in stated:
            kinds[index] = short.number
            slots[index, 3] = 0
            classes[index] = classes_of(short.deformations, ())
    return kinds, slots, classes


def _coordinate_classes(draft: Draft, used: IntArray, node_kind: IntArray) -> IntArray:
    of_kind = np.zeros((len(NodeKind) + 1, 3), np.int32)
    for kind, axes in AXES.items():
        of_kind[kind, list(axes)] = Class.DEPENDENT
    classes = of_kind[node_kind].reshape(-1, 3)
    if draft.coordinate_class and used.size:
        stated = np.array(list(draft.coordinate_class), np.int64)
        values = np.array(list(draft.coordinate_class.values()), np.int32)
        place = np.minimum(np.searchsorted(used, stated[:, 0]), used.size - 1)
        there = used[place] == stated[:, 0]
        classes[place[there], stated[there, 1]] = values[there]
    return classes.T


def _appearance(draft: Draft, elements: int) -> Appearance | None:
    """How elements are drawn; None where nothing is said."""
    if all(said == {"drawn": True} for said in draft.said.values()):
        return None
    shapes, drawn = np.zeros((elements, 3)), np.ones(elements, bool)
    body_shape = np.zeros(elements, np.int32)
    numbers = {name: np.full((elements, *size), np.nan) for name, size in _LOOKS.items()}
    for i, said in draft.said.items():
        shapes[i] = said.get("shape", 0.0)
        drawn[i] = said.get("drawn", True)
        body_shape[i] = said.get("body_shape", 0)
        for name in said.keys() & _LOOKS.keys():
            numbers[name][i] = said[name]
    kinds = shapes[:, 0].astype(np.int32)
    return Appearance(kinds, shapes[:, 1:].copy(), **numbers, drawn=drawn, body_shape=body_shape)


def _properties(draft: Draft, elements: int, node_numbers: Sequence[int]) -> Properties | None:
    """What parts are made of; None where nothing is said."""
    if not (draft.node_mass or any(getattr(draft, name) for name in OF_ELEMENTS)):
        return None
    place = {number: i for i, number in enumerate(node_numbers)} if draft.node_mass else {}
    at_nodes = {place[n]: row for n, row in draft.node_mass.items() if n in place}
    every = {name: (elements, getattr(draft, name)) for name in OF_ELEMENTS}
    every["node_mass"] = len(node_numbers), at_nodes
    tables = {}
    for name, (size, said) in every.items():
        tables[name] = np.full((size, NUMBERS[name]), np.nan)
        for i, row in said.items():
            tables[name][i, : len(row)] = row
    return Properties(**tables)


def _loads(draft: Draft, node_numbers: Sequence[int]) -> Loads | None:
    """The loads on these nodes; None where all are zero."""
    loaded = draft.loaded
    place = {number: i for i, number in enumerate(node_numbers)} if loaded else {}
    if not (any(number in place for number in loaded) or any(draft.gravity)):
        return None

    def table(said: Mapping[int, Vector]) -> FloatArray:
        made = np.zeros((len(node_numbers), 3))
        for number, load in said.items():
            if number in place:
                made[place[number]] = load
        return made

    return Loads(table(draft.force), table(draft.increment), np.array(draft.gravity))


def _left_over(draft: Draft, used: set[int]) -> Iterator[Diagnostic]:
    """Warnings about points, masses and loads that nothing uses."""
    points = [
        number
        for number, kind in draft.node_kind.items()
        if is_position(kind) and used.isdisjoint((number, draft.orientation_at.get(number)))
    ]
    if points:
        yield warning(
            "unused-node",
            f"no element uses {_listed(draft, points)}",
            "join it to something, or leave it out",
        )
    for what, given in (("mass", draft.node_mass), ("load", draft.loaded)):
        if unused := [number for number in given if number not in used]:
            yield warning(
                "unused-node",
                f"{_listed(draft, unused)} is given a {what}, but no element uses it",
                "give it to a node that an element uses",
            )


def _same_names(draft: Draft) -> Iterator[Diagnostic]:
    """Warnings about parts of one name that hang together, so that the core sees one part.

    Names in a deck are comments of its lines, which may be alike; twins are told as such.
    """
    for name, found in draft.parts_by_name.items():
        twins = len({draft.slots[index] for index in found}) < len(found)
        if found[-1] < draft.elements_given or twins or not draft.shares(found):
            continue
        if _is_one(draft, found):
            yield warning(
                "repeated-name",
                f"several parts that hang together are called {in_short(name)}",
                "give each a name of its own: this one finds none of them",
            )


def _is_one(draft: Draft, indices: Sequence[int]) -> bool:
    """Whether elements hang together by their nodes."""
    numbers = sorted({node for index in indices for node in draft.slots[index] if node})
    place = {number: k for k, number in enumerate(numbers, len(indices))}
    ends = [(k, place[n]) for k, index in enumerate(indices) for n in draft.slots[index] if n]
    return not groups_of(len(indices) + len(place), ends)[: len(indices)].any()


def _listed(draft: Draft, numbers: Sequence[int]) -> str:
    """Nodes by name, or by number where they have none; of many the first."""
    words = [
        f"'{draft.node_names[number]}'" if number in draft.node_names else f"node {number}"
        for number in numbers[:_MOST_LISTED]
    ]
    more = len(numbers) - _MOST_LISTED
    return ", ".join(words) + (f" and {more} more" if more > 0 else "")
