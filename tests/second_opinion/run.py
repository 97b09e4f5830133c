# SPDX-License-Identifier: BSD-3-Clause
"""Whole analyses by our factor and by CHOLMOD's, side by side: no count may differ.

    python tests/second_opinion/run.py [--models N] [--decks N] [--seed S]

asks the package in use, and the one in build/cholmod/package (tests/second_opinion/build.sh),
about random models and about so many decks of each family of the standing attack. The exit code
is 1 where a count differs.
"""

from __future__ import annotations

import argparse
import itertools
import json
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tqdm import tqdm  # type: ignore[import-untyped]

ROOT = Path(__file__).resolve().parents[2]
OTHER = ROOT / "build" / "cholmod" / "package"
Answer = dict[str, Any]


def answers(package: Path | None, asked: list[str]) -> Iterator[Answer]:
    """Of a build, as they come; none of them where it ends early."""
    command = [sys.executable, str(Path(__file__).with_name("answers.py")), *asked]
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    if package is not None:
        environment["PYTHONPATH"] = str(package)
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        yield from map(json.loads, process.stdout)
    if process.returncode:
        sys.exit(f"The process of {package or 'the package in use'} ended: {process.returncode}.")


def difference(ours: Answer, theirs: Answer) -> str:
    """The first of what differs, or nothing."""
    return next((key for key in ("counts", "certainty", "nearly") if ours[key] != theirs[key]), "")


def compare(seed: int, models: int, decks: int) -> Counter[str]:
    """Ask both, and say where they differ."""
    asked = [str(number) for number in (seed, models, decks)]
    found: Counter[str] = Counter()
    both = itertools.zip_longest(answers(None, asked), answers(OTHER, asked))
    heads = next(both)
    if [head["cholmod"] for head in heads] != [False, True]:
        sys.exit("One build must be with CHOLMOD and the other without: make second-opinion.")
    for ours, theirs in tqdm(both, unit=" questions"):
        assert ours and theirs and ours["name"] == theirs["name"]
        found["asked"] += 1
        found["wide"] += ours.get("bound") != theirs.get("bound")
        if ours["counts"] is None or theirs["counts"] is None:
            found["refused"] += 1
            found["counts"] += ours["counts"] != theirs["counts"]
            print(f"{ours['name']}: ours {ours}, CHOLMOD's {theirs}")
            continue
        found["both"] += min(ours["counts"]) > 0
        found["singular"] += max(ours["counts"]) > 0
        found[ours["certainty"]] += 1
        if differs := difference(ours, theirs):
            found[differs] += 1
            print(f"{ours['name']}: {differs} differ: ours {ours}, CHOLMOD's {theirs}")
    return found


def main() -> int:
    """Compare, and print what was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--models", type=int, default=1000, help="random models")
    parser.add_argument("--decks", type=int, default=40, help="of each family of the attack")
    parser.add_argument("--seed", type=int, default=16)
    given = parser.parse_args()
    found = compare(given.seed, given.models, given.decks)
    sure = ", ".join(f"{found[word]} {word}" for word in ("proven", "numerically certain"))
    print(
        f"{found['asked']} analyses, {found['singular']} of them not exactly constrained; {sure}; "
        f"{found['refused']} refused.\nIn {found['wide']} the bound that the factor shows differs "
        f"in its digits, so that both factors were at work.\nOther counts: {found['counts']}; the "
        f"same counts, but surer by one: {found['certainty']}; other counts nearby: "
        f"{found['nearly']}."
    )
    return 1 if found["counts"] or not found["wide"] else 0


if __name__ == "__main__":
    sys.exit(main())
