# SPDX-License-Identifier: BSD-3-Clause
"""The rank of a framework of bars in exact arithmetic modulo a prime.

The row of a bar holds the differences of the coordinates of its ends. Each double is a whole
number times a power of two, so that its residue is exact. The rank modulo a prime is never
above that of the framework, and below it only where the prime divides one of its minors,
which a large prime does about once in 2**31 times.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flexact import Model
from flexact.core.elements import Class

_PRIME = 2**31 - 1
Residues = NDArray[np.int64]


def rank_of_bars(model: Model) -> int:
    """Rank of D(c) of a model of bars alone, by elimination of columns from the left.

    Columns are taken in the order of their nodes along x, so that rows stay short: for a
    grid of side k a step touches some k rows and columns.
    """
    row, column, value, columns = _entries(model)
    first = np.full(row.max(initial=-1) + 1, columns)
    np.minimum.at(first, row, column)
    rows: list[list[NDArray[np.int64]]] = [[] for _ in range(columns + 1)]
    order = np.argsort(row, kind="stable")
    ends = np.searchsorted(row[order], np.arange(first.size + 1))
    for i in range(first.size):
        part = order[ends[i] : ends[i + 1]]
        if part.size:
            rows[first[i]].append(_dense(column[part], value[part]))
    rank = 0
    for j in range(columns):
        rank += _eliminate(rows, j)
    return rank


def _eliminate(rows: list[list[Residues]], j: int) -> int:
    """Take the rows that start at column j one step on; return whether there were any."""
    here, rows[j] = rows[j], []
    if not here:
        return 0
    width = max(row.size for row in here)
    block = np.zeros((len(here), width), np.int64)
    for k, row in enumerate(here):
        block[k, : row.size] = row
    pivot = block[0] * pow(int(block[0, 0]), -1, _PRIME) % _PRIME
    rest = (block[1:] - block[1:, :1] * pivot % _PRIME) % _PRIME
    for row in rest:
        stored = np.flatnonzero(row)
        if stored.size:
            rows[j + stored[0]].append(row[stored[0] : stored[-1] + 1])
    return 1


def _dense(column: NDArray[np.int64], value: Residues) -> Residues:
    """One row from its first to its last entry."""
    made = np.zeros(column.max() - column.min() + 1, np.int64)
    made[column - column.min()] = value
    return made


def _entries(
    model: Model,
) -> tuple[NDArray[np.int64], NDArray[np.int64], Residues, int]:
    """Rows, columns and residues of the entries that are not zero, and how many columns."""
    arrays = model.data.arrays
    ends = arrays.element_node[[0, 2]].astype(np.int64) - 1
    place = _residue(arrays.node_value[:3])
    difference = (place[:, ends[0]] - place[:, ends[1]]) % _PRIME
    dependent = arrays.coordinate_class == Class.DEPENDENT
    along = np.argsort(arrays.node_value[0], kind="stable")
    number = np.empty(dependent.shape, np.int64)
    number[:, along] = (np.cumsum(dependent[:, along].T.ravel()) - 1).reshape(-1, 3).T
    bars = np.broadcast_to(np.arange(ends.shape[1]), difference.shape)
    row = np.concatenate([bars.ravel(), bars.ravel()])
    value = np.concatenate([difference.ravel(), (-difference % _PRIME).ravel()])
    column = np.concatenate([number[:, end].ravel() for end in ends])
    used = np.concatenate([dependent[:, end].ravel() for end in ends]) & (value != 0)
    return row[used], column[used], value[used], int(dependent.sum())


def _residue(numbers: NDArray[np.float64]) -> Residues:
    """Of doubles: mantissa times a power of two, each modulo the prime."""
    mantissa, exponent = np.frexp(numbers)
    whole = np.ldexp(mantissa, 53).astype(np.int64)
    # The order of 2 modulo 2**31 - 1 is 31.
    power = (1 << np.mod(exponent - 53, 31)).astype(np.int64)
    made: Residues = (whole % _PRIME) * power % _PRIME
    return made
