# SPDX-License-Identifier: BSD-3-Clause
"""What flexures hold as lines and faces at their places, as large as they are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from ...core.arrays import FloatArray
from .drawing_spaces import SpaceShape, shape_of_space
from .spaces import FamilyLike

#: How large a line or a plane is drawn, in sizes of the flexure, and at least, and at most, in
#: parts of the drawing's size; a line is `space_families` long for a drawing of size one.
_OF_PART, _LEAST, _MOST = 1.7, 0.35, 1.0


class SpaceLike(Protocol):
    """A space of wrenches; see `flexact.advice.spaces.screw_space`."""

    @property
    def families(self) -> Sequence[FamilyLike]:
        """What it is made of."""

    @property
    def about(self) -> FloatArray:
        """(3,) the middle of the flexure [m]."""


class HoldLike(Protocol):
    """What a flexure holds; see `flexact.advice.holding`."""

    @property
    def space(self) -> SpaceLike:
        """The wrenches that it carries."""

    @property
    def extent(self) -> float:
        """Its size [m]."""


def shape_of_hold(hold: HoldLike, size: float, *, planar: bool) -> SpaceShape:
    """What is drawn of what a flexure holds.

    Args:
        hold: What it holds; a moment is drawn only where there is no force.
        size: Of the drawing [m].
        planar: Whether the drawing is.
    """
    own = float(np.clip(_OF_PART * hold.extent, _LEAST * size, _MOST * size))
    made = shape_of_space(
        hold.space.families, hold.space.about, own, is_freedom=False, planar=planar
    )
    return replace(made, arrows=()) if made.lines or made.faces else made
