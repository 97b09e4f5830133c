# SPDX-License-Identifier: BSD-3-Clause
"""Names of parts and points: how they are read off elements, and how they are looked up."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ..core.elements import POSITION_NAMES, ROTATION_NAMES
from ..deck.rendering import ModelError, model_error
from ..util.loading import load
from ..util.text import in_short

#: Names of coordinates, which no point can have.
COORDINATES = frozenset((*POSITION_NAMES, *ROTATION_NAMES))


def is_coordinate(given: object) -> bool:
    """Whether this is the name of a coordinate."""
    return isinstance(given, str) and given in COORDINATES


def one_line(name: str) -> str:
    """A name as the comment of a deck's line can hold it."""
    line = "".join(c if c.isprintable() else " " for c in name)
    return line.lstrip(" %#").rstrip()


_TAIL = re.compile(r",?\s+(?:part\s+)?\d+\s+of\s+\d+$|,\s*\d+$")
#: What SPACAR Light calls the beams of an element.
_OF_ELEMENT = re.compile(r"^(element\s+\d+)\s+beam\s+\d+$")


def part_name(element_name: str) -> str:
    """The name of the part that an element belongs to: without its own number in the part."""
    found = _OF_ELEMENT.match(element_name)
    return found[1] if found else _TAIL.sub("", element_name)


_HALF = re.compile(r", (?:half [12]|bar(?: [123])?)$")


def is_half(name: str) -> bool:
    """Whether this is what the half of a notch, or a bar beside one, is called.

    A body may carry it.
    """
    return bool(_HALF.search(name))


def own_number(element_name: str) -> int:
    """The number of an element in its part, 2 of "stage, 2"; 0 where it has none."""
    found = re.search(r"\d+", element_name[len(part_name(element_name)) :])
    return int(found[0]) if found else 0


def unknown(code: str, what: str, name: str, known: Iterable[str]) -> ModelError:
    """The error for a name that nothing has, with the nearest names."""
    near = nearest(name, known)
    hint = f"did you mean {' or '.join(map(in_short, near))}?" if near else ""
    return model_error(code, f"there is no {what} named {in_short(name)}", hint)


def nearest(name: str, known: Iterable[str]) -> list[str]:
    """The names that look most like this one, at most three, the likeliest first."""
    by_lower = {each.lower(): each for each in sorted(set(known)) if each}
    near = load("difflib").get_close_matches(name.lower(), by_lower, 3)
    return [by_lower[each] for each in near]


def ambiguous(what: str, name: str) -> ModelError:
    """The error for a name that several things have."""
    return model_error(
        "ambiguous-name",
        f"several {what}s are named {in_short(name)}",
        "give one of them another name, or use the handle that its call gave",
    )
