# SPDX-License-Identifier: BSD-3-Clause
"""What ``-o`` may name: a folder that does not look like a file, a deck, or stdout."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from ...analysis.json import text_of
from ...analysis.result import Result
from ...deck.rendering import ProblemsError
from ...show.mesh import Meshes
from ...show.mesh.collection import MESHES
from ...show.mesh.file import FORMATS as MESH_FORMATS
from ...show.mesh.file import find_format, mesh_bytes
from ...show.page import Entry, broken_entry, broken_page, entry_of, unread_entry, with_way_back
from ...show.saving import page_bytes, small_picture
from ...show.spacar_log import log_text, spacar_log
from ...show.writers import PAGES, PICTURES, TABLES, as_bytes
from ...util.decks import SUFFIX, DeckFile, find_decks
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.outputs import STDOUT, OutputError, plan_file, plan_files, write_together
from . import decks as failures
from .decks import foreseen
from .parser import Argument, Group, argument
from .terminal import put

#: Suffixes of decks besides that of the deck that was read.
DECKS = (SUFFIX, ".txt", ".inp", ".deck", "")
#: What the end of a file's name looks like.
_FILE = re.compile(r"\.[A-Za-z][A-Za-z0-9]{0,6}")
#: What writes files of such suffixes, to be named where a folder was wanted.
_MAKERS = {
    **dict.fromkeys(PAGES, "a page is made by flexact report"),
    **dict.fromkeys(PICTURES, "a picture is made by flexact picture"),
    **dict.fromkeys(TABLES, "a table is made by flexact batch"),
    **dict.fromkeys(MESHES.suffixes, "a mesh is made by flexact export"),
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


#: Those of `mesh.file`, which takes a while to load.
FORMATS = tuple(MESH_FORMATS)


def mesh_argument(target: str) -> Argument:
    """The format of the meshes in the folder that the option `target` names."""
    return argument(
        "--mesh",
        metavar="FORMAT",
        help=f"format of the meshes of {target}: {', '.join(FORMATS)} (default {FORMATS[0]})",
    )


def deck_arguments(words: str, kind: Callable[[str], Path] = file) -> tuple[Argument, ...]:
    """The one deck of a verb, and the file made of it, which `words` describe."""
    output = argument("-o", "--output", type=kind, metavar="FILE", required=True, help=words)
    return DECK, output


def number(text: str) -> int:
    """A whole number from 1, as an option's type."""
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"a whole number from 1 is wanted, not {text!r}")
    return value


def address(text: str) -> str:
    """Where a scheduler is, as an option's type."""
    if not re.fullmatch(r"[a-z]+://\S+:\d+", text):
        raise argparse.ArgumentTypeError(f"tcp://host:port of a scheduler is wanted, not {text!r}")
    return text


def number_or_name(text: str) -> int | str:
    """A whole number from 1, or a name, as an option's type."""
    return number(text) if text.strip().lstrip("+-").isdecimal() or not text.strip() else text


DECK = argument("deck", metavar="DECK", help="a deck, or - for stdin")
NO_BROWSER = argument("--no-browser", action="store_true", help="open no browser")
#: The choice of the motion; numbers count from 1.
SHOWN_MOTION = Group(
    "",
    (
        argument(
            "--motion", type=number, metavar="K", help="show motion K (default: the first, if any)"
        ),
        argument(
            "--freedom",
            type=number_or_name,
            metavar="K",
            help="show declared degree of freedom K, or that of a name, such as 'stage y'",
        ),
    ),
)
#: Who does the work on many decks.
WORKERS = Group(
    "who does the work",
    (
        Group(
            "",
            (
                argument(
                    *("-j", "--workers"),
                    type=number,
                    metavar="N",
                    help="processes (default: one a processor)",
                ),
                argument(
                    "--dask",
                    type=address,
                    metavar="ADDRESS",
                    help="work on a Dask cluster: tcp://host:port of its scheduler",
                ),
            ),
        ),
    ),
)


def one_deck(chosen: argparse.Namespace) -> DeckFile:
    """The deck that is meant.

    Raises:
        BatchError: A folder with several decks is meant.
    """
    decks = find_decks([chosen.deck])
    if len(decks) > 1:
        raise BatchError(f"{chosen.deck} holds {len(decks)} decks; this takes one at a time")
    return decks[0]


#: What the index takes the place of among the decks.
INDEX = DeckFile("the index", Path("index"))
WITHOUT_PICTURES = (
    "without the packages matplotlib and pillow there are no still pictures, for browsers without "
    "WebGL and in the index: pip install matplotlib pillow"
)


class DeckPage(NamedTuple):
    """A page, and its place in the index."""

    content: bytes
    entry: Entry


def page_of(result: Result, place: str, *, indexed: bool) -> DeckPage:
    """The page of a result, whose path beside the index is `place` but for its suffix.

    Args:
        result: The result.
        place: The path.
        indexed: Whether there is an index, which has a picture of each page.
    """
    with unwinding():
        content = page_bytes(result, place if indexed else None)
    with unwinding():
        picture = small_picture(result) if indexed else None
    return DeckPage(content, entry_of(result, place, f"{place}.html", picture))


def broken_page_of(
    error: Exception, name: str, place: str, *, indexed: bool = True
) -> DeckPage | None:
    """The page of a deck with errors; None where its file could not be read."""
    if isinstance(error, ProblemsError):
        codes = {item.code for item in error.diagnostics}
        if codes & failures.NOT_READ:
            return None
    made = broken_page(error, name)
    if indexed:
        made = with_way_back(made, place)
    return DeckPage(as_bytes(made), broken_entry(error, place, f"{place}.html", name))


def unread(place: str) -> Entry:
    """What the index says of a deck that could not be read."""
    return unread_entry(place)


class ResultFiles:
    """Where each deck's results go, found before anything is computed.

    Raises:
        OutputError: Two decks would write one file, or the folder cannot take files.
        MeshFormatError: There is no such mesh format.
    """

    def __init__(
        self, decks: Sequence[DeckFile], folder: Path, mesh_format: str, log: str | None = None
    ) -> None:
        """Plan the files of all decks; `log` is the form of the logs, None that of Flexact."""
        self._log = log
        with unwinding():
            self.format = find_format(mesh_format)
        self.plan = plan_files(decks, folder, (".json", ".log", f".{self.format}"))

    def write(self, deck: DeckFile, result: Result) -> Exception | None:
        """Write the results, or say why not: that is no reason to keep the verdict back."""
        try:
            contents = contents_of(result, self.format, self._log)
            with unwinding():
                write_together(dict(zip(self.plan[deck.path], contents, strict=True)))
        except Exception as error:
            return foreseen(error)
        return None


def contents_of(result: Result, mesh_format: str, log: str | None = None) -> tuple[bytes, ...]:
    """What stands in the files of a result, in the order of the plan.

    `log` is the form of the log, None that of Flexact.

    Raises:
        OutputError: The mesh cannot be written.
        MemoryError: There is not enough memory.
    """
    json = f"{text_of(result)}\n".encode()
    meshes = Meshes(result)
    words = spacar_log(result) if log else log_text(result, most_in_mesh=meshes.most_modes)
    mesh = meshes.still()
    with unwinding():
        return json, words.encode("utf-8", "backslashreplace"), mesh_bytes(mesh, mesh_format)
