# SPDX-License-Identifier: BSD-3-Clause
"""The words of a line, and the block that it stands in; a deck need not be sound for this."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

from ...core.raw import ElementKind
from ...deck.keywords import ENDINGS, WITH_WARPING, Block, Keyword, element_of, find_keyword
from .document import Document, Range

_WORD = re.compile(r"[^\x00-\x20]+")
_NUMBER = re.compile(r"\+?0*([1-9]\d{0,9})\Z")
_ENDING = re.compile(
    r"^[\x00-\x09\x0b-\x20]*(END|HALT|VISUALIZATION)(?=[\x00-\x20%#;]|\Z)",
    re.IGNORECASE | re.MULTILINE,
)


def _number(word: str) -> int | None:
    found = _NUMBER.match(word)
    return int(found[1]) if found else None


class Word(NamedTuple):
    """A word of a line and where it stands."""

    text: str
    first: int
    last: int
    """Behind its last character."""

    @property
    def number(self) -> int | None:
        """The positive number that it is; None where it is none."""
        return _number(self.text)


class Reference(NamedTuple):
    """A number of a node or an element in a statement."""

    kind: str
    """"node" or "element"."""
    number: int
    place: int
    """Which word it is."""
    defines: bool
    """Whether the statement makes the element, or gives the node its place."""


class Plan(NamedTuple):
    """What a keyword makes of the words behind it."""

    element: ElementKind | None
    """The kind of element that it makes."""
    keyword: Keyword | None
    """Its row in the table of keywords."""
    letters: str
    """A letter an operand, the last one repeated: those of keywords; of elements E the number
    that the element gets, n its nodes, v its vector."""

    def letter(self, place: int) -> str:
        """What operand 1, 2, ... is; empty where that is not known."""
        return self.letters[min(place, len(self.letters)) - 1] if self.letters and place else ""


@cache
def _known_plan(name: str, block: Block) -> Plan:
    kind = element_of(name)
    if kind is not None:
        nodes = sum(slot > 0 for slot in kind.slots) + 2 * (name == WITH_WARPING)
        return Plan(kind, None, f"E{'n' * nodes}v")
    keyword = find_keyword(name, block)
    return Plan(None, keyword, keyword.form if keyword is not None else "")


_NO_PLAN = Plan(None, None, "")
#: No keyword is longer, so that what is typed wrong is not remembered.
_LONGEST = 13


def plan_of(name: str, block: Block) -> Plan:
    """What a word in capitals makes of the words behind it."""
    return _known_plan(name, block) if len(name) <= _LONGEST and name.isalpha() else _NO_PLAN


class Facts(NamedTuple):
    """What an index wants to know of a line, wherever it stands."""

    name: str
    """The keyword in capitals; empty without one."""
    element: ElementKind | None
    references: tuple[Reference, ...]
    is_statement: bool
    """Whether it says something: not where it is behind the second END."""
    is_blank: bool
    comment: str
    """What stands behind the mark of a comment, without blanks."""


def _mark(text: str, block: Block) -> int:
    """Where the comment of a line starts; its length where there is none."""
    if text.startswith("*"):
        return 0
    mark = len(text)
    for c in "%#;" if block is Block.PICTURE else "%#":
        found = text.find(c, 0, mark)
        mark = found if found >= 0 else mark
    return mark


def facts_of(text: str, block: Block) -> Facts:
    """What an index wants to know of a line."""
    mark = _mark(text, block)
    words = _WORD.findall(text, 0, mark)
    comment = text[mark:].strip("%#;* \t") if mark < len(text) else ""
    name = words[0].upper() if words else ""
    is_statement = bool(words) and name not in ENDINGS and block is not Block.CLOSED
    if not is_statement:
        return Facts(name, None, (), False, not words and mark == len(text), comment)
    plan = plan_of(name, block)
    made = []
    for place, word in enumerate(words):
        letter = plan.letter(place)
        if letter and letter in "Een" and (number := _number(word)) is not None:
            kind = "node" if letter == "n" else "element"
            made.append(Reference(kind, number, place, letter == "E" or (name, place) == _X))
    return Facts(name, plan.element, tuple(made), True, False, comment)


_X = ("X", 1)


class Words:
    """The words of a line, and where they stand.

    Attributes:
        words: Its words before the comment; none in a line of comment.
        block: The block that it stands in.
        mark: Where the comment starts; the length of the line where there is none.
        name: Its keyword in capitals; empty without words.
        facts: What is known of it besides.
        element: The kind of element that it makes.
        keyword: Its row in the table of keywords.
    """

    def __init__(self, text: str, block: Block) -> None:
        """Take a line apart."""
        self.block, self.mark = block, _mark(text, block)
        self.words = tuple(
            Word(one[0], one.start(), one.end()) for one in _WORD.finditer(text, 0, self.mark)
        )
        self.facts = facts_of(text, block)
        self.name = self.facts.name
        self._plan = plan_of(self.name, block)
        self.element, self.keyword = self._plan.element, self._plan.keyword

    def word_at(self, character: int) -> int | None:
        """The word that a place touches, 0 for the keyword."""
        for place, word in enumerate(self.words):
            if word.first <= character <= word.last:
                return place
        return None

    def letter(self, place: int) -> str:
        """What operand 1, 2, ... is, as `Plan.letters` says; empty where that is not known."""
        return self._plan.letter(place)

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

    What is known of a line is kept for the next states of the document, in `Document.known`.
    """

    def __init__(self, document: Document) -> None:
        """Of a document at one moment."""
        self.document = document
        self.blocks = Blocks(document)

    def at(self, line: int) -> Statement:
        """What a line says, of whatever kind it is."""
        return Statement(line, Words(self.document.bare[line], self.blocks.of_line(line)))

    def facts(self) -> Iterator[Facts]:
        """What is known of each line."""
        known = self.document.known
        starts = [*self.blocks.starts, len(self.document.bare)]
        for block, first, behind in zip(self.blocks.blocks, starts, starts[1:], strict=False):
            for text in self.document.bare[first:behind]:
                key = (text, block)
                made = known.get(key)
                if made is None:
                    made = known[key] = facts_of(text, block)
                yield made
