# SPDX-License-Identifier: BSD-3-Clause
"""From an exact deck to text: turned, moved, stretched, rounded to digits and renumbered."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from functools import partial
from typing import NamedTuple

from .exact_deck import ORIGIN, ZERO, Deck, Element, Vector

Writer = Callable[[Fraction], str]
#: Numbers of significant digits, each as likely; 17 and more are all the digits of a double.
DIGITS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 15, 16, 17, 17, 17)
_ALL_DIGITS = 17
#: Whole numbers beyond this are no doubles.
_LONGEST = 10**15
_EXACT = Context(prec=400)


class Style(NamedTuple):
    """How numbers are typed."""

    places: Writer
    directions: Writer
    digits: float
    """Of the largest coordinate; endless where nothing is rounded."""


def style_of(deck: Deck, chance: random.Random) -> Style:
    """Significant digits, decimals, or the double's own."""
    digits = chance.choice(DIGITS)
    if digits >= _ALL_DIGITS:
        return Style(as_double, as_double, math.log10(2.0**53))
    directions = partial(significant, digits)
    if chance.random() < 0.5:
        return Style(directions, directions, digits)
    return Style(partial(decimals, digits - _order(deck)), directions, digits)


def in_whole_numbers(deck: Deck) -> Deck | None:
    """The deck in a unit in which nothing has decimals; None where numbers would be long."""
    numbers = [part for place in deck.places.values() for part in place]
    numbers += [part for each in deck.elements.values() for part in each.vector or ()]
    unit = math.lcm(*(number.denominator for number in numbers))
    if unit * max(map(abs, numbers), default=ZERO) > _LONGEST:
        return None

    def scaled(v: Vector) -> Vector:
        return unit * v[0], unit * v[1], unit * v[2]

    return mapped(deck, scaled, scaled)


def exact(number: Fraction) -> str:
    """Every digit of a number whose decimals end; else 40 of them."""
    finite = pow(10, 600, number.denominator) == 0
    context = _EXACT if finite else Context(prec=40)
    return _plain(context.divide(Decimal(number.numerator), Decimal(number.denominator)))


def has_long_numbers(text: str, digits: int = _ALL_DIGITS) -> bool:
    """Whether a number has more digits; more than 17 do not tell doubles further apart."""
    numbers = re.findall(r"(?<![\w.])[-+]?([\d.]+)", text)
    return any(len(number.replace(".", "").strip("0")) > digits for number in numbers)


def as_double(number: Fraction) -> str:
    """The shortest digits of the nearest double."""
    return repr(float(number))


def significant(digits: int, number: Fraction) -> str:
    """Rounded to significant digits."""
    context = Context(prec=digits, rounding=ROUND_HALF_EVEN)
    return _plain(context.divide(Decimal(number.numerator), Decimal(number.denominator)))


def decimals(places: int, number: Fraction) -> str:
    """Rounded to decimals after the point, or before it where there are fewer than none."""
    return _plain(_EXACT.scaleb(Decimal(round(number * Fraction(10) ** places)), -places))


def _plain(number: Decimal) -> str:
    short = number.normalize(_EXACT)
    _, digits, exponent = short.as_tuple()
    assert isinstance(exponent, int)
    return f"{short:f}" if -20 < exponent <= 0 or len(digits) + exponent < 12 else f"{short}"


def _order(deck: Deck) -> int:
    """Digits before the point of the largest coordinate."""
    largest = max((abs(part) for place in deck.places.values() for part in place), default=0)
    return math.floor(math.log10(largest)) + 1 if largest else 1


def mapped(deck: Deck, move: Callable[[Vector], Vector], turn: Callable[[Vector], Vector]) -> Deck:
    """A deck whose places and vectors are others."""
    elements = {
        number: each if each.vector is None else each._replace(vector=turn(each.vector))
        for number, each in deck.elements.items()
    }
    nodes = (node for node, slot in deck.slots.items() if slot == "p")
    places = {node: move(deck.places.get(node, ORIGIN)) for node in nodes}
    return Deck(elements, places, set(deck.held), set(deck.released))


def quaternion(chance: random.Random, planar: bool, plain: bool) -> tuple[Fraction, ...]:
    """A rotation: about an axis whose cosine and sine end after few decimals, or any."""
    if plain:
        axis = 3 if planar else chance.choice((1, 2, 3))
        parts = [0, 0, 0, 0]
        parts[0], parts[axis] = chance.choice(((1, 2), (2, 1), (1, 3), (3, -1), (1, -7), (7, 1)))
        return tuple(Fraction(part) for part in parts)
    if planar:
        angle = math.radians(chance.choice((30, 45, 60, 15, 10, chance.uniform(-180, 180))))
        return (Fraction(1), Fraction(0), Fraction(0), Fraction(math.tan(angle / 2)))
    return tuple(Fraction(chance.uniform(-1, 1)) for _ in range(4))


def rotation(parts: tuple[Fraction, ...]) -> Callable[[Vector], Vector]:
    """The exact rotation of a quaternion of any length."""
    w, x, y, z = parts
    n = w * w + x * x + y * y + z * z
    matrix = (
        ((w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n),
        (2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n),
        (2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n),
    )

    def turned(v: Vector) -> Vector:
        a, b, c = (row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in matrix)
        return a, b, c

    return turned


def text_of(deck: Deck, style: Style) -> str:
    """The deck's text, in the order in which it holds its parts."""
    lines = [_element(number, each, style.directions) for number, each in deck.elements.items()]
    used = 2 if deck.planar else 3
    slots = deck.slots
    for node, place in deck.places.items():
        lines.append(f"X {node} {' '.join(style.places(part) for part in place[:used])}")
    lines += _holds(deck, slots)
    for number in sorted({number for number, _ in deck.released}):
        parts = sorted(k for each, k in deck.released if each == number)
        lines.append(f"RLSE {number} {' '.join(map(str, parts))}")
    return "\n".join([*lines, "END", "HALT", "END", "END"]) + "\n"


def _element(number: int, element: Element, write: Writer) -> str:
    words = [element.keyword, number, *element.nodes, *map(write, element.vector or ())]
    return " ".join(map(str, words))


def _holds(deck: Deck, slots: dict[int, str]) -> list[str]:
    lines = []
    for node, slot in slots.items():
        axes = deck.axes(slot)
        held = [axis for axis in axes if (node, axis) in deck.held]
        first = 2 if slot == "o" else 1
        if len(held) == len(axes):
            lines.append(f"FIX {node}")
        elif held:
            lines.append(f"FIX {node} {' '.join(str(axis + first) for axis in held)}")
    return lines


def renumbered(deck: Deck, chance: random.Random) -> Deck:
    """Other numbers of nodes and elements, and another order of all lines."""
    nodes, elements = list(deck.slots), list(deck.elements)
    new = dict(zip(nodes, chance.sample(range(1, 3 * len(nodes) + 1), len(nodes)), strict=True))
    label = dict(
        zip(elements, chance.sample(range(1, 3 * len(elements) + 1), len(elements)), strict=True)
    )
    chance.shuffle(elements)
    chance.shuffle(nodes)
    return Deck(
        {
            label[each]: deck.elements[each]._replace(
                nodes=tuple(new[node] for node in deck.elements[each].nodes)
            )
            for each in elements
        },
        {new[node]: deck.places[node] for node in nodes if node in deck.places},
        {(new[node], axis) for node, axis in deck.held if node in new},
        {(label[number], part) for number, part in deck.released},
    )
