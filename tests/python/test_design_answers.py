# SPDX-License-Identifier: BSD-3-Clause
"""What the command answers to design problems, judged by an independent computation.

Problems and judge: `tests/reference/design_problems.json`, `more_design_problems.json`,
`random_freedoms.py` and `design_oracle.py`; none of them uses what it judges.
"""

import contextlib
import io
import json
from pathlib import Path

import numpy as np
import pytest
from design_answers_by_hand import Json, design_oracle, problems, random_freedoms

from flexact.apps.cli.main import main

PROBLEMS = problems() | problems("more_design_problems.json")


def answered(problem: Json, folder: Path, *options: str) -> tuple[int, Json]:
    """Exit code and answer of the command; the answer is the only line of stdout."""
    # What is expected is no part of a problem, nor where it is from.
    asked = {key: value for key, value in problem.items() if key not in ("expect", "source")}
    (path := folder / "problem.json").write_text(json.dumps(asked), encoding="utf-8")
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        code = main(["design", str(path), "--json", *options])
    lines = printed.getvalue().splitlines()
    assert lines, "nothing is printed"
    return code, json.loads(lines[0])


def wrong(problem: Json, folder: Path, *options: str) -> list[str]:
    """What is wrong with the answer of the command to a problem."""
    code, answer = answered(problem, folder, *options)
    found = list(design_oracle.judge(problem, answer))
    if code != (0 if answer["layouts"] else 1):
        found.append(f"the exit code is {code} with {len(answer['layouts'])} layouts")
    return found


@pytest.mark.dear(4)
@pytest.mark.parametrize("name", PROBLEMS)
def test_the_answer_to_a_problem_holds(name: str, tmp_path: Path) -> None:
    assert wrong(PROBLEMS[name], tmp_path) == []


WAYS = {
    "turned and shifted": (np.eye(3)[[2, 0, 1]], np.array([0.5, -0.25, 1.0]), 1.0),
    "mirrored": (np.diag([-1.0, 1.0, 1.0]), np.zeros(3), 1.0),
    "a thousand times as large": (np.eye(3), np.zeros(3), 1e3),
    "a thousandth": (np.eye(3)[[1, 0, 2]], np.zeros(3), 1e-3),
}


@pytest.mark.dear(1)
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", ["hinge", "screw", "three_skew_rotations", "guide_folded"])
def test_a_moved_problem_has_the_same_layouts(name: str, way: str, tmp_path: Path) -> None:
    problem = PROBLEMS[name]
    _, here = answered(problem, tmp_path)
    _, there = answered(design_oracle.moved(problem, *WAYS[way]), tmp_path)
    assert design_oracle.correspond(problem, here, there, WAYS[way]) == []


RANDOM = list(random_freedoms.problems(2 * len(random_freedoms.FREEDOMS)))


@pytest.mark.dear(3)
@pytest.mark.parametrize("problem", RANDOM, ids=lambda problem: str(problem["id"]))
def test_the_answer_to_a_random_freedom_holds(problem: Json, tmp_path: Path) -> None:
    """In free space every freedom has a layout, and one in parallel turns little with errors."""
    code, answer = answered(problem, tmp_path, "-n", "2")
    assert code == 0
    assert design_oracle.judge(problem, answer) == []
    if problem["expect"]["parallel_wires"]:
        layout = answer["layouts"][0]["flexures"]
        values = design_oracle.turns_with_errors(problem, layout)
        assert not values or min(values) <= 1 / 0.05


@pytest.mark.nightly
def test_the_answers_to_a_thousand_random_freedoms_hold(tmp_path: Path) -> None:
    found = {}
    for problem in random_freedoms.problems(1000, seed=1):
        if said := wrong(problem, tmp_path, "-n", "1"):
            found[problem["id"], problem["title"]] = said
    assert not found
