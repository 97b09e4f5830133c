# SPDX-License-Identifier: BSD-3-Clause
"""What is told of a cost, before it is broken into rows: sentences and tables."""

from __future__ import annotations

from typing import NamedTuple

from ..util.text import table, wrapped

#: Columns of text where nobody says how many there are.
WIDTH = 80


class Row(NamedTuple):
    """A sentence, and what stands in front of its further rows."""

    words: str
    indent: str = ""


class Table(NamedTuple):
    """A table whose first row has its headings; they may go on in a second one."""

    rows: tuple[tuple[str, ...], ...]
    second: bool = False


Told = Row | Table


def shown(told: Told, width: int) -> str:
    """As text in rows of at most `width` columns."""
    if isinstance(told, Row):
        return wrapped(told.words, width, told.indent)
    return table(told.rows, width, second=told.second)
