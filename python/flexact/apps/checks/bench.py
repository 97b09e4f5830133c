# SPDX-License-Identifier: BSD-3-Clause
"""One mechanism by one method: how long its analysis takes, beside numpy's SVD of its matrix."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from ...analysis.decomposition import Asked
from ...analysis.result import Result, result_of
from ...core.arrays import FloatArray
from ...core.elements import Class
from ...model.data import ModelData
from ...model.handles import Node
from ...model.jacobian import jacobian
from ...model.model import Model
from ...util.errors import FlexactError
from ...util.loading import load
from ...util.text import harmless


def full_matrix(model: Model) -> FloatArray:
    """D(c): derivatives of fixed and independent deformations to dependent coordinates."""
    a = model.data.arrays
    rows, columns = (
        each.T[each.T != Class.NONE] for each in (a.deformation_class, a.coordinate_class)
    )
    held = np.isin(rows, (Class.FIXED, Class.INDEPENDENT))
    full = jacobian(model).toarray()[held][:, columns == Class.DEPENDENT]
    return np.ascontiguousarray(full)


#: A mechanism, and what its construction says of it: its name, the numbers of its motions and of
#: its self-stresses.
Mechanism = tuple[Model, str, int, int]
#: Between neighbouring stages, the length of a leaf of a folded sheet, and a step in height [m].
_PITCH, _LEAF, _HEIGHT = 0.3, 0.1, 0.02
#: Steps of the lattice of bars [m]: no two are at right angles, so that all is coupled.
_STEPS = np.array([(1.0, 0.2, 0.1), (0.1, 1.0, 0.2), (0.2, 0.1, 1.0)])


def stages(side: int) -> Mechanism:
    """An array of `side` by `side` stages on folded sheets, exactly constrained.

    Three folded sheets from the ground hold a stage along z, so that it is left in its plane.
    There a link to the neighbour on the left holds it along x and against rotation, and one to the
    neighbour below along y; the first ones are held by the ground. Stage after stage, six
    constraints hold six coordinates. What a folded sheet can do inside is declared.
    """
    model = Model()

    def held(place: tuple[float, float, float]) -> Node:
        """A point of the ground."""
        node = model.node(place)
        model.fix(node)
        return node

    ground = {}
    centre = {(i, j): model.node(_at(i, j)) for i in range(side) for j in range(side)}
    for k in range(side):
        ground[-1, k] = held(_at(-1, k))
        ground[k, -1] = held(_at(k, -1))
    for (i, j), here in centre.items():
        x, y, z = _at(i, j)
        for dx, dy in ((1.0, 0.0), (-0.5, 0.8660254), (-0.5, -0.8660254)):
            fold = model.node(x + _LEAF * dx, y + _LEAF * dy, z)
            foot = held((x + _LEAF * (dx - dy), y + _LEAF * (dy + dx), z))
            model.independent(model.beam(foot, fold, (dx, dy, 0.0), (2, 5)), 6)
            model.beam(fold, here, (-dy, dx, 0.0), (2, 5, 6))
        beside = centre.get((i - 1, j)) or ground[i - 1, j]
        below = centre.get((i, j - 1)) or ground[i, j - 1]
        model.beam(beside, here, (0.0, 1.0, 0.0), (2, 3, 4, 5))
        model.beam(below, here, (1.0, 0.0, 0.0), (2, 3, 4, 5, 6))
    return model, f"{side * side} stages on folded sheets", 0, 0


def bars(side: int) -> Mechanism:
    """A skew lattice of bars with `side`^3 joints, one motion and one self-stress.

    Three bars hold each joint to the one before it in each direction, and to the ground at the
    first ones. One bar is left out at the last joint, a motion; and one more joins two joints that
    are held already, a self-stress.
    """
    model = Model()
    # Joints of the lattice, and those on the ground before its first ones.
    every = product(range(-1, side), repeat=3)
    joints = [index for index in every if sum(c < 0 for c in index) <= 1]
    node = {
        index: model.node(
            [sum(c * s[k] for c, s in zip(index, _STEPS, strict=True)) for k in range(3)]
        )
        for index in joints
    }
    for index in joints:
        if min(index) < 0:
            model.fix(node[index])
            continue
        for axis in range(3):
            i, j, k = index
            before = (i - (axis == 0), j - (axis == 1), k - (axis == 2))
            if not (axis == 2 and index == (side - 1,) * 3):
                model.truss(node[before], node[index])
    model.truss(node[0, 0, 0], node[1, 1, 0])
    return model, f"{side**3} joints on bars", 1, 1


def _at(i: int, j: int) -> tuple[float, float, float]:
    """Where a stage is; no two neighbours at one height, so that links couple all their motions."""
    return _PITCH * i, _PITCH * j, _HEIGHT * ((2 * i + 3 * j) % 5)


#: By the word that a measurement has.
FAMILIES: dict[str, Callable[[int], Mechanism]] = {"stages": stages, "bars": bars}


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


#: Called with what is measured now, and which part of all is done.
Progress = Callable[[str, float], None]


#: What is measured: a family of mechanisms, its size, and the method.
Case = tuple[str, int, str]
#: In half a minute on two cores of 2020 or so, and in a few seconds.
CASES: tuple[Case, ...] = (
    *(("stages", side, "svd") for side in (2, 4, 6)),
    *(("bars", side, "svd") for side in (5, 7)),
    *(("stages", side, "sparse") for side in (6, 20, 40)),
    *(("bars", side, "sparse") for side in (7, 14, 20)),
)
QUICK: tuple[Case, ...] = (
    *(("stages", side, "svd") for side in (2, 4)),
    *(("bars", 5, "svd"), ("stages", 10, "sparse"), ("bars", 7, "sparse")),
)
#: Of the rows and columns up to which numpy's SVD runs beside.
_MOST_OF_SVD = 1500
#: Part of the work of a case, which grows so with its columns.
_POWERS = {"svd": 2.2, "sparse": 1.2}


@dataclass(frozen=True)
class Measurement:
    """What was measured.

    Attributes:
        mechanism: What it is, in words.
        rows: Of D(c).
        columns: Likewise.
        method: How it was decomposed.
        seconds: Of the analysis, by the number of threads; the shortest of some runs.
        svd_seconds: Of numpy's SVD of the same matrix with both bases, likewise; empty where it
            was too large for that.
        counts_are_right: Whether motions and self-stresses are those of the construction.
        error: Why there are no times, in words; empty where there are.
    """

    mechanism: str
    rows: int
    columns: int
    method: str
    seconds: dict[int, float]
    svd_seconds: dict[int, float]
    counts_are_right: bool = True
    error: str = ""

    @property
    def ratio(self) -> float | None:
        """The analysis to numpy's SVD, on one thread; None without an SVD."""
        least = min(self.svd_seconds, default=None)
        return None if least is None else self.seconds[least] / self.svd_seconds[least]

    def to_dict(self) -> dict[str, Any]:
        """The entries of the JSON, as `docs/bench.schema.json` says."""
        made = asdict(self)
        for name in ("seconds", "svd_seconds"):
            made[name] = {str(threads): value for threads, value in made[name].items()}
        return {**made, "ratio": self.ratio}


def measure(
    cases: Sequence[Case], threads: Sequence[int], progress: Progress
) -> Iterator[Measurement]:
    """Measure case after case.

    Args:
        cases: What is measured.
        threads: Numbers of threads, ascending.
        progress: Called before each piece of work.
    """
    columns = {"stages": lambda side: 24.0 * side**2, "bars": lambda side: 3.0 * side**3}
    work = [columns[family](side) ** _POWERS[method] for family, side, method in cases]
    for k, (family, side, method) in enumerate(cases):
        before, whole = sum(work[:k]) / sum(work), work[k] / sum(work)

        def part(name: str, done: float, before: float = before, whole: float = whole) -> None:
            """Say how far all is, where this case is so far."""
            progress(name, before + done * whole)

        yield _measured(FAMILIES[family](side), method, threads, part)


def _measured(
    mechanism: Mechanism, method: str, threads: Sequence[int], progress: Progress
) -> Measurement:
    model, name, *wanted = mechanism
    data = model.data
    count = data.count
    made = Measurement(name, count.rows, count.columns, method, {}, {})
    try:
        full = full_matrix(model) if max(count.rows, count.columns) <= _MOST_OF_SVD else None
        for k, number in enumerate(threads):
            progress(f"{name}, {method}", k / len(threads))
            with load("threadpoolctl").threadpool_limits(number):
                calls: list[Callable[[], object]] = [lambda: _analysed(data, method)]
                if full is not None:
                    calls.append(partial(np.linalg.svd, full))
                own, *svd = least_times(calls)
            made.seconds[number] = own
            made.svd_seconds.update(zip((number,), svd, strict=False))
        result = _analysed(data, method)
    except (FlexactError, MemoryError) as error:
        words = harmless(str(error) or "not enough memory").splitlines()[0]
        return replace(made, seconds={}, svd_seconds={}, error=words)
    right = [result.under_constrained, result.over_constrained] == wanted
    return replace(made, method=result.method, counts_are_right=right)


def _analysed(data: ModelData, method: str) -> Result:
    """A whole analysis; of a copy, of which nothing is known yet."""
    result: Result = result_of(replace(data), Asked(method=method))
    _ = result.certainty, result.margin
    return result


_NAME, _SIZE, _TIME = 29, 13, 12


def head(threads: Sequence[int]) -> str:
    """The first line."""
    times = [f"{number} thread{'s' * (number > 1)}" for number in threads]
    heads = "".join(f"{text:>{_TIME}}" for text in (*times, "numpy's SVD", "ratio"))
    return f"{'mechanism':{_NAME}}{'D(c)':>{_SIZE}}  method{heads}"


def line(made: Measurement, threads: Sequence[int]) -> str:
    """The line of a measurement."""
    size = f"{made.rows} x {made.columns}"
    start = f"{made.mechanism:{_NAME}}{size:>{_SIZE}}  {made.method:6}"
    if made.error:
        return f"{start} {made.error}"
    first = threads[0]
    times = [_time(made.seconds[number]) for number in threads]
    svd = _time(made.svd_seconds[first]) if made.svd_seconds else "-"
    ratio = f"{made.ratio:.2f}" if made.ratio is not None else "-"
    wrong = "" if made.counts_are_right else "  WRONG COUNTS"
    return start + "".join(f"{text:>{_TIME}}" for text in (*times, svd, ratio)) + wrong


def _time(seconds: float) -> str:
    return f"{seconds * 1e3:.3g} ms" if seconds < 1.0 else f"{seconds:.3g} s"
