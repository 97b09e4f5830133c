# SPDX-License-Identifier: BSD-3-Clause
"""What ``-o`` may name: a folder that does not look like a file, a deck, or stdout."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Callable
from pathlib import Path

from ...util.decks import SUFFIX, DeckFile
from ...util.interruption import unwinding
from ...util.outputs import STDOUT, OutputError, plan_file, write_together
from .terminal import put

#: Suffixes of decks besides that of the deck that was read.
DECKS = (SUFFIX, ".txt", ".inp", ".deck", "")
#: What the end of a file's name looks like.
_FILE = re.compile(r"\.[A-Za-z][A-Za-z0-9]{0,6}")
#: What writes files of such suffixes, to be named where a folder was wanted.
_MAKERS = {
    **dict.fromkeys((".html", ".htm"), "a page is made by flexact report"),
    **dict.fromkeys(
        (".png", ".svg", ".gif", ".pdf", ".mp4", ".webm"), "a picture is made by flexact picture"
    ),
    **dict.fromkeys((".csv", ".jsonl", ".parquet"), "a table is made by flexact batch"),
    **dict.fromkeys((".vtu", ".vtp", ".vtk", ".xdmf", ".pvd"), "a mesh is made by flexact export"),
    ".json": "for JSON on standard output say --json of flexact analyse",
    SUFFIX: "a deck is made by flexact advise --apply, declare or convert",
}


def folder(text: str) -> Path:
    """A folder, as an option's type; see `folder_or`."""
    return folder_or()(text)


def folder_or(*files: str) -> Callable[[str], Path]:
    """An option's type: a folder, or a file of one of these suffixes.

    A name that looks like a file's is none of a folder, unless there is such a folder already, or
    it ends with a slash.
    """

    def checked(text: str) -> Path:
        path = Path(text)
        if path == STDOUT:
            raise argparse.ArgumentTypeError(f"{_wanted(files)}, and - is standard output")
        suffix = path.suffix
        if suffix.lower() in files or not _FILE.fullmatch(suffix) or _is_folder(text):
            return path
        maker = _MAKERS.get(suffix.lower())
        raise argparse.ArgumentTypeError(
            f"{text} looks like a file, and {_wanted(files)}"
            f"{f'; {maker}' if maker else ''}; for a folder of this name write {text}/"
        )

    return checked


def _is_folder(text: str) -> bool:
    ends = text.endswith(os.sep) or bool(os.altsep and text.endswith(os.altsep))
    try:
        return ends or os.path.isdir(text)
    except ValueError:
        return False


def _wanted(files: tuple[str, ...]) -> str:
    return f"a file {' or '.join(files)}, or a folder is wanted" if files else "a folder is wanted"


def file(text: str) -> Path:
    """A file that cannot be stdout, as an option's type."""
    if Path(text) == STDOUT:
        raise argparse.ArgumentTypeError("a file is wanted, and - is standard output")
    return Path(text)


def plan_deck(deck: DeckFile, target: Path) -> None:
    """Find out whether a deck may be written to a file, or to stdout.

    Raises:
        OutputError: It may not.
    """
    if target == STDOUT:
        return
    suffix = target.suffix.lower()
    if suffix not in DECKS and suffix != Path(deck.path).suffix.lower() and _FILE.fullmatch(suffix):
        raise OutputError(f"{target} is no name of a deck: it ends with {SUFFIX}")
    plan_file(deck, target)


def plan_text(deck: DeckFile, target: Path) -> None:
    """As `plan_file`, of a file that may be stdout."""
    if target != STDOUT:
        plan_file(deck, target)


def write_text(target: Path, content: bytes) -> None:
    """Write a file of text, or to stdout what would stand in it.

    Raises:
        OutputError: The file cannot be written.
    """
    if target == STDOUT:
        put(content)
    else:
        with unwinding():
            write_together({target: content})
