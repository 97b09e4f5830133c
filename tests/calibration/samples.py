# SPDX-License-Identifier: BSD-3-Clause
"""What the calibrations share: special mechanisms of the attack, placed anyhow, and tables."""

from __future__ import annotations

import math
import os
import random
import sys
from collections.abc import Callable, Iterator, Sequence
from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np
from attack.deck_text import Style, as_double, mapped, quaternion, rotation, significant, text_of
from attack.exact_deck import Deck, Vector
from attack.families import FAMILIES
from attack.sketch import Chance
from attack.truth import Counts, counts_of, counts_of_text

import flexact

#: Special mechanisms: most have a motion and a self-stress that a small change takes away.
SPECIAL = ("desargues", "bipartite", "octahedron", "collinear", "platform", "guide", "cranks")

#: Mechanisms of which many are not special.
ORDINARY = ("grown", "lattice", "spokes", "prism")


class Sample(NamedTuple):
    """A special mechanism before it is rounded."""

    deck: Deck
    meant: Counts


def samples(seed: int, number: int) -> Iterator[Sample]:
    """Mechanisms as they are drawn, in small whole numbers, whose rank is below both sides."""
    made = 0
    for k in range(100 * number):
        chance = Chance(f"{seed}-{k}")
        chance.hairless = True
        deck = FAMILIES[SPECIAL[k % len(SPECIAL)]](chance).deck
        meant = counts_of(deck)
        if min(meant) > 0:
            yield Sample(deck, meant)
            made += 1
        if made == number:
            return


def ordinary_samples(seed: int, number: int) -> Iterator[Sample]:
    """Likewise others, whose counts stay the same when every node is moved by a little."""
    made = 0
    for k in range(100 * number):
        chance = Chance(f"{seed}-{k}")
        chance.hairless = True
        deck = FAMILIES[ORDINARY[k % len(ORDINARY)]](chance).deck
        meant = counts_of(deck)
        if counts_of(mapped(deck, partial(_shaken, chance=chance), lambda v: v)) == meant:
            yield Sample(deck, meant)
            made += 1
        if made == number:
            return


def _shaken(place: Vector, chance: random.Random) -> Vector:
    x, y, z = (part + Fraction(chance.randint(-99, 99), 9999) for part in place)
    return x, y, z


def turned_exactly(deck: Deck, chance: random.Random) -> Deck:
    """Turned anyhow, without any rounding."""
    turn = rotation(quaternion(chance, deck.planar, plain=False))
    return mapped(deck, turn, turn)


def turned_in_floating_point(deck: Deck, chance: random.Random, times: int) -> Deck:
    """Turned so many times, and scaled, with doubles."""
    turns = []
    for _ in range(times):
        angle = chance.uniform(-math.pi, math.pi)
        c, s = math.cos(angle), math.sin(angle)
        matrix = np.eye(3)
        i, j = (0, 1) if deck.planar else chance.choice(((0, 1), (1, 2), (0, 2)))
        matrix[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
        turns.append(matrix)
    scale = chance.uniform(0.1, 10.0)

    def turn(v: Vector) -> Vector:
        moved = np.array([float(part) for part in v])
        for matrix in turns:
            moved = matrix @ moved
        x, y, z = (Fraction(part) for part in scale * moved)
        return x, y, z

    return mapped(deck, turn, turn)


def typed(deck: Deck, digits: int, is_cut: bool = False) -> str:
    """The text with so many significant digits, rounded or cut off; 17 give the double."""
    write = as_double if digits >= 17 else partial(significant, digits)
    if is_cut:
        write = partial(_cut_off, digits)
    return text_of(deck, Style(write, write, digits))


def _cut_off(digits: int, number: Fraction) -> str:
    context = Context(prec=digits, rounding=ROUND_DOWN)
    made = context.divide(Decimal(number.numerator), Decimal(number.denominator))
    return f"{made:f}"


def lifted(text: str, meant: Counts) -> bool:
    """Whether the numbers as typed have a higher rank than what is meant."""
    return counts_of_text(text).under_constrained < meant.under_constrained


def analysed(text: str, **asked: object) -> flexact.Analysis | None:
    """The result, None where the digits leave no sound deck."""
    try:
        return flexact.analyse(flexact.read_text(text), **asked)  # type: ignore[arg-type]
    except flexact.FlexactError:
        return None


def quantiles(values: Sequence[float], write: Callable[[float], str] = "{:.2g}".format) -> str:
    """Least, median, 99 in 100, and largest, as cells of a table."""
    if not values:
        return " | ".join("-" * 4)
    found = np.quantile(values, (0.0, 0.5, 0.99, 1.0))
    return " | ".join(write(float(value)) for value in found)
