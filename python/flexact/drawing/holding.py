# SPDX-License-Identifier: BSD-3-Clause
"""What flexures hold as lines and faces at their places, as large as they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..advice.holding import Hold
from .spaces import SpaceShape, shape_of_space

#: How large a line or a plane is drawn, in sizes of the flexure, and at least, and at most, in
#: parts of the drawing's size; a line is `space_families` long for a drawing of size one.
_OF_PART, _LEAST, _MOST = 1.7, 0.35, 1.0


def shape_of_hold(hold: Hold, size: float, *, planar: bool) -> SpaceShape:
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
