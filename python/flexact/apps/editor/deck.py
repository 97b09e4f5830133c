# SPDX-License-Identifier: BSD-3-Clause
"""Where nodes and elements are made and named in a deck."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...core.arrays import BoolArray
from ...core.raw import ElementKind
from ...deck.diagnostics import Problems
from ...deck.rendering import DeckError
from ...deck.tokens import Line, Tokens
from ...model.data import ModelData
from ...model.parts.condensing import Condensed, as_given
from ...model.parts.parts import Parts
from ...model.reading import read_bytes
from ...util.records import cached_property
from .document import Document, Range

#: A node or an element by its number.
Key = tuple[str, int]
NODE, ELEMENT = "node", "element"
#: What stands in the place of the kind of a node that carries warping.
WARPING = -1


def keys_in(line: Line) -> Iterator[tuple[Key, Range]]:
    """The nodes and elements that a line names, and where."""
    for place, word in enumerate(line.words):
        if word.number and word.letter in "nEe":
            yield (NODE if word.letter == "n" else ELEMENT, word.number), span(line, place)


def span(line: Line, first: int, last: int | None = None) -> Range:
    """Where a word stands, or where words from one to another one do."""
    word = line.words[first]
    behind = word.behind if last is None else line.words[last].behind
    return Range.within(line.number, word.first, behind)


class Index:
    """Where a deck makes its nodes and elements, and where it names them.

    Attributes:
        tokens: The deck.
        made: By "node" and "element", the line that gives a node its place, or makes an element,
            by its number; the first one, where it stands twice.
        kinds: Kind of each node, by the first slot that it stands in.
    """

    def __init__(self, tokens: Tokens) -> None:
        """Go through all words."""
        self.tokens = tokens
        counted, letter = tokens.number > 0, tokens.letter
        self._named = {
            NODE: counted & (letter == ord("n")),
            ELEMENT: counted & np.isin(letter, [ord("E"), ord("e")]),
        }
        at_x = np.isin(tokens.line, tokens.lines_of("X"))
        self._made = {NODE: self._named[NODE] & at_x, ELEMENT: counted & (letter == ord("E"))}
        self.made = {
            kind: {number: int(tokens.line[word]) for number, word in self._first(words)}
            for kind, words in self._made.items()
        }
        slots = self._first(counted & (tokens.node != 0))
        self.kinds = {number: int(tokens.node[word]) for number, word in slots}

    def _first(self, words: BoolArray) -> Iterator[tuple[int, int]]:
        """The numbers that some words are, each with the first of these words."""
        places = np.flatnonzero(words)
        numbers, first = np.unique(self.tokens.number[places], return_index=True)
        return zip(numbers.tolist(), places[first].tolist(), strict=True)

    def _spans(self, key: Key, words: dict[str, BoolArray]) -> list[Range]:
        """Where those of some words stand that are the number of a node or an element."""
        found = np.flatnonzero(words[key[0]] & (self.tokens.number == key[1]))
        return [Range.within(*self.tokens.place_of(word)) for word in found.tolist()]

    def where(self, key: Key) -> list[Range]:
        """All places where a node or an element stands."""
        return self._spans(key, self._named)

    def definition(self, key: Key) -> list[Range]:
        """Where an element is made; where a node has its X, else where it first stands."""
        made = self._spans(key, self._made)
        return made or (self.where(key)[:1] if key[0] == NODE else [])

    def element(self, number: int) -> Line | None:
        """The statement that makes an element."""
        line = self.made[ELEMENT].get(number)
        return None if line is None else self.tokens[line]

    def kind_of_element(self, number: int) -> ElementKind | None:
        """What an element is."""
        made = self.element(number)
        return None if made is None else made.element

    def comment(self, key: Key) -> str:
        """The comment behind the statement that makes it."""
        line = self.made[key[0]].get(key[1])
        return "" if line is None else self.tokens[line].comment

    def elements_on(self, node: int) -> list[int]:
        """Numbers of the elements that stand on a node."""
        tokens = self.tokens
        lines = tokens.line[(tokens.node != 0) & (tokens.number == node)]
        return [number for number in dict.fromkeys(tokens.owner[lines].tolist()) if number]

    def is_used(self, key: Key) -> bool:
        """Whether a number is that of a node, or of an element."""
        return bool((self._named[key[0]] & (self.tokens.number == key[1])).any())

    def free(self, kind: str) -> int:
        """The smallest number behind all that are in use."""
        return int(self.tokens.number[self._named[kind]].max(initial=0)) + 1


@dataclass(frozen=True, eq=False)
class Told:
    """A model of which is spoken without an analysis; see `analysis.places.Told`."""

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
    def tokens(self) -> Tokens:
        """Its lines and words."""
        return Tokens("\n".join(self.document.bare))

    @cached_property
    def index(self) -> Index:
        """Where its nodes and elements stand."""
        return Index(self.tokens)

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
