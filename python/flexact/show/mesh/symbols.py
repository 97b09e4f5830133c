# SPDX-License-Identifier: BSD-3-Clause
"""Supports and declared degrees of freedom as surfaces of quads, each at its node."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import FloatArray
from ...util.records import Frozen
from ..drawing import Drawing, Form, Pose, Support
from ..drawing.rotations import frames_along

Integers = NDArray[np.int64]

#: `form` of a support is this and its `Support`; behind them a declared translation, and rotation.
SUPPORT = max(Form)
TRANSLATION = SUPPORT + max(Support) + 1
ROTATION = TRANSLATION + 1

_ROUND = 12
#: What stands for a point, so that all faces are quads: a part of the size.
_TIP = 0.02
#: Thickness of the plate below a pyramid, a part of a support's size.
_PLATE = 0.28
#: Rings of a symbol: place along its axis and radius, parts of its size.
_PYRAMID = ((-1.0, 0.75), (0.0, _TIP))
_CONE = ((-1.1, 0.45), (0.0, _TIP))
_CONES = ((-0.7, 0.4), (0.0, _TIP), (0.7, 0.4))
#: Of arrows, parts of the drawing's size: length, and where the head begins; radii.
_LENGTH, _HEAD, _SHAFT, _WIDE = 0.13, 0.095, 0.004, 0.012
_ARROW = ((0.0, _SHAFT), (_HEAD, _SHAFT), (_HEAD, _WIDE), (_LENGTH, _SHAFT * _TIP))
#: A turning arrow: radius of its circle, and angles [rad] where it begins, has its head, and ends.
_CIRCLE, _ANGLES = 0.055, (0.0, 3.9, 4.7)
_BENDS = 20


@dataclass(frozen=True, eq=False)
class Symbols(Frozen):
    """Symbols of what is declared of nodes.

    Attributes:
        points: (n, 3) in the reference configuration [m].
        node: (n,) index of the position node that a point goes with.
        quads: (k, 4) points.
        owner: (k,) number of the symbol of each quad.
        form: (k,) what it is: see `SUPPORT`, `TRANSLATION` and `ROTATION`.
        node_of: (symbols,) index of the position node of each symbol.
    """

    points: FloatArray
    node: Integers
    quads: Integers
    owner: Integers
    form: Integers
    node_of: Integers

    def points_in(self, pose: Pose, reference: Pose) -> FloatArray:
        """(n, 3) where the points are in a pose [m]: symbols go with their nodes."""
        moved: FloatArray = pose.position[self.node] - reference.position[self.node]
        return self.points + moved

    def in_words(self, node_names: Sequence[str]) -> list[str]:
        """What each symbol is called."""
        forms = np.zeros(len(self.node_of), np.int64)
        forms[self.owner] = self.form
        pairs = zip(forms.tolist(), self.node_of.tolist(), strict=True)
        return [f"{_WORDS[form]} {node_names[node]}" for form, node in pairs]


_WORDS = {
    SUPPORT + Support.CLAMP: "clamp at",
    SUPPORT + Support.PIN: "pin at",
    SUPPORT + Support.SLIDE: "fixed translation of",
    SUPPORT + Support.TURN: "fixed rotation of",
    TRANSLATION: "declared translation of",
    ROTATION: "declared rotation of",
}


@dataclass(frozen=True, eq=False)
class _Tube(Frozen):
    """Rings (r, c, 3) about an axis, closed at both ends."""

    rings: FloatArray

    @property
    def quads(self) -> Integers:
        """(k, 4) corners of its faces, seen from outside against the clock."""
        r, c, _ = self.rings.shape
        corner = np.arange(c)
        side = np.stack((corner, (corner + 1) % c, (corner + 1) % c + c, corner + c), axis=-1)
        sides = (side + c * np.arange(r - 1)[:, None, None]).reshape(-1, 4)
        fan = np.arange(1, c // 2)
        end = np.stack((fan - 1, fan, c - 1 - fan, c - fan), axis=-1)
        return np.concatenate((sides, end[:, ::-1], end + c * (r - 1)))


def symbols_of(drawing: Drawing) -> Symbols:
    """The symbols of a drawing."""
    made = [*_supports(drawing), *_arrows(drawing)]
    points, quads, behind = [np.zeros((0, 3))], [np.zeros((0, 4), np.int64)], 0
    nodes, owners, forms = [], [], []
    for number, (node, form, tube) in enumerate(made):
        corners = tube.rings.reshape(-1, 3)
        points.append(corners)
        quads.append(behind + tube.quads)
        behind += len(corners)
        nodes += [node] * len(corners)
        owners += [number] * len(tube.quads)
        forms += [form] * len(tube.quads)
    return Symbols(
        np.concatenate(points),
        np.array(nodes, np.int64),
        np.concatenate(quads),
        np.array(owners, np.int64),
        np.array(forms, np.int64),
        np.array([node for node, _, _ in made], np.int64),
    )


def _supports(drawing: Drawing) -> Iterator[tuple[int, int, _Tube]]:
    supports = drawing.supports
    for row in range(len(supports)):
        node, kind = int(supports.node[row]), Support(int(supports.kind[row]))
        place = drawing.reference.position[node] + supports.offset[row]
        frame = supports.frame[row]
        size, half = float(supports.size[row]), supports.extent[row]
        form = SUPPORT + kind
        if kind is Support.CLAMP:
            yield node, form, _block(place, frame, half, float(supports.depth[row]))
        elif kind is Support.PIN:
            yield node, form, _turned(place, frame, _PYRAMID, size, 4)
            ground = place - size * frame[:, 0]
            yield node, form, _block(ground, frame, np.full(2, 0.85 * size), _PLATE * size)
        else:
            rings = _CONE if kind is Support.SLIDE else _CONES
            yield node, form, _turned(place, frame, rings, size, _ROUND)


def _arrows(drawing: Drawing) -> Iterator[tuple[int, int, _Tube]]:
    arrows = drawing.arrows
    frames = frames_along(arrows.direction)
    for row in range(len(arrows)):
        node = int(arrows.node[row])
        place = drawing.reference.position[node]
        if arrows.turning[row]:
            yield node, ROTATION, _bent(place, frames[row], drawing.size)
        else:
            yield node, TRANSLATION, _turned(place, frames[row], _ARROW, drawing.size, _ROUND)


def _block(place: FloatArray, frame: FloatArray, half: FloatArray, thick: float) -> _Tube:
    """A block of ground whose upper face lies at the place."""
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
    upper = place + corner @ frame[:, 1:].T
    return _Tube(np.stack((upper - thick * frame[:, 0], upper)))


def _turned(
    place: FloatArray,
    frame: FloatArray,
    rings: tuple[tuple[float, float], ...],
    size: float,
    corners: int,
) -> _Tube:
    """Rings about ex of a frame."""
    angle = 2 * np.pi * (np.arange(corners) + 0.5 * (corners == 4)) / corners
    circle = np.cos(angle)[:, None] * frame[:, 1] + np.sin(angle)[:, None] * frame[:, 2]
    return _Tube(np.stack([place + size * (x * frame[:, 0] + r * circle) for x, r in rings]))


def _bent(place: FloatArray, frame: FloatArray, size: float) -> _Tube:
    """An arrow round ex of a frame."""
    start, head, end = _ANGLES
    along = np.linspace(start, head, _BENDS)
    angle = np.concatenate((along, [head, end]))
    radius = np.concatenate((np.full(_BENDS, _SHAFT), [_WIDE, _SHAFT * _TIP])) * size
    outwards = np.cos(angle)[:, None] * frame[:, 1] + np.sin(angle)[:, None] * frame[:, 2]
    corner = 2 * np.pi * np.arange(_ROUND) / _ROUND
    # Against the clock about the way that it goes.
    across = np.cos(corner)[:, None] * outwards[:, None] - np.sin(corner)[:, None] * frame[:, 0]
    middle = place + _CIRCLE * size * outwards
    return _Tube(middle[:, None] + radius[:, None, None] * across)


NO_SYMBOLS = Symbols(
    np.zeros((0, 3)),
    np.zeros(0, np.int64),
    np.zeros((0, 4), np.int64),
    *(np.zeros(0, np.int64) for _ in range(3)),
)
