# SPDX-License-Identifier: BSD-3-Clause
"""Look for a layout of wires by drawing lines, to know that a design problem has one.

Slow and plain: lines of the constraint space are drawn at random, cut with both regions, and chosen
one after the other by their distance from the span so far. What it finds is judged by
`design_oracle.py` like any answer; that it finds nothing proves nothing.
"""

from __future__ import annotations

import itertools

import numpy as np
from design_classes import (
    Json,
    Real,
    boxes_of,
    centre_of,
    complement,
    constraint,
    freedom,
    klein,
    orthonormal,
    points_of,
    wires_leave,
)
from design_oracle import Solid, box_solid, distance, symmetry_matrix

Wire = tuple[Real, Real]


def drawn_lines(space: Real, random: np.random.Generator, count: int) -> Real:
    """Unit lines (f, m/L) of the constraint space of T, drawn all at once."""
    wrenches = constraint(space)
    if len(wrenches) == 0:
        return np.zeros((0, 6))
    values, vectors = np.linalg.eigh(klein(wrenches))
    parts = random.normal(size=(count, len(values)))
    up, down, flat = values > 1e-9, values < -1e-9, np.abs(values) <= 1e-9
    # Far and near lines of flat families alike.
    parts[:, flat] *= 10 ** random.uniform(-1.5, 1.5, size=(count, 1))
    for side in (up, down):
        if up.any() and down.any():
            weights = np.sqrt(np.abs(values[side]))
            parts[:, side] /= np.linalg.norm(parts[:, side] * weights, axis=1, keepdims=True)
        else:
            parts[:, side] = 0.0
    lines = parts @ vectors.T @ wrenches
    sizes = np.linalg.norm(lines[:, :3], axis=1)
    keep = sizes > 1e-6 * np.maximum(1e-12, np.linalg.norm(lines, axis=1))
    return np.array(lines[keep] / sizes[keep, None])


def lines_through(space: Real, points: Real, random: np.random.Generator) -> Real:
    """Unit lines (f, m/L) through points (in parts of L about the centre) that stop nothing."""
    found = []
    for point in points:
        velocities = space[:, 3:] + np.cross(space[:, :3], point)
        if len(velocities) == 0:
            free = np.eye(3)
        else:
            _, values, right = np.linalg.svd(velocities)
            free = right[int(np.sum(values > 1e-9)) :]
        if len(free):
            direction = random.normal(size=len(free)) @ free
            direction /= np.linalg.norm(direction)
            found.append(np.concatenate([direction, np.cross(point, direction)]))
    return np.array(found).reshape(-1, 6)


def cut(feet: Real, along: Real, box: Real) -> tuple[Real, Real]:
    """Where lines enter and leave a box, as their parameter; first above last where they miss."""
    with np.errstate(divide="ignore", invalid="ignore"):
        one, two = (box[0] - feet) / along, (box[1] - feet) / along
    near, far = np.minimum(one, two), np.maximum(one, two)
    inside = (feet >= box[0] - 1e-12) & (feet <= box[1] + 1e-12)
    flat = np.abs(along) < 1e-12
    near = np.where(flat, np.where(inside, -np.inf, np.inf), near)
    far = np.where(flat, np.where(inside, np.inf, -np.inf), far)
    return near.max(axis=1), far.min(axis=1)


def wires(
    problem: Json, space: Real, regions: tuple[list[Real], list[Real]], random: np.random.Generator
) -> list[tuple[Wire, Real]]:
    """Candidates between two lists of boxes (a point is a box without size), with their rows."""
    centre, size = centre_of(problem), problem["size"]
    low, high = np.array(problem["limits"]["length"], dtype=float)
    lines = [drawn_lines(space, random, 20000)]
    for box in regions[0]:
        points = random.uniform(box[0], box[1], size=(200, 3))
        for axis in range(3):
            ends = box[random.integers(0, 2, size=200), axis]
            points[:, axis] = np.where(random.random(200) < 0.5, ends, points[:, axis])
        lines.append(lines_through(space, (points - centre) / size, random))
    for one, other in itertools.product(*regions):
        if np.array_equal(one[0], one[1]) and np.array_equal(other[0], other[1]):
            u = (other[0] - one[0]) / np.linalg.norm(other[0] - one[0])
            row = np.concatenate([u, np.cross(one[0] - centre, u) / size])
            if np.max(np.abs(space @ row[[3, 4, 5, 0, 1, 2]]), initial=0.0) < 1e-9:
                lines.append(row[None])
    rows = np.vstack(lines)
    along = rows[:, :3]
    feet = centre + size * np.cross(along, rows[:, 3:])
    found = []
    for ours, theirs in itertools.product(*regions):
        a, b = cut(feet, along, ours), cut(feet, along, theirs)
        hit = np.flatnonzero((a[0] <= a[1] + 1e-9 * size) & (b[0] <= b[1] + 1e-9 * size))
        for k in random.permutation(hit)[:150]:
            s, t = (random.uniform(min(c[0][k], c[1][k]), c[1][k]) for c in (a, b))
            # The nearest and the farthest pairs of places too, for tight limits of length.
            ends = itertools.product((s, a[0][k], a[1][k]), (t, b[0][k], b[1][k]))
            fits = [(x, y) for x, y in ends if low <= abs(x - y) <= high]
            if fits:
                x, y = fits[random.integers(len(fits))]
                pair = (feet[k] + x * along[k], feet[k] + y * along[k])
                found.append((pair, rows[k] / np.linalg.norm(rows[k])))
    return found


def turns_asked(problem: Json) -> list[Real]:
    """The group of isometries that a layout is asked to keep; the identity alone without."""
    asked = problem["limits"].get("symmetry", "any")
    if asked in ("any", "none"):
        return [np.eye(3)]
    turn = symmetry_matrix(asked)
    group = [np.eye(3)]
    while not np.allclose(turn @ group[-1], np.eye(3)):
        group.append(turn @ group[-1])
    return group


def kept_wrenches(space: Real, group: list[Real]) -> Real:
    """The freedom whose constraints are those of T that all isometries keep."""
    wrenches = constraint(space)
    for turn in group[1:]:
        sense = np.linalg.det(turn)
        turned = np.hstack([wrenches[:, :3] @ turn.T, sense * wrenches[:, 3:] @ turn.T])
        # Combinations c of rows with c (turned - rows) = 0.
        left, values, _ = np.linalg.svd(turned - wrenches)
        wrenches = left[:, int(np.sum(values > 1e-9)) :].T @ wrenches
    return complement(orthonormal(wrenches))[:, [3, 4, 5, 0, 1, 2]]


def orbits(
    problem: Json, candidates: list[tuple[Wire, Real]], group: list[Real]
) -> list[tuple[list[Wire], Real]]:
    """Images of candidates under a group, each once, with the rows of their lines."""
    centre, size = centre_of(problem), problem["size"]
    found = []
    for pair, _ in candidates:
        images: list[Wire] = []
        for turn in group:
            p, q = (centre + turn @ (end - centre) for end in pair)
            if all(np.linalg.norm(np.subtract((p, q), other)) > 1e-7 * size for other in images):
                images.append((p, q))
        inside = all(
            any(np.all(end >= box[0] - 1e-12) and np.all(end <= box[1] + 1e-12) for box in boxes)
            for image in images
            for end, boxes in zip(
                image, (boxes_of(problem, "stage"), boxes_of(problem, "ground")), strict=True
            )
        )
        if inside:
            rows = []
            for p, q in images:
                u = (q - p) / np.linalg.norm(q - p)
                row = np.concatenate([u, np.cross(p - centre, u) / size])
                rows.append(row / np.linalg.norm(row))
            found.append((images, np.array(rows)))
    return found


def symmetric_choice(problem: Json, space: Real, random: np.random.Generator) -> list[Solid] | None:
    """Whole orbits of wires that hold what T leaves, with the self-stresses that are allowed."""
    group = turns_asked(problem)
    regions = boxes_of(problem, "stage"), boxes_of(problem, "ground")
    candidates = wires(problem, space, regions, random)
    kept = kept_wrenches(space, group)
    alone = wires(problem, kept, regions, random) if len(kept) < 6 else []
    some = [candidates[k] for k in random.permutation(len(candidates))[:200]]
    found = orbits(problem, some + alone[:100], group)
    radius, clearance = np.mean(problem["limits"]["diameter"]) / 2, problem["limits"]["clearance"]
    needed = 6 - len(space)
    for _ in range(60):
        picked: list[Solid] = []
        span, spare = np.zeros((0, 6)), problem["limits"].get("over_constraint", 0)
        for k in random.permutation(len(found)):
            images, rows = found[k]
            wider = orthonormal(np.vstack([span, rows]), 0.03)
            cost = len(images) - (len(wider) - len(span))
            if len(wider) == len(span) or cost > spare or len(images) > needed - len(span) + spare:
                continue
            solids = [Solid((p + q) / 2, np.array([(q - p) / 2]), radius) for p, q in images]
            pairs = itertools.chain(
                itertools.combinations(solids, 2), itertools.product(solids, picked)
            )
            if all(distance(one, other) > clearance for one, other in pairs):
                picked, span, spare = picked + solids, wider, spare - cost
            if len(span) == needed:
                return picked
    return None


def chosen(
    problem: Json,
    candidates: list[tuple[Wire, Real]],
    count: int,
    taken: list[Solid],
    random: np.random.Generator,
) -> list[Solid] | None:
    """Independent wires that keep clear of each other, of what is there and of keep-outs."""
    radius = np.mean(problem["limits"]["diameter"]) / 2
    clearance = problem["limits"]["clearance"]
    boxes = [box_solid(box) for box in boxes_of(problem, "keep_out")]
    picked: list[Solid] = []
    span = np.zeros((0, 6))
    order = random.permutation(len(candidates))[:400]
    rows = np.array([candidates[k][1] for k in order]).reshape(-1, 6)
    solids = [
        Solid((p + q) / 2, np.array([(q - p) / 2]), radius)
        for p, q in (candidates[k][0] for k in order)
    ]
    for _ in range(count):
        apart = np.linalg.norm(rows - rows @ span.T @ span, axis=1)
        for k in np.argsort(-apart * random.uniform(0.7, 1.0, size=len(apart))):
            if apart[k] < 0.02:
                continue
            others = [*picked, *taken, *boxes]
            if all(distance(solids[k], other) > clearance for other in others):
                picked.append(solids[k])
                span = orthonormal(np.vstack([span, rows[k]]))
                break
        else:
            return None
    return picked


def layers(space: Real, random: np.random.Generator) -> list[Real]:
    """A cut of T into freedoms that wires can hold, in random order."""
    if wires_leave(space) == 0:
        return [space]
    count = len(space)
    for parts in range(2, count + 1):
        for _ in range(40):
            basis = random.normal(size=(count, count)) @ space
            cuts = np.sort(random.choice(np.arange(1, count), parts - 1, replace=False))
            pieces = [orthonormal(piece) for piece in np.split(basis, cuts)]
            if all(wires_leave(piece) == 0 for piece in pieces):
                return pieces
    raise ValueError("no cut was found")


def named(made: list[tuple[Solid, str, str]]) -> list[Json]:
    """Wires as flexures of an answer."""
    return [
        {
            "name": f"wire {n}",
            "kind": "wire",
            "ends": [(s.centre - s.axes[0]).tolist(), (s.centre + s.axes[0]).tolist()],
            "between": [one, other],
            "diameter": 2 * s.radius,
        }
        for n, (s, one, other) in enumerate(made, start=1)
    ]


def witness(problem: Json, seed: int = 0, tries: int = 12) -> list[Json] | None:
    """Flexures of a layout of wires, or nothing where none was found."""
    random = np.random.default_rng(seed)
    space = freedom(problem)

    def region(name: str) -> list[Real]:
        return boxes_of(problem, name) + [np.array([p, p]) for p in points_of(problem, name)]

    middle = centre_of(problem) + 0.9 * problem["size"] * np.array([[-1.0] * 3, [1.0] * 3])
    if len(turns_asked(problem)) > 1:
        picked = symmetric_choice(problem, space, random)
        return named([(solid, "stage", "ground") for solid in picked]) if picked else None
    for _ in range(tries):
        pieces = layers(space, random)
        bodies = [region("stage")]
        for _ in pieces[1:]:
            places = region("intermediate") or [middle]
            bodies.append([places[random.integers(len(places))]])
        bodies.append(region("ground"))
        names = ["stage", *(f"body {k}" for k in range(1, len(pieces))), "ground"]
        made: list[tuple[Solid, str, str]] = []
        for k, piece in enumerate(pieces):
            candidates = wires(problem, piece, (bodies[k], bodies[k + 1]), random)
            taken = [solid for solid, _, _ in made]
            picked = None
            for _ in range(4):
                picked = chosen(problem, candidates, 6 - len(piece), taken, random)
                if picked is not None:
                    break
            if picked is None:
                break
            made += [(solid, names[k], names[k + 1]) for solid in picked]
        else:
            return named(made)
    return None
