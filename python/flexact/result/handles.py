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
    elements = getattr(target, "elements", None) or (target,)
    number = getattr(elements[0], "number", None)
    if not isinstance(number, int):
        raise TypeError(
            f"a part is given by its name or by what the model handed out, not by "
            f"{in_short(target)}"
        )
    index = parts.data.element_index.get(number)
    if index is None:
        raise model_error("no-such-element", f"there is no element {number}")
    return parts.of_element(index)


def position_of(parts: Parts, target: object) -> int:
    """Index of the position node of the point that is meant.

    Args:
        parts: Those of the model.
        target: Its name, the number of its position node, or a handle with `position`.

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
    number = getattr(target, "position", target)
    if not isinstance(number, int) or isinstance(number, bool):
        raise TypeError(
            f"a point is given by its name, its number or what the model handed out, not by "
            f"{in_short(target)}"
        )
    index = data.node_index.get(number)
    if index is None or data.arrays.node_kind[index] > NodeKind.POSITION:
        raise model_error("no-such-node", f"no element uses a position node {number}")
    return index
