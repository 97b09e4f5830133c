# SPDX-License-Identifier: BSD-3-Clause
"""The table of a sweep: parameters and results, a row a variant."""

from __future__ import annotations

import math
import os
import pickle
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from ..analysis.naming import length_in_words
from ..analysis.verdict import Certainty, Verdict
from ..core.arrays import BoolArray
from ..model.model import Model
from ..util.errors import FlexactError
from ..util.loading import load
from ..util.records import Frozen
from ..util.text import harmless
from .columns import COLUMNS, ERROR, Column, write_table
from .crossings import Crossing, Crossings, crossings_of, varying
from .evaluate import MotionArrays, Positions, Source, StressArrays, variant_of
from .plots import MOST_SEARCHED, chosen, curve, finished, parameter_map

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = np.ndarray
_WIDTH = 100
#: Rows of a table in a notebook.
_MOST_ROWS = 10
#: Values of a parameter that are told one by one.
_FEW_VALUES = 4


@dataclass(frozen=True, eq=False, repr=False)
class Table(Frozen):
    """Parameters and results of variants; see `flexact.sweep`.

    A column is an attribute, `table.under_constrained`, or goes by its name, `table["angle"]`: a
    read-only array of (variants,). A row is a dictionary, `table[3]`, and
    `table[table.margin < 1e-5]` is the table of some rows. What a row has not is NaN, -1 of whole
    numbers, or empty. A parameter called like a method, such as "plot", goes by its name alone.

    Attributes:
        columns: The names of the columns in their order: parameters, then results.
        arrays: The columns, (variants,) each.
        parameter_names: Which of them are parameters.
        want: What was asked for of each variant.
        motions: Of each variant its motions, `MotionArrays`; None if not asked for.
        self_stresses: Likewise its self-stresses, `StressArrays`.
    """

    columns: tuple[str, ...]
    arrays: tuple[Array, ...]
    parameter_names: tuple[str, ...]
    want: str
    motions: tuple[MotionArrays, ...] | None = None
    self_stresses: tuple[StressArrays, ...] | None = None
    _source: Source | None = None
    _signed: Array | None = None

    def __len__(self) -> int:
        """Number of variants."""
        return len(self.arrays[-1])

    def __getattr__(self, name: str) -> Array:
        """A column."""
        # Before there are any columns, something copies or unpickles.
        if name.startswith("_") or name not in self.__dict__.get("columns", ()):
            raise AttributeError(self._not_there(name))
        return self.arrays[self.columns.index(name)]

    def __dir__(self) -> list[str]:
        """Names of the columns, too."""
        return sorted({*object.__dir__(self), *self.columns})

    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: int) -> dict[str, Any]: ...
    @overload
    def __getitem__(self, key: slice | Sequence[int] | Array) -> Table: ...
    def __getitem__(self, key: Any) -> Any:
        """A column by its name, a row by its number from 0, or the table of some rows."""
        if isinstance(key, str):
            if key not in self.columns:
                raise KeyError(self._not_there(key))
            return self.arrays[self.columns.index(key)]
        if isinstance(key, (int, np.integer)):
            return self._row(range(len(self))[key])
        return self._taken(np.arange(len(self))[key])

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """The rows."""
        for cells in zip(*(column.tolist() for column in self.arrays), strict=True):
            yield dict(zip(self.columns, cells, strict=True))

    @property
    def is_doubtful(self) -> BoolArray:
        """(variants,) whether the rank is in doubt."""
        return np.asarray(self.certainty == Certainty.DOUBTFUL.value)

    @property
    def has_error(self) -> BoolArray:
        """(variants,) whether there is no result."""
        return np.asarray(self.error != "")

    def crossings(self, along: str | None = None, *, workers: int | None = None) -> Crossings:
        """Singular variants between neighbouring rows, found by bisection; see `Crossing`.

        Neighbours are rows that differ in one parameter alone, in the order of its values: of a
        grid along each axis. Variants of a model by positions, without such parameters, are
        neighbours in the order in which they were given; each point goes along a straight line
        between two of them. Where D(c) is square its
        smallest singular value is followed with the sign of the determinant, and bisected where
        that changes; where it only dips towards zero, or D(c) is not square, its minimum is
        sought. Two roots between the same neighbours can be missed: no finer than the rows.

        Args:
            along: The parameter along which rows are neighbours, by default each in turn; "rows",
                in the order of the rows, for parameters that change together.
            workers: So many processes at most; by default one a processor.

        Raises:
            FlexactError: nobody knows how to make variants between the rows.
            ValueError: there is no such parameter, or no row has a neighbour.
        """
        return crossings_of(self, self._known_source(), self._signed, along, workers)

    def plot(
        self,
        x: str | None = None,
        y: str | None = None,
        *,
        crossings: bool | Crossings = True,
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """The variants as a picture: a curve over one parameter, or a map of two.

        Verdicts are told by colours, singular places between the rows by lines; doubtful rows and
        errors are marked.

        Args:
            x: The parameter along the picture; by default the first that varies.
            y: Another parameter, for a map, or a column of the results, for a curve of it. By
                default the second parameter that varies; without one, the smallest singular
                value and the margin.
            crossings: Whether singular places are sought, or those that were found. They are not
                sought unasked between more than 20,000 rows, or where no parameter varies.
            path: A file to write, too: .png, .svg or .pdf.

        Raises:
            FlexactError: matplotlib is missing, or the file cannot be written.
            KeyError: there is no such column.
            ValueError: it holds no numbers.
        """
        x, y = chosen(self, x, y)
        found = Crossings((), 0)
        if isinstance(crossings, Crossings):
            found = crossings
        elif crossings and len(self) <= MOST_SEARCHED and varying(self):
            # There are none where rows have no neighbours.
            with suppress(ValueError, FlexactError):
                found = self.crossings()
        if x is not None and y in self.parameter_names:
            made = parameter_map(self, x, str(y), found)
        else:
            made = curve(self, x, y, found)
        return finished(made, path, in_short(self), self.describe())

    def model(self, variant: int | Crossing) -> Model:
        """The model of a row, by its number from 0, or of a singular variant between rows.

        Raises:
            FlexactError: the table does not know how its variants were made, or the model is
                wrong.
            IndexError: there is no such row.
            Exception: whatever the function raises that makes the models.
        """
        source = self._known_source()
        if isinstance(variant, Crossing):
            a, b, share, parameters = *variant.rows, variant.share, variant.parameters
        else:
            a = b = range(len(self))[variant]
            own, share = self._row(a), 0.0
            parameters = {name: own[name] for name in self.parameter_names}
        return Model.from_data(variant_of(source, a, b, share, parameters))

    def describe(self) -> str:
        """What the variants are, and where the margin is smallest, in plain English."""
        of = ", ".join(f"{name} ({_values(self[name])})" for name in self.parameter_names)
        lines = [f"{_counted(len(self), 'variant')}{' of ' * bool(of)}{of}."]
        for words, count in counts_of(self):
            lines.append(f"{_capital(words)}: {share_in_words(count, len(self))}.")
        lines += _smallest(self)
        if (wrong := np.flatnonzero(self.has_error)).size:
            first = int(wrong[0])
            lines.append(f"First error, {row_in_words(self, first)}: {self.error[first]}")
        return "\n".join(
            textwrap.fill(harmless(line), _WIDTH, subsequent_indent="  ", break_long_words=False)
            for line in lines
        )

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the table as CSV, whole or not at all.

        Raises:
            FlexactError: it cannot be written.
        """
        self._write(Path(path), ".csv")

    def to_jsonl(self, path: str | os.PathLike[str]) -> None:
        """Write it as JSON Lines, an object a row; numbers that are not finite are null.

        Raises:
            FlexactError: it cannot be written.
        """
        self._write(Path(path), ".jsonl")

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Write it as Parquet.

        Raises:
            FlexactError: it cannot be written, or pyarrow is missing.
        """
        self._write(Path(path), ".parquet")

    def to_pandas(self) -> Any:
        """The table as a DataFrame of pandas.

        Raises:
            FlexactError: pandas is missing.
        """
        try:
            pandas = load("pandas")
        except ImportError:
            raise FlexactError("a DataFrame needs the package pandas: pip install pandas") from None
        return pandas.DataFrame(dict(zip(self.columns, self.arrays, strict=True)))

    def __repr__(self) -> str:
        """Size and verdicts in a line."""
        return f"<Table: {in_short(self)}>"

    def _repr_html_(self) -> str:
        heads = "".join(f"<th>{escape(harmless(name))}</th>" for name in self.columns)
        first = (self[k].values() for k in range(min(len(self), _MOST_ROWS)))
        cells = ("".join(f"<td>{escape(harmless(_value(v)))}</td>" for v in row) for row in first)
        rows = "".join(f"<tr>{each}</tr>" for each in cells)
        left = len(self) - _MOST_ROWS
        more = f"<p>and {_counted(left, 'further row')}</p>" if left > 0 else ""
        return (
            f"<div><pre>{escape(self.describe())}</pre><table><thead><tr>{heads}</tr></thead>"
            f"<tbody>{rows}</tbody></table>{more}</div>"
        )

    def __reduce__(self) -> tuple[Callable[..., object], tuple[Any, ...]]:
        """Without the function that made the variants, where it cannot be pickled."""
        if callable(self._source):
            try:
                pickle.dumps(self._source)
            except Exception:
                return replace(self, _source=None).__reduce__()
        return super().__reduce__()

    def _known_source(self) -> Source:
        if self._source is None:
            raise FlexactError(
                "this table does not know how its variants were made: it was read from a pickle, "
                "and the function could not be kept. Sweep again"
            )
        return self._source

    def _row(self, index: int) -> dict[str, Any]:
        cells = (column[index : index + 1].tolist()[0] for column in self.arrays)
        return dict(zip(self.columns, cells, strict=True))

    def _taken(self, index: Array) -> Table:
        changed: dict[str, Any] = {"arrays": tuple(column[index] for column in self.arrays)}
        for name in ("motions", "self_stresses"):
            modes = getattr(self, name)
            changed[name] = None if modes is None else tuple(modes[k] for k in index.tolist())
        if isinstance(self._source, Positions):
            changed["_source"] = self._source.taken(index)
        if self._signed is not None:
            changed["_signed"] = self._signed[index]
        return replace(self, **changed)

    def _not_there(self, name: str) -> str:
        known = self.__dict__.get("columns", ())
        of = next((column for column in COLUMNS if column.name == name), None)
        if of is not None:
            return f"{name} is there from want={of.least!r} on; this table has less"
        return f"the table has no column {name!r}; it has {', '.join(known)}"

    def _write(self, path: Path, suffix: str) -> None:
        if path.suffix.lower() != suffix:
            raise FlexactError(f"{path} must have the suffix {suffix}")
        columns = [
            _column_of(name, array) for name, array in zip(self.columns, self.arrays, strict=True)
        ]
        write_table(path, columns, (tuple(row.values()) for row in self))


def _column_of(name: str, array: Array) -> Column:
    """What the writers are told of a column; those of results they know."""
    kind = {"b": bool, "i": int, "f": float}.get(array.dtype.kind, str)
    known = (column for column in (*COLUMNS, ERROR) if column.name == name)
    return next(known, Column(name, kind, "parameter", "verdict"))


def in_short(table: Table) -> str:
    """Size and verdicts in a line."""
    told = [f"{count} {words}" for words, count in counts_of(table)]
    return f"{_counted(len(table), 'variant')}{': ' * bool(told)}{', '.join(told)}"


def counts_of(table: Table) -> list[tuple[str, int]]:
    """Each verdict that there is, what is doubtful, and errors, with how many rows have it."""
    every = [(each.value, int((table.verdict == each.value).sum())) for each in Verdict]
    every += [("doubtful, of these", int(table.is_doubtful.sum()))]
    every += [("with an error", int(table.has_error.sum()))]
    return [each for each in every if each[1]]


def row_in_words(table: Table, row: int) -> str:
    """A row by its number, and by its parameters."""
    told = ", ".join(f"{name} {_value(table[row][name])}" for name in table.parameter_names)
    return f"variant {row}{': ' * bool(told)}{told}"


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


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'s' * (count != 1)}"


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]
