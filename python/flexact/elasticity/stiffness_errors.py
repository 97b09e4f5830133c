# SPDX-License-Identifier: BSD-3-Clause
"""What an elastic analysis refuses, in words."""

from __future__ import annotations

import math

from ..util.errors import FlexactError
from ..util.quantities import larger_in_words


class ElasticError(FlexactError, ValueError):
    """What is asked has no answer; the text says why, and what to do."""


def require_within(value: float, size: float, is_turn: bool, what: str) -> None:
    """Raise where a stroke or an error is larger than the model: a slip of the unit.

    Args:
        value: From where the model rests [m, rad].
        size: Of the model [m].
        is_turn: Whether it is an angle.
        what: Such as "the stroke of z of node 1".

    Raises:
        ElasticError: the length is larger than the size, or the angle than half a turn.
    """
    if abs(value) <= (math.pi if is_turn else size):
        return
    most = "half a turn" if is_turn else f"the whole model, {size:.3g} m"
    unit, example = ("rad", "1mrad") if is_turn else ("m", "3mm")
    raise ElasticError(larger_in_words(what, f"{abs(value):.6g} {unit}", most, example))


class UnknownError(ElasticError, LookupError):
    """A node, element, deformation or coordinate that is not there; the text says what is."""


class StrokeWarning(UserWarning):
    """A stroke that is surely meant from where the coordinate rests, and is not given so."""


class StrokeError(ElasticError):
    """A state that could not be reached.

    Attributes:
        reached: What was reached of what was asked for: the value of a driven coordinate, of a
            load the factor, of an error its value, in the units in which it was given.
        place: The node or element where it stopped, in words; empty where it is not known.
    """

    def __init__(self, message: str, reached: float, place: str = "") -> None:
        """Keep the text, and how far it went."""
        super().__init__(message)
        self.reached = reached
        self.place = place

    def __reduce__(self) -> tuple[type[StrokeError], tuple[str, float, str]]:
        """What makes it anew, as a worker of a sweep does."""
        return type(self), (str(self), self.reached, self.place)
