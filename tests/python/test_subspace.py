# SPDX-License-Identifier: BSD-3-Clause
"""Subspaces of sparse vectors against the same by dense matrices."""

from __future__ import annotations

import numpy as np
import pytest

from flexact.analysis import sparse_basis as subspace
from flexact.analysis.sparse_basis import (
    Sparse,
    norms_of_product,
    orthonormal,
    row_norms,
    support_of,
)
from flexact.apps.checks.comparison import fixed_vectors, project
from flexact.core.arrays import Basis, FloatArray

SIZE = 60


def groups_of_vectors() -> FloatArray:
    """(SIZE, 9): one vector alone, two groups of two of one shape, and a chain of four."""
    rng = np.random.default_rng(4)
    made = np.zeros((SIZE, 9))
    places = (
        *((0, 4), (10, 13), (11, 14), (20, 23), (21, 24)),
        *((30, 35), (34, 40), (39, 44), (43, 50)),
    )
    for k, (first, last) in enumerate(places):
        made[first:last, k] = rng.standard_normal(last - first)
    shuffled: FloatArray = made[:, rng.permutation(9)]
    return shuffled


def weights() -> FloatArray:
    return np.random.default_rng(5).uniform(0.1, 10.0, SIZE)


@pytest.fixture(params=[20_000_000, 20], ids=["together", "by groups"])
def room(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Room for all vectors together, or for a group at a time."""
    monkeypatch.setattr(subspace, "_MOST_ENTRIES", request.param)


@pytest.mark.usefixtures("room")
def test_basis_is_orthonormal_and_spans_the_weighted_space() -> None:
    # The chain of four has 20 rows, too many to be held; it is looked at below.
    vectors = groups_of_vectors()
    vectors = vectors[:, ~vectors[30:].any(axis=0)]
    made = orthonormal(Basis.of_dense(vectors), weights())
    q = made.toarray()
    assert np.abs(q.T @ q - np.eye(5)).max() < 1e-14
    wanted = np.linalg.qr(weights()[:, None] * vectors)[0]
    assert np.abs(q @ q.T - wanted @ wanted.T).max() < 1e-14
    assert row_norms(made) == pytest.approx(np.linalg.norm(wanted, axis=1), abs=1e-14)
    assert made.place.dtype == np.int32


def test_groups_are_made_orthonormal_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subspace, "_MOST_ENTRIES", 80)
    vectors = groups_of_vectors()
    q = orthonormal(Basis.of_dense(vectors), weights()).toarray()
    wanted = np.linalg.qr(weights()[:, None] * vectors)[0]
    assert np.abs(q @ q.T - wanted @ wanted.T).max() < 1e-13
    group = np.arange(SIZE) // 10
    group[group == 4] = 3
    assert all(np.unique(group[np.flatnonzero(column)]).size == 1 for column in q.T)


def test_a_group_that_is_too_large_keeps_its_vectors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subspace, "_MOST_ENTRIES", 10)
    vectors = groups_of_vectors()
    made = orthonormal(Basis.of_dense(vectors), weights())
    assert np.linalg.norm(made.toarray(), axis=0) == pytest.approx(np.ones(9), rel=1e-14)
    reached = np.flatnonzero(vectors.any(axis=1))
    assert np.array_equal(np.flatnonzero(row_norms(made)), reached)
    assert np.array_equal(support_of(made), reached)


@pytest.mark.parametrize("one_by_one", [64, 0])
@pytest.mark.parametrize("at_once", [1, 7, 10_000])
def test_norms_of_a_product(one_by_one: int, at_once: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subspace, "_ONE_BY_ONE", one_by_one)
    monkeypatch.setattr(subspace, "_TERMS_AT_ONCE", at_once)
    rng = np.random.default_rng(6)
    rows, columns = rng.integers(0, 30, 200), rng.integers(0, SIZE, 200)
    matrix = Sparse(rows, columns, rng.standard_normal(200), 31)
    full = np.zeros((31, SIZE))
    np.add.at(full, (rows, columns), matrix.value)
    wanted = np.linalg.norm(full @ groups_of_vectors(), axis=1)
    found = norms_of_product(matrix, Basis.of_dense(groups_of_vectors()))
    assert found == pytest.approx(wanted, rel=1e-13, abs=1e-14)


def test_of_a_product_that_takes_too_long_the_first_vectors_are_taken(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(subspace, "_ONE_BY_ONE", 0)
    vectors = groups_of_vectors()
    terms = np.cumsum(np.count_nonzero(vectors, axis=0))
    monkeypatch.setattr(subspace, "_MOST_TERMS", int(terms[3]))
    unit = Sparse(np.arange(SIZE), np.arange(SIZE), np.ones(SIZE), SIZE)
    found = norms_of_product(unit, Basis.of_dense(vectors))
    assert found == pytest.approx(np.linalg.norm(vectors[:, :4], axis=1), rel=1e-14)


def test_projection_needs_no_orthonormal_basis() -> None:
    vectors = groups_of_vectors()
    given = fixed_vectors([f"{k}:x" for k in range(SIZE)])
    q = np.linalg.qr(vectors)[0]
    found = project(Basis.of_dense(vectors), given)
    assert np.abs(found - q @ (q.T @ given)).max() < 1e-12


def test_fixed_vectors_follow_from_the_labels() -> None:
    both, one = fixed_vectors(["1:x", "2:x"]), fixed_vectors(["2:x"])
    assert np.array_equal(both[1], one[0])
    assert np.abs(both).max() <= 1.0 and np.unique(both).size == both.size
