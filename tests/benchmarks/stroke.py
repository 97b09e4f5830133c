# SPDX-License-Identifier: BSD-3-Clause
"""Strokes of the six folded sheets, side by side with dense eigenproblems of the same size.

    OPENBLAS_NUM_THREADS=1 .venv/bin/python tests/benchmarks/stroke.py

At every point of the stroke of three designs: equilibrium, the ten lowest frequencies, and the
support stiffness. The time is told as a multiple of one scipy.linalg.eigh(K, M) with n = 570,
which takes turns with it, on one thread; and how it grows with the number of beams a sheet.
scipy is needed for this alone (the extra `bench`).
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import flexact

ROOT = Path(__file__).resolve().parents[2]
DECK = ROOT / "input_decks" / "paper" / "six_folded_sheets.dat"
#: As built, and two proven releases.
DESIGNS: tuple[list[tuple[int, int]], ...] = ([], [(21, 2)], [(1, 3)])
STROKE = 3e-3
DENSE = 570


def seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def by_scipy() -> float:
    """One dense eigenproblem; how long it takes hardly depends on the values."""
    from scipy.linalg import eigh

    rng = np.random.default_rng(0)
    stiffness, mass = (
        part @ part.T + DENSE * np.eye(DENSE) for part in rng.standard_normal((2, DENSE, DENSE))
    )
    return seconds(lambda: eigh(stiffness, mass))


def strokes(beams: int, points: int) -> None:
    for release in DESIGNS:
        model = flexact.elastic(DECK, release=release, beams=beams)
        for state in model.along(1, "z", np.linspace(-STROKE, STROKE, points)):
            state.frequencies  # noqa: B018
            state.stiffness(1)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--beams", type=int, nargs="+", default=[4, 8, 16, 32])
    parser.add_argument("--points", type=int, default=21)
    parser.add_argument("--rounds", type=int, default=5)
    given = parser.parse_args()
    if os.environ.get("OPENBLAS_NUM_THREADS") != "1":
        parser.error("set OPENBLAS_NUM_THREADS=1: one thread is compared with one thread")
    ratios: dict[int, list[float]] = {beams: [] for beams in given.beams}
    taken: dict[int, list[float]] = {beams: [] for beams in given.beams}
    strokes(1, 1)
    for _ in range(given.rounds):
        for beams in given.beams:
            dense = by_scipy()
            taken[beams].append(seconds(lambda beams=beams: strokes(beams, given.points)))
            ratios[beams].append(taken[beams][-1] / ((dense + by_scipy()) / 2))
    print(f"{len(DESIGNS)} designs x {given.points} points, medians of {given.rounds} rounds")
    print(f"| beams a sheet | seconds | times eigh(K, M), n = {DENSE} |")
    print("|---|---|---|")
    for beams in given.beams:
        second, ratio = statistics.median(taken[beams]), statistics.median(ratios[beams])
        print(f"| {beams} | {second:.2f} | {ratio:.1f} |")
    if len(given.beams) > 1:
        times = [min(taken[beams]) for beams in given.beams]
        print(f"exponent: {np.polyfit(np.log(given.beams), np.log(times), 1)[0]:.2f}")


if __name__ == "__main__":
    main()
