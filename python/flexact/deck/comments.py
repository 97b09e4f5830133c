# SPDX-License-Identifier: BSD-3-Clause
"""The comments of a deck, and the statements that they belong to."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from ..core.elements import element_kinds
from .diagnostics import Source, decode

#: Statements by what they are written as again, and the number of their node or element.
Key = tuple[str, int]

#: Of all elements; their numbers are their own, whatever their keywords.
ELEMENT = "element"
#: Which has no number.
GRAVITY = "GRAVITY"
_KINEMATICS, _DYNAMICS, _BEHIND, _PICTURE = range(4)
#: What a statement is written as again, by block.
_WRITTEN_AS: dict[int, dict[str, str]] = {
    _KINEMATICS: {
        **{word: word for word in ("X", "FIX", "DYNX", "RLSE", "DYNE")},
        "INPUTX": "DYNX",
        "INPUTE": "DYNE",
    },
    _DYNAMICS: {
        **{word: word for word in ("ESTIFF", "EM", "XM", "XF", "DELXF", GRAVITY)},
        "EMASS": "EM",
        "MASS": "XM",
        "FORCE": "XF",
    },
}
#: Whose comments are names, which are data of the model.
_NAMED = (ELEMENT, "X")
#: Of the largest number of a node or an element.
_MOST_DIGITS = 10
_MARK = re.compile(r"[%#]")
_MARK_OF_PICTURES = re.compile(r"[%#;]")


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
    reader = _Reader(made)
    for line in _lines(source.text):
        reader.read(line.rstrip())
    reader.finish()
    return made


def _lines(text: bytes) -> list[str]:
    try:
        return text.decode("utf-8").split("\n")
    except UnicodeDecodeError:
        return [decode(line) for line in text.split(b"\n")]


class _Reader:
    """Goes through the lines of a deck as the core does, and keeps what it passes over."""

    def __init__(self, made: DeckComments) -> None:
        self.made = made
        self.block = _KINEMATICS
        self.has_begun = False
        #: Lines since the last statement that is written again.
        self.waiting: list[str] = []
        kinds = element_kinds()
        self.elements = {word for kind in kinds for word in (kind.keyword, kind.synonym) if word}
        # Read as beams, and written as such.
        self.elements.add("BEAMW")

    def read(self, line: str) -> None:
        """Take the next line."""
        body, comment = self._parts(line)
        words = body.split(None, 2)
        if words:
            self._statement(words[0].upper(), words[1] if len(words) > 1 else "", comment)
        elif comment:
            lines = self.waiting if self.has_begun else self.made.top
            # What opens a comment of a picture does so nowhere else.
            lines.append(_printable(f"% {comment[1:].lstrip()}" if comment[0] == ";" else line))

    def finish(self) -> None:
        """Take the end of the deck."""
        self._close()

    def _parts(self, line: str) -> tuple[str, str]:
        """A line before its comment, and the comment with its mark."""
        if line.startswith("*"):
            return "", line
        pattern = _MARK_OF_PICTURES if self.block == _PICTURE else _MARK
        mark = pattern.search(line)
        return (line, "") if mark is None else (line[: mark.start()], line[mark.start() :])

    def _statement(self, keyword: str, number: str, comment: str) -> None:
        self.has_begun = True
        if keyword in ("END", "HALT", "VISUALIZATION"):
            self._next_block(keyword)
            return
        written = _WRITTEN_AS.get(self.block, {}).get(keyword)
        if self.block == _KINEMATICS and keyword in self.elements:
            written = ELEMENT
        # Python makes no number of thousands of digits, even of zeros.
        digits = "0" if written == GRAVITY else number.removeprefix("+").lstrip("0")
        if written is None or not digits.isdecimal() or len(digits) > _MOST_DIGITS:
            return
        key = written, int(digits)
        if self.waiting:
            self.made.before.setdefault(key, []).extend(self.waiting)
            self.waiting = []
        if comment and written not in _NAMED and (words := _words_of(comment)):
            self.made.behind.setdefault(key, []).append(words)

    def _next_block(self, word: str) -> None:
        if self.block == _PICTURE:
            return
        self._close()
        if word == "VISUALIZATION":
            self.block = _PICTURE
        elif word == "END":
            self.block = _DYNAMICS if self.block == _KINEMATICS else _BEHIND

    def _close(self) -> None:
        lines = self.made.end if self.block == _KINEMATICS else self.made.rest
        lines.extend(self.waiting)
        self.waiting = []


def _words_of(comment: str) -> str:
    """A comment without its mark, as it reads again."""
    return _printable(comment).lstrip("%# ")


def _printable(text: str) -> str:
    if not text.isprintable():
        text = "".join(c if c.isprintable() else " " for c in text)
    return text.rstrip()
