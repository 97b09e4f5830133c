# SPDX-License-Identifier: BSD-3-Clause
"""One mechanism by one method: how long its analysis takes, beside numpy's SVD of its matrix."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ...analysis.decomposition import Asked
from ...analysis.result import Result, result_of
from ...model.data import ModelData
from ...model.reading import read_bytes
from ...util.errors import FlexactError
from ...util.loading import load
from ...util.plain_text import harmless
from .matrix import full_matrix
from .mechanisms import FAMILIES, Mechanism
from .timing import least_times

#: Called with what is measured now, and which part of all is done.
Progress = Callable[[str, float], None]


class Case(NamedTuple):
    """What is measured: a family of mechanisms, its size, and the method."""

    family: str
    side: int
    method: str


#: In half a minute on two cores of 2020 or so, and in a few seconds.
CASES = (
    *(Case("stages", side, "svd") for side in (2, 4, 6)),
    *(Case("bars", side, "svd") for side in (5, 7)),
    *(Case("stages", side, "sparse") for side in (6, 20, 40)),
    *(Case("bars", side, "sparse") for side in (7, 14, 20)),
)
QUICK = (
    *(Case("stages", side, "svd") for side in (2, 4)),
    Case("bars", 5, "svd"),
    Case("stages", 10, "sparse"),
    Case("bars", 7, "sparse"),
)
#: Of the rows and columns up to which numpy's SVD runs beside.
_MOST_OF_SVD = 1500
#: Part of the work of a case, which grows so with its columns.
_POWERS = {"svd": 2.2, "sparse": 1.2}


@dataclass(frozen=True)
class Measurement:
    """What was measured.

    Attributes:
        mechanism: What it is, in words.
        rows: Of D(c).
        columns: Likewise.
        method: How it was decomposed.
        seconds: Of the analysis, by the number of threads; the shortest of some runs.
        svd_seconds: Of numpy's SVD of the same matrix with both bases, likewise; empty where it
            was too large for that.
        counts_are_right: Whether motions and self-stresses are those of the construction.
        error: Why there are no times, in words; empty where there are.
    """

    mechanism: str
    rows: int
    columns: int
    method: str
    seconds: dict[int, float]
    svd_seconds: dict[int, float]
    counts_are_right: bool = True
    error: str = ""

    @property
    def ratio(self) -> float | None:
        """The analysis to numpy's SVD, on one thread; None without an SVD."""
        least = min(self.svd_seconds, default=None)
        return None if least is None else self.seconds[least] / self.svd_seconds[least]

    def to_dict(self) -> dict[str, Any]:
        """The entries of the JSON, as `docs/bench.schema.json` says."""
        made = asdict(self)
        for name in ("seconds", "svd_seconds"):
            made[name] = {str(threads): value for threads, value in made[name].items()}
        return {**made, "ratio": self.ratio}


def measure(
    cases: Sequence[Case], threads: Sequence[int], progress: Progress
) -> Iterator[Measurement]:
    """Measure case after case.

    Args:
        cases: What is measured.
        threads: Numbers of threads, ascending.
        progress: Called before each piece of work.
    """
    work = [_columns(case) ** _POWERS[case.method] for case in cases]
    for k, case in enumerate(cases):
        part = partial(_part, progress, sum(work[:k]) / sum(work), work[k] / sum(work))
        yield _measured(FAMILIES[case.family](case.side), case.method, threads, part)


def _part(progress: Progress, before: float, whole: float, name: str, done: float) -> None:
    """Say how far all is, where a part of it is so far."""
    progress(name, before + done * whole)


def _columns(case: Case) -> float:
    return 24.0 * case.side**2 if case.family == "stages" else 3.0 * case.side**3


def _measured(
    mechanism: Mechanism, method: str, threads: Sequence[int], progress: Progress
) -> Measurement:
    data = read_bytes(mechanism.deck, mechanism.name)
    count = data.count
    made = Measurement(mechanism.name, count.rows, count.columns, method, {}, {})
    try:
        full = full_matrix(data) if max(count.rows, count.columns) <= _MOST_OF_SVD else None
        for k, number in enumerate(threads):
            progress(f"{mechanism.name}, {method}", k / len(threads))
            with _threads(number):
                calls: list[Callable[[], object]] = [lambda: _analysed(data, method)]
                if full is not None:
                    calls.append(partial(np.linalg.svd, full))
                own, *svd = least_times(calls)
            made.seconds[number] = own
            made.svd_seconds.update(zip((number,), svd, strict=False))
        result = _analysed(data, method)
    except (FlexactError, MemoryError) as error:
        words = harmless(str(error) or "not enough memory").splitlines()[0]
        return replace(made, seconds={}, svd_seconds={}, error=words)
    counts = result.under_constrained, result.over_constrained
    right = counts == (mechanism.motions, mechanism.self_stresses)
    return replace(made, method=result.method, counts_are_right=right)


def _analysed(data: ModelData, method: str) -> Result:
    """A whole analysis; of a copy, of which nothing is known yet."""
    result: Result = result_of(replace(data), Asked(method=method))
    _ = result.certainty, result.margin
    return result


def _threads(number: int) -> AbstractContextManager[Any]:
    limits: AbstractContextManager[Any] = load("threadpoolctl").threadpool_limits(number)
    return limits
