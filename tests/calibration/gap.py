# SPDX-License-Identifier: BSD-3-Clause
"""What sets 100 in theory.md (9): how far below the rest stand zeros that printed digits lift.

    python tests/calibration/gap.py

Special mechanisms printed with 10 to 14 digits, analysed without a proof. A quarter of a minute.
"""

from __future__ import annotations

from samples import Chance, analysed, lifted, quantiles, samples, turned_exactly, typed

DECKS = 250
GAP = 100.0


def line(digits: int) -> str:
    """The smallest value that is not meant to be zero, over the largest that is."""
    found = []
    for k, sample in enumerate(samples(3, DECKS)):
        text = typed(turned_exactly(sample.deck, Chance(f"{digits}-{k}")), digits)
        analysis = analysed(text, method="svd", prove=False) if lifted(text, sample.meant) else None
        if analysis is None:
            continue
        rank = analysis.columns - sample.meant.under_constrained
        values = analysis.scaled_singular_values
        if 0 < rank < values.size and values[rank] > 0.0:
            found.append(float(values[rank - 1] / values[rank]))
    nearer = sum(ratio < GAP for ratio in found)
    return f"| {digits} | {len(found)} | {quantiles(found)} | {nearer} |"


def main() -> None:
    """Print the table."""
    print("| digits | decks | least | median | 99 % | largest | below 100 |")
    print("|---|---|---|---|---|---|---|")
    for digits in (6, 8, 9, 10, 11, 12, 13, 14):
        print(line(digits))


if __name__ == "__main__":
    main()
