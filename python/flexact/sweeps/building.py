# SPDX-License-Identifier: BSD-3-Clause
"""Tables made of parameters, and of what is known of each variant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .columns import ERROR, Column, columns_of
from .modes import NO_MOTIONS, NO_STRESSES
from .parameters import Row, array_of
from .signed import columns_of_signed
from .source import Source
from .sweeps_worker import Answer
from .table import Table

Array = np.ndarray
#: Columns of results that come first.
_FIRST = ("verdict", "under_constrained", "over_constrained", "rank", "certainty", "gap", "margin")


def _kind_of(column: Column) -> type:
    """Of the numbers or texts of a column; errors are few, and may be long."""
    return object if column is ERROR else column.kind


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
    found: dict[str, Array] = {
        column.name: np.array(values, _kind_of(column))
        for column, values in zip(kept, cells, strict=True)
    }
    further: dict[str, Any] = {}
    if want == "all":
        modes = [answer.modes or (NO_MOTIONS, NO_STRESSES) for answer in answers]
        further["motions"] = tuple(each[0] for each in modes)
        further["self_stresses"] = tuple(each[1] for each in modes)
    if any(answer.signed is not None for answer in answers):
        further["_signed"] = columns_of_signed([answer.signed for answer in answers])
    return table_of(rows, found, want, source, **further)
