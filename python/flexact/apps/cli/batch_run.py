# SPDX-License-Identifier: BSD-3-Clause
"""A run of a batch: what is left is done, what is done stands in the journal, then in the table."""

from __future__ import annotations

import base64
import contextlib
import hashlib
import os
import sys
import time
from array import array
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, suppress
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ...analysis.decomposition import Asked
from ...analysis.verdict import AnalysisError
from ...deck.rendering import DeckError
from ...model.reading import deck_bytes
from ...sweeps.batch import (
    DeckRow,
    Test,
    Values,
    deck_columns,
    deck_row,
    failed_row,
    filter_of,
    first_error,
)
from ...sweeps.columns import Column
from ...sweeps.journal import Journal
from ...sweeps.running import results_of
from ...sweeps.writing import Cell, write_table
from ...util.decks import DeckFile, FolderError
from ...util.errors import BatchError
from ...util.interruption import undisturbed, unwinding
from ...util.loading import load
from ...util.outputs import OutputError, plan_files, write_together, written_whole
from ...util.partial import why
from ...util.records import cached_property
from ...util.text import harmless
from .terminal import complain, is_watched, size_of_terminal

if TYPE_CHECKING:
    from ...show.page import Entry
    from .deck_files import DeckPage


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
        made: tuple[bytes, ...] = load("flexact.apps.cli.deck_files").contents_of(
            row.result, self._mesh_format
        )
        return made

    def _page(self, row: DeckRow, item: Item) -> DeckPage | None:
        if not self._has_pages:
            return None
        pages = load("flexact.apps.cli.deck_files")
        made: DeckPage | None
        if row.result is not None:
            made = pages.page_of(row.result, item.place, indexed=True)
        else:
            made = pages.broken_page_of(row.error, item.name, item.place)
        return made


def _every(_: Values) -> bool:
    return True


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
            made = load("flexact.apps.cli.deck_files").ResultFiles(decks, files, mesh_format)
            self.mesh_format, self._files = made.format, made.plan
        if report is not None:
            # Processes that are forked have it then.
            pages = load("flexact.apps.cli.deck_files")
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
        pages = load("flexact.apps.cli.deck_files")
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


_FORM = "{n_fmt} of {total_fmt} decks |{bar}| {rate_fmt}, {remaining} left{postfix}"
#: Where nobody watches, in a log, a line is written so often [s].
_LINE = 60.0


class BatchBar:
    """A bar on stderr; where that is no terminal, a line from time to time."""

    def __init__(self, total: int, before: int) -> None:
        """Of so many decks some were done before."""
        self._total, self._before, self._done, self._errors = total, before, before, 0
        self._start = self._last = time.monotonic()
        self._bar: Any = None

    def __enter__(self) -> BatchBar:
        """Draw the bar, if somebody watches."""
        if is_watched():
            with contextlib.suppress(ImportError, OSError):
                self._bar = self._drawn()
        return self

    def __exit__(self, *_: object) -> None:
        """Wipe the bar."""
        if self._bar is not None:
            with contextlib.suppress(OSError):
                self._bar.close()

    def _drawn(self) -> Any:
        tqdm = import_module("tqdm").tqdm
        tqdm.monitor_interval = 0  # no thread of its own: processes are forked
        return tqdm(
            **{"total": self._total, "initial": self._before, "file": sys.stderr, "leave": False},
            **{"unit": " decks", "bar_format": _FORM, **size_of_terminal()},
        )

    def count(self, has_error: bool) -> None:
        """One more deck is done."""
        self._done += 1
        self._errors += has_error
        if self._bar is None:
            self._in_a_log()
            return
        with contextlib.suppress(OSError):
            if has_error:
                words = f"{self._errors} with errors"
                self._bar.set_postfix_str(words, refresh=False)
            self._bar.update(1)

    def _in_a_log(self) -> None:
        now = time.monotonic()
        if now - self._last < _LINE:
            return
        self._last = now
        rate = (self._done - self._before) / (now - self._start)
        left = import_module("tqdm").tqdm.format_interval((self._total - self._done) / rate)
        complain(f"{self._done} of {self._total} decks, {rate:.3g} decks/s, {left} left")


#: What is counted of decks without a verdict.
_WITH_ERRORS = "with errors"
_NOT_DONE = -1


class BatchRun:
    """Decks, what is done with each, and the journal of what is done."""

    def __init__(
        self, decks: Sequence[DeckFile], work: Work, outputs: Outputs, journal: Journal
    ) -> None:
        """Find out what is done already.

        Raises:
            JournalError: The journal cannot be read.
        """
        self._decks, self._work, self._outputs, self._journal = decks, work, outputs, journal
        self._place = array("q", [_NOT_DONE]) * len(decks)
        for entry in journal.entries():
            index = entry.record.get("deck")
            # Whatever else stands there was written by others.
            if entry.place and type(index) is int and 0 <= index < len(decks):
                self._place[index] = entry.place
        self._left = array("q", (k for k in range(len(decks)) if not self._is_done(k)))
        for k in self._left:
            self._place[k] = _NOT_DONE
        self._sent: dict[int, tuple[int, str]] = {}
        names = [column.name for column in work.columns[1:]]
        self._verdict, self._error = names.index("verdict"), names.index("error")
        self._rows_written = 0

    def _is_done(self, index: int) -> bool:
        """Whether a deck, as it is now, was done, and what was written of it is there."""
        if self._place[index] == _NOT_DONE:
            return False
        deck, record = self._decks[index], self._journal.read(self._place[index])
        return (
            record.get("of") == _content(deck).digest
            and self._is_row(record.get("row"))
            and type(record.get("wanted")) is bool
            and self._outputs.are_there(deck, record)
        )

    def _is_row(self, row: object) -> bool:
        """Whether it is a row as those are that this run writes."""
        kinds = [column.kind for column in self._work.columns[1:]]
        if not isinstance(row, list) or len(row) != len(kinds):
            return False
        return all(
            cell is None or type(cell) is kind or (kind is float and type(cell) is int)
            for cell, kind in zip(row, kinds, strict=True)
        )

    @property
    def done(self) -> int:
        """How many decks are done."""
        return len(self._place) - self._place.count(_NOT_DONE)

    def make(self, table: Path, executor: str | None, workers: int | None) -> str:
        """Do what is left, and write the table; then the journal is not needed any more.

        Args:
            table: The table.
            executor: Address of a Dask scheduler, or None.
            workers: So many processes on this machine; None: one a processor.

        Returns:
            In words what came of the decks, and where it stands.

        Raises:
            BatchError: It cannot be gone on with; what is done is in the journal.
        """
        try:
            with unwinding() as look:
                if self._left:
                    self._do(executor, workers, look)
                return self._write(table)
        except BatchError as error:
            raise BatchError(f"{error}; {self._where_to_go_on}") from error
        except KeyboardInterrupt:
            complain(f"stopped; {self._where_to_go_on}")
            raise
        finally:
            with undisturbed(), suppress(OutputError):
                self._journal.keep(at_once=True)
                if not self.done:
                    self._journal.remove()

    def _do(self, executor: str | None, workers: int | None, look: Callable[[], None]) -> None:
        results = results_of(self._work, self._items(), executor=executor, workers=workers)
        with closing(results), BatchBar(len(self._decks), self.done) as self._bar:
            for index, answer, failure in results:
                look()
                deck, digest = self._sent.pop(index)
                if failure:
                    answer = self._failed(deck, AnalysisError(failure))
                self._finish(deck, digest, answer)

    def _items(self) -> Iterator[Item]:
        """The decks that are left; those that cannot be read are done here."""
        sent = 0
        for index in self._left:
            deck = self._decks[index]
            content = _content(deck)
            if content.error is not None:
                self._finish(index, content.digest, self._failed(index, content.error))
                continue
            self._sent[sent] = index, content.digest
            sent += 1
            yield Item(deck.name, deck.relative.as_posix(), content.raw)

    def _failed(self, index: int, error: Exception) -> Answer:
        deck = self._decks[index]
        return self._work.failed(error, deck.name, deck.relative.as_posix())

    def _finish(self, index: int, digest: str, answer: Answer) -> None:
        """Write what was made of a deck, and then that it is done."""
        written = self._outputs.put(self._decks[index], answer)
        record = {"deck": index, "of": digest, "row": answer.values, "wanted": answer.is_wanted}
        self._place[index] = self._journal.add({**record, **written})
        self._journal.keep()
        self._bar.count(bool(answer.values[self._error]))

    @property
    def _where_to_go_on(self) -> str:
        if not self.done:
            return "no deck is done yet"
        some = f"{self.done} of {len(self._decks)} decks are done"
        return f"{some} and kept in {self._journal.path}: go on with --resume"

    def _write(self, table: Path) -> str:
        """Write the index of the pages and the table; what came of the decks, in words."""
        counts: Counter[str] = Counter()
        index = self._outputs.write_index(self._wanted)
        write_table(table, self._work.columns, self._rows(counts))
        self._outputs.keep()
        self._journal.remove()
        return _summary(counts, self._rows_written, self._work.where, table, index)

    def _rows(self, counts: Counter[str]) -> Iterator[tuple[Cell, ...]]:
        """The wanted rows in the order of the decks; what came of all is counted."""
        self._rows_written = 0
        for deck, record in self._records():
            counts[record["row"][self._verdict] or _WITH_ERRORS] += 1
            if record["wanted"]:
                self._rows_written += 1
                yield (deck.name, *record["row"])

    def _wanted(self) -> Iterator[tuple[DeckFile, dict[str, Any]]]:
        return ((deck, record) for deck, record in self._records() if record["wanted"])

    def _records(self) -> Iterator[tuple[DeckFile, dict[str, Any]]]:
        for deck, place in zip(self._decks, self._place, strict=True):
            yield deck, self._journal.read(place)


class _Content(NamedTuple):
    raw: bytes
    digest: str
    """Tells whether it is the same as before."""
    error: Exception | None = None


def _content(deck: DeckFile) -> _Content:
    """The text of a deck, or why there is none."""
    try:
        if deck.error is not None:
            raise deck.error
        raw = deck_bytes(deck)
    except (DeckError, FolderError) as error:
        return _Content(b"", first_error(error, ""), error)
    return _Content(raw, hashlib.blake2b(raw, digest_size=16).hexdigest())


def _summary(counts: Counter[str], rows: int, where: str, table: Path, index: str) -> str:
    total = counts.total()
    decks = f"{total} deck{'s' * (total != 1)}"
    found = ", ".join(f"{count} {words}" for words, count in counts.most_common())
    some = f", {rows} row{'s' * (rows != 1)} where {where}" if where else ""
    lines = [f"{decks}: {found}", f"table in {table}{some}"]
    return "\n".join(map(harmless, [*lines, *([f"index in {index}"] if index else [])]))
