# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms close to a change of verdict: the truth is among the answers, by every method.

The answers are the counts given and, where they are not certain, those that hold if what is in
doubt is zero. Where no double can tell, `BEYOND` keeps the truth and what is answered instead.

Truths hold by construction; ranks of bars are counted in exact arithmetic besides
(tests/benchmarks/exact_rank.py), and the smallest singular values with 60 digits.
"""

import importlib
import itertools
import math
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest
from ill_conditioned_models import levers, spokes, two_fold_lines, two_wire_flexures, two_wires
from reference_decks import text_of, transform
from verdicts import (
    DENSE,
    METHODS,
    Counts,
    assert_all_right,
    assert_right,
    assert_right_or_nearly,
    never_wrong,
)

from flexact import Analysis, Model, analyse, read_text

pytestmark = pytest.mark.dear(100)

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
families: Any = importlib.import_module("families")
exact_rank: Any = importlib.import_module("exact_rank")

# Two constraints at an angle


@pytest.mark.parametrize("power", range(1, 19))
@pytest.mark.parametrize(
    ("make", "truth"), [(two_wires, (0, 0)), (two_wire_flexures, (4, 0))], ids=["bars", "wires"]
)
def test_two_wires_at_an_angle(make: Any, truth: tuple[int, int], power: int) -> None:
    """The coordinates are typed: 1e-16 is no rounding of zero."""
    for method in METHODS:
        analysis = never_wrong(analyse(make(10.0**-power), method=method), truth)
        if power <= 13:
            assert_right_or_nearly(analysis, truth)
        if power <= 11:
            assert_right(analysis, truth)


@pytest.mark.parametrize("power", range(1, 15))
def test_two_fold_lines_at_an_angle(power: int) -> None:
    """Down to singular values of 2e-15, which the stored coordinates hold to a few bits."""
    for method in METHODS:
        analysis = never_wrong(analyse(two_fold_lines(10.0**-power), method=method), (6, 0))
        if power <= 13:
            assert_right_or_nearly(analysis, (6, 0))
        if power <= 11:
            assert_right(analysis, (6, 0))


def test_two_constraints_at_no_angle() -> None:
    """They lose one constraint to a self-stress, and certainly so."""
    for method in METHODS:
        assert_right(analyse(two_fold_lines(0.0), method=method), (7, 1))


def test_smallest_value_of_two_fold_lines_is_proportional_to_their_angle() -> None:
    """tests/reference/known_answers.md, Numerics: full rank down to where doubles end."""
    ratios = []
    for power in range(2, 13):
        values = analyse(two_fold_lines(10.0**-power), method="jacobi").singular_values
        ratios.append(values[-1] / values[0] * 10.0**power)
    np.testing.assert_allclose(ratios, ratios[0], rtol=1e-4)


# The smallest singular value by jacobi, against 60 digits


def assert_smallest_value_is_exact(analysis: Analysis, ratio: float) -> None:
    """To 1e-13, of the matrix as it is stored; sigma/sigma_1 is below `ratio`.

    The largest singular value of the inverse, by iteration from numpy's vector.
    """
    matrix = analysis.dense_jacobian()
    with mpmath.workdps(60):
        inverse = np.array((mpmath.matrix(matrix) ** -1).tolist())
        vector = np.array([mpmath.mpf(part) for part in np.linalg.svd(matrix)[0][:, -1]])
        value, before = mpmath.mpf(1), mpmath.mpf(0)
        while abs(value - before) > mpmath.mpf(10) ** -20 * value:
            image = inverse @ vector
            value, before = mpmath.sqrt(image @ image), value
            vector = inverse.T @ image
            vector = vector / mpmath.sqrt(vector @ vector)
        assert 1 / value < ratio * analysis.singular_values[0]
        assert abs(analysis.singular_values[-1] * value - 1) <= 1e-13


@pytest.mark.parametrize("power", range(1, 12))
@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
def test_smallest_value_of_two_wires_by_jacobi(power: int, unit: float) -> None:
    analysis = analyse(two_wires(10.0**-power, unit), method="jacobi")
    with mpmath.workdps(60):
        (a, b), (c, d) = mpmath.matrix(analysis.dense_jacobian()).tolist()
        square, determinant = a * a + b * b + c * c + d * d, a * d - b * c
        root = mpmath.sqrt(square**2 - 4 * determinant**2)
        largest = mpmath.sqrt((square + root) / 2)
        smallest = abs(determinant) / largest
        assert smallest < 0.6 * 10.0**-power * largest
        assert abs(analysis.singular_values[-1] / smallest - 1) <= 1e-13
        assert abs(analysis.singular_values[0] / largest - 1) <= 1e-13


@pytest.mark.parametrize("factor", [1e-9, 1e-6, 1e-3, 1.0, 1e3])
def test_smallest_value_of_folded_sheets_by_jacobi(factor: float) -> None:
    """The paper's five, D(c) of 35 x 35 in metres, whose columns have several units."""
    text = transform.scaled(text_of("paper/five_folded_sheets"), factor)
    analysis = analyse(read_text(text), method="jacobi")
    assert (analysis.rows, analysis.columns) == (35, 35)
    assert_smallest_value_is_exact(analysis, min(0.5, 40 * factor, 40 / factor))


@pytest.mark.parametrize("number", [3, 6, 9, 11])
def test_smallest_value_of_levers_by_jacobi(number: int) -> None:
    analysis = analyse(levers(number, 10.0), method="jacobi")
    assert_smallest_value_is_exact(analysis, 30 * 10.0**-number)


# A conditioning that grows exponentially


@pytest.mark.parametrize("ratio", [2.0, 4.0, 10.0])
@pytest.mark.parametrize("power", range(1, 15))
def test_levers_that_amplify_are_right_or_nearly(ratio: float, power: int) -> None:
    """(0, 0), until the smallest singular value is some 1e-15 of the largest."""
    number = math.ceil(power / math.log10(ratio))
    model = levers(number, ratio)
    assert exact_rank.rank_of_bars(model) == 2 * number
    for method in METHODS:
        analysis = never_wrong(analyse(model, method=method), (0, 0))
        if power <= 12:
            assert_right_or_nearly(analysis, (0, 0))
        if power <= 9 and method in ("svd", "jacobi"):
            assert_right(analysis, (0, 0))


LONG_LEVERS = [(100, 2.0), (60, 4.0), (20, 10.0), (40, 10.0), (30, 300.0), (12, 1e4)]


@pytest.mark.parametrize(("number", "ratio"), LONG_LEVERS)
def test_levers_that_amplify_beyond_the_doubles_are_right_or_nearly(
    number: int, ratio: float
) -> None:
    """Their determinant is not zero, though their smallest singular value is below 1e-19."""
    model = levers(number, ratio)
    assert exact_rank.rank_of_bars(model) == 2 * number
    for method in METHODS:
        never_wrong(analyse(model, method=method), (0, 0))
        assert_right_or_nearly(analyse(model, method=method), (0, 0))


@pytest.mark.parametrize("arm", [1.6, 1.1, 1.01])
@pytest.mark.parametrize("side", [2, 3, 4])
def test_amplifying_stages_are_right_or_nearly(arm: float, side: int) -> None:
    case = families.ill_conditioned(42 * side**2, arm=arm)
    for method in METHODS:
        assert_right_or_nearly(analyse(case.model, method=method), (0, 0))


def many_stages(arm: float, side: int) -> Model:
    """Singular values that vanish beside the rounding: still no motion in truth."""
    model: Model = families.ill_conditioned(42 * side**2, arm=arm).model
    return model


def test_many_amplifying_stages_are_right_or_nearly() -> None:
    assert_right_or_nearly(analyse(many_stages(1.6, 10), method="sparse"), (0, 0))


@pytest.mark.parametrize(("arm", "side"), [(1.6, 16), (1.1, 20), (1.01, 14)])
def test_very_many_amplifying_stages_are_not_certain(arm: float, side: int) -> None:
    never_wrong(analyse(many_stages(arm, side), method="sparse"), (0, 0))


@pytest.mark.parametrize("beams", [100, 300, 1000])
def test_long_strips_are_right(beams: int) -> None:
    """A braced strip, held at one end: its stiffness falls with a power of its length."""
    model = Model(planar=True)
    low = [model.node(k, 0) for k in range(beams)]
    high = [model.node(k, 1) for k in range(beams)]
    for k in range(1, beams):
        model.truss(low[k], high[k])
        model.truss(low[k - 1], low[k])
        model.truss(high[k - 1], high[k])
        model.truss(low[k - 1], high[k])
    model.fix(low[0])
    model.fix(high[0])
    for method in ("sparse", "auto", *(DENSE if beams == 100 else ())):
        assert_right(analyse(model, method=method), (0, 0))


# Matrices with a name


def laeuchli(power: int) -> Model:
    mu = 10.0**-power
    return spokes(np.array([[1.0, 0.0, 0.0], [1.0, mu, 0.0], [1.0, 0.0, mu], [1.0, mu, mu]]))


@pytest.mark.parametrize("power", range(1, 19))
def test_laeuchli_as_spokes(power: int) -> None:
    """Rows that agree but for mu, in one joint: three constraints, any more are over."""
    model = laeuchli(power)
    assert exact_rank.rank_of_bars(model) == 3
    for method in METHODS:
        analysis = never_wrong(analyse(model, method=method), (0, 1))
        if power <= 13:
            assert_right_or_nearly(analysis, (0, 1))
        if power <= 11:
            assert_right(analysis, (0, 1))


def test_graded_rows_of_rank_two() -> None:
    """[1 2 3; 4 5 6; 7 8 9] with rows times any powers of ten is of rank 2
    (tests/reference/known_answers.md, Numerics).
    """
    rows = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]])
    for power in range(16):
        graded = rows * np.array([[1.0], [10.0**-power], [10.0**power]])
        for method in METHODS:
            assert_right_or_nearly(analyse(spokes(graded), method=method), (1, 1))


# Bars taken out at random: many are nearly singular


def residuals(analysis: Analysis) -> tuple[float, float]:
    """Largest |D v| of the motions and |D' v| of the self-stresses, all of unit length."""
    matrix = analysis.dense_jacobian()
    right = (float(np.linalg.norm(matrix @ motion.vector)) for motion in analysis.motions)
    left = (float(np.linalg.norm(stress.vector @ matrix)) for stress in analysis.self_stresses)
    return max(right, default=0.0), max(left, default=0.0)


@pytest.mark.nightly
@pytest.mark.parametrize("columns", [100, 200, 400, 800])
def test_random_removal_is_right_or_nearly(columns: int) -> None:
    for seed in range(1, 6):
        case = families.random_removal(columns, seed)
        rank = exact_rank.rank_of_bars(case.model)
        truth = (case.columns - rank, case.rows - rank)
        for method in (*DENSE, "sparse") if columns < 400 else ("sparse", "auto"):
            analysis = analyse(case.model, method=method)
            assert_right_or_nearly(analysis, truth)
            assert max(residuals(analysis)) <= 1e-10, (seed, method, residuals(analysis))


def test_random_removal_at_three_thousand_columns() -> None:
    case = families.random_removal(3000)
    rank = exact_rank.rank_of_bars(case.model)
    analysis = analyse(case.model, method="sparse")
    assert_right_or_nearly(analysis, (case.columns - rank, case.rows - rank))
    assert max(residuals(analysis)) <= 1e-10


def test_a_nearly_flat_framework() -> None:
    """Narrow, and t must be raised where its pins then no longer suffice. The counts are those of
    the decompositions of the whole matrix.
    """
    random = np.random.default_rng(1)
    places = random.uniform(-1, 1, (34, 3)) * (1, 1, 1e-6)
    model = Model()
    nodes = [model.node(*place) for place in places]
    pairs = [(i, j) for i in range(34) for j in range(i)]
    for k in random.permutation(len(pairs))[: 3 * 34 - 6]:
        model.truss(*(nodes[i] for i in pairs[k]))
    model.fix(nodes[0])
    assert_all_right(model, (9, 6))


@pytest.mark.parametrize("letter", ["T", "O", "B", "C"])
@pytest.mark.parametrize("columns", [110, 1000])
def test_families_are_right_with_small_residuals(letter: str, columns: int) -> None:
    case = families.FAMILIES[letter](columns)
    for method in ("sparse", "auto", *(DENSE if columns < 200 else ())):
        analysis = analyse(case.model, method=method)
        assert_right(analysis, (case.motions, case.stresses))
        assert max(residuals(analysis)) <= 1e-10


def test_the_smallest_values_fall_as_they_should() -> None:
    """Each lever takes its ratio off the smallest singular value."""
    smallest = [
        analyse(levers(number, 4.0), method="jacobi").singular_values[-1] for number in range(4, 18)
    ]
    for before, after in itertools.pairwise(smallest):
        assert after == pytest.approx(before / 4, rel=0.05)


# Beyond what doubles can tell

BEYOND: dict[str, tuple[Callable[[], Model], Counts]] = {
    **{f"bars at 1e-{p}": (partial(two_wires, 10.0**-p), (0, 0)) for p in range(14, 19)},
    **{f"wires at 1e-{p}": (partial(two_wire_flexures, 10.0**-p), (4, 0)) for p in range(14, 19)},
    **{f"laeuchli 1e-{p}": (partial(laeuchli, p), (0, 1)) for p in range(14, 19)},
    "fold lines at 1e-14": (partial(two_fold_lines, 1e-14), (6, 0)),
    **{
        f"{number} levers by {ratio:g}": (partial(levers, number, ratio), (0, 0))
        for number, ratio in ((44, 2.0), (47, 2.0), (22, 4.0), (24, 4.0), (14, 10.0), *LONG_LEVERS)
    },
}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", BEYOND)
def test_the_truth_is_among_the_answers(name: str, method: str) -> None:
    make, truth = BEYOND[name]
    assert_right_or_nearly(analyse(make(), method=method), truth)


@pytest.mark.parametrize(("arm", "side"), [(1.6, 16), (1.1, 20), (1.01, 14)])
def test_the_truth_is_among_the_answers_of_large_models(arm: float, side: int) -> None:
    assert_right_or_nearly(analyse(many_stages(arm, side), method="sparse"), (0, 0))
