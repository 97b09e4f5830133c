# SPDX-License-Identifier: BSD-3-Clause
"""Measurements as lines of a table, one after the other as they come."""

from __future__ import annotations

from collections.abc import Sequence

from .bench import Measurement

_NAME, _SIZE, _TIME = 29, 13, 12


def head(threads: Sequence[int]) -> str:
    """The first line."""
    times = [f"{number} thread{'s' * (number > 1)}" for number in threads]
    heads = "".join(f"{text:>{_TIME}}" for text in (*times, "numpy's SVD", "ratio"))
    return f"{'mechanism':{_NAME}}{'D(c)':>{_SIZE}}  method{heads}"


def line(made: Measurement, threads: Sequence[int]) -> str:
    """The line of a measurement."""
    size = f"{made.rows} x {made.columns}"
    start = f"{made.mechanism:{_NAME}}{size:>{_SIZE}}  {made.method:6}"
    if made.error:
        return f"{start} {made.error}"
    first = threads[0]
    times = [_time(made.seconds[number]) for number in threads]
    svd = _time(made.svd_seconds[first]) if made.svd_seconds else "-"
    ratio = f"{made.ratio:.2f}" if made.ratio is not None else "-"
    wrong = "" if made.counts_are_right else "  WRONG COUNTS"
    return start + "".join(f"{text:>{_TIME}}" for text in (*times, svd, ratio)) + wrong


def _time(seconds: float) -> str:
    return f"{seconds * 1e3:.3g} ms" if seconds < 1.0 else f"{seconds:.3g} s"
