"""What a user waits for: one analysis, one command, one file, each against a yardstick.

What is compared is run in turn, A B A B, and the ratio is that of the medians, so that a slow
moment of the machine touches both.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import flexact

DECK = Path(__file__).parents[2] / "input_decks" / "paper" / "five_folded_sheets.dat"
COMMAND = (sys.executable, "-m", "flexact")


def in_turn(a: Callable[[], object], b: Callable[[], object], runs: int) -> tuple[float, float]:
    """Median times of two calls that take turns [s]."""
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(runs + 1):
        for call, record in zip((a, b), times, strict=True):
            start = time.perf_counter()
            call()
            record.append(time.perf_counter() - start)
    # The first round warms up.
    return statistics.median(times[0][1:]), statistics.median(times[1][1:])


def planar_grid(elements: int) -> str:
    """A planar grid of bars with diagonals, its joints off the lattice by random amounts."""
    side = int((elements / 3) ** 0.5) + 2
    place = np.random.default_rng(1).random((side, side, 2))
    lines: list[str] = []
    for i in range(side):
        for j in range(side):
            node = i * side + j + 1
            neighbours = [node + side] * (i < side - 1) + [node + 1] * (j < side - 1)
            neighbours += [node + side + 1] * (i < side - 1 and j < side - 1)
            lines += [f"PLTRUSS {len(lines) + k + 1} {node} {q}" for k, q in enumerate(neighbours)]
    for i in range(side):
        for j in range(side):
            x, y = (float(v) for v in (i, j) + 0.4 * place[i, j])
            lines.append(f"X {i * side + j + 1} {x!r} {y!r}")
    return "\n".join([*lines, "FIX 1", "FIX 2 2", "END", "END", ""])


def analysis_against_svd() -> tuple[str, float, float]:
    """One analysis of the 35 x 35 deck against one SVD of its matrix by numpy."""
    model = flexact.read(DECK)
    matrix = flexact.analyse(model).dense_jacobian()
    times = in_turn(lambda: flexact.analyse(model), lambda: np.linalg.svd(matrix), 2000)
    rows, columns = matrix.shape
    return (f"`analyse(model)`, {rows} x {columns}, against `numpy.linalg.svd` of D(c)", *times)


def command_against_import() -> tuple[str, float, float]:
    """The whole command against an interpreter that imports numpy."""
    times = in_turn(
        lambda: subprocess.run([*COMMAND, "analyse", DECK], check=True, capture_output=True),
        lambda: subprocess.run([sys.executable, "-c", "import numpy"], check=True),
        30,
    )
    return ('`flexact analyse DECK` against `python -c "import numpy"`', *times)


def reading_against_split() -> tuple[str, float, float]:
    """Reading a deck of 100,000 elements against splitting its text into words."""
    text = planar_grid(100_000)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "grid.dat"
        path.write_text(text)
        elements = flexact.read(path).element_numbers.size
        times = in_turn(lambda: flexact.read(path), text.split, 15)
    return (f"`read` of {elements:,} elements against `str.split` of the text", *times)
