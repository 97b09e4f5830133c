# SPDX-License-Identifier: BSD-3-Clause
"""Fuzz real decks for some minutes, and keep what offends as short as it can be made.

    python tests/fuzz/run.py [--minutes M] [--seed S] [--workers N] [--keep FOLDER]

The exit code is 1 where a deck was met that crashes, hangs, ends in a traceback, does not survive
the round trip, or ends the core with a sanitizer's finding.
"""

from __future__ import annotations

import argparse
import itertools
import os
import random
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tqdm import tqdm  # type: ignore[import-untyped]

from fuzz import sanitized, workers
from fuzz.keeping import Folder
from fuzz.mutations import Case, case_of
from fuzz.seeds import seeds


class Fuzzing:
    """What has been tried, and what offended."""

    def __init__(self, seed: int, minutes: float, folder: Folder) -> None:
        """Nothing yet."""
        self.seed = seed
        self.end = time.monotonic() + 60.0 * minutes
        self.folder = folder
        self.seeds = seeds()
        self.outcomes: Counter[str] = Counter()
        self.core = 0
        self.slowest = workers.Judged(Case("", b""))

    def cases(self, seed: str) -> Iterator[Case]:
        """Decks until the time is over."""
        for number in itertools.count():
            if time.monotonic() > self.end:
                return
            yield case_of(self.seeds, seed, number)

    def through_the_package(self, processes: int, progress: tqdm) -> None:
        """Decks through reader, analysis, writer and command."""
        for found in workers.judged(self.cases(str(self.seed)), processes):
            self.outcomes[found.offence or found.outcome] += 1
            self.slowest = max(self.slowest, found, key=lambda each: each.seconds)
            progress.update()
            if found.offence:
                self.folder.keep(found, of_core=False)

    def through_the_core(self) -> None:
        """Other decks through the core with sanitizers."""
        for found in sanitized.judged(self._counted(self.cases(f"core-{self.seed}"))):
            self.folder.keep(found, of_core=True)

    def _counted(self, cases: Iterator[Case]) -> Iterator[Case]:
        for case in cases:
            self.core += 1
            yield case


def main() -> int:
    """Fuzz, and say what was found."""
    asked = _arguments()
    if not sanitized.PROGRAM.exists():
        print(f"{sanitized.PROGRAM} is not there: tools/test_core.sh builds it", file=sys.stderr)
        return 1
    folder = Folder(asked.keep)
    fuzzing = Fuzzing(asked.seed, asked.minutes, folder)
    core = threading.Thread(target=fuzzing.through_the_core)
    with tqdm(unit=" decks", disable=asked.quiet or None) as progress:
        core.start()
        try:
            fuzzing.through_the_package(asked.workers, progress)
        except KeyboardInterrupt:
            fuzzing.end = 0.0
        core.join()
    print(f"seed {asked.seed}")
    for name, count in fuzzing.outcomes.most_common():
        print(f"{count:>9} {name}")
    print(f"{fuzzing.core:>9} through the core with sanitizers")
    print(f"the longest took {fuzzing.slowest.seconds:.2f} s: {fuzzing.slowest.case.name}")
    print("\n".join(folder.lines()))
    return 1 if folder.kinds else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10.0, help="default 10")
    seed = random.SystemRandom().randrange(10**6)
    parser.add_argument("--seed", type=int, default=seed, help="default any; it is printed")
    most = max(1, (os.cpu_count() or 1) - 1)
    parser.add_argument("--workers", type=int, default=most, help="besides one for the core")
    keep = Path("build") / "fuzz"
    parser.add_argument("--keep", type=Path, default=keep, help="folder of offending decks")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
