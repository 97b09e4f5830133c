# SPDX-License-Identifier: BSD-3-Clause
"""Relations as equations: what is zero at every geometry that has one, and nothing else.

Lines, planes and points are taken from the places of nodes and the vectors of elements, so that
Newton's method, with the least change, leads a random geometry to one that has the relation. All
is of many geometries at once, (b, ...), as differences need them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ...analysis.result import Result
from ...core.arrays import BoolArray, FloatArray
from ...model.parts.parts import Part, PartKind
from .cause import LineKind, Relation, RelationKind
from .gradients import Geometry
from .lines import Limbs, position_of_hinge

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
        return lambda places, vectors: (places[:, node], _unit(vectors[:, element]))

    def line(self, part: Part) -> FigureAt:
        """The line of a bar, wire or member from end to end."""
        p, q = self.ends(part)
        return lambda places, _: (places[:, p], _unit(places[:, q] - places[:, p]))

    def plane(self, part: Part) -> FigureAt:
        """The plane of a sheet."""
        (p, q), element = self.ends(part), self.element(part)
        is_width = int(self.result.parts.wide[part.elements[0]]) == 1

        def at(places: FloatArray, vectors: FloatArray) -> Figure:
            along, across = _unit(places[:, q] - places[:, p]), vectors[:, element]
            if is_width:
                return places[:, p], _unit(np.cross(along, across))
            return places[:, p], _unit(across - _dot(across, along) * along)

        return at

    def own(self, part: Part) -> tuple[LineKind, FigureAt] | None:
        """The plane of a sheet in space, the axis of a hinge, or the line of a wire or bar."""
        planar = self.result.given.planar
        if part.kind is PartKind.SHEET and not planar:
            return LineKind.SHEET, self.plane(part)
        if part.kind is PartKind.HINGE and not planar:
            axis = self.axis(part)
            return None if axis is None else (LineKind.AXIS, axis)
        if part.kind in (PartKind.SHEET, PartKind.WIRE, PartKind.BAR):
            return LineKind.FORCE, self.line(part)
        return None

    def fold(self, parts: Sequence[Part]) -> FigureAt:
        """The line in which the planes of two sheets meet that are folded."""
        first, second = (self.plane(part) for part in parts)
        shared = set(self.ends(parts[0])) & set(self.ends(parts[1]))
        node = shared.pop()

        def at(places: FloatArray, vectors: FloatArray) -> Figure:
            normals = first(places, vectors)[1], second(places, vectors)[1]
            return places[:, node], _unit(np.cross(*normals))

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
    is_directed = one.of is not LineKind.JOINT and made[1].size == 6
    return Condition(*made, tuple(sorted(nodes)), elements, is_directed)


_Residual = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
_Made = tuple[_Residual, FloatArray]


def _residual(figures: Figures, one: Relation) -> _Made | None:
    kind = one.kind
    if kind in (RelationKind.POSITION, RelationKind.REFLECTION):
        return None
    if kind in (RelationKind.ALONG, RelationKind.ACROSS_AXIS):
        return _of_axis(figures, one)
    if one.of is LineKind.JOINT:
        return _of_joints(figures, one)
    if one.of is LineKind.MEMBER and kind in (RelationKind.ONE_LINE, RelationKind.ONE_PLANE):
        return _of_points(figures, one)
    found = _figures(figures, one)
    if found is None:
        return None
    planes, lines = found
    if kind is RelationKind.ROTATION:
        return _of_half_turn(figures, one, lines) if one.of is LineKind.AXIS else None
    if kind is RelationKind.REGULUS:
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
        elif one.of is LineKind.SHEET:
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
    of_line, of_plane = _TERMS[one.kind]
    if not direction.any():
        direction = [*planes, *lines][0](*figures.here)[1][0]
    # Direction, point over the length, and what else is shared, as it is.
    pitch = [one.pitch / length] if one.kind is RelationKind.COMPLEX else []
    free = np.concatenate((direction, one.point / length, pitch))

    def residual(places: FloatArray, vectors: FloatArray, free: FloatArray) -> FloatArray:
        made = [of_line(*figure(places, vectors), free, length) for figure in lines]
        made += [of_plane(*figure(places, vectors), free, length) for figure in planes]
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


_Term = Callable[[FloatArray, FloatArray, FloatArray, float], FloatArray]


def _parallel(_: FloatArray, way: FloatArray, free: FloatArray, __: float) -> FloatArray:
    return np.cross(way, free[:, :3])


def _across(_: FloatArray, way: FloatArray, free: FloatArray, __: float) -> FloatArray:
    return _dot(way, free[:, :3])


def _on_line(at: FloatArray, way: FloatArray, free: FloatArray, length: float) -> FloatArray:
    off = np.cross(at / length - free[:, 3:6], free[:, :3])
    return np.concatenate((np.cross(way, free[:, :3]), off), axis=1)


def _in_plane(at: FloatArray, way: FloatArray, free: FloatArray, length: float) -> FloatArray:
    off = _dot(at / length - free[:, 3:6], free[:, :3])
    return np.concatenate((_dot(way, free[:, :3]), off), axis=1)


def _same_plane(at: FloatArray, way: FloatArray, free: FloatArray, length: float) -> FloatArray:
    off = _dot(at / length - free[:, 3:6], free[:, :3])
    return np.concatenate((np.cross(way, free[:, :3]), off), axis=1)


def _through(at: FloatArray, way: FloatArray, free: FloatArray, length: float) -> FloatArray:
    return np.cross(at / length - free[:, 3:6], way)


def _meets(at: FloatArray, way: FloatArray, free: FloatArray, length: float) -> FloatArray:
    return _dot(np.cross(at / length - free[:, 3:6], way), free[:, :3])


def _contains(at: FloatArray, way: FloatArray, free: FloatArray, length: float) -> FloatArray:
    off = _dot(at / length - free[:, 3:6], way)
    return np.concatenate((_dot(way, free[:, :3]), off), axis=1)


def _in_complex(at: FloatArray, way: FloatArray, free: FloatArray, length: float) -> FloatArray:
    return _meets(at, way, free, length) + free[:, 6:7] * _dot(way, free[:, :3])


def _none(at: FloatArray, *_: object) -> FloatArray:
    return np.zeros((len(at), 0))


#: What is zero of each line, and of each plane.
_TERMS: dict[RelationKind, tuple[_Term, _Term]] = {
    RelationKind.ONE_LINE: (_on_line, _none),
    RelationKind.PARALLEL: (_parallel, _parallel),
    RelationKind.ONE_PLANE: (_in_plane, _same_plane),
    RelationKind.CONCURRENT: (_through, _none),
    RelationKind.ONE_TRANSVERSAL: (_meets, _contains),
    RelationKind.ACROSS: (_across, _parallel),
    RelationKind.COMPLEX: (_in_complex, _none),
}


def _of_axis(figures: Figures, one: Relation) -> _Made | None:
    """Directions along or across one that is the ground's, and no other will do."""
    found = [own[1] for own in map(figures.own, one.parts) if own is not None]
    term = _parallel if one.kind is RelationKind.ALONG else _across

    def residual(places: FloatArray, vectors: FloatArray, _: FloatArray) -> FloatArray:
        way = one.direction[None]
        at = (figure(places, vectors) for figure in found)
        return np.concatenate([term(*each, way, figures.length) for each in at], axis=1)

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


_SAME = 1.0e-6


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
    return float(np.abs(_off(one, other, length)).max()) < _SAME


def _of_points(figures: Figures, one: Relation) -> _Made:
    """Members whose ends are all on one line or in one plane."""
    length = figures.length
    nodes = sorted({node for part in one.parts for node in _positions(figures, part)})
    in_line = one.kind is RelationKind.ONE_LINE

    def residual(places: FloatArray, _: FloatArray, free: FloatArray) -> FloatArray:
        away = places[:, nodes] / length - free[:, None, 3:6]
        way = free[:, None, :3]
        off = np.cross(away, np.broadcast_to(way, away.shape)) if in_line else _dot(away, way)
        return np.concatenate((off.reshape(len(off), -1), _size(free[:, :3])), axis=1)

    return residual, np.concatenate((one.direction, one.point / length))


def _positions(figures: Figures, part: Part) -> list[int]:
    """The position nodes of all elements of a part, in the model as analysed."""
    own = figures.result.condensed.elements
    found = [int(np.searchsorted(own, index)) for index in part.elements]
    able = [k for k, index in zip(found, part.elements, strict=True) if k < own.size]
    slots = figures.result.data.arrays.element_node[[0, 2]][:, able] - 1
    return [int(node) for node in slots.ravel() if node >= 0]


def _of_joints(figures: Figures, one: Relation) -> _Made | None:
    """Joints of the plane on a circle, a conic or two lines."""
    nodes = [figures.node(given) for given in one.nodes]
    length = figures.length
    at = figures.result.data.arrays.node_value[:2, nodes].T / length
    middle = at.mean(axis=0)
    if one.kind is RelationKind.TWO_LINES:
        return _of_two_lines(figures, nodes)
    terms = circle_terms if one.kind is RelationKind.CIRCLE else conic_terms

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


def _of_two_lines(figures: Figures, nodes: list[int]) -> _Made | None:
    """Of each joint the line on which it is; a line by its unit normal and its distance."""
    at = figures.result.data.arrays.node_value[:2, nodes].T / figures.length
    for i, j in combinations(range(min(3, len(nodes))), 2):
        way = at[j] - at[i]
        off = (at[:, 0] - at[i, 0]) * way[1] - (at[:, 1] - at[i, 1]) * way[0]
        on = np.abs(off) <= _SAME * float(way @ way)
        if np.count_nonzero(~on) < 2:
            continue
        lines = _through_points(at[on]), _through_points(at[~on])
        if float(np.abs(at[~on] @ lines[1][:2] - lines[1][2]).max()) <= _SAME:
            return _on_two_lines(figures.length, nodes, on), np.concatenate(lines)
    return None


def _on_two_lines(length: float, nodes: list[int], on: BoolArray) -> _Residual:
    def residual(places: FloatArray, _: FloatArray, free: FloatArray) -> FloatArray:
        now = places[:, nodes, :2] / length
        made = []
        for k, chosen in ((0, on), (3, ~on)):
            normal, distance = free[:, None, k : k + 2], free[:, k + 2, None]
            made += [(now[:, chosen] * normal).sum(axis=2) - distance, _size(free[:, k : k + 2])]
        return np.concatenate(made, axis=1)

    return residual


def _through_points(at: FloatArray) -> FloatArray:
    middle = at.mean(axis=0)
    normal = np.linalg.svd(at - middle)[2][-1]
    return np.append(normal, normal @ middle)


def _unit(vectors: FloatArray) -> FloatArray:
    sizes = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.maximum(sizes, 1.0e-300))


def _dot(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.asarray((one * other).sum(axis=-1, keepdims=True))


def _size(unit: FloatArray) -> FloatArray:
    """(b, 1) by what the square of the length is not one."""
    return _dot(unit, unit) - 1.0
