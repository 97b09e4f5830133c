# SPDX-License-Identifier: BSD-3-Clause
"""Random models that are large enough for the sparse factor: regular, singular and nearly so."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "benchmarks"))

from assembly import Assembly, Floats, Indices  # type: ignore[import-not-found]
from families import FAMILIES as BENCHMARKS  # type: ignore[import-not-found]

from flexact import Model

Chance = np.random.Generator


def framework(chance: Chance) -> Model:
    """Random joints, about as many random bars as they need; now and then nearly in a plane."""
    joints = int(chance.integers(34, 52))
    place = chance.uniform(-1.0, 1.0, (joints, 3))
    place[:, 2] *= 10.0 ** chance.choice([0, 0, 0, -3, -6, -9])
    ring = np.column_stack([np.arange(joints), np.roll(np.arange(joints), 1)])
    pairs = chance.integers(0, joints, (8 * joints, 2))
    pairs = np.unique(np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1), axis=0)
    count = 3 * joints - int(chance.integers(0, 14)) - joints
    drawn = pairs[chance.permutation(len(pairs))[:count]]
    bars = np.unique(np.sort(np.concatenate([ring, drawn]), axis=1), axis=0)
    return _framework("framework", place, np.arange(joints) < chance.integers(1, 4), bars)


def lattice(chance: Chance) -> Model:
    """A block of a cubic lattice with about as many of its edges and diagonals as it needs; joints
    stand off it by a hair or more, so that what it lets move in its own shape nearly does.
    """
    sizes = [int(n) for n in chance.integers(3, 5, 3)]
    cells = np.stack([grid.ravel() for grid in np.indices(sizes)], axis=1)
    apart = np.sum((cells[:, None] - cells[None]) ** 2, axis=2)
    bars = np.argwhere(np.triu((apart > 0) & (apart <= 2)))
    needed = 3 * np.count_nonzero(cells[:, 2]) + int(chance.integers(-5, 15))
    bars = bars[np.any(cells[bars, 2] > 0, axis=1)]
    bars = bars[np.sort(chance.permutation(len(bars))[:needed])]
    by = 10.0 ** -float(chance.integers(1, 12))
    place = cells + by * chance.uniform(-1.0, 1.0, cells.shape)
    return _framework("lattice", place, cells[:, 2] == 0, bars)


def _framework(name: str, place: Floats, fixed: np.ndarray, bars: Indices) -> Model:
    """Bars between joints, all of which have one."""
    used, bars = np.unique(bars, return_inverse=True)
    bars = bars.reshape(-1, 2)
    assembly = Assembly()
    nodes = assembly.positions(place[used], fixed[used])
    assembly.bars(nodes[bars[:, 0]], nodes[bars[:, 1]])
    made: Model = assembly.model(name)
    return made


def _benchmark(letter: str, least: int, most: int) -> Callable[[Chance], Model]:
    def make(chance: Chance) -> Model:
        columns, seed = int(chance.integers(least, most)), int(chance.integers(1, 10**6))
        made: Model = BENCHMARKS[letter](columns, seed).model
        return made

    return make


#: The grid of bars, the same with bars removed at random, the octet lattice, stages on folded
#: sheets, and stages ever worse conditioned; and those above.
MODELS: dict[str, Callable[[Chance], Model]] = {
    "framework": framework,
    "lattice": lattice,
    "removal": _benchmark("Tb", 250, 500),
    "grid": _benchmark("T", 400, 900),
    "octet": _benchmark("O", 200, 600),
    "stages": _benchmark("B", 300, 700),
    "conditioned": _benchmark("Bx", 300, 900),
}
#: How often each comes by turns.
TURNS = (
    *("framework", "lattice", "removal", "framework", "lattice", "grid"),
    *("framework", "lattice", "removal", "octet", "stages", "conditioned"),
)


def model_of(seed: int, number: int) -> tuple[str, Model]:
    """One model and its name, always the same."""
    family = TURNS[number % len(TURNS)]
    return f"{family}-{seed}-{number}", MODELS[family](np.random.default_rng([seed, number]))
