# SPDX-License-Identifier: BSD-3-Clause
"""Scatter of the two-sheet guide: clamps and thicknesses, 10,000 samples with their indices.

    .venv/bin/python tests/benchmarks/scatter.py [--samples 10000] [--workers 2] [--stroke]

Issue 31 asks for two minutes on two processors. The time of a sample is told as a multiple, too, of
a dense numpy.linalg.eigh of as many coordinates as the mesh of 8 beams a sheet has, on one thread.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

import flexact

DECK = (
    Path(__file__).resolve().parents[2]
    / "input_decks"
    / "flexures"
    / "parallel_guide_width_as_y.dat"
)
#: Free coordinates of that mesh: 14 inner places and the body, six each.
COORDINATES = 6 * 15


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=10_000)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--stroke", action="store_true", help="and at one end of a stroke of 1 mm")
    chosen = parser.parse_args()
    model = flexact.elastic(DECK)
    begin = time.perf_counter()
    stroke = "13:x+=0..1mm" if chosen.stroke else None
    found = model.scatter(
        "20um", "0.1mrad", "5um", samples=chosen.samples, stroke=stroke, workers=chosen.workers
    )
    taken = time.perf_counter() - begin
    matrix = np.random.default_rng(0).standard_normal((COORDINATES, COORDINATES))
    with threadpool_limits(1):
        begin = time.perf_counter()
        for _ in range(50):
            np.linalg.eigh(matrix + matrix.T)
        dense = (time.perf_counter() - begin) / 50
    each = taken / chosen.samples
    print(found.opening())
    print(
        f"{chosen.samples} samples of {len(found.inputs)} inputs: {taken:.1f} s, "
        f"{1e3 * each:.2f} ms each, {each / dense:.1f} times a dense eigenproblem of {COORDINATES}"
    )


if __name__ == "__main__":
    main()
