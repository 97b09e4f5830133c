# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of variants, however they are given: a table, a grid, or rows as they come."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np

from ..util.text import in_short
from .columns import COLUMNS, ERROR, in_a_line

#: A parameter of a variant.
Value = str | int | float | bool | None
Row = dict[str, Value]
#: A table by columns or rows, a grid, a structured array, a data frame, or rows as they come.
Parameters = Any

_TAKEN = {column.name for column in (*COLUMNS, ERROR)}
_TEXTS = (str, bytes, bytearray)
_SINGLE = (str, int, float, bool, type(None), np.generic)


@dataclass(frozen=True)
class Grid:
    """Every combination of some values of each parameter; the last parameter changes fastest.

    Attributes:
        axes: The values of each parameter by its name.
    """

    axes: dict[str, list[Value]]

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each parameter has."""
        return tuple(map(len, self.axes.values()))

    def __len__(self) -> int:
        """How many combinations there are."""
        return prod(self.shape)

    def __iter__(self) -> Iterator[Row]:
        """The combinations as rows."""
        for values in itertools.product(*self.axes.values()):
            yield dict(zip(self.axes, values, strict=True))


def grid(**axes: Iterable[Value]) -> Grid:
    """Parameters for `flexact.sweep`: every combination of the values of each.

    Args:
        **axes: By the name of the parameter its values: numbers, texts, truth values or None.

    Raises:
        TypeError: the values are no sequence, or one is none of these.
        ValueError: a parameter is called like a column of the table.
    """
    for name in axes:
        require_name(name)
    return Grid({name: _column(name, values) for name, values in axes.items()})


#: Rows of parameters, taken as they are needed, a text in place of one that cannot be had; and how
#: many there are, None where that shows only as they come.
Given = tuple[Iterator[Row | str], int | None]


def given(parameters: Parameters) -> Given:
    """The rows of parameters; what is there from the beginning is checked before the first.

    Raises:
        TypeError: they are no parameters, or one is no number, text, truth value or None.
        ValueError: columns differ in length, or a parameter is called like a column of the table.
    """
    if isinstance(parameters, Grid):
        return iter(parameters), len(parameters)
    columns = _columns(parameters)
    if columns is not None:
        return _by_columns(columns)
    if isinstance(parameters, _TEXTS) or not isinstance(parameters, Iterable):
        raise TypeError(
            "parameters are a mapping of names to values, a flexact.grid, a data frame, or rows "
            f"of names and values, not {in_short(parameters)}"
        )
    if isinstance(parameters, Sequence):
        rows = [checked(row) for row in parameters]
        return iter(rows), len(rows)
    return _as_they_come(iter(parameters)), None


def _columns(parameters: Parameters) -> dict[str, Any] | None:
    """Columns by name, of a mapping, a structured array or a data frame."""
    if isinstance(parameters, np.ndarray) and parameters.dtype.names:
        names: Iterable[str] = parameters.dtype.names
    elif isinstance(parameters, Mapping):
        names = parameters
    elif hasattr(parameters, "columns") and hasattr(parameters, "__getitem__"):
        names = parameters.columns
    else:
        return None
    return {name: parameters[name] for name in names}


def _by_columns(columns: Mapping[Any, Any]) -> Given:
    for name in columns:
        require_name(name)
    made = {
        name: _plain(name, values) if isinstance(values, _SINGLE) else _column(name, values)
        for name, values in columns.items()
    }
    lengths = {name: len(values) for name, values in made.items() if isinstance(values, list)}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise ValueError(
            f"columns of parameters must be of one length, not {told}; flexact.grid(...) makes "
            "every combination"
        )
    count = next(iter(lengths.values()), 1)
    whole = [v if isinstance(v, list) else [v] * count for v in made.values()]
    rows = (dict(zip(made, values, strict=True)) for values in zip(*whole, strict=True))
    return rows, count if made else 0


def _column(name: str, values: Any) -> list[Value]:
    if isinstance(values, _TEXTS) or not isinstance(values, Iterable):
        raise TypeError(f"the parameter {name} must be a list of values, not {in_short(values)}")
    return [_plain(name, value) for value in values]


def _as_they_come(taken: Iterator[Any]) -> Iterator[Row | str]:
    """Rows; one that is wrong, or what the generator raises, is told in its place."""
    for count in itertools.count():
        try:
            item = next(taken)
        except StopIteration:
            return
        except Exception as error:
            yield f"the parameters ended here: {in_a_line(error)}"
            return
        try:
            row: Row | str = checked(item)
        except (TypeError, ValueError) as error:
            if not count:
                raise
            row = str(error)
        yield row


def checked(row: Any) -> Row:
    """A row of parameters, if it is one.

    Raises:
        TypeError: It is none, or a parameter is no number, text, truth value or None.
        ValueError: A parameter is called like a column of the table.
    """
    if not isinstance(row, Mapping):
        raise TypeError(
            f"the parameters of a variant are a mapping of names to values, not {in_short(row)}"
        )
    for name in row:
        require_name(name)
    return {name: _plain(name, value) for name, value in row.items()}


def require_name(name: Any) -> None:
    """Raise unless a parameter can be called so.

    Raises:
        TypeError: It is no text.
        ValueError: It is empty, or the name of a column.
    """
    if not isinstance(name, str):
        raise TypeError(f"the name of a parameter must be text, not {in_short(name)}")
    if not name:
        raise ValueError("a parameter must have a name")
    if name in _TAKEN:
        raise ValueError(
            f"a parameter cannot be called {name!r}: a column of the table has that name"
        )


def _plain(name: str, value: Any) -> Value:
    """A value as Python's own."""
    if isinstance(value, np.generic):
        value = value.item()
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value)
    if value is None:
        return None
    raise TypeError(
        f"the parameter {name} must be a number, a text, a truth value or None, "
        f"not {in_short(value)}"
    )


def array_of(values: Sequence[Value]) -> np.ndarray:
    """A column: of floats, whole numbers, truth values or texts, else of objects.

    Among numbers None is NaN.
    """
    kinds = {type(value) for value in values}
    plain = {frozenset({bool}): np.bool_, frozenset({str}): np.str_, frozenset({int}): np.int64}
    kind = plain.get(frozenset(kinds))
    if kind is None and kinds <= {int, float, type(None)} and kinds != {type(None)}:
        kind = np.float64
    if kind is not None:
        with suppress(OverflowError):
            return np.array(values, kind)
    made = np.empty(len(values), object)
    made[:] = values
    return made
