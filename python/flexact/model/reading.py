# SPDX-License-Identifier: BSD-3-Clause
"""From a file or a text to a model; all that is wrong with it is a DeckError."""

from __future__ import annotations

import os
import re
import stat
import sys
from dataclasses import replace
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from ..core import calls
from ..deck.diagnostics import Diagnostic, Problems, Severity, Source, problems_of
from ..deck.rendering import DeckError
from ..util.decks import DeckFile
from ..util.loading import load
from ..util.units import METRES, MILLIMETRES
from .data import Appearance, DeckNames, Loads, ModelData, Properties, slips_in

if TYPE_CHECKING:
    from .model import Model

LARGEST_DECK = 2**31 - 2
_UTF8_MARK = b"\xef\xbb\xbf"
_UTF16_MARKS = (b"\xff\xfe", b"\xfe\xff")
_ALONE = rb"\r(?!\n)"
_SAMPLE, _HEAD = 65536, 64
_PIECE = 2**20
_CONTROLS = bytes(c for c in range(32) if chr(c) not in "\t\n\r\f\v\x1a") + b"\x7f"


def read_file(path: str | bytes | os.PathLike[str] | os.PathLike[bytes]) -> ModelData:
    """Read a deck from a file; see `flexact.read`."""
    name = os.fsdecode(path)
    return read_bytes(file_bytes(name), name)


def read_deck(deck: DeckFile) -> ModelData:
    """Read a deck that a command was given; as `read_file`."""
    return read_bytes(deck_bytes(deck), os.fsdecode(deck.path))


def deck_bytes(deck: DeckFile) -> bytes:
    """The text of a deck that a command was given.

    Raises:
        DeckError: its file cannot be read.
    """
    return file_bytes(deck.path) if deck.content is None else deck.content


def file_bytes(path: str) -> bytes:
    """The text of a deck as it stands in a file.

    Raises:
        DeckError: the file cannot be read.
    """
    try:
        is_windows = sys.platform == "win32"
        place = load("flexact.util.outputs").reachable(path) if is_windows else path
        status = os.stat(place)
        if stat.S_ISDIR(status.st_mode):
            raise _file_error(
                path, "is-a-folder", "this is a folder, not a deck", "name a deck in it"
            )
        if not stat.S_ISREG(status.st_mode):
            raise _file_error(
                path, "not-a-file", "this is not a regular file", "write the deck to a file first"
            )
        if status.st_size > LARGEST_DECK:
            raise _too_large(path)
        with open(place, "rb") as file:
            return _content(file, status.st_size)
    except FileNotFoundError:
        hint = "check its name and its folder"
        raise _file_error(path, "no-such-file", "there is no such file", hint) from None
    except (OSError, ValueError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        message = f"the file cannot be read: {reason}"
        hint = "check that you may read it"
        raise _file_error(path, "cannot-read", message, hint) from None
    except MemoryError:
        raise _file_error(path, "out-of-memory", "the file does not fit into memory") from None


def _content(file: BinaryIO, size: int) -> bytes:
    """All of a file, as much as a deck may hold; it may have grown, or not know its size."""
    raw = file.read(size + 1)
    if len(raw) <= size:
        return raw
    pieces, length = [raw], len(raw)
    while length <= LARGEST_DECK and (piece := file.read(_PIECE)):
        pieces.append(piece)
        length += len(piece)
    return b"".join(pieces)


def read_bytes(raw: bytes, name: str) -> ModelData:
    """Read a deck from the bytes of its text.

    Raises:
        DeckError: anything is wrong with the deck.
    """
    if raw.startswith(_UTF8_MARK):
        raw = raw[len(_UTF8_MARK) :]
    raw = raw.removesuffix(b"\x1a")
    if raw.count(b"\r") != raw.count(b"\r\n"):
        # Lines of an old Mac, which may stand among others; no character moves within its line.
        raw = re.sub(_ALONE, b"\n", raw)
    _require_text(raw, name)
    source = Source(raw, name)
    try:
        deck = calls.read_deck(raw)
    except MemoryError:
        raise _file_error(name, "out-of-memory", "the deck does not fit into memory") from None
    problems = problems_of(deck.problems, source)
    if problems.errors:
        raise DeckError(problems, name, source)
    # Numbers may stand where they mean nothing, and loads be zero.
    is_given = not all(np.isnan(part).all() for part in deck.properties.values())
    is_loaded = any(part.any() for part in deck.loads.values())
    made = ModelData(
        deck.arrays,
        deck.planar,
        name,
        DeckNames(raw, deck.name),
        DeckNames(raw, deck.node_name),
        source=source,
        found=problems,
        given_appearance=Appearance(**deck.appearance) if deck.appearance else None,
        properties=Properties(**deck.properties) if is_given else None,
        loads=Loads(**deck.loads) if is_loaded else None,
        has_long_numbers=deck.has_long_numbers,
        units=MILLIMETRES if deck.length_power else METRES,
    )
    slips = tuple(slips_in(made))
    return replace(made, found=problems.and_also(slips)) if slips else made


def _require_text(raw: bytes, name: str) -> None:
    if not raw:
        raise _file_error(
            name,
            "empty-deck",
            "the deck is empty",
            "state at least one element, such as TRUSS 1 1 2",
        )
    if len(raw) > LARGEST_DECK:
        raise _too_large(name)
    if raw.startswith(_UTF16_MARKS):
        raise _file_error(
            name, "not-text", "the deck is in UTF-16", "save it as UTF-8 or plain ASCII text"
        )
    if raw[:_HEAD].lstrip().startswith(b"ISO-10303-21"):
        raise _file_error(
            name,
            "step-file",
            "this is a STEP file and no deck",
            "flexact convert makes a deck of it, and flexact watch shows its mechanism",
        )
    sample = raw[:_SAMPLE]
    controls = len(sample) - len(sample.translate(None, _CONTROLS))
    if controls * 20 > len(sample) and controls > 4:
        raise _file_error(
            name, "not-text", "this is not text, so it cannot be a deck", "give a plain text file"
        )


def _too_large(name: str) -> DeckError:
    return _file_error(name, "too-large", "the deck is larger than two gigabytes")


def _file_error(name: str, code: str, message: str, hint: str = "") -> DeckError:
    item = Diagnostic(Severity.ERROR, code, message, help=hint)
    return DeckError(Problems.of([item]), name, None)


def _model(data: ModelData) -> Model:
    # A command that reads a deck needs nothing of what makes models.
    made: Model = load("flexact.model.model").Model.from_data(data)
    return made


def read(path: str | bytes | os.PathLike[str] | os.PathLike[bytes]) -> Model:
    """Read a deck from a file.

    Warnings and notes are kept in `Model.diagnostics`.

    Args:
        path: A regular file.

    Raises:
        DeckError: anything is wrong with the deck or the file.
        TypeError: `path` is no path.
    """
    return _model(read_file(path))


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
        return _model(read_bytes(text.encode("utf-8", "replace"), name))
    if isinstance(text, (bytes, bytearray, memoryview)):
        return _model(read_bytes(bytes(text), name))
    raise TypeError(f"the text of a deck must be text or bytes, not {type(text).__name__}")
