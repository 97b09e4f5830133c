# SPDX-License-Identifier: BSD-3-Clause
"""Which rows of a table are neighbours."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .table import Table

#: In place of a parameter: rows are neighbours in the order in which they stand.
ROWS = "rows"

Array = np.ndarray


def lines_of(table: Table, along: str | None, in_order: bool) -> list[tuple[str, list[int]]]:
    """Lines of neighbours: a name, and the rows in their order.

    Args:
        table: The table.
        along: The parameter that changes along a line, `ROWS`, or None for all.
        in_order: Whether rows are neighbours in their order where no two differ in one parameter
            alone.

    Raises:
        ValueError: there is no such parameter, or no row has a neighbour.
    """
    every = [(ROWS, list(range(len(table))))]
    if along == ROWS:
        return every
    names = varying(table)
    if along is not None and along not in names:
        told = ", ".join(names) if names else "none"
        raise ValueError(
            f"there is no parameter {along!r} whose numbers vary; there are: {told}. Or say "
            f"along={ROWS!r}"
        )
    chosen = names if along is None else [along]
    made = [(name, line) for name in chosen for line in _lines(table, name) if len(line) > 1]
    if made or len(table) < 2:
        return made
    if in_order and along is None:
        return every
    raise ValueError(
        "no two rows differ in one number alone, so that none are neighbours; where parameters "
        f"change together, say along={ROWS!r}"
    )


def varying(table: Table) -> list[str]:
    """The parameters of which there are different numbers."""
    numbers = [name for name in table.parameter_names if table[name].dtype.kind in "if"]
    return [name for name in numbers if np.unique(_finite(table[name])).size > 1]


def _finite(column: Array) -> Array:
    there: Array = column[np.isfinite(column)]
    return there


def _keys(column: Array) -> list[object]:
    """Values that can be compared: NaN is like NaN."""
    return [None if value != value else value for value in column.tolist()]


def _lines(table: Table, name: str) -> Iterator[list[int]]:
    """Rows that differ in one parameter alone, by its value; of equal ones the first."""
    others = [_keys(table[other]) for other in table.parameter_names if other != name]
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for row, key in enumerate(zip(*others, strict=True) if others else [()] * len(table)):
        groups[key].append(row)
    values = table[name]
    for rows in groups.values():
        _, first = np.unique(values[rows], return_index=True)
        yield [rows[k] for k in first.tolist() if np.isfinite(values[rows[k]])]
