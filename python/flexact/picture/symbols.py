"""Supports, hinges and pin joints of spatial scenes, as solids."""

from __future__ import annotations

import numpy as np

from ..exchange import FloatArray
from ..scene import Pose, Scene, Support
from ..scene.colours import SUPPORT
from ..scene.rotations import matrix_of
from .drawing import Drawing
from .surfaces import OUTLINE, OUTLINE_WIDTH, Grid, add_grid
from .visible import visible_joints

_ROUND = 20
_GROUND = (0.72, 0.73, 0.74)
_HATCH = (0.36, 0.38, 0.41)
#: So many radii before its middle a ball hides the bars that end in it.
_BEFORE = 4.0
#: Thickness of a block of ground, a part of a support's size.
_THICK = 0.6


def add_supports(drawing: Drawing, scene: Scene, pose: Pose, finest: float) -> None:
    """Draw the supports; those that let a node slide go with it."""
    supports = scene.supports
    place = pose.position[supports.node]
    for row in range(len(supports)):
        kind, size = supports.kind[row], float(supports.size[row])
        frame, half = supports.frame[row], supports.extent[row]
        if kind == Support.CLAMP:
            _add_box(drawing, place[row], frame, (half[0], half[1]), _THICK * size)
        elif kind == Support.PIN:
            _add_pin(drawing, place[row], frame, size, finest)
        elif kind == Support.SLIDE:
            _add_turned(drawing, place[row], frame, ((-1.1, 0.45), (0.0, 0.0)), size, finest)
        else:
            rings = ((-0.7, 0.4), (0.0, 0.0), (0.7, 0.4))
            _add_turned(drawing, place[row], frame, rings, size, finest)


def add_hinges(
    drawing: Drawing, scene: Scene, pose: Pose, finest: float, colour: FloatArray | None = None
) -> None:
    """Draw the hinges of which it is known where they stand, as cylinders about their axes."""
    hinges = scene.hinges
    colours = hinges.colour if colour is None else colour
    for row in np.flatnonzero((hinges.nodes[:, 0] >= 0) & (hinges.opacity > 0.0)).tolist():
        node, turn = hinges.nodes[row, :2]
        frame = pose.rotation[turn] @ hinges.frame[row]
        length, diameter = hinges.size[row]
        points = _rings(
            pose.position[node],
            frame,
            ((-length / 2, diameter / 2), (length / 2, diameter / 2)),
            _ROUND,
        )
        grid = Grid(points, colours[row][None, None], hinges.opacity[row][None], _edge())
        add_grid(drawing, grid, finest=finest)


def add_joints(drawing: Drawing, scene: Scene, pose: Pose) -> None:
    """Draw balls where bars meet that turn freely about their ends."""
    node, radius = visible_joints(scene)
    angle = 2 * np.pi * np.arange(_ROUND) / _ROUND
    right, up, _ = drawing.view.axes
    disc = np.cos(angle)[:, None] * right + np.sin(angle)[:, None] * up
    place = pose.position[node]
    before = _before(scene, node, radius, drawing.view.axes[2])
    for scale, shift, colour in ((1.0, 0.0, (0.55, 0.58, 0.62)), (0.55, 0.3, (0.75, 0.78, 0.81))):
        middle = place + (radius * shift)[:, None] * (0.5 * up - 0.5 * right)
        ring = middle[:, None] + (scale * radius)[:, None, None] * disc
        nearer = before + (scale < 1.0) * 0.01 * radius
        if scale == 1.0:
            drawing.polygons(
                ring, np.array(colour), edge=np.array(OUTLINE), width=OUTLINE_WIDTH, nearer=nearer
            )
        else:
            drawing.polygons(ring, np.array(colour), nearer=nearer)


def _before(scene: Scene, node: np.ndarray, radius: FloatArray, towards: FloatArray) -> FloatArray:
    """(j,) how much nearer to the eye balls count [m]; not through a block seen from behind."""
    supports = scene.supports
    clamped = supports.kind == Support.CLAMP
    least = np.full(len(scene.reference.position), np.inf)
    facing = supports.direction[clamped] @ towards
    behind = np.where(facing < 0.0, -facing * _THICK * supports.size[clamped] / 2, np.inf)
    np.minimum.at(least, supports.node[clamped], behind)
    return np.asarray(np.minimum(_BEFORE * radius, least[node]))


def _edge() -> FloatArray:
    return np.array([OUTLINE])


def _rings(
    place: FloatArray, frame: FloatArray, rings: tuple[tuple[float, float], ...], corners: int
) -> FloatArray:
    """(1, s, c, 3) rings about ex of a frame: place along it and radius of each [m]."""
    angle = 2 * np.pi * (np.arange(corners) + 0.5 * (corners == 4)) / corners
    circle = np.cos(angle)[:, None] * frame[:, 1] + np.sin(angle)[:, None] * frame[:, 2]
    made = [place + along * frame[:, 0] + radius * circle for along, radius in rings]
    return np.stack(made)[None]


def _add_turned(
    drawing: Drawing,
    place: FloatArray,
    frame: FloatArray,
    rings: tuple[tuple[float, float], ...],
    size: float,
    finest: float,
    corners: int = _ROUND,
) -> None:
    scaled = tuple((size * along, size * radius) for along, radius in rings)
    points = _rings(place, frame, scaled, corners)
    grid = Grid(points, np.array([[SUPPORT]]) * 1.35, np.ones(1), _edge())
    add_grid(drawing, grid, finest=finest)


def _add_pin(
    drawing: Drawing, place: FloatArray, frame: FloatArray, size: float, finest: float
) -> None:
    """A pyramid on a plate of ground."""
    _add_turned(drawing, place, frame, ((-1.0, 0.75), (0.0, 0.0)), size, finest, corners=4)
    half = 0.85 * size
    _add_box(drawing, place - size * frame[:, 0], frame, (half, half), 0.28 * size)


def _add_box(
    drawing: Drawing,
    place: FloatArray,
    frame: FloatArray,
    half: tuple[float, float],
    thick: float,
) -> None:
    """A block of ground whose upper face lies at the place; its sides are hatched."""
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.array(half)
    upper = place + corner @ frame[:, 1:].T
    points = np.stack((upper - thick * frame[:, 0], upper))[None]
    grid = Grid(points, np.array([[_GROUND]]), np.ones(1), _edge())
    add_grid(drawing, grid, finest=thick)
    towards = drawing.view.axes[2]
    for side in range(4):
        first, last = points[0, :, side], points[0, :, (side + 1) % 4]
        normal = np.cross(last[0] - first[0], frame[:, 0])
        if normal @ towards > 0.0:
            _add_hatch(drawing, first, last, thick)


def _add_hatch(drawing: Drawing, first: FloatArray, last: FloatArray, thick: float) -> None:
    """Slanting lines over a side: `first` and `last` are its edges, from below to above."""
    length = float(np.linalg.norm(last[0] - first[0]))
    count = max(2, min(14, round(length / (0.55 * thick))))
    pitch = 1.0 / count
    lean = min(thick / length, 1.0) if length > 0.0 else 1.0
    lines = []
    for start in np.arange(-lean + pitch / 2, 1.0, pitch).tolist():
        # From (start, 0) to (start + lean, 1), cut at the edges.
        low, high = max(0.0, -start / lean), min(1.0, (1.0 - start) / lean)
        if high - low > 0.05:
            ends = [(start + share * lean, share) for share in (low, high)]
            lines.append([_on(first, last, u, v) for u, v in ends])
    drawing.lines(np.array(lines), np.array(_HATCH), 0.5)


def _on(first: FloatArray, last: FloatArray, u: float, v: float) -> FloatArray:
    lower, upper = (edge[0] + v * (edge[1] - edge[0]) for edge in (first, last))
    return np.asarray(lower + u * (upper - lower))


def turn_about(axis: FloatArray, angle: FloatArray) -> FloatArray:
    """(n, 3, 3) rotations about a unit vector by angles (n,) [rad]."""
    return matrix_of(angle[:, None] * axis)
