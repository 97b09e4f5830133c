# SPDX-License-Identifier: BSD-3-Clause
"""What `flexact batch` costs beside the analyses, how it scales, and how it bears being killed.

    python tests/benchmarks/batch.py            # the table of docs/batch.md
    python tests/benchmarks/batch.py --kill 20  # killed so often and resumed; says what was lost

Everything that is compared takes turns, and the best of each counts: other work on the machine
only ever adds time.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Callable
from pathlib import Path

# As in the processes of a batch.
os.environ["OPENBLAS_NUM_THREADS"] = "1"

import flexact
from flexact.sweeps.columns import row_of

#: Two sheets guide a stage; D(c) is 12 x 11, or 11 x 11.
DECK = """\
BEAM 1  1 2 3 4  0 1 0     % sheet 1
BEAM 2  5 6 7 8  0 1 0     % sheet 2
BEAM 3  3 4 7 8            % stage
X 3  {x:.5f} 0.00 0
X 5  0.0 {y:.5f} 0
X 7  {x:.5f} {y:.5f} 0
FIX 1
FIX 2
FIX 5
FIX 6
RLSE 1  2 5 6
RLSE 2  2 {released} 5 6
DYNX 3  2
"""


def write_decks(folder: Path, count: int) -> None:
    """Small decks, a fifth of them exactly constrained, and one in a hundred with a mistake."""
    chance = random.Random(12)
    folder.mkdir()
    for k in range(count):
        x, y = 0.1 + 0.01 * chance.random(), 0.05 + 0.01 * chance.random()
        text = DECK.format(x=x, y=y, released="" if k % 5 else "3")
        text = text.replace("FIX 1", "FIXX 1") if k % 100 == 3 else text
        (folder / f"deck{k:05d}.dat").write_text(text)


def command(*words: object) -> list[str]:
    """The command, as a list for subprocess."""
    return [sys.executable, "-m", "flexact", "batch", *map(str, words)]


def in_process(folder: Path, columns: str | None) -> Callable[[], None]:
    """One analysis after the other in this process, with the columns that are wanted."""
    paths = sorted(folder.glob("*.dat"))

    def run() -> None:
        for path in paths:
            try:
                result = flexact.analyse(path)
            except flexact.DeckError:
                continue
            if columns is not None:
                row_of(result, columns)

    return run


def measure(folder: Path, count: int, rounds: int) -> None:
    """Print the table: time and processor time a deck, the best of some rounds."""
    table = folder.parent / "table.csv"

    def batch(*words: object) -> Callable[[], object]:
        return lambda: subprocess.run(
            command(folder, "-o", table, *words), check=True, stdout=subprocess.DEVNULL
        )

    runs: dict[str, Callable[[], object]] = {
        "`analyse(path)`, one after the other": in_process(folder, None),
        "the same, and the columns of `--columns verdict`": in_process(folder, "verdict"),
        "the same, and the columns of `--columns values`": in_process(folder, "values"),
        "`batch -j 1 --columns verdict`": batch("-j1", "--columns", "verdict"),
        "`batch -j 1`": batch("-j1"),
        "`batch -j 2`": batch("-j2"),
    }
    best = {name: [float("inf")] * 2 for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            start, before = time.perf_counter(), _processor_time()
            run()
            found = time.perf_counter() - start, _processor_time() - before
            best[name] = [min(pair) for pair in zip(best[name], found, strict=True)]
    of_one = best["`analyse(path)`, one after the other"]
    print(f"| {count} decks | time a deck | processor time a deck | over `analyse(path)` |")
    print("|---|---|---|---|")
    for name, (wall, used) in best.items():
        ratios = f"{wall / of_one[0]:.2f}, {used / of_one[1]:.2f}"
        print(f"| {name} | {wall / count * 1e6:.0f} us | {used / count * 1e6:.0f} us | {ratios} |")
    ideal = best["`batch -j 1`"][0] / best["`batch -j 2`"][0] / 2
    print(f"\nTwo processes against one: {ideal:.2f} of ideal.")
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"Most memory of any process: {peak:.0f} MB.")


def _processor_time() -> float:
    """Of this process and of those that have ended [s]."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def kill(folder: Path, count: int, kills: int) -> None:
    """Kill a batch at random moments and resume it; print what became of its rows."""
    # Shells start what runs in the background deaf to Control-C, and its children with it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    whole, table = folder.parent / "whole.csv", folder.parent / "table.csv"
    journal = folder.parent / "table.csv.journal"
    start = time.perf_counter()
    subprocess.run(command(folder, "-o", whole), check=True)
    unbroken = time.perf_counter() - start
    chance = random.Random(12)
    done: dict[int, float] = {}
    killed = 0
    while killed < kills:
        process = subprocess.Popen(
            command(folder, "-o", table, "--resume"), stderr=subprocess.PIPE, text=True
        )
        if killed % 2:
            time.sleep(chance.random() * (0.5 + 2.0 * unbroken / kills))
        else:
            goal = len(done) + chance.randrange(1, 2 * count // kills)
            while process.poll() is None and _lines(journal) <= min(goal, count - 1):
                time.sleep(0.001)
        number = chance.choice((signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT))
        process.send_signal(number)
        process.communicate()
        if process.returncode == 0:
            print("done before it was killed")
            break
        killed += 1
        found = _journaled(journal)
        lost = sum(found.get(deck) != seconds for deck, seconds in done.items())
        print(f"{number.name}: {len(done)} -> {len(found)} decks, {lost} lost or done again")
        done = found
    subprocess.run(command(folder, "-o", table, "--resume"), check=True)
    one, other = (
        [line.rpartition(",") for line in path.read_text().splitlines()] for path in (whole, table)
    )
    same = [line[0] for line in one] == [line[0] for line in other]
    again = sum(float(other[1 + deck][2]) != seconds for deck, seconds in done.items())
    print(f"killed {killed} times; the same table but for times: {same}; done again: {again}")


def _lines(journal: Path) -> int:
    return journal.read_bytes().count(b"\n") if journal.exists() else 0


def _journaled(journal: Path) -> dict[int, float]:
    """Seconds of the decks that a journal has."""
    found: dict[int, float] = {}
    for line in journal.read_bytes().split(b"\n")[1:] if journal.exists() else []:
        if line[9:] and line[:9] == b"%08x " % zlib.crc32(line[9:]):
            record = json.loads(line[9:])
            found[record["deck"]] = record["row"][-1]
    return found


def main() -> None:
    """Measure, or kill."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--decks", type=int, default=10_000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--kill", type=int, default=0, metavar="TIMES")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "decks"
        write_decks(folder, chosen.decks)
        if chosen.kill:
            kill(folder, chosen.decks, chosen.kill)
        else:
            measure(folder, chosen.decks, chosen.rounds)


if __name__ == "__main__":
    main()
