# SPDX-License-Identifier: BSD-3-Clause
"""What the variants of a table were made from, so that others can be made between them."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from ..model.data import ModelData
from ..model.model import Model
from ..model.variation import varied
from ..util.records import Frozen
from .parameters import Row, Value

Make = Callable[..., Model]


class Source(Protocol):
    """How the variants of a table came about."""

    def variant(self, a: int, b: int, share: float, row: Row) -> ModelData:
        """The model between the variants of two rows, with its parameters.

        Raises:
            Exception: whatever a function of the user raises.
        """

    def goes_between(self, a: int, b: int) -> bool:
        """Whether there is anything between two variants of the same topology."""

    def taken(self, index: np.ndarray) -> Source:
        """The source of some of the rows."""

    def portable(self) -> Source | None:
        """What of it can be pickled."""


@dataclass(frozen=True, eq=False)
class Positions(Frozen):
    """A model, with its nodes elsewhere or other deformations held; see `sweep`."""

    data: ModelData
    positions: FloatArray | None
    held: BoolArray | None

    @property
    def count(self) -> int:
        """How many variants there are."""
        given = self.positions if self.held is None else self.held
        return 0 if given is None else len(given)

    def variant(self, a: int, b: int, share: float, row: Row) -> ModelData:
        """Each position on the straight line between its two places."""
        between = None
        if self.positions is not None:
            first, last = self.positions[a], self.positions[b]
            between = first + share * (last - first)
        return varied(self.data, between, None if self.held is None else self.held[a])

    def goes_between(self, a: int, b: int) -> bool:
        """Unless what is held differs, or nothing moves at all."""
        if self.positions is None:
            return False
        return self.held is None or bool((self.held[a] == self.held[b]).all())

    def taken(self, index: np.ndarray) -> Positions:
        """The source of some of the rows."""
        return Positions(
            self.data,
            None if self.positions is None else self.positions[index],
            None if self.held is None else self.held[index],
        )

    def portable(self) -> Positions:
        """All of it."""
        return self


@dataclass(frozen=True, eq=False)
class Making(Frozen):
    """A function of parameters that makes the model."""

    make: Make

    def variant(self, a: int, b: int, share: float, row: Row) -> ModelData:
        """What the function makes of the parameters."""
        return made_by(self.make, row)

    def goes_between(self, a: int, b: int) -> bool:
        """Wherever parameters differ."""
        return True

    def taken(self, index: np.ndarray) -> Making:
        """The function knows no rows."""
        return self

    def portable(self) -> Making | None:
        """Functions without a name in a module cannot be pickled."""
        try:
            pickle.dumps(self.make)
        except Exception:
            return None
        return self


def made_by(make: Make, row: Row) -> ModelData:
    """The data of the model that a function makes of parameters, checked.

    Raises:
        TypeError: it makes no model.
        ModelError, DeckError: the model is wrong.
        Exception: whatever the function raises.
    """
    model = make(**row)
    if not isinstance(model, Model):
        raise TypeError(f"the function must return a flexact.Model, not {type(model).__name__}")
    data = model.data
    data.require_sound()
    return data


def between(
    names: Sequence[str], first: Sequence[Value], last: Sequence[Value], share: float
) -> Row:
    """The parameters between those of two rows, as Python's own numbers.

    What is no number is that of the first.
    """
    return {name: _between(a, b, share) for name, a, b in zip(names, first, last, strict=True)}


def _between(a: Value, b: Value, share: float) -> Value:
    if a == b or share == 0.0 or not (is_number(a) and is_number(b)):
        return a
    if share == 1.0:
        return b
    assert isinstance(a, (int, float)) and isinstance(b, (int, float))
    return float(a + share * (b - a))


def is_number(value: Value) -> bool:
    """Whether there is something between it and another one."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)
