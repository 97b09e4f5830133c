"""Hinges as they are drawn: cylinders about their axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..elements import keywords_of
from ..exchange import FloatArray
from ..frozen import Frozen
from ..model_data import ModelData
from .colours import HINGE
from .members import frames_along
from .places import places_of_hinges, slots_of
from .rotations import unit

#: Length and diameter, parts of the scene's size.
_PARTS = (0.06, 0.03)


@dataclass(frozen=True, eq=False)
class Hinges(Frozen):
    """Drawn elements without extent, in the order of the elements.

    Attributes:
        index: (h,) index of the element, from 0.
        number: (h,) its number.
        names: (h,) its name, empty where it has none.
        keyword: (h,) its keyword.
        nodes: (h, 3) node indices: the position where it stands, -1 where none is known; its
            two orientations.
        frame: (h, 3, 3) reference frame; ex is the axis.
        size: (h, 2) length and diameter of its symbol [m].
        colour: (h, 3) red, green, blue, 0 to 1.
        opacity: (h,) 0 to 1.
    """

    index: np.ndarray
    number: np.ndarray
    names: tuple[str, ...]
    keyword: tuple[str, ...]
    nodes: np.ndarray
    frame: FloatArray
    size: FloatArray
    colour: FloatArray
    opacity: FloatArray

    def __len__(self) -> int:
        """How many there are."""
        return int(self.index.size)

    @property
    def axis(self) -> FloatArray:
        """(h, 3) unit vectors along the axes."""
        return self.frame[..., 0]


def hinges_of(data: ModelData, size: float) -> Hinges:
    """The hinges of a model; `size` is that of the scene [m]."""
    arrays, look = data.arrays, data.look
    slots = slots_of(arrays)
    is_line = (slots[:, 0] >= 0) & (slots[:, 2] >= 0)
    every = np.flatnonzero(~is_line)
    chosen = look.drawn[every]
    place, index = places_of_hinges(slots, is_line)[chosen], every[chosen]
    axis = arrays.element_vector.T[index].astype(np.float64)
    # A planar hinge turns about the global z axis.
    axis = unit(np.where(np.any(axis != 0.0, axis=1)[:, None], axis, (0.0, 0.0, 1.0)))
    given, opacity = look.colour[index], look.opacity[index]
    return Hinges(
        index=index,
        number=arrays.element_number[index].astype(np.int64),
        names=tuple(data.element_names[i] for i in index.tolist()),
        keyword=keywords_of(arrays.element_kind[index]),
        nodes=np.column_stack((place, slots[index][:, [1, 3]])),
        frame=frames_along(axis, np.zeros_like(axis)),
        size=np.tile(np.array(_PARTS) * size, (index.size, 1)),
        colour=np.where(np.isnan(given), HINGE, given),
        opacity=np.where(np.isnan(opacity), 1.0, opacity),
    )
