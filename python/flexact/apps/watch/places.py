# SPDX-License-Identifier: BSD-3-Clause
"""What can be switched: a deformation of an element or a coordinate of a node; and its states."""

from __future__ import annotations

from typing import NamedTuple

from ...core.elements import Class


class DeformationPlace(NamedTuple):
    """A deformation of an element; of a divided flexure as if it were its first beam."""

    element: int
    """Number of the element."""
    number: int
    """Number of the deformation, from 1."""


class CoordinatePlace(NamedTuple):
    """A coordinate of a node."""

    node: int
    """Number of the node."""
    name: str
    """Such as x or rz."""


Place = DeformationPlace | CoordinatePlace


class Edit(NamedTuple):
    """A deformation or a coordinate, and the class that it gets."""

    place: Place
    to: Class


_DEFORMATION = {
    "held": Class.FIXED,
    "released": Class.DEPENDENT,
    "independent": Class.INDEPENDENT,
}
_COORDINATE = {
    "fixed": Class.FIXED,
    "free": Class.DEPENDENT,
    "independent": Class.INDEPENDENT,
}


def states_of(place: Place) -> dict[str, Class]:
    """The states that a place can have: words and classes."""
    return _DEFORMATION if isinstance(place, DeformationPlace) else _COORDINATE


def state_word(place: Place, value: Class) -> str:
    """The word of a class: "held", "fixed", ..."""
    return next(word for word, each in states_of(place).items() if each == value)
