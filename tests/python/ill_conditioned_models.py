# SPDX-License-Identifier: BSD-3-Clause
"""Models that are exact by construction and close to a change of verdict."""

from __future__ import annotations

import math

import numpy as np

from flexact import Model


def two_wires(angle: float, unit: float = 1.0) -> Model:
    """Bars in a plane from the points 0 and `angle` along y to one joint: (0, 0)."""
    model = Model(planar=True)
    a, b, joint = model.node(0, 0), model.node(0, unit * angle), model.node(unit, 0)
    for end in (a, b):
        model.truss(end, joint)
        model.fix(end)
    return model


def two_wire_flexures(angle: float) -> Model:
    """The same of beams in space, whose joint can turn and leave the plane: (4, 0)."""
    model = Model()
    a, b, joint = model.node(0, 0, 0), model.node(0, angle, 0), model.node(1, 0, 0)
    for end in (a, b):
        model.wire(end, joint)
        model.fix(end)
    return model


def two_fold_lines(angle: float) -> Model:
    """A body on two folded sheets, one turned about the x axis by an angle: (6, 0).

    The fold lines cross, and each holds one direction; four motions of the body and one
    within each folded sheet remain.
    """
    model = Model()
    body = model.node(0, 0, 0)
    for turn in (0.0, angle):
        c, s = math.cos(turn), math.sin(turn)
        fold, foot = model.node(-1, 0, 0), model.node(-1, -c, -s)
        model.sheet(foot, fold, (0, -s, c))
        model.sheet(fold, body, (0, -s, c))
        model.fix(foot)
    return model


def spokes(directions: np.ndarray) -> Model:
    """Bars of length one from the ground to one joint: D(c) has their directions as rows."""
    model = Model(planar=directions.shape[1] == 2)
    joint = model.node(*np.zeros(directions.shape[1]))
    for direction in directions:
        end = model.node(*-direction)
        model.truss(end, joint)
        model.fix(end)
    return model


def levers(number: int, ratio: float) -> Model:
    """Sliding joints in a plane; each drives the next one `ratio` times as far: (0, 0).

    A bar across its path holds each joint to it. The bar from the joint before stands across
    the path but for 1/ratio, and the bar to the next joint stands along it. The inverse of
    D(c) is of the size ratio**number.
    """
    model = Model(planar=True)
    place, path = np.zeros(2), np.array([1.0, 0.0])
    before = model.node(*place)
    model.fix(before)
    for k in range(number):
        bar = path
        place = place + bar
        joint = model.node(*place)
        model.truss(before, joint)
        # The path stands at an angle to the bar whose cosine is 1/ratio; to either side by turns.
        sine = math.sqrt(1.0 - 1.0 / ratio**2) * (-1) ** k
        path = np.array([bar[0] / ratio - sine * bar[1], sine * bar[0] + bar[1] / ratio])
        end = model.node(place[0] - path[1], place[1] + path[0])
        model.truss(end, joint)
        model.fix(end)
        before = joint
    return model
