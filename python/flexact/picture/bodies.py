"""Members in a pose as grids of surface."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..exchange import FloatArray
from ..frozen import Frozen
from ..scene import Members, Pose, Scene, solid
from .surfaces import OUTLINE, Grid
from .visible import visible_stations


@dataclass(frozen=True)
class Detail:
    """How finely members are drawn.

    Attributes:
        segments: Of a bent member.
        corners: Of a round section.
        finest: Size of facets, as a part of the scene's size.
    """

    segments: int
    corners: int
    finest: float


#: Up to so many members are drawn that finely.
_LEVELS = (
    (60, Detail(16, 18, 0.05)),
    (400, Detail(10, 10, 0.1)),
    (1500, Detail(8, 6, 0.5)),
)
#: Round members are thick, and have twice as many corners, beyond this part of the scene's size.
_THICK = 0.05


def detail_of(scene: Scene) -> Detail | None:
    """How finely the members of a scene are drawn; None where they are too many for solids."""
    count = len(scene.members)
    return next((detail for most, detail in _LEVELS if count <= most), None)


@dataclass(frozen=True, eq=False)
class Body(Frozen):
    """The surface of members with equally many stations and corners.

    Attributes:
        member: (k,) which of the scene's members.
        at: (s,) stations, from 0 at p to 1 at q.
        points: (k, s, c, 3) corners [m].
    """

    member: np.ndarray
    at: FloatArray
    points: FloatArray


def bodies(scene: Scene, pose: Pose, detail: Detail, pieces: int = 1) -> Iterator[Body]:
    """The visible members of a spatial scene; straight ones in so many pieces."""
    for strip in visible_stations(scene.members, pose, detail.segments):
        round_ = strip.member[scene.members.round[strip.member]]
        thick = scene.members.section[round_].max(initial=0.0) > _THICK * scene.size
        corners = detail.corners * (2 if thick else 1)
        for each in solid(strip, scene.members, corners=corners):
            points, at = each.points, each.at
            if at.size == 2 and pieces > 1:
                at = np.linspace(0.0, 1.0, pieces + 1)
                share = at[None, :, None, None]
                points = (1 - share) * points[:, :1] + share * points[:, 1:]
            yield Body(each.member, at, points)


def outline_of(members: Members, member: np.ndarray) -> FloatArray:
    """(k, 3) colours of edges."""
    given = members.edge_colour[member]
    return np.where(np.isnan(given), OUTLINE, given)


def grid_of(scene: Scene, body: Body, colour: FloatArray | None = None) -> Grid:
    """A body with its colours: its own, or (k, s - 1, 3) given ones."""
    members = scene.members
    own = members.colour[body.member][:, None] if colour is None else colour
    opacity = members.opacity[body.member]
    return Grid(body.points, own, opacity, outline_of(members, body.member))
