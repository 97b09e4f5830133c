# SPDX-License-Identifier: BSD-3-Clause
"""Thousands of variants of a mechanism in one table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from functools import partial
from itertools import islice
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..analysis.decomposition import Asked, asked_for
from ..core.progress import Progress
from ..model.model import Model
from ..model.variation import held_given, positions_given
from .chunks import EngineError
from .columns import ERROR, columns_of
from .evaluate import (
    NO_MOTIONS,
    NO_STRESSES,
    Answer,
    Make,
    Positions,
    Source,
    answer_of,
    failed,
    signed_column,
    swept,
)
from .parameters import Parameters, Row, array_of, given
from .running import require_workers, results_of
from .table import Table

Array = np.ndarray
#: Columns of results that come first.
_FIRST = ("verdict", "under_constrained", "over_constrained", "rank", "certainty", "gap", "margin")


def table_of(
    rows: Sequence[Row],
    found: dict[str, Array],
    want: str,
    source: Source | None,
    **further: Any,
) -> Table:
    """A table of parameters and of the columns of results by name."""
    names = tuple(dict.fromkeys(name for row in rows for name in row))
    parameters = tuple(array_of([row.get(name) for row in rows]) for name in names)
    known = [column.name for column in columns_of(want)]
    order = [name for name in _FIRST if name in known]
    order += [name for name in known if name not in _FIRST] + [ERROR.name]
    return Table(
        columns=(*names, *order),
        arrays=(*parameters, *(np.asarray(found[name]) for name in order)),
        parameter_names=names,
        want=want,
        _source=source,
        **further,
    )


def table_of_answers(
    rows: Sequence[Row], answers: Sequence[Answer], want: str, source: Source
) -> Table:
    """A table of parameters and of what workers answered."""
    kept = (*columns_of(want), ERROR)
    cells: list[Sequence[Any]] = list(zip(*(answer.cells for answer in answers), strict=True))
    cells = cells or [[] for _ in kept]
    # Errors are few, and may be long.
    found: dict[str, Array] = {
        column.name: np.array(values, object if column is ERROR else column.kind)
        for column, values in zip(kept, cells, strict=True)
    }
    further: dict[str, Any] = {}
    if want == "all":
        modes = [answer.modes or (NO_MOTIONS, NO_STRESSES) for answer in answers]
        further["motions"] = tuple(each[0] for each in modes)
        further["self_stresses"] = tuple(each[1] for each in modes)
    if any(answer.signed is not None for answer in answers):
        further["_signed"] = signed_column(answer.signed for answer in answers)
    return table_of(rows, found, want, source, **further)


Item = TypeVar("Item")


def answers_of(
    function: Callable[[Item], Answer],
    items: Iterator[Item | str],
    count: int | None,
    want: str,
    workers: int | None,
    executor: Any,
    progress: Progress | None,
) -> list[Answer]:
    """The answer to each item; what is done when the engine is lost stays.

    Args:
        function: What makes an answer.
        items: Taken as they are needed; in place of one a text says what is wrong with it.
        count: How many there will be, if that is known.
        want: One of `WANTS`.
        workers: As for `results_of`.
        executor: Likewise.
        progress: As for `sweep`.

    Raises:
        EngineError: nothing could be done at all.
    """
    answers: dict[int, Answer] = {}
    sent: list[int] = []
    seen = 0

    def taken() -> Iterator[Item]:
        nonlocal seen
        for item in items:
            place, seen = seen, seen + 1
            if isinstance(item, str):
                answers[place] = failed(item, want)
            else:
                sent.append(place)
                yield item

    results = results_of(function, taken(), executor=executor, workers=workers)
    try:
        with closing(results):
            for done in results:
                answers[sent[done.index]] = done.result or failed(done.failure, want)
                if progress is not None:
                    share = len(answers) / count if count else 0.0
                    progress(f"variant {len(answers)}", min(share, 1.0))
    except EngineError as error:
        if not answers:
            raise
        left = taken()
        # Rows that come one by one may have no end.
        for _ in left if count is not None else islice(left, 1):
            pass
        further = "" if count is not None else ", nor is what would follow"
        for place in range(seen):
            answers.setdefault(place, failed(f"not done{further}: {error}", want))
    return [answers[place] for place in range(seen)]


_PLAIN = Asked()


def sweep(
    of: Model | Make,
    parameters: Parameters | None = None,
    *,
    positions: ArrayLike | None = None,
    held: ArrayLike | None = None,
    want: str = "values",
    method: str = "auto",
    tolerance: float | None = None,
    prove: bool | None = None,
    workers: int | None = None,
    executor: Any = None,
    progress: Progress | None = None,
) -> Table:
    """Analyse many variants of a mechanism: one table, a row a variant.

    Either of a model whose nodes are moved, or of which other deformations are held,

        flexact.sweep(model, positions=P)

    by threads in the core; or of a function that makes a model of parameters,

        flexact.sweep(make, flexact.grid(angle=[...], length=[...]))

    which is called, as `make(angle=..., length=...)`, and analysed by several processes.

    A variant that cannot be made or analysed is a row with its `error`; all others stay.

    Args:
        of: A model, or a function that returns one.
        parameters: For a function, what it is called with, by name: columns of one length (a
            mapping, in which a single value stands for all rows; a data frame; a structured
            array), `flexact.grid(...)`, or rows (a list or generator of mappings). Each is a
            number, a text, a truth value or None. For a model, likewise, what the variants are
            called in the table; they may be left out.
        positions: (variants, nodes, 3) [m], as `Model.positions`; rows of orientations are
            ignored, and vectors of elements stay as they are.
        held: (variants, elements, 6) of bool, as for `Model.with_held`; with or without
            positions.
        want: What is to be known of each variant: "verdict", the decision on rank alone;
            "values", the gap, the smallest singular value, the condition number and the margin;
            "all", motions and self-stresses, too.
        method: As for `analyse`.
        tolerance: As for `analyse`.
        prove: As for `analyse`.
        workers: So many threads or processes at most; by default one a processor.
        executor: Where the work is done, if not here: see `flexact.sweeps.running.results_of`.
        progress: Called with what is being done and how much of that is done, from 0 to 1 (0
            where nobody knows how many variants there will be).

    Raises:
        DeckError, ModelError: the model is wrong.
        EngineError: the executor is not there, or was lost.
        TypeError: something is of another kind than it must be.
        ValueError: positions or masks have the wrong shape or are not finite, columns differ in
            length, a parameter is called like a column of the table, or there is no such `want`
            or method.
    """
    columns_of(want)
    asked = asked_for(method, tolerance, prove)
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be something to call, not {type(progress).__name__}")
    require_workers(workers)
    if not isinstance(of, Model) and not callable(of):
        raise TypeError(
            f"a model, or a function that makes one, can be swept, not {type(of).__name__}"
        )
    if isinstance(of, Model):
        source: Source = _source_of(of, positions, held)
    elif positions is not None or held is not None:
        raise TypeError("positions and what is held belong to a model, not to a function")
    elif parameters is None:
        raise TypeError("a function needs parameters: sweep(make, {'angle': [...]})")
    else:
        source = of
    if isinstance(source, Positions):
        kept = _labels(parameters, source.count)
        if executor is None and asked == _PLAIN and want != "all":
            return table_of(kept, swept(source, want, workers, progress), want, source)
        count: int | None = source.count
        items: Iterator[Any] = map(source.one, range(source.count))
        function = partial(answer_of, source.data, want, asked)
    else:
        rows, count = given(parameters)
        kept = []

        def taken() -> Iterator[Row | str]:
            for row in rows:
                kept.append({} if isinstance(row, str) else row)
                yield row

        function, items = partial(answer_of, source, want, asked), taken()
    answers = answers_of(function, items, count, want, workers, executor, progress)
    return table_of_answers(kept, answers, want, source)


def _source_of(model: Model, positions: ArrayLike | None, held: ArrayLike | None) -> Positions:
    """Positions and masks, checked.

    Raises:
        DeckError, ModelError, TypeError, ValueError: see `sweep`.
    """
    model.check()
    data = model.data
    if positions is None and held is None:
        raise TypeError("a model needs positions, or what is held: sweep(model, positions=...)")
    moved = None if positions is None else positions_given(data, positions, many=True)
    masks = None if held is None else held_given(data, held, many=True)
    if moved is not None and masks is not None and len(moved) != len(masks):
        raise ValueError(
            f"there are {len(moved)} positions, but {len(masks)} masks of what is held"
        )
    # What is given may change afterwards.
    return Positions(
        data, None if moved is None else moved.copy(), None if masks is None else masks.copy()
    )


def _labels(parameters: Parameters | None, count: int) -> list[Row]:
    """What the variants of a model are called."""
    if parameters is None:
        return [{}] * count
    rows = list(given(parameters)[0])
    for row in rows:
        if isinstance(row, str):
            raise ValueError(row)
    if len(rows) != count:
        raise ValueError(f"there are {count} variants, but parameters of {len(rows)}")
    return [row for row in rows if not isinstance(row, str)]
