# SPDX-License-Identifier: BSD-3-Clause
"""How long calls take that run in turn, so that a slow moment of the machine touches all."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

#: Calls are repeated until one has taken so long altogether [s], or so many times.
_LONG_ENOUGH, _MOST_RUNS = 0.4, 7


def least_times(calls: Sequence[Callable[[], object]]) -> list[float]:
    """The shortest time of each call [s]; the first round, which warms up, counts where it is long.

    Args:
        calls: What is run, A B A B ...
    """
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(_MOST_RUNS):
        for call, known in zip(calls, times, strict=True):
            start = time.perf_counter()
            call()
            known.append(time.perf_counter() - start)
        if max(map(sum, times)) > _LONG_ENOUGH:
            break
    return [min(known) for known in times]
