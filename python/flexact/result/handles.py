# SPDX-License-Identifier: BSD-3-Clause
"""Parts and points as users point at them: by name, by number, or by what a model handed out."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..base.plain_text import in_short
from ..core.arrays import FloatArray, IntArray
from ..core.elements import NodeKind
from ..diagnostics.errors import model_error
from ..model.parts.parts import Part, PartKind, Parts

#: Part of the size of the model within which a place is that of a point.
_SAME = 1.0e-9


def part_of(parts: Parts, target: object) -> Part:
    """The part that is meant.

    Args:
        parts: Those of the model.
        target: Its name, the part itself, or a handle with `elements` or a `number`.

    Raises:
        ModelError: there is none, or there are several.
        TypeError: it is nothing of that.
    """
    if isinstance(target, Part):
        return parts.of_element(target.elements[0])
    if isinstance(target, str):
        return parts.named(target)
    elements = getattr(target, "elements", (target,))
    if not elements and hasattr(target, "nodes"):
        return _of_one_point(parts, target)
    found = dict.fromkeys(_of_element(parts, element, target) for element in elements)
    if len(found) > 1:
        raise model_error(
            "ambiguous-part",
            f"{len(found)} parts are meant: {', '.join(part.name for part in found)}",
            "ask for one of them",
        )
    return next(iter(found))


def _of_element(parts: Parts, element: object, target: object) -> Part:
    number = getattr(element, "number", None)
    if not isinstance(number, int):
        raise TypeError(
            f"a part is given by its name or by what the model handed out, not by "
            f"{in_short(target)}"
        )
    index = parts.data.element_index.get(number)
    if index is None:
        raise model_error("no-such-element", f"there is no element {number}")
    return parts.of_element(index)


def _of_one_point(parts: Parts, target: object) -> Part:
    """The body that carries the point of a body that has no members of its own."""
    body = parts.body_at.get(position_of(parts, target))
    if body is None:
        raise model_error(
            "no-such-part", "this body is a single point; ask for what the point does"
        )
    return parts.of_body(body)


def position_of(parts: Parts, target: object) -> int:
    """Index of the position node of the point that is meant.

    Args:
        parts: Those of the model.
        target: Its name, or that of a body, of which its first point is meant; the number of its
            position node; where it is, (x, y, z) [m]; or a handle with `position`, or with
            `nodes`, of which the first is meant.

    Raises:
        ModelError: there is none, or there are several.
        TypeError: it is nothing of that.
    """
    data = parts.data
    there = np.flatnonzero(data.arrays.node_kind <= NodeKind.POSITION).astype(np.int32)
    nodes = getattr(target, "nodes", None)
    is_place = isinstance(target, (list, tuple, np.ndarray)) and not hasattr(target, "position")
    if isinstance(target, str):
        found = [node for node in there.tolist() if parts.name_of_point(node) == target]
        bodies = [part for part in parts.all if part.kind is PartKind.BODY and part.name == target]
        if not found and len(bodies) == 1:
            return int(data.arrays.element_node[0, bodies[0].elements[0]]) - 1
        how = "called"
    elif is_place and nodes is None:
        found, how = _at_place(data.arrays.node_value[:3, there], there, target), "at"
    if isinstance(target, str) or (is_place and nodes is None):
        if len(found) != 1:
            many = "no point is" if not found else f"{len(found)} points are"
            raise model_error("no-such-point", f"{many} {how} {in_short(target)}")
        return found[0]
    number = getattr(nodes[0] if nodes else target, "position", target)
    if not isinstance(number, int) or isinstance(number, bool):
        raise TypeError(
            f"a point is given by its name, its number or what the model handed out, not by "
            f"{in_short(target)}"
        )
    index = data.node_index.get(number)
    if index is None or data.arrays.node_kind[index] > NodeKind.POSITION:
        raise model_error("no-such-node", f"no element uses a position node {number}")
    return index


def _at_place(places: FloatArray, nodes: IntArray, given: Any) -> list[int]:
    """Those of nodes (n,) at places (3, n) that are where it is given, within `_SAME`."""
    try:
        numbers = np.asarray(given, np.float64)
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if numbers.shape not in ((2,), (3,)) or not np.isfinite(numbers).all():
        raise TypeError(f"a place has two or three finite coordinates [m], not {in_short(given)}")
    far = np.abs(places - np.append(numbers, np.zeros(3 - numbers.size))[:, None]).max(axis=0)
    size = float(np.ptp(places, axis=1).max(initial=0.0)) if places.size else 0.0
    found: list[int] = nodes[far <= _SAME * size].tolist()
    return found
