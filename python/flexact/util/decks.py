# SPDX-License-Identifier: BSD-3-Clause
"""Which decks a command means, and what came of each."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from .errors import FlexactError, reason_of

SUFFIX = ".dat"
#: What stands for a deck on standard input, and what that deck is called.
STDIN, STDIN_NAME = "-", "<stdin>"
#: What cells of spreadsheets begin with that are run.
_FORMULAS = ("=", "+", "-", "@", "\t", "\r")
#: A deck is smaller; whether it is is said where it is read.
_MOST_BYTES = 2**31


class FolderError(FlexactError):
    """A folder gives no decks.

    Attributes:
        code: Short name of the reason, as diagnostics have one.
        remark: The same in a few words.
    """

    def __init__(self, message: str, code: str, remark: str) -> None:
        """A folder's failure."""
        super().__init__(message)
        self.code = code
        self.remark = remark


@dataclass(frozen=True)
class DeckFile:
    """One deck of a batch, or a folder that gives none.

    Attributes:
        path: The path as a person would write it.
        relative: Where its results go below the output folder, without a suffix: the deck's name,
            behind the subfolders that lie between it and the folder that was asked for.
        error: Why the path, a folder, gives no decks.
        content: The text of a deck that came by standard input; None of one in a file.
    """

    path: str
    relative: Path
    error: FolderError | None = None
    content: bytes | None = field(default=None, repr=False)

    @property
    def name(self) -> str:
        """The path as text that can be encoded: the deck's name in results."""
        return no_formula(self.path.encode("utf-8", "backslashreplace").decode("utf-8"))


def no_formula(path: str) -> str:
    """A path, or words that begin with one, which no spreadsheet takes for a formula."""
    return f"./{path}" if path.startswith(_FORMULAS) else path


def find_decks(arguments: Iterable[str]) -> tuple[DeckFile, ...]:
    """The decks that files and folders stand for, in the order of the arguments, each once.

    A folder stands for every ``*.dat`` in it and below it, sorted by path; symbolic links to
    folders are not followed. A folder that cannot be searched, or holds no deck, is among them
    with its error. A file is taken whatever its suffix, whether or not it exists, so that reading
    it gives the error with its reason. ``-`` stands for the deck on standard input.
    """
    decks: dict[str, DeckFile] = {}
    place_of = cache(_place)
    for argument in dict.fromkeys(arguments):
        for deck in _expand(argument):
            folder, name = os.path.split(deck.path)
            decks.setdefault(os.path.join(place_of(folder), name), deck)
    return tuple(decks.values())


def _place(folder: str) -> str:
    """What is the same for different spellings of a folder; a link to a deck is another deck."""
    try:
        return os.path.realpath(folder)
    except (OSError, ValueError):
        return folder


def _expand(argument: str) -> Iterator[DeckFile]:
    if argument == STDIN:
        yield _from_stdin()
        return
    whole = Path(Path(argument).stem or "deck")
    if not os.path.isdir(argument):
        yield DeckFile(argument, whole)
        return
    errors: list[OSError] = []
    found = list(_walk(argument, errors))
    decks = [deck for _, deck in sorted(found, key=lambda each: each[0])]
    decks += [DeckFile(str(error.filename), whole, _not_searched(error)) for error in errors]
    if errors:
        decks.sort(key=lambda deck: Path(deck.path))
    yield from decks
    if not decks:
        message = f"{argument}: no deck (*{SUFFIX}) in this folder or below it"
        yield DeckFile(argument, whole, FolderError(message, "no-decks", "no decks"))


def _from_stdin() -> DeckFile:
    name, whole = STDIN_NAME, Path("stdin")
    try:
        if sys.stdin is None:
            raise OSError("standard input is closed")
        return DeckFile(name, whole, content=sys.stdin.buffer.read(_MOST_BYTES))
    except (OSError, ValueError) as error:
        why = reason_of(error) if isinstance(error, OSError) else "standard input is closed"
        message = f"{name}: this deck cannot be read: {why}"
        return DeckFile(name, whole, FolderError(message, "cannot-read", "cannot be read"))


def _walk(folder: str, errors: list[OSError]) -> Iterator[tuple[tuple[str, ...], DeckFile]]:
    """The decks in a folder and below it, each with the parts of its path."""
    for place, _, names in os.walk(folder, onerror=errors.append):
        here = Path(place)
        below, parts = here.relative_to(folder), here.parts
        for name in names:
            if name.lower().endswith(SUFFIX):
                stem = name[: -len(SUFFIX)] or name
                yield (*parts, name), DeckFile(str(here / name), below / stem)


def _not_searched(error: OSError) -> FolderError:
    message = f"{error.filename}: this folder cannot be searched: {reason_of(error)}"
    return FolderError(message, "cannot-read", "cannot be read")
