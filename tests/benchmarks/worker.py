# SPDX-License-Identifier: BSD-3-Clause
"""One contestant on one model, in a process of its own, so that its memory can be told.

    python tests/benchmarks/worker.py FAMILY COLUMNS METHOD

METHOD is one of Flexact's, or `dgesdd`, numpy's SVD of the same matrix with both bases. Prints
a line of JSON: time [s], time and processor time of the first call, growth of the resident
memory [bytes], what was found, and the largest residual of a null vector of unit length.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
from families import FAMILIES, Case, two_bars
from matrix import Columns, scaled_jacobian
from numpy.typing import NDArray

import flexact
from flexact.analysis.verdict_words import certainty_word
from flexact.core.arrays import Basis

_T = TypeVar("_T")


class Took(NamedTuple):
    """What a call took."""

    time: float
    """Median of some calls [s]."""
    first: float
    """Of the first [s]."""
    processor: float
    """Of the first, processor time [s]."""
    memory: int
    """By how much the resident memory grew at most [bytes]."""


#: Null vectors of which the residual is computed.
_LOOKED_AT = 64
#: A call that takes less than this [s] is repeated, the first one having warmed up ...
_SHORT = 2.0
#: ... for so long [s].
_LONG_ENOUGH = 0.1
_MOST_RUNS = 9


def main() -> None:
    """Measure and print."""
    letter, columns, method = sys.argv[1:]
    case = FAMILIES[letter](int(columns))
    matrix = scaled_jacobian(case.model)
    found = _by_numpy(matrix) if method == "dgesdd" else _by_flexact(case, matrix, method)
    print(json.dumps(found))


def _by_numpy(matrix: Columns) -> dict[str, Any]:
    full = matrix.toarray()
    (u, s, vt), took = _measured(lambda: np.linalg.svd(full, full_matrices=True))
    rank = int(np.count_nonzero(s > max(full.shape) * np.finfo(float).eps * s[0]))
    motions, stresses = Basis.of_dense(vt[rank:].T), Basis.of_dense(u[:, rank:])
    return _result(took, (motions, stresses), matrix)


def _by_flexact(case: Case, matrix: Columns, method: str) -> dict[str, Any]:
    def analyse() -> flexact.Analysis:
        # A copy of the data has not been checked or counted yet.
        model = flexact.Model.from_data(replace(case.model.data))
        made = flexact.analyse(model, method=method)
        _ = made.certainty, made.gap
        return made

    # What is imported late is neither time nor memory of the analysis.
    _ = flexact.analyse(two_bars(0.1, 0.2), method=method).certainty
    analysis, took = _measured(analyse)
    raw = analysis.raw
    bases = (_scaled(raw.motions, raw.column_scale), _scaled(raw.stresses, raw.row_scale))
    found = _result(took, bases, matrix)
    found |= {"motions": analysis.under_constrained, "stresses": analysis.over_constrained}
    nearly = analysis.nearly
    found["nearly"] = None if nearly is None else list(nearly)
    found |= {"values": analysis.singular_values_given}
    return found | {"method": analysis.method, "certainty": certainty_word(analysis)}


def _scaled(basis: Basis, scale: NDArray[np.float64]) -> Basis:
    """Null vectors of D(c) as those of the scaled matrix."""
    return basis._replace(value=basis.value / scale[basis.place])


def _result(took: Took, bases: tuple[Basis, Basis], matrix: Columns) -> dict[str, Any]:
    column = np.repeat(np.arange(matrix.shape[1]), np.diff(matrix.start))
    residual = max(
        _residual(bases[0], matrix.row, column, matrix),
        _residual(bases[1], column, matrix.row, matrix),
    )
    motions, stresses = (basis.vectors for basis in bases)
    return took._asdict() | {
        "motions": motions,
        "stresses": stresses,
        "residual": residual,
    }


def _residual(
    basis: Basis, row: NDArray[np.int64], column: NDArray[np.int64], matrix: Columns
) -> float:
    largest = 0.0
    for k in range(min(basis.vectors, _LOOKED_AT)):
        vector = basis.vector(k)
        product = np.bincount(row, matrix.value * vector[column])
        largest = max(largest, float(np.linalg.norm(product) / np.linalg.norm(vector)))
    return largest


def _measured(call: Callable[[], _T]) -> tuple[_T, Took]:
    """Result, and what it took."""
    _forget_peak()
    before, busy = _memory("VmRSS:"), time.process_time()
    times: list[float] = []
    made = _timed(call, times)
    first, processor = times[0], time.process_time() - busy
    memory = _memory("VmHWM:") - before
    if times[0] < _SHORT:
        times.clear()
        while len(times) < _MOST_RUNS and sum(times) < _LONG_ENOUGH:
            made = _timed(call, times)
    return made, Took(statistics.median(times), first, processor, memory)


def _timed(call: Callable[[], _T], times: list[float]) -> _T:
    start = time.perf_counter()
    made = call()
    times.append(time.perf_counter() - start)
    return made


def _memory(name: str) -> int:
    """A line of /proc/self/status [bytes]."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(name):
            return 1024 * int(line.split()[1])
    return 0


def _forget_peak() -> None:
    """Make the highest resident memory the present one."""
    Path("/proc/self/clear_refs").write_text("5")


if __name__ == "__main__":
    main()
