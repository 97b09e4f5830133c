# SPDX-License-Identifier: BSD-3-Clause
"""How the sentences of advice begin and end, whoever has made their pieces."""

from __future__ import annotations

from ..sentences import Named, Piece, Pieces, plain


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


def sentences(*all_pieces: Pieces) -> Pieces:
    """Sentences behind each other; those without words are left out."""
    made = [ended(begun(pieces)) for pieces in all_pieces if plain(pieces).strip()]
    return tuple(
        piece
        for place, pieces in enumerate(made)
        for piece in ((" ", *pieces) if place else pieces)
    )


def _capital(piece: Piece) -> Piece:
    words = str(piece)
    first = words[:1].upper() + words[1:]
    return piece._replace(words=first) if isinstance(piece, Named) else first
