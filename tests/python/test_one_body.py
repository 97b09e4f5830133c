# SPDX-License-Identifier: BSD-3-Clause
"""The seventeen arrangements of docs/one_body_and_its_wires.md.

Wires and cells: L. C. Hale, *Principles and Techniques for Designing Precision Machines*, thesis,
MIT, 1999, figure 2-21. Freedoms are computed here from the lines of the wires alone: what is
reciprocal to their Pluecker coordinates, by the singular value decomposition.
"""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Callable
from itertools import combinations, permutations, product
from pathlib import Path

import numpy as np
import pytest

import flexact

PAGE = (Path(__file__).parents[2] / "docs" / "one_body_and_its_wires.md").read_text("utf-8")
ROW = r"^\| \d+ \| (\d)R (\d)T \| `(.*?)` \| (.*?) \| (.*?) ?\| (.*?) \|$"
ROWS = re.findall(ROW, PAGE, re.MULTILINE)
HALF = 0.05  # m
PASSING = "x(+,0) y(0,+) z(+,0)"
AXES = np.eye(3)
#: Turns about axes through the centre, and moves along them.
COORDINATES = ("rx", "ry", "rz", "x", "y", "z")


def code() -> dict[str, Callable[..., flexact.Model]]:
    """What the first block of the page defines."""
    names: dict[str, Callable[..., flexact.Model]] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)[0], names)
    return names


BODY_ON = code()["body_on"]


def lines(wires: str) -> np.ndarray:
    """(wires, 6) moments about the centre and forces along them, of the page's notation."""
    rows = []
    for axis, *signs in re.findall(r"([xyz])\(([-0+]),([-0+])\)", wires):
        k = "xyz".index(axis)
        point = np.insert([HALF * ("-0+".index(sign) - 1) for sign in signs], k, 0.0)
        rows.append((*np.cross(point, AXES[k]), *AXES[k]))
    return np.array(rows)


def null_space(rows: np.ndarray) -> np.ndarray:
    """(n, 6) orthonormal rows that are reciprocal to all; turns times the half edge."""
    scaled = rows / np.array((HALF,) * 3 + (1.0,) * 3)
    _, values, right = np.linalg.svd(scaled)
    return right[int((values > 1e-9).sum()) :]


def projector(rows: np.ndarray) -> np.ndarray:
    _, values, right = np.linalg.svd(rows, full_matrices=False)
    right = right[values > 1e-9 * max(values, default=0.0)]
    return right.T @ right


def computed(model: flexact.Model) -> np.ndarray:
    """(n, 6) the freedom space of the body as Flexact has it, scaled likewise."""
    spaces = flexact.analyse(model).advice(body="body").spaces
    assert spaces is not None
    given = spaces.freedom
    turns, moves = given.basis[:, :3], given.basis[:, 3:]
    return np.hstack((HALF * turns, moves - np.cross(turns, given.about)))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[2])
def test_freedoms_are_those_of_the_lines_and_of_the_cell(row: tuple[str, ...]) -> None:
    turns, moves, wires, verdict, declared, words = row
    free, model = null_space(lines(wires)), BODY_ON(wires)
    count = int(turns) + int(moves)
    assert len(free) == count == 6 - len(lines(wires))
    cell = np.eye(6)[[COORDINATES.index(each) for each in declared.split()]]
    assert sum(each[0] == "r" for each in declared.split()) == int(turns)
    assert np.allclose(projector(free), projector(cell), atol=1e-12)
    assert np.allclose(projector(computed(model)), projector(free), atol=1e-9)
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (count, 0)
    assert verdict == analysis.verdict.value + (f" by {count}" if count else "")
    assert flexact.analyse(BODY_ON(wires, declared)).verdict == "exact"
    told = analysis.advice(body="body").to_dict()["spaces"]["statements"][0]  # type: ignore[index]
    assert told.partition("motion")[2].lstrip("s: ") == words if count else words == "nothing"


def test_there_are_seventeen_and_thirteen_freedoms_none_of_which_is_missing() -> None:
    """All choices of turns and moves, of which wires hold the rest where lines span it."""

    def alike(free: tuple[int, ...]) -> frozenset[int]:
        """The same choice by other names of the axes: the first of all of them."""
        renamed = [{order[k % 3] + k // 3 * 3 for k in free} for order in permutations(range(3))]
        return frozenset(min(map(sorted, renamed)))

    shown = [alike(tuple(COORDINATES.index(each) for each in row[4].split())) for row in ROWS]
    assert len(shown) == 17 and len(set(shown)) == 13
    assert [[n + 1 for n in range(17) if shown[n] == each] for each in dict.fromkeys(shown)] == [
        *([1], [2], [3], [4], [5], [6], [7], [8]),
        *([9, 10], [11], [12, 13, 14], [15], [16, 17]),
    ]
    possible = set()
    for free in (each for n in range(6) for each in combinations(range(6), n)):
        held = [k for k in range(6) if k not in free]
        # A line that holds: a force, and a moment across it of what is held.
        spans = [
            (*(sign * AXES[m] if m is not None else np.zeros(3)), *AXES[f - 3])
            for f, m, sign in product(held, (None, *held), (-1, 1))
            if f >= 3 and (m is None or (m < 3 and m != f - 3))
        ]
        if np.linalg.matrix_rank(np.array(spans or [np.zeros(6)])) == len(held):
            possible.add(alike(free))
    assert possible == set(shown)


def is_sheet(three: np.ndarray) -> bool:
    """Whether three lines are independent and lie in one plane."""
    if np.linalg.matrix_rank(three, tol=1e-9) < 3 or np.linalg.matrix_rank(three[:, 3:]) != 2:
        return False
    normal = np.linalg.svd(three[:, 3:])[2][2]
    return bool(np.ptp(np.cross(three[:, 3:], three[:, :3]) @ normal) < 1e-12)


def test_rows_that_have_a_sheet() -> None:
    threes = [combinations(lines(wires), 3) for _, _, wires, *_ in ROWS]
    found = [n for n, all_ in enumerate(threes, 1) if any(is_sheet(np.array(t)) for t in all_)]
    assert found == [6, 7, 13, 14, 15, 16]


def test_wires_that_pass_each_other_make_screws() -> None:
    """Figure 2-25. With v = V w, w.V w is zero along each wire, three directions at right angles.

    So the trace of V is zero; about (1, 1, 1), an axis of symmetry, the pitch is the distance at
    which the wires pass, and across it minus half of that. None is zero, so that the axes of pure
    turns are rulings that do not meet.
    """
    free = null_space(lines(PASSING))
    turned = np.linalg.solve(free[:, :3] / HALF, free[:, 3:])
    pitches, axes = np.linalg.eigh((turned + turned.T) / 2)
    assert pitches == pytest.approx([-HALF / 2, -HALF / 2, HALF], abs=1e-12)
    assert np.abs(axes[:, 2]) == pytest.approx(np.ones(3) / np.sqrt(3), abs=1e-12)
    assert np.allclose(projector(computed(BODY_ON(PASSING))), projector(free), atol=1e-9)
