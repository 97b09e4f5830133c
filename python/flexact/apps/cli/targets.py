# SPDX-License-Identifier: BSD-3-Clause
"""What ``-o`` may name: a folder that does not look like a file, a deck, or stdout."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from ...deck.rendering import ModelError, ProblemsError
from ...show.writers import PAGES, PICTURES, PLAYING, SOLIDS, TABLES, as_bytes
from ...util.decks import SUFFIX, DeckFile, find_decks
from ...util.errors import BatchError, FlexactError
from ...util.interruption import unwinding
from ...util.loading import load
from ...util.outputs import (
    STDOUT,
    OutputError,
    plan_file,
    plan_files,
    require_replaceable,
    write_together,
)
from ...util.text import harmless
from .parser import Argument, Group, argument
from .terminal import complain, give, put, say

#: Suffixes of decks besides that of the deck that was read.
DECKS = (SUFFIX, ".txt", ".inp", ".deck", "")
#: What the end of a file's name looks like.
_FILE = r"\.[A-Za-z][A-Za-z0-9]{0,6}"
#: What writes files of such suffixes, to be named where a folder was wanted.
_MAKERS = {
    **dict.fromkeys(PAGES, "a page is made by flexact report"),
    **dict.fromkeys(PICTURES, "a picture is made by flexact picture"),
    **dict.fromkeys(TABLES, "a table is made by flexact batch"),
    **dict.fromkeys((".vtu", ".vtp", ".vtk", ".xdmf", PLAYING), "a mesh is made by flexact export"),
    **dict.fromkeys(SOLIDS, "solids are made by flexact export"),
    ".json": "for JSON on standard output say --json of flexact analyse",
    SUFFIX: "a deck is made by flexact advise --apply, declare or convert",
}


def folder_or(*files: str) -> Callable[[str], Path]:
    """An option's type: a folder, or a file of one of these suffixes.

    A name that looks like a file's is none of a folder, unless there is such a folder already, or
    it ends with a slash.
    """
    wanted = (
        f"a file {' or '.join(files)}, or a folder is wanted" if files else "a folder is wanted"
    )

    def checked(text: str) -> Path:
        path = Path(text)
        if path == STDOUT:
            raise argparse.ArgumentTypeError(f"{wanted}, and - is standard output")
        suffix = path.suffix
        if suffix.lower() in files or not re.fullmatch(_FILE, suffix) or _is_folder(text):
            return path
        maker = _MAKERS.get(suffix.lower())
        raise argparse.ArgumentTypeError(
            f"{text} looks like a file, and {wanted}"
            f"{f'; {maker}' if maker else ''}; for a folder of this name write {text}/"
        )

    return checked


#: A folder, as an option's type.
folder = folder_or()


def _is_folder(text: str) -> bool:
    ends = text.endswith(os.sep) or bool(os.altsep and text.endswith(os.altsep))
    try:
        return ends or os.path.isdir(text)
    except ValueError:
        return False


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
    if (
        suffix not in DECKS
        and suffix != Path(deck.path).suffix.lower()
        and re.fullmatch(_FILE, suffix)
    ):
        raise OutputError(f"{target} is no name of a deck: it ends with {SUFFIX}")
    plan_file(deck, target)


def plan_shown(deck: DeckFile, target: Path, endings: Sequence[str]) -> None:
    """As `plan_file`, with the files of a cycle that plays beside it.

    Raises:
        OutputError: One of them may not be written.
    """
    plan_file(deck, target)
    if target.suffix.lower() == PLAYING:
        collection = load("flexact.show.mesh.collection")
        steps = replace(deck, relative=Path(collection.STEM))
        plan_files([steps], collection.folder_of(target), endings)


def plan_table(table: Path, decks: Sequence[DeckFile]) -> None:
    """Raise where the table would overwrite a deck, or has no place.

    Raises:
        OutputError: It does.
    """
    plan_file(DeckFile("the table", Path()), table)
    require_replaceable(table)
    for deck in decks:
        if deck.path.endswith(table.suffix) and os.path.realpath(deck.path) == os.path.realpath(
            table
        ):
            raise OutputError(f"{table} would overwrite the deck {deck.path}")


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


#: Those of `flexact.show.mesh.file`, which takes a while to load.
FORMATS = ("vtu", "vtk", "xdmf")


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


def outputs_of(
    deck: DeckFile, chosen: argparse.Namespace, require: Callable[[Path], object]
) -> list[Path]:
    """The files that -o names, each of which may be written; - is none of them.

    Args:
        deck: The deck, which is not overwritten.
        chosen: The options of a verb that has --json and any number of -o.
        require: Raises for a file of no known kind.

    Raises:
        BatchError: --json and - are both given.
        OutputError: A file cannot be written.
    """
    if STDOUT in chosen.output and chosen.json:
        raise BatchError("--json and -o - both go to standard output: choose one")
    files = [target for target in chosen.output if target != STDOUT]
    for target in files:
        plan_file(deck, target)
        with unwinding():
            require(target)
    return files


@contextmanager
def asked_in_a_line() -> Iterator[None]:
    """Say in a line what was asked for and is not there; of a deck with errors all of them."""
    try:
        yield
    except BatchError:
        raise
    except ModelError as error:
        told = (f"{e.message}{f'; {e.help}' if e.help else ''}" for e in error.diagnostics)
        raise BatchError("\n".join(told)) from None
    except ProblemsError:
        raise
    except FlexactError as error:
        raise BatchError(str(error)) from error


def give_answer(
    deck: DeckFile,
    chosen: argparse.Namespace,
    files: Sequence[Path],
    *,
    table: Callable[[], str],
    data: Callable[[], str],
    words: Callable[[], str],
) -> None:
    """Give what was made on standard output as was asked for, and say which files were written."""
    is_data = chosen.json or STDOUT in chosen.output
    if chosen.json:
        give(data())
    elif is_data:
        put(as_bytes(table()))
    else:
        say(words())
    for target in files:
        text = f"{harmless(deck.name)}: written to {harmless(str(target))}"
        complain(text) if is_data else say(text)
