# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces as lines, translucent faces and arrows about a body.

Drawn as users of FACT draw them (Hopkins and Culpepper, *Synthesis of multi-degree of freedom,
parallel flexure system concepts via freedom and constraint topology*, Precision Engineering, 2010):
freedom in red, constraint in blue; of a family of infinitely many lines so many that it is seen.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen
from .spaces import MADE_BY, FamilyLike, disc

#: Radius of a ring about a pole, and of one that is a couple, in the plane.
_POLE, _COUPLE = 0.02, 0.1
#: Up to so many lines can be thick.
_FEW = 3


@dataclass(frozen=True, eq=False)
class SpaceShape(Frozen):
    """What is drawn of a space; all places in [m].

    Attributes:
        is_freedom: Whether it is that of motions; else that of forces.
        lines: (c, 3) each: straight ones of two points, and helices.
        faces: (c, 3) each: corners of convex polygons that shine through.
        arrows: (2, 3) each: from where to where; translations, or couples.
    """

    is_freedom: bool
    lines: tuple[FloatArray, ...] = ()
    faces: tuple[FloatArray, ...] = ()
    arrows: tuple[FloatArray, ...] = ()

    @property
    def is_bold(self) -> bool:
        """Whether its lines are so few that they can be thick."""
        return len(self.lines) <= _FEW

    def __add__(self, other: SpaceShape) -> SpaceShape:
        """Both together."""
        return SpaceShape(
            self.is_freedom,
            self.lines + other.lines,
            self.faces + other.faces,
            self.arrows + other.arrows,
        )


def shape_of_space(
    families: Iterable[FamilyLike],
    middle: FloatArray,
    size: float,
    *,
    is_freedom: bool,
    planar: bool = False,
) -> SpaceShape:
    """What is drawn of a space.

    Args:
        families: What it is made of.
        middle: (3,) of the body [m].
        size: Of the drawing [m].
        is_freedom: Whether it is that of motions.
        planar: Whether the drawing is; what is along z is a ring there.
    """
    made = SpaceShape(is_freedom)
    for family in families:
        lines, faces, arrows = MADE_BY[family.kind.name](family, middle, size)
        made += SpaceShape(is_freedom, tuple(lines), tuple(faces), tuple(arrows))
    return _in_plane(made, size) if planar else made


def _in_plane(shape: SpaceShape, size: float) -> SpaceShape:
    """Rings about the poles of rotations, wider ones for couples, in place of what is along z."""
    rings = [
        disc(parts.mean(axis=0), np.array((0.0, 0.0, 1.0)), radius * size)
        for every, radius in ((shape.lines, _POLE), (shape.arrows[::2], _COUPLE))
        for parts in every
        if _is_upright(parts)
    ]
    closed = [np.concatenate((ring, ring[:1])) for ring in rings]
    lines, arrows = (
        tuple(parts for parts in every if not _is_upright(parts))
        for every in (shape.lines, shape.arrows)
    )
    return SpaceShape(shape.is_freedom, (*lines, *closed), shape.faces, arrows)


def _is_upright(parts: FloatArray) -> bool:
    """Whether a line is along z."""
    return bool(np.ptp(parts[:, :2], axis=0).max() < 1.0e-6 * np.ptp(parts[:, 2]))


def dashes(ends: FloatArray, size: float) -> FloatArray:
    """(n, 2, 3) the dashes of lines (k, 2, 3), as long in all of them."""
    made = [np.zeros((0, 2, 3))]
    for first, last in ends:
        count = max(int(np.linalg.norm(last - first) / (0.035 * size)), 1)
        share = (np.arange(count)[:, None] + (0.0, 0.6)) / (count - 0.4)
        made.append(first + share[..., None] * (last - first))
    return np.concatenate(made)
