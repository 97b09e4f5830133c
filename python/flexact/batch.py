"""Which decks a command means, and what came of each."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path

from .diagnostics import FlexactError

SUFFIX = ".dat"


class ExitCode(IntEnum):
    """What a command tells the shell."""

    ANALYSED = 0
    OTHER = 1
    DECK_ERROR = 2
    DIFFERENT = 3


class BatchError(FlexactError):
    """A deck could not be handled for a reason that is not in the deck itself."""


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
    """

    path: str
    relative: Path
    error: FolderError | None = None

    @property
    def name(self) -> str:
        """The path as text that can be encoded: the deck's name in results."""
        return self.path.encode("utf-8", "backslashreplace").decode("utf-8")


@dataclass(frozen=True)
class Outcome:
    """What came of one deck.

    Attributes:
        deck: Its name.
        code: The exit code that it asks for.
        result: A word or two, counted over the batch.
        remark: Why it wants attention; empty where the code says enough.
    """

    deck: str
    code: ExitCode
    result: str
    remark: str = ""


def find_decks(arguments: Iterable[str]) -> tuple[DeckFile, ...]:
    """The decks that files and folders stand for, in the order of the arguments, each once.

    A folder stands for every ``*.dat`` in it and below it, sorted by path; symbolic links to
    folders are not followed. A folder that cannot be searched, or holds no deck, is among them
    with its error. A file is taken whatever its suffix, whether or not it exists, so that reading
    it gives the error with its reason.
    """
    decks: dict[str, DeckFile] = {}
    for argument in arguments:
        for deck in _expand(argument):
            decks.setdefault(_place(deck.path), deck)
    return tuple(decks.values())


def _place(path: str) -> str:
    """What is the same for different spellings of a path; a link to a deck is another deck."""
    folder, name = os.path.split(path)
    try:
        return os.path.join(os.path.realpath(folder), name)
    except (OSError, ValueError):
        return path


def _expand(argument: str) -> Iterator[DeckFile]:
    whole = Path(Path(argument).stem or "deck")
    if not os.path.isdir(argument):
        yield DeckFile(argument, whole)
        return
    errors: list[OSError] = []
    decks = [
        DeckFile(str(path), path.relative_to(argument).with_suffix(""))
        for path in _walk(argument, errors)
    ]
    decks += [DeckFile(str(error.filename), whole, _not_searched(error)) for error in errors]
    yield from sorted(decks, key=lambda deck: Path(deck.path))
    if not decks:
        message = f"{argument}: no deck (*{SUFFIX}) in this folder or below it"
        yield DeckFile(argument, whole, FolderError(message, "no-decks", "no decks"))


def _walk(folder: str, errors: list[OSError]) -> Iterator[Path]:
    for place, _, names in os.walk(folder, onerror=errors.append):
        yield from (Path(place, name) for name in names if name.lower().endswith(SUFFIX))


def _not_searched(error: OSError) -> FolderError:
    message = f"{error.filename}: this folder cannot be searched: {reason_of(error)}"
    return FolderError(message, "cannot-read", "cannot be read")


def reason_of(error: OSError) -> str:
    """What the system says, to stand within a sentence."""
    return error.strerror.lower() if error.strerror else str(error)


def exit_code(outcomes: Iterable[Outcome]) -> ExitCode:
    """The exit code of a batch: the gravest of its decks, in the order 1, 2, 3, 0."""
    codes = {outcome.code for outcome in outcomes}
    for code in (ExitCode.OTHER, ExitCode.DECK_ERROR, ExitCode.DIFFERENT):
        if code in codes:
            return code
    return ExitCode.ANALYSED
