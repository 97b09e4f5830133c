# SPDX-License-Identifier: BSD-3-Clause
"""Speed against accuracy: every method and the peers on families of growing size.

A contestant runs in a process of its own (worker.py, peers.c), on one thread. The contestants
of one model take turns, and what is kept is the median of the rounds.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import peers
from exact_rank import rank_of_bars
from families import FAMILIES, Case
from matrix import scaled_jacobian

import flexact
from flexact.analysis.verdict_words import certainty_word
from flexact.apps.cli.decks import TRADES
from flexact.core.calls import METHODS

HERE = Path(__file__).parent
NAMES = {
    "T": "bar grid",
    "O": "octet lattice",
    "B": "array of stages",
    "C": "separate chains",
    "Tb": "random removal",
    "Bx": "amplifying array",
}
SIZES = (100, 300, 1000, 3000, 10_000, 30_000, 100_000, 300_000)
#: Largest size of each family; the lattice costs most, and random removal has more motions
#: than a bare peer can hold. Bx is there for its verdicts.
_LARGEST = {"O": 100_000, "Tb": 100_000, "Bx": 30_000}
#: Largest size at which a method runs, and larger ones of single families. Beyond, `auto` is
#: `sparse`.
_UP_TO = {"dgesdd": 1000, "svd": 1000, "jacobi": 1000, "sparse": 3000}
_UP_TO_OF = {
    ("dgesdd", "T"): 3000,
    ("dgesdd", "B"): 3000,
    ("dgesdd", "C"): 3000,
    ("svd", "B"): 3000,
}
PEERS = tuple(
    f"{method} {order}" for method in ("QR", "Cholesky") for order in ("METIS", "default")
)
#: Up to here both orderings run; beyond, the one that was faster before.
_BOTH_ORDERINGS = 10_000
#: Self-stresses that grow with the size are not asked of the peers, which cannot hold them.
_MANY_STRESSES = ("T", "O")
_ROUNDS = 2
#: No further round starts after so long [s].
_PATIENCE = 3.0
#: Longest time of a contestant [s].
_LIMIT = 150.0
#: Largest size of random removal at which the exact rank is computed.
_EXACT = 30_000


@dataclass(frozen=True)
class Outcome:
    """What a contestant gave on one model; medians over the rounds."""

    family: str
    size: int
    rows: int
    columns: int
    contestant: str
    seconds: float
    memory: float
    motions: int
    stresses: int
    residual: float
    method: str
    certainty: str
    values: str
    """Which singular values it gives: all, or the smallest."""
    nearly: tuple[int, int] | None
    truth: tuple[int, int] | None

    @property
    def right(self) -> bool | None:
        """Whether the counts are those known; None where none are known, or none were given."""
        if self.truth is None or self.motions < 0:
            return None
        return self.motions == self.truth[0] and self.stresses in (-1, self.truth[1])


def outcomes(sizes: tuple[int, ...] = SIZES) -> list[Outcome]:
    """All measurements; what is under way is printed."""
    made: list[Outcome] = []
    with tempfile.TemporaryDirectory() as folder:
        program = peers.compiled(Path(folder))
        if program is None:
            print("SuiteSparse's headers or a C compiler are missing: no peers", flush=True)
        for family in FAMILIES:
            orderings: dict[str, str] = {}
            for size in sizes:
                if size <= _LARGEST.get(family, sizes[-1]):
                    found = list(_on_one_model(family, size, program, Path(folder), orderings))
                    made += found
                    _remember_orderings(found, orderings)
    return made


def _on_one_model(
    family: str, size: int, program: Path | None, folder: Path, orderings: dict[str, str]
) -> Iterator[Outcome]:
    case = FAMILIES[family](size)
    truth = _truth(family, size, case)
    calls = dict(_flexact_calls(family, size))
    if program is not None and size >= 300:
        scaled_jacobian(case.model).write(folder / "matrix")
        side = "motions" if family in _MANY_STRESSES else "both"
        for peer in _peers_at(size, orderings):
            method, order = peer.lower().split()
            calls[peer] = [str(program), str(folder / "matrix"), method, order, side]
    for contestant, found in _in_turn(calls).items():
        yield _outcome(family, size, case, contestant, found, truth)
        print(_line(family, size, contestant, found), flush=True)


def _line(family: str, size: int, contestant: str, found: list[dict[str, Any]]) -> str:
    seconds = statistics.median(one["time"] for one in found)
    return f"{family:3s}{size:8d} {contestant:17s}{seconds:10.4f} s"


def _truth(family: str, size: int, case: Case) -> tuple[int, int] | None:
    if case.motions is not None and case.stresses is not None:
        return case.motions, case.stresses
    if size > _EXACT:
        return None
    rank = rank_of_bars(case.model)
    return case.columns - rank, case.rows - rank


def _flexact_calls(family: str, size: int) -> Iterator[tuple[str, list[str]]]:
    for contestant in ("dgesdd", *METHODS[1:], METHODS[0]):
        largest = _UP_TO.get(contestant, SIZES[-1])
        if family == "Bx" and size < 1000:
            continue
        if size <= _UP_TO_OF.get((contestant, family), largest):
            worker = str(HERE / "worker.py")
            yield contestant, [sys.executable, worker, family, str(size), contestant]


def _peers_at(size: int, orderings: dict[str, str]) -> tuple[str, ...]:
    if size <= _BOTH_ORDERINGS or not orderings:
        return PEERS
    return tuple(orderings.values())


def _remember_orderings(found: list[Outcome], orderings: dict[str, str]) -> None:
    """The faster ordering of each of the peers' methods."""
    for method in ("QR", "Cholesky"):
        those = [one for one in found if one.contestant.startswith(method)]
        if those:
            orderings[method] = min(those, key=lambda one: one.seconds).contestant


def _in_turn(calls: dict[str, list[str]]) -> dict[str, list[dict[str, Any]]]:
    """What each call printed, by round; a contestant that fails is left out."""
    environment = environment_of(1)
    found: dict[str, list[dict[str, Any]]] = {name: [] for name in calls}
    start = time.perf_counter()
    for _ in range(_ROUNDS):
        for name in list(found):
            answer = answer_of(calls[name], environment)
            if isinstance(answer, str):
                print(f"{name} gave no answer: {answer}", flush=True)
                del found[name]
            else:
                found[name].append(answer)
        if time.perf_counter() - start > _PATIENCE:
            break
    return {name: seen for name, seen in found.items() if seen}


def environment_of(threads: int) -> dict[str, str]:
    """So many threads for certain: some libraries take more, unless OpenMP has a limit."""
    names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT")
    return dict(os.environ, **dict.fromkeys(names, str(threads)))


def answer_of(
    call: list[str], environment: dict[str, str], limit: float = _LIMIT
) -> dict[str, Any] | str:
    """What a contestant printed, or why it did not."""
    try:
        ran = subprocess.run(
            call, env=environment, capture_output=True, text=True, timeout=limit, check=True
        )
    except subprocess.TimeoutExpired:
        return f"more than {limit:.0f} s"
    except subprocess.CalledProcessError as error:
        return (error.stderr.strip() or f"exit {error.returncode}").splitlines()[-1]
    answer: dict[str, Any] = json.loads(ran.stdout)
    return answer


def _outcome(
    family: str,
    size: int,
    case: Case,
    contestant: str,
    found: list[dict[str, Any]],
    truth: tuple[int, int] | None,
) -> Outcome:
    def median(key: str) -> float:
        return float(statistics.median(one[key] for one in found))

    first = found[0]
    nearly = first.get("nearly")
    return Outcome(
        family,
        size,
        case.rows,
        case.columns,
        contestant,
        median("time"),
        median("memory"),
        first["motions"],
        first["stresses"],
        first["residual"],
        first.get("method", contestant),
        first.get("certainty", ""),
        first.get("values", "all"),
        None if nearly is None else (nearly[0], nearly[1]),
        truth,
    )


def errors_of_smallest(cases: tuple[tuple[str, int], ...]) -> list[dict[str, Any]]:
    """Relative errors of the smallest singular value by method (smallest_value.py)."""
    methods = [*METHODS[1:], METHODS[0]]
    environment = environment_of(1)
    made = []
    for kind, size in cases:
        script = str(HERE / "smallest_value.py")
        answer = answer_of([sys.executable, script, kind, str(size), *methods], environment)
        print(f"smallest value, {kind} {size}: {answer}", flush=True)
        if not isinstance(answer, str):
            made.append(answer)
    return made


def one_of(found: list[Outcome], family: str, size: int, contestant: str) -> Outcome | None:
    """The outcome of a contestant on one model."""
    for one in found:
        if (one.family, one.size, one.contestant) == (family, size, contestant):
            return one
    return None


def best_peer(found: list[Outcome], family: str, size: int) -> Outcome | None:
    """The fastest peer that gave the null spaces; a wrong count is none."""
    those = [one for one in found if (one.family, one.size) == (family, size)]
    those = [one for one in those if one.contestant in PEERS and one.right is not False]
    those = [one for one in those if one.motions >= 0 and one.stresses >= -1]
    return min(those, key=lambda one: one.seconds, default=None)


#: Beams a sheet by the words for the trade.
WORDS: dict[str, int | str] = {"default": "auto", "`--fast`": 4, "`--certain`": "auto"}
#: Beams a sheet of which the cost is taken for true.
_FINE = 32
SIX = HERE.parents[1] / "input_decks" / "paper" / "six_folded_sheets.dat"
FIVE = SIX.with_name("five_folded_sheets.dat")


def fast_and_certain() -> list[str]:
    """What each word costs and gives, in Markdown; times over those of the default, in turn."""
    models = {
        "35 x 35": flexact.read(FIVE),
        "stages, n = 168": FAMILIES["B"](168).model,
        "grid, n = 1,000": FAMILIES["T"](1000).model,
        "grid, n = 30,000": FAMILIES["T"](30_000).model,
    }
    times = {name: _times_of_words(model) for name, model in models.items()}
    stages = models["stages, n = 168"]
    rank = {word: certainty_word(flexact.analyse(stages, **_told(word, 168))) for word in WORDS}
    errors = errors_of_smallest((("small", 168),))[0]["errors"]
    costs = beams_trade()
    heads = [*models, "smallest value, stages 1 nm apart", "rank, n = 168", "`cost`: time"]
    heads += ["tolerances off by", "frequencies off by"]
    lines = [f"| | {' | '.join(heads)} |", "|---" * (len(heads) + 1) + "|"]
    for word, beams in WORDS.items():
        cells = [f"{times[name][word]:.2g}" for name in models]
        cells.append(f"{errors[_told(word, 168).get('method', 'auto')]:.0e} of itself")
        cells.append(rank[word])
        taken, tolerance, frequency = costs[beams]
        cells += [f"{taken / costs['auto'][0]:.2g}", f"{tolerance:.1%}", f"{frequency:.1e}"]
        lines.append(f"| {word} | {' | '.join(cells)} |")
        print(lines[-1], flush=True)
    return lines


def _told(word: str, columns: int) -> dict[str, Any]:
    """What Python is told for a word: see `flexact.apps.cli.decks.TRADES`."""
    if word == "default":
        return {}
    method, (least, most), prove = (
        TRADES[word.strip("`")][option][0] for option in ("method", "columns_of_method", "prove")
    )
    return {"prove": prove} | ({"method": method} if least <= columns <= most else {})


def _times_of_words(model: flexact.Model) -> dict[str, float]:
    """Processor time by word over that of the default, least of rounds in turn."""
    taken: dict[str, list[float]] = {word: [] for word in WORDS}
    begun = time.perf_counter()
    while len(taken["default"]) < 2 or time.perf_counter() - begun < 1.0:
        for word in WORDS:
            start = time.process_time()
            flexact.analyse(model, **_told(word, model.data.count.columns))
            taken[word].append(time.process_time() - start)
    return {word: min(each[1:]) / min(taken["default"][1:]) for word, each in taken.items()}


@cache
def beams_trade() -> dict[int | str, tuple[float, float, float]]:
    """By beams a sheet: seconds, and by how much tolerances and frequencies are off at most.

    What over-constraint costs six folded sheets, against 32 beams a sheet.
    """
    model = flexact.read(SIX)
    true = dict(_numbers(flexact.cost(model, beams=_FINE).to_dict()))
    made: dict[int | str, tuple[float, float, float]] = {}
    for beams in (1, 2, 4, 8, 16, "auto"):
        start = time.process_time()
        found = dict(_numbers(flexact.cost(model, beams=beams).to_dict()))
        taken = time.process_time() - start
        off = {
            kind: max(
                abs(value / true[place] - 1.0)
                for place, value in found.items()
                if kind in place and "uncert" not in place and true.get(place)
            )
            for kind in ("tolerance", "frequenc")
        }
        made[beams] = (taken, off["tolerance"], off["frequenc"])
        print(f"{beams} beams a sheet: {made[beams]}", flush=True)
    return made


def _numbers(tree: Any, place: str = "") -> Iterator[tuple[str, float]]:
    """Numbers of a JSON by where they stand."""
    if isinstance(tree, dict):
        for name, each in tree.items():
            yield from _numbers(each, f"{place}/{name}")
    elif isinstance(tree, list):
        for k, each in enumerate(tree):
            yield from _numbers(each, f"{place}/{k}")
    elif isinstance(tree, float):
        yield place, tree
