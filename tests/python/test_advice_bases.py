# SPDX-License-Identifier: BSD-3-Clause
"""How many sets of rows are bases: matroids of which the number is known in closed form."""

import math
from itertools import combinations

import numpy as np
import pytest

from flexact.advice.releases.matroid import Rows, TooManyError, count_bases, echelon_of

Edges = list[tuple[int, int]]
ERROR = 1.0e-15


def never(rows: Rows) -> bool:
    raise AssertionError(f"asked about {sorted(rows)}")


def orthonormal(rows: np.ndarray) -> np.ndarray:
    return np.linalg.qr(rows)[0]


def of_graph(vertices: int, edges: Edges) -> np.ndarray:
    """Rows of the edges: their bases are the spanning trees."""
    rows = np.zeros((len(edges), vertices))
    for k, (i, j) in enumerate(edges):
        rows[k, i], rows[k, j] = 1.0, -1.0
    return orthonormal(rows[:, 1:])


@pytest.mark.parametrize(("size", "count"), [(9, 1), (12, 2), (30, 3), (16, 5), (8, 7), (5, 5)])
def test_of_rows_in_general_position_every_set_is_a_basis(size: int, count: int) -> None:
    """A uniform matroid has as many bases as there are sets."""
    rows = np.random.default_rng(size).normal(size=(size, count))
    assert count_bases(orthonormal(rows), ERROR, never) == math.comb(size, count)


@pytest.mark.parametrize("n", [3, 4, 5, 6, 7])
def test_complete_graphs_have_as_many_trees_as_cayley_says(n: int) -> None:
    """A. Cayley, A theorem on trees, 1889: n^(n - 2)."""
    edges = list(combinations(range(n), 2))
    assert count_bases(of_graph(n, edges), ERROR, never) == n ** (n - 2)


@pytest.mark.parametrize(("m", "n"), [(2, 5), (3, 4), (4, 4)])
def test_complete_bipartite_graphs_have_as_many_trees_as_is_known(m: int, n: int) -> None:
    """m^(n - 1) n^(m - 1): M. Fiedler and J. Sedlacek, 1958."""
    edges = [(i, m + j) for i in range(m) for j in range(n)]
    assert count_bases(of_graph(m + n, edges), ERROR, never) == m ** (n - 1) * n ** (m - 1)


def test_what_does_not_hang_together_is_multiplied_however_much_it_is() -> None:
    """Forty triangles: each has three trees. Parallel and serial edges need no search either."""
    edges = [(2 * k, 2 * k + 1) for k in range(40)]
    edges += [(2 * k + 1, 2 * k + 2) for k in range(40)]
    edges += [(2 * k + 2, 2 * k) for k in range(40)]
    assert count_bases(of_graph(81, edges), ERROR, never) == 3**40
    # Two vertices with 50 double paths between them: one path whole, of the others one edge.
    edges = [(0, 2 + k) for k in range(50)] + [(2 + k, 1) for k in range(50)]
    assert count_bases(of_graph(52, edges), ERROR, never) == 50 * 2**49


def test_loops_and_coloops_are_in_none_and_in_all() -> None:
    rows = np.zeros((7, 2))
    rows[0] = (1.0, 0.0)
    rows[1:4, 1] = (1.0, 2.0, -1.0)
    assert count_bases(orthonormal(rows), ERROR, never) == 3
    assert count_bases(np.zeros((4, 1)), ERROR, never) == 0
    assert count_bases(np.zeros((1, 2)), ERROR, never) == 0
    assert count_bases(np.eye(3), ERROR, never) == 1


def test_rows_of_small_whole_numbers_are_counted_as_their_determinants_say() -> None:
    """Blocks of whole numbers: a determinant that is not zero is one at least."""
    random = np.random.default_rng(3)
    counted = 0
    for _ in range(120):
        count = int(random.integers(1, 5))
        rows = random.integers(-2, 3, size=(int(random.integers(count, 10)), count)).astype(float)
        if np.linalg.matrix_rank(rows) < count:
            continue
        regular = (np.linalg.det(rows[list(s)]) for s in combinations(range(len(rows)), count))
        assert count_bases(orthonormal(rows), ERROR, never) == sum(abs(d) > 0.5 for d in regular)
        counted += 1
    assert counted > 80


@pytest.mark.parametrize("truth", [False, True])
def test_what_the_numbers_leave_in_doubt_is_asked_for(truth: bool) -> None:
    """An entry of 1e-7 where rounding makes 1e-15 is too small to be plain."""
    asked: list[Rows] = []

    def judge(rows: Rows) -> bool:
        asked.append(rows)
        return truth

    rows = orthonormal(np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 1.0e-7]]))
    assert count_bases(rows, ERROR, judge) == 5 + truth
    assert set(asked) == {frozenset({0, 3})}


def test_the_block_of_an_echelon_form_is_well_conditioned() -> None:
    rows = orthonormal(np.random.default_rng(5).normal(size=(40, 6)))
    form = echelon_of(rows)
    assert form is not None
    assert np.abs(form.factor).max() <= 1.01
    assert np.allclose(form.factor.T @ rows[form.basis], rows[form.others])
    # Blocks of which no exchange makes the determinant larger: Goreinov et al., 1997.
    assert form.smallest > 1.0 / math.sqrt(1 + 1.01**2 * 6 * 34)


def test_more_than_can_be_counted_is_refused() -> None:
    rows = np.random.default_rng(7).normal(size=(60, 20))
    with pytest.raises(TooManyError):
        count_bases(orthonormal(rows), ERROR, lambda _: True)
