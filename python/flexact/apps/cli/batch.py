# SPDX-License-Identifier: BSD-3-Clause
"""``flexact batch``: one table of many decks, by all processors, that loses nothing."""

from __future__ import annotations

import argparse
import base64
import hashlib
import os
import time
from array import array
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, nullcontext, suppress
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ...analysis.decomposition import Asked, asked_for
from ...analysis.verdict import AnalysisError
from ...deck.rendering import DeckError
from ...model.reading import deck_bytes
from ...sweeps.batch import (
    DeckRow,
    Test,
    deck_columns,
    deck_row,
    failed_row,
    filter_of,
    first_error,
)
from ...sweeps.columns import Cell, Column, require_table, write_table
from ...sweeps.journal import Journal, JournalError
from ...sweeps.running import results_of
from ...util.decks import DeckFile, FolderError, find_decks
from ...util.errors import BatchError
from ...util.interruption import undisturbed, unwinding
from ...util.loading import VERSION, load
from ...util.machine import processors
from ...util.outputs import STDOUT, OutputError, plan_files, write_together, written_whole
from ...util.partial import why
from ...util.records import cached_property
from ...util.text import harmless
from .decks import ACCURACY, DECISION, DECKS, decision_of
from .parser import Verb, argument
from .targets import WORKERS, folder, mesh_argument, plan_table
from .terminal import ExitCode, complain, drawn, is_watched, say

if TYPE_CHECKING:
    from ...show.page import Entry
    from .report import DeckPage

#: What the table may hold.
_COLUMNS = ("verdict", "values")
#: Number of the form of the journal.
_FORM = 2


def make_table(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the decks that were asked for, and write their table."""
    if chosen.mesh and not chosen.files:
        raise BatchError("--mesh is for the meshes of --files DIR")
    table: Path = chosen.output
    if table == STDOUT:
        raise BatchError(
            "a batch keeps a journal beside its table, which needs a name; for a line a deck on "
            "standard output say flexact analyse --summary or --json"
        )
    require_table(table)
    decks = find_decks(chosen.decks)
    plan_table(table, decks)
    outputs = Outputs(decks, chosen.files, chosen.mesh or "vtu", chosen.report)
    asked = asked_for(*decision_of(chosen))
    work = Work(asked, chosen.columns, chosen.where, outputs.mesh_format, chosen.report is not None)
    run = BatchRun(decks, work, outputs, _journal(table, _head(chosen, decks), chosen.resume))
    # One thread of BLAS, where the work is done in this process, as in those of a pool.
    is_here = chosen.dask is None and (chosen.workers or processors()) == 1
    with load("threadpoolctl").threadpool_limits(1) if is_here else nullcontext():
        words = run.make(table, chosen.dask, chosen.workers)
    say(words)
    # A folder that gives no decks is no deck that has its row.
    failures = [deck.error for deck in decks if deck.error is not None]
    for error in failures:
        complain(str(error))
    return ExitCode.DECK_ERROR if failures else ExitCode.ANALYSED


def _head(chosen: argparse.Namespace, decks: Sequence[DeckFile]) -> dict[str, Any]:
    """What a journal remembers of its run: a row of it is of use in another of the same alone."""
    folders = {name: getattr(chosen, name) for name in ("files", "report")}
    return {
        "journal": _FORM,
        "flexact": VERSION,
        "options": {
            "--columns": chosen.columns,
            "--where": chosen.where or None,
            "--method": chosen.method,
            "--tolerance": chosen.zero_tolerance,
            "--prove": chosen.prove,
            "--fast, --certain": chosen.trade[0] if chosen.trade else None,
            "--accuracy": chosen.accuracy and list(chosen.accuracy),
            "--mesh": chosen.mesh,
            **{f"--{name}": path and os.path.abspath(path) for name, path in folders.items()},
        },
        "decks": [deck.path for deck in decks],
    }


def _journal(table: Path, head: dict[str, Any], resume: bool) -> Journal:
    """The journal beside a table, a new one or that of the run that was interrupted.

    Raises:
        JournalError: There is one that was not asked for, or it is of another run.
    """
    path = table.with_name(f"{table.name}.journal")
    found = Journal.resume(path)
    if found is None:
        return Journal.begin(path, head)
    if not resume:
        raise JournalError(
            f"{path} is there, of a run that was interrupted: go on with --resume, or delete it "
            "to start anew"
        )
    if differences := _differences(found.head, head):
        raise JournalError(
            f"{path} is of another run: {'; '.join(differences)}. Go on as that run began, or "
            "delete it to start anew"
        )
    return found


def _differences(then: dict[str, Any], now: dict[str, Any]) -> list[str]:
    """What is asked for in another way than it was, in words."""
    if then.get("journal") != now["journal"] or then.get("flexact") != now["flexact"]:
        return [f"it was written by flexact {then.get('flexact')}, and this is {VERSION}"]
    options, decks = then.get("options"), then.get("decks")
    if not isinstance(options, dict) or not isinstance(decks, list) or {*map(type, decks)} - {str}:
        return ["its first line is not as flexact writes it"]
    pairs = {name: (options.get(name), value) for name, value in now["options"].items()}
    made = [
        "{} was {}, now {}".format(name, *("not given" if v is None else v for v in pair))
        for name, pair in pairs.items()
        if pair[0] != pair[1]
    ]
    if decks != now["decks"]:
        new, gone = sorted({*now["decks"]} - {*decks}), sorted({*decks} - {*now["decks"]})
        words = [f"{len(decks)} decks then, {len(now['decks'])} now"] if new or gone else []
        words += [f"{new[0]} is new"] if new else []
        words += [f"{gone[0]} is not among them any more"] if gone else []
        made.append(", ".join(words) or "the decks stand in another order")
    return made


#: A deck that is to be done: its name, the place of its page, beside the index and without its
#: suffix, and its text: workers need not have its file.
Item = tuple[str, str, bytes]


class Answer(NamedTuple):
    """What came of a deck."""

    values: tuple[Cell, ...]
    """Of the columns behind that of the deck."""
    is_wanted: bool
    """Whether it is what --where asks for."""
    files: tuple[bytes, ...] = ()
    page: DeckPage | None = None
    """With its entry in the index of the pages."""


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
            BatchError: `where` is no condition.
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
        return filter_of(self.where, self.columns) if self.where else lambda _: True

    def __getstate__(self) -> dict[str, object]:
        """What is sent: functions are made anew."""
        return {name: value for name, value in vars(self).items() if name != "_test"}

    def __call__(self, item: Item) -> Answer:
        """Analyse a deck, and make what is wanted of it."""
        name, place, raw = item
        return self._answer(deck_row(raw, name, self._asked, self._want), name, place)

    def failed(self, error: Exception, deck: DeckFile) -> Answer:
        """What is said of a deck that could not be done."""
        row = failed_row(error, deck.name, self._want)
        return self._answer(row, deck.name, deck.relative.as_posix())

    def _answer(self, row: DeckRow, name: str, place: str) -> Answer:
        is_wanted = self._test({**row.values, "deck": name})
        files: tuple[bytes, ...] = ()
        page: DeckPage | None = None
        if is_wanted:
            try:
                if self._mesh_format and row.result is not None:
                    export = load("flexact.apps.cli.export")
                    files = export.contents_of(row.result, self._mesh_format)
                if self._has_pages:
                    report = load("flexact.apps.cli.report")
                    if row.result is not None:
                        page = report.page_of(row.result, place, indexed=True)
                    else:
                        page = report.broken_page_of(row.error, name, place)
            except Exception as error:
                row.values["error"] = f"{name}: its files could not be made: {why(error)}"
                files = ()
        values = tuple(row.values[column.name] for column in self.columns[1:])
        return Answer(values, is_wanted, files, page)


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
            plan_results = load("flexact.apps.cli.export").plan_results
            self.mesh_format, self._files = plan_results(decks, files, mesh_format)
        if report is not None:
            # Processes that are forked have it then.
            pages = load("flexact.apps.cli.report")
            self._pages = plan_files((*decks, pages.INDEX), report, (".html",))
            self._index = self._pages[pages.INDEX.path][0]
            if not load("flexact.show.picture").has_packages():
                complain(pages.WITHOUT_PICTURES)

    def put(self, deck: DeckFile, answer: Answer) -> dict[str, Any]:
        """Write what was made of a deck.

        Returns:
            What is to be remembered of it: sizes, and the entry of the index.

        Raises:
            OutputError: A file cannot be written.
        """
        page, entry = answer.page or (b"", None)
        contents = [*answer.files, *([page] if page else [])]
        targets = self._targets(deck, bool(answer.files), bool(page))
        if contents:
            write_together(dict(zip(targets, contents, strict=True)))
        record: dict[str, Any] = {}
        if answer.files:
            record["files"] = [len(content) for content in answer.files]
        if entry is not None:
            picture = entry.picture
            packed = None if picture is None else base64.b64encode(picture).decode("ascii")
            record["page"] = [len(page)]
            record["entry"] = {**asdict(entry), "picture": packed}
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
        page = load("flexact.show.page")
        for deck, record in self.records():
            packed = record.get("entry")
            yield _unpacked(packed) if packed else page.unread_entry(deck.relative.as_posix())


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


_BAR = "{n_fmt} of {total_fmt} decks |{bar}| {rate_fmt}, {remaining} left{postfix}"
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
            with suppress(ImportError, OSError):
                count = {"total": self._total, "initial": self._before, "unit": " decks"}
                self._bar = drawn(**count, bar_format=_BAR)
        return self

    def __exit__(self, *_: object) -> None:
        """Wipe the bar."""
        if self._bar is not None:
            with suppress(OSError):
                self._bar.close()

    def count(self, has_error: bool) -> None:
        """One more deck is done."""
        self._done += 1
        self._errors += has_error
        now = time.monotonic()
        if self._bar is not None:
            with suppress(OSError):
                if has_error:
                    self._bar.set_postfix_str(f"{self._errors} with errors", refresh=False)
                self._bar.update(1)
            return
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
        for place, record in journal.entries():
            index = record.get("deck")
            # Whatever else stands there was written by others.
            if place and type(index) is int and 0 <= index < len(decks):
                self._place[index] = place
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
        kinds, row = [column.kind for column in self._work.columns[1:]], record.get("row")
        if not isinstance(row, list) or len(row) != len(kinds):
            return False
        return (
            record.get("of") == _content(deck)[1]
            and all(
                cell is None or type(cell) is kind or (kind is float and type(cell) is int)
                for cell, kind in zip(row, kinds, strict=True)
            )
            and type(record.get("wanted")) is bool
            and self._outputs.are_there(deck, record)
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
                k, digest = self._sent.pop(index)
                if failure:
                    answer = self._work.failed(AnalysisError(failure), self._decks[k])
                self._finish(k, digest, answer)

    def _items(self) -> Iterator[Item]:
        """The decks that are left; those that cannot be read are done here."""
        sent = 0
        for index in self._left:
            deck = self._decks[index]
            raw, digest, error = _content(deck)
            if error is not None:
                self._finish(index, digest, self._work.failed(error, deck))
                continue
            self._sent[sent] = index, digest
            sent += 1
            yield deck.name, deck.relative.as_posix(), raw

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
        total, rows, where = counts.total(), self._rows_written, self._work.where
        found = ", ".join(f"{count} {words}" for words, count in counts.most_common())
        some = f", {rows} row{'s' * (rows != 1)} where {where}" if where else ""
        lines = [f"{total} deck{'s' * (total != 1)}: {found}", f"table in {table}{some}"]
        return "\n".join(map(harmless, [*lines, *([f"index in {index}"] if index else [])]))

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


def _content(deck: DeckFile) -> tuple[bytes, str, Exception | None]:
    """The text of a deck, what tells whether it is the same as before, and why there is none."""
    try:
        if deck.error is not None:
            raise deck.error
        raw = deck_bytes(deck)
    except (DeckError, FolderError) as error:
        return b"", first_error(error, ""), error
    return raw, hashlib.blake2b(raw, digest_size=16).hexdigest(), None


VERB = Verb(
    run=make_table,
    description=(
        "Analyse many decks by all processors into one table, a row a deck; one with errors is a "
        "row with its first error. What is done stands in the journal TABLE.journal until the "
        "table is written, so that after an interruption --resume goes on."
    ),
    examples=(
        (
            "A table of many decks",
            "flexact batch input_decks/paper -o results/decks.csv",
        ),
        (
            "Of those that are over-constrained, with their files",
            "flexact batch input_decks/paper -o results/over.csv --where 'over_constrained > 0' "
            "--files results",
        ),
    ),
    arguments=(
        DECKS,
        argument(
            *("-o", "--output"),
            type=Path,
            metavar="TABLE",
            required=True,
            help="the table, .csv, .jsonl or .parquet",
        ),
        WORKERS,
        argument(
            "--resume", action="store_true", help="go on where an interrupted run has stopped"
        ),
        argument(
            "--columns",
            choices=_COLUMNS,
            default="values",
            help="the verdict alone, or singular values and margins as well (default)",
        ),
        argument(
            "--where",
            default="",
            metavar="CONDITION",
            help="rows, files and pages of some decks alone, such as 'over_constrained > 0'",
        ),
        argument(
            "--files",
            type=folder,
            metavar="DIR",
            help="write what analyse -o writes of each deck there",
        ),
        mesh_argument("--files"),
        argument(
            "--report",
            type=folder,
            metavar="DIR",
            help="write a page of each deck and index.html there",
        ),
        DECISION,
        ACCURACY,
    ),
)
