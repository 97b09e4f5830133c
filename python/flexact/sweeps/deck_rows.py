# SPDX-License-Identifier: BSD-3-Clause
"""A deck as a row of a table: what is known of it, or its first error."""

from __future__ import annotations

import time
from dataclasses import dataclass

from ..analysis.decomposition import Asked
from ..analysis.failing import AnalysisError
from ..analysis.result import Result, result_of
from ..core.arrays import ModelArrays
from ..core.progress import Progress
from ..deck.errors import DeckError, ProblemsError
from ..model.reading import read_bytes
from ..util.decks import FolderError, no_formula
from ..util.partial import why
from ..util.plain_text import harmless
from .columns import ERROR, Column, columns_of
from .row import error_row, row_of
from .writing import Cell

DECK = Column("deck", str, "the deck, as it was named", "verdict")
_SIZE = (
    Column("rows", int, "rows of D(c)", "verdict"),
    Column("columns", int, "columns of D(c)", "verdict"),
)
SECONDS = Column("seconds", float, "what reading and analysing it took [s]", "verdict")
#: From this number of elements on, Ctrl-C need not wait for the core.
_LONG = 300


@dataclass(frozen=True)
class DeckRow:
    """What came of a deck.

    Attributes:
        values: By the names of the columns, but for that of the deck.
        result: None where there is an error.
        error: Why there is no result, or None.
    """

    values: dict[str, Cell]
    result: Result | None
    error: Exception | None


def deck_columns(want: str) -> tuple[Column, ...]:
    """The columns of a table of decks, for one of `WANTS`."""
    columns = columns_of(want)
    behind = 1 + [column.name for column in columns].index("rank")
    return (DECK, *columns[:behind], *_SIZE, *columns[behind:], ERROR, SECONDS)


def deck_row(raw: bytes, name: str, asked: Asked, want: str) -> DeckRow:
    """Read and analyse a deck, whose errors are its row.

    Args:
        raw: Its text.
        name: What it is called.
        asked: How it is to be analysed.
        want: One of `WANTS`.
    """
    start = time.perf_counter()
    try:
        data = read_bytes(raw, name)
        result: Result = result_of(data, asked, name, _awake(data.arrays))
        values: dict[str, Cell] = {
            **row_of(result, want),
            **{"rows": result.rows, "columns": result.columns},
        }
        made = DeckRow(values, result, None)
    except (DeckError, AnalysisError, MemoryError) as error:
        made = failed_row(error, name, want)
    except Exception as error:
        # One deck over which this program stumbles shall not cost the others.
        made = failed_row(AnalysisError(why(error)), name, want)
    made.values["seconds"] = time.perf_counter() - start
    return made


def failed_row(error: Exception, name: str, want: str, seconds: float = 0.0) -> DeckRow:
    """The row of a deck that has no result."""
    words = first_error(error, name)
    values: dict[str, Cell] = {**error_row(words, want), "rows": None, "columns": None}
    return DeckRow(values | {"seconds": seconds}, None, error)


def first_error(error: Exception, name: str) -> str:
    """The first error of a deck in a line: `file:line:column: message`."""
    place, message = name, str(error)
    if isinstance(error, ProblemsError):
        first = next(item for item in error.diagnostics if item.is_error)
        message = first.message
        if first.line:
            place = f"{name}:{first.line}:{first.column}"
    elif isinstance(error, MemoryError):
        message = "not enough memory"
    elif isinstance(error, FolderError):
        return harmless(no_formula(message))  # which names it
    return harmless(f"{place}: {message}")


def _awake(arrays: ModelArrays) -> Progress | None:
    """What lets a large model be analysed in a thread, while this one hears signals."""
    return _nothing if arrays.element_number.size > _LONG else None


def _nothing(_: str, __: float) -> None:
    """Nothing is shown."""
