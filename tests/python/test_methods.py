"""The choice of a method and of a tolerance: what is taken, what is refused, what is said."""

import re
from typing import Any

import numpy as np
import pytest
from known_models import folded_sheet, ring, twelve_trusses
from large_results import changed

import flexact
from flexact import Analysis, Model, _boundary, analyse, memory
from flexact.log import log_text
from flexact.words import describe

DENSE = ("svd", "jacobi", "qr")


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
    assert f"Method: {method}" in describe(analysis)


def test_what_is_no_method_is_refused_with_the_choices() -> None:
    with pytest.raises(ValueError, match=r"no method 'SVD'; .* auto, svd, jacobi, qr, sparse"):
        analyse(twelve_trusses(), method="SVD")
    for method in (None, 3, b"svd"):
        with pytest.raises(TypeError, match="a method is given by its name"):
            analyse(twelve_trusses(), method=method)  # type: ignore[arg-type]


@pytest.mark.parametrize("tolerance", [-1e-300, float("nan"), float("inf")])
def test_a_tolerance_must_be_finite_and_not_negative(tolerance: float) -> None:
    with pytest.raises(ValueError, match="must be finite and not negative"):
        analyse(twelve_trusses(), tolerance=tolerance)


@pytest.mark.parametrize("tolerance", ["1e-3", b"1", True, 1j, [1.0]])
def test_a_tolerance_must_be_a_number(tolerance: Any) -> None:
    with pytest.raises(TypeError, match="the tolerance must be a number"):
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


def failing(status: int, monkeypatch: pytest.MonkeyPatch) -> None:
    raw = analyse(ring(3)).raw._replace(status=status, bytes_needed=3.5e9)
    monkeypatch.setattr(_boundary, "analyse_model", lambda *_: raw)


@pytest.mark.parametrize(
    ("status", "words"),
    [
        (1, "did not converge"),
        (2, r"9 rows and 9 columns; its decomposition needs about 3\.5 GB of memory, more than"),
        (5, r"has no SuiteSparse, .* \(apt-get install libsuitesparse-dev\), then build Flexact"),
        (9, r"the core failed \(status 9\)"),
    ],
)
def test_failures_of_the_core_say_what_to_do(
    status: int, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    failing(status, monkeypatch)
    with pytest.raises(flexact.AnalysisError, match=words):
        analyse(ring(3))


def test_memory_that_runs_out_on_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(_boundary, "analyse_model", full)
    with pytest.raises(flexact.AnalysisError, match="needs more memory than there is"):
        analyse(ring(3))


def test_what_is_not_worth_a_look_may_always_be_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available", lambda: 0.0)
    assert memory.allowance() == 2**26
    assert analyse(ring(3)).rank == 9


def test_method_is_told_where_it_is_not_the_plain_one() -> None:
    analysis = analyse(folded_sheet(False))
    assert "Method:" not in describe(analysis)
    large = changed(analysis, method="sparse", parts=300, largest_part=(36, 35))
    wanted = "Method: sparse (chosen automatically), in 300 parts, the largest 36 x 35."
    assert wanted in describe(large).splitlines()


def smallest_only(analysis: Analysis, kept: int) -> Analysis:
    return changed(
        analysis,
        singular_values=analysis.singular_values[-kept:],
        scaled_values=analysis.scaled_singular_values[-kept:],
    )


def test_smallest_singular_values_alone() -> None:
    whole = analyse(twelve_trusses())
    part = smallest_only(whole, 3)
    assert part.singular_values_given == "smallest" and part.gap == whole.gap
    assert part.to_dict()["singular_values_given"] == "smallest"
    assert smallest_only(analyse(ring(3)), 3).condition_number is None
    text = log_text(part)
    (section,) = re.findall(r"The smallest singular values of D\(c\).*?tolerance", text, re.S)
    assert re.findall(r"^ +(\d+) ", section, re.M) == ["10", "11", "12"]
    assert section.count("counts as zero") == 1 and " 12 " in section.split("counts")[0][-60:]


def test_singular_values_of_the_scaled_matrix_alone() -> None:
    part = changed(smallest_only(analyse(twelve_trusses()), 2), singular_values=np.zeros(0))
    assert part.singular_values_given == "smallest"
    lines = [line.split() for line in log_text(part).splitlines()]
    assert [line[:2] for line in lines if line[1:2] == ["-"]] == [["11", "-"], ["12", "-"]]


def test_gap_where_zeros_alone_are_given() -> None:
    whole = analyse(twelve_trusses())
    pairs = np.array([0.25, 0.5])
    part = changed(smallest_only(whole, 1), pair_value=pairs)
    assert part.gap == (0.25, whole.gap.largest_zero)
    none = changed(smallest_only(whole, 1), pair_value=np.zeros(0))
    assert none.gap == (None, whole.gap.largest_zero)


def test_words_say_why_another_method_was_used() -> None:
    """A tolerance above what the sparse route can prove leaves the count to svd."""
    analysis = flexact.analyse(twelve_trusses(), method="sparse", tolerance=1e-3)
    assert (analysis.method, analysis.under_constrained) == ("svd", 1)
    assert "Method: svd (sparse could not confirm the count)." in analysis.describe()
