# SPDX-License-Identifier: BSD-3-Clause
"""``flexact batch``: one table of many decks, by all processors, that loses nothing."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from ...analysis.decomposition import asked_for
from ...sweeps.journal import Journal, JournalError
from ...sweeps.writing import require_table
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.loading import VERSION, load
from ...util.machine import processors
from ...util.outputs import STDOUT, OutputError, plan_file, require_replaceable
from .batch_run import BatchRun, Outputs, Work
from .decks import ACCURACY, DECISION, DECKS
from .parser import Verb, argument
from .targets import WORKERS, folder, mesh_argument
from .terminal import ExitCode, complain, say

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
    require_place(table, decks)
    outputs = Outputs(decks, chosen.files, chosen.mesh or "vtu", chosen.report)
    asked = asked_for(chosen.method, chosen.zero_tolerance, chosen.prove, chosen.accuracy)
    work = Work(asked, chosen.columns, chosen.where, outputs.mesh_format, outputs.has_pages)
    run = BatchRun(decks, work, outputs, _journal(table, _head(chosen, decks), chosen.resume))
    with _threads(chosen):
        words = run.make(table, chosen.dask, chosen.workers)
    say(words)
    return _code(decks)


def require_place(table: Path, decks: Sequence[DeckFile]) -> None:
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


def _threads(chosen: argparse.Namespace) -> Any:
    """One thread of BLAS, where the work is done in this process, as in those of a pool."""
    if chosen.dask is not None or (chosen.workers or processors()) > 1:
        return nullcontext()
    return load("threadpoolctl").threadpool_limits(1)


def _code(decks: Sequence[DeckFile]) -> ExitCode:
    """A folder that gives no decks is no deck that has its row."""
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
    made = [
        f"{name} was {_shown(then['options'].get(name))}, now {_shown(value)}"
        for name, value in now["options"].items()
        if then["options"].get(name) != value
    ]
    if then["decks"] != now["decks"]:
        made.append(_of_decks(then["decks"], now["decks"]))
    return made


def _shown(value: object) -> str:
    return "not given" if value is None else str(value)


def _of_decks(then: list[str], now: list[str]) -> str:
    new, gone = sorted({*now} - {*then}), sorted({*then} - {*now})
    if not new and not gone:
        return "the decks stand in another order"
    words = [f"{len(then)} decks then, {len(now)} now"]
    words += [f"{new[0]} is new"] if new else []
    words += [f"{gone[0]} is not among them any more"] if gone else []
    return ", ".join(words)


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
