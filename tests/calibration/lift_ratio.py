# SPDX-License-Identifier: BSD-3-Clause
"""What sets 1 and 30 in theory.md (22): a value over what storing the geometry makes of it.

    python tests/calibration/lift_ratio.py

Of mechanisms that are meant to have a zero, whose digits lift it; and of others that are off
by a hair, which is typed exactly. Half a minute.
"""

from __future__ import annotations

from fractions import Fraction

from samples import (
    Chance,
    analysed,
    lifted,
    quantiles,
    samples,
    turned_exactly,
    turned_in_floating_point,
    typed,
)

import flexact

DECKS = 250


def ratio_of(analysis: flexact.Analysis, meant: int) -> float | None:
    """The largest value that is meant to be zero, over its lift."""
    raw = analysis.raw
    if analysis.under_constrained == meant and raw.explained > 0.0:
        return raw.left / raw.explained
    above = meant - analysis.under_constrained
    pairs = analysis.pairs
    if not 0 < above <= len(pairs) or not pairs[above - 1].lift_of_storing:
        return None
    return pairs[above - 1].value / pairs[above - 1].lift_of_storing


def meant_zeros(name: str, digits: int, turns: int) -> str:
    """A line of the first table."""
    found = []
    for k, sample in enumerate(samples(1, DECKS)):
        chance = Chance(f"{digits}-{turns}-{k}")
        deck = turned_exactly(sample.deck, chance)
        if turns:
            deck = turned_in_floating_point(sample.deck, chance, turns)
        text = typed(deck, digits)
        analysis = analysed(text) if lifted(text, sample.meant) else None
        ratio = ratio_of(analysis, sample.meant.under_constrained) if analysis else None
        if ratio is not None:
            found.append(ratio)
    above = [sum(ratio > limit for ratio in found) for limit in (1.0, 30.0)]
    return f"| {name} | {len(found)} | {quantiles(found)} | {above[0]} | {above[1]} |"


def hairs(power: int) -> str:
    """A line of the second table: two bars to one joint, off their line by 10**-power."""
    found, answers = [], {"nonzero": 0, "doubtful": 0, "zero": 0}
    for k in range(DECKS // 5):
        chance = Chance(f"hair-{k}")
        x, y = chance.randint(1, 9), chance.randint(1, 9)
        by = Fraction(chance.randint(1, 9), 10**power)
        end = f"{-x} {float(-y):.0f}"
        if by:
            whole = Fraction(-y) + by
            end = f"{-x} {_decimal(whole, power)}"
        text = f"PLTRUSS 1 1 2\nPLTRUSS 2 1 3\nX 1 0 0\nX 2 {x} {y}\nX 3 {end}\nFIX 2\nFIX 3\n"
        analysis = analysed(text + "END\n")
        if analysis is None:
            continue
        ratio = ratio_of(analysis, 1)
        if ratio is not None:
            found.append(ratio)
        certain = analysis.certainty is flexact.Certainty.CERTAIN
        answer = "zero" if analysis.under_constrained else "nonzero"
        answers[answer if certain else "doubtful"] += 1
    cells = " | ".join(map(str, answers.values()))
    return f"| 1e-{power} | {len(found)} | {quantiles(found)} | {cells} |"


def _decimal(number: Fraction, places: int) -> str:
    whole = round(number * 10**places)
    sign, size = "-" * (whole < 0), f"{abs(whole):0{places + 1}d}"
    return f"{sign}{size[:-places]}.{size[-places:]}"


def main() -> None:
    """Print both tables."""
    print("| a zero is meant | decks | least | median | 99 % | largest | above 1 | above 30 |")
    print("|---|---|---|---|---|---|---|---|")
    for digits in (10, 12, 14, 15, 16, 17):
        print(meant_zeros(f"rounded once, to {digits} digits", digits, 0))
    for turns in (1, 3, 10):
        print(meant_zeros(f"turned {turns} times in floating point, 17 digits", 17, turns))
    print()
    heads = "least | median | 99 % | largest | not zero | doubtful | zero"
    print(f"| off a line by 1 to 9 times | decks | {heads} |")
    print("|---|---|---|---|---|---|---|---|---|")
    for power in (8, 10, 12, 13, 14, 15, 16, 17, 18):
        print(hairs(power))


if __name__ == "__main__":
    main()
