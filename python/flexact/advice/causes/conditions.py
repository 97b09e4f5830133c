# SPDX-License-Identifier: BSD-3-Clause
"""Relations as equations: what is zero at every geometry that has one, and nothing else.

Lines, planes and points are taken from the places of nodes and the vectors of elements, so that
Newton's method, with the least change, leads a random geometry to one that has the relation. All
is of many geometries at once, (b, ...), as differences need them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ...analysis.result import Result
from ...core.arrays import BoolArray, FloatArray
from ...model.parts.parts import Part, PartKind
from ...util.groups import values_in
from ...util.rotations import unit
from .cause import LineKind, Relation, RelationKind
from .gradients import Geometry
from .lines import SAME, Limbs, position_of_hinge

#: Points and unit vectors, (b, 3): of a line its direction, of a plane its normal.
Figure = tuple[FloatArray, FloatArray]
#: A figure at places (b, nodes, 3) [m] and vectors (b, elements, 3) of the model as analysed.
FigureAt = Callable[[FloatArray, FloatArray], Figure]


class Condition(NamedTuple):
    """What is zero where a relation holds.

    Attributes:
        residual: (b, equations) of places, vectors and what is free besides (b, k), such as where
            lines meet.
        free: What is free besides, at the geometry that has the relation.
        nodes: Indices of the position nodes that it takes, in the model as analysed.
        elements: Indices of the elements whose vectors it takes.
        is_directed: Whether what is free besides is a direction and a point.
    """

    residual: Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
    free: FloatArray
    nodes: tuple[int, ...]
    elements: tuple[int, ...]
    is_directed: bool


class Figures:
    """The lines and planes of the parts of a result."""

    def __init__(self, result: Result) -> None:
        """Keep the result."""
        self.result, self.limbs, self.geometry = result, Limbs(result), Geometry(result.data)
        self.length = result.characteristic_length

    @property
    def here(self) -> tuple[FloatArray, FloatArray]:
        """(1, nodes, 3) and (1, elements, 3), places and vectors as they are."""
        return self.geometry.places[None], self.geometry.vectors[None]

    def node(self, given: int) -> int:
        """A node of the model as given in that as analysed."""
        return int(np.searchsorted(self.result.condensed.nodes, given))

    def element(self, part: Part) -> int:
        """The element of a part in the model as analysed."""
        return int(np.searchsorted(self.result.condensed.elements, part.elements[0]))

    def ends(self, part: Part) -> tuple[int, int]:
        """Both ends of a part, in the model as analysed."""
        slots = self.result.data.arrays.element_node[[0, 2], self.element(part)] - 1
        return int(slots[0]), int(slots[1])

    def axis(self, part: Part) -> FigureAt | None:
        """The axis of a hinge; None where it stands at no known place."""
        place, element = position_of_hinge(self.result, part), self.element(part)
        if place is None:
            return None
        node = self.node(place)
        return lambda places, vectors: (places[:, node], unit(vectors[:, element]))

    def line(self, part: Part) -> FigureAt:
        """The line of a bar, wire or member from end to end."""
        p, q = self.ends(part)
        return lambda places, _: (places[:, p], unit(places[:, q] - places[:, p]))

    def plane(self, part: Part) -> FigureAt:
        """The plane of a sheet."""
        (p, q), element = self.ends(part), self.element(part)
        is_width = int(self.result.parts.wide[part.elements[0]]) == 1

        def at(places: FloatArray, vectors: FloatArray) -> Figure:
            along, across = unit(places[:, q] - places[:, p]), vectors[:, element]
            if is_width:
                return places[:, p], unit(np.cross(along, across))
            return places[:, p], unit(across - _dot(across, along) * along)

        return at

    def own(self, part: Part) -> tuple[LineKind, FigureAt] | None:
        """The plane of a sheet in space, the axis of a hinge, or the line of a wire or bar."""
        planar = self.result.given.planar
        if part.kind is PartKind.SHEET and not planar:
            return "sheet", self.plane(part)
        if part.kind is PartKind.HINGE and not planar:
            axis = self.axis(part)
            return None if axis is None else ("axis", axis)
        if part.kind in (PartKind.SHEET, PartKind.WIRE, PartKind.BAR):
            return "force", self.line(part)
        return None

    def fold(self, parts: Sequence[Part]) -> FigureAt:
        """The line in which the planes of two sheets meet that are folded."""
        first, second = (self.plane(part) for part in parts)
        shared = set(self.ends(parts[0])) & set(self.ends(parts[1]))
        node = shared.pop()

        def at(places: FloatArray, vectors: FloatArray) -> Figure:
            normals = first(places, vectors)[1], second(places, vectors)[1]
            return places[:, node], unit(np.cross(*normals))

        return at


def condition_of(figures: Figures, one: Relation, about: FloatArray) -> Condition | None:
    """The condition of a relation; None where it is none of lines, planes or joints.

    Args:
        figures: The lines and planes.
        one: The relation.
        about: (3,) about which its lines make a couple, where they do in the self-stress.
    """
    parts = one.parts
    nodes = {figures.node(given) for given in one.nodes}
    for part in parts:
        nodes |= {node for node in figures.ends(part) if node >= 0}
        place = position_of_hinge(figures.result, part) if part.kind is PartKind.HINGE else None
        nodes |= set() if place is None else {figures.node(place)}
    made = _residual(figures, one)
    if made is None:
        return None
    if one.couple.any():
        made = _with_couple(figures, one, about, made)
    elements = tuple(figures.element(part) for part in parts)
    is_directed = one.of != "joint" and made[1].size == 6
    return Condition(*made, tuple(sorted(nodes)), elements, is_directed)


_Residual = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
_Made = tuple[_Residual, FloatArray]


def _residual(figures: Figures, one: Relation) -> _Made | None:
    kind = one.kind
    if kind in ("position", "reflection"):
        return None
    if kind in ("along", "across axis"):
        return _of_axis(figures, one)
    if one.of == "joint":
        return _of_joints(figures, one)
    if one.of == "member" and kind in ("one line", "one plane"):
        return _of_points(figures, one)
    found = _figures(figures, one)
    if found is None:
        return None
    planes, lines = found
    if kind == "rotation":
        return _of_half_turn(figures, one, lines) if one.of == "axis" else None
    if kind == "regulus":
        return _of_regulus(figures, lines)
    return _of_figures(figures, one, planes, lines)


def _figures(figures: Figures, one: Relation) -> tuple[list[FigureAt], list[FigureAt]] | None:
    """The planes and lines that a relation is about; None where one of them is not known."""
    planes: list[FigureAt] = []
    lines: list[FigureAt] = []
    limb_of = {part: limb.parts for limb in figures.limbs.all for part in limb.parts}
    done: set[Part] = set()
    for part in one.parts:
        if part in done:
            continue
        limb = limb_of.get(part, (part,))
        if part.kind is PartKind.HINGE:
            axis = figures.axis(part)
            if axis is None:
                return None
            lines.append(axis)
        elif part.kind is not PartKind.SHEET:
            lines.append(figures.line(part))
        elif one.of == "sheet":
            planes.append(figures.plane(part))
        elif len(limb) == 2:
            lines.append(figures.fold(limb))
            done |= set(limb)
        else:
            return None
    return planes, lines


def _of_figures(
    figures: Figures, one: Relation, planes: list[FigureAt], lines: list[FigureAt]
) -> _Made:
    length, direction = figures.length, one.direction
    if not direction.any():
        direction = [*planes, *lines][0](*figures.here)[1][0]
    # Direction, point over the length, and what else is shared, as it is.
    pitch = [one.pitch / length] if one.kind == "complex" else []
    free = np.concatenate((direction, one.point / length, pitch))

    def residual(places: FloatArray, vectors: FloatArray, free: FloatArray) -> FloatArray:
        made: list[FloatArray] = []
        for figure in (*lines, *planes):
            made += _zero(one.kind, figure in planes, figure(places, vectors), free, length)
        return np.concatenate([*made, _size(free[:, :3])], axis=1)

    return residual, free


def _with_couple(figures: Figures, one: Relation, about: FloatArray, made: _Made) -> _Made:
    """The lines make a couple about a given direction besides: of two parallel ones their plane."""
    lines, plain = (_figures(figures, one) or ([], []))[1], made[0]

    def residual(places: FloatArray, vectors: FloatArray, free: FloatArray) -> FloatArray:
        at = [line(places, vectors) for line in lines]
        more = [_dot(way, about) for _, way in at]
        if len(at) == 2:
            more.append(_dot(at[1][0] - at[0][0], about) / figures.length)
        return np.concatenate([plain(places, vectors, free), *more], axis=1)

    return residual, made[1]


def _of_regulus(figures: Figures, lines: list[FigureAt]) -> _Made:
    """Four lines whose coordinates are dependent."""
    length = figures.length

    def coordinates(places: FloatArray, vectors: FloatArray) -> FloatArray:
        at = [line(places, vectors) for line in lines]
        rows = [np.concatenate((way, np.cross(point / length, way)), axis=1) for point, way in at]
        return np.stack(rows, axis=1)

    def residual(places: FloatArray, vectors: FloatArray, free: FloatArray) -> FloatArray:
        added = np.einsum("bi,bij->bj", free, coordinates(places, vectors))
        return np.concatenate((added, _size(free)), axis=1)

    return residual, np.linalg.svd(coordinates(*figures.here)[0])[0][:, -1]


def _zero(
    kind: RelationKind, is_plane: bool, figure: Figure, free: FloatArray, length: float
) -> tuple[FloatArray, ...]:
    """What is zero of a line, or of a plane, with the direction and the point of a relation."""
    (at, way), axis = figure, free[:, :3]
    off = at / length - free[:, 3:6]
    match kind, is_plane:
        case "one line", False:
            return np.cross(way, axis), np.cross(off, axis)
        case ("parallel", _) | ("across", True):
            return (np.cross(way, axis),)
        case "across", False:
            return (_dot(way, axis),)
        case "one plane", False:
            return _dot(way, axis), _dot(off, axis)
        case "one plane", True:
            return np.cross(way, axis), _dot(off, axis)
        case "concurrent", False:
            return (np.cross(off, way),)
        case "one transversal", True:
            return _dot(way, axis), _dot(off, way)
        case "one transversal", False:
            return (_dot(np.cross(off, way), axis),)
        case "complex", False:
            return (_dot(np.cross(off, way), axis) + free[:, 6:7] * _dot(way, axis),)
    return ()


def _of_axis(figures: Figures, one: Relation) -> _Made | None:
    """Directions along or across one that is the ground's, and no other will do."""
    found = [own[1] for own in map(figures.own, one.parts) if own is not None]

    def residual(places: FloatArray, vectors: FloatArray, _: FloatArray) -> FloatArray:
        ways, axis = (figure(places, vectors)[1] for figure in found), one.direction[None]
        off = [np.cross(way, axis) if one.kind == "along" else _dot(way, axis) for way in ways]
        return np.concatenate(off, axis=1)

    return residual, np.zeros(0)


def _of_half_turn(figures: Figures, one: Relation, lines: list[FigureAt]) -> _Made | None:
    """Lines that a half-turn takes onto each other."""
    length = figures.length
    now = [line(*figures.here) for line in lines]
    free = np.concatenate((one.direction, one.point / length))
    pairs = []
    for i, line in enumerate(now):
        turned = half_turned(line, free[None], length)
        found = [j for j, other in enumerate(now) if are_one(turned, other, length)]
        if not found:
            return None
        pairs += [(i, found[0])] if i <= found[0] else []

    def residual(places: FloatArray, vectors: FloatArray, free: FloatArray) -> FloatArray:
        at = [line(places, vectors) for line in lines]
        made = [_off(half_turned(at[i], free, length), at[j], length) for i, j in pairs]
        return np.concatenate([*made, _size(free[:, :3])], axis=1)

    return residual, free


def half_turned(line: Figure, axis: FloatArray, length: float) -> Figure:
    """Lines turned by half a turn about axes (b, 6): direction, and point over the length."""
    point, way = line
    at, unit = point / length - axis[:, 3:6], axis[:, :3]
    return (
        length * (axis[:, 3:6] + 2.0 * _dot(unit, at) * unit - at),
        2.0 * _dot(unit, way) * unit - way,
    )


def _off(one: Figure, other: Figure, length: float) -> FloatArray:
    away = np.cross(one[0] - other[0], other[1]) / length
    return np.concatenate((np.cross(one[1], other[1]), away), axis=1)


def are_one(one: Figure, other: Figure, length: float) -> bool:
    """Whether two lines are one."""
    return float(np.abs(_off(one, other, length)).max()) < SAME


def _of_points(figures: Figures, one: Relation) -> _Made:
    """Members whose ends are all on one line or in one plane."""
    length = figures.length
    members = [index for part in one.parts for index in part.elements]
    result = figures.result
    mine = np.isin(result.condensed.elements, members)
    slots = result.data.arrays.element_node[[0, 2]][:, mine] - 1
    nodes = values_in(slots[slots >= 0]).tolist()
    in_line = one.kind == "one line"

    def residual(places: FloatArray, _: FloatArray, free: FloatArray) -> FloatArray:
        away = places[:, nodes] / length - free[:, None, 3:6]
        way = free[:, None, :3]
        off = np.cross(away, np.broadcast_to(way, away.shape)) if in_line else _dot(away, way)
        return np.concatenate((off.reshape(len(off), -1), _size(free[:, :3])), axis=1)

    return residual, np.concatenate((one.direction, one.point / length))


def _of_joints(figures: Figures, one: Relation) -> _Made | None:
    """Joints of the plane on a circle, a conic or two lines."""
    nodes = [figures.node(given) for given in one.nodes]
    length = figures.length
    at = figures.result.data.arrays.node_value[:2, nodes].T / length
    middle = at.mean(axis=0)
    if one.kind == "two lines":
        return _of_two_lines(figures, nodes)
    terms = circle_terms if one.kind == "circle" else conic_terms

    def residual(places: FloatArray, _: FloatArray, free: FloatArray) -> FloatArray:
        rows = terms(places[:, nodes, :2] / length - middle)
        off = np.einsum("bij,bj->bi", rows, free)
        return np.concatenate((off, _size(free)), axis=1)

    return residual, np.linalg.svd(terms(at - middle))[2][-1]


def circle_terms(at: FloatArray) -> FloatArray:
    """(..., 4) terms of a circle at points (..., 2): dependent of points on one."""
    x, y = at[..., 0], at[..., 1]
    return np.stack((x**2 + y**2, x, y, np.ones_like(x)), axis=-1)


def conic_terms(at: FloatArray) -> FloatArray:
    """(..., 6) terms of a conic, likewise."""
    x, y = at[..., 0], at[..., 1]
    return np.stack((x**2, x * y, y**2, x, y, np.ones_like(x)), axis=-1)


def on_two_lines(points: FloatArray) -> Iterator[BoolArray]:
    """Which of points (n, 2) are on the first of two lines that have all of them; for each pair.

    One of the lines goes through two of the first three.
    """
    for i, j in combinations(range(3), 2):
        on = _is_on_line(points, points[i], points[j])
        rest = points[~on]
        if len(rest) < 3 or bool(_is_on_line(rest, rest[0], rest[1]).all()):
            yield on


def _is_on_line(points: FloatArray, first: FloatArray, second: FloatArray) -> BoolArray:
    way = second - first
    off = (points[:, 0] - first[0]) * way[1] - (points[:, 1] - first[1]) * way[0]
    return np.asarray(np.abs(off) <= SAME * float(way @ way), bool)


def _of_two_lines(figures: Figures, nodes: list[int]) -> _Made | None:
    """Of each joint the line on which it is; a line by its unit normal and its distance."""
    length = figures.length
    at = figures.result.data.arrays.node_value[:2, nodes].T / length
    on = next((each for each in on_two_lines(at) if np.count_nonzero(~each) > 1), None)
    if on is None:
        return None
    sides = on, ~on

    def residual(places: FloatArray, _: FloatArray, free: FloatArray) -> FloatArray:
        now, made = places[:, nodes, :2] / length, list[FloatArray]()
        for k, chosen in zip((0, 3), sides, strict=True):
            normal, distance = free[:, None, k : k + 2], free[:, k + 2, None]
            made += [(now[:, chosen] * normal).sum(axis=2) - distance, _size(free[:, k : k + 2])]
        return np.concatenate(made, axis=1)

    return residual, np.concatenate([_through_points(at[side]) for side in sides])


def _through_points(at: FloatArray) -> FloatArray:
    middle = at.mean(axis=0)
    normal = np.linalg.svd(at - middle)[2][-1]
    return np.append(normal, normal @ middle)


def _dot(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.asarray((one * other).sum(axis=-1, keepdims=True))


def _size(unit: FloatArray) -> FloatArray:
    """(b, 1) by what the square of the length is not one."""
    return _dot(unit, unit) - 1.0
