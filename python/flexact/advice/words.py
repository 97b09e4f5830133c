# SPDX-License-Identifier: BSD-3-Clause
"""Sentences and rows of pieces: what all words of the advice are put together with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..analysis.naming import Named, Piece, Pieces, plain


def begun(pieces: Pieces) -> Pieces:
    """The pieces with a capital first letter, as a sentence begins."""
    for place, piece in enumerate(pieces):
        if words := str(piece):
            capital: Piece = words[:1].upper() + words[1:]
            if isinstance(piece, Named):
                capital = piece._replace(words=str(capital))
            return (*pieces[:place], capital, *pieces[place + 1 :])
    return pieces


def ended(pieces: Pieces) -> Pieces:
    """The pieces with a full stop at their end, in place of the mark that is there."""
    if not pieces:
        return pieces
    last = pieces[-1]
    if isinstance(last, Named):
        return (*pieces, ".")
    return (*pieces[:-1], last.rstrip(" .:;") + ".")


def sentence(pieces: Pieces) -> Pieces:
    """The pieces from a capital letter to a full stop; nothing where there are no words."""
    return ended(begun(pieces)) if plain(pieces).strip() else ()


def in_a_row(sentences: Iterable[Pieces]) -> str:
    """Sentences behind each other, as text."""
    return " ".join(filter(None, map(plain, sentences)))


def row_of(items: Sequence[Pieces], most: int | None = None) -> Pieces:
    """Items such as "a, b and c"; of more than `most` the first, and how many more there are."""
    shown = list(items[:most])
    if len(items) > len(shown):
        shown.append((f"{len(items) - len(shown)} more",))
    made: list[Piece] = []
    for k, item in enumerate(shown):
        made += [""] if not k else [" and "] if k == len(shown) - 1 else [", "]
        made += item
    return tuple(piece for piece in made if piece)
