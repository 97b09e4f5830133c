# SPDX-License-Identifier: BSD-3-Clause
"""Finding elements and nodes of a draft by names, numbers and places; tables made when needed."""

from __future__ import annotations

import itertools
from bisect import insort
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ..core.elements import is_position
from ..deck.rendering import model_error
from ..util.text import in_short
from .names import part_name

if TYPE_CHECKING:
    from .bodies import RigidComponents


#: Of the size of a model: points nearer than this are at one place.
ROUNDING = 1.0e-9
#: Size of a cell of the table, in tolerances.
_CELL = 16.0


class Places:
    """Position nodes of a draft by their places, within a tolerance [m]."""

    def __init__(self, draft: Lookup, tolerance: float) -> None:
        """Of all position nodes that there are now."""
        self._draft = draft
        self._tolerance = tolerance
        self._size = _CELL * tolerance or 1.0
        self._cells: dict[tuple[int, ...], list[int]] = {}
        for number, kind in draft.node_kind.items():
            if is_position(kind):
                self.add(number)

    def add(self, number: int) -> None:
        """Take in a position node."""
        for cell in self._cells_of(self._draft.node_value[number], 0.0):
            self._cells.setdefault(cell, []).append(number)

    def _cells_of(self, place: Sequence[float], within: float) -> Iterable[tuple[int, ...]]:
        """The cells that are met within a distance of a place: nearly always one."""
        size = self._size
        x, y, z = place[0] / size, place[1] / size, place[2] / size
        i, j, k = cell = round(x), round(y), round(z)
        inside = 0.5 - within / size
        if abs(x - i) < inside and abs(y - j) < inside and abs(z - k) < inside:
            return (cell,)
        near = within / size
        return itertools.product(*({round(v - near), round(v + near)} for v in (x, y, z)))

    def near(self, place: Sequence[float], tolerance: float | None = None) -> list[int]:
        """Numbers of the nodes at a place, in the order they were made.

        Args:
            place: (x, y, z) [m].
            tolerance: Of a few times that of all [m]; by default that.
        """
        within = self._tolerance if tolerance is None else tolerance
        found = []
        for cell in self._cells_of(place, within):
            for number in self._cells.get(cell, ()):
                value = self._draft.node_value[number]
                if all(abs(value[k] - place[k]) <= within for k in range(3)):
                    found.append(number)
        return sorted(found)


def size_of(draft: Lookup) -> float:
    """The largest coordinate of a draft [m]."""
    return max(
        (
            abs(x)
            for number, kind in draft.node_kind.items()
            if is_position(kind)
            for x in draft.node_value[number][:3]
        ),
        default=0.0,
    )


def one_line(name: str) -> str:
    """A name as the comment of a deck's line can hold it."""
    line = "".join(c if c.isprintable() else " " for c in name)
    return line.lstrip(" %#").rstrip()


class Lookup:
    """The half of a draft that finds and names things; see there."""

    node_kind: dict[int, int]
    node_value: dict[int, tuple[float, ...]]
    numbers: list[int]

    def __init__(self) -> None:
        """Nothing has a name yet, and nothing was looked for."""
        #: Names of elements by index, and of points by the numbers of their position nodes.
        self.names: dict[int, str] = {}
        self.node_names: dict[int, str] = {}
        #: Which points rigid links join, as far as that was found out.
        self.components: RigidComponents | None = None
        self._index_of: dict[int, int] | None = None
        self._of_part: dict[str, list[int]] | None = None
        self._of_name: dict[str, list[int]] | None = None
        self._of_place: dict[tuple[float, ...], list[int]] | None = None
        self._size: float | None = None
        self._places: tuple[float, Places] | None = None

    def nodes_at(self, value: tuple[float, ...]) -> list[int]:
        """Numbers of the position nodes at a place, in the order they were made.

        Where there are none at exactly this place, those within 1e-9 of the model's size.
        """
        if self._of_place is None:
            self._of_place = {}
            for number, kind in self.node_kind.items():
                if is_position(kind):
                    self._of_place.setdefault(self.node_value[number], []).append(number)
        return self._of_place.get(value) or self._near(value)

    def _near(self, value: tuple[float, ...]) -> list[int]:
        """The same within rounding; the table is made anew when the model has doubled."""
        if self._size is None:
            self._size = size_of(self)
        if not self._size:
            return []
        if self._places is None or self._size > 2.0 * self._places[0]:
            self._places = self._size, Places(self, ROUNDING * self._size)
        return self._places[1].near(value[:3], ROUNDING * self._size)

    def part_indices(self, name: str) -> list[int]:
        """Indices of the elements of the parts with this name, in the order they were made."""
        return self.parts_by_name.get(name, [])

    @property
    def parts_by_name(self) -> dict[str, list[int]]:
        """Indices of elements by the name of their part."""
        if self._of_part is None:
            self._of_part = {}
            for index in sorted(self.names):
                self._of_part.setdefault(part_name(self.names[index]), []).append(index)
        return self._of_part

    @property
    def points_by_name(self) -> dict[str, list[int]]:
        """Numbers of position nodes by their names."""
        if self._of_name is None:
            self._of_name = {}
            for number, name in self.node_names.items():
                self._of_name.setdefault(name, []).append(number)
        return self._of_name

    def shares(self, indices: list[int]) -> bool:
        """Whether elements of one part's name are those of several parts.

        Those of one part are numbered behind its name, or there is a single one.
        """
        if len(indices) < 2:
            return False
        own = {self.names[index] for index in indices}
        return len(own) < len(indices) or any(name == part_name(name) for name in own)

    def name_node(self, number: int, name: str) -> None:
        """Name a node, or with an empty name take its name away."""
        if number in self.node_names:
            self._of_name = None
            del self.node_names[number]
        if name := one_line(name):
            self.node_names[number] = name
            if self._of_name is not None:
                self._of_name.setdefault(name, []).append(number)

    def name_element(self, index: int, name: str) -> None:
        """Name an element, or with an empty name take its name away."""
        old = self.names.pop(index, None)
        made = one_line(name)
        if made:
            self.names[index] = made
        if self._of_part is not None:
            if old is not None:
                before = self._of_part[part_name(old)]
                before.remove(index)
                if not before:
                    del self._of_part[part_name(old)]
            if made:
                insort(self._of_part.setdefault(part_name(made), []), index)

    def name_of(self, number: int) -> str:
        """Name of an element by its number, empty without one or without the element."""
        self._number_elements()
        assert self._index_of is not None
        return self.names.get(self._index_of.get(number, -1), "")

    def changed_names_or_places(self) -> None:
        """Forget what was found by names, numbers and places; it is found anew when asked for."""
        self._index_of = self._of_part = self._of_name = self._of_place = None
        self._size = self._places = None
        self.components = None

    def index_of(self, number: int) -> int:
        """Index of the element with this number."""
        self._number_elements()
        assert self._index_of is not None
        index = self._index_of.get(number)
        if index is None:
            raise model_error("no-such-element", f"there is no element {in_short(number)}")
        return index

    def _number_elements(self) -> None:
        if self._index_of is None:
            self._index_of = {n: i for i, n in enumerate(self.numbers)}

    def element_words(self, index: int) -> str:
        """What messages call an element."""
        name = self.names.get(index)
        return in_short(name) if name else f"element {self.numbers[index]}"

    def node_words(self, number: int) -> str:
        """What messages call a node."""
        name = self.node_names.get(number)
        return f"point {in_short(name)}" if name else f"node {number}"

    def _added_node(self, number: int) -> None:
        """Take a new node into the tables that there are."""
        if not is_position(self.node_kind[number]):
            return
        if self._of_place is not None:
            self._of_place.setdefault(self.node_value[number], []).append(number)
        if self._size is not None:
            self._size = max(self._size, *map(abs, self.node_value[number][:3]))
        if self._places is not None:
            self._places[1].add(number)

    def _added_element(self, index: int) -> None:
        """Take a new element into the tables that there are."""
        if self._index_of is not None:
            self._index_of[self.numbers[index]] = index
