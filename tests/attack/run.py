# SPDX-License-Identifier: BSD-3-Clause
"""Attack the claim that a wrong count is never called certain, and print what was found.

    python tests/attack/run.py [--count N] [--seed S] [--family F] [--method M] [--keep FOLDER]

makes decks of all families by turns; without a count until it is stopped with Ctrl-C. The exit
code is 1 where a wrong count was called certain, or the truth was missing from an answer.
"""

from __future__ import annotations

import argparse
import itertools
import math
import os
import random
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tqdm import tqdm  # type: ignore[import-untyped]

from attack.exact_deck import read
from attack.families import FAMILIES, Case, case_of
from attack.judge import OFFENCES, Answer, Judged, Judgement, judge, methods
from attack.truth import counts_of

_HEADS = {
    Judgement.RIGHT: "right",
    Judgement.MEANT: "as meant",
    Judgement.TYPED: "as typed",
    Judgement.STORED: "stored",
    Judgement.GIVEN: "given",
    Judgement.OFFERED: "offered",
    Judgement.NEEDLESS: "needless",
    Judgement.MISSING: "MISSING",
    Judgement.WRONG: "WRONG",
    Judgement.UNLIKE: "UNLIKE",
    Judgement.REFUSED: "refused",
}
#: What is written into the folder of offending decks.
_KEPT = (*OFFENCES, Judgement.NEEDLESS)


class Score:
    """How often each method was judged how, by family."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.found: Counter[tuple[str, str, Judgement]] = Counter()
        self.decks: Counter[str] = Counter()
        self.numpy: Counter[str] = Counter()

    def add(self, family: str, judged: Judged) -> None:
        """Take a deck in."""
        self.decks[family] += 1
        self.numpy[family] += judged.numpy_is_wrong
        for method, answer in judged.answers.items():
            self.found[family, method, answer.judgement] += 1

    def offences(self) -> int:
        """How many answers the claim forbids."""
        return sum(count for (*_, each), count in self.found.items() if each in OFFENCES)

    def lines(self, chosen: tuple[str, ...]) -> Iterator[str]:
        """The table: a line for each family and method, and for all families."""
        heads = "".join(f"{head:>9}" for head in _HEADS.values())
        yield f"{'family':12}{'method':15}{'decks':>7}{heads}{'dgesdd wrong':>14}"
        for family, method in itertools.product(self.decks, chosen):
            counts = [self.found[family, method, each] for each in _HEADS]
            yield self._line(family, method, self.decks[family], counts, self.numpy[family])
        for method in chosen:
            counts = [sum(self.found[f, method, each] for f in self.decks) for each in _HEADS]
            yield self._line("all", method, self.decks.total(), counts, self.numpy.total())

    @staticmethod
    def _line(family: str, method: str, decks: int, counts: list[int], wrong: int) -> str:
        numbers = "".join(f"{count or '.':>9}" for count in counts)
        return f"{family:12}{method:15}{decks:>7}{numbers}{wrong:>14}"


class Folder:
    """Where offending decks are kept, with a line of README each."""

    def __init__(self, path: Path | None) -> None:
        """Make it; nothing is kept without a path."""
        self._path = path
        if path is not None:
            path.mkdir(parents=True, exist_ok=True)

    def keep(self, judged: Judged) -> None:
        """Write the deck if any method offends with it."""
        worst = [a for a in judged.answers.values() if a.judgement in _KEPT]
        if self._path is None or not worst:
            return
        case = judged.case
        (self._path / f"{case.name}.dat").write_text(case.text, encoding="utf-8")
        with (self._path / "README.md").open("a", encoding="utf-8") as file:
            file.write(_described(case, judged.answers) + "\n")


def _described(case: Case, answers: dict[str, Answer]) -> str:
    meant = "unknown" if case.meant is None else str(tuple(case.meant))
    said = "; ".join(
        f"{method}: {answer.judgement.value} ({answer.words})" for method, answer in answers.items()
    )
    stored = tuple(counts_of(read(case.text).stored()))
    truth = f"typed {tuple(case.typed)}, meant {meant}, as stored in doubles {stored}"
    digits = "all" if math.isinf(case.digits) else f"{case.digits:.0f}"
    return f"- {case.name}.dat: {digits} digits; {truth}. {said}"


def main() -> int:
    """Attack, and print the table."""
    asked = _arguments()
    families = asked.family or list(FAMILIES)
    chosen = tuple(asked.method or methods())
    score, folder = Score(), Folder(asked.keep)
    endless = ((number, family) for number in itertools.count() for family in families)
    progress = tqdm(
        itertools.islice(endless, asked.count),
        total=asked.count,
        unit=" decks",
        disable=asked.quiet,
    )
    try:
        for number, family in progress:
            judged = judge(case_of(family, asked.seed, number), chosen)
            score.add(family, judged)
            folder.keep(judged)
            progress.set_postfix(offences=score.offences(), refresh=False)
    except KeyboardInterrupt:
        pass
    finally:
        progress.close()
    print(f"seed {asked.seed}")
    print("\n".join(score.lines(chosen)))
    return 1 if score.offences() else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--count", type=int, help="how many decks; default until stopped")
    seed = random.SystemRandom().randrange(10**6)
    parser.add_argument("--seed", type=int, default=seed, help="default any; it is printed")
    parser.add_argument("--family", action="append", choices=FAMILIES, help="may be repeated")
    parser.add_argument("--method", action="append", choices=methods(), help="may be repeated")
    parser.add_argument("--keep", type=Path, help="folder that offending decks are written to")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
