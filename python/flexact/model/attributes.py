# SPDX-License-Identifier: BSD-3-Clause
"""How the elements of a model are to be drawn, as its deck or its maker said."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import BoolArray, FloatArray, IntArray, ModelArrays
from ..core.elements import coordinate_name
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


@dataclass(frozen=True, eq=False)
class Loads(Frozen):
    """Dead loads; whether a mechanism is exactly constrained does not depend on them.

    Zero where nothing is given. A position has forces along x, y, z [N], an orientation
    moments about x, y, z [N m], which work on small rotations about these fixed axes; in a
    planar model there are forces along x and y, and the moment about z.

    Attributes:
        force: (nodes, 3) of XF.
        increment: (nodes, 3) of DELXF, which is added to XF in the course of loading.
        gravity: (3,) of GRAVITY, the acceleration of free fall [m/s^2].

    Raises:
        ValueError: a shape is wrong, or a number is not finite.
    """

    force: FloatArray
    increment: FloatArray
    gravity: FloatArray

    def __post_init__(self) -> None:
        """Check the arrays and make them read-only."""
        super().__post_init__()
        for name, shape in (
            ("force", (len(self.force), 3)),
            ("increment", (len(self.force), 3)),
            ("gravity", (3,)),
        ):
            array = getattr(self, name)
            if array.shape != shape:
                raise ValueError(f"{name} has shape {array.shape}, but must have {shape}")
            if not np.isfinite(array).all():
                raise ValueError(f"{name} has a number that is not finite")


#: How many numbers an element or a node has at most of each.
NUMBERS = {"stiffness": 6, "mass": 5, "node_mass": 6}


@dataclass(frozen=True, eq=False)
class Properties(Frozen):
    """Stiffness and mass; whether a mechanism is exactly constrained does not depend on them.

    A row holds the numbers of one statement of the deck language, in its order, and NaN
    behind them. A row of NaN: nothing is given.

    Attributes:
        stiffness: (elements, 6) of ESTIFF. Of a beam EA [N], G It, E Iy, E Iz [N m^2] and the
            shear E Iy / (G A k), E Iz / (G A k) [m^2]; of a planar beam EA, EI and shear; of a
            truss EA; of a hinge the stiffness about its axis [N m/rad] and about the others.
        mass: (elements, 5) of EM. Of a beam mass [kg/m], then Jxx, Jyy, Jzz, Jyz [kg m] per
            length; of a planar beam mass and J; of a truss or a rigid link mass.
        node_mass: (nodes, 6) of XM. Of a position its mass [kg]; of an orientation Jxx, Jxy,
            Jxz, Jyy, Jyz, Jzz, of a planar one J [kg m^2].

    Raises:
        ValueError: a shape is wrong, or a number stands behind one that is not given.
    """

    stiffness: FloatArray
    mass: FloatArray
    node_mass: FloatArray

    def __post_init__(self) -> None:
        """Check the arrays and make them read-only."""
        super().__post_init__()
        for name, numbers in NUMBERS.items():
            array = getattr(self, name)
            if array.ndim != 2 or array.shape[1] != numbers:
                raise ValueError(f"{name} has shape {array.shape}, but must have (…, {numbers})")
            missing = np.isnan(array)
            if np.isinf(array).any() or (missing[:, :-1] & ~missing[:, 1:]).any():
                raise ValueError(f"{name} has a number behind one that is not given, or infinity")


def rows_of(table: FloatArray) -> Iterator[tuple[int, tuple[float, ...]]]:
    """Index and numbers of each row of which something is given."""
    for i in np.flatnonzero(~np.isnan(table[:, 0])).tolist():
        yield i, tuple(value for value in table[i].tolist() if value == value)


Labels = tuple[tuple[int, str], ...]


def row_labels(arrays: ModelArrays, label: NDArray[np.integer]) -> tuple[tuple[int, int], ...]:
    """Element numbers and deformations from 1 of (2, m) their indices, both from 0."""
    numbers = arrays.element_number[label[0]].tolist()
    return tuple(zip(numbers, (label[1] + 1).tolist(), strict=True))


def column_labels(arrays: ModelArrays, label: NDArray[np.integer]) -> Labels:
    """Node numbers and coordinate names of (2, n) node indices and axes, both from 0."""
    numbers = arrays.node_number[label[0]].tolist()
    kinds = arrays.node_kind[label[0]].tolist()
    axes = label[1].tolist()
    return tuple(
        (number, coordinate_name(kind, axis))
        for number, kind, axis in zip(numbers, kinds, axes, strict=True)
    )
