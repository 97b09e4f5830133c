# SPDX-License-Identifier: BSD-3-Clause
"""Hinges as they are drawn: cylinders about their axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import Member
from ...model.data import ModelData
from ...model.parts.forms import is_member
from .colours import HINGE
from .members import Elements, described
from .places import places_of_hinges, slots_of

#: Length and diameter, parts of the drawing's size.
_PARTS = (0.06, 0.03)


@dataclass(frozen=True, eq=False)
class Hinges(Elements):
    """Drawn elements without extent; ex is the axis.

    Their nodes are the position where each stands, -1 where none is known, and its two
    orientations.

    Attributes:
        size: (h, 2) length and diameter of its symbol [m].
    """

    size: FloatArray


def hinges_of(data: ModelData, size: float) -> Hinges:
    """The hinges of a model; `size` is that of the drawing [m]."""
    arrays = data.arrays
    slots = slots_of(arrays)
    is_line = ~is_member(arrays.element_kind, Member.HINGE)
    every = np.flatnonzero(~is_line)
    chosen = data.appearance.drawn[every]
    place, index = places_of_hinges(slots, is_line)[chosen], every[chosen]
    return Hinges(
        **described(data, index, HINGE),
        nodes=np.column_stack((place, slots[index][:, [1, 3]])),
        size=np.tile(np.array(_PARTS) * size, (index.size, 1)),
    )
