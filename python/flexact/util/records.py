# SPDX-License-Identifier: BSD-3-Clause
"""Kinds of records: frozen ones that hold arrays, words of enumerations, what is found once."""

from __future__ import annotations

import sys
from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass, fields
from enum import Enum
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

Value = TypeVar("Value")


@dataclass(frozen=True, eq=False, repr=False)
class Frozen:
    """Base of frozen dataclasses whose arrays are read-only, alone or in named tuples.

    A pickle forgets that an array is read-only, so that an object is made anew from its
    fields when it comes out of one; what it has cached is not pickled.
    """

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        _freeze(self.__dict__.values())

    def __reduce__(self) -> tuple[Callable[..., object], tuple[Any, ...]]:
        """What makes it anew, class and fields."""
        return _made, (type(self), *(getattr(self, field.name) for field in fields(self)))


def kept(owner: Frozen, key: Hashable, find: Callable[[], Value]) -> Value:
    """What is found once of an object that does not change, and is kept in it.

    As by `cached_property`, for what is found above the room of the object.
    """
    found: dict[Hashable, Value] = owner.__dict__.setdefault("_kept", {})
    if key not in found:
        found[key] = find()
    return found[key]


def _made(kind: type, *values: object) -> object:
    _freeze(values, every=True)
    return kind(*values)


def _freeze(values: Iterable[object], *, every: bool = False) -> None:
    """Make arrays read-only; tuples that say that theirs are so already are passed over."""
    for value in values:
        if isinstance(value, np.ndarray):
            value.setflags(write=False)
        elif isinstance(value, tuple) and (every or not hasattr(value, "is_read_only")):
            _freeze(value, every=every)


Array = TypeVar("Array", bound=np.ndarray)


def read_only(array: Array) -> Array:
    """An array that was just made, closed to changes."""
    array.setflags(write=False)
    return array


class Word(str, Enum):
    """Base of enumerations whose values are words, which they are in texts."""

    def __str__(self) -> str:
        """The word itself."""
        return str(self.value)


if TYPE_CHECKING or sys.version_info >= (3, 12):
    from functools import cached_property as cached_property
else:

    class cached_property:  # noqa: N801
        """As that of `functools` from Python 3.12 on."""

        def __init__(self, function):
            """Of a method."""
            self.function = function
            self.name = function.__name__
            self.__doc__ = function.__doc__
            self.__module__ = function.__module__

        def __set_name__(self, owner, name):
            """What it is called, where it is kept."""
            self.name = name

        def __get__(self, instance, owner=None):
            """What was found; kept in the object, it is not asked for here again."""
            if instance is None:
                return self
            found = self.function(instance)
            instance.__dict__[self.name] = found
            return found
