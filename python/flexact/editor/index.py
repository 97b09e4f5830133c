# SPDX-License-Identifier: BSD-3-Clause
"""Where nodes and elements are made and named in a deck."""

from __future__ import annotations

from ..core.elements import NodeKind
from ..core.raw import ElementKind
from ..deck.keywords import WITH_WARPING
from .document import Range
from .statements import Statement, Statements

#: A node or an element by its number.
Key = tuple[str, int]
NODE, ELEMENT = "node", "element"
#: What stands in the place of the kind of a node that carries warping.
WARPING = 0


class Index:
    """Of all statements of a document."""

    def __init__(self, statements: Statements) -> None:
        """Go through all statements."""
        self.all: list[Statement] = []
        #: Where each stands, the statements that make it or give it its place apart.
        self.made: dict[Key, list[tuple[Statement, int]]] = {}
        self.named: dict[Key, list[tuple[Statement, int]]] = {}
        #: Kind of each node, by the first slot that it stands in.
        self.kinds: dict[int, int] = {}
        for statement in statements:
            self.all.append(statement)
            self._take(statement)

    def _take(self, statement: Statement) -> None:
        says = statement.says
        for one in says.references:
            where = self.made if one.defines else self.named
            where.setdefault((one.kind, one.number), []).append((statement, one.place))
        if says.element is not None:
            for place, kind in enumerate(slots_of(says.element, says.name), start=2):
                if (number := says.number(place)) is not None:
                    self.kinds.setdefault(number, kind)

    def where(self, key: Key) -> list[Range]:
        """All places where a node or an element stands."""
        both = (*self.made.get(key, ()), *self.named.get(key, ()))
        return sorted(statement.span(place) for statement, place in both)

    def definition(self, key: Key) -> list[Range]:
        """Where an element is made; where a node has its X, else where it first stands."""
        made = self.made.get(key)
        if made:
            return [statement.span(place) for statement, place in made]
        first = self.named.get(key, ())[:1] if key[0] == NODE else ()
        return [statement.span(place) for statement, place in first]

    def element(self, number: int) -> Statement | None:
        """The statement that makes an element."""
        made = self.made.get((ELEMENT, number))
        return made[0][0] if made else None

    def kind_of_element(self, number: int | None) -> ElementKind | None:
        """What an element is."""
        made = self.element(number) if number is not None else None
        return made.says.element if made is not None else None

    def elements_on(self, node: int) -> list[int]:
        """Numbers of the elements that stand on a node."""
        numbers = (
            statement.says.number(1)
            for statement, _ in self.named.get((NODE, node), ())
            if statement.says.element is not None
        )
        return [number for number in dict.fromkeys(numbers) if number is not None]

    def free(self, kind: str) -> int:
        """The smallest number behind all that are in use."""
        used = {number for what, number in (*self.made, *self.named) if what == kind}
        return max(used, default=0) + 1


def slots_of(kind: ElementKind, name: str) -> tuple[int, ...]:
    """Kinds of the nodes of a statement, in their order; `WARPING` for nodes of warping."""
    used = tuple(slot for slot in kind.slots if slot)
    if name == WITH_WARPING:
        return (*used[:2], WARPING, *used[2:], WARPING)
    return used


def is_position(kind: int) -> bool:
    """Whether a node of this kind has a place."""
    return kind in (NodeKind.POSITION, NodeKind.PLANAR_POSITION)
