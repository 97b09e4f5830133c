# SPDX-License-Identifier: BSD-3-Clause
"""Rods with notches, struts with necks, and bellows: what holds five wrenches, four, or one.

A *notch* is a stiff rod from body to body with a notch across it: it holds all lines that meet the
axis of the notch, five wrenches. A *rod* has two notches with parallel axes: it holds all lines in
the plane of both axes and all lines parallel to them, four. A *strut* has two round necks, about
each of which it turns in every way: it holds the line through both, and its turning about itself
is a motion within. A *bellows* holds a couple along its axis, wherever that is, and nothing else.
All of the first three are notches to users.

Their sizes follow from the limits of a problem. A notch is as thin as a sheet, as broad as a sheet,
and circular, its radius ten times the thickness, if rods are long enough for that. A neck is as
thick as a wire, and six times as long. The outer diameter of a bellows is the mean breadth of a
sheet, or the least where that leaves no room; its convolutions have the proportions of
`flexact.model.bellows`.

What flexures hold is as stiff as all their pieces in a row, with what they release left to turn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import kind_of
from ..model.bellows import DEPTH, PITCH, WALL, bellows_make
from ..model.data import CrossSection
from ..model.draft import Shape
from ..model.notches import NotchContour
from ..model.sections import Material, stiffness
from ..util.rotations import unit
from .candidates import (
    Candidates,
    Place,
    Sizes,
    around,
    breadths,
    clear_of_boxes,
    couples,
    distinct_rows,
    first_of_alike,
    forces,
    joined,
    lines_for,
    outside,
    planes,
    points_of,
    reached,
    ways_in_planes,
    with_special,
)
from .frame import snapped
from .geometry import TINY

#: What candidates of these kinds are to users, see `flexact.designs.problem.KINDS`.
SHOWN_AS = {"rod": "notch", "strut": "notch"}
#: Of screws, how much of one may be outside of a space in which it is.
_OUTSIDE = 1.0e-10

# Proportions ----------------------------------------------------------------------------

#: The radius of a notch in its thickness; and the part of the least length that it is at most.
_ROUND, _OF_LENGTH = 10.0, 1.0 / 8.0
#: With a smaller radius, in its thickness, what is between two cuts is no notch.
_LEAST_ROUND = 3.0
#: The length of a neck in its diameter; and the part of the least length that it is at most.
_NECK, _NECK_OF_LENGTH = 6.0, 1.0 / 6.0
#: How much thicker a strut is than its necks.
_STRUT = 3.0
#: Bars that are shorter are none, in parts of the size.
_NO_BAR = 1.0e-11
#: Two notches take up at most this part of a rod.
_NOTCHED = 2.0 / 3.0


def radius_of(thickness: float, least: float) -> float:
    """The radius of a notch of a thickness in a rod of some least length."""
    return min(_ROUND * thickness, _OF_LENGTH * least)


def reach_of(thickness: float, least: float) -> float:
    """How far the material of a notch reaches to both sides of its axis."""
    return radius_of(thickness, least) + thickness


def height_of(thickness: float, least: float) -> float:
    """The height of a rod with such a notch."""
    return thickness + 2.0 * radius_of(thickness, least)


def neck_of(diameter: float, least: float) -> float:
    """The length of a neck of a strut."""
    return min(_NECK * diameter, _NECK_OF_LENGTH * least)


# Stiffness of pieces in a row -------------------------------------------------------------


class _Piece(NamedTuple):
    """A piece of some rods, symmetric about its middle, in their frame: along, height, axis.

    Attributes:
        middle: (n,) where it is from the point about which wrenches are.
        compliance: (n, 6) about its middle: shifts, then rotations.
    """

    middle: FloatArray
    compliance: FloatArray


def _bar(shape: Shape, starts: FloatArray, ends: FloatArray, material: Material) -> _Piece:
    """A bar between places along rods, its section along height and axis."""
    axial, twist, about_y, about_z, shear_y, shear_z = stiffness(kind_of("BEAM"), shape, material)
    long = ends - starts
    made = (
        long / axial,
        (long**3 / 12.0 + long * shear_z) / about_z,
        (long**3 / 12.0 + long * shear_y) / about_y,
        *(long / twist, long / about_y, long / about_z),
    )
    return _Piece((starts + ends) / 2.0, np.stack(made, axis=1))


@lru_cache(maxsize=256)
def _compliance(contour: NotchContour) -> FloatArray:
    """(6,) of a notch; the same few are asked for between all regions."""
    compliance = np.array(contour.compliance)
    # Between bars that are as broad as it, and much thicker, it cannot warp.
    compliance[3] = contour.held_torsion
    return compliance


def _notched(contour: NotchContour, at: FloatArray) -> _Piece:
    return _Piece(at, np.broadcast_to(_compliance(contour), (len(at), 6)))


def _in_a_row(pieces: list[_Piece]) -> FloatArray:
    """(n, 6, 6) compliance of rods for wrenches (f, m) about a point of them, in their frame."""
    total = np.zeros((len(pieces[0].middle), 6, 6))
    for middle, compliance in pieces:
        # The moment about the middle of a piece of a force at the point is -d x f.
        turned = np.broadcast_to(np.eye(6), total.shape).copy()
        turned[:, 5, 1], turned[:, 4, 2] = -middle, middle
        total += turned.transpose(0, 2, 1) @ (compliance[:, :, None] * turned)
    return total


def _held(compliance: FloatArray, held: list[int]) -> FloatArray:
    """(n, r, r) stiffness against the wrenches that are held, what is released being free."""
    return np.asarray(np.linalg.inv(compliance[:, held][:, :, held]))


def _plain(sizes: Sizes) -> Material:
    """A material with a modulus of one."""
    return Material("", E=1.0, G=1.0 / sizes.shear, density=0.0)


def _contour(sizes: Sizes, breadth: float) -> NotchContour:
    return NotchContour(
        "circular",
        thickness=sizes.thickness,
        breadth=breadth,
        radius=radius_of(sizes.thickness, sizes.length[0]),
        material=_plain(sizes),
    )


# Notches and rods -------------------------------------------------------------------------


def notches(place: Place, fineness: int = 3) -> Candidates:
    """Rods with one notch: all lines that meet its axis are in W.

    W has these where T is one rotation, about that axis, or where nothing is wanted. Rods go
    through points of the axis across it; where any axis will do, along lines from body to body,
    with the notch in the middle.
    """
    if len(place.freedom) > 1:
        points = ways = axes = np.zeros((0, 3))
        free = False
    elif len(place.freedom):
        points, ways, axes = _about_axis(place, fineness)
        free = False
    else:
        points, ways = lines_for(place, fineness)
        across = around(ways)[:, [0, 6]].reshape(-1, 3)
        points, ways, axes = np.repeat(points, 2, axis=0), np.repeat(ways, 2, axis=0), across
        free = True
    held = outside(place.freedom, _meeting(points, ways, axes)) <= _OUTSIDE
    some = held.all(axis=1)
    return _rods(place, points[some], ways[some], axes[some], "notch", free=free)


def _about_axis(place: Place, fineness: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Points of the axis of a rotation, directions across it, and the axis with each."""
    turn, move = place.freedom[0, :3], place.freedom[0, 3:]
    size = float(np.linalg.norm(turn))
    if size <= TINY or abs(float(turn @ move)) > TINY * size:
        return (np.zeros((0, 3)),) * 3
    along, foot = turn / size, np.cross(turn, move) / size**2
    corners = points_of((*place.here, *place.there), 2) - foot
    shares = corners @ along
    evenly = np.linspace(shares.min(), shares.max(), 4 * fineness + 1)
    # Within a box of the body as finely again, for that is where rods are short.
    near = points_of(place.here, fineness) - foot
    every = np.concatenate((evenly, near @ along, shares, [0.0]))
    points = foot + distinct_rows(every[:, None]) * along
    ways = around(along[None])[0]
    many = len(ways)
    return (
        np.repeat(points, many, axis=0),
        np.tile(ways, (len(points), 1)),
        np.tile(along, (many * len(points), 1)),
    )


def rods(place: Place, fineness: int = 3) -> Candidates:
    """Rods with two parallel notches.

    W has the lines in a plane and the lines along the axes where T is within the rotations about
    lines along the axes in that plane and the translation across it.
    """
    here = with_special(place.freedom, points_of(place.here, fineness), place.here)
    points, normals = planes(place.freedom, here, pencil=False)
    points, normals, ways = ways_in_planes(points, normals)
    turning = place.freedom[:, :3]
    sizes = np.linalg.norm(turning, axis=1)
    if len(turning) and sizes.max() > TINY:
        # Rods go across the one direction that all rotations have.
        along = turning[int(sizes.argmax())] / sizes.max()
        more = np.cross(normals, along)
        lengths = np.linalg.norm(more, axis=1)
        fits = lengths > 1.0 - TINY
        points, normals = points[fits], normals[fits]
        ways = more[fits] / lengths[fits, None]
    axes = np.cross(ways, normals)
    held = _in_the_plane(points, ways, axes)
    some = (outside(place.freedom, held) <= _OUTSIDE).all(axis=1)
    return _rods(place, points[some], ways[some], axes[some], "rod")


def _meeting(middles: FloatArray, along: FloatArray, axes: FloatArray) -> FloatArray:
    """(n, 5, 6) unit wrenches of all lines that meet axes."""
    height = np.cross(axes, along)
    three = [forces(middles, each) for each in (along, height, axes)]
    return np.stack((*three, couples(along), couples(height)), axis=1)


def _in_the_plane(middles: FloatArray, along: FloatArray, axes: FloatArray) -> FloatArray:
    """(n, 4, 6) unit wrenches of lines in the planes along and axis, and parallel to axes."""
    two = [forces(middles, each) for each in (along, axes)]
    return np.stack((*two, couples(along), couples(np.cross(axes, along))), axis=1)


def _rods(
    place: Place,
    points: FloatArray,
    ways: FloatArray,
    axes: FloatArray,
    kind: str,
    *,
    free: bool = True,
) -> Candidates:
    """Rods along lines through points; `free` if notches need not be at the points."""
    sizes = place.sizes
    thickness, least = sizes.thickness, sizes.length[0]
    reach, height = reach_of(thickness, least), height_of(thickness, least)
    made = []
    for breadth in breadths(sizes):
        if radius_of(thickness, least) < _LEAST_ROUND * thickness or breadth < thickness:
            points, ways, axes = points[:0], ways[:0], axes[:0]
        deep = height / 2.0 * np.cross(axes, ways)
        edges = np.stack([breadth / 2.0 * axes + sign * deep for sign in (1.0, -1.0)])
        which, starts, ends = reached(place, points, ways, edges, None if free else reach)
        made.append(
            rods_between(
                *(place, starts, ends, axes[which], breadth, kind),
                None if free else points[which],
            )
        )
    return joined(made)


def rods_between(
    place: Place,
    starts: FloatArray,
    ends: FloatArray,
    axes: FloatArray,
    breadth: float,
    kind: str,
    at: FloatArray | None = None,
) -> Candidates:
    """Rods with these ends, with notches about axes that are across them.

    Args:
        place: The regions.
        starts: (n, 3) on the body.
        ends: (n, 3) on what holds it.
        axes: (n, 3) unit vectors.
        breadth: Along the axes.
        kind: "notch" for one, "rod" for two near the ends.
        at: (n, 3) places of single notches; by default the middles.
    """
    sizes = place.sizes
    thickness, least = sizes.thickness, sizes.length[0]
    reach, height = reach_of(thickness, least), height_of(thickness, least)
    at = (starts + ends) / 2.0 if at is None else at
    lengths = np.linalg.norm(ends - starts, axis=1)
    if kind == "notch":
        # Bars beside a notch are there, or are not.
        bars = np.stack([np.linalg.norm(at - end, axis=1) - reach for end in (starts, ends)])
        fits = ((bars > thickness) | (np.abs(bars) < _NO_BAR)).all(axis=0)
    else:
        fits = lengths >= 4.0 * reach / _NOTCHED
    first = first_of_alike(np.concatenate((starts, ends, np.abs(axes)), axis=1))
    first = first[fits[first]]
    starts, ends, axes, at, lengths = (each[first] for each in (starts, ends, axes, at, lengths))
    along = (ends - starts) / lengths[:, None]
    bar = Shape(CrossSection.RECT, height, breadth)
    contour, plain = _contour(sizes, breadth), _plain(sizes)
    none = np.zeros(len(starts))
    if kind == "notch":
        before = -np.linalg.norm(at - starts, axis=1)
        pieces = [
            _bar(bar, before, none - reach, plain),
            _notched(contour, none),
            _bar(bar, none + reach, before + lengths, plain),
        ]
        rows = _meeting(at, along, axes)
        matrix = _held(_in_a_row(pieces), [0, 1, 2, 3, 4])
        via = at[:, None]
    else:
        away = lengths / 2.0 - reach
        half = away - reach
        pieces = [_notched(contour, -away), _bar(bar, -half, half, plain), _notched(contour, away)]
        rows = _in_the_plane(at, along, axes)
        matrix = _held(_in_a_row(pieces), [0, 2, 3, 4])
        via = np.stack((starts + reach * along, ends - reach * along), axis=1)
    strips = np.stack((starts, ends, breadth / 2.0 * axes), axis=1)[:, None]
    made = Candidates(
        *(kind, np.stack((starts, ends), axis=1), strips, height / 2.0, rows, matrix),
        *(np.full(len(starts), breadth), np.cross(axes, along), via),
        np.repeat(axes[:, None], via.shape[1], axis=1),
    )
    held = (outside(place.freedom, rows) <= _OUTSIDE).all(axis=1)
    return made.of(held & clear_of_boxes(place, strips, height / 2.0))


# Struts -----------------------------------------------------------------------------------


def struts(place: Place, fineness: int = 3) -> Candidates:
    """Struts with two round necks, along lines of W."""
    points, directions = lines_for(place, fineness)
    held = outside(place.freedom, forces(points, directions)) <= _OUTSIDE
    points, directions = points[held], directions[held]
    thick = _STRUT * place.sizes.diameter
    _, starts, ends = reached(place, points, directions, round_ends(directions, thick))
    return struts_between(place, starts, ends)


def struts_between(place: Place, starts: FloatArray, ends: FloatArray) -> Candidates:
    """Struts with these ends, those left out that touch what is kept out."""
    diameter = place.sizes.diameter
    both = distinct_rows(np.concatenate((starts, ends), axis=1))
    starts, ends = both[:, :3], both[:, 3:]
    lengths = np.linalg.norm(ends - starts, axis=1)
    directions = (ends - starts) / lengths[:, None]
    neck = neck_of(diameter, place.sizes.length[0])
    area = np.pi * diameter**2 / 4.0
    give = 2.0 * neck / area + (lengths - 2.0 * neck) / (area * _STRUT**2)
    strips = np.stack((starts, ends, np.zeros_like(starts)), axis=1)[:, None]
    radius = _STRUT * diameter / 2.0
    via = np.stack((starts + neck / 2.0 * directions, ends - neck / 2.0 * directions), axis=1)
    made = Candidates(
        *("strut", np.stack((starts, ends), axis=1), strips, radius),
        *(forces(starts, directions)[:, None], (1.0 / give)[:, None, None]),
        *(np.zeros(len(starts)), np.zeros_like(starts), via, np.zeros_like(via)),
    )
    return made.of(clear_of_boxes(place, strips, radius))


def round_ends(directions: FloatArray, diameter: float) -> FloatArray:
    """(3, n, 3) half of what round ends reach along x, y and z."""
    reach = diameter / 2.0 * np.sqrt(np.maximum(1.0 - directions**2, 0.0))
    return np.stack([reach * axis for axis in np.eye(3)])


# Bellows ----------------------------------------------------------------------------------


def bellows(place: Place, fineness: int = 3) -> Candidates:
    """Bellows along directions of the couples of W."""
    points = points_of(place.here, fineness)
    turning = place.freedom[:, :3]
    free = np.eye(3)
    if len(turning):
        _, values, right = np.linalg.svd(turning)
        free = right[int((values > TINY).sum()) :]
    ways = np.zeros((0, 3))
    if len(free) == 1:
        ways = free
    elif len(free) == 2:
        ways = around(np.cross(free[:1], free[1:]))[0]
    elif len(free) == 3:
        ways = np.concatenate((np.eye(3), unit(np.array(_SLANTED))))
    many = len(ways)
    lines = np.repeat(points, many, axis=0), np.tile(ways, (len(points), 1))
    made = None
    for diameter in breadths(place.sizes)[-2:]:
        _, starts, ends = reached(place, *lines, round_ends(lines[1], diameter))
        found = bellows_between(place, starts, ends, diameter)
        spanned = np.linalg.matrix_rank(found.rows[:, 0, 3:], 1.0e-6) if len(found) else 0
        if made is None or spanned > np.linalg.matrix_rank(made.rows[:, 0, 3:], 1.0e-6):
            made = found
        if spanned == len(free):
            break
    assert made is not None
    return made


#: Directions between the axes.
_SLANTED = [[0, 1, 1], [0, 1, -1], [1, 0, 1], [1, 0, -1], [1, 1, 0], [1, -1, 0]]


def bellows_between(
    place: Place, starts: FloatArray, ends: FloatArray, diameter: float
) -> Candidates:
    """Bellows with these ends, those left out that touch what is kept out."""
    both = distinct_rows(np.concatenate((starts, ends), axis=1))
    starts, ends = both[:, :3], both[:, 3:]
    lengths = np.linalg.norm(ends - starts, axis=1)
    directions = (ends - starts) / lengths[:, None]
    depth, plain = DEPTH * diameter, _plain(place.sizes)
    twist = []
    for length in lengths.tolist():
        numbers = bellows_make(length, diameter, WALL * depth, depth, PITCH * depth, plain)
        assert numbers.stiffness is not None
        twist.append(numbers.stiffness[1] / length)
    strips = np.stack((starts, ends, np.zeros_like(starts)), axis=1)[:, None]
    none = np.zeros((len(starts), 0, 3))
    made = Candidates(
        *("bellows", np.stack((starts, ends), axis=1), strips, diameter / 2.0),
        *(couples(directions)[:, None], np.array(twist).reshape(-1, 1, 1)),
        *(np.full(len(starts), diameter), np.zeros_like(starts), none, none),
    )
    held = outside(place.freedom, made.rows[:, 0]) <= _OUTSIDE
    return made.of(held & clear_of_boxes(place, strips, diameter / 2.0))


# Models -----------------------------------------------------------------------------------


#: Points that are nearer to each other, in lengths of a rod, are one.
_SAME = 1.0e-9


def form_of(kind: str, via: FloatArray, axes: FloatArray) -> str:
    """Which of notch, rod and strut a flexure is that users call a notch; else its kind."""
    if kind != "notch" or len(via) == 1:
        return kind
    return "rod" if axes.any() else "strut"


def outer_sizes(
    form: str, diameter: float, width: float, thickness: float, least: float
) -> tuple[float, float, float]:
    """Diameter, breadth and thickness of the material of a flexure where it is largest."""
    if form == "strut":
        return _STRUT * diameter, 0.0, 0.0
    if form == "bellows":
        return width, 0.0, 0.0
    if form in ("notch", "rod"):
        return 0.0, width, height_of(thickness, least)
    return diameter, width, thickness


def turns_of(via: FloatArray, axes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(m, 3) points and unit vectors of all rotations that notches and necks release.

    About a neck, whose axis is zero, these are three.
    """
    points, ways = [], []
    for point, axis in zip(via, axes, strict=True):
        mine = axis[None] if axis.any() else np.eye(3)
        points.append(np.repeat(point[None], len(mine), axis=0))
        ways.append(mine)
    return np.concatenate(points), np.concatenate(ways)


def _typed(size: float) -> float:
    """A size as one would type it."""
    return float(snapped(np.array(size), size))


class Call(NamedTuple):
    """A call of a method of a model, to which the material is added.

    Attributes:
        method: Of `flexact.Model`.
        given: Without a name.
        named: By name.
    """

    method: str
    given: tuple[Any, ...]
    named: dict[str, Any]


def notch_calls(
    name: str,
    points: Sequence[tuple[float, ...]],
    ends: FloatArray,
    via: FloatArray,
    axis: FloatArray,
    breadth: float,
    thickness: float,
    least: float,
) -> Iterator[Call]:
    """What makes a rod with one notch or two: bars, and notches with their contour between them.

    Args:
        name: What it is called; its parts are "name, notch 1", "name, bar 1", ...
        points: Its ends, as methods of a model take them.
        ends: (2, 3) where these are [m].
        via: (1 or 2, 3) middles of the notches, from the first end to the second [m].
        axis: (3,) of the notches.
        breadth: Along the axis [m].
        thickness: Of the notches [m].
        least: Least length of flexures, to which the radius is adapted [m].
    """
    length = float(np.linalg.norm(ends[1] - ends[0]))
    along = (ends[1] - ends[0]) / length
    reach, height = reach_of(thickness, least), height_of(thickness, least)
    at = [ends[0]]
    for middle in via:
        at += [middle - reach * along, middle + reach * along]
    at.append(ends[1])
    is_bar = [np.linalg.norm(at[k + 1] - at[k]) > _SAME * length for k in range(0, len(at), 2)]
    inner = [tuple(point) for point in snapped(np.array(at[1:-1]), length).tolist()]
    # Without a bar the notch begins at the end itself.
    inner[0] = inner[0] if is_bar[0] else points[0]
    inner[-1] = inner[-1] if is_bar[-1] else points[1]
    points = [points[0], *inner, points[1]]
    deep, way = tuple(snapped(np.cross(axis, along), 1.0).tolist()), tuple(axis.tolist())
    for k, there in enumerate(is_bar):
        if there:
            own = f"{name}, bar {sum(is_bar[: k + 1])}"
            section = {"name": own, "section": (_typed(height), breadth)}
            yield Call("beam", (points[2 * k], points[2 * k + 1], deep), section)
    sizes: dict[str, Any] = {"contour": "circular", "thickness": thickness, "breadth": breadth}
    sizes |= {"radius": _typed(radius_of(thickness, least)), "warping": True}
    for k in range(len(via)):
        own = name if len(via) == 1 else f"{name}, notch {k + 1}"
        yield Call("notch", (points[2 * k + 1], way, points[2 * k + 2], own), sizes)


def strut_calls(
    name: str,
    points: Sequence[tuple[float, ...]],
    ends: FloatArray,
    y: str,
    diameter: float,
    least: float,
) -> Iterator[Call]:
    """What makes a strut: a bar between two necks, whose turning about itself is declared.

    Each neck twists, and bends where it meets the bar: there the strut turns in every way.

    Args:
        name: What it is called; its parts are "name, neck 1", "name, bar" and "name, neck 2".
        points: Its ends, as methods of a model take them.
        ends: (2, 3) where these are [m].
        y: The axis that is most nearly across it.
        diameter: Of the necks [m].
        least: Least length of flexures, to which that of the necks is adapted [m].
    """
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    neck = neck_of(diameter, least)
    at = np.array((ends[0] + neck * along, ends[1] - neck * along))
    a, b = (tuple(point) for point in snapped(at, float(np.abs(ends).max())).tolist())
    p, q = points
    first = f"{name}, neck 1"
    yield Call("beam", (p, a, y, (4, 6), first), {"section": diameter})
    yield Call("beam", (a, b, y), {"name": f"{name}, bar", "section": _typed(_STRUT * diameter)})
    yield Call("beam", (b, q, y, (2, 3, 5), f"{name}, neck 2"), {"section": diameter})
    yield Call("independent", (first, "twist"), {})
