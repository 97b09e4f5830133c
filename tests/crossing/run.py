# SPDX-License-Identifier: BSD-3-Clause
"""Take changed mechanisms through every verb and form of output, and say what offends.

    python tests/crossing/run.py [--seed S] [--workers N] [--minutes M] [--only WORDS]
        [--outputs WORDS] [--keep FILE] [--again]

What was taken through is kept in FILE, so that a run that was stopped goes on where it was; with
--again it begins anew. The exit code is 1 where something offends.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TextIO

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ["FLEXACT_STRICT"] = "1"
os.environ.setdefault("MPLBACKEND", "agg")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from crossing.judge import offence_of
from crossing.mechanisms import mechanisms
from crossing.outputs import outputs


def _tried(name: str, text: str, wanted: str) -> tuple[str, list[str]]:
    """A mechanism through all outputs."""
    begun = [output for output in outputs() if wanted in output.name]
    return name, [words for output in begun if (words := offence_of(output, name, text))]


def _left(asked: argparse.Namespace, done: set[str]) -> Iterator[tuple[str, str]]:
    end = time.monotonic() + 60.0 * asked.minutes
    every = list(mechanisms(asked.seed))
    # So that what a stopped run has seen is an even sample.
    random.Random(asked.seed).shuffle(every)
    for name, text in every:
        if time.monotonic() > end:
            return
        if asked.only in name and name not in done:
            yield name, text


def main() -> int:
    """Take them through, and say what was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--only", default="", help="mechanisms whose name holds these words")
    parser.add_argument("--outputs", default="", help="outputs whose name holds these words")
    parser.add_argument("--keep", type=Path, default=Path("build/crossing.txt"))
    parser.add_argument("--again", action="store_true")
    asked = parser.parse_args()
    asked.keep.parent.mkdir(parents=True, exist_ok=True)
    if asked.again:
        asked.keep.unlink(missing_ok=True)
    head = f"seed {asked.seed}, outputs {asked.outputs!r}"
    kept = asked.keep.read_text("utf-8").splitlines() if asked.keep.exists() else []
    if not kept or kept[0] != head:
        kept = [head]
        asked.keep.write_text(f"{head}\n", encoding="utf-8")
    found = count = 0
    with asked.keep.open("a", encoding="utf-8") as done, ProcessPoolExecutor(asked.workers) as pool:
        waiting = []
        for name, text in _left(asked, set(kept[1:])):
            waiting.append(pool.submit(_tried, name, text, asked.outputs))
            while len(waiting) > 2 * asked.workers:
                found, count = _said(waiting.pop(0).result(), done, found), count + 1
        for each in waiting:
            found, count = _said(each.result(), done, found), count + 1
    print(f"{count} mechanisms through {len(outputs())} outputs: {found} offend")
    return int(found > 0)


def _said(result: tuple[str, list[str]], done: TextIO, found: int) -> int:
    name, offences = result
    for words in offences:
        print(f"{words}\n{'-' * 80}", flush=True)
    if not offences:
        done.write(f"{name}\n")
        done.flush()
    return found + len(offences)


if __name__ == "__main__":
    sys.exit(main())
