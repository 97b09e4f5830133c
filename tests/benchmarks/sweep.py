# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps side by side with numpy's singular values of the same matrices, ready made.

    .venv/bin/python tests/benchmarks/sweep.py --variants 100000 --write

The contestants take turns, and what is told of each is the median of the rounds. With --write the
table goes to docs/sweeps.md. Nothing else should run on the machine.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

import flexact
from flexact.model.variation import with_positions
from flexact.sweeps.evaluate import scaled_jacobian

ROOT = Path(__file__).resolve().parents[2]
DECK = ROOT / "input_decks" / "flexures" / "five_wires.dat"
PAGE = ROOT / "docs" / "sweeps.md"
HEAD = "<!-- written by tests/benchmarks/sweep.py --write -->\n"
#: Misalignment of the points, of the size of their margin [m].
SPREAD = 0.005
#: Matrices that are held at a time, 50 MB of them.
CHUNK = 5_000
KNOWN = {
    "verdict": "counts, rank, certainty",
    "values": "also gap, singular values, condition number, margins",
    "all": "also motions and self-stresses",
}


KINDS = {"positions": "`sweep(model, positions=P, ", "function": "`sweep(make, parameters, "}


class Contestant(NamedTuple):
    """What is measured, and of how many variants."""

    name: str
    variants: int
    run: Callable[[int], float]
    """Seconds for so many variants."""


def positions_of(model: flexact.Model, count: int) -> np.ndarray:
    rng = np.random.default_rng(0)
    return model.positions + SPREAD * rng.standard_normal((count, *model.positions.shape))


def seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def matrices_of(model: flexact.Model, positions: np.ndarray) -> np.ndarray:
    """The scaled D(c) of each variant."""
    return np.array([scaled_jacobian(with_positions(model.data, p))[0] for p in positions])


def by_numpy(model: flexact.Model, count: int) -> float:
    """Singular values alone, of matrices that are there already; their making is not counted."""
    taken = 0.0
    positions = positions_of(model, count)
    for first in range(0, count, CHUNK):
        part = positions[first : first + CHUNK]
        ready = matrices_of(model, part)
        taken += seconds(lambda ready=ready: np.linalg.svd(ready, compute_uv=False))
    return taken


def by_positions(model: flexact.Model, count: int, want: str) -> float:
    positions = positions_of(model, count)
    return seconds(lambda: flexact.sweep(model, positions=positions, want=want))


def made(x: float) -> flexact.Model:
    """The guide of the deck, as a script makes it."""
    model = flexact.Model()
    ends = [(0.04, -0.03, 0.02), (0.04, 0.03, 0.02), (x, 0.04, 0.02), (0.04, 0, -0.02)]
    ends.append((0, 0.04, -0.02))
    for end, along in zip(ends, (0, 0, 1, 0, 1), strict=True):
        ground = tuple(p + 0.06 * (k == along) for k, p in enumerate(end))
        model.wire(ground, end)
        model.fix(ground)
    model.body([(0, 0, 0), *ends], name="stage")
    model.independent("stage", "z")
    return model


def by_function(count: int, want: str) -> float:
    parameters = {"x": np.linspace(-0.02, 0.02, count)}
    return seconds(lambda: flexact.sweep(made, parameters, want=want))


def making(count: int) -> float:
    """The function alone, in one process."""
    return seconds(lambda: [made(x).data.problems for x in np.linspace(-0.02, 0.02, count)])


def few_of(count: int) -> int:
    """So many of what is slow."""
    return max(count // 50, 1000)


def contestants(model: flexact.Model, count: int) -> list[Contestant]:
    few = few_of(count)
    every = [Contestant("numpy", count, lambda n: by_numpy(model, n))]
    for want in KNOWN:
        size = few if want == "all" else count
        every.append(
            Contestant(f"positions {want}", size, lambda n, w=want: by_positions(model, n, w))
        )
    for want in KNOWN:
        every.append(Contestant(f"function {want}", few, lambda n, w=want: by_function(n, w)))
    every.append(Contestant("making", few, making))
    return every


def memory_of(count: int) -> float:
    """Most memory of a process that sweeps by positions [MB]."""
    code = (
        "import resource, sys; sys.path.insert(0, sys.argv[1]); import sweep, flexact;"
        "m = flexact.read(sweep.DECK); sweep.by_positions(m, int(sys.argv[2]), 'values');"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    words = [sys.executable, "-c", code, str(Path(__file__).parent), str(count)]
    return int(subprocess.run(words, check=True, capture_output=True, text=True).stdout) / 1000


def table(model: flexact.Model, count: int, rounds: int) -> str:
    taken: dict[str, list[float]] = {}
    for _ in range(rounds):
        for each in contestants(model, count):
            taken.setdefault(each.name, []).append(each.run(each.variants) / each.variants)
    per_million = {name: 1e6 * statistics.median(values) for name, values in taken.items()}
    ratio = {
        name: statistics.median(a / b for a, b in zip(values, taken["numpy"], strict=True))
        for name, values in taken.items()
    }
    rows = [
        "| what | known of each variant | seconds per million | times numpy |",
        "|---|---|---|---|",
    ]
    rows.append(
        f"| numpy, `linalg.svd(compute_uv=False)` of ready matrices | singular values of D(c) "
        f"| {per_million['numpy']:.0f} | 1 |"
    )
    for kind, words in KINDS.items():
        for want, known in KNOWN.items():
            name = f"{kind} {want}"
            told = f"{words}want={want!r})`".replace("'", '"')
            rows.append(f"| {told} | {known} | {per_million[name]:.0f} | {ratio[name]:.2g} |")
    rows.append(f"| of which `make` itself, in one process | | {per_million['making']:.0f} | |")
    size = memory_of(count)
    rows.append("")
    rows.append(
        f"{count} variants by positions, of the slower ones {few_of(count)}; medians of {rounds} "
        f"rounds. A process that sweeps {count} by positions takes {size:.0f} MB at most."
    )
    return "\n".join(rows) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--variants", type=int, default=10_000)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--write", action="store_true", help=f"into {PAGE.name}")
    given = parser.parse_args()
    text = table(flexact.read(DECK), given.variants, given.rounds)
    print(text)
    if given.write:
        before, _, rest = PAGE.read_text(encoding="utf-8").partition(HEAD)
        _, _, after = rest.partition("\n## ")
        PAGE.write_text(f"{before}{HEAD}{text}\n## {after}", encoding="utf-8")


if __name__ == "__main__":
    main()
