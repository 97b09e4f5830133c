# SPDX-License-Identifier: BSD-3-Clause
"""Measure, and write the tables and the picture of docs/benchmarks.md.

    python tests/benchmarks/run.py [--quick]

writes the tables into docs/benchmarks.md and trade.svg beside it. With --quick, sizes up to 1000
only, written to build/bench.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any

# What is timed runs on one thread, in this process too.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import scaling
import waits
from picture import draw
from trade import (
    METHODS,
    NAMES,
    Outcome,
    beams_trade,
    best_peer,
    errors_of_smallest,
    fast_and_certain,
    one_of,
    outcomes,
)

ROOT = Path(__file__).parents[2]
#: Where a quick run writes.
QUICK = ROOT / "build" / "bench"
PAGE = ROOT / "docs" / "benchmarks.md"
PICTURE = ROOT / "docs" / "trade.svg"
#: A table stands between these two lines of the page.
FIRST, LAST = "<!-- {}: make bench -->", "<!-- end of {} -->"
#: Sizes that the table shows of each family; against dgesdd where it ran, else the best peer.
_SHOWN = (1000, 3000, 100_000, 300_000)
_METHODS = (*METHODS[1:], METHODS[0])
#: Arrays on which the smallest singular value is compared.
_CONDITIONED = (("amplifying", 42 * 16), *(("small", 42 * side**2) for side in (2, 3, 4, 5)))
_QUICK = (100, 300, 1000)


def main() -> None:
    """Measure, print and store."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true", help="small sizes, written to build/bench")
    quick = parser.parse_args().quick
    tables = {} if quick else {"waits": waits.table(), "sizes": scaling.sizes()}
    tables["words"] = fast_and_certain()
    found = outcomes(_QUICK) if quick else outcomes()
    errors = errors_of_smallest(_CONDITIONED[1:3] if quick else _CONDITIONED)
    tables["families"] = _speed(found)
    tables["methods"] = [*_accuracy(found, errors), "", *_verdicts(found)]
    print("\n\n".join("\n".join(table) for table in tables.values()))
    if quick:
        QUICK.mkdir(parents=True, exist_ok=True)
        text = "\n\n".join("\n".join(table) for table in tables.values())
        (QUICK / "tables.md").write_text(f"{text}\n")
    else:
        page = PAGE.read_text()
        for name, table in tables.items():
            page = _with_table(page, name, table)
        PAGE.write_text(page)
    draw(found, errors, beams_trade(), QUICK / "trade.svg" if quick else PICTURE)


def _with_table(page: str, name: str, table: list[str]) -> str:
    """The page with another table of that name."""
    first, last = FIRST.format(name), LAST.format(name)
    before, rest = page.split(first)
    text = "\n".join(table)
    return f"{before}{first}\n\n{text}\n\n{last}{rest.split(last)[1]}"


def _speed(found: list[Outcome]) -> list[str]:
    """`auto` against dgesdd where that ran, and else against the best peer."""
    lines = [
        "| family | size of D(c) | `auto` took | against | time | memory | counts | residual | "
        "growth | other methods, over `auto` |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for family in ("T", "O", "B", "C", "Tb"):
        shown = [one for size in _SHOWN if (one := one_of(found, family, size, "auto"))]
        for one in shown:
            growth = _growth(found, family) if one is shown[-1] else ""
            line = f"| {NAMES[family]} | {_against(one, found)} | {growth} |"
            lines.append(f"{line} {_methods_over(one, found)} |")
    return lines


def _against(one: Outcome, found: list[Outcome]) -> str:
    other = one_of(found, one.family, one.size, "dgesdd") or best_peer(found, one.family, one.size)
    size = f"{one.rows:,} x {one.columns:,}"
    time = f"{_time(one.seconds)} ({one.method})"
    if other is None:
        return f"{size} | {time} | | | | {_counts(one)} | {one.residual:.0e}"
    memory = f"{one.memory / other.memory:.2g}" if one.memory > 0 < other.memory else ""
    name = other.contestant if other.contestant == "dgesdd" else f"bare {other.contestant}"
    name += ", motions alone" if other.stresses == -1 else ""
    ratio = f"{one.seconds / other.seconds:.2g}"
    return f"{size} | {time} | {name} | {ratio} | {memory} | {_counts(one)} | {one.residual:.0e}"


def _methods_over(one: Outcome, found: list[Outcome]) -> str:
    """Times of the other methods, and what they give less."""
    words = []
    for method in METHODS[1:]:
        other = one_of(found, one.family, one.size, method)
        if other is not None and method != one.method:
            less = ", smallest values alone" if other.values != one.values == "all" else ""
            words.append(f"`{method}` {other.seconds / one.seconds:.2g}{less}")
    return "; ".join(words)


def _time(seconds: float) -> str:
    return f"{seconds:.3g} s" if seconds >= 1 else f"{seconds * 1e3:.3g} ms"


def _counts(one: Outcome) -> str:
    """Whether they are right, and what the analysis says of them."""
    right = {True: "right", False: "wrong", None: "truth unknown"}[one.right]
    return f"{right}, {one.certainty}"


def _growth(found: list[Outcome], family: str) -> str:
    """Exponent of the time of `auto` over the sizes from 10,000 on."""
    those = [one for one in found if (one.family, one.contestant) == (family, "auto")]
    those = [one for one in those if one.size >= 10_000]
    if len(those) < 2:
        return ""
    slope = np.polyfit(
        np.log([one.columns for one in those]), np.log([one.seconds for one in those]), 1
    )[0]
    return f"{slope:.2f}"


def _accuracy(found: list[Outcome], errors: list[dict[str, Any]]) -> list[str]:
    """Time over dgesdd on the array of stages, errors and residuals, by method."""
    sizes = [one.size for one in found if (one.family, one.contestant) == ("B", "dgesdd")]
    heads = [f"time, n = {one_of(found, 'B', size, 'dgesdd').columns}" for size in sizes]  # type: ignore[union-attr]
    shown = [one for one in errors if one["kind"] == "amplifying" or one is errors[-1]]
    heads += [f"error, {one['kind']} stages, {one['ratio']:.0e}" for one in shown]
    lines = [f"| method | {' | '.join(heads)} | residual |", "|---" * (len(heads) + 2) + "|"]
    for method in _METHODS:
        cells = [_over_dgesdd(found, size, method) for size in sizes]
        cells += [
            f"{one['errors'][method]:.0e}" if method in one["errors"] else "" for one in shown
        ]
        worst = max((one.residual for one in found if one.contestant == method), default=0.0)
        lines.append(f"| `{method}` | {' | '.join(cells)} | {worst:.0e} |")
    return lines


def _over_dgesdd(found: list[Outcome], size: int, method: str) -> str:
    one, other = (one_of(found, "B", size, name) for name in (method, "dgesdd"))
    return f"{one.seconds / other.seconds:.2g}" if one and other else ""


def _verdicts(found: list[Outcome]) -> list[str]:
    """How often the counts were right, of all runs on families whose truth is known."""
    lines = ["| who | runs with a known answer | right | wrong | wrong, not called doubtful |"]
    lines.append("|---|---|---|---|---|")
    ours = [one for one in found if one.contestant in _METHODS]
    theirs = [one for one in found if one.contestant not in _METHODS]
    for name, those in (("Flexact", ours), ("dgesdd and the bare peers", theirs)):
        known = [one for one in those if one.right is not None]
        wrong = [one for one in known if not one.right]
        sure = sum(one.certainty != "doubtful" for one in wrong) if those is ours else ""
        right = len(known) - len(wrong)
        lines.append(f"| {name} | {len(known)} | {right} | {len(wrong)} | {sure} |")
    return lines


if __name__ == "__main__":
    main()
