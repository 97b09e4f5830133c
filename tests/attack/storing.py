# SPDX-License-Identifier: BSD-3-Clause
"""Whether storing the numbers of a deck explains that a singular value is not zero.

A value u' D v with all its digits is held against what half a unit of the last bit of every
number makes of it, or of the last digit where ten to fourteen were printed, to first order.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any

import mpmath

from .exact_deck import Deck, Vector
from .exact_rows import rows_of

_DIGITS = 80
#: With so many digits a zero comes out below this.
_ZERO = mpmath.mpf(10) ** -60
#: Numbers of so many digits were printed; of more, they stand for what is stored.
_PRINTED = range(10, 15)

Matrix = list[list[Any]]


def explains(deck: Deck, rank: int) -> bool:
    """Whether each value beyond `rank` is no larger than what storing the numbers makes of it."""
    with mpmath.workdps(_DIGITS):
        plain = _matrix(deck)
        scales = [1 / mpmath.norm(row) if any(row) else mpmath.mpf(1) for row in plain]
        scaled = mpmath.matrix([[a * s for a in row] for row, s in zip(plain, scales, strict=True)])
        u, values, v = mpmath.svd_r(scaled, full_matrices=False)
        beyond = range(rank, len(values))
        lifts = [mpmath.mpf(0)] * len(values)
        for moved in _moved(deck):
            for i, changed in _changes(plain, _matrix(moved)):
                for k in beyond:
                    part = mpmath.fdot(changed, [v[k, j] for j in range(len(changed))])
                    lifts[k] += abs(u[i, k] * scales[i] * part)
        return all(values[k] <= max(lifts[k], _ZERO) for k in beyond)


def _changes(before: Matrix, after: Matrix) -> Iterator[tuple[int, list[Any]]]:
    for i, (old, new) in enumerate(zip(before, after, strict=True)):
        if old != new:
            yield i, [b - a for a, b in zip(old, new, strict=True)]


def _matrix(deck: Deck) -> Matrix:
    """D(c), each row up to its factor, with rotations in about the mechanism's own length."""
    columns = deck.columns()
    slots = deck.slots
    length = _length(deck)
    made = []
    for _, nodes, row in rows_of(deck, lambda number: number):
        line = [mpmath.mpf(0)] * len(columns)
        for node, block in zip(nodes, row, strict=True):
            for axis, value in enumerate(block):
                if value and (node, axis) in columns:
                    part = value / length if slots[node] == "o" else value
                    line[columns[node, axis]] += mpmath.mpf(part.numerator) / part.denominator
        made.append(line)
    return made


def _length(deck: Deck) -> Fraction:
    every = [
        float(sum(part * part for part in deck.chord(each))) for each in deck.elements.values()
    ]
    known = [math.log(each) / 2 for each in every if each > 0]
    return Fraction(math.exp(sum(known) / len(known))) if known else Fraction(1)


def _moved(deck: Deck) -> Iterator[Deck]:
    """The deck with one number changed by half a unit, for each number."""
    for node, place in deck.places.items():
        for other in _changed(place):
            yield replace(deck, places={**deck.places, node: other})
    for number, element in deck.elements.items():
        for other in _changed(element.vector or ()):
            changed = element._replace(vector=other)
            yield replace(deck, elements={**deck.elements, number: changed})


def _changed(vector: tuple[Fraction, ...]) -> Iterator[Vector]:
    for axis, value in enumerate(vector):
        if value:
            parts = list(vector)
            parts[axis] = value + _half_unit(value)
            yield parts[0], parts[1], parts[2]


def _half_unit(value: Fraction) -> Fraction:
    digits = str(mpmath.nstr(mpmath.mpf(value.numerator) / value.denominator, 30))
    places = digits.lower().split("e")[0].replace(".", "").replace("-", "").strip("0")
    if len(places) in _PRINTED:
        leading = math.floor(math.log10(abs(float(value))))
        return Fraction(10) ** (leading - len(places) + 1) / 2
    return Fraction(math.ulp(float(value))) / 2
