# SPDX-License-Identifier: BSD-3-Clause
"""Arrows: what a motion moves or turns, and declared degrees of freedom; always in front."""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ...util.rotations import frames_along, matrix_of, unit, vector_of
from ..drawing import Drawing, Pose, reach_of
from ..drawing.members import ARROW, CONSTRAINT_SPACE, FREEDOM, FREEDOM_SPACE, NEW_WIRE, PRESS
from ..drawing.presses import SECOND, Press, way_out
from ..spaces import SpaceShown, dashes
from .canvas import OVER, Canvas

#: Displacements below this part of the largest get no arrow, and no more than so many get one.
_LEAST, _MOST = 0.3, 28
#: Arrows whose nodes are nearer than this part of the drawing's size are one.
_APART = 0.06
#: A motion that displaces nothing by more than this part of the drawing's size has turning arrows,
#: no more than so many, no nearer to each other than this part.
_STILL, _MOST_TURNING, _TURNING_APART = 0.02, 4, 0.15
#: Less than this part of a whole turning arrow is not drawn.
_LEAST_TURNING = 0.15
#: The least width of a circle that is seen, a part of its height.
_OPEN = 0.4
#: Lengths of arrows of freedoms, and radius of turning ones: parts of the drawing's size.
_LENGTH, _RADIUS = 0.13, 0.055
#: Length and width of a head: parts of the drawing's size, and at most of the arrow's length.
_HEAD, _HEAD_PART = (0.03, 0.02), 0.5
_WIDTH = 1.9
_CASE = (1.0, 1.0, 1.0)
#: Freedoms beyond so many are not drawn.
_MOST_FREEDOMS = 60


def add_displacements(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
    """Arrows from where nodes were to where they are, of the largest displacements."""
    shown = np.unique(drawing.members.nodes[:, [0, 2]])
    start, end = drawing.reference.position[shown], pose.position[shown]
    length = np.linalg.norm(end - start, axis=1)
    chosen = _apart(start, _by_size(length, drawing.size), _APART * drawing.size, _MOST)
    add_straight(canvas, start[chosen], end[chosen], ARROW, drawing.size)


def add_rotations(canvas: Canvas, drawing: Drawing, pose: Pose, end: Pose) -> None:
    """Turning arrows at the largest rotations of a motion that displaces hardly anything.

    Args:
        canvas: Where to.
        drawing: The drawing.
        pose: Where the nodes are.
        end: Where they are at the end of the motion; arrows are whole there.
    """
    if reach_of(drawing, [end])[0] >= _STILL * drawing.size:
        return
    # Position nodes and orientation nodes there, of members and of hinges.
    members, hinges = drawing.members.nodes, drawing.hinges.nodes
    pairs = (members[:, :2], members[:, 2:], hinges[:, [0, 1]], hinges[:, [0, 2]])
    every = np.unique(np.concatenate(pairs), axis=0)
    node, turn = every[np.all(every >= 0, axis=1)].T
    farthest = np.linalg.norm(vector_of(end.rotation[turn]), axis=1)
    order = _by_size(farthest, 1.0)
    place = drawing.reference.position[node]
    rotation = vector_of(pose.rotation[turn])
    for row in _apart(place, order, _TURNING_APART * drawing.size, _MOST_TURNING):
        share = float(np.linalg.norm(rotation[row]) / farthest[row])
        if share > _LEAST_TURNING:
            axis = unit(rotation[row])
            _add_turning(canvas, place[row], axis, drawing.size, ARROW, share)


def add_freedoms(canvas: Canvas, drawing: Drawing) -> None:
    """Arrows of the declared degrees of freedom, straight or turning."""
    node, direction, turning = drawing.arrows
    if len(node) > _MOST_FREEDOMS:
        return
    place = drawing.reference.position[node]
    start = place[~turning]
    # From the surface of the body.
    for row, k in enumerate(np.flatnonzero(~turning).tolist()):
        start[row] += way_out(drawing, int(node[k]), direction[k]) * direction[k]
    end = start + _LENGTH * drawing.size * direction[~turning]
    add_straight(canvas, start, end, FREEDOM, drawing.size)
    for row in np.flatnonzero(turning).tolist():
        _add_turning(canvas, place[row], direction[row], drawing.size, FREEDOM)


def add_presses(canvas: Canvas, drawing: Drawing, presses: tuple[Press, ...]) -> None:
    """Arrows of what parts press on bodies; of moments with two heads."""
    for heads, chosen in (
        ((1.0,), [each for each in presses if not each.is_moment]),
        ((1.0, SECOND), [each for each in presses if each.is_moment]),
    ):
        if chosen:
            start, end = (np.array([each[k] for each in chosen]) for k in (-2, -1))
            for part in heads:
                add_straight(canvas, start, start + part * (end - start), PRESS, drawing.size)


def _by_size(sizes: FloatArray, unit_size: float) -> np.ndarray:
    """Rows of the largest sizes (n,), these first; what rounding tells apart is equal."""
    order = np.argsort(-np.round(sizes / unit_size, 9), kind="stable")
    return np.asarray(order[sizes[order] > _LEAST * sizes.max(initial=0.0)])


def _apart(place: FloatArray, order: np.ndarray, apart: float, most: int) -> list[int]:
    """The first rows in an order whose places (n, 3) are not too near to each other."""
    chosen: list[int] = []
    for row in order.tolist():
        gap = np.linalg.norm(place[chosen] - place[row], axis=1)
        if gap.min(initial=np.inf) > apart:
            chosen.append(row)
        if len(chosen) == most:
            break
    return chosen


def add_straight(
    canvas: Canvas,
    start: FloatArray,
    end: FloatArray,
    colour: tuple[float, float, float],
    size: float,
) -> None:
    """Straight arrows, their heads in the plane of the picture."""
    way = end - start
    towards = canvas.view.axes[2]
    flat = way - (way @ towards)[:, None] * towards
    length = np.linalg.norm(flat, axis=1)
    able = length > 1.0e-3 * size
    start, end, flat, length = start[able], end[able], flat[able], length[able]
    head = np.minimum(_HEAD[0] * size, _HEAD_PART * length)
    along = unit(flat)
    # The shaft ends where the head begins; in the picture, whatever its depth.
    neck = end - (0.85 * head)[:, None] * along
    shaft = np.stack((start, neck), axis=1)
    _add(canvas, shaft, end, along, head, colour, size)


def _add_turning(
    canvas: Canvas,
    place: FloatArray,
    axis: FloatArray,
    size: float,
    colour: tuple[float, float, float],
    share: float = 1.0,
) -> None:
    """A share of three quarters of a circle about an axis, with a head.

    It is turned to the eye so far that it is seen as an arc and not as a stroke.
    """
    towards = canvas.view.axes[2]
    facing = float(axis @ towards)
    if abs(facing) < _OPEN:
        # The nearest axis about which a circle is seen wide enough.
        sense = -1.0 if facing < 0.0 else 1.0
        flat = unit(axis - facing * towards)
        axis = np.sqrt(1.0 - _OPEN**2) * flat + sense * _OPEN * towards
    frame = frames_along(axis[None])[0]
    radius = _RADIUS * size
    angle = np.linspace(0.0, 1.5 * np.pi * min(share, 1.0), 28)
    circle = place + radius * (matrix_of(angle[:, None] * axis) @ frame[:, 1])
    head = 0.8 * _HEAD[0] * size
    along = circle[-1] - circle[-2]
    flat = unit(along - (along @ towards) * towards)
    tip = circle[-1] + 0.7 * head * flat
    _add(canvas, circle[None], tip[None], flat[None], np.array([head]), colour, size)


def _add(
    canvas: Canvas,
    shafts: FloatArray,
    tip: FloatArray,
    along: FloatArray,
    head: FloatArray,
    colour: tuple[float, float, float],
    size: float,
) -> None:
    """Shafts (n, c, 3), and heads of lengths (n,) that end at tips (n, 3) along directions."""
    wing = np.cross(canvas.view.axes[2], along) * (head * _HEAD[1] / _HEAD[0] / 2)[:, None]
    back = tip - head[:, None] * along
    heads = np.stack((tip, back + wing, back - wing), axis=1)
    given, case = np.array(colour), np.array(_CASE)
    canvas.lines(shafts, case, _WIDTH + 1.6, layer=OVER)
    canvas.polygons(heads, case, edge=case, width=1.6, layer=OVER)
    above = 10 * size  # over the cases of all
    canvas.lines(shafts, given, _WIDTH, layer=OVER, nearer=above)
    canvas.polygons(heads, given, edge=given, width=0.4, layer=OVER, nearer=above)


#: Of lines [pt]; and of faces, whose edges are as wide as this.
_BOLD, _SPACES_WIDTH, _THIN, _EDGE, _DASH = 2.6, 1.5, 0.8, 0.7, 2.6
_OPACITY = 0.16


def add_space(canvas: Canvas, drawing: Drawing, shown: SpaceShown) -> None:
    """Draw a space over the mechanism."""
    shape = shown.shape
    colour = np.array(FREEDOM_SPACE if shape.is_freedom else CONSTRAINT_SPACE)
    for face in shape.faces:
        canvas.polygons(face[None], colour, opacity=_OPACITY)
        canvas.lines(np.concatenate((face, face[:1]))[None], colour, _EDGE)
    for line in shape.lines:
        canvas.lines(line[None], colour, _BOLD if shape.is_bold else _SPACES_WIDTH)
        if shown.labels:
            # What a wire holds lies within it.
            canvas.lines(line[None], colour, _THIN, layer=OVER)
    if shape.arrows:
        ends = np.array(shape.arrows)
        # A couple has two heads.
        for part in (1.0,) if shape.is_freedom else (1.0, SECOND):
            tips = ends[:, 0] + part * (ends[:, 1] - ends[:, 0])
            add_straight(canvas, ends[:, 0], tips, tuple(colour.tolist()), drawing.size)
    if len(shown.wires):
        canvas.lines(
            dashes(shown.wires, drawing.size),
            np.array(NEW_WIRE),
            _DASH,
            layer=OVER,
            nearer=20 * drawing.size,
        )
