# SPDX-License-Identifier: BSD-3-Clause
"""What an elastic analysis refuses, in words."""

from __future__ import annotations

from ..base.errors import FlexactError


class ElasticError(FlexactError, ValueError):
    """What is asked has no answer; the text says why, and what to do."""


class UnknownError(ElasticError, LookupError):
    """A node, element, deformation or coordinate that is not there; the text says what is."""


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
