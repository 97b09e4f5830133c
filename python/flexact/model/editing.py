# SPDX-License-Identifier: BSD-3-Clause
"""A deck of which only the statements change that a change of the model is about.

All else stays to the letter: comments, blanks, what the analysis does not use. What comes of it
is read again; where it does not say the same as the changed model, the model is written anew.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from ..deck.keywords import Block
from ..deck.rendering import DeckError
from ..deck.tokens import DeckComments, Key, Line, Tokens, key_of
from ..util.groups import grouped
from .data import ModelData
from .reading import read_bytes
from .writing import deck_of, dynamics_of, statements_of


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
    # What is shown may be in other units than those of the deck.
    own = read_bytes(source.text, "").units
    given, changed = replace(given, units=own), replace(changed, units=own)
    old, new = dict(statements_of(given)), dict(statements_of(changed))
    edited = {
        key: new.get(key, "").encode().decode("latin-1")
        for key in dict.fromkeys((*old, *new))
        if old.get(key) != new.get(key)
    }
    # With an element or a node goes what is said of its stiffness, mass and loads.
    of_old, of_new = (_keys_of(dynamics_of(data, DeckComments())) for data in (given, changed))
    edited |= dict.fromkeys(of_old - of_new, "")
    # Every byte is a character, so that whatever the deck holds stays.
    lines = _lines(Tokens(source.text.decode("latin-1")), edited)
    text = "\n".join(lines).encode("latin-1")
    return text if _says(text, changed) else None


def _keys_of(statements: Iterable[str]) -> set[Key]:
    """Keyword and number of statements that have both."""
    words = (each.split()[:2] for each in statements)
    return {(each[0], int(each[1])) for each in words if len(each) == 2 and each[1].isdigit()}


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


def _lines(tokens: Tokens, edited: dict[Key, str]) -> Iterable[str]:
    """The lines of a deck with statements in the place of others.

    Args:
        tokens: The deck.
        edited: The statements that change, empty where one is taken away.
    """
    left = dict(edited)
    kept: list[tuple[str, list[str]]] = []
    rest: list[str] = []
    lines = iter(tokens)
    for line in lines:
        if line.ends or line.block is Block.PICTURE:
            rest = [line.text, *(text for other in lines for text in _kept(other, left))]
            break
        key = key_of(line)
        if key is None or key not in edited:
            kept.append(("" if key is None else key[0], [line.text]))
        else:
            kept.append((key[0], list(_written(line, left.pop(key, "")))))
    new = grouped((keyword, each) for (keyword, _), each in left.items() if each)
    ending = "\r" if any(line.endswith("\r") for _, some in kept for line in some) else ""
    last = {keyword: place for place, (keyword, _) in enumerate(kept)}
    made: list[str] = []
    # New statements stand behind the last of their keyword.
    for place, (keyword, some) in enumerate(kept):
        made += some
        if keyword in new and last[keyword] == place:
            made += [statement + ending for statement in new.pop(keyword)]
    behind = [statement + ending for statements in new.values() for statement in statements]
    # Behind the last line there is nothing, or the end of the text.
    is_open = not rest and made and not made[-1]
    return [*made[:-1], *behind, ""] if is_open else [*made, *behind, *rest]


def _kept(line: Line, edited: dict[Key, str]) -> Iterator[str]:
    """A line behind the kinematics, unless its statement goes."""
    key = None if line.block is Block.PICTURE else key_of(line)
    if key is not None and edited.get(key) == "":
        yield from _written(line, "")
    else:
        yield line.text


def _written(line: Line, statement: str) -> Iterator[str]:
    """What stands in the place of a line; what it says besides stays as a comment."""
    body, comment = line.text[: line.mark], line.text[line.mark :]
    if statement:
        operands = statement.partition(" % ")[0].partition(" ")[2]
        gap = body[len(body.rstrip()) :]
        yield f"{body[: line.words[0].behind]} {operands}{gap}{comment}"
    elif comment.strip("%# \t\r"):
        yield comment
