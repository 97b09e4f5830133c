# SPDX-License-Identifier: BSD-3-Clause
"""Values of tables: each check gives the value as it is used, or raises ValueError in words."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...core.elements import element_kinds

#: Fourth powers of sizes, times moduli, are numbers.
LARGEST = 1e30


def flag(value: Any) -> bool:
    """True or false; also 1 and 0."""
    if isinstance(value, bool) or (isinstance(value, (int, float)) and value in (0, 1)):
        return bool(value)
    raise ValueError("true or false is wanted")


def number(value: Any) -> float:
    """A finite number."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError("a number is wanted")
    try:
        made = float(value)
    except OverflowError:
        made = math.inf
    if not math.isfinite(made):
        raise ValueError("the number is not finite")
    return made


def whole(value: Any) -> int:
    """A whole number, also one like 2.0."""
    made = number(value)
    if made != int(made):
        raise ValueError("a whole number is wanted")
    return int(made)


def positive(value: Any) -> float:
    """A number above zero, neither tiny nor huge."""
    if not 1.0 / LARGEST < (made := number(value)) < LARGEST:
        raise ValueError(f"a number between 0 and {LARGEST:g} is wanted")
    return made


def not_negative(value: Any) -> float:
    """A number from zero on."""
    return 0.0 if number(value) == 0.0 else positive(value)


def count(value: Any) -> int:
    """A whole number from 1 on."""
    if not 1 <= (made := whole(value)) < 10**6:
        raise ValueError("a whole number from 1 on is wanted")
    return made


def part(value: Any) -> float:
    """A number from 0 to 1."""
    if not 0.0 <= (made := number(value)) <= 1.0:
        raise ValueError("a number from 0 to 1 is wanted")
    return made


def text(value: Any) -> str:
    """A text on one line."""
    if not isinstance(value, str):
        raise ValueError("a text is wanted")
    return " ".join(value.split())


def texts(value: Any) -> tuple[str, ...]:
    """A text, or several."""
    return tuple(text(each) for each in (value if isinstance(value, list) else [value]))


def vector(*sizes: int) -> Callable[[Any], tuple[float, ...]]:
    """What checks for so many finite numbers."""

    def check(value: Any) -> tuple[float, ...]:
        given = value if isinstance(value, (list, tuple)) else [value]
        if len(given) not in sizes:
            raise ValueError(f"{' or '.join(map(str, sizes))} numbers are wanted")
        return tuple(number(each) for each in given)

    return check


def direction(value: Any) -> tuple[float, ...]:
    """A vector that is not zero."""
    made = vector(3)(value)
    if not any(made):
        raise ValueError("the vector is zero")
    return made


def numbers_from_one(value: Any) -> tuple[int, ...]:
    """Numbers from 1 on, each once; a single one may stand without brackets."""
    made = tuple(count(each) for each in (value if isinstance(value, (list, tuple)) else [value]))
    if len(set(made)) < len(made):
        raise ValueError("a number stands there twice")
    return made


def deformations(value: Any) -> tuple[int, ...]:
    """Numbers of deformations from 1 to 6, each once."""
    made = numbers_from_one(value)
    if max(made, default=1) > 6:
        raise ValueError("deformations have numbers from 1 to 6")
    return made


def shape(value: Any) -> str:
    """The kind of a cross-section."""
    if value not in ("rect", "circ"):
        raise ValueError("'rect' or 'circ' is wanted")
    return str(value)


def sizes(value: Any) -> tuple[float, ...]:
    """Width and thickness, or a diameter."""
    return tuple(positive(each) for each in vector(1, 2)(value))


#: Colours by name; by number from 1 in this order.
COLOURS = {
    "blue": (0.62, 0.76, 0.86),
    "grey": (0.78, 0.78, 0.78),
    "darkblue": (0.0, 0.45, 0.7),
    "darkgrey": (0.44, 0.44, 0.44),
    "green": (0.5, 0.76, 0.56),
    "darkgreen": (0.35, 0.54, 0.4),
}


def colour(value: Any) -> tuple[float, ...]:
    """Red, green and blue from 0 to 1, or to 255 where one exceeds 1; a name, or its number."""
    if isinstance(value, str):
        if value not in COLOURS:
            raise ValueError(f"one of {', '.join(COLOURS)} is wanted, or three numbers")
        return COLOURS[value]
    if not isinstance(value, (list, tuple)):
        if not 1 <= whole(value) <= len(COLOURS):
            raise ValueError(f"the colours have numbers from 1 to {len(COLOURS)}")
        return tuple(COLOURS.values())[whole(value) - 1]
    made = vector(3)(value)
    if max(made) > 1.0:
        made = tuple(each / 255.0 for each in made)
    return tuple(part(each) for each in made)


def kind(value: Any) -> str:
    """The keyword of an element, in small letters."""
    known = [each.keyword.lower() for each in element_kinds()]
    if not isinstance(value, str) or value.lower() not in known:
        raise ValueError(f"one of {', '.join(known)} is wanted")
    return value.lower()


def moments(value: Any) -> tuple[float, ...]:
    """Six moments of inertia, none of them huge."""
    made = vector(6)(value)
    if max(map(abs, made)) >= LARGEST:
        raise ValueError(f"numbers below {LARGEST:g} are wanted")
    return made
