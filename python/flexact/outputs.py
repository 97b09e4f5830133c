"""Files of results, each set of them written whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from .batch import BatchError, DeckFile


class OutputError(BatchError):
    """A file of results cannot be written."""


def plan_files(
    decks: Sequence[DeckFile], folder: Path, suffixes: Sequence[str]
) -> dict[str, tuple[Path, ...]]:
    """The files that each deck's results go to, found before anything is computed.

    Args:
        decks: The decks of the batch.
        folder: The output folder.
        suffixes: One suffix a file, with its dot.

    Returns:
        The files of each deck, by the deck's path, in the order of ``suffixes``.

    Raises:
        OutputError: Two decks would write one file, a deck would be overwritten, or the folder
            cannot take files.
    """
    _check_folder(folder)
    owner: dict[Path, str] = {}
    plan = {}
    sources = {os.path.realpath(deck.path): deck.path for deck in decks}
    for deck in decks:
        stem = folder / deck.relative
        targets = tuple(stem.with_name(stem.name + suffix) for suffix in suffixes)
        for target in targets:
            if target in owner:
                raise OutputError(
                    f"{owner[target]} and {deck.path} would both write {target}; analyse them "
                    "apart, or name one folder that holds both"
                )
            if (source := sources.get(os.path.realpath(target))) is not None:
                raise OutputError(f"{target} would overwrite the deck {source}")
            owner[target] = deck.path
        plan[deck.path] = targets
    return plan


def _check_folder(folder: Path) -> None:
    place = folder.absolute()
    while not os.path.lexists(place) and place != place.parent:
        place = place.parent
    if not place.is_dir():
        raise OutputError(f"cannot write to {folder}: {place} is not a folder")
    if not os.access(place, os.W_OK | os.X_OK):
        raise OutputError(f"cannot write to {folder}: no permission to write in {place}")


def write_together(files: Mapping[Path, bytes]) -> None:
    """Write a set of files so that they appear together or not at all.

    Everything is written beside its place first, and moved there when all of it is written.
    Folders are made where they are missing.

    Raises:
        OutputError: A folder or file cannot be written; no file of the set has changed then.
    """
    waiting: dict[Path, Path] = {}
    target = Path()
    try:
        for target in files:
            if target.is_dir():
                raise OutputError(f"cannot write {target}: it is a folder")
        for number, (target, content) in enumerate(files.items()):
            target.parent.mkdir(parents=True, exist_ok=True)
            temporary = target.with_name(f".flexact-{os.getpid()}-{number}.tmp")
            waiting[temporary] = target
            temporary.write_bytes(content)
        for temporary, target in waiting.items():
            os.replace(temporary, target)
    except OSError as error:
        raise OutputError(f"cannot write {target}: {error.strerror or error}") from error
    finally:
        for temporary in waiting:
            temporary.unlink(missing_ok=True)
