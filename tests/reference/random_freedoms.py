# SPDX-License-Identifier: BSD-3-Clause
"""Random freedoms of all kinds, as design problems in free space.

A freedom is drawn in a frame of its own by its geometry (lines that meet, are parallel, skew;
pitches of one sense), then turned, shifted, mirrored and given by another basis. What is possible
with it is known by its kind (`known`: from the tables of Hopkins and Culpepper 2010 and 2011 and
from Hunt 1978) and computed again by `design_classes.classify`, by drawing lines. Freedoms near the
border between two kinds are drawn anew.

``python tests/reference/random_freedoms.py 1000`` prints as many problems as JSON.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from design_classes import Json, Real, klein, orthonormal

#: L of all problems, in metres.
SIZE = 0.05
Draw = np.random.Generator
Freedom = Callable[[Draw], list[Real]]

X, Y, Z, O = np.eye(3)[0], np.eye(3)[1], np.eye(3)[2], np.zeros(3)  # noqa: E741


def turn(direction: Any, point: Any = O, pitch: float = 0.0) -> Real:
    """Twist (w, v at the origin) of a rotation or a screw; lengths in parts of L."""
    w = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    return np.concatenate([w, pitch * w + np.cross(point, w)])


def move(direction: Any) -> Real:
    v = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    return np.concatenate([O, v])


def length(random: Draw) -> float:
    """A distance or a pitch that is neither near zero nor large."""
    return float(random.uniform(0.15, 0.4))


def oblique(random: Draw, one: Real, other: Real) -> Real:
    """A direction at 40 to 75 degrees from one axis, towards another."""
    angle = np.radians(random.uniform(40, 75))
    return np.array(np.cos(angle) * one + np.sin(angle) * other)


def reciprocal(rows: list[Real]) -> list[Real]:
    """Twists on which the wrenches (v, w) of some twists do no work."""
    matrix = np.array(rows)
    return list(np.linalg.svd(matrix)[2][len(rows) :][:, [3, 4, 5, 0, 1, 2]])


def unequal(random: Draw) -> tuple[float, float]:
    first = float(random.uniform(0.12, 0.2))
    return first, first * float(random.uniform(1.8, 2.6))


def regulus(random: Draw, round_one: bool) -> list[Real]:
    radius, rise = length(random), float(random.uniform(0.7, 1.4))
    other = radius if round_one else radius * float(random.uniform(1.4, 1.8))
    angles = np.radians([0.0, 120.0, 240.0])
    return [
        turn(
            [-radius * np.sin(a), other * np.cos(a), rise * radius],
            [radius * np.cos(a), other * np.sin(a), 0.0],
        )
        for a in angles
    ]


def paraboloid(random: Draw) -> list[Real]:
    height = length(random)
    return [turn(X, -height * Z), turn(Y, height * Z), turn(oblique(random, X, Y))]


def screws(random: Draw, count: int, equal: int) -> list[Real]:
    """Screws along the axes, all right-handed, the first `equal` of one pitch."""
    first, second = unequal(random)
    pitches = [first, second, (first + second) / 2]
    if equal:
        pitches = [first] * equal + [second] * (3 - equal)
    return [turn(axis, O, pitch) for axis, pitch in zip((X, Y, Z)[:count], pitches, strict=False)]


ONE: dict[str, Freedom] = {
    "rotation": lambda r: [turn(X)],
    "translation": lambda r: [move(X)],
    "screw": lambda r: [turn(X, O, length(r))],
}
TWO: dict[str, Freedom] = {
    "two rotations that meet": lambda r: [turn(X), turn(oblique(r, X, Y))],
    "parallel rotations": lambda r: [turn(X, length(r) * Y), turn(X, -length(r) * Y)],
    "two translations": lambda r: [move(X), move(oblique(r, X, Y))],
    "two skew rotations": lambda r: [
        turn(X, length(r) * Z),
        turn(oblique(r, X, Y), -length(r) * Z),
    ],
    "cylindrical": lambda r: [turn(X), move(X)],
    "rotation and oblique translation": lambda r: [turn(X), move(oblique(r, X, Y))],
    "two screws of unequal pitch": lambda r: screws(r, 2, 0),
    "two screws of equal pitch": lambda r: screws(r, 2, 2),
    "rotation and screw": lambda r: [turn(X), turn(Y, O, length(r))],
    "screw and translation across": lambda r: [turn(X, O, length(r)), move(Y)],
}
THREE: dict[str, Freedom] = {
    "ball": lambda r: [turn(X), turn(oblique(r, X, Y)), turn(oblique(r, X, Z))],
    "tip, tilt, piston": lambda r: [turn(X), turn(oblique(r, X, Y)), move(Z)],
    "planar": lambda r: [move(X), move(oblique(r, X, Y)), turn(Z)],
    "two pencils": lambda r: [turn(X), turn(oblique(r, X, Z)), turn(Y, length(r) * X)],
    "pencil and parallels": lambda r: [turn(X), turn(oblique(r, X, Z)), move(Z)],
    "parallels twice": lambda r: [turn(X, length(r) * Z), turn(oblique(r, X, Y)), move(Z)],
    "hyperboloid": lambda r: regulus(r, False),
    "round hyperboloid": lambda r: regulus(r, True),
    "paraboloid": paraboloid,
    "three translations": lambda r: [move(X), move(oblique(r, X, Y)), move(oblique(r, X, Z))],
    "two translations and a rotation along one": lambda r: [move(X), move(Y), turn(X)],
    "two translations and an oblique rotation": lambda r: [
        move(X),
        move(Y),
        turn(oblique(r, X, Z)),
    ],
    "pencil and screw": lambda r: [turn(X), turn(oblique(r, X, Y)), turn(Z, O, length(r))],
    "parallels and screw": lambda r: [turn(X), move(Z), turn(Y, O, length(r))],
    "two translations and a screw": lambda r: [move(X), move(Y), turn(Z, O, length(r))],
    "rotation and two unequal screws": lambda r: [turn(Z), *screws(r, 2, 0)],
    "rotation and two equal screws": lambda r: [turn(Z), *screws(r, 2, 2)],
    "two unequal screws and translation": lambda r: [move(Z), *screws(r, 2, 0)],
    "two equal screws and translation": lambda r: [move(Z), *screws(r, 2, 2)],
    "three equal screws": lambda r: screws(r, 3, 3),
    "three screws, two equal": lambda r: screws(r, 3, 2),
    "three unequal screws": lambda r: screws(r, 3, 0),
}


def _against(freedom: Freedom) -> Freedom:
    return lambda random: reciprocal(freedom(random))


FREEDOMS: dict[str, Freedom] = {
    "nothing": lambda r: [],
    **ONE,
    **TWO,
    **THREE,
    **{f"left by wrenches like {name}": _against(draw) for name, draw in TWO.items()},
    **{f"left by wrenches like a {name}": _against(draw) for name, draw in ONE.items()},
}

#: What wires alone leave beside what is wanted, where they leave anything.
EXTRA = {
    "two translations": 1,
    "three translations": 3,
    "two translations and a rotation along one": 1,
    "two translations and an oblique rotation": 1,
    "pencil and screw": 1,
    "parallels and screw": 1,
    "two translations and a screw": 3,
    "rotation and two unequal screws": 2,
    "rotation and two equal screws": 2,
    "two unequal screws and translation": 3,
    "two equal screws and translation": 3,
    "three equal screws": 3,
    "three screws, two equal": 3,
    "three unequal screws": 3,
    # As constraints: of two dimensions wires span two that meet, are parallel, or skew.
    "left by wrenches like two translations": 2,
    "left by wrenches like cylindrical": 1,
    "left by wrenches like rotation and oblique translation": 1,
    "left by wrenches like two screws of unequal pitch": 2,
    "left by wrenches like two screws of equal pitch": 2,
    "left by wrenches like rotation and screw": 1,
    "left by wrenches like screw and translation across": 2,
    "left by wrenches like a translation": 1,
    "left by wrenches like a screw": 1,
}
#: Where a whole sheet fits.
SHEETS = (
    "nothing",
    "rotation",
    "translation",
    "two rotations that meet",
    "parallel rotations",
    "tip, tilt, piston",
)


def known(name: str, dimension: int) -> Json:
    """What is known of a kind, in the words of `expect`."""
    extra = EXTRA.get(name, 0)
    return {
        "dimension": dimension,
        "parallel_wires": extra == 0,
        "least_wires": 6 - dimension if extra == 0 else None,
        "sheet": name in SHEETS,
        "with_sheet": [1, 3 - dimension] if name in SHEETS else None,
        "least_layers": 3 if name == "three translations" else 2 if extra else 1,
        "extra_freedom_of_wires_alone": extra,
    }


def moved(rows: list[Real], random: Draw) -> Real:
    """Twists turned, mirrored and shifted at random, in another basis of their span."""
    matrix = np.array(rows).reshape(-1, 6)
    turned, _ = np.linalg.qr(random.normal(size=(3, 3)))
    shift = random.uniform(-0.1, 0.1, size=3)
    w = matrix[:, :3] @ turned.T * np.linalg.det(turned)
    v = matrix[:, 3:] @ turned.T + np.cross(shift, w)
    result = np.hstack([w, v])
    if len(result) and random.random() < 0.5:
        # Couples stay apart: a combination that is nearly one would be a remote rotation.
        pure = np.linalg.norm(w, axis=1) < 1e-9
        for part in (pure, ~pure):
            count = int(part.sum())
            result[part] = np.linalg.qr(random.normal(size=(count, count)))[0] @ result[part]
    return np.array(result)


def clear(rows: Real) -> bool:
    """Whether a freedom is far from the borders between kinds."""
    if len(rows) == 0:
        return True
    sizes = np.linalg.svd(rows / np.linalg.norm(rows, axis=1, keepdims=True))[1]
    form = np.abs(np.linalg.eigvalsh(klein(orthonormal(rows))))
    couples = np.linalg.svd(rows[:, :3])[1]
    return bool(
        sizes[-1] > 0.08
        and not np.any((form > 1e-9) & (form < 0.02))
        and not np.any((couples > 1e-9) & (couples < 0.05))
    )


def written(row: Real) -> Json:
    """A twist about the centre as a wanted motion; lengths in metres."""
    w, v = row[:3], row[3:]
    turns = float(np.linalg.norm(w))
    if turns < 1e-12:
        return {"kind": "translation", "direction": (v / np.linalg.norm(v)).tolist()}
    pitch = float(w @ v) / turns**2
    point = SIZE * np.cross(w, v) / turns**2
    motion = {"direction": (w / turns).tolist(), "point": point.tolist()}
    if abs(pitch) < 1e-12:
        return {"kind": "rotation", **motion}
    return {"kind": "screw", **motion, "pitch": SIZE * pitch}


def free_space() -> Json:
    """A stage with ground all around, and flexures of generous limits."""
    a, b = 0.06, 0.08
    shell = []
    for axis in range(3):
        for low, high in ((a, b), (-b, -a)):
            box = [[-b] * 3, [b] * 3]
            box[0][axis], box[1][axis] = low, high
            shell.append(box)
    return {
        "stage": {"boxes": [[[-0.025] * 3, [0.025] * 3]]},
        "ground": {"boxes": shell},
        "centre": [0.0, 0.0, 0.0],
        "size": SIZE,
        "limits": {
            "length": [0.02, 0.15],
            "width": [0.005, 0.03],
            "thickness": 0.0002,
            "diameter": 0.0005,
            "clearance": 0.0005,
            "kinds": ["wire", "sheet"],
            "over_constraint": 0,
        },
        "material": {"E": 210e9, "G": 80.77e9, "density": 7800.0},
        "mass": 0.2,
        "inertia": 4e-5,
    }


def problems(count: int = 1000, seed: int = 33) -> Iterator[Json]:
    """Problems of random freedoms, all kinds in turn."""
    random = np.random.default_rng(seed)
    names = list(FREEDOMS)
    for number in range(count):
        name = names[number % len(names)]
        while not clear(rows := moved(FREEDOMS[name](random), random)):
            pass
        yield {
            "id": f"random_{number}",
            "title": name[0].upper() + name[1:],
            "source": f"{name}, tests/reference/random_freedoms.py, seed {seed}",
            "wanted": [written(row) for row in rows],
            **free_space(),
            "expect": known(name, len(rows)) | {"layout_exists": True},
        }


if __name__ == "__main__":
    print(json.dumps({"problems": list(problems(int(sys.argv[1])))}, indent=1))
