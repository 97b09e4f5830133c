"""What a frozen result or model does about the arrays that it holds."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np


@dataclass(frozen=True, eq=False, repr=False)
class Frozen:
    """Base of frozen dataclasses whose arrays are read-only, alone or in named tuples.

    A pickle forgets that an array is read-only, so that an object is made anew from its
    fields when it comes out of one; what it has cached is not pickled.
    """

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        _freeze(getattr(self, field.name) for field in fields(self))

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        """Class and fields."""
        return type(self), tuple(getattr(self, field.name) for field in fields(self))


def _freeze(values: Iterable[object]) -> None:
    for value in values:
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
        elif isinstance(value, tuple):
            _freeze(value)
