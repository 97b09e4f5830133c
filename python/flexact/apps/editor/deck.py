# SPDX-License-Identifier: BSD-3-Clause
"""Where nodes and elements are made and named in a deck."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.elements import NodeKind
from ...core.raw import ElementKind
from ...deck.diagnostics import Problems
from ...deck.keywords import WITH_WARPING
from ...deck.rendering import DeckError
from ...model.data import ModelData
from ...model.parts.condensing import Condensed, as_given
from ...model.parts.parts import Parts
from ...model.reading import read_bytes
from ...util.records import cached_property
from .document import Document, Range
from .statements import Facts, Statement, Statements

#: A node or an element by its number.
Key = tuple[str, int]
NODE, ELEMENT = "node", "element"
#: What stands in the place of the kind of a node that carries warping.
WARPING = 0


class Index:
    """Of all lines of a document.

    Attributes:
        facts: What is known of each line.
        made: Lines and words that make an element, or give a node its place.
        named: Lines and words that name them otherwise.
        kinds: Kind of each node, by the first slot that it stands in.
    """

    def __init__(self, statements: Statements) -> None:
        """Go through all lines."""
        self._statements = statements
        self.facts: list[Facts] = list(statements.facts())
        self.made: dict[Key, list[tuple[int, int]]] = {}
        self.named: dict[Key, list[tuple[int, int]]] = {}
        self.kinds: dict[int, int] = {}
        for line, facts in enumerate(self.facts):
            for kind, number, place, defines in facts.references:
                where = self.made if defines else self.named
                where.setdefault((kind, number), []).append((line, place))
            if facts.element is not None:
                slots = slots_of(facts.element, facts.name)
                for _, number, place, defines in facts.references:
                    if not defines:
                        self.kinds.setdefault(number, slots[place - 2])

    def at(self, line: int) -> Statement:
        """What a line says."""
        return self._statements.at(line)

    def _spans(self, places: list[tuple[int, int]]) -> list[Range]:
        return [self.at(line).span(place) for line, place in places]

    def where(self, key: Key) -> list[Range]:
        """All places where a node or an element stands."""
        return self._spans(sorted([*self.made.get(key, ()), *self.named.get(key, ())]))

    def definition(self, key: Key) -> list[Range]:
        """Where an element is made; where a node has its X, else where it first stands."""
        made = self.made.get(key, [])
        first = self.named.get(key, [])[:1] if key[0] == NODE else []
        return self._spans(made or first)

    def element(self, number: int) -> Statement | None:
        """The statement that makes an element."""
        made = self.made.get((ELEMENT, number))
        return self.at(made[0][0]) if made else None

    def kind_of_element(self, number: int | None) -> ElementKind | None:
        """What an element is."""
        made = self.element(number) if number is not None else None
        return made.says.element if made is not None else None

    def comment(self, key: Key) -> str:
        """The comment behind the statement that makes it."""
        made = self.made.get(key)
        return self.facts[made[0][0]].comment if made else ""

    def elements_on(self, node: int) -> list[int]:
        """Numbers of the elements that stand on a node."""
        every = (self.facts[line] for line, _ in self.named.get((NODE, node), ()))
        numbers = (
            one.number
            for facts in every
            if facts.element is not None
            for one in facts.references[:1]
            if one.defines
        )
        return list(dict.fromkeys(numbers))

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


@dataclass(frozen=True, eq=False)
class Told:
    """A model of which is spoken without an analysis: see `text.deformation.Told`."""

    data: ModelData

    @cached_property
    def condensed(self) -> Condensed:
        """The model as it is."""
        return as_given(self.data)

    @cached_property
    def parts(self) -> Parts:
        """Its parts."""
        return Parts(self.data)


@dataclass(frozen=True, eq=False)
class Deck:
    """A document with what is read off it, each when it is asked for."""

    document: Document
    name: str = "deck"

    @cached_property
    def statements(self) -> Statements:
        """Its lines, taken apart."""
        return Statements(self.document)

    @cached_property
    def index(self) -> Index:
        """Where its nodes and elements stand."""
        return Index(self.statements)

    @cached_property
    def _read(self) -> tuple[ModelData | None, Problems]:
        raw = self.document.text.encode("utf-8", "replace")
        try:
            data = read_bytes(raw, self.name)
        except DeckError as error:
            return None, error.problems
        return data, data.problems

    @property
    def data(self) -> ModelData | None:
        """Its model; None where it has errors."""
        return self._read[0]

    @property
    def problems(self) -> Problems:
        """What `flexact check` says."""
        return self._read[1]

    @cached_property
    def told(self) -> Told | None:
        """Its model, to be spoken of; None where it has errors."""
        return Told(self.data) if self.data is not None else None
