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
    INTERRUPTED = 130


class BatchError(FlexactError):
    """A deck could not be handled for a reason that is not in the deck itself."""


class NoDecksError(FlexactError):
    """A folder holds no deck."""


@dataclass(frozen=True)
class DeckFile:
    """One deck of a batch.

    Attributes:
        path: The path as a person would write it; also the deck's name in results.
        relative: Where its results go below the output folder, without a suffix: the deck's name,
            behind the subfolders that lie between it and the folder that was asked for.
        empty_folder: The path is a folder without decks.
    """

    path: str
    relative: Path
    empty_folder: bool = False


@dataclass(frozen=True)
class Outcome:
    """What came of one deck: its name, the exit code it asks for, and a word or a reason."""

    deck: str
    code: ExitCode
    result: str


def find_decks(arguments: Iterable[str]) -> tuple[DeckFile, ...]:
    """The decks that files and folders stand for, in the order of the arguments.

    A folder stands for every ``*.dat`` in it and below it, sorted by path; symbolic links to
    folders are not followed. A file is taken whatever its suffix, whether or not it exists, so
    that reading it gives the error with its reason.

    Raises:
        BatchError: A folder cannot be searched.
    """
    return tuple(deck for argument in arguments for deck in _expand(argument))


def _expand(argument: str) -> Iterator[DeckFile]:
    if not os.path.isdir(argument):
        yield DeckFile(argument, Path(Path(argument).stem or "deck"))
        return
    found = sorted(_walk(argument))
    for path in found:
        yield DeckFile(str(path), path.relative_to(argument).with_suffix(""))
    if not found:
        yield DeckFile(argument, Path(Path(argument).stem or "deck"), empty_folder=True)


def _walk(folder: str) -> Iterator[Path]:
    def refuse(error: OSError) -> None:
        raise BatchError(f"cannot search {error.filename}: {error.strerror}")

    for place, _, names in os.walk(folder, onerror=refuse):
        yield from (Path(place, name) for name in names if name.lower().endswith(SUFFIX))


def exit_code(outcomes: Iterable[Outcome]) -> ExitCode:
    """The exit code of a batch: the gravest of its decks, in the order 1, 2, 3, 0."""
    codes = {outcome.code for outcome in outcomes}
    for code in (ExitCode.OTHER, ExitCode.DECK_ERROR, ExitCode.DIFFERENT):
        if code in codes:
            return code
    return ExitCode.ANALYSED
