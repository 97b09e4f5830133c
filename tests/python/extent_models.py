# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms of which it is known whether their motions go on; each names its source."""

import math
from collections.abc import Iterable, Sequence

import numpy as np

from flexact import Model


def bars(
    places: Sequence[Sequence[float]],
    pairs: Iterable[tuple[int, int]],
    fixed: Iterable[int],
    planar: bool = False,
) -> Model:
    """Bars between places, some of which are fixed."""
    model = Model(planar=planar)
    nodes = [model.node(*place) for place in places]
    for p, q in pairs:
        model.truss(nodes[p], nodes[q])
    for index in fixed:
        model.fix(nodes[index])
    return model


def free_bars(
    places: np.ndarray, pairs: Iterable[tuple[int, int]], corner: tuple[int, int, int] | None
) -> Model:
    """Bars whose rigid motions are stopped at three joints, if at all: six coordinates."""
    if corner is None:
        return bars(places.tolist(), pairs, ())
    a, b, c = (places[k] for k in corner)
    ex = (b - a) / np.linalg.norm(b - a)
    ez = np.cross(ex, c - a)
    ez /= np.linalg.norm(ez)
    turned = (places - a) @ np.stack([ex, np.cross(ez, ex), ez], axis=1)
    model = Model()
    nodes = [model.node(*place) for place in turned.tolist()]
    for p, q in pairs:
        model.truss(nodes[p], nodes[q])
    for k, axes in zip(corner, ("xyz", "yz", "z"), strict=True):
        for axis in axes:
            model.fix(nodes[k], axis)
    return model


def jessen(supported: bool = True) -> Model:
    """Jessen's orthogonal icosahedron: infinitesimally flexible, rigid (Jessen 1967).

    24 edges of length root 6 and 6 of length 4; as cables and struts it is the expanded
    octahedron, which is prestress stable (Connelly and Whiteley 1996).
    """
    places = []
    for s in (1, -1):
        for t in (1, -1):
            places += [(2 * s, t, 0), (0, 2 * s, t), (t, 0, 2 * s)]
    return _by_lengths(
        np.array(places, float), (math.sqrt(6.0), 4.0), (0, 1, 2) if supported else None
    )


def regular_octahedron() -> Model:
    """Rigid, also to first order (Cauchy, Dehn): no motion."""
    places = np.concatenate([np.eye(3), -np.eye(3)])
    return _by_lengths(places, (math.sqrt(2.0),), (0, 1, 2))


def _by_lengths(
    places: np.ndarray, lengths: tuple[float, ...], corner: tuple[int, int, int] | None
) -> Model:
    apart = np.linalg.norm(places[:, None] - places, axis=2)
    pairs = [
        (p, q)
        for p in range(len(places))
        for q in range(p + 1, len(places))
        if any(abs(apart[p, q] - length) < 1.0e-9 for length in lengths)
    ]
    return free_bars(places, pairs, corner)


def bricard_octahedron() -> Model:
    """Line-symmetric octahedron: it flexes (Bricard 1897, first kind)."""
    half = np.array([[1.0, 0.2, 0.1], [-0.3, 0.9, 0.6], [0.4, 0.5, -0.8]])
    places = np.concatenate([half, half * (-1.0, -1.0, 1.0)])
    pairs = [(p, q) for p in range(6) for q in range(p + 1, 6) if q != p + 3]
    return free_bars(places, pairs, (0, 1, 2))


def dixon_of_eight() -> Model:
    """K4,4 on two rectangles with the same axes of symmetry: it moves (Dixon 1899, second)."""
    corners = [(s * x, t * y) for x, y in ((2, 1), (1.3, 2.4)) for s in (1, -1) for t in (1, -1)]
    model = Model(planar=True)
    nodes = [model.node(*place) for place in corners]
    for p in nodes[:4]:
        for q in nodes[4:]:
            model.truss(p, q)
    # The motion keeps the axes; what is rigid is stopped at two joints.
    model.fix(nodes[0])
    model.fix(nodes[4], "y")
    return model


def inner_tangent(first: float, second: float) -> Model:
    """A joint on two bars in a line, both on one side: circles that touch from inside."""
    return bars([(0, 0), (first, 0), (first - second, 0)], [(0, 1), (2, 1)], (0, 2), planar=True)


def double_watt() -> Model:
    """Two Watt linkages whose middles a bar joins: they stand in a cusp of the motion.

    Connelly and Servatius, Discrete Comput. Geom. 11, 1994: a mechanism without velocity at
    the start, though its positions are a curve.
    """
    model = Model(planar=True)
    middles = []
    for side in (1.0, -1.0):
        far = 0.0 if side > 0.0 else 3.0
        lower, upper = model.node(far - side, -0.5), model.node(far + side, 0.5)
        a, b = model.node(far, -0.5), model.node(far, 0.5)
        middle = model.node(far, 0.0)
        model.truss(lower, a)
        model.truss(upper, b)
        model.rigid(a, middle)
        model.rigid(middle, b)
        model.fix(lower)
        model.fix(upper)
        middles.append(middle)
    model.truss(*middles)
    return model


def platform_on_equal_legs(angles: Sequence[float], radii: Sequence[float]) -> Model:
    """Six parallel legs of one length between two congruent hexagons (Borel and Bricard).

    It goes on to both sides, as legs that stay parallel; and where the hexagons are on circles
    it turns about their axis.
    """
    model = Model()
    ends = []
    for angle, radius in zip(np.radians(angles).tolist(), radii, strict=True):
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        foot, end = model.node(x, y, 0), model.node(x, y, 1)
        model.fix(foot)
        model.truss(foot, end)
        ends.append((x, y, 1.0))
    model.body(ends, name="platform")
    return model


def loop(axes: Sequence[Sequence[float]], places: Sequence[Sequence[float]]) -> Model:
    """Rigid bodies in a closed loop, the ground among them, with a hinge at each place."""
    model = Model()
    joints = [model.node(*place) for place in places]
    model.fix(joints[0])
    behind = model.hinge(joints[0], tuple(axes[0]))
    for joint, axis in zip(joints[1:], axes[1:], strict=True):
        model.rigid(behind, joint)
        behind = model.hinge(joint, tuple(axis))
    model.fix(behind)
    return model


def spherical_loop(degrees: Sequence[float]) -> Model:
    """Hinges in a plane through one point: a flat vertex of an origami."""
    axes = [(math.cos(a), math.sin(a), 0.0) for a in np.radians(degrees).tolist()]
    return loop(axes, axes)


def loop_across_a_line() -> Model:
    """Six hinges whose axes meet the z axis: it alone is reciprocal to all of them."""
    axes = np.array(
        [
            *([0.5, 0.3, 0.8], [-0.6, 0.7, 0.2], [0.1, -0.9, 0.4]),
            *([0.8, 0.5, -0.3], [0.2, 0.6, 0.7], [-0.4, 0.3, 0.9]),
        ]
    )
    heights = np.array([0.0, 0.5, -0.7, 1.1, -0.3, 0.8])
    far = np.array([1.0, 1.3, 0.8, 1.1, 0.9, 1.2])
    places = heights[:, None] * (0.0, 0.0, 1.0) + far[:, None] * axes
    return loop(axes.tolist(), places.tolist())


def orthogonal_bricard() -> Model:
    """Six hinges, each at right angles to the next, on the edges of a cube (Bricard 1927)."""
    places = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1), (0, 0, 1)]
    # Each link is the common normal of its axes, so that the axes are across two edges.
    ways = np.diff(np.array([*places, places[0]]), axis=0)
    axes = [np.cross(ways[k - 1], ways[k]) for k in range(6)]
    return loop([axis.tolist() for axis in axes], places)


def third_order(height: float) -> Model:
    """The planar pair of third order, its last joint fixed at some height.

    C turns about A(0, 0) at radius 1 and about D(0, height): after a share t the circles are
    apart by t**2 |1 - 1/(1 - height)| / 2, by which A moves across its two bars in a line. So
    the least strain grows as t**4, and is zero where both are one circle, of height 0.
    """
    places = [(-1, 0), (1, 0), (0, height), (0, 0), (0, 1)]
    return bars(places, [(0, 3), (1, 3), (3, 4), (4, 2)], (0, 1, 2), planar=True)
