# SPDX-License-Identifier: BSD-3-Clause
"""Parts and points as users point at them: by name, by number, or by what a model handed out."""

from __future__ import annotations

from ..base.plain_text import in_short
from ..core.elements import NodeKind
from ..diagnostics.errors import model_error
from ..model.parts.parts import Part, Parts


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
        target: Its name, the number of its position node, or a handle with `position`, or
            with `nodes`, of which the first is meant.

    Raises:
        ModelError: there is none, or there are several.
        TypeError: it is nothing of that.
    """
    data = parts.data
    if isinstance(target, str):
        positions = [
            node
            for node, kind in enumerate(data.arrays.node_kind.tolist())
            if kind <= NodeKind.POSITION and parts.name_of_point(node) == target
        ]
        if len(positions) != 1:
            how = "no point is" if not positions else f"{len(positions)} points are"
            raise model_error("no-such-point", f"{how} called {in_short(target)}")
        return positions[0]
    nodes = getattr(target, "nodes", None)
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
