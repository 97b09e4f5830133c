# SPDX-License-Identifier: BSD-3-Clause
"""The words of a line, and the block that it stands in; a deck need not be sound for this."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

from ..core.raw import ElementKind
from ..deck.keywords import ENDINGS, WITH_WARPING, Block, Keyword, element_of, find_keyword
from .document import Document, Range

_WORD = re.compile(r"[^\x00-\x20]+")
_NUMBER = re.compile(r"\+?0*([1-9]\d{0,9})\Z")
_MARKS = {False: re.compile(r"[%#]"), True: re.compile(r"[%#;]")}
_ENDING = re.compile(
    r"^[\x00-\x09\x0b-\x20]*(END|HALT|VISUALIZATION)(?=[\x00-\x20%#;]|\Z)",
    re.IGNORECASE | re.MULTILINE,
)


class Word(NamedTuple):
    """A word of a line and where it stands."""

    text: str
    first: int
    last: int
    """Behind its last character."""

    @property
    def number(self) -> int | None:
        """The positive number that it is; None where it is none."""
        found = _NUMBER.match(self.text)
        return int(found[1]) if found else None


class Reference(NamedTuple):
    """A number of a node or an element in a statement."""

    kind: str
    """"node" or "element"."""
    number: int
    place: int
    """Which word it is."""
    defines: bool
    """Whether the statement makes the element, or gives the node its place."""


class Words:
    """What a line says, wherever it stands.

    Attributes:
        words: Its words before the comment; none in a line of comment.
        block: The block that it stands in.
        comment: What stands behind the mark of a comment, without blanks.
        mark: Where the comment starts; the length of the line where there is none.
        name: Its keyword in capitals; empty without words.
    """

    def __init__(self, text: str, block: Block) -> None:
        """Take a line apart."""
        found = _MARKS[block is Block.PICTURE].search(text)
        self.block = block
        self.mark = 0 if text.startswith("*") else found.start() if found else len(text)
        self.words = tuple(
            Word(one[0], one.start(), one.end()) for one in _WORD.finditer(text, 0, self.mark)
        )
        self.comment = text[self.mark :].strip("%#;* \t")
        self.name = self.words[0].text.upper() if self.words else ""

    @cached_property
    def element(self) -> ElementKind | None:
        """The kind of element that it makes."""
        return element_of(self.name)

    @cached_property
    def keyword(self) -> Keyword | None:
        """Its row in the table of keywords."""
        return find_keyword(self.name, self.block)

    @property
    def is_statement(self) -> bool:
        """Whether it says something: not where it is behind the second END."""
        return bool(self.words) and self.name not in ENDINGS and self.block is not Block.CLOSED

    def word_at(self, character: int) -> int | None:
        """The word that a place touches, 0 for the keyword."""
        for place, word in enumerate(self.words):
            if word.first <= character <= word.last:
                return place
        return None

    def letter(self, place: int) -> str:
        """What operand 1, 2, ... is: e element, n node, i component, r real, w word, v vector.

        E is the number that an element gets; empty where that is not known.
        """
        if place < 1:
            return ""
        kind = self.element
        if kind is not None:
            nodes = sum(slot > 0 for slot in kind.slots) + 2 * (self.name == WITH_WARPING)
            return "E" if place == 1 else "n" if place <= nodes + 1 else "v"
        return self.keyword.letter(place) if self.keyword is not None else ""

    @cached_property
    def references(self) -> tuple[Reference, ...]:
        """The nodes and elements that it names."""
        if not self.is_statement:
            return ()
        made = []
        for place, word in enumerate(self.words):
            letter = self.letter(place)
            if letter and letter in "Een" and (number := word.number) is not None:
                kind = "node" if letter == "n" else "element"
                defines = letter == "E" or (self.name == "X" and place == 1)
                made.append(Reference(kind, number, place, defines))
        return tuple(made)

    def number(self, place: int) -> int | None:
        """The positive number that word 0, 1, ... is; None where it is none."""
        return self.words[place].number if place < len(self.words) else None


class Statement(NamedTuple):
    """What a line says, and which one it is, from 0."""

    line: int
    says: Words

    def span(self, place: int) -> Range:
        """Where a word stands."""
        word = self.says.words[place]
        return Range.within(self.line, word.first, word.last)

    @property
    def whole(self) -> Range:
        """From the first word to the last."""
        words = self.says.words
        return Range.within(self.line, words[0].first, words[-1].last)


class Blocks:
    """Which block each line stands in."""

    def __init__(self, document: Document) -> None:
        """Go through what ends blocks, and opens them."""
        self.starts, self.blocks = [0], [Block.KINEMATICS]
        #: Lines of END, HALT and VISUALIZATION.
        self.ends: list[tuple[int, str]] = []
        text, line, seen = "\n".join(document.bare), 0, 0
        for found in _ENDING.finditer(text):
            line += text.count("\n", seen, found.start(1))
            seen = found.start(1)
            self._end(line, found[1].upper())

    def _end(self, line: int, word: str) -> None:
        block = self.blocks[-1]
        if block is Block.PICTURE:
            return
        self.ends.append((line, word))
        behind = line + 1
        if word == "VISUALIZATION":
            behind, block = line, Block.PICTURE
        elif word == "END":
            block = Block.DYNAMICS if block is Block.KINEMATICS else Block.CLOSED
        elif block is Block.CLOSED:
            block = Block.IN_OUT
        elif block is Block.KINEMATICS:
            block = Block.DYNAMICS
        if block is not self.blocks[-1]:
            self.starts.append(behind)
            self.blocks.append(block)

    def of_line(self, line: int) -> Block:
        """The block of a line, from 0."""
        return self.blocks[bisect_right(self.starts, line) - 1]


class Statements:
    """The lines of a document, each taken apart when it is asked for.

    What was taken apart is kept for the next states of the document, in `Document.known`.
    """

    def __init__(self, document: Document) -> None:
        """Of a document at one moment."""
        self.document = document
        self.blocks = Blocks(document)

    def at(self, line: int) -> Statement:
        """What a line says, of whatever kind it is."""
        text, block = self.document.bare[line], self.blocks.of_line(line)
        known = self.document.known
        made = known.get((text, block))
        if made is None:
            made = known[text, block] = Words(text, block)
        return Statement(line, made)

    def __iter__(self) -> Iterator[Statement]:
        """All lines that say something."""
        for line in range(len(self.document.bare)):
            made = self.at(line)
            if made.says.is_statement:
                yield made
