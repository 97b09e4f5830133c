# SPDX-License-Identifier: BSD-3-Clause
"""Where the files and the pages of a batch go, and whether they are there."""

from __future__ import annotations

import base64
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...util.decks import DeckFile
from ...util.loading import load
from ...util.outputs import plan_files, write_together, written_whole
from .batch_work import Answer
from .terminal import complain

if TYPE_CHECKING:
    from ...show.page import Entry


class Outputs:
    """The files and pages that are asked for beside the table.

    Raises:
        OutputError: Two decks would write one file, or a folder cannot take files.
        MeshFormatError: There is no such mesh format.
    """

    def __init__(
        self, decks: Sequence[DeckFile], files: Path | None, mesh_format: str, report: Path | None
    ) -> None:
        """Plan the files of all decks.

        Args:
            decks: The decks.
            files: The folder of JSON, logs and meshes, if they are wanted.
            mesh_format: Of the meshes.
            report: The folder of pages, if they are wanted.
        """
        self.mesh_format = ""
        self._files: dict[str, tuple[Path, ...]] = {}
        self._pages: dict[str, tuple[Path, ...]] = {}
        self._index: Path | None = None
        if files is not None:
            made = load("flexact.apps.cli.result_files").ResultFiles(decks, files, mesh_format)
            self.mesh_format, self._files = made.format, made.plan
        if report is not None:
            # Processes that are forked have it then.
            pages = load("flexact.apps.cli.pages")
            self._pages = plan_files((*decks, pages.INDEX), report, (".html",))
            self._index = self._pages[pages.INDEX.path][0]
            if not load("flexact.show.picture").has_packages():
                complain(pages.WITHOUT_PICTURES)

    @property
    def has_pages(self) -> bool:
        """Whether pages are wanted."""
        return self._index is not None

    def put(self, deck: DeckFile, answer: Answer) -> dict[str, Any]:
        """Write what was made of a deck.

        Returns:
            What is to be remembered of it: sizes, and the entry of the index.

        Raises:
            OutputError: A file cannot be written.
        """
        contents = [*answer.files, *([answer.page] if answer.page else [])]
        targets = self._targets(deck, bool(answer.files), bool(answer.page))
        if contents:
            write_together(dict(zip(targets, contents, strict=True)))
        record: dict[str, Any] = {}
        if answer.files:
            record["files"] = [len(content) for content in answer.files]
        if answer.page:
            record["page"] = [len(answer.page)]
        if answer.entry is not None:
            record["entry"] = _packed(answer.entry)
        return record

    def _targets(self, deck: DeckFile, has_files: bool, has_page: bool) -> list[Path]:
        """Where files and page of a deck go, those that are made."""
        files = self._files[deck.path] if has_files else ()
        return [*files, *(self._pages[deck.path] if has_page else ())]

    def are_there(self, deck: DeckFile, record: dict[str, Any]) -> bool:
        """Whether what was written of a deck is as it was remembered."""
        files, page = record.get("files", []), record.get("page", [])
        if not isinstance(files, list) or not isinstance(page, list):
            return False
        if "entry" in record and not _is_entry(record["entry"]):
            return False
        try:
            targets = self._targets(deck, bool(files), bool(page))
            return [os.stat(path).st_size for path in targets] == [*files, *page]
        except (OSError, ValueError, KeyError):
            return False

    def keep(self) -> None:
        """Have the disk keep what was written, of this run and of those before."""
        if (self._files or self._pages) and hasattr(os, "sync"):
            # File by file it would take longer than the analyses.
            os.sync()

    def write_index(self, records: Callable[[], Iterator[tuple[DeckFile, dict[str, Any]]]]) -> str:
        """Write the index of the pages, if there is to be one.

        Args:
            records: The wanted decks in their order, each with what was remembered; called more
                than once.

        Returns:
            Its path, or nothing.
        """
        if self._index is None:
            return ""
        page = load("flexact.show.page")
        with written_whole(self._index) as file:
            for piece in page.index_pieces(_Entries(records)):
                file.write(piece.encode("utf-8", "backslashreplace"))
        return str(self._index)


@dataclass(frozen=True)
class _Entries:
    """The entries of an index, unpacked as they are gone through."""

    records: Callable[[], Iterator[tuple[DeckFile, dict[str, Any]]]]

    def __len__(self) -> int:
        return sum(1 for _ in self.records())

    def __iter__(self) -> Iterator[Entry]:
        pages = load("flexact.apps.cli.pages")
        for deck, record in self.records():
            packed = record.get("entry")
            yield _unpacked(packed) if packed else pages.unread(deck.relative.as_posix())

    def __contains__(self, entry: object) -> bool:
        return any(entry == each for each in self)


def _packed(entry: Entry) -> dict[str, Any]:
    picture = None if entry.picture is None else base64.b64encode(entry.picture).decode("ascii")
    return {**asdict(entry), "picture": picture}


def _is_entry(packed: object) -> bool:
    """Whether `_unpacked` makes an entry of it that an index can show."""
    try:
        entry = _unpacked(packed)  # type: ignore[arg-type]
        # Whatever else is wrong with it is found where it is shown.
        return bool("".join(load("flexact.show.page").index_pieces([entry])))
    except Exception:
        return False


def _unpacked(packed: dict[str, Any]) -> Entry:
    picture = None if packed["picture"] is None else base64.b64decode(packed["picture"])
    made: Entry = load("flexact.show.page").Entry(
        **{**packed, "kind": tuple(packed["kind"]), "picture": picture}
    )
    return made
