# SPDX-License-Identifier: BSD-3-Clause
"""Past this machine: what larger models and larger sweeps would take, from parts measured here.

    .venv/bin/python tests/benchmarks/scaling.py sizes    # the table of docs/benchmarks.md
    .venv/bin/python tests/benchmarks/scaling.py sweep    # the table of docs/clusters.md

Sizes: each stage of the analysis and the memory grow as a power of the number of columns, which is
taken from two sizes; the third size, of which nothing was used, tests the prediction. Sweep: the
engine on two workers, which are killed and held up at random; the table has to be that of an
undisturbed run, and what each loss cost is told.
"""

from __future__ import annotations

import json
import math
import os
import random
import signal
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from trade import NAMES, answer_of, environment_of

import flexact

#: Families whose count of columns says how large they are, sizes that are measured, the size that
#: tests the prediction, and that which no machine here holds.
FAMILIES = ("T", "B", "C")
MEASURED, TESTED, PREDICTED = (100_000, 300_000), 1_000_000, 10_000_000
_LIMIT = 300.0
#: Between two looks at the stage of an analysis [s].
_LOOK = 0.005


def one(family: str, size: int) -> dict[str, Any]:
    """Processor seconds of each stage of one analysis, and the memory that it took [bytes]."""
    from dataclasses import replace

    from families import FAMILIES as MADE
    from worker import _forget_peak, _memory

    from flexact.analysis.decomposition import Asked
    from flexact.analysis.result import result_of
    from flexact.core import progress

    progress._PAUSE = _LOOK
    data = replace(MADE[family](size).model.data)
    taken: dict[str, float] = {}
    last = ["checking", time.process_time()]
    _forget_peak()
    before = _memory("VmRSS:")

    def look(stage: str, done: float) -> None:
        del done
        now = time.process_time()
        taken[last[0]] = taken.get(last[0], 0.0) + now - last[1]
        last[:] = stage, now

    found = result_of(data, Asked("sparse"), progress=look)
    look("", 1.0)
    return {
        "columns": found.columns,
        "stages": taken,
        "memory": _memory("VmHWM:") - before,
        "counts": [found.under_constrained, found.over_constrained],
    }


def power(one_at: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    """Factor and exponent of the power through two points."""
    exponent = math.log(other[1] / one_at[1]) / math.log(other[0] / one_at[0])
    return other[1] / other[0] ** exponent, exponent


def sizes() -> list[str]:
    """What 10^6 and 10^7 coordinates take, in Markdown."""
    lines = [
        "| family | columns | processor time | memory | of which grows fastest |",
        "|---|---|---|---|---|",
    ]
    for family in FAMILIES:
        call = [sys.executable, __file__, "one", family]
        found = {}
        for size in (*MEASURED, TESTED):
            answer = answer_of([*call, str(size)], environment_of(1), _LIMIT)
            if isinstance(answer, str):
                lines.append(f"| {NAMES[family]} | {size:,} | {answer} | | |")
                continue
            found[size] = answer
        small, large = (found[size] for size in MEASURED)
        stages = [name for name in large["stages"] if large["stages"][name] > 0.02]
        laws = {
            name: power(
                (small["columns"], max(small["stages"].get(name, 0.0), 1e-3)),
                (large["columns"], large["stages"][name]),
            )
            for name in stages
        }
        memory = power((small["columns"], small["memory"]), (large["columns"], large["memory"]))
        fastest = max(laws, key=lambda name: laws[name][0] * PREDICTED ** laws[name][1])
        for size in (*MEASURED, TESTED, PREDICTED):
            columns = found[size]["columns"] if size in found else size
            says = sum(factor * columns**exponent for factor, exponent in laws.values())
            held = memory[0] * columns ** memory[1]
            if size in MEASURED or size not in found:
                measured = found.get(size)
                told = sum(measured["stages"].values()) if measured else says
                kept = measured["memory"] if measured else held
                mark = "" if measured else " (predicted)"
                time_told, memory_told = f"{told:.3g} s{mark}", f"{kept / 1e9:.2g} GB{mark}"
            else:
                real = sum(found[size]["stages"].values())
                time_told = f"{real:.3g} s (predicted {says:.3g} s)"
                memory_told = (
                    f"{found[size]['memory'] / 1e9:.2g} GB (predicted {held / 1e9:.2g} GB)"
                )
            part = f"{fastest}, n^{laws[fastest][1]:.2f}" if size == PREDICTED else ""
            lines.append(
                f"| {NAMES[family]} | {columns:,} | {time_told} | {memory_told} | {part} |"
            )
            print(lines[-1], flush=True)
    return lines


#: Variants of the sweep that is disturbed; how many of them kill the worker that meets them first,
#: and how many are held up, and for how long [s].
VARIANTS, LOSSES, DELAYS, DELAY = 20_000, 20, 20, 0.5
_MARKS = "FLEXACT_MARKS"


def make(x: float, fate: str = "") -> flexact.Model:
    """A guide of two sheets; the first who makes it may be killed, or held up."""
    folder = os.environ.get(_MARKS)
    if fate and folder:
        mark = Path(folder) / f"{x:.12f}"
        if not mark.exists():
            mark.touch()
            if fate == "loss":
                os.kill(os.getpid(), signal.SIGKILL)
            time.sleep(DELAY)
    model = flexact.Model()
    for y in (0.0, 0.05):
        model.sheet((0, y, 0), (x, y, 0), "z")
        model.fix((0, y, 0))
    model.body([(x, 0, 0), (x, 0.05, 0)], name="stage")
    return model


def sweep() -> list[str]:
    """The engine with losses and delays, in Markdown."""
    chance = random.Random(7)
    lengths = np.linspace(0.08, 0.12, VARIANTS).tolist()
    chosen = chance.sample(range(VARIANTS), LOSSES + DELAYS)
    fates = {
        "undisturbed": {},
        f"{LOSSES} losses": dict.fromkeys(chosen[:LOSSES], "loss"),
        f"{DELAYS} delays of {DELAY} s": dict.fromkeys(chosen[LOSSES:], "delay"),
        "both": dict.fromkeys(chosen[:LOSSES], "loss") | dict.fromkeys(chosen[LOSSES:], "delay"),
    }
    lines = [
        "| on two workers | time that passes | more than undisturbed | rows | same table |",
        "|---|---|---|---|---|",
    ]
    plain: tuple[float, Any] | None = None
    for name, fate in fates.items():
        with tempfile.TemporaryDirectory() as folder:
            os.environ[_MARKS] = folder
            parameters = [{"x": x, "fate": fate.get(k, "")} for k, x in enumerate(lengths)]
            start = time.perf_counter()
            table = flexact.sweep(make, parameters, want="verdict", workers=2)
            taken = time.perf_counter() - start
        plain = plain or (taken, table)
        names = [column for column in table.columns if column != "fate"]
        same = all(np.array_equal(table[n], plain[1][n]) for n in names)
        told = "yes" if same else "NO"
        lines.append(
            f"| {name} | {taken:.1f} s | {taken - plain[0]:.1f} s | {len(table):,} | {told} |"
        )
        print(lines[-1], flush=True)
    return lines


def main() -> None:
    word, *rest = sys.argv[1:] or ["sizes"]
    if word == "one":
        print(json.dumps(one(rest[0], int(rest[1]))))
    elif word == "sizes":
        sizes()
    else:
        sweep()


if __name__ == "__main__":
    main()
