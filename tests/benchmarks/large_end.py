# SPDX-License-Identifier: BSD-3-Clause
"""The large end: Flexact against SuiteSparse called bare, each on one thread for certain.

    python tests/benchmarks/large_end.py [T:300000 B:1000 ...]

measures all rows of the table, or those that are named, and prints them. What is compared is
processor time, the least of the rounds, so that other work of the machine touches it little:
on one thread it is the time that passes on an idle machine. Each run is the first analysis of
a fresh process; what is imported late is imported before.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

# This process makes the models and the matrices.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import peers
from families import FAMILIES
from matrix import scaled_jacobian
from trade import NAMES, answer_of, environment_of

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
    rounds: int = 3
    counts_agree: bool = True
    """Whether a peer with other counts is left out."""

    @property
    def key(self) -> str:
        """As the row is named in the command."""
        return f"{self.family}:{self.size}"


ROWS = (
    Row("T", 300_000, (*_QR, *_CHOLESKY), 1.0, "motions"),
    Row("B", 300_000, (*_QR, *_CHOLESKY), 1.0),
    Row("C", 300_000, (*_QR, *_CHOLESKY), 0.5),
    # With its default order QR takes minutes here.
    Row("O", 100_000, ("qr metis", *_CHOLESKY), 1.0, "motions"),
    Row("T", 1000, _QR, 1.5, "motions", 15),
    Row("B", 1000, _QR, 1.5, rounds=15),
    # Bare Cholesky answers in one step, wrongly: there are values as small as its shift.
    Row("Tb", 100_000, _CHOLESKY, 10.0, rounds=1, counts_agree=False),
)
#: Where two threads are compared with one.
THREADED = (("T", 300_000), ("B", 300_000), ("O", 100_000))


def table(rows: tuple[Row, ...] = ROWS) -> list[str]:
    """The rows in Markdown; what is under way is printed."""
    lines = [
        "| family | size of D(c) | Flexact | fastest of the bare | ratio | to be at most | "
        "memory over bare Cholesky | counts |",
        "|---|---|---|---|---|---|---|---|",
    ]
    with tempfile.TemporaryDirectory() as folder:
        program = peers.compiled(Path(folder))
        if program is None:
            return ["SuiteSparse's headers or a C compiler are missing: no peers"]
        for row in rows:
            lines.append(_compared(row, program, Path(folder) / "matrix"))
            print(lines[-1], flush=True)
    return lines


def threads_table(models: tuple[tuple[str, int], ...] = THREADED, rounds: int = 3) -> list[str]:
    """Time that passes on one thread and on two, in turn."""
    lines = ["| family | one thread | two threads | ratio |", "|---|---|---|---|"]
    for family, size in models:
        call = _worker(family, size)
        best = [float("inf")] * 2
        for _ in range(rounds):
            for k in range(2):
                found = answer_of(call, environment_of(k + 1), _LIMIT)
                if not isinstance(found, str):
                    best[k] = min(best[k], found["first"])
        line = f"| {NAMES[family]}, n = {size:,} | {best[0]:.3g} s | {best[1]:.3g} s |"
        lines.append(f"{line} {best[0] / best[1]:.2f} |")
        print(lines[-1], flush=True)
    return lines


def _compared(row: Row, program: Path, matrix: Path) -> str:
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
    size = f"{NAMES[row.family]} | {case.rows:,} x {case.columns:,}"
    return f"| {size} | {_against(row, found, (case.motions, case.stresses))} |"


def _against(
    row: Row, found: dict[str, dict[str, Any]], truth: tuple[int | None, int | None]
) -> str:
    ours = found.get("Flexact")
    if ours is None:
        return "no answer | | | | |"
    others = {
        name: answer
        for name, answer in found.items()
        if name != "Flexact" and (not row.counts_agree or _agrees(answer, truth))
    }
    time = f"{ours['processor']:.3g} s"
    counts = f"{_right(ours, truth)}, {ours['certainty']}"
    if not others:
        return f"{time} | none | | {row.at_most} | | {counts}"
    name = min(others, key=lambda each: float(others[each]["processor"]))
    ratio = ours["processor"] / others[name]["processor"]
    least = [answer for each, answer in others.items() if each.startswith("cholesky")]
    memory = ""
    if least:
        fastest = min(least, key=lambda each: float(each["processor"]))
        memory = f"{ours['memory'] / fastest['memory']:.2f}"
    against = f"{_named(name)}: {others[name]['processor']:.3g} s"
    return f"{time} | {against} | {ratio:.2f} | {row.at_most} | {memory} | {counts}"


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


if __name__ == "__main__":
    asked = sys.argv[1:]
    table(tuple(row for row in ROWS if not asked or row.key in asked))
    threads_table(
        tuple(one for one in THREADED if not asked or f"{one[0]}:{one[1]}:threads" in asked)
    )
