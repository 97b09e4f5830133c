# SPDX-License-Identifier: BSD-3-Clause
"""Lines, positions and changes of a text, against a plain reading of the protocol."""

import random
import re

import pytest

from flexact.apps.editor.deck import Deck, Document, Position, split
from flexact.apps.editor.session import problems_of

_CODECS = {"utf-8": "utf-8", "utf-16": "utf-16-le", "utf-32": "utf-32-le"}
_WIDTHS = {"utf-8": 1, "utf-16": 2, "utf-32": 4}
_SCRAPS = ["a", "B 1", "é", "😀", "\n", "\r", "\r\n", "\u2028", "\x0b", "\t", "% x\n", ""]


def offset_of(text: str, line: int, character: int, encoding: str) -> int:
    """Characters before a position, by the words of the protocol: a line ends at CR LF, LF, CR."""
    ends = [0, *(found.end() for found in re.finditer(r"\r\n|\n|\r", text))]
    if line >= len(ends):
        return len(text)
    rest = re.match(r"[^\r\n]*", text[ends[line] :])
    assert rest is not None
    raw = rest[0].encode(_CODECS[encoding])[: character * _WIDTHS[encoding]]
    return ends[line] + len(raw.decode(_CODECS[encoding], "ignore"))


@pytest.mark.parametrize("encoding", list(_CODECS))
def test_changes_are_those_of_the_whole_text(encoding: str) -> None:
    dice = random.Random(f"changes {encoding}")
    for _ in range(60):
        text = "".join(dice.choices(_SCRAPS, k=dice.randrange(12)))
        document = Document.of(text, encoding=encoding)
        for version in range(8):
            places = sorted((dice.randrange(9), dice.randrange(6)) for _ in range(2))
            new = "".join(dice.choices(_SCRAPS, k=dice.randrange(4)))
            first, last = (offset_of(text, *place, encoding) for place in places)
            last = max(first, last)
            start, end = (document.taken(*place) for place in places)
            document = document.changed(start, end, new, version)
            text = text[:first] + new + text[last:]
            assert document.text == text
            assert document.lines == split(text)
            assert len(document.lines) == len(re.split(r"\r\n|\n|\r", text))


@pytest.mark.parametrize("encoding", list(_CODECS))
def test_positions_go_to_the_editor_and_back(encoding: str) -> None:
    document = Document.of("é😀 a\r\nb\n", encoding=encoding)
    for line, text in enumerate(document.bare):
        for character in range(len(text) + 1):
            position = Position(line, character)
            assert document.taken(*document.given(position)) == position
    counts = {"utf-8": 6, "utf-16": 3, "utf-32": 2}
    assert document.given(Position(0, 2)) == (0, counts[encoding])
    # Half a character is none, and what is beyond the end is the end.
    assert document.taken(0, 1 if encoding == "utf-8" else 0) == (0, 0)
    assert document.taken(0, 99) == (0, 4)
    assert document.taken(99, 3) == (2, 0)


@pytest.mark.parametrize(
    ("before", "line"),
    [("", 0), ("% x\n", 1), ("% x\r\n", 1), ("% \u2028 \x85\n", 1), ("\ufeff", 0), ("% é😀\n", 1)],
)
def test_a_problem_stands_where_its_word_stands(before: str, line: int) -> None:
    document = Document.of(f"{before}TRUSS 1 1 2 % é😀\nX 2 1..0 0 0\n")
    (problem,) = problems_of(Deck(document))
    assert problem.code == "bad-number"
    start, end = problem.range
    assert start.line == end.line == line + 1
    assert document.bare[start.line][start.character : end.character] == "1..0"


def test_lines_of_the_core_are_those_of_the_editor() -> None:
    """A CR alone ends a line of both, also among lines that end with LF."""
    mixed = Document.of("TRUSS 1 1 2\rX 2 1..0 0 0\n")
    found = {one.code: one.range.start for one in problems_of(Deck(mixed))}
    assert found == {"bad-number": (1, 4)}
    old = Document.of("TRUSS 1 1 2\rX 2 1..0 0 0\r")
    (problem,) = problems_of(Deck(old))
    assert problem.range.start == (1, 4)


def test_problems_without_a_place_stand_on_the_first_line() -> None:
    (problem,) = problems_of(Deck(Document.of("")))
    assert problem.code == "empty-deck" and problem.range.start == (0, 0)
