# SPDX-License-Identifier: BSD-3-Clause
"""What sets 2 in theory.md (25): mechanisms rounded to a few digits.

    python tests/calibration/digits.py

Special ones, whose zero the rounding lifts: the value over what half a unit of every digit makes
of it, and how many of them are doubted; and ordinary ones, which should not be. Half a minute.
"""

from __future__ import annotations

from samples import (
    Chance,
    analysed,
    lifted,
    ordinary_samples,
    quantiles,
    samples,
    turned_exactly,
    typed,
)

import flexact

DECKS = 250


def special(digits: int, is_cut: bool) -> str:
    """A line of the table for mechanisms whose zero is lifted."""
    found, doubted, offered, decks = [], 0, 0, 0
    for k, sample in enumerate(samples(2, DECKS)):
        text = typed(turned_exactly(sample.deck, Chance(f"{digits}-{k}")), digits, is_cut)
        analysis = analysed(text) if lifted(text, sample.meant) else None
        if analysis is None:
            continue
        decks += 1
        meant = sample.meant.under_constrained
        above = meant - analysis.under_constrained
        pairs = analysis.pairs
        if 0 < above <= len(pairs) and pairs[above - 1].lift_of_digits:
            found.append(pairs[above - 1].value / pairs[above - 1].lift_of_digits)
        others = [item.under_constrained for item in analysis.alternatives]
        doubted += analysis.certainty is not flexact.Certainty.CERTAIN
        offered += meant in others or analysis.under_constrained == meant
    above = [sum(ratio > limit for ratio in found) for limit in (1.0, 2.0)]
    shares = f"{_percent(doubted, decks)} | {_percent(offered, decks)}"
    name = f"{digits}, {'cut off' if is_cut else 'rounded'}"
    return f"| {name} | {decks} | {quantiles(found)} | {above[0]} | {above[1]} | {shares} |"


def ordinary(digits: int) -> str:
    """A line of the table for mechanisms that no rounding changes."""
    doubted = decks = 0
    for k, sample in enumerate(ordinary_samples(2, DECKS)):
        analysis = analysed(typed(turned_exactly(sample.deck, Chance(f"{digits}-{k}")), digits))
        if analysis is not None:
            decks += 1
            doubted += analysis.certainty is not flexact.Certainty.CERTAIN
    return f"| {digits} | {decks} | {_percent(doubted, decks)} |"


def _percent(part: int, of: int) -> str:
    return f"{100 * part / of:.0f} %" if of else "-"


def main() -> None:
    """Print both tables."""
    heads = "least | median | 99 % | largest | above 1 | above 2 | doubted | meant counts said"
    print(f"| digits | special decks | {heads} |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for is_cut in (False, True):
        for digits in range(2, 10):
            print(special(digits, is_cut))
    print()
    print("| digits | ordinary decks | doubted |")
    print("|---|---|---|")
    for digits in range(2, 10):
        print(ordinary(digits))


if __name__ == "__main__":
    main()
