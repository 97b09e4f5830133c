# SPDX-License-Identifier: BSD-3-Clause
"""What any process does with one deck of a batch: its row, and what is to be written of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ...analysis.decomposition import Asked
from ...sweeps.batch import Test, Values, filter_of
from ...sweeps.columns import Column
from ...sweeps.deck_rows import DeckRow, deck_columns, deck_row, failed_row
from ...sweeps.writing import Cell
from ...util.cached import cached_property
from ...util.loading import load
from ...util.partial import why

if TYPE_CHECKING:
    from ...show.page import Entry
    from .pages import DeckPage


class Item(NamedTuple):
    """A deck that is to be done."""

    name: str
    place: str
    """Of its page, beside the index and without its suffix."""
    raw: bytes
    """Its text: workers need not have its file."""


class Answer(NamedTuple):
    """What came of a deck."""

    values: tuple[Cell, ...]
    """Of the columns behind that of the deck."""
    is_wanted: bool
    """Whether it is what --where asks for."""
    files: tuple[bytes, ...] = ()
    page: bytes = b""
    entry: Entry | None = None
    """In the index of the pages."""


class Work:
    """What is asked for, to be called with each deck; it can be sent to other machines."""

    def __init__(
        self, asked: Asked, want: str, where: str, mesh_format: str, has_pages: bool
    ) -> None:
        """What is wanted.

        Args:
            asked: How decks are analysed.
            want: One of `WANTS`.
            where: Which rows, files and pages are wanted; all where it is empty.
            mesh_format: Of the mesh among the files; empty where no files are wanted.
            has_pages: Whether pages are wanted.

        Raises:
            FilterError: `where` is no condition.
        """
        self._asked, self._want, self.where = asked, want, where
        self._mesh_format, self._has_pages = mesh_format, has_pages
        self._test  # noqa: B018

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """The columns of the table, first that of the deck."""
        return deck_columns(self._want)

    @cached_property
    def _test(self) -> Test:
        return filter_of(self.where, self.columns) if self.where else _every

    def __getstate__(self) -> dict[str, object]:
        """What is sent: functions are made anew."""
        return {name: value for name, value in vars(self).items() if name != "_test"}

    def __call__(self, item: Item) -> Answer:
        """Analyse a deck, and make what is wanted of it."""
        return self._answer(deck_row(item.raw, item.name, self._asked, self._want), item)

    def failed(self, error: Exception, name: str, place: str) -> Answer:
        """What is said of a deck that could not be done."""
        return self._answer(failed_row(error, name, self._want), Item(name, place, b""))

    def _answer(self, row: DeckRow, item: Item) -> Answer:
        is_wanted = self._test({**row.values, "deck": item.name})
        files: tuple[bytes, ...] = ()
        page = None
        if is_wanted:
            try:
                files, page = self._files(row), self._page(row, item)
            except Exception as error:
                row.values["error"] = f"{item.name}: its files could not be made: {why(error)}"
        values = tuple(row.values[column.name] for column in self.columns[1:])
        if page is None:
            return Answer(values, is_wanted, files)
        return Answer(values, is_wanted, files, page.content, page.entry)

    def _files(self, row: DeckRow) -> tuple[bytes, ...]:
        if not self._mesh_format or row.result is None:
            return ()
        made: tuple[bytes, ...] = load("flexact.apps.cli.result_files").contents_of(
            row.result, self._mesh_format
        )
        return made

    def _page(self, row: DeckRow, item: Item) -> DeckPage | None:
        if not self._has_pages:
            return None
        pages = load("flexact.apps.cli.pages")
        made: DeckPage | None
        if row.result is not None:
            made = pages.page_of(row.result, item.place, indexed=True)
        else:
            made = pages.broken_page_of(row.error, item.name, item.place)
        return made


def _every(_: Values) -> bool:
    return True
