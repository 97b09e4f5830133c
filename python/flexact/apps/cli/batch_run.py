# SPDX-License-Identifier: BSD-3-Clause
"""A run of a batch: what is left is done, what is done stands in the journal, then in the table."""

from __future__ import annotations

import hashlib
from array import array
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, suppress
from pathlib import Path
from typing import Any, NamedTuple

from ...analysis.failing import AnalysisError
from ...deck.errors import DeckError
from ...model.reading import deck_bytes
from ...sweeps.deck_rows import first_error
from ...sweeps.engine_running import results_of
from ...sweeps.journal import Journal
from ...sweeps.writing import Cell, write_table
from ...util.decks import DeckFile, FolderError
from ...util.errors import BatchError
from ...util.interruption import undisturbed, unwinding
from ...util.outputs import OutputError
from ...util.plain_text import harmless
from .batch_bar import BatchBar
from .batch_outputs import Outputs
from .batch_work import Answer, Item, Work
from .terminal import complain

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
