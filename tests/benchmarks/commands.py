# SPDX-License-Identifier: BSD-3-Clause
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
from flexact.core.arrays import model_arrays
from flexact.model.data import ModelData

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


def parts_against_one() -> tuple[str, float, float]:
    """Many mechanisms in one model against as many times one alone."""
    many, one = 20, flexact.read(DECK)
    together = _side_by_side(one, many)
    times = in_turn(
        lambda: flexact.analyse(together), lambda: [flexact.analyse(one) for _ in range(many)], 50
    )
    return (f"`analyse` of {many} such mechanisms in one model against {many} alone", *times)


def carried_against_bare() -> tuple[str, float, float]:
    """A body that carries nodes which nothing else joins, against numpy's SVD of its D(c)."""
    model = flexact.Model()
    bases = [model.node(0.0, y, 0.0) for y in (0.0, 0.05)]
    stage = [model.node(0.1, y, 0.0) for y in (0.0, 0.05)]
    for base, end in zip(bases, stage, strict=True):
        model.fix(base)
        model.sheet(base, end, width=(0, 0, 1))
    for k in range(1, 100):
        model.rigid(stage[0], stage[1] if k == 1 else model.node(0.1, 0.05, 0.01 * k))
    matrix = flexact.analyse(model).dense_jacobian()
    times = in_turn(lambda: flexact.analyse(model), lambda: np.linalg.svd(matrix), 5)
    rows, columns = matrix.shape
    what = f"`analyse(model)` of a stage that carries 98 points, {rows} x {columns}"
    return (f"{what}, against `numpy.linalg.svd` of D(c)", *times)


def _side_by_side(model: flexact.Model, many: int) -> flexact.Model:
    """So many copies of a model."""
    arrays, data = model.data.arrays, model.data
    nodes, elements = arrays.node_number.size, arrays.element_number.size
    copies = {
        name: np.concatenate([array] * many, axis=-1) for name, array in arrays._asdict().items()
    }
    copies["node_number"] = np.arange(many * nodes) + 1
    copies["element_number"] = np.arange(many * elements) + 1
    shift = np.repeat(np.arange(many) * nodes, elements)
    copies["element_node"] = np.where(copies["element_node"] > 0, copies["element_node"] + shift, 0)
    names = list(data.element_names) * many
    return flexact.Model.from_data(
        ModelData(model_arrays(**copies), data.planar, f"{many} times", names)
    )
