# SPDX-License-Identifier: BSD-3-Clause
"""The freedom that a design problem wants, and its class, without the theorems of the package.

What wires can do is found by drawing the lines of the constraint space, what sheets can do by
solving for their plane, how many layers it takes by drawing sums. Conventions: `design_oracle.py`.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Json = dict[str, Any]


def boxes_of(problem: Json, region: str) -> list[Real]:
    boxes = (problem.get(region) or {}).get("boxes") or []
    return [np.sort(np.array(box, dtype=float), axis=0) for box in boxes]


def points_of(problem: Json, region: str) -> list[Real]:
    points = (problem.get(region) or {}).get("points") or []
    return [np.array(point, dtype=float) for point in points]


def unit(vector: Any) -> Real:
    vector = np.asarray(vector, dtype=float)
    return np.array(vector / np.linalg.norm(vector))


def twist(motion: Json, centre: Real) -> Real:
    """(w, v) of a wanted motion, v at the centre."""
    direction = unit(motion["direction"])
    if motion["kind"] == "translation":
        return np.concatenate([np.zeros(3), direction])
    arm = centre - np.asarray(motion["point"], dtype=float)
    pitch = motion.get("pitch", 0.0) if motion["kind"] == "screw" else 0.0
    return np.concatenate([direction, pitch * direction + np.cross(direction, arm)])


def centre_of(problem: Json) -> Real:
    if "centre" in problem:
        return np.array(problem["centre"], dtype=float)
    corners = np.array(
        [*itertools.chain(*boxes_of(problem, "stage")), *points_of(problem, "stage")]
    )
    return np.array((corners.min(axis=0) + corners.max(axis=0)) / 2)


def orthonormal(rows: Real, floor: float = 1e-10) -> Real:
    """Orthonormal rows with the span of some rows."""
    if rows.size == 0:
        return np.zeros((0, 6))
    _, values, right = np.linalg.svd(rows)
    return np.array(right[: int(np.sum(values > floor * max(values[0], 1e-300)))])


def complement(rows: Real) -> Real:
    """Orthonormal rows across the span of orthonormal rows."""
    return np.array(np.linalg.svd(rows)[2][len(rows) :]) if len(rows) else np.eye(rows.shape[1])


def freedom(problem: Json) -> Real:
    """T: orthonormal rows of scaled twists (w L, v) about the centre."""
    centre, size = centre_of(problem), problem["size"]
    rows = [twist(motion, centre) * np.repeat([size, 1.0], 3) for motion in problem["wanted"]]
    space = orthonormal(np.array(rows).reshape(-1, 6))
    if len(space) != len(rows):
        raise ValueError("the wanted motions depend on each other")
    return space


def constraint(space: Real) -> Real:
    """W: orthonormal rows (f, m/L) that do no work on the scaled twists (w L, v)."""
    return np.array(complement(space)[:, [3, 4, 5, 0, 1, 2]])


def signature(rows: Real) -> tuple[int, int, int]:
    """Numbers of positive, negative and zero eigenvalues of a.b on rows (a, b)."""
    values = np.linalg.eigvalsh(klein(rows))
    return (
        int(np.sum(values > 1e-7)),
        int(np.sum(values < -1e-7)),
        int(np.sum(np.abs(values) <= 1e-7)),
    )


def klein(rows: Real) -> Real:
    return np.array((rows[:, :3] @ rows[:, 3:].T + rows[:, 3:] @ rows[:, :3].T) / 2)


def sampled_lines(space: Real, random: np.random.Generator, count: int = 60) -> Real:
    """Lines of a space of wrenches, drawn from all zeros of f.m in it, couples left out.

    With f.m diagonal a zero has parts of one length where it is positive and negative, and any
    part where it is zero; where one sign is missing the other part is nothing.
    """
    if len(space) == 0:
        return np.zeros((0, 6))
    values, vectors = np.linalg.eigh(klein(space))
    up, down, flat = values > 1e-7, values < -1e-7, np.abs(values) <= 1e-7
    found = []
    for _ in range(count):
        parts = np.zeros(len(values))
        parts[flat] = random.normal(size=int(flat.sum()))
        if up.any() and down.any():
            for side in (up, down):
                direction = unit(random.normal(size=int(side.sum())))
                parts[side] = direction / np.sqrt(np.abs(values[side]))
        if np.linalg.norm(parts) == 0:
            continue
        line = unit(parts @ vectors.T @ space)
        if np.linalg.norm(line[:3]) > 1e-6:
            found.append(line / np.linalg.norm(line[:3]))
    return np.array(found).reshape(-1, 6)


def wires_leave(space: Real) -> int:
    """How many more motions than wanted are left by all wires that stop nothing wanted."""
    lines = sampled_lines(constraint(space), np.random.default_rng(len(space)))
    return 6 - len(space) - len(orthonormal(lines, 1e-6))


def sheet_plane(space: Real) -> tuple[Real, Real] | None:
    """(normal, point in units of L) of a plane in which a whole sheet stops nothing wanted.

    Every wanted velocity in the plane is along its normal n: w.n = 0 and v + w x p along n.
    """
    if len(space) == 0:
        return np.array([0.0, 0.0, 1.0]), np.zeros(3)
    turns, _, right = np.linalg.svd(space[:, :3])
    rank = int(np.sum(np.linalg.svd(space[:, :3])[1] > 1e-7))
    couples = turns[:, rank:].T @ space[:, 3:]
    if len(couples) > 1 or rank > 2:
        return None
    normal = unit(couples[0]) if len(couples) else right[2]
    if np.max(np.abs(space[:, :3] @ normal)) > 1e-7:
        return None
    across = np.eye(3) - np.outer(normal, normal)
    spins = np.vstack([across @ spin(row[:3]) for row in space])
    speeds = np.concatenate([across @ row[3:] for row in space])
    point = np.linalg.lstsq(spins, -speeds, rcond=1e-9)[0]
    return (normal, point) if np.max(np.abs(spins @ point + speeds)) < 1e-7 else None


def spin(w: Real) -> Real:
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def least_layers(space: Real) -> int:
    """How many layers a freedom takes, by drawing sums of freedoms that wires can hold."""
    if wires_leave(space) == 0:
        return 1
    random, count = np.random.default_rng(7), len(space)
    for _ in range(60):
        basis = random.normal(size=(count, count)) @ space
        for cut in range(1, count // 2 + 1):
            if all(wires_leave(orthonormal(half)) == 0 for half in (basis[:cut], basis[cut:])):
                return 2
    return 3


def classify(space: Real) -> Json:
    """The class of a freedom T (orthonormal scaled twists), in the words of `expect`."""
    extra, layers = wires_leave(space), least_layers(space)
    sheet = sheet_plane(space) is not None
    return {
        "dimension": len(space),
        "parallel_wires": extra == 0,
        "least_wires": 6 - len(space) if extra == 0 else None,
        "sheet": sheet,
        "with_sheet": [1, 3 - len(space)] if sheet else None,
        "least_layers": layers,
        "extra_freedom_of_wires_alone": extra,
        "signature_freedom": [*sorted(signature(space)[:2], reverse=True), signature(space)[2]],
    }
