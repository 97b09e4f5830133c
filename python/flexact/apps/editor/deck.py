# SPDX-License-Identifier: BSD-3-Clause
"""A deck as an editor has it: its text, and where nodes and elements are made and named in it.

Inside, a position is a line from 0 and a character (code point) from 0. Editors count in the
units of the encoding that was agreed upon, and end lines at CR, LF and CR LF alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...core.arrays import BoolArray
from ...deck.diagnostics import Problems
from ...deck.rendering import DeckError
from ...deck.tokens import Line, Tokens
from ...model.data import ModelData
from ...model.parts.condensing import Condensed, as_given
from ...model.parts.parts import Parts
from ...model.reading import read_bytes
from ...util.records import cached_property
from ...util.units import METRES, MILLIMETRES, Units

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n)")
_BYTE_MARK = "\ufeff"


class Position(NamedTuple):
    """A place between two characters."""

    line: int
    character: int


class Range(NamedTuple):
    """From a place to another one."""

    start: Position
    end: Position

    @classmethod
    def within(cls, line: int, first: int, last: int) -> Range:
        """Part of one line."""
        return cls(Position(line, first), Position(line, last))

    def holds(self, position: Position) -> bool:
        """Whether a place lies in it, at its end too."""
        return self.start <= position <= self.end


class Edit(NamedTuple):
    """New text in the place of other text."""

    range: Range
    text: str


def split(text: str) -> list[str]:
    """The lines of a text with their ends; the last one has none, and may be empty."""
    lines = _LINE.findall(text)
    lines.append(text[sum(map(len, lines)) :])
    return lines


def units(text: str, encoding: str) -> int:
    """The length of a text in the units of "utf-8", "utf-16" or "utf-32"."""
    if encoding == "utf-32" or text.isascii():
        return len(text)
    if encoding == "utf-8":
        return len(text.encode("utf-8", "surrogatepass"))
    return len(text) + sum(c > "\uffff" for c in text)


def characters(text: str, count: int, encoding: str) -> int:
    """How many characters of a text so many units are; half a character is none."""
    if count <= 0:
        return 0
    if encoding == "utf-32" or text.isascii():
        return min(count, len(text))
    left = count
    for place, c in enumerate(text):
        left -= units(c, encoding)
        if left < 0:
            return place
    return len(text)


@dataclass(frozen=True, eq=False)
class Document:
    """A deck at one moment.

    Attributes:
        uri: What the editor calls it.
        lines: Its lines with their ends, the last one without; there is always one.
        version: The editor's number of this state.
        encoding: In what units the editor counts characters.
    """

    uri: str
    lines: list[str]
    version: int = 0
    encoding: str = "utf-16"

    @classmethod
    def of(cls, text: str, uri: str = "", version: int = 0, encoding: str = "utf-16") -> Document:
        """A document from its text."""
        return cls(uri, split(text), version, encoding)

    @cached_property
    def text(self) -> str:
        """All of it."""
        return "".join(self.lines)

    @cached_property
    def bare(self) -> list[str]:
        """The lines without their ends, and the first one without a byte mark's words.

        A byte mark counts as a blank, so that places stay.
        """
        made = [line.rstrip("\r\n") for line in self.lines]
        if made[0].startswith(_BYTE_MARK):
            made[0] = " " + made[0][1:]
        return made

    @cached_property
    def ending(self) -> str:
        """How its lines end."""
        first = self.lines[0]
        return first[len(first.rstrip("\r\n")) :] or "\n"

    def clamped(self, position: Position) -> Position:
        """The nearest position that there is."""
        line = min(max(position.line, 0), len(self.lines) - 1)
        length = len(self.lines[line].rstrip("\r\n"))
        character = length if position.line > line else min(max(position.character, 0), length)
        return Position(line, character)

    def taken(self, line: int, character: int) -> Position:
        """A position as an editor counts, as ours."""
        if not 0 <= line < len(self.lines):
            return self.clamped(Position(line, 0))
        text = self.lines[line].rstrip("\r\n")
        return Position(line, characters(text, character, self.encoding))

    def given(self, position: Position) -> tuple[int, int]:
        """Our position as an editor counts."""
        line, character = self.clamped(position)
        return line, units(self.lines[line][:character], self.encoding)

    def changed(self, start: Position, end: Position, text: str, version: int) -> Document:
        """The document with other text from one position to another."""
        start, end = self.clamped(start), self.clamped(end)
        end = max(start, end)
        # A CR and an LF that come together end one line, so the neighbours are split again.
        first, last = max(start.line - 1, 0), min(end.line + 2, len(self.lines))
        before = "".join(self.lines[first : start.line])
        before += self.lines[start.line][: start.character]
        behind = self.lines[end.line][end.character :]
        behind += "".join(self.lines[end.line + 1 : last])
        pieces = split(before + text + behind)
        if last < len(self.lines) and not pieces[-1]:
            pieces.pop()
        lines = [*self.lines[:first], *pieces, *self.lines[last:]]
        return Document(self.uri, lines, version, self.encoding)

    def place_of(self, line: int, column: int) -> Position:
        """The position of a line and a character of the core's, both from 1.

        Both end lines at LF, CR and CR LF.
        """
        if self.text.startswith(_BYTE_MARK) and line == 1:
            column += 1
        return self.clamped(Position(line - 1, column - 1))


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
        return self._spans(key, self._made) or (self.where(key)[:1] if key[0] == NODE else [])

    def element(self, number: int) -> Line | None:
        """The statement that makes an element."""
        line = self.made[ELEMENT].get(number)
        return None if line is None else self.tokens[line]

    def comment(self, key: Key) -> str:
        """The comment behind the statement that makes it."""
        line = self.made[key[0]].get(key[1])
        return "" if line is None else self.tokens[line].comment

    def elements_on(self, node: int) -> list[int]:
        """Numbers of the elements that stand on a node."""
        tokens = self.tokens
        lines = tokens.line[(tokens.node != 0) & (tokens.number == node)]
        return [number for number in dict.fromkeys(tokens.owner[lines].tolist()) if number]

    def free(self, kind: str) -> int:
        """The smallest number behind all that are in use."""
        return int(self.tokens.number[self._named[kind]].max(initial=0)) + 1


class Told(NamedTuple):
    """A model of which is spoken without an analysis; see `analysis.places.Told`."""

    data: ModelData
    condensed: Condensed
    parts: Parts


@dataclass(frozen=True, eq=False)
class Deck:
    """A document with what is read off it, each when it is asked for."""

    document: Document
    name: str = "deck"

    @cached_property
    def tokens(self) -> Tokens:
        """Its lines and words."""
        return Tokens("\n".join(self.document.bare))

    @property
    def units(self) -> Units:
        """In which its numbers are; metres where what it says is none."""
        said = [self.tokens[int(k)].words for k in self.tokens.lines_of("UNITS")]
        named = [words[1].text.lower() for words in said if len(words) > 1]
        return MILLIMETRES if named[-1:] == [MILLIMETRES.name] else METRES

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
        data = self.data
        return None if data is None else Told(data, as_given(data), Parts(data))
