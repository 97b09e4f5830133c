# SPDX-License-Identifier: BSD-3-Clause
"""The lines of a deck, their words and comments, as the core reads them: its one reader.

A deck need not be sound for this. Places are characters from 0; a byte mark is no part of a text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
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


#: Statements by what they are written as again, and the number of their node or element.
Key = tuple[str, int]

#: Of all elements; their numbers are their own, whatever their keywords.
ELEMENT = "element"
#: Which have no number.
GRAVITY, UNITS = "GRAVITY", "UNITS"
#: What a statement is written as again, by block and keyword.
_WRITTEN_AS = {
    **{(Block.KINEMATICS, word): word for word in (UNITS, "X", "FIX", "DYNX", "RLSE", "DYNE")},
    (Block.KINEMATICS, "INPUTX"): "DYNX",
    (Block.KINEMATICS, "INPUTE"): "DYNE",
    **{(Block.DYNAMICS, word): word for word in ("ESTIFF", "EM", "XM", "XF", "DELXF", GRAVITY)},
    **{(Block.DYNAMICS, word): word for word in ("STRENGTH", "EXPANSION", "FILLET")},
    (Block.DYNAMICS, "EMASS"): "EM",
    (Block.DYNAMICS, "MASS"): "XM",
    (Block.DYNAMICS, "FORCE"): "XF",
}
#: Whose comments are names, which are data of the model.
_NAMED = (ELEMENT, "X")


def key_of(line: Line) -> Key | None:
    """The statement that a line is written as again; None where it is not."""
    owner = line.number_of(1)
    if line.element is not None:
        return (ELEMENT, owner) if owner else None
    if line.keyword is None:
        return None
    word = _WRITTEN_AS.get((line.keyword.block, line.keyword.name))
    if word in (GRAVITY, UNITS):
        return word, 0
    return None if word is None or not owner else (word, owner)


@dataclass
class DeckComments:
    """Comments by where they stand; lines with their marks, others without.

    Attributes:
        top: Lines before the first statement.
        before: Lines before a statement.
        behind: What stands behind a statement in its line.
        end: Lines behind the last statement of the kinematics that is written again.
        rest: Lines of the other blocks that stand before no statement that is.
    """

    top: list[str] = field(default_factory=list)
    before: dict[Key, list[str]] = field(default_factory=dict)
    behind: dict[Key, list[str]] = field(default_factory=dict)
    end: list[str] = field(default_factory=list)
    rest: list[str] = field(default_factory=list)

    def beside(self, keyword: str, statements: Iterable[tuple[int, str]]) -> Iterator[str]:
        """Lines of statements of one keyword, given by number and text, with their comments."""
        if not self.before and not self.behind:
            yield from (line for _, line in statements)
            return
        for number, line in statements:
            key = keyword, number
            yield from self.before.get(key, ())
            behind = self.behind.get(key)
            yield f"{line} % {'; '.join(behind)}" if behind else line


def comments_of(source: Source | None) -> DeckComments:
    """The comments of a deck that has no errors, or of none."""
    made = DeckComments()
    if source is None or not re.search(rb"[%#]|^\*", source.text, re.MULTILINE):
        return made
    #: Lines since the last statement that is written again.
    waiting: list[str] = []
    has_begun = False
    block = Block.KINEMATICS
    for line in tokens_of(source):
        comment = line.text[line.mark :].rstrip()
        is_new = line.block is Block.PICTURE is not block
        if is_new or (line.ends and line.block is not Block.PICTURE):
            (made.end if block is Block.KINEMATICS else made.rest).extend(waiting)
            waiting = []
        block = line.block
        has_begun = has_begun or bool(line.words)
        if not line.words and comment:
            # What opens a comment of a picture does so nowhere else.
            text = f"% {comment[1:].lstrip()}" if comment[0] == ";" else line.text
            (waiting if has_begun else made.top).append(_printable(text))
        key = key_of(line)
        if key is None:
            continue
        if waiting:
            made.before.setdefault(key, []).extend(waiting)
            waiting = []
        if key[0] not in _NAMED and (words := _printable(comment).lstrip("%# ")):
            made.behind.setdefault(key, []).append(words)
    (made.end if block is Block.KINEMATICS else made.rest).extend(waiting)
    return made


def _printable(text: str) -> str:
    if not text.isprintable():
        text = "".join(c if c.isprintable() else " " for c in text)
    return text.rstrip()
