# SPDX-License-Identifier: BSD-3-Clause
"""A deck of which only the statements change that a change of the model is about.

All else stays to the letter: comments, blanks, what the analysis does not use. What comes of it
is read again; where it does not say the same as the changed model, the model is written anew.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..core.elements import element_kinds
from ..deck.comments import ELEMENT, DeckComments
from ..deck.rendering import DeckError
from .data import ModelData
from .reading import read_bytes
from .writing import deck_of, dynamics_of, statements_of

#: A statement by its keyword, of elements "element", and its number.
Key = tuple[str, int]
#: What keywords are written as.
_WRITTEN_AS = {
    **{word: word for word in ("X", "FIX", "DYNX", "RLSE", "DYNE")},
    **{"INPUTX": "DYNX", "INPUTE": "DYNE"},
}
_NUMBER = re.compile(r"\+?0*([1-9]\d{0,9})$")
_WORD = re.compile(r"\S+")


def edited_deck(given: ModelData, changed: ModelData) -> bytes:
    """The deck of a changed model, made of the deck of the model that it was.

    Args:
        given: The model as it was read; of one that was made in Python there is no deck.
        changed: The same with other classes, places or vectors, or with more elements.

    Returns:
        Its text, in the encoding of the deck.
    """
    edited = edited_to_the_letter(given, changed)
    return deck_of(changed).encode() if edited is None else edited


def edited_to_the_letter(given: ModelData, changed: ModelData) -> bytes | None:
    """As `edited_deck`; None where there is no deck, or what it says cannot be changed in it."""
    source = given.source or given.began_as
    if source is None:
        return None
    old, new = dict(statements_of(given)), dict(statements_of(changed))
    # Every byte is a character, so that whatever the deck holds stays.
    lines = source.text.decode("latin-1").split("\n")
    edited = {
        key: new.get(key, "").encode().decode("latin-1")
        for key in dict.fromkeys((*old, *new))
        if old.get(key) != new.get(key)
    }
    text = "\n".join(_Editor(edited).lines(lines)).encode("latin-1")
    return text if _says(text, changed) else None


def _says(text: bytes, wanted: ModelData) -> bool:
    """Whether a text is the deck of a model, as far as an analysis goes."""
    try:
        made = read_bytes(text, "")
    except DeckError:
        return False
    return all(
        sorted(of(made)) == sorted(of(wanted))
        for of in (statements_of, lambda data: dynamics_of(data, DeckComments()))
    )


class _Editor:
    """Goes through the lines of a deck, and puts statements in the place of others."""

    def __init__(self, edited: dict[Key, str]) -> None:
        """Keep the statements that change, empty where one is taken away."""
        self.edited = edited
        self.left = dict(edited)
        kinds = element_kinds()
        self.elements = {word for kind in kinds for word in (kind.keyword, kind.synonym) if word}
        self.elements.add("BEAMW")

    def lines(self, given: list[str]) -> list[str]:
        """The lines of the deck, changed."""
        kept: list[tuple[str, list[str]]] = []
        end = None
        for place, line in enumerate(given):
            body, comment = _parts(line)
            words = _WORD.findall(body)
            if words and words[0].upper() in ("END", "HALT", "VISUALIZATION"):
                end = place
                break
            key = self._key(words)
            written = [line] if key is None else list(self._written(key, line, comment))
            kept.append(("" if key is None else key[0], written))
        rest = [] if end is None else given[end:]
        return [*self._with_new(kept, bool(rest)), *rest]

    def _key(self, words: list[str]) -> Key | None:
        """Which statement the words of a line are; None where they are no statement of a model."""
        found = _NUMBER.match(words[1]) if len(words) > 1 else None
        if found is None:
            return None
        keyword = words[0].upper()
        written = ELEMENT if keyword in self.elements else _WRITTEN_AS.get(keyword)
        return None if written is None else (written, int(found[1]))

    def _written(self, key: Key, line: str, comment: str) -> Iterator[str]:
        """What stands in the place of a line; what it says besides stays as a comment."""
        if key not in self.edited:
            yield line
            return
        statement = self.left.pop(key, "")
        if not statement:
            if comment.strip("%# \t\r"):
                yield comment
            return
        body = line[: len(line) - len(comment)]
        keyword = _WORD.search(body)
        assert keyword is not None
        operands = statement.partition(" % ")[0].partition(" ")[2]
        gap = body[len(body.rstrip()) :]
        yield f"{body[: keyword.end()]} {operands}{gap}{comment}"

    def _with_new(self, kept: list[tuple[str, list[str]]], is_ended: bool) -> list[str]:
        """All lines, new statements behind the last of their keyword."""
        new: dict[str, list[str]] = {}
        for (keyword, _), statement in self.left.items():
            if statement:
                new.setdefault(keyword, []).append(statement)
        ending = "\r" if any(line.endswith("\r") for _, lines in kept for line in lines) else ""
        last = {keyword: place for place, (keyword, _) in enumerate(kept)}
        made: list[str] = []
        for place, (keyword, lines) in enumerate(kept):
            made += lines
            if keyword in new and last[keyword] == place:
                made += [statement + ending for statement in new.pop(keyword)]
        behind = [statement + ending for statements in new.values() for statement in statements]
        # Behind the last line there is nothing, or the end of the text.
        is_open = not is_ended and made and not made[-1]
        return [*made[:-1], *behind, ""] if is_open else [*made, *behind]


def _parts(line: str) -> tuple[str, str]:
    """A line of the kinematics before its comment, and the comment with its mark."""
    if line.startswith("*"):
        return "", line
    mark = re.search(r"[%#]", line)
    return (line, "") if mark is None else (line[: mark.start()], line[mark.start() :])
