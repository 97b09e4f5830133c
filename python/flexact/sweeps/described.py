# SPDX-License-Identifier: BSD-3-Clause
"""A table in words, and as HTML for notebooks."""

from __future__ import annotations

import math
import textwrap
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis.units import length_in_words
from ..analysis.verdict import Verdict
from ..util.plain_text import harmless

if TYPE_CHECKING:
    from .table import Table

_WIDTH = 100
#: Rows of a table in a notebook.
_MOST_ROWS = 10
#: Values of a parameter that are told one by one.
_FEW_VALUES = 4


def in_short(table: Table) -> str:
    """Size and verdicts in a line."""
    told = [f"{count} {words}" for words, count in counts_of(table)]
    return f"{_counted(len(table), 'variant')}{': ' * bool(told)}{', '.join(told)}"


def described(table: Table) -> str:
    """See `Table.describe`."""
    lines = [f"{_counted(len(table), 'variant')}{_of_parameters(table)}."]
    for words, count in counts_of(table):
        lines.append(f"{_capital(words)}: {share_in_words(count, len(table))}.")
    lines += _smallest(table)
    lines += _first_error(table)
    return "\n".join(
        textwrap.fill(harmless(line), _WIDTH, subsequent_indent="  ", break_long_words=False)
        for line in lines
    )


def counts_of(table: Table) -> list[tuple[str, int]]:
    """Each verdict that there is, what is doubtful, and errors, with how many rows have it."""
    every = [(each.value, int((table.verdict == each.value).sum())) for each in Verdict]
    every += [("doubtful, of these", int(table.is_doubtful.sum()))]
    every += [("with an error", int(table.has_error.sum()))]
    return [each for each in every if each[1]]


def row_in_words(table: Table, row: int) -> str:
    """A row by its number, and by its parameters."""
    values = (f"{name} {_value(table[row][name])}" for name in table.parameter_names)
    told = ", ".join(values)
    return f"variant {row}{': ' * bool(told)}{told}"


def html_of(table: Table) -> str:
    """The words, and the first rows."""
    heads = "".join(f"<th>{escape(harmless(name))}</th>" for name in table.columns)
    rows = "".join(_row(table[k]) for k in range(min(len(table), _MOST_ROWS)))
    left = len(table) - _MOST_ROWS
    more = f"<p>and {_counted(left, 'further row')}</p>" if left > 0 else ""
    return (
        f"<div><pre>{escape(described(table))}</pre><table><thead><tr>{heads}</tr></thead>"
        f"<tbody>{rows}</tbody></table>{more}</div>"
    )


def _row(row: dict[str, Any]) -> str:
    cells = (f"<td>{escape(harmless(_value(value)))}</td>" for value in row.values())
    return f"<tr>{''.join(cells)}</tr>"


def _of_parameters(table: Table) -> str:
    told = [f"{name} ({_values(table[name])})" for name in table.parameter_names]
    return f" of {', '.join(told)}" if told else ""


def _values(column: np.ndarray) -> str:
    every = list(dict.fromkeys(column.tolist()))
    if len(every) <= _FEW_VALUES:
        return ", ".join(map(_value, every))
    if column.dtype.kind in "if":
        ends = (_value(end(column).item()) for end in (np.nanmin, np.nanmax))
        return f"{len(every)} values from {' to '.join(ends)}"
    return f"{len(every)} values"


def _value(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def share_in_words(count: int, total: int) -> str:
    """A count, and how many per cent that is."""
    return f"{count} ({per_cent(count / total)} %)"


def per_cent(part: float) -> str:
    """A part in per cent; what is short of a hundred stays so."""
    shown, left = 100.0 * part, 100.0 * (1.0 - part)
    if not 0.0 < left < 1.0:
        return f"{shown:.3g}"
    return f"{shown:.{max(1, math.ceil(-math.log10(left) - 1e-6))}f}"


def _smallest(table: Table) -> list[str]:
    """Where margin and gap are smallest."""
    made = []
    for name, words in (("margin", "margin"), ("gap", "singular value that counts (scaled)")):
        if name not in table.columns:
            continue
        values = table[name]
        there = np.flatnonzero(np.isfinite(values))
        if there.size:
            row = int(there[np.argmin(values[there])])
            size = float(values[row])
            told = length_in_words(size) if name == "margin" else f"{size:.3g}"
            if name == "margin" and size == 0.0:
                told = "none, in exact alignment only"
            made.append(f"Smallest {words}: {told}, at {row_in_words(table, row)}.")
    return made


def _first_error(table: Table) -> list[str]:
    rows = np.flatnonzero(table.has_error)
    if not rows.size:
        return []
    first = int(rows[0])
    return [f"First error, {row_in_words(table, first)}: {table.error[first]}"]


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'s' * (count != 1)}"


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]
