# SPDX-License-Identifier: BSD-3-Clause
"""Layouts of a hinge from 2,000 candidate lines, side by side with dense decompositions.

    OPENBLAS_NUM_THREADS=1 .venv/bin/python tests/benchmarks/designs.py

The first layout, and ten that are verified by the analysis and scored, once libraries are loaded;
wanted on one core: half a second and two seconds. Each is told in seconds and as a multiple of one
numpy.linalg.svd of a matrix of 570 x 570, which takes turns with it. With `--refine` also how many
designs the cross hinge of SPACAR Light's example takes to 27.9 Hz, for some seeds.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from pathlib import Path

import numpy as np

import flexact

ROOT = Path(__file__).resolve().parents[2]
PROBLEM = ROOT / "input_decks" / "designs" / "mirror_hinge.toml"
DENSE = 570


def by_numpy() -> float:
    """One dense decomposition."""
    matrix = np.random.default_rng(0).standard_normal((DENSE, DENSE))
    start = time.perf_counter()
    np.linalg.svd(matrix)
    return time.perf_counter() - start


def layouts(path: Path) -> tuple[float, float, flexact.Designs]:
    """Seconds until the first layout, until all, and these."""
    start = time.perf_counter()
    first: list[float] = []
    found = flexact.design(path, show=lambda _: first.append(time.perf_counter() - start))
    return first[0], time.perf_counter() - start, found


def hinge(H: float, B: float, w: float, t: float) -> flexact.Model:  # noqa: N803
    """The cross hinge of SPACAR Light's example, with a body of 1 kg."""
    model = flexact.Model(name="cross hinge")
    made = model.cross_hinge(
        *([(0, 0, 0), (B, 0, 0)], [(B, H, 0), (0, H, 0)], "z", "hinge"),
        section=(w, t),
        material={"E": 210e9, "G": 70e9, "density": 7800},
        mass=1,
        inertia=(1e-3, 1e-3, 1e-3),
    )
    model.fix(*made.ground)
    model.independent("hinge body", "rz")
    return model


def refined(seed: int) -> tuple[int, int, float]:
    """After how many designs 27.9 Hz is passed, how many there were, and the best [Hz]."""
    found = flexact.refine(
        hinge,
        vary={"H": (0.02, 0.15), "B": (0.02, 0.15), "w": (0.005, 0.05), "t": (0.2e-3, 1e-3)},
        maximise="first parasitic frequency",
        at="end of stroke",
        stroke=0.5,
        stress=300e6,
        moment=2.5,
        seed=seed,
    )
    passed = [k for k, e in enumerate(found.evaluations, 1) if e.is_feasible and e.objective > 27.9]
    return passed[0] if passed else 0, len(found.evaluations), found.value


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("problem", nargs="?", type=Path, default=PROBLEM)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--refine", action="store_true")
    given = parser.parse_args()
    if os.environ.get("OPENBLAS_NUM_THREADS") != "1":
        parser.error("set OPENBLAS_NUM_THREADS=1: one thread is compared with one thread")
    layouts(given.problem)
    taken: list[tuple[float, float, float]] = []
    for _ in range(given.rounds):
        before = by_numpy()
        first, whole, found = layouts(given.problem)
        taken.append((first, whole, (before + by_numpy()) / 2))
    counts = ", ".join(f"{n} {kind}" for kind, n in found.candidates.items())
    print(f"{len(found)} layouts from {counts} candidates, medians of {given.rounds} rounds")
    print(f"| until | seconds | times svd, n = {DENSE} |")
    print("|---|---|---|")
    for k, what in enumerate(("the first layout", "all, verified and scored")):
        second = statistics.median(each[k] for each in taken)
        ratio = statistics.median(each[k] / each[2] for each in taken)
        print(f"| {what} | {second:.2f} | {ratio:.1f} |")
    for seed in range(3) if given.refine else ():
        passed, total, best = refined(seed)
        print(f"seed {seed}: 27.9 Hz after {passed} designs; {best:.3f} Hz after {total}")


if __name__ == "__main__":
    main()
