# SPDX-License-Identifier: BSD-3-Clause
"""Random freedoms: what is known of their kinds is what drawing their lines gives."""

from collections import Counter

import numpy as np
import pytest
from design_answers_by_hand import Json, design_classes, design_oracle, random_freedoms

COUNT = len(random_freedoms.FREEDOMS)


def differences(problem: Json) -> list[str]:
    own = design_oracle.classify(design_oracle.freedom(problem))
    expected = problem["expect"]
    return [key for key in own.keys() & expected.keys() if own[key] != expected[key]]


@pytest.mark.parametrize(
    "problem", list(random_freedoms.problems(COUNT)), ids=lambda problem: str(problem["title"])
)
def test_a_kind_is_known(problem: Json) -> None:
    assert differences(problem) == []


@pytest.mark.nightly
def test_a_thousand_are_known() -> None:
    assert [p["id"] for p in random_freedoms.problems(1000) if differences(p)] == []


def test_kinds_are_those_of_the_charts() -> None:
    """3 of one dimension, 10 of two, 22 of three; 26 are in parallel (FACT)."""
    problems = list(random_freedoms.problems(COUNT))
    dimensions = Counter(problem["expect"]["dimension"] for problem in problems)
    assert dimensions == {0: 1, 1: 3, 2: 10, 3: 22, 4: 10, 5: 3}
    assert sum(problem["expect"]["parallel_wires"] for problem in problems) == 26


def test_the_same_seed_draws_the_same() -> None:
    first, second = (list(random_freedoms.problems(5, seed=2)) for _ in range(2))
    assert first == second


def test_a_written_motion_is_the_twist() -> None:
    random = np.random.default_rng(3)
    for _ in range(20):
        row = random.normal(size=6)
        back = design_classes.twist(random_freedoms.written(row), np.zeros(3))
        scaled = back * np.repeat([random_freedoms.SIZE, 1.0], 3)
        assert np.linalg.matrix_rank(np.array([row, scaled]), tol=1e-10) == 1
