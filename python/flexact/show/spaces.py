# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces, and what flexures hold, as they are drawn and told.

A space is made of families of lines, directions or screws: members of each, and faces they lie in.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import reduce
from operator import add

import numpy as np

from ..advice.constraint_quality import Hold, hold_in_words, holds_in_words, holds_of, number_of
from ..advice.spaces.screws import Family, ScrewSpace
from ..advice.spaces.spaces import Spaces, body_words, dashed_in_words, spaces_lines
from ..analysis.naming import plain
from ..analysis.result import Result
from ..core.arrays import FloatArray
from ..util.records import Frozen
from ..util.rotations import frames_along, unit

#: Half the length of a line, and of an arrow from the middle: parts of the drawing's size.
_REACH, _ARROW = 0.42, 0.26
#: Where arrows begin, away from the middle.
_START = 0.05
#: Lines through a point in a plane, and corners of a disc.
_FAN, _ROUND = 8, 40
#: Lines side by side.
_BESIDE = np.linspace(-0.75, 0.75, 5)
#: Of a helix: radius, at most so many turns, and points of each.
_HELIX, _TURNS, _POINTS = 0.045, 8.0, 24


#: Lines, faces and arrows, as of `SpaceShape`.
_Parts = tuple[list[FloatArray], list[FloatArray], list[FloatArray]]


def _segments(points: FloatArray, directions: FloatArray, half: float) -> list[FloatArray]:
    """A line (2, 3) to both sides of each point, (3,) or (n, 3)."""
    points, directions = np.broadcast_arrays(np.atleast_2d(points), np.atleast_2d(directions))
    return list(np.stack((points - half * directions, points + half * directions), axis=1))


def _fan(normal: FloatArray, count: int = _FAN) -> FloatArray:
    """(count, 3) directions in a plane, over half a turn."""
    frame = frames_along(normal[None])[0]
    angle = np.pi * np.arange(count) / count
    return np.outer(np.cos(angle), frame[:, 1]) + np.outer(np.sin(angle), frame[:, 2])


def disc(point: FloatArray, normal: FloatArray, radius: float) -> FloatArray:
    """(c, 3) corners of what looks round."""
    ring = _fan(normal, _ROUND // 2)
    return np.asarray(point + radius * np.concatenate((ring, -ring)))


def _square(point: FloatArray, one: FloatArray, other: FloatArray, half: float) -> FloatArray:
    corners = np.array(((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)))
    return np.asarray(point + half * (corners[:, :1] * one + corners[:, 1:] * other))


def _sides(direction: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors across a direction and each other."""
    frame = frames_along(direction[None])[0]
    return frame[:, 1], frame[:, 2]


def _line(family: Family, middle: FloatArray, size: float) -> _Parts:
    return _segments(family.point, family.direction, _REACH * size), [], []


def _pencil(family: Family, middle: FloatArray, size: float) -> _Parts:
    half = _REACH * size
    lines = _segments(family.point, _fan(family.normal), half)
    return lines, [disc(family.point, family.normal, half)], []


def _parallels_in_plane(family: Family, middle: FloatArray, size: float) -> _Parts:
    half = _REACH * size
    across = unit(np.cross(family.normal, family.direction))
    points = family.point + half * _BESIDE[:, None] * across
    face = _square(family.point, family.direction, across, half)
    return _segments(points, family.direction, half), [face], []


def _bundle(family: Family, middle: FloatArray, size: float) -> _Parts:
    every = np.array([each for each in np.ndindex(3, 3, 3) if each > (1, 1, 1)]) - 1.0
    return _segments(family.point, unit(every), _REACH * size), [], []


def _parallels(family: Family, middle: FloatArray, size: float) -> _Parts:
    one, other = _sides(family.direction)
    half, beside = _REACH * size, 0.6 * _REACH * size
    places = [middle + beside * (i * one + j * other) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    lines = _segments(np.array(places), family.direction, half)
    faces = [
        _square(middle + end * half * family.direction, one, other, 1.3 * beside) for end in (-1, 1)
    ]
    return lines, faces, []


def _flat(
    point: FloatArray, normal: FloatArray, half: float
) -> tuple[list[FloatArray], list[FloatArray]]:
    """Lines of all directions in a plane, and a square of it."""
    one, other = _sides(normal)
    lines = _segments(point + half * _BESIDE[:, None] * other, one, half)
    lines += _segments(point + half * _BESIDE[:, None] * one, other, half)
    diagonals = np.array((one + other, one - other))
    return lines + _segments(point, diagonals, half), [_square(point, one, other, half)]


def _some(family: Family, middle: FloatArray, size: float) -> _Parts:
    # About the point of each that is nearest to the middle.
    arm = middle - family.points
    along = np.sum(arm * family.directions, axis=1)[:, None]
    points = family.points + along * family.directions
    return _segments(points, family.directions, _REACH * size), [], []


def _meeting_two(family: Family, middle: FloatArray, size: float) -> _Parts:
    """Lines from one to the other: the two themselves are lines of the reciprocal space."""
    two, _, _ = _some(family, middle, size)
    first, second = (
        np.linspace(0.1, 0.9, 4)[:, None] * (line[1] - line[0]) + line[0] for line in two
    )
    return [np.stack((one, other)) for one in first for other in second], [], []


def _meeting_across(family: Family, middle: FloatArray, size: float) -> _Parts:
    """Pencils in parallel planes, round points of the line, which is of the reciprocal space."""
    axis = _some(family, middle, size)[0][0]
    half = 0.6 * _REACH * size
    lines, faces = [], []
    for place in np.linspace(0.15, 0.85, 3)[:, None] * (axis[1] - axis[0]) + axis[0]:
        lines += _segments(place, _fan(family.direction, 4), half)
        faces.append(disc(place, family.direction, half))
    return lines, faces, []


def _meeting(family: Family, middle: FloatArray, size: float) -> _Parts:
    lines = _segments(family.point, family.direction, _REACH * size)
    one, other = _sides(family.direction)
    slant = np.array([one, other, one + family.direction, other - family.direction])
    for share in (-0.6, 0.0, 0.6):
        place = family.point + share * _REACH * size * family.direction
        lines += _segments(place, unit(slant), 0.6 * _REACH * size)
    return lines, [], []


def _across(family: Family, middle: FloatArray, size: float) -> _Parts:
    planes = [
        _flat(
            middle + share * _REACH * size * family.direction, family.direction, 0.8 * _REACH * size
        )
        for share in (-0.55, 0.0, 0.55)
    ]
    return [line for lines, _ in planes for line in lines], [faces[0] for _, faces in planes], []


def _every(family: Family, middle: FloatArray, size: float) -> _Parts:
    faces = [disc(middle, axis, _REACH * size) for axis in np.eye(3)]
    lines = [_segments(middle, _fan(axis), _REACH * size) for axis in np.eye(3)]
    return [each for some in lines for each in some], faces, []


def _screw(family: Family, middle: FloatArray, size: float) -> _Parts:
    half = _REACH * size
    turns = min(half / abs(family.pitch) / np.pi, _TURNS) if family.pitch else _TURNS
    share = np.linspace(-1.0, 1.0, max(int(turns * _POINTS), 2))[:, None]
    angle = np.sign(family.pitch or 1.0) * np.pi * turns * share
    one, other = _sides(family.direction)
    # Both axes across are right-handed about the direction, and so is a screw of positive pitch.
    around = _HELIX * size * (np.cos(angle) * one + np.sin(angle) * other)
    helix: FloatArray = family.point + half * share * family.direction + around
    return [*_segments(family.point, family.direction, half), helix], [], []


def _complex(family: Family, middle: FloatArray, size: float) -> _Parts:
    """Lines round the axis, the steeper the nearer, and those that meet it at right angles."""
    half, lines = _REACH * size, []
    for distance in (0.25 * half, 0.75 * half):
        for across in np.concatenate((fan := _fan(family.direction, 4), -fan)):
            # In the moment about the axis, distance times the part along the tangent, and the
            # pitch times the part along the axis cancel.
            tangent = np.cross(family.direction, across)
            way = unit(distance * family.direction - family.pitch * tangent)
            lines += _segments(family.point + distance * across, way, 0.6 * half)
    return lines + _segments(family.point, fan, 0.75 * half), [], []


def _arrows(directions: FloatArray, middle: FloatArray, size: float) -> list[FloatArray]:
    ends = ((_START, _ARROW), (-_START, -_ARROW))
    return [
        np.stack([middle + part * size * each for part in pair])
        for each in np.atleast_2d(directions)
        for pair in ends
    ]


def _directions_in_plane(family: Family, middle: FloatArray, size: float) -> _Parts:
    face = disc(middle, family.normal, _ARROW * size)
    return [], [face], _arrows(_fan(family.normal, 4), middle, size)


#: By the name of the kind.
MADE_BY: dict[str, Callable[[Family, FloatArray, float], _Parts]] = {
    "LINE": _line,
    "PENCIL": _pencil,
    "PARALLELS_IN_PLANE": _parallels_in_plane,
    "BUNDLE": _bundle,
    "PARALLELS": _parallels,
    "PLANE": lambda family, _, size: (*_flat(family.point, family.normal, _REACH * size), []),
    "REGULUS": _some,
    "MEETING_TWO": _meeting_two,
    "MEETING_ACROSS": _meeting_across,
    "CONGRUENCE": _some,
    "MEETING": _meeting,
    "ACROSS": _across,
    "COMPLEX": _complex,
    "EVERY": _every,
    "DIRECTION": lambda family, *place: ([], [], _arrows(family.direction, *place)),
    "DIRECTIONS_IN_PLANE": _directions_in_plane,
    "EVERY_DIRECTION": lambda _, *place: ([], [], _arrows(np.eye(3), *place)),
    "SCREW": _screw,
}


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
    families: Iterable[Family],
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


#: How large a line or a plane is drawn, in sizes of the flexure, and at least, and at most, in
#: parts of the drawing's size; a line is as long as of a space in a drawing of that size.
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


_NO_WIRES = np.zeros((0, 2, 3))


@dataclass(frozen=True)
class SpaceShown:
    """A space, or what flexures hold.

    Attributes:
        title: What it is called.
        shape: What is drawn of it.
        words: What it is.
        wires: (w, 2, 3) ends of wires that may be added [m].
        labels: Places (3,) [m], each with what stands there.
    """

    title: str
    shape: SpaceShape
    words: str
    wires: FloatArray
    labels: tuple[tuple[FloatArray, str], ...] = ()


def space_shown(space: ScrewSpace, title: str, words: str, size: float) -> SpaceShown:
    """A space without a mechanism, in a drawing of a size [m]."""
    shape = shape_of_space(
        space.families, space.about, size, is_freedom=not space.of_wrenches, planar=space.planar
    )
    return SpaceShown(title, shape, words, _NO_WIRES)


def spaces_shown(result: Result, spaces: Spaces, size: float, planar: bool) -> Iterator[SpaceShown]:
    """The freedom space and the constraint space of a body, in a drawing of a size [m]."""
    lines = spaces_lines(result, spaces)
    for which, space, line in zip(
        ("Freedom", "Constraint"), (spaces.freedom, spaces.constraint), lines, strict=False
    ):
        is_freedom = not space.of_wrenches
        shape = shape_of_space(
            space.families, space.about, size, is_freedom=is_freedom, planar=planar
        )
        wires = _NO_WIRES if is_freedom else spaces.new_wires
        words = plain(line.head) + "; ".join(map(plain, line.items))
        title = f"{which} space of {body_words(result, spaces)}"
        yield SpaceShown(title, shape, words + dashed_in_words(len(wires)), wires)


def holds_shown(result: Result, size: float, planar: bool, most: int = 0) -> list[SpaceShown]:
    """What all flexures of an exactly constrained mechanism hold, with how well at each.

    Behind that what each of them holds, of several and up to so many; nothing where that is not
    known.
    """
    holds = holds_of(result)
    if not holds:
        return []
    shapes = [shape_of_hold(each, size, planar=planar) for each in holds]
    labels = tuple((each.space.about, number_of(each)) for each in holds)
    title, words = "What each flexure holds", holds_in_words(holds)
    made = [SpaceShown(title, reduce(add, shapes), words, _NO_WIRES, labels)]
    if 1 < len(holds) <= most:
        for hold, shape, label in zip(holds, shapes, labels, strict=True):
            title, words = f"{hold.name}: {label[1]}", hold_in_words(result, hold)
            made.append(SpaceShown(title, shape, words, _NO_WIRES, (label,)))
    return made
