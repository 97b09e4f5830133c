# SPDX-License-Identifier: BSD-3-Clause
"""The choice of a method and of a tolerance: what is taken, what is refused, what is given."""

import math
import re
from typing import Any

import numpy as np
import pytest
from known_models import folded_sheet, ring, twelve_trusses
from large_results import changed
from verdicts import DENSE

import flexact
from flexact import Analysis, Model, analyse
from flexact.advice.describe import describe
from flexact.core import calls
from flexact.core.arrays import FloatArray
from flexact.show.spacar_log import log_text
from flexact.util import machine as memory


@pytest.mark.parametrize("method", DENSE)
@pytest.mark.parametrize(
    ("model", "under", "over"),
    [(twelve_trusses(), 1, 1), (ring(5), 0, 0), (folded_sheet(False, 3), 18, 0)],
)
def test_every_dense_method_finds_the_known_counts(
    method: str, model: Model, under: int, over: int
) -> None:
    analysis = analyse(model, method=method)
    assert (analysis.under_constrained, analysis.over_constrained) == (under, over)
    assert analysis.method == method and analysis.asked.method == method
    assert analysis.singular_values_given == "all"


def test_what_is_no_method_is_refused_with_the_choices() -> None:
    with pytest.raises(ValueError) as error:
        analyse(twelve_trusses(), method="SVD")
    assert all(name in str(error.value) for name in ("'SVD'", *calls.METHODS))
    for method in (None, 3, b"svd"):
        with pytest.raises(TypeError):
            analyse(twelve_trusses(), method=method)  # type: ignore[arg-type]


@pytest.mark.parametrize("tolerance", [-1e-300, float("nan"), float("inf")])
def test_a_tolerance_must_be_finite_and_not_negative(tolerance: float) -> None:
    with pytest.raises(ValueError):
        analyse(twelve_trusses(), tolerance=tolerance)


@pytest.mark.parametrize("tolerance", ["1e-3", b"1", True, 1j, [1.0]])
def test_a_tolerance_must_be_a_number(tolerance: Any) -> None:
    with pytest.raises(TypeError):
        analyse(twelve_trusses(), tolerance=tolerance)


def test_a_tolerance_decides_and_is_echoed() -> None:
    plain = analyse(twelve_trusses())
    smallest = plain.gap.smallest_nonzero
    assert smallest is not None
    coarse = analyse(twelve_trusses(), tolerance=1.01 * smallest)
    assert coarse.rank < plain.rank == 11
    assert coarse.tolerance == coarse.to_dict()["tolerance"] == 1.01 * smallest
    for given in (0.5 * smallest, np.float32(2.0**-10)):
        again = analyse(twelve_trusses(), tolerance=float(given))
        assert (again.rank, again.tolerance) == (11, float(given))
    assert coarse.asked.tolerance == 1.01 * smallest and plain.asked.tolerance is None


def failing(error: str, monkeypatch: pytest.MonkeyPatch) -> None:
    raw = analyse(ring(3)).raw._replace(error=error, bytes_needed=3.5e9)
    monkeypatch.setattr(calls, "analyse_model", lambda *_, **__: raw)


@pytest.mark.parametrize("failure", [each for each in calls.ERRORS if each != "none"])
def test_failures_of_the_core_are_errors_of_the_analysis(
    failure: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What they say to do stands in golden/messages/failed_analyses.txt."""
    failing(failure, monkeypatch)
    with pytest.raises(flexact.AnalysisError) as error:
        analyse(ring(3))
    if failure == "memory":
        assert re.findall(r"\d[\d.]*", str(error.value)) == ["9", "9", "3.5"]


def test_memory_that_runs_out_on_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr(calls, "analyse_model", full)
    with pytest.raises(flexact.AnalysisError):
        analyse(ring(3))


def test_what_is_not_worth_a_look_may_always_be_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available", lambda: 0.0)
    assert memory.allowance() == 2**27
    assert analyse(ring(3)).rank == 9


def joints_apart(count: int = 20) -> Model:
    """Joints on seven bars each, and as many on one: parts with more rows, or more columns."""
    model = Model()
    for k in range(2 * count):
        joint = model.node(10.0 * k, 0.0, 0.0)
        for bar in range(7 if k < count else 1):
            foot = model.node(10.0 * k + math.cos(bar), math.sin(bar), 1.0 + 0.1 * bar)
            model.fix(foot)
            model.truss(joint, foot)
    return model


def test_no_decomposition_asks_for_more_than_it_may_need() -> None:
    for model in (twelve_trusses(), ring(3), ring(30), folded_sheet(False, 40), joints_apart()):
        raw = analyse(model, method="svd").raw
        needed = raw.bytes_needed
        assert 0 < needed <= memory.dense_needed(raw.row_scale.size, raw.column_scale.size)


def test_singular_values_without_room_are_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    analysis = analyse(ring(3), method="svd")
    monkeypatch.setattr(memory, "allowance", lambda most=0.0: 1.0)
    with pytest.raises(flexact.AnalysisError):
        _ = analysis.singular_values
    monkeypatch.undo()
    assert analysis.singular_values.size == 9


def test_method_is_told_where_it_is_not_the_plain_one() -> None:
    analysis = analyse(folded_sheet(False))
    plain = set(describe(analysis).splitlines())
    assert not any("svd" in line for line in plain)
    large = changed(analysis, method="sparse", components=300, largest_component=(36, 35))
    told = describe(large, verbose=True).splitlines()
    (line,) = (line for line in told if "sparse" in line)
    assert re.findall(r"\d+", line) == ["300", "36", "35"]


def smallest_only(analysis: Analysis, kept: int) -> Analysis:
    part = changed(analysis, scaled_values=analysis.scaled_singular_values[-kept:])
    return given(part, analysis.singular_values[-kept:])


def given(analysis: Analysis, values: FloatArray) -> Analysis:
    """The analysis with these singular values of D(c) itself, as if it had been asked for them."""
    vars(analysis)["singular_values"] = values
    return analysis


def test_smallest_singular_values_alone() -> None:
    whole = analyse(twelve_trusses())
    part = smallest_only(whole, 3)
    assert part.singular_values_given == "smallest" and part.gap == whole.gap
    assert part.to_dict()["singular_values_given"] == "smallest"
    assert smallest_only(analyse(ring(3)), 3).condition_number is None
    assert [number for number, *_ in values_reported(part)] == [10, 11, 12]
    assert [remark != "" for *_, remark in values_reported(part)] == [False, False, True]


def values_reported(analysis: Analysis) -> list[tuple[int, str, str, str]]:
    """Number, value, scaled value, and the remark behind them, as the log lists them."""
    number = r"(-|\d\.\d{16}e[+-]\d+)"
    rows = re.findall(rf"^ +(\d+) +{number} +{number} *(.*)$", log_text(analysis), re.MULTILINE)
    return [(int(first), *rest) for first, *rest in rows]  # type: ignore[misc]


def test_singular_values_of_the_scaled_matrix_alone() -> None:
    part = given(smallest_only(analyse(twelve_trusses()), 2), np.zeros(0))
    assert part.singular_values_given == "smallest"
    assert [reported[:2] for reported in values_reported(part)] == [(11, "-"), (12, "-")]


def test_gap_where_zeros_alone_are_given() -> None:
    whole = analyse(twelve_trusses())
    pairs = np.array([0.25, 0.5])
    part = changed(smallest_only(whole, 1), pair_value=pairs)
    assert part.gap == (0.25, whole.gap.largest_zero)
    none = changed(smallest_only(whole, 1), pair_value=np.zeros(0))
    assert none.gap == (None, whole.gap.largest_zero)


def test_a_tolerance_that_the_sparse_route_cannot_prove_leaves_the_count_to_svd() -> None:
    analysis = flexact.analyse(twelve_trusses(), method="sparse", tolerance=1e-3)
    assert (analysis.method, analysis.under_constrained) == ("svd", 1)
    assert analysis.asked.method == "sparse"
