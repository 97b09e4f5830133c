# SPDX-License-Identifier: BSD-3-Clause
"""The columns of a table of results: what each says, and when it is there.

A number that a row has not, such as the margin of a row with an error, is NaN, or -1 where it
is whole.
"""

from __future__ import annotations

from typing import NamedTuple

#: How much is to be known of each variant, from little to all.
WANTS = ("verdict", "values", "all")


class Column(NamedTuple):
    """One column."""

    name: str
    kind: type
    """str, int or float."""
    about: str
    """What it says, with its unit."""
    least: str
    """From which of `WANTS` on it is there."""


COLUMNS = (
    Column("verdict", str, "verdict; empty where there is an error", "verdict"),
    Column("under_constrained", int, "number of motions that nothing determines", "verdict"),
    Column("over_constrained", int, "number of self-stresses", "verdict"),
    Column("rank", int, "rank of D(c)", "verdict"),
    Column("certainty", str, "whether rounding or digits leave a doubt", "verdict"),
    Column("gap", float, "smallest singular value of the scaled D(c) that is not zero", "values"),
    Column("largest_zero", float, "largest that counts as zero, likewise", "values"),
    Column("smallest_singular_value", float, "smallest singular value of D(c) itself", "values"),
    Column("condition_number", float, "largest over smallest of them", "values"),
    Column(
        "margin",
        float,
        "smallest move of a node that changes the verdict [m]; infinite where none does",
        "values",
    ),
    Column(
        "margin_angle",
        float,
        "smallest turn of an element that changes it [rad]; infinite where none does",
        "values",
    ),
)
ERROR = Column("error", str, "why there is no result; empty where there is one", "verdict")


def columns_of(want: str) -> tuple[Column, ...]:
    """The columns that are there for one of `WANTS`, without that of errors.

    Raises:
        TypeError: it is no text.
        ValueError: it is none of them.
    """
    if not isinstance(want, str):
        raise TypeError(f"want must be a word, not {type(want).__name__}")
    if want not in WANTS:
        raise ValueError(f"want must be one of {', '.join(WANTS)}, not {want!r}")
    return _COLUMNS_OF[want]


_COLUMNS_OF = {
    want: tuple(c for c in COLUMNS if WANTS.index(c.least) <= k) for k, want in enumerate(WANTS)
}
