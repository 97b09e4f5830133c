# SPDX-License-Identifier: BSD-3-Clause
"""What is written of each deck: result, log, mesh and page; it loads what makes them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from ...analysis.json import text_of
from ...analysis.result import Result
from ...deck.rendering import ProblemsError
from ...show.mesh import Meshes
from ...show.mesh.file import find_format, mesh_bytes
from ...show.page import Entry, broken_entry, broken_page, entry_of, unread_entry, with_way_back
from ...show.saving import page_bytes, small_picture
from ...show.spacar_log import log_text, spacar_log
from ...show.writers import as_bytes
from ...util.decks import DeckFile
from ...util.interruption import unwinding
from ...util.outputs import plan_files, write_together
from . import decks as failures
from .decks import foreseen

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
