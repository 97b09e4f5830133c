# SPDX-License-Identifier: BSD-3-Clause
"""What sharing out work costs: two processes against one, and processor time a message.

    python tests/benchmarks/messages.py

prints what docs/clusters.md tells. Processor time is disturbed less by what else the machine
does than what a clock shows; on a busy machine the first ratio says nothing.
"""

from __future__ import annotations

import os
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "python"))

from commands import in_turn
from dask_cluster import running_cluster

from flexact.sweeps import chunks
from flexact.sweeps.running import results_of

#: Items, and what one of them takes [s].
ITEMS, SECONDS = 2000, 0.0015
#: Sizes of chunks whose cost is measured, with so many items each.
POOL = ((1, 20_000), (1000, 400_000))
DASK = ((1, 2000), (1000, 200_000))


def main() -> None:
    """Measure and print."""
    one, two = in_turn(lambda: _worked(1), lambda: _worked(2), 3)
    print(f"{ITEMS} items of 1.5 ms: two processes are {one / two / 2:.2f} of ideal against one")
    for size, items in POOL:
        chunks.MOST_ITEMS = size
        seconds = _spent(_mine, lambda items=items: _done(items, workers=2))
        print(f"local pool, chunks of {size}: {1e6 * seconds / items:.1f} us an item here")
    with (
        tempfile.TemporaryDirectory() as folder,
        running_cluster(Path(folder), workers=2) as cluster,
    ):
        assert cluster.scheduler is not None
        scheduler, workers = cluster.scheduler.pid, [process.pid for process in cluster.workers]
        whose: dict[str, Callable[[], float]] = {
            "here": _mine,
            "scheduler": lambda: _of(scheduler),
            "workers": lambda: sum(map(_of, workers)),
        }
        for size, items in DASK:
            chunks.MOST_ITEMS = size
            _done(100, executor=cluster.address)
            before = {name: spent() for name, spent in whose.items()}
            _done(items, executor=cluster.address)
            words = ", ".join(
                f"{name} {1e3 * (spent() - before[name]) * size / items:.2f} ms"
                for name, spent in whose.items()
            )
            print(f"Dask, chunks of {size}: {words} a chunk")


def _worked(workers: int) -> None:
    for _ in results_of(_busy, range(ITEMS), workers=workers):
        pass


def _busy(_: int) -> None:
    """Take processor time, which does not depend on who else wants it."""
    end = time.process_time() + SECONDS
    while time.process_time() < end:
        pass


def _done(items: int, **where: object) -> None:
    for _ in results_of(_row, range(items), **where):  # type: ignore[arg-type]
        pass


def _row(k: int) -> dict[str, object]:
    numbers = {"under": 0, "over": 0, "rank": 11, "gap": 0.1851 + k, "margin": 1e-3}
    return {"verdict": "exactly constrained", **numbers, "error": ""}


def _spent(clock: Callable[[], float], call: Callable[[], object]) -> float:
    start = clock()
    call()
    return clock() - start


def _mine() -> float:
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def _of(process: int) -> float:
    """Processor time of another process [s]."""
    words = Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / float(os.sysconf("SC_CLK_TCK"))


if __name__ == "__main__":
    main()
