# SPDX-License-Identifier: BSD-3-Clause
"""Why a path was not followed farther."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from ..util.records import Frozen


class Ending(str, Enum):
    """Why a path was not followed farther."""

    LENGTH = "length"
    """It was followed as far as was asked."""
    CLOSED = "closed"
    """It came back to where it began."""
    BRANCHES = "branches"
    """Directions in which it may go on are more than before: others branch off."""
    TURNS_BACK = "turns back"
    """It comes to a point from which no direction leads on but the one back."""
    NOT_ZERO = "not zero"
    """No configuration near, ahead of it, has held deformations of zero."""
    ELEMENT = "element"
    """An element has left its range."""
    STEPS = "steps"
    """As many steps were taken as are allowed."""


@dataclass(frozen=True, eq=False)
class Stop(Frozen):
    """Why a path was not followed farther, and by how much it failed.

    Attributes:
        ending: Which it is.
        step: The last step that was tried [size].
        residual: The largest held deformation that was left after it [size]; 0 without.
        directions: How many independent directions are possible there.
        element: Index of the element that has left its range; -1 without.
        range: "length" or "bending" of it; empty without.
    """

    ending: Ending
    step: float = 0.0
    residual: float = 0.0
    directions: int = 0
    element: int = -1
    range: str = ""
