# SPDX-License-Identifier: BSD-3-Clause
"""How a flexure of a layout may be moved so that it goes on holding nothing of a wanted freedom.

All of it is in the frame of a problem, in parts of its size. Lines of W are the zeros of q on W; at
a line c the directions d with c'Qd = 0 are tangent to them, and from c + d back to a line it goes
along Q c, by the smaller root of a quadratic equation, all within W. Where Q c is zero, as in a
flat family, the directions with Q d = 0 stay. Planes are those in which the freedom leaves all
lines (theorem 2), found anew where a sheet is moved to. So a flexure that was moved is exact with
the others as it was before, unless lines become dependent.

Where a flexure begins and ends along its line follows from the regions as in `candidates.reached`,
for a least length that may be asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..advice.spaces.screws import canonical, complement
from ..core.arrays import FloatArray
from ..util.errors import FlexactError
from ..util.rotations import matrix_of, unit
from .candidates import (
    Candidates,
    Place,
    able,
    folded_between,
    nearest_in,
    planes,
    sheets_between,
    spans,
    wires_between,
)
from .frame import turned_screws
from .geometry import TINY, cut
from .images import materials, moved
from .problem import Box
from .rods import (
    bellows_between,
    height_of,
    outer_sizes,
    radius_of,
    reach_of,
    rods_between,
    round_ends,
    struts_between,
)

#: Forms of flexures that hold a force along a line; those with a breadth; those with two ends in a
#: line.
_OF_LINES = ("wire", "strut", "folded sheet")
WIDE = ("sheet", "waisted sheet", "folded sheet", "notch", "rod", "bellows")
STRAIGHT = ("wire", "strut", "sheet", "waisted sheet", "notch", "rod", "bellows")
#: How far places and angles are moved at most, in parts of the size and radians.
_FAR, _TURNED = 1.5, 0.8
#: How far something is moved to see what it does.
_TRIAL = 0.01
#: A force of less is a couple; of a plane, by how much it may turn in a trial.
_NO_FORCE, _JUMP = 1.0e-3, 0.2
#: What leads from a line to no other one, and how far two materials that are alike are apart.
_FLAT, _SAME = 1.0e-9, 1.0e-6
#: A leaf of a folded sheet is this part of the least length at least, to have a state.
_LEAF = 0.1
#: What is no radius of a notch, in its thickness.
_LEAST_ROUND = 3.0


class NoPlaceError(FlexactError):
    """A flexure cannot be where it was moved to; the text says why."""


class Degree(NamedTuple):
    """A way in which a flexure may be moved.

    Attributes:
        words: Such as "shift 1".
        unit: "m", or "rad".
        far: How far at most, in parts of the size or radians.
    """

    words: str
    unit: str
    far: float


class Mover:
    """A flexure, and how it may be moved.

    Args:
        flexure: One, at rest.
        place: Between which regions it is, with sizes as they are at rest; None where its ends
            stay.
        kept: (n, 3, 3) turns and mirrors that it is to be its own image under.
        least: The length that it has at least at rest.

    Attributes:
        off: How far it is, at rest, from where it would be by the regions alone.
    """

    def __init__(
        self,
        flexure: Candidates,
        place: Place | None,
        kept: Sequence[FloatArray] = (),
        least: float = 0.0,
    ) -> None:
        """Find its degrees."""
        self.rest, self.form, self.place = flexure, flexure.kind, place
        self.first, self.last = flexure.ends[0]
        self.way = unit(self.last - self.first)
        self.width = float(flexure.width[0])
        self.normal, self.via, self.axes = (
            each[0] for each in (flexure.normal, flexure.via, flexure.axes)
        )
        self.degrees: tuple[Degree, ...] = ()
        self.off, self._least = 0.0, least
        self._off: tuple[FloatArray, FloatArray] = (np.zeros(3), np.zeros(3))
        if place is None:
            return
        self.boxes = tuple(
            min(boxes, key=lambda box: round(_beyond_box(points, box), 9))
            for boxes, points in zip(
                (place.here, place.there), clamps_of(flexure, place.sizes.diameter), strict=True
            )
        )
        if self.form in _OF_LINES:
            self._prepare_line(kept)
        every = self._possible()
        self._count = len(every)
        # Images, and what is longer than it need be, lie otherwise along their lines.
        try:
            if self.form == "folded sheet":
                first, last = self._nearest(self.via[0], self.axes[0], self.width)
            else:
                first, last = self._made(np.zeros(self._count), self.width, 0.0, place).ends[0]
        except NoPlaceError:
            self.place = None
            return
        self._off = self.first - first, self.last - last
        self.off = round(float(np.abs(self._off).max()), 6)
        self._which = [k for k in range(self._count) if self._is_degree(k, kept)]
        self.degrees = tuple(every[k] for k in self._which)

    def at(self, moves: FloatArray, width: float, least: float, place: Place) -> Candidates:
        """The flexure after moves.

        Args:
            moves: (n,) how far in each of its degrees.
            width: Of it; of wires nothing.
            least: The length that it has at least.
            place: With the sizes of flexures.

        Raises:
            NoPlaceError: it cannot be there.
        """
        if self.place is None:
            at = self.via[0] if len(self.via) else None
            return self._built(self.first, self.last, self.normal, width, place, at, self.axes)
        every = np.zeros(self._count)
        every[self._which] = moves
        return self._made(every, width, least, place)

    # Degrees ------------------------------------------------------------------------------

    def _possible(self) -> tuple[Degree, ...]:
        """Degrees that its form may have."""
        if self.form in _OF_LINES:
            made = [Degree(f"shift {k + 1}", "m", _FAR) for k in range(len(self._tangents))]
            along = Degree("shift along its fold", "m", _FAR)
            return (*made, along) if self.form == "folded sheet" else tuple(made)
        side = Degree("shift sideways", "m", _FAR)
        turn = Degree("turn", "rad", _TURNED)
        return {
            "sheet": (side, turn, Degree("shift of its plane", "m", _FAR)),
            "rod": (side, Degree("shift of its plane", "m", _FAR)),
            "waisted sheet": (side, turn, Degree("shift of its plane", "m", _FAR)),
            "notch": (side, turn),
            "bellows": (side, Degree("shift across", "m", _FAR)),
        }[self.form]

    def _is_degree(self, k: int, kept: Sequence[FloatArray]) -> bool:
        """Whether moving it so leads somewhere, and it stays its own image."""
        assert self.place is not None
        found = False
        for sense in (1.0, -1.0):
            moves = np.zeros(self._count)
            moves[k] = sense * _TRIAL
            try:
                made = self._made(moves, self.width, 0.0, self.place)
            except NoPlaceError:
                continue
            if np.abs(made.normal[0] - self.normal).max() > _JUMP:
                return False
            here = materials(made, 9)
            for turn in kept:
                if np.abs(materials(moved(made, turn), 9) - here).max() > _SAME:
                    return False
            found = True
        return found

    def _prepare_line(self, kept: Sequence[FloatArray]) -> None:
        """Its line in coordinates of W, and an orthonormal basis of directions to other lines.

        Orthonormal in what the line does to two points of it: the ends, or those beside a fold.
        """
        assert self.place is not None
        rows = canonical(complement(np.roll(self.place.freedom, 3, axis=1)))
        self._rows = rows
        self._form = (rows[:, :3] @ rows[:, 3:].T + rows[:, 3:] @ rows[:, :3].T) / 2.0
        line = rows @ self.rest.rows[0, 0]
        slope = self._form @ line
        if np.linalg.norm(slope) > _FLAT:
            stay = np.stack((slope, line))
        else:
            stay = np.concatenate((self._form, line[None]))
        if self.form == "folded sheet":
            way = self.axes[0]
            points = self.via[0] + np.array([[-0.5], [0.5]]) * way
        else:
            way, points = self.way, np.array((self.first, self.last))
        tangents = _null(stay) @ rows
        if len(tangents) and len(kept):
            # Of each the mean of its images, with the sense in which the line is its own image.
            force = self.rest.rows[0, 0]
            images = [
                _turned(turn, tangents) * np.sign(_turned(turn, force) @ force) for turn in kept
            ]
            tangents = np.mean([tangents, *images], axis=0)
        shifts = [
            np.cross(way, tangents[:, 3:] - np.cross(point, tangents[:, :3])) for point in points
        ]
        does = np.concatenate(shifts, axis=1)
        left, sizes, right = np.linalg.svd(does, full_matrices=False)
        some = sizes > 1.0e-6
        basis = canonical(right[some]) if some.any() else np.zeros((0, 6))
        # tangents.T @ back do what the basis says.
        back = basis @ right[some].T @ np.diag(1.0 / sizes[some]) @ left[:, some].T
        self._line, self._tangents = line, back @ tangents @ rows.T

    # Places -------------------------------------------------------------------------------

    def _made(self, moves: FloatArray, width: float, least: float, place: Place) -> Candidates:
        """The flexure after moves in all of the possible degrees."""
        make: Callable[..., Candidates] = {
            "wire": self._along_line,
            "strut": self._along_line,
            "folded sheet": self._folded,
            "sheet": self._in_plane,
            "rod": self._in_plane,
            "waisted sheet": self._from_waist,
            "notch": self._about_notch,
            "bellows": self._beside,
        }[self.form]
        return make(moves, width, max(least, self._least, place.sizes.length[0]), place)

    def _moved_line(self, moves: FloatArray) -> tuple[FloatArray, FloatArray]:
        """A point of a line of W, and its direction."""
        line = self._line + moves @ self._tangents
        way = self._form @ line
        off = float(line @ way)
        if abs(off) > 1.0e-15:
            slope, bend = float(way @ way), float(way @ self._form @ way)
            square = slope * slope - bend * off
            if slope <= _FLAT**2 or square <= 0.0:
                raise NoPlaceError("there is no line of the constraint where a flexure would be")
            line = line - off / (slope + np.sqrt(square)) * way
        force, moment = np.split(line @ self._rows, 2)
        size = float(np.linalg.norm(force))
        if size < _NO_FORCE:
            raise NoPlaceError("there is no line of the constraint where a flexure would be")
        force, moment = force / size, moment / size
        return np.cross(force, moment), force

    def _along_line(
        self, moves: FloatArray, width: float, least: float, place: Place
    ) -> Candidates:
        point, way = self._moved_line(moves)
        way = way if way @ self.way > 0.0 else -way
        half = np.zeros((1, 3))
        if self.form == "strut":
            thick = outer_sizes("strut", place.sizes.diameter, 0.0, 0.0, 0.0)[0]
            half = round_ends(way[None], thick)
        start, end = self._seated(point, way, half, least)
        return self._built(start, end, self.normal, width, place)

    def _in_plane(self, moves: FloatArray, width: float, least: float, place: Place) -> Candidates:
        is_rod = self.form == "rod"
        side, turn, over = (moves[0], 0.0, moves[1]) if is_rod else moves
        middle = (self.first + self.last) / 2.0
        normal = self.normal
        if over:
            middle, normal = self._other_plane(middle, over)
        way = unit(self.way - (self.way @ normal) * normal)
        way = matrix_of(turn * normal) @ way if turn else way
        beside = np.cross(normal, way)
        half = self._edges(normal, way, width, place)
        start, end = self._seated(middle + side * beside, way, half, least)
        return self._built(start, end, normal, width, place)

    def _other_plane(self, middle: FloatArray, over: float) -> tuple[FloatArray, FloatArray]:
        """A point, and the normal, of a plane with all lines in W, from where a sheet is."""
        # That end at which the plane goes along with the freedom most.
        at = max((self.first, self.last, middle), key=lambda each: round(self._speed(each), 6))
        there = at + over * self.normal
        points, normals = planes(self.freedom, there[None], pencil=False)
        if not len(points):
            raise NoPlaceError("there is no plane of the constraint where a sheet would be")
        along = normals @ self.normal
        best = int(np.argmax(np.round(np.abs(along), 9)))
        normal = normals[best] * np.sign(along[best] or 1.0)
        return middle - ((middle - there) @ normal) * normal, normal

    @property
    def freedom(self) -> FloatArray:
        """(d, 6) orthonormal rows of T."""
        assert self.place is not None
        return self.place.freedom

    def _speed(self, point: FloatArray) -> float:
        found = self.freedom[:, 3:] + np.cross(self.freedom[:, :3], point)
        return float(np.linalg.norm(found))

    def _from_waist(
        self, moves: FloatArray, width: float, least: float, place: Place
    ) -> Candidates:
        side, turn, over = moves
        beside = np.cross(self.normal, self.way)
        waist = self.via[0] + side * beside + over * self.normal
        vectors, counts = able(self.freedom, waist[None])
        if counts[0] < 2:
            raise NoPlaceError("there is no plane of the constraint at the waist of a sheet")
        normal = self.normal
        if counts[0] == 2:
            normal = vectors[0, 0] * np.sign(vectors[0, 0] @ self.normal or 1.0)
        way = unit(self.way - (self.way @ normal) * normal)
        way = matrix_of(turn * normal) @ way if turn else way
        half = self._edges(normal, way, width, place)
        at_first = bool(np.linalg.norm(self.via[0] - self.first) < TINY)
        start, end = self._seated(waist, way, half, least, 0 if at_first else 1)
        return self._built(start, end, normal, width, place, waist)

    def _about_notch(
        self, moves: FloatArray, width: float, least: float, place: Place
    ) -> Candidates:
        side, turn = moves
        axis = self.axes[0]
        at = self.via[0] + side * axis
        way = matrix_of(turn * axis) @ self.way if turn else self.way
        normal = np.cross(axis, way)
        half = self._edges(normal, way, width, place)
        reach = reach_of(place.sizes.thickness, place.sizes.length[0])
        start, end = self._seated(at, way, half, least, reach=reach)
        return self._built(start, end, normal, width, place, at, axis[None])

    def _beside(self, moves: FloatArray, width: float, least: float, place: Place) -> Candidates:
        axis = np.eye(3)[int(np.argmin(np.round(np.abs(self.way), 6)))]
        one = unit(np.cross(self.way, axis))
        point = self.first + moves[0] * one + moves[1] * np.cross(self.way, one)
        half = round_ends(self.way[None], width)
        start, end = self._seated(point, self.way, half, least)
        return self._built(start, end, self.normal, width, place)

    def _folded(self, moves: FloatArray, width: float, least: float, place: Place) -> Candidates:
        *shifts, along = moves
        point, way = self._moved_line(np.array(shifts))
        way = way if way @ self.axes[0] > 0.0 else -way
        fold = point + ((self.via[0] - point) @ way + along) * way
        start, end = (
            found + off - (off @ way) * way
            for found, off in zip(self._nearest(fold, way, width), self._off, strict=True)
        )
        return self._built(start, end, self.normal, width, place, fold, way[None])

    def _nearest(self, fold: FloatArray, way: FloatArray, width: float) -> list[FloatArray]:
        """Where the leaves of a folded sheet end: in its regions, nearest to the fold."""
        ends = []
        for box in self.boxes:
            found, fits = nearest_in(fold[None], way[None], width / 2.0 * way[None], box)
            if not fits[0]:
                raise NoPlaceError("the leaves of a folded sheet do not reach its regions")
            ends.append(found[0])
        return ends

    def _edges(self, normal: FloatArray, way: FloatArray, width: float, place: Place) -> FloatArray:
        """(m, 1, 3) from the middle of a clamped end to its corners on one side."""
        beside = width / 2.0 * np.cross(normal, way)
        if self.form not in ("notch", "rod"):
            return np.asarray(beside[None])
        deep = height_of(place.sizes.thickness, place.sizes.length[0]) / 2.0 * normal
        return np.stack((beside + deep, beside - deep))[:, None]

    def _seated(
        self,
        point: FloatArray,
        way: FloatArray,
        half: FloatArray,
        least: float,
        fixed: int | None = None,
        reach: float = 0.0,
    ) -> tuple[FloatArray, FloatArray]:
        """Where a flexure begins and ends along a line through a point, as `candidates.reached`.

        Args:
            point: (3,) of the line.
            way: (3,) along it, from body to ground.
            half: Its edges, as of `spans`.
            least: How long it is at least, if its regions have room for that.
            fixed: Which of its ends is at the point.
            reach: How far it reaches at least to both sides of the point; 0 for not at all.
        """
        found = []
        for box in self.boxes:
            first, last = (float(v[0]) for v in spans(point[None], way[None], half, box))
            if not (np.isfinite(first) and np.isfinite(last)):
                raise NoPlaceError("a flexure does not reach its regions")
            # A line that misses is as good as it can be, and is told to be outside.
            found.append((first, last) if first <= last else ((first + last) / 2.0,) * 2)
        (s0, s1), (g0, g1) = found
        if fixed == 0:
            begin, end = 0.0, max(g0, min(least, g1))
        elif fixed == 1:
            begin, end = min(s1, -min(least, -s0)), 0.0
        else:
            least = min(least, g1 - s0)
            begin = min(s1, g1 - least, -reach if reach else np.inf)
            end = max(g0, begin + least, reach if reach else -np.inf)
        begin += float(self._off[0] @ self.way) * (fixed != 0)
        end += float(self._off[1] @ self.way) * (fixed != 1)
        if end - begin < TINY:
            raise NoPlaceError("a flexure has no length")
        return point + begin * way, point + end * way

    def _built(
        self,
        start: FloatArray,
        end: FloatArray,
        normal: FloatArray,
        width: float,
        place: Place,
        at: FloatArray | None = None,
        axes: FloatArray | None = None,
    ) -> Candidates:
        """The flexure with these ends, by what makes all of its form."""
        # Regions, lengths and what is kept out are looked at for all flexures together.
        freedom = np.zeros((0, 6)) if self.place is None else place.freedom
        bare = Place(freedom, (), (), (), place.sizes)
        one, other, across = start[None], end[None], normal[None]
        if self.form in ("notch", "rod"):
            thickness, least = place.sizes.thickness, place.sizes.length[0]
            if radius_of(thickness, least) < _LEAST_ROUND * thickness or width < thickness:
                raise NoPlaceError("a notch is too thick")
            along = self.axes[:1] if axes is None or self.place is None else axes
            if self.form == "rod" and self.place is not None:
                along = np.cross(unit(end - start), normal)[None]
            middle = None if at is None or self.form == "rod" else at[None]
            made = rods_between(bare, one, other, along, width, self.form, middle)
        elif self.form == "folded sheet":
            assert at is not None and axes is not None
            loose = replace(place.sizes, length=(_LEAF * place.sizes.length[0], np.inf))
            made = folded_between(replace(bare, sizes=loose), one, at[None], other, axes[:1], width)
        elif self.form in ("sheet", "waisted sheet"):
            waist = None
            if self.form == "waisted sheet":
                assert at is not None
                waist = 0 if np.linalg.norm(at - start) < np.linalg.norm(at - end) else 1
            made = sheets_between(bare, one, other, across, width, self.form, waist)
        elif self.form == "bellows":
            made = bellows_between(bare, one, other, width)
        else:
            make = struts_between if self.form == "strut" else wires_between
            made = make(bare, one, other)
        if not len(made):
            raise NoPlaceError(f"no {self.form} can be where one would be")
        return made


def _null(rows: FloatArray) -> FloatArray:
    """Orthonormal rows of what is across rows of any rank, that follow from their space alone."""
    _, sizes, right = np.linalg.svd(rows)
    rank = int((sizes > 1.0e-9 * sizes.max(initial=0.0)).sum()) if sizes.size else 0
    rest = right[rank:]
    return canonical(rest) if len(rest) else rest


def _turned(turn: FloatArray, wrenches: FloatArray) -> FloatArray:
    """Wrenches (f, m) after a turn or a mirror."""
    rolled = np.roll(np.atleast_2d(wrenches), 3, axis=-1)
    made = np.roll(turned_screws(turn, rolled), 3, axis=-1)
    return made if wrenches.ndim > 1 else made[0]


# Regions ----------------------------------------------------------------------------------


def clamps_of(flexure: Candidates, diameter: float) -> tuple[FloatArray, FloatArray]:
    """(n, 3) points of each of the two clamped ends of one flexure, the middle first.

    Args:
        flexure: One.
        diameter: Of wires; not of consequence for others.
    """
    first, last = flexure.ends[0]
    if flexure.kind == "wire":
        return first[None], last[None]
    if flexure.kind in ("strut", "bellows"):
        (reach,) = np.moveaxis(round_ends(unit(last - first)[None], 2.0 * flexure.radius), 1, 0)
        edges = np.concatenate((np.zeros((1, 3)), reach, -reach))
        return first + edges, last + edges
    made = []
    for end, half in ((first, flexure.strips[0, 0, 2]), (last, flexure.strips[0, -1, 2])):
        edges = np.array((half, -half))
        if flexure.kind in ("notch", "rod"):
            deep = flexure.radius * flexure.normal[0]
            edges = np.concatenate((edges + deep, edges - deep))
        made.append(np.concatenate((end[None], end + edges)))
    return made[0], made[1]


def _beyond_box(points: FloatArray, box: Box) -> float:
    """How far the farthest of some points is outside of a box along an axis; negative inside."""
    if (box.high - box.low).max() <= TINY:
        # At a point the middle of the clamp is.
        points = points[:1]
    return float(np.maximum(box.low - points, points - box.high).max())


def beyond(flexure: Candidates, place: Place) -> float:
    """How far a clamped end of a flexure is outside of its regions; negative inside.

    Raises:
        NoPlaceError: it goes through one box of the ground to another one.
    """
    made = clamps_of(flexure, place.sizes.diameter)
    far = max(
        min((_beyond_box(points, box) for box in boxes), default=0.0)
        for points, boxes in zip(made, (place.here, place.there), strict=True)
    )
    first, last = flexure.ends[0]
    length = float(np.linalg.norm(last - first))
    way = (last - first) / length
    for box in place.there if flexure.kind in STRAIGHT else ():
        low, high = (float(v[0]) for v in cut(first[None], way[None], box.low, box.high))
        if low <= high and low > TINY and high < length - TINY:
            raise NoPlaceError("a flexure goes through one box of the ground to another one")
    return far


def lengths_of(flexure: Candidates) -> FloatArray:
    """The length of a flexure, or of both leaves of a folded one."""
    strips = flexure.strips[0]
    return np.asarray(np.linalg.norm(strips[:, 1] - strips[:, 0], axis=1))
