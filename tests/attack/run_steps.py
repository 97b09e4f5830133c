# SPDX-License-Identifier: BSD-3-Clause
"""Attack advice: apply its steps, paste its statements, build its hardware, keep its causes.

    python tests/attack/run_steps.py [--count N] [--first K] [--seed S] [--quiet]

Each mechanism has a name, family, seed and number, from which it is made again. The exit code is 1
where something that advice says is not so.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections import Counter
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("FLEXACT_STRICT", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(1, str(Path(__file__).resolve().parents[1] / "python"))

from tqdm import tqdm  # type: ignore[import-untyped]

from attack.advised import Offence, offences
from attack.mechanisms import mechanism, name_of


def main() -> int:
    """Attack, and print how much was tried and what is not so."""
    asked = _arguments()
    done: Counter[str] = Counter()
    found: list[tuple[str, Offence]] = []
    slowest = (0.0, "")
    for number in tqdm(range(asked.first, asked.first + asked.count), disable=asked.quiet):
        name, start = name_of(asked.seed, number), time.process_time()
        # Of calls of Python and of statements of a deck by turns.
        model = mechanism(asked.seed, number)
        for one in offences(model.to_deck() if number // 8 % 2 else model, done):
            found.append((name, one))
            print(f"{name}: {one.kind}: {one.words}", flush=True)
        slowest = max(slowest, (time.process_time() - start, name))
    print(f"seed {asked.seed}, {asked.count} mechanisms, slowest {slowest[0]:.1f} s ({slowest[1]})")
    print("\n".join(f"{count:8} {what}" for what, count in sorted(done.items())))
    kinds = Counter(one.kind for _, one in found)
    print(
        "\n".join(f"{count:8} {kind.upper()}" for kind, count in kinds.items()) or "nothing false"
    )
    return 1 if found else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--count", type=int, default=2000, help="how many; 2000 by default")
    parser.add_argument("--first", type=int, default=0, help="the first of them")
    parser.add_argument("--seed", type=int, default=28, help="28 by default")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
