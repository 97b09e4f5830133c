# SPDX-License-Identifier: BSD-3-Clause
"""What a model hands out for its nodes and elements."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Node:
    """A point of a model: a position node and an orientation node.

    The orientation node comes into the analysis only where an element uses it.

    Attributes:
        position: Number of the position node.
        orientation: Number of the orientation node.
    """

    position: int
    orientation: int
    owner: object = field(repr=False)


@dataclass(frozen=True, slots=True)
class Element:
    """An element of a model.

    Attributes:
        number: Number of the element.
    """

    number: int
    owner: object = field(repr=False)


@dataclass(frozen=True, slots=True)
class Sheet:
    """A sheet flexure of one or several beams.

    Attributes:
        elements: Its beams from p to q.
        nodes: Its nodes from p to q, both ends included.
    """

    elements: tuple[Element, ...]
    nodes: tuple[Node, ...]
