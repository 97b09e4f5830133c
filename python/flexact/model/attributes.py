# SPDX-License-Identifier: BSD-3-Clause
"""How the elements of a model are to be drawn, as its deck or its maker said."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.raw import RawAppearance
from ..util.records import Frozen


class CrossSection(IntEnum):
    """Shape of a member's cross-section, as CROSSTYPE names it."""

    NONE = 0
    RECT = 1
    CIRC = 2
    RECTHOL = 3
    CIRCHOL = 4
    LINE = 5


@dataclass(frozen=True, eq=False)
class Appearance(Frozen):
    """What was said about drawing the elements; the analysis does not use it.

    Attributes:
        cross_section: (elements,) `CrossSection`; NONE where none was given.
        dimensions: (elements, 2) outer sizes along local y and local z [m], a diameter
            twice; 0 where not given.
        colour: (elements, 3) red, green, blue from 0 to 1; NaN where not given.
        edge_colour: (elements, 3) the same for edges.
        opacity: (elements,) from 0, invisible, to 1; NaN where not given.
        drawn: (elements,) whether an element is drawn.
    """

    cross_section: IntArray
    dimensions: FloatArray
    colour: FloatArray
    edge_colour: FloatArray
    opacity: FloatArray
    drawn: BoolArray

    @classmethod
    def plain(cls, elements: int) -> Appearance:
        """All elements are drawn, and nothing else is given; takes no memory."""
        nan = np.float64(np.nan)
        return cls(
            np.broadcast_to(np.int32(CrossSection.NONE), (elements,)),
            np.broadcast_to(np.float64(0.0), (elements, 2)),
            np.broadcast_to(nan, (elements, 3)),
            np.broadcast_to(nan, (elements, 3)),
            np.broadcast_to(nan, (elements,)),
            np.broadcast_to(np.True_, (elements,)),
        )

    @classmethod
    def of(cls, raw: RawAppearance) -> Appearance:
        """What a deck says; copies, since what was read lies in larger arrays."""
        choice, value = raw
        sizes, colour, edge_colour = (value[part].T.copy() for part in np.s_[0:2, 2:5, 5:8])
        return cls(choice[0].copy(), sizes, colour, edge_colour, value[8].copy(), choice[1] == 1)
