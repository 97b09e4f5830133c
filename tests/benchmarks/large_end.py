# SPDX-License-Identifier: BSD-3-Clause
"""The large end: Flexact against SuiteSparse called bare, each on one thread for certain.

    python tests/benchmarks/large_end.py [T:300000 B:1000 T:300000:threads ...]

measures all, or what is named, and prints it. What is compared is
processor time, the least of the rounds, so that other work of the machine touches it little:
on one thread it is the time that passes on an idle machine. Each run is the first analysis of
a fresh process; what is imported late is imported before.
"""

from __future__ import annotations

import math
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

# This process makes the models and the matrices.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import peers
from families import FAMILIES
from matrix import scaled_jacobian
from trade import answer_of, environment_of

HERE = Path(__file__).parent
_QR = ("qr default", "qr metis")
_CHOLESKY = ("cholesky metis", "cholesky default")
#: Longest time of one contestant [s].
_LIMIT = 300.0


class Row(NamedTuple):
    """What is compared, and the ratio that it is to keep to."""

    family: str
    size: int
    peers: tuple[str, ...]
    at_most: float
    sides: str = "both"
    """Null spaces that the peers are asked for: their number must be one that they can hold."""
    rounds: int = 2
    counts_agree: bool = True
    """Whether a peer with other counts is left out."""

    @property
    def key(self) -> str:
        """As the row is named in the command."""
        return f"{self.family}:{self.size}"


#: With its default order QR takes minutes for the lattice.
ROWS = (
    Row("T", 300_000, (*_QR, *_CHOLESKY), 1.0, "motions"),
    Row("B", 300_000, (*_QR, *_CHOLESKY), 1.0),
    Row("C", 300_000, (*_QR, *_CHOLESKY), 0.5),
    Row("O", 100_000, _CHOLESKY, 0.8, "motions"),
    Row("T", 1000, _QR, 1.5, "motions", 15),
    Row("B", 1000, _QR, 1.5, rounds=15),
    # Bare Cholesky answers in one step, wrongly: there are values as small as its shift.
    Row("Tb", 100_000, _CHOLESKY, 4.0, rounds=1, counts_agree=False),
)
#: Where two threads are compared with one, and how much of what two processes side by side gain
#: they are to gain.
THREADED = {("O", 100_000): 0.85, ("T", 300_000): 0.75, ("B", 300_000): 0.65}


class Compared(NamedTuple):
    """Processor seconds and memory of Flexact and of the fastest peer."""

    seconds: float
    peer: str
    """Its name; empty without any."""
    of_peer: float
    memory: float
    """Over that of bare Cholesky."""
    counts: str


def compared(row: Row) -> Compared:
    """One row.

    Raises:
        RuntimeError: SuiteSparse's headers or a C compiler are missing, or there is no answer.
    """
    with tempfile.TemporaryDirectory() as folder:
        program = peers.compiled(Path(folder))
        if program is None:
            raise RuntimeError("SuiteSparse's headers or a C compiler are missing: no peers")
        return _compared(row, program, Path(folder) / "matrix")


def threads_gain(family: str, size: int, rounds: int = 2) -> tuple[float, float]:
    """What two threads gain over one, and what two processes side by side do, in turn."""
    call, one, two, both = _worker(family, size), [], [], []
    for _ in range(rounds):
        one.append(_first(answer_of(call, environment_of(1), _LIMIT)))
        two.append(_first(answer_of(call, environment_of(2), _LIMIT)))
        with ThreadPoolExecutor(2) as pool:
            beside = pool.map(lambda _: answer_of(call, environment_of(1), _LIMIT), range(2))
            both.append(max(map(_first, beside)))
    return min(one) / min(two), 2.0 * min(one) / min(both)


def _first(answer: dict[str, Any] | str) -> float:
    if isinstance(answer, str):
        raise RuntimeError(answer)
    return float(answer["first"])


def _compared(row: Row, program: Path, matrix: Path) -> Compared:
    case = FAMILIES[row.family](row.size)
    scaled_jacobian(case.model).write(matrix)
    calls = {"Flexact": _worker(row.family, row.size)}
    for peer in row.peers:
        calls[peer] = [str(program), str(matrix), *peer.split(), row.sides]
    found: dict[str, dict[str, Any]] = {}
    for _ in range(row.rounds):
        for name, call in calls.items():
            answer = answer_of(call, environment_of(1), _LIMIT)
            if isinstance(answer, str):
                print(f"{row.key} {name} gave no answer: {answer}", flush=True)
            elif name not in found or answer["processor"] < found[name]["processor"]:
                found[name] = answer
    for name, answer in found.items():
        print(f"  {name}: {answer}", flush=True)
    truth = (case.motions, case.stresses)
    ours = found.pop("Flexact")
    others = {
        name: answer
        for name, answer in found.items()
        if not row.counts_agree or _agrees(answer, truth)
    }
    counts = f"{_right(ours, truth)}, {ours['certainty']}"
    if not others:
        return Compared(ours["processor"], "", math.nan, math.nan, counts)
    name = min(others, key=lambda each: float(others[each]["processor"]))
    least = [answer for each, answer in others.items() if each.startswith("cholesky")]
    fastest = min(least, key=lambda each: float(each["processor"]), default=None)
    memory = ours["memory"] / fastest["memory"] if fastest else math.nan
    return Compared(
        ours["processor"], _named(name), float(others[name]["processor"]), memory, counts
    )


def _named(peer: str) -> str:
    method, order = peer.split()
    method = {"qr": "QR", "cholesky": "Cholesky"}[method]
    return f"{method}, {order.upper() if order == 'metis' else order}"


def _agrees(answer: dict[str, Any], truth: tuple[int | None, int | None]) -> bool:
    motions, stresses = answer["motions"], answer["stresses"]
    return motions == truth[0] and stresses in (-1, truth[1])


def _right(answer: dict[str, Any], truth: tuple[int | None, int | None]) -> str:
    if None in truth:
        return "truth unknown"
    return "right" if (answer["motions"], answer["stresses"]) == truth else "wrong"


def _worker(family: str, size: int) -> list[str]:
    return [sys.executable, str(HERE / "worker.py"), family, str(size), "sparse"]


def main() -> None:
    """The rows and threads that are named, or all."""
    asked = sys.argv[1:]
    for row in ROWS:
        if not asked or row.key in asked:
            found = compared(row)
            print(
                f"{row.key}: {found.seconds:.3g} s, {found.peer} {found.of_peer:.3g} s: "
                f"{found.seconds / found.of_peer:.2f} (at most {row.at_most}), memory "
                f"{found.memory:.2f}, {found.counts}",
                flush=True,
            )
    for (family, size), share in THREADED.items():
        if not asked or f"{family}:{size}:threads" in asked:
            gain, most = threads_gain(family, size)
            print(f"{family}:{size} two threads {gain:.2f} of {most:.2f}, at least {share}")


if __name__ == "__main__":
    main()
