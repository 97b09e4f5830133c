# SPDX-License-Identifier: BSD-3-Clause
"""The text of a deck as an editor has it: lines, positions in an editor's units, changes.

Inside, a position is a line from 0 and a character (code point) from 0. Editors count in the
units of the encoding that was agreed upon, and end lines at CR, LF and CR LF alone.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NamedTuple

from ...util.records import cached_property

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

    def replaced(self, text: str, version: int) -> Document:
        """The document with all of its text anew."""
        return Document.of(text, self.uri, version, self.encoding)

    def place_of(self, line: int, column: int) -> Position:
        """The position of a line and a character of the core's, both from 1.

        Both end lines at LF, CR and CR LF.
        """
        if self.text.startswith(_BYTE_MARK) and line == 1:
            column += 1
        return self.clamped(Position(line - 1, column - 1))
