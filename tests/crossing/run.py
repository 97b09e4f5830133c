# SPDX-License-Identifier: BSD-3-Clause
"""Take changed mechanisms through every verb and form of output, and say what offends.

    python tests/crossing/run.py [--seed S] [--workers N] [--minutes M] [--only WORDS]
        [--outputs WORDS] [--every-suffix] [--keep FILE] [--again]

Of suffixes that show the same each change of a deck takes the next one, so that every deck comes
through all of them; with --every-suffix each change comes through all, which takes twice as long.
What was taken through is kept in FILE, so that a run that was stopped goes on where it was; with
--again it begins anew. The exit code is 1 where something offends.
"""

from __future__ import annotations

import argparse
import itertools
import os
import random
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ["FLEXACT_STRICT"] = "1"
os.environ.setdefault("MPLBACKEND", "agg")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from crossing.judge import offence_of
from crossing.mechanisms import mechanisms
from crossing.outputs import outputs, outputs_in_turn


def _tried(name: str, text: str, wanted: str, turn: int | None) -> tuple[str, int, list[str]]:
    """A mechanism through the outputs: how many, and what offends."""
    every = outputs() if turn is None else outputs_in_turn(turn)
    begun = [output for output in every if wanted in output.name]
    return name, len(begun), [said for each in begun if (said := offence_of(each, name, text))]


def _left(asked: argparse.Namespace, done: set[str]) -> Iterator[tuple[str, str, int]]:
    end = time.monotonic() + 60.0 * asked.minutes
    every = [(*each, turn) for turn, each in enumerate(mechanisms(asked.seed))]
    # So that what a stopped run has seen is an even sample.
    random.Random(asked.seed).shuffle(every)
    for name, text, turn in every:
        if time.monotonic() > end:
            return
        if asked.only in name and name not in done:
            yield name, text, turn


def main() -> int:
    """Take them through, and say what was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--only", default="", help="mechanisms whose name holds these words")
    parser.add_argument("--outputs", default="", help="outputs whose name holds these words")
    parser.add_argument("--every-suffix", action="store_true")
    parser.add_argument("--keep", type=Path, default=Path("build/crossing.txt"))
    parser.add_argument("--again", action="store_true")
    asked = parser.parse_args()
    asked.keep.parent.mkdir(parents=True, exist_ok=True)
    if asked.again:
        asked.keep.unlink(missing_ok=True)
    suffixes = "every suffix" if asked.every_suffix else "suffixes in turn"
    head = f"seed {asked.seed}, outputs {asked.outputs!r}, {suffixes}"
    kept = asked.keep.read_text("utf-8").splitlines() if asked.keep.exists() else []
    if not kept or kept[0] != head:
        kept = [head]
        asked.keep.write_text(f"{head}\n", encoding="utf-8")
    found = count = pairs = 0
    with asked.keep.open("a", encoding="utf-8") as done, ProcessPoolExecutor(asked.workers) as pool:
        waiting = []
        left = _left(asked, set(kept[1:]))
        while True:
            for name, text, turn in itertools.islice(left, 2 * asked.workers - len(waiting)):
                chosen = None if asked.every_suffix else turn
                waiting.append(pool.submit(_tried, name, text, asked.outputs, chosen))
            if not waiting:
                break
            name, outputs_of_it, offences = waiting.pop(0).result()
            count, pairs, found = count + 1, pairs + outputs_of_it, found + len(offences)
            for words in offences:
                print(f"{words}\n{'-' * 80}", flush=True)
            if not offences:
                done.write(f"{name}\n")
                done.flush()
    print(f"{count} mechanisms, {pairs} outputs: {found} offend")
    return int(found > 0)


if __name__ == "__main__":
    sys.exit(main())
