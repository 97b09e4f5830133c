# SPDX-License-Identifier: BSD-3-Clause
"""Hinges as notches: with the contour that a model gives, else of a size that fits the drawing.

A notch with a contour is the whole plate from end to end with both cuts. An ideal hinge is a
circular notch in line with its link, one that tilts, too, a round neck; two hinges at one point
are made one behind the other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import Class
from ...model.notches import CONTOURS
from ...model.parts.parts import Parts
from ...util.groups import grouped, groups_of
from ...util.records import Frozen
from ...util.rotations import frames_along, unit
from ..drawing import Drawing, Pose
from .shapes import Contour, Curve, Piece, Prism, circle

#: What is in line, in a plane or parallel within this part, is so.
_SAME = 1.0e-9
#: An ideal hinge: radius of its circles, its neck and its breadth, parts of the thickness of
#: bodies, which is taken as no more than a part of the shortest link.
_RADIUS, _NECK, _BREADTH, _OF_LINK = 0.5, 0.15, 1.8, 0.22
#: The part of a notch that bends where it is drawn so.
_NECK_PART = 0.2
#: So many names are told.
_MOST_NAMED = 4


def listed(names: Sequence[str], mark: str = ", ") -> str:
    """Names, of many a few."""
    if len(names) > _MOST_NAMED:
        names = [*names[: _MOST_NAMED - 1], f"{len(names) - _MOST_NAMED + 1} more"]
    last = " and " if mark == ", " else mark
    return f"{mark.join(names[:-1])}{last}{names[-1]}" if len(names) > 1 else names[0]


def notch_shape(
    kind: str, length: float, height: float, thickness: float, radius: float, blank: float
) -> tuple[Piece, ...]:
    """The contour of a notch in a plate, about its middle, x along it and y along its height.

    Args:
        kind: "circular", "fillet", "elliptic" or "parabolic".
        length: Of the notch [m].
        height: Of the plate [m].
        thickness: At the thinnest [m].
        radius: Of a circle or of fillets [m].
        blank: Length of the whole plate, at least that of the notch [m].
    """
    half, h, t = length / 2, height / 2, thickness / 2

    def below(sign: float) -> list[Piece]:
        """The cut from -x to x below, or with a sign of -1 from x to -x above."""
        a, y = sign * half, -sign * h
        neck = -sign * t
        if kind == "parabolic":
            return [Piece((-a, y), Curve.PARABOLA, (0.0, neck))]
        if kind == "elliptic":
            return [Piece((-a, y), Curve.ELLIPSE, (0.0, y), (half, h - t), False)]
        depth = min(h - t, radius)
        reach = math.sqrt(max(depth * (2.0 * radius - depth), 0.0))
        centre_y, low = neck - sign * radius, -sign * (t + depth)
        straight = 0.0 if kind == "circular" else half - reach
        walls = [Piece((-a, y))] if abs(y - low) > _SAME * h else []
        axes = (radius, radius)
        if straight <= _SAME * half:
            arcs = [Piece((-a, low), Curve.CIRCLE, (0.0, centre_y), axes, False)]
        else:
            s = sign * straight
            arcs = [
                Piece((-a, low), Curve.CIRCLE, (-s, centre_y), axes, False),
                Piece((-s, neck)),
                Piece((s, neck), Curve.CIRCLE, (s, centre_y), axes, False),
            ]
        return [*walls, *arcs, *([Piece((a, low))] if walls else [])]

    end = blank / 2
    beyond = end > half * (1.0 + _SAME)
    made: list[Piece] = []
    for sign in (1.0, -1.0):
        if beyond:
            made.append(Piece((-sign * end, -sign * h)))
        made += below(sign)
        made.append(Piece((sign * half, -sign * h)))
        if beyond:
            made.append(Piece((sign * end, -sign * h)))
    return tuple(made)


@dataclass(frozen=True, eq=False)
class Notch(Frozen):
    """A notch in a plate.

    Attributes:
        name: What it is called.
        place: (3,) its middle [m].
        frame: (3, 3) along it, along its height, and its axis.
        contour: About its middle.
        length: Of the plate [m].
        height: Of the plate [m].
        breadth: Of the plate [m].
        turns: Orientation nodes of its two sides.
        node: Its position node.
        round: Whether it is a round neck, whose contour is its section.
    """

    name: str
    place: FloatArray
    frame: FloatArray
    contour: Contour
    length: float
    height: float
    breadth: float
    turns: tuple[int, int]
    node: int
    round: bool = False

    def frame_at(self, end: int) -> FloatArray:
        """(3, 3) out of its end 0 or 1, and along its section."""
        return np.asarray(self.frame * (np.array((1.0, 1.0, 1.0)) if end else (-1.0, -1.0, 1.0)))

    def shape(self) -> Prism:
        """Its solid."""
        if self.round:
            start = self.place - self.frame[:, 0] * self.length / 2
            return Prism(self.contour, start, self.frame[:, [1, 2, 0]], self.length)
        return Prism(
            self.contour, self.place - self.frame[:, 2] * self.breadth / 2, self.frame, self.breadth
        )

    def points_at(self, drawing: Drawing, pose: Pose) -> FloatArray:
        """(n, 3) corners of its polyhedron in a pose, in which both sides turn with theirs [m].

        The neck lies between them.
        """
        points = self.shape().polyhedron().points
        x = (points - self.place) @ self.frame[:, 0]
        side = np.clip(0.5 + x / (_NECK_PART * self.length), 0.0, 1.0)[:, None]
        arm = points - drawing.reference.position[self.node]
        one, other = (arm @ pose.rotation[turn].T for turn in self.turns)
        return np.asarray(pose.position[self.node] + (1.0 - side) * one + side * other)


class Hinges:
    """The hinges of a model, in the making."""

    def __init__(self, drawing: Drawing, parts: Parts, thick: float) -> None:
        """Those of a drawing; `thick` is the thickness of bodies [m]."""
        self.drawing, self.data, self.parts, self.thick = drawing, drawing.data, parts, thick
        self.place = drawing.reference.position
        #: Orientation nodes that no member has.
        self.between = set(drawing.hinges.nodes[:, 1:].ravel().tolist()) - set(
            drawing.members.nodes[:, [1, 3]].ravel().tolist()
        )
        #: Elements that are halves of notches, and the position nodes between halves.
        self.halves: set[int] = set()
        self.middles: set[int] = set()
        self.notes: list[str] = []

    def notches(self) -> list[Notch]:
        """Hinges as notches: with their contour where the model has one."""
        hinges, members = self.drawing.hinges, self.drawing.members
        made: list[Notch] = []
        assumed, rows_of = [], self._series()
        for row in range(len(hinges)):
            node, *turns = hinges.nodes[row].tolist()
            name = self.parts.of_element(int(hinges.index[row])).name
            axis = hinges.frame[row, :, 0]
            given = self.data.appearance.dimensions[hinges.index[row]]
            sides = [
                np.flatnonzero(
                    members.stiff
                    & np.any(members.nodes[:, [0, 2]] == node, axis=1)
                    & np.any(members.nodes[:, [1, 3]] == turn, axis=1)
                )
                for turn in turns
            ]
            found = None
            if row in rows_of:
                continue
            if np.all(given > 0.0) and all(len(side) for side in sides):
                found = self._contour(row, name, node, turns, axis, given, sides)
            made.append(found or self._knuckle(row, name, node, (turns[0], turns[1])))
            if found is None:
                assumed.append(name)
        told: dict[bool, list[str]] = {True: [], False: []}
        for chain in dict.fromkeys(rows_of.values()):
            in_row = self._in_row(chain)
            made += in_row
            assumed += [each.name for each in in_row]
            names = [self.parts.of_element(int(hinges.index[row])).name for row in chain]
            told[bool(in_row)] += names
        for is_made, how in ((True, "made one behind the other"), (False, "not made")):
            if told[is_made]:
                self.notes.append(
                    f"Hinges that stand at one point, {how}: {listed(told[is_made])}."
                )
        if assumed:
            self.notes.append(
                f"{listed(assumed)}: no sizes are given; made as notches of a size that fits the "
                "drawing."
            )
        return made

    def _series(self) -> dict[int, tuple[int, ...]]:
        """Rows of hinges that stand at one point with no body between them, each with its row."""
        hinges = self.drawing.hinges
        members = set(self.drawing.members.nodes[:, [1, 3]].ravel().tolist())
        pairs = hinges.nodes[:, 1:].tolist()
        alone = {n for pair in pairs for n in pair if n not in members} - {
            n for pair in pairs for n in pair if self.parts.is_held(n)
        }
        shared = [
            (i, j)
            for i, one in enumerate(pairs)
            for j in range(i)
            if alone & set(one) & set(pairs[j])
        ]
        group = groups_of(len(pairs), shared).tolist()
        chains = grouped((each, row) for row, each in enumerate(group))
        nowhere = set(np.flatnonzero(hinges.nodes[:, 0] < 0).tolist())
        return {
            row: tuple(rows)
            for rows in chains.values()
            for row in rows
            if len(rows) > 1 or row in nowhere or alone & set(pairs[row])
        }

    def _in_row(self, chain: tuple[int, ...]) -> list[Notch]:
        """Two hinges at one point, one behind the other along what they join; of more none."""
        hinges = self.drawing.hinges
        if len(chain) != 2 or hinges.nodes[chain[0], 0] < 0:
            return []
        (node, a, b), (_, c, d) = hinges.nodes[list(chain)].tolist()
        middle = ({a, b} & {c, d}).pop()
        # From the one side over the middle to the other.
        outer, far = (a if b == middle else b), (c if d == middle else d)
        one, other = (
            self._knuckle(row, self.parts.of_element(int(hinges.index[row])).name, node, turns)
            for row, turns in zip(chain, ((outer, middle), (middle, far)), strict=True)
        )
        x = np.cross(one.frame[:, 2], other.frame[:, 2])
        if not np.linalg.norm(x) > 1.0e-6:
            return []
        x = unit(x)
        towards = self._way(node, (outer, far), one.frame[:, 2] * 0.0)
        if towards is not None and towards[0] @ x < 0.0:
            x = -x
        shift = (one.length / 2 + 0.4 * self.thick) * x
        made = []
        for each, sign in ((one, -1.0), (other, 1.0)):
            z = each.frame[:, 2]
            frame = np.stack((x, np.cross(z, x), z), axis=1)
            made.append(replace(each, frame=frame, place=each.place + sign * shift))
        return made

    def _contour(
        self,
        row: int,
        name: str,
        node: int,
        turns: list[int],
        axis: FloatArray,
        given: FloatArray,
        sides: Sequence[np.ndarray],
    ) -> Notch | None:
        """A notch as made: of its neck, its breadth and the radius of its root."""
        members, element = self.drawing.members, self.drawing.hinges.index[row]
        far = []
        for side in sides:
            slots = members.nodes[side[0], [0, 2]]
            far.append(int(slots[slots != node][0]))
        p, q = self.place[far[0]], self.place[far[1]]
        length, middle = float(np.linalg.norm(q - p)), (p + q) / 2
        x = unit(q - p)
        if not length > 0.0 or np.linalg.norm(middle - self.place[node]) > 1.0e-6 * length:
            return None
        z = axis - (axis @ x) * x
        if np.linalg.norm(z) < 0.999:
            return None
        z = unit(z)
        t, b = (float(size) for size in given)
        kind, height, long, radius = self.data.appearance.contour[element].tolist()
        if kind == kind:
            contour = notch_shape(CONTOURS[int(kind)], long, height, t, radius, length)
        else:
            # A deck tells the radius of the root: as of a circular contour.
            known = self.data.properties
            radius = np.nan if known is None else float(known.fillet[element, 0])
            if not radius > 0.0:
                return None
            half = min(radius, length / 2)
            height = t + 2.0 * (radius - np.sqrt(max(radius**2 - half**2, 0.0)))
            contour = notch_shape("circular", 2.0 * half, height, t, radius, length)
        self.halves.update(int(members.index[side[0]]) for side in sides)
        self.middles.add(node)
        frame = np.stack((x, np.cross(z, x), z), axis=1)
        turned = (turns[0], turns[1])
        return Notch(name, middle, frame, contour, length, height, b, turned, node)

    def _way(
        self, node: int, turns: tuple[int, int], axis: FloatArray
    ) -> tuple[FloatArray, float] | None:
        """(3,) from the one side of a hinge to the other, across its axis; size of that link [m].

        In line with the shorter of the two links; None where neither tells.
        """
        found: list[tuple[float, int, FloatArray, float]] = []
        for sign, turn in ((-1.0, turns[0]), (1.0, turns[1])):
            body = self.parts.body_at.get(turn)
            if body is None:
                continue
            places = self.place[list(self.parts.bodies[body].positions)]
            arm = sign * (places - self.place[node]).mean(axis=0)
            arm = arm - (arm @ axis) * axis
            if np.linalg.norm(arm) > 1.0e-6 * self.drawing.size:
                size = float(np.linalg.norm(np.ptp(places, axis=0)))
                found.append((round(size / self.drawing.size, 6), len(found), unit(arm), size))
        if not found:
            return None
        _, _, way, size = min(found, key=lambda each: each[:2])
        return way, size

    def _knuckle(self, row: int, name: str, node: int, turns: tuple[int, int]) -> Notch:
        """An ideal hinge as a notch; where it tilts, too, as a round neck."""
        element, place = self.drawing.hinges.index[row], self.place[node]
        tilts = self.data.arrays.deformation_class[1:3, element]
        is_round = bool(np.isin(tilts, (Class.DEPENDENT, Class.INDEPENDENT)).any())
        axis = self.drawing.hinges.frame[row, :, 0]
        x, scale = frames_along(axis[None])[0][:, 1], self.thick
        # A neck is in line with its link, whichever axis its hinge has.
        if (way := self._way(node, turns, axis * (not is_round))) is not None:
            x, scale = way[0], min(scale, _OF_LINK * way[1])
        radius, t = _RADIUS * scale, _NECK * scale
        if is_round:
            frame = frames_along(x[None])[0]
            return Notch(
                *(name, place, frame, circle(t), 2 * radius, t, t, turns, node), round=True
            )
        frame = np.stack((x, np.cross(axis, x), axis), axis=1)
        height = t + 2 * radius
        contour = notch_shape("circular", 2 * radius, height, t, radius, 2 * radius)
        return Notch(
            *(name, place, frame, contour, 2 * radius, height, _BREADTH * scale, turns, node)
        )
