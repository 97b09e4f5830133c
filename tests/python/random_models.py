# SPDX-License-Identifier: BSD-3-Clause
"""Random models for property tests: frameworks of bars, and mixed mechanisms."""

import numpy as np

from flexact import Model

NAMES = ["", "bar", "% of it", "Blattfeder \u00fc", "a # b % c", "TRUSS 1 1 2"]


def framework(
    random: np.random.Generator, joints: int, bars: int, supports: int, planar: bool
) -> Model:
    """Random joints, bars between random pairs, some joints fixed."""
    model = Model(planar=planar)
    size = 2 if planar else 3
    nodes = [model.node(*random.uniform(-1, 1, size)) for _ in range(joints)]
    pairs = [(i, j) for i in range(joints) for j in range(i)]
    for k in random.permutation(len(pairs))[:bars]:
        i, j = pairs[k]
        model.truss(nodes[i], nodes[j])
    used = set(model.node_numbers.tolist())
    standing = [node for node in nodes if node.position in used]
    for node in standing[:supports]:
        model.fix(node)
    return model


def mechanism(random: np.random.Generator, planar: bool, held: bool = True) -> Model:
    """A few of every element on random points, with classes of all kinds.

    Where it is not `held`, its coordinates are all dependent.
    """
    model = Model(planar=planar, name="random")
    size = 2 if planar else 3
    points = [model.node(*random.normal(size=size)) for _ in range(random.integers(3, 7))]
    for _ in range(random.integers(1, 8)):
        add_element(model, random, points)
    used = set(model.node_numbers.tolist())
    for point in points if held else []:
        if point.position not in used:
            continue
        used.discard(point.position)
        if random.random() < 0.3:
            model.fix(point)
        elif random.random() < 0.3:
            model.independent(point, str(random.choice(["x", "y"])))
    for number, classes in zip(
        model.element_numbers.tolist(), model.deformation_classes.tolist(), strict=True
    ):
        stiff = [k + 1 for k, value in enumerate(classes) if value == 1]
        if stiff and random.random() < 0.2:
            model.release(number, int(random.choice(stiff)))
        elif stiff and random.random() < 0.1:
            model.independent(number, int(random.choice(stiff)))
    return model


def add_element(model: Model, random: np.random.Generator, points: list) -> None:  # type: ignore[type-arg]
    """One random element between two random points."""
    i, j = random.permutation(len(points))[:2]
    p, q = points[i], points[j]
    if p.position == q.position:
        return
    name = NAMES[random.integers(len(NAMES))]
    y = None if model.planar or random.random() < 0.5 else random.normal(size=3)
    match random.integers(6):
        case 0:
            model.truss(p, q, name=name)
        case 1:
            model.beam(p, q, y, release=(2,), name=name)
        case 2:
            model.wire(p, q, y, name=name)
        case 3:
            width = None if model.planar else random.normal(size=3)
            model.sheet(p, q, width, beams=int(random.integers(1, 4)), name=name)
        case 4:
            model.rigid(p, q, name=name)
        case _:
            points.append(model.hinge(p, None if model.planar else random.normal(size=3)))


def transformed(model: Model, turn: np.ndarray, shift: np.ndarray, scale: float) -> Model:
    """The same bars with their joints turned, moved and scaled."""
    made = Model(planar=model.planar)
    size = 2 if model.planar else 3
    places = scale * (model.positions @ turn.T) + shift
    nodes = [made.node(*place[:size]) for place in places]
    for p, _, q, _ in model.element_nodes.tolist():
        made.truss(nodes[p], nodes[q])
    for node, classes in zip(nodes, model.coordinate_classes.tolist(), strict=True):
        if classes[0] == 1:
            made.fix(node)
    return made
