# SPDX-License-Identifier: BSD-3-Clause
"""The lines of a deck and their words, as the core reads them: the one reader of the language.

A deck need not be sound for this. Places are characters from 0; a byte mark is no part of a text.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..core import calls
from ..core.arrays import BoolArray, IntArray
from ..core.elements import element_kinds
from ..core.raw import ElementKind
from .diagnostics import Source, decode
from .keywords import Block, Keyword, keywords

_BLOCKS = (Block.KINEMATICS, *Block)


class Word(NamedTuple):
    """A word of a line before its comment."""

    text: str
    first: int
    """Its place in the line."""
    behind: int
    letter: str
    """What it is: k a keyword, E the number that an element gets, n a node, v part of a vector,
    else as in `Keyword.form`; blank where that is not known."""
    node: int
    """The kind that the node of an element must be, -1 for one of warping; else 0."""
    number: int
    """The whole number from 1 that it is; 0 where it is none."""


class Line(NamedTuple):
    """A line of a deck."""

    number: int
    """From 0."""
    text: str
    words: tuple[Word, ...]
    mark: int
    """Where its comment starts; the length of the line where there is none."""
    block: Block
    """The block that it stands in."""
    element: ElementKind | None
    """The kind of element that it makes."""
    keyword: Keyword | None
    """Its row in the table of keywords."""
    ends: bool
    """Whether it ends a block: END or HALT."""

    @property
    def name(self) -> str:
        """Its first word in capitals; empty without words."""
        return self.words[0].text.upper() if self.words else ""

    @property
    def comment(self) -> str:
        """Its comment without marks and blanks around it."""
        return self.text[self.mark :].strip("%#;* \t\r")

    def word_at(self, character: int) -> int | None:
        """Which word a place touches, 0 for the keyword."""
        touched = (k for k, word in enumerate(self.words) if word.first <= character <= word.behind)
        return next(touched, None)

    def number_of(self, word: int) -> int:
        """The whole number from 1 that word 0, 1, ... is; 0 where it is none, or not there."""
        return self.words[word].number if word < len(self.words) else 0


class Tokens:
    """A deck taken apart.

    Attributes:
        text: All of it.
        block: (lines,) the block that each line stands in.
        element: (lines,) number of the kind of element that it makes, or 0.
        keyword: (lines,) its row in the table of keywords from 1, 0 without one, -1 where it ends
            a block.
        line: (words,) which line each word stands in.
        letter: (words,) as `Word.letter`, as codes.
        node: (words,) as `Word.node`.
        number: (words,) as `Word.number`.
    """

    def __init__(self, text: str) -> None:
        """Have a text read by the core; what is not ASCII is in no keyword and in no number."""
        self.text = text
        self._lines, self._words = calls.find_tokens(text.encode("ascii", "replace"))
        ends, self.block, self.element, self.keyword = self._lines[3:]
        self.letter, self.node, self.number = self._words[2:]
        self._start = np.concatenate((np.zeros(1, np.int32), ends))
        self.line = np.repeat(np.arange(ends.size, dtype=np.int32), np.diff(self._start))
        self._rows = tuple(keywords().values())

    def __len__(self) -> int:
        """How many lines there are; behind the last line feed stands one, too."""
        return len(self.block)

    def __getitem__(self, line: int) -> Line:
        """Line 0, 1, ..."""
        first, behind, mark, end, block, element, row = self._lines[:, line].tolist()
        words = self._words[:, self._start[line] : end].T.tolist()
        text = self.text
        return Line(
            line,
            text[first:behind],
            tuple(
                Word(text[at:to], at - first, to - first, chr(letter), node, number)
                for at, to, letter, node, number in words
            ),
            mark - first,
            _BLOCKS[block],
            element_kinds()[element - 1] if element else None,
            self._rows[row - 1] if row > 0 else None,
            row < 0,
        )

    def __iter__(self) -> Iterator[Line]:
        """Line by line."""
        return map(self.__getitem__, range(len(self)))

    def place_of(self, word: int) -> tuple[int, int, int]:
        """The line of a word, and where in it the word starts and ends."""
        line = int(self.line[word])
        first, behind = (self._words[:2, word] - self._lines[0, line]).tolist()
        return line, first, behind

    @property
    def owner(self) -> IntArray:
        """(lines,) the whole number from 1 that the first operand of each is, or 0."""
        second = np.flatnonzero(np.diff(self._start) > 1)
        made = np.zeros(len(self), np.int32)
        made[second] = self.number[self._start[second] + 1]
        return made

    def lines_of(self, *names: str) -> IntArray:
        """The lines of statements with some keywords; "element" are those of all elements."""
        rows = [k for k, (_, name) in enumerate(keywords(), start=1) if name in names]
        found: BoolArray = np.isin(self.keyword, rows)
        if "element" in names:
            found |= self.element > 0
        return np.flatnonzero(found).astype(np.int32)


def tokens_of(source: Source) -> Tokens:
    """Those of a deck as it was read, decoded line by line where not all of it is UTF-8."""
    try:
        return Tokens(source.text.decode("utf-8"))
    except UnicodeDecodeError:
        return Tokens("\n".join(map(decode, source.text.split(b"\n"))))
