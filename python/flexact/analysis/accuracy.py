# SPDX-License-Identifier: BSD-3-Clause
"""To what the parts of a machine are made and put together: what a margin is held against."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from ..util.plain_text import in_short
from ..util.quantities import Quantity, QuantityError, larger_in_words, measured
from .failing import AnalysisError
from .verdict import Margin

#: A length [m], or a length [m] and an angle [rad]; a text says its unit, such as "20um,1mrad".
AccuracyGiven = Quantity | Iterable[Quantity | None]

_NO_NUMBERS = (bytes, bytearray, memoryview)


class Accuracy(NamedTuple):
    """How far nodes and elements of the machine may lie from where the model has them."""

    length: float
    """Of nodes [m]."""
    angle: float | None = None
    """Of elements [rad]; None where nothing is known of it."""

    def __str__(self) -> str:
        """As the command takes it, such as "2e-05,0.0001"."""
        return ",".join(repr(part) for part in self if part is not None)

    def exceeds(self, margin: Margin) -> tuple[bool, bool]:
        """Whether it is larger than the length, and than the angle, of a margin."""
        length = margin.length is not None and margin.length < self.length
        if margin.angle is None or self.angle is None:
            return length, False
        return length, margin.angle < self.angle

    def require_within(self, size: float) -> None:
        """Raise where it is larger than the model: a slip of the unit.

        Args:
            size: Of the model [m].

        Raises:
            AnalysisError: it is.
        """
        if self.length > size:
            most = f"the whole model, {size:.3g} m"
            raise AnalysisError(larger_in_words("the accuracy", f"{self.length:g} m", most, "20um"))

    @classmethod
    def of(cls, given: AccuracyGiven) -> Accuracy:
        """An accuracy as it may be given.

        Raises:
            TypeError: it is neither a number nor two.
            ValueError: one is not positive, or not finite.
        """
        parts: list[Any] = [given]
        if isinstance(given, str):
            parts = given.split(",")
        elif isinstance(given, Iterable) and not isinstance(given, _NO_NUMBERS):
            parts = list(given)
            parts = parts[:1] if parts[1:] == [None] else parts
        if not 1 <= len(parts) <= 2:
            raise TypeError(
                "the accuracy is a length [m], or a length and an angle [rad], "
                f"not {len(parts)} numbers"
            )
        return cls(*map(_checked, parts, ("m", "rad")))


def _checked(part: Any, unit: str) -> float:
    if isinstance(part, (*_NO_NUMBERS, bool)):
        raise TypeError(f"the accuracy must be a number or two, not {type(part).__name__}")
    try:
        value = measured(part, unit)
    except QuantityError as error:
        raise TypeError(f"the accuracy must be a number or two: {error}") from None
    except TypeError:
        raise TypeError(
            f"the accuracy must be a number or two, not {type(part).__name__}"
        ) from None
    except (ValueError, OverflowError):
        raise ValueError(f"the accuracy must be a number or two, not {in_short(part)}") from None
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(f"the accuracy must be finite and positive, not {value}")
    return value
