# SPDX-License-Identifier: BSD-3-Clause
"""D(c) of one row, of one column, empty, all zero, or with thousands of equal values."""

import itertools

import numpy as np
import pytest
from verdicts import METHODS, assert_all_right, assert_right, counts

from flexact import Analysis, Model, analyse

pytestmark = pytest.mark.dear(6)


def assert_modes_are_sound(analysis: Analysis) -> None:
    """Orthonormal bases of the right size that D(c) and its transpose send to zero."""
    matrix = analysis.dense_jacobian()
    for modes, map_ in ((analysis.motions, matrix), (analysis.self_stresses, matrix.T)):
        vectors = np.array([mode.vector for mode in modes]).reshape(len(modes), map_.shape[1])
        np.testing.assert_allclose(map_ @ vectors.T, 0.0, atol=1e-13)
    assert (len(analysis.motions), len(analysis.self_stresses)) == counts(analysis)


def star(directions: np.ndarray, *held: str) -> Model:
    """A joint on bars along unit directions, some of its coordinates fixed."""
    model = Model()
    joint = model.node(0, 0, 0)
    for direction in directions:
        end = model.node(*direction)
        model.truss(joint, end)
        model.fix(end)
    model.fix(joint, *held)
    return model


def test_one_row() -> None:
    """A bar that nothing holds: six coordinates, one constraint."""
    model = Model()
    model.truss(model.node(0, 0, 0), model.node(1, 2, 2))
    for method in METHODS:
        analysis = analyse(model, method=method)
        assert (analysis.rows, analysis.columns) == (1, 6)
        assert_right(analysis, (5, 0))
        assert_modes_are_sound(analysis)
        np.testing.assert_allclose(analysis.singular_values, [np.sqrt(2)], rtol=1e-15)


@pytest.mark.parametrize("bars", [1, 2, 7, 60])
def test_one_column(bars: int) -> None:
    """Each bar after the first is one too many; the value is the root of sum cos**2."""
    angle = np.linspace(0.1, 1.4, bars)
    directions = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(bars)])
    model = star(directions, "y", "z")
    for method in METHODS:
        analysis = analyse(model, method=method)
        assert (analysis.rows, analysis.columns) == (bars, 1)
        assert_right(analysis, (0, bars - 1))
        assert_modes_are_sound(analysis)
        expected = np.linalg.norm(np.cos(angle))
        np.testing.assert_allclose(analysis.singular_values, [expected], rtol=1e-14)


@pytest.mark.parametrize("bars", [1, 2, 50])
def test_all_zero(bars: int) -> None:
    """A joint free to move across all its bars: a zero column."""
    angle = np.linspace(0.0, 3.0, bars)
    model = star(np.column_stack([np.cos(angle), np.sin(angle), np.zeros(bars)]), "x", "y")
    for method in METHODS:
        analysis = analyse(model, method=method)
        assert_right(analysis, (1, bars))
        assert_modes_are_sound(analysis)
        assert not analysis.singular_values.any()
        assert analysis.gap.smallest_nonzero is None


def test_no_columns() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.beam(a, b)
    model.fix(a)
    model.fix(b)
    assert_all_right(model, (0, 6))
    assert_modes_are_sound(analyse(model, method="sparse"))


def test_no_rows() -> None:
    """A beam that holds nothing: twelve motions of its ends."""
    model = Model()
    model.beam(model.node(0, 0, 0), model.node(1, 0, 0), release=range(1, 7))
    assert_all_right(model, (12, 0))
    for method in METHODS:
        assert_modes_are_sound(analyse(model, method=method))


def test_neither_rows_nor_columns() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.beam(a, b, release=range(1, 7))
    model.fix(a)
    model.fix(b)
    assert_all_right(model, (0, 0))
    for method in METHODS:
        analysis = analyse(model, method=method)
        assert (analysis.rows, analysis.columns) == (0, 0)
        assert analysis.describe() and analysis.to_json()


# Thousands of equal singular values


def posts(number: int, free: tuple[str, ...]) -> Model:
    """Separate bars of length one along x, each with some coordinates of its top free."""
    model = Model()
    for k in range(number):
        foot, top = model.node(0, 2 * k, 0), model.node(1, 2 * k, 0)
        model.truss(foot, top)
        model.fix(foot)
        held = [axis for axis in "xyz" if axis not in free]
        if held:
            model.fix(top, *held)
    return model


@pytest.mark.parametrize("method", ["sparse", "auto"])
@pytest.mark.parametrize("number", [10, 3000])
def test_equal_values_that_are_not_zero(method: str, number: int) -> None:
    """D(c) is the identity."""
    analysis = analyse(posts(number, ("x",)), method=method)
    assert_right(analysis, (0, 0))
    assert analysis.components == number
    for values in (analysis.singular_values, analysis.scaled_singular_values):
        np.testing.assert_allclose(values / values[0], 1.0, rtol=1e-15)
    assert analysis.gap.largest_zero is None


@pytest.mark.parametrize("method", ["sparse", "auto"])
@pytest.mark.parametrize("number", [10, 3000])
def test_equal_values_all_of_them_zero(method: str, number: int) -> None:
    """Each top moves across its bar, which is a self-stress."""
    analysis = analyse(posts(number, ("y",)), method=method)
    assert_right(analysis, (number, number))
    assert not analysis.singular_values.any()
    assert analysis.gap.smallest_nonzero is None


@pytest.mark.parametrize("method", ["sparse", "auto"])
def test_thousands_of_motions_and_equal_values(method: str) -> None:
    analysis = analyse(posts(3000, ("x", "y", "z")), method=method)
    assert_right(analysis, (6000, 0))
    assert analysis.gap.smallest_nonzero == pytest.approx(analysis.scaled_singular_values[0])


@pytest.mark.parametrize("method", METHODS)
def test_equal_values_within_one_part(method: str) -> None:
    """Bars along y in a row from a wall, in n = 200 joints that may move along y alone: the
    values are 2 sin((2 k - 1) pi / (4 n + 2)), from the eigenvalues of a chain with one end held.
    """
    number = 200
    model = Model(planar=True)
    joints = [model.node(0, k) for k in range(number + 1)]
    model.fix(joints[0])
    for before, after in itertools.pairwise(joints):
        model.truss(before, after)
        model.fix(after, "x")
    analysis = analyse(model, method=method)
    assert_right(analysis, (0, 0))
    k = np.arange(1, number + 1)
    expected = 2 * np.sin((2 * k - 1) * np.pi / (4 * number + 2))
    given = analysis.singular_values
    np.testing.assert_allclose(given[::-1], expected[: given.size], rtol=1e-8)


# Many times as long as wide, where a square of the longer side would not fit


@pytest.mark.parametrize("method", METHODS)
def test_a_joint_on_thousands_of_bars(method: str) -> None:
    """Three of them hold it."""
    bars = 20_000
    model = Model()
    joint = model.node(0, 0, 0)
    for direction in np.random.default_rng(1).standard_normal((bars, 3)):
        end = model.node(*direction)
        model.truss(joint, end)
        model.fix(end)
    analysis = analyse(model, method=method)
    assert_right(analysis, (0, bars - 3))
    assert analysis.raw.stresses.value.size <= 4 * bars
    assert analysis.describe() and len(analysis.to_json()) < 1000 * bars


@pytest.mark.parametrize("method", METHODS)
def test_thousands_of_bars_between_two_nodes(method: str) -> None:
    """All but one are too many, and each can be pulled against the first."""
    bars = 20_000
    model = Model()
    ends = model.node(0, 0, 0), model.node(1, 2, 2)
    for _ in range(bars):
        model.truss(*ends)
    analysis = analyse(model, method=method)
    assert_right(analysis, (5, bars - 1))
    assert analysis.raw.stresses.value.size <= 2 * bars
    assert analysis.describe() and len(analysis.to_json()) < 1000 * bars


@pytest.mark.parametrize("method", ["auto", "sparse"])
def test_thousands_of_free_joints_on_one(method: str) -> None:
    """Each bar takes one of the coordinates: neither D'D nor DD' may fill."""
    bars = 20_000
    model = Model()
    hub = model.node(0, 0, 0)
    for direction in np.random.default_rng(1).standard_normal((bars, 3)):
        model.truss(hub, model.node(*direction))
    analysis = analyse(model, method=method)
    assert_right(analysis, (2 * bars + 3, 0))
    assert len(analysis.motions) == 2 * bars + 3
    assert analysis.describe() and len(analysis.to_json()) < 2000 * bars
