# SPDX-License-Identifier: BSD-3-Clause
"""What the benchmarks hold for true of their families, at sizes that numpy can decompose."""

from __future__ import annotations

import importlib
import itertools
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
families = importlib.import_module("families")
matrix = importlib.import_module("matrix")
exact_rank = importlib.import_module("exact_rank")

KNOWN = ("T", "O", "B", "C", "Bx")
SIZES = (110, 400)


def rank_by_svd(case) -> int:
    """Rank of D(c) by numpy, where a wide gap leaves no doubt."""
    values = np.linalg.svd(matrix.scaled_jacobian(case.model).toarray(), compute_uv=False)
    rank = int(np.count_nonzero(values > 1e-7 * values[0]))
    assert not np.any(values[rank:] > 1e-13 * values[0])
    return rank


@pytest.mark.parametrize("letter", KNOWN)
@pytest.mark.parametrize("columns", SIZES)
def test_counts_are_those_of_a_decomposition(letter: str, columns: int) -> None:
    case = families.FAMILIES[letter](columns)
    rank = rank_by_svd(case)
    assert (case.motions, case.stresses) == (case.columns - rank, case.rows - rank)


@pytest.mark.parametrize("letter", families.FAMILIES)
def test_a_model_is_sound_and_of_the_size_asked_for(letter: str) -> None:
    case = families.FAMILIES[letter](20_000)
    case.model.check()
    assert not case.model.diagnostics
    assert case.columns == pytest.approx(20_000, rel=0.15)


@pytest.mark.parametrize("letter", KNOWN)
def test_maxwells_count_holds_at_any_size(letter: str) -> None:
    case = families.FAMILIES[letter](20_000)
    assert case.motions - case.stresses == case.columns - case.rows


def test_the_ill_conditioned_array_deteriorates_exponentially() -> None:
    """A row of stages more takes about the same factor off the smallest singular value."""
    smallest = []
    for side in (2, 3, 4, 5):
        case = families.ill_conditioned(42 * side**2)
        full = matrix.scaled_jacobian(case.model).toarray()
        smallest.append(np.linalg.svd(full, compute_uv=False)[-1])
    assert all(after < before / 3 for before, after in itertools.pairwise(smallest))


@pytest.mark.parametrize("letter", ("T", "O", "Tb"))
def test_the_rank_modulo_a_prime_is_that_of_a_decomposition(letter: str) -> None:
    case = families.FAMILIES[letter](300)
    full = matrix.scaled_jacobian(case.model).toarray()
    assert exact_rank.rank_of_bars(case.model) == np.linalg.matrix_rank(full, tol=1e-10)


def test_the_rank_modulo_a_prime_sees_what_lies_beyond_doubles() -> None:
    """Two bars whose directions differ by less than doubles of their products can tell."""
    model = families.two_bars(0.3, np.nextafter(0.3, 1.0))
    assert exact_rank.rank_of_bars(model) == 2
    assert exact_rank.rank_of_bars(families.two_bars(0.3, 0.3)) == 1
