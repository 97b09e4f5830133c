# SPDX-License-Identifier: BSD-3-Clause
"""How the sentences of advice begin and end, whoever has made their pieces."""

from __future__ import annotations

from collections.abc import Iterable

from ..analysis.sentences import Named, Piece, Pieces, plain


def begun(pieces: Pieces) -> Pieces:
    """The pieces with a capital first letter, as a sentence begins."""
    for place, piece in enumerate(pieces):
        if str(piece):
            return (*pieces[:place], _capital(piece), *pieces[place + 1 :])
    return pieces


def ended(pieces: Pieces, mark: str = ".") -> Pieces:
    """The pieces with a mark at their end, in place of the one that is there."""
    if not pieces:
        return pieces
    last = pieces[-1]
    if isinstance(last, Named):
        return (*pieces, mark)
    return (*pieces[:-1], last.rstrip(" .:;") + mark)


def sentence(pieces: Pieces) -> Pieces:
    """The pieces from a capital letter to a full stop; nothing where there are no words."""
    return ended(begun(pieces)) if plain(pieces).strip() else ()


def in_a_row(sentences: Iterable[Pieces]) -> str:
    """Sentences behind each other, as text."""
    return " ".join(words for words in map(plain, sentences) if words)


def _capital(piece: Piece) -> Piece:
    words = str(piece)
    first = words[:1].upper() + words[1:]
    return piece._replace(words=first) if isinstance(piece, Named) else first
