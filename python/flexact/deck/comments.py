# SPDX-License-Identifier: BSD-3-Clause
"""The comments of a deck, and the statements that they belong to."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from .diagnostics import Source
from .keywords import Block
from .tokens import Line, tokens_of

#: Statements by what they are written as again, and the number of their node or element.
Key = tuple[str, int]

#: Of all elements; their numbers are their own, whatever their keywords.
ELEMENT = "element"
#: Which has no number.
GRAVITY = "GRAVITY"
#: What a statement is written as again, by block and keyword.
_WRITTEN_AS = {
    **{(Block.KINEMATICS, word): word for word in ("X", "FIX", "DYNX", "RLSE", "DYNE")},
    (Block.KINEMATICS, "INPUTX"): "DYNX",
    (Block.KINEMATICS, "INPUTE"): "DYNE",
    **{(Block.DYNAMICS, word): word for word in ("ESTIFF", "EM", "XM", "XF", "DELXF", GRAVITY)},
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
    if word == GRAVITY:
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
