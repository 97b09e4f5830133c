# SPDX-License-Identifier: BSD-3-Clause
"""Subnormal and huge numbers: an answer without NaN, or a clear error; memory that is short."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from known_models import folded_sheet, twelve_trusses
from verdicts import DENSE, METHODS, assert_all_right, counts
from wrong_use import code_of

import flexact
from flexact import Analysis, Model, analyse
from flexact.apps.cli.main import main
from flexact.util import machine as memory

pytestmark = pytest.mark.dear(25)

LEAST = 5e-324
HUGE = 1.7976931348623157e308


def assert_sound(analysis: Analysis) -> None:
    """Every number is finite and every text can be made."""
    for values in (analysis.singular_values, analysis.scaled_singular_values):
        assert np.all(np.isfinite(values)) and np.all(values >= 0)
    for modes in (analysis.motions, analysis.self_stresses):
        for mode in modes:
            assert np.all(np.isfinite(mode.vector))
    assert len(analysis.motions) == analysis.under_constrained
    margin = analysis.margin
    for part in (margin.length, margin.angle):
        assert part is None or (math.isfinite(part) and part >= 0)
    assert "nan" not in analysis.describe().lower()
    json.loads(analysis.to_json(), parse_constant=pytest.fail)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [2e-90, 1e-60, 1e-30, 1e30, 1e60, 5e89])
def test_lengths_that_are_far_from_one(size: float) -> None:
    for method in METHODS:
        for clamped, truth in ((True, (1, 1)), (False, (6, 0))):
            analysis = analyse(folded_sheet(clamped, size=size), method=method)
            assert counts(analysis) == truth
            assert_sound(analysis)


@pytest.mark.parametrize("size", [LEAST, 1e-310, 1e-200, 9e-91, 2e90, 1e200, 1e308])
def test_lengths_out_of_range_are_refused(size: float) -> None:
    with pytest.raises(flexact.ModelError) as error:
        analyse(folded_sheet(True, size=size))
    codes = {item.code for item in error.value.diagnostics}
    assert codes <= {"length-out-of-range", "zero-length"}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("tiny", [LEAST, 1e-310, 2.3e-308, 1e-200, 1e-100, -LEAST])
def test_coordinates_that_are_almost_zero(tiny: float) -> None:
    """Where a zero was meant the verdict stays, and no method fails."""
    model = Model()
    places = [(0, 0, tiny), (1, tiny, 0), (1, 1, -tiny)]
    a, b, c = (model.node(*place) for place in places)
    model.sheet(a, b, (tiny, 0, 1))
    model.sheet(b, c, (0, 0, 1))
    model.fix(a)
    model.fix(c)
    for method in METHODS:
        analysis = analyse(model, method=method)
        assert counts(analysis) == (1, 1)
        assert_sound(analysis)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("far", [1e12, 1e14, 1e15, 1e17, 1e60, 1e150, 1e300, HUGE])
def test_coordinates_that_swallow_the_rest(far: float) -> None:
    """There is an answer as long as the bars can be seen, and then a message."""
    model = Model(planar=True)
    a, b, c = model.node(0, far), model.node(0, far + 2), model.node(0, far + 6)
    if far > 1e16:
        # Refused where it is made.
        for p, q in ((a, b), (b, c)):
            with pytest.raises(flexact.ModelError) as error:
                model.truss(p, q)
            assert {item.code for item in error.value.diagnostics} == {"zero-length"}
        return
    model.truss(a, b)
    model.truss(b, c)
    model.fix(a)
    model.fix(c)
    for method in METHODS:
        analysis = analyse(model, method=method)
        assert counts(analysis) == (1, 1)
        assert_sound(analysis)


@pytest.mark.filterwarnings("error")
def test_ends_at_opposite_ends_of_the_numbers() -> None:
    """Their difference overflows."""
    model = Model()
    model.truss(model.node(-HUGE, 0, 0), model.node(HUGE, 0, 0))
    with pytest.raises(flexact.ModelError) as error:
        analyse(model)
    assert [item.code for item in error.value.diagnostics] == ["length-out-of-range"]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [LEAST, 1e-310, 1e-160, 1e-100, 1e100, 1e160, HUGE])
def test_vectors_of_any_length(size: float) -> None:
    """A vector counts by its direction."""
    for method in METHODS:
        model = Model()
        a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(1, 1, 0)
        model.beam(a, b, (0, size, 0), release=(2, 5, 6))
        model.beam(b, c, (size, 0, 0), release=(2, 5, 6))
        model.fix(a)
        model.fix(c)
        analysis = analyse(model, method=method)
        assert counts(analysis) == (1, 1)
        assert_sound(analysis)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [LEAST, 1e-310, 1e-160, 1e160, HUGE / 4])
def test_axes_of_any_length(size: float) -> None:
    """Two rigid links on three parallel hinges between fixed points: held, three too many."""
    model = Model()
    first, middle, last = model.node(0, 0, 0), model.node(1, 1, 0), model.node(2, 0, 0)
    model.fix(first)
    model.fix(last)
    start = model.hinge(first, (0, 0, size))
    model.beam(start, middle)
    beyond = model.hinge(middle, (0, 0, size))
    end = model.hinge(last, (0, 0, size))
    model.beam(beyond, end)
    assert_all_right(model, (0, 3))


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_is_refused(number: float) -> None:
    with pytest.raises(flexact.ModelError) as error:
        Model().node(number, 0, 0)
    assert code_of(error) == "bad-number"


@pytest.mark.parametrize("word", ["4.9e-324", "1e-400", "1.7e308", "1e400"])
def test_numbers_in_a_deck(word: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A verdict or a message with its place, whatever is typed."""
    path = tmp_path / "deck.dat"
    path.write_text(f"TRUSS 1 1 2\nX 1 {word} 0 0\nX 2 0 1 0\nFIX 1\nEND\n", encoding="utf-8")
    code = main(["analyse", str(path)])
    out, err = capsys.readouterr()
    assert "Traceback" not in err and "nan" not in out.lower()
    assert (code, bool(out)) == ((0, True) if float(word) < 1 else (1, False))
    assert code == 0 or str(path) in err


# Memory that does not suffice


def braced_strip(bays: int) -> Model:
    """One connected part of 4 (bays) columns."""
    model = Model(planar=True)
    low = [model.node(k, 0) for k in range(bays + 1)]
    high = [model.node(k, 1) for k in range(bays + 1)]
    for k in range(1, bays + 1):
        model.truss(low[k], high[k])
        model.truss(low[k - 1], low[k])
        model.truss(high[k - 1], high[k])
        model.truss(low[k - 1], high[k])
    model.fix(low[0])
    model.fix(high[0])
    return model


@pytest.mark.parametrize("method", DENSE)
def test_dense_methods_refuse_a_hundred_thousand_columns(method: str) -> None:
    """D(c) alone takes 8e10 bytes, and its decomposition has two bases of the same size."""
    model = braced_strip(25_000)
    with pytest.raises(flexact.AnalysisError) as caught:
        analyse(model, method=method)
    words = str(caught.value).split()
    assert "100000" in words
    assert 3 * 80 <= float(words[words.index("GB") - 1]) <= 12 * 80
    assert "\n" not in str(caught.value)


def test_the_command_refuses_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "long.dat"
    path.write_text(braced_strip(600).to_deck(), encoding="utf-8")
    monkeypatch.setattr(memory, "available", lambda: 0.0)
    code = main(["analyse", str(path), "--method", "svd"])
    out, err = capsys.readouterr()
    assert code not in (0, 3)
    assert out == ""
    assert len(err.splitlines()) == 1
    assert "2400" in err.split() and str(path) in err
    assert main(["analyse", str(path), "--method", "sparse"]) == 0


def test_memory_that_suffices_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available", lambda: 0.0)
    for method in METHODS:
        assert counts(analyse(twelve_trusses(), method=method)) == (1, 1)
