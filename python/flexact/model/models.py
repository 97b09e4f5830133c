# SPDX-License-Identifier: BSD-3-Clause
"""Decks as models to work with."""

from __future__ import annotations

import os

from .model import Model
from .reading import read_bytes, read_file


def read(path: str | bytes | os.PathLike[str] | os.PathLike[bytes]) -> Model:
    """Read a deck from a file.

    Warnings and notes are kept in `Model.diagnostics`.

    Args:
        path: A regular file.

    Raises:
        DeckError: anything is wrong with the deck or the file.
        TypeError: `path` is no path.
    """
    return Model.from_data(read_file(path))


def read_text(text: str | bytes, name: str = "deck") -> Model:
    """Read a deck from its text.

    Args:
        text: The deck.
        name: What it is called in results and problems.

    Raises:
        DeckError: anything is wrong with the deck.
        TypeError: the text or the name is none.
    """
    if not isinstance(name, str):
        raise TypeError(f"the name of a deck must be text, not {type(name).__name__}")
    if isinstance(text, str):
        return Model.from_data(read_bytes(text.encode("utf-8", "replace"), name))
    if isinstance(text, (bytes, bytearray, memoryview)):
        return Model.from_data(read_bytes(bytes(text), name))
    raise TypeError(f"the text of a deck must be text or bytes, not {type(text).__name__}")
