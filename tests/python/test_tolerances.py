# SPDX-License-Identifier: BSD-3-Clause
"""Random misalignments: what moves and what does not, shares and quantiles."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_sweep import platform

import flexact
from flexact import Model, Verdict, analyse, tolerances
from flexact.sweeps.tolerances import Share, misaligned, spread_given


def guide(beams: int = 1) -> Model:
    model = Model(name="guide")
    for k, y in enumerate((0.0, 0.05), 1):
        clamp = model.node(0, y, 0, name=f"clamp {k}")
        model.sheet(clamp, (0.1, y, 0), width=(0, 0, 1), name=f"sheet {k}", beams=beams)
        model.fix(clamp)
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    model.independent("stage", "y")
    return model


def errors(model: Model, sd: Any, samples: int = 4000, seed: int = 1) -> np.ndarray:
    made = misaligned(model, spread_given(model, sd), samples, seed)
    return made - model.positions


def index(model: Model, point: Any) -> int:
    return model.node_index(model.point(point).position)


def test_points_move_at_random_and_nothing_else_does() -> None:
    """Means and standard deviations of 4000 normal numbers are off by some per cent at most."""
    model = guide()
    moved = errors(model, 1e-4)
    is_position = np.array([kind == 2 for kind in model.node_kinds])
    assert (moved[:, ~is_position] == 0).all()
    points = moved[:, is_position] / 1e-4
    assert np.abs(points.mean(axis=0)).max() < 4 / math.sqrt(4000)
    assert points.std(axis=0) == pytest.approx(np.ones(points.shape[1:]), abs=0.05)
    whole = points.reshape(4000, -1)
    correlation = np.corrcoef(whole.T) - np.eye(whole.shape[1])
    assert np.abs(correlation).max() < 0.08


def test_nodes_at_one_place_are_one_point() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(0, 0, 0)
    model.truss(a, (1, 0, 0))
    model.truss(b, (0, 1, 0))
    moved = errors(model, 0.01, samples=3)
    i, j = (model.node_index(each.position) for each in (a, b))
    assert (moved[:, i] == moved[:, j]).all() and (moved[:, i] != 0).all()


def test_nodes_inside_a_divided_sheet_follow_its_ends() -> None:
    model = guide(beams=4)
    before = model.positions
    after = before + errors(model, 1e-3, samples=1)[0]
    ends = [index(model, "clamp 1"), index(model, (0.1, 0.0, 0.0))]
    inner = [k for k in range(len(before)) if 0 < before[k, 0] < 0.1 and before[k, 1] == 0]
    assert len(inner) == 3
    chord = after[ends[1]] - after[ends[0]]
    for k in inner:
        share = before[k, 0] / 0.1
        assert after[k] == pytest.approx(after[ends[0]] + share * chord, abs=1e-15)


def test_planar_points_stay_in_the_plane() -> None:
    model = Model(planar=True)
    model.truss((0, 0), (1, 0))
    moved = errors(model, 0.1, samples=2)
    assert (moved[..., 2] == 0).all() and (moved[..., :2] != 0).any()


def test_the_spread_is_given_for_all_points_or_for_some() -> None:
    model = guide()
    clamp, other = index(model, "clamp 1"), index(model, (0.1, 0.05, 0.0))
    number = int(model.node_numbers[other])
    by_name = spread_given(model, {"clamp 1": 1e-5, number: (0, 0, 2e-5)})
    assert by_name[clamp].tolist() == [1e-5] * 3 and by_name[other].tolist() == [0, 0, 2e-5]
    assert np.count_nonzero(by_name) == 4
    by_handle = spread_given(model, {model.point("clamp 1"): 1e-5})
    assert by_handle[clamp].tolist() == [1e-5] * 3
    nodes = model.node_numbers.size
    each = spread_given(model, np.arange(nodes) * 1e-6)
    assert each[clamp].tolist() == [clamp * 1e-6] * 3
    assert spread_given(model, np.full((nodes, 3), 1e-6)).shape == (nodes, 3)


def test_the_same_seed_makes_the_same_samples() -> None:
    one, same, other = (tolerances(guide(), sd=1e-4, samples=8, seed=s) for s in (5, 5, 6))
    assert one.table.gap.tolist() == same.table.gap.tolist()
    assert one.table.gap.tolist() != other.table.gap.tolist()


def test_samples_are_analyses_of_misaligned_models() -> None:
    model = platform(80.0)
    found = tolerances(model, sd=0.01, samples=4, seed=2)
    places = misaligned(model, spread_given(model, 0.01), 4, 2)
    for row, place in zip(found.table, places, strict=True):
        one = analyse(model.with_positions(place))
        assert row["gap"] == pytest.approx(one.gap.smallest_nonzero, rel=1e-9)
        assert row["margin"] == pytest.approx(one.margin.length, rel=1e-6)
    assert found.nominal.margin[0] == pytest.approx(analyse(model).margin.length, rel=1e-9)


def test_a_singular_design_is_regular_in_every_machine() -> None:
    """At 90 degrees misalignment lifts the zero, but leaves small margins, in proportion to it."""
    small, large = (tolerances(platform(90.0), sd=sd, samples=60) for sd in (1e-4, 1e-3))
    assert small.nominal.verdict[0] == Verdict.BOTH.value
    assert small.shares[Verdict.EXACT].value == large.shares[Verdict.EXACT].value == 1.0
    for of in ("margin", "smallest"):
        ratio = large.quantiles(of, [0.5]) / small.quantiles(of, [0.5])
        assert ratio == pytest.approx(10, rel=0.02)
    assert small.share_below(1e-2).value == 1.0
    assert "in exact alignment only" in small.describe()


def test_shares_have_the_interval_of_wilson() -> None:
    """Numbers of Newcombe, Statistics in Medicine 17 (1998) 857-872, table I, method 3."""
    for count, of, low, high in (
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ):
        share = Share.counted(count, of)
        assert share.value == count / of
        assert (share.low, share.high) == pytest.approx((low, high), abs=5e-5)
    assert Share.counted(29, 29).high == 1.0
    assert (Share.counted(0, 0).low, Share.counted(0, 0).high) == (0.0, 1.0)


def test_quantiles_are_samples_and_shares_count_them() -> None:
    found = tolerances(platform(80.0), sd=0.02, samples=100, below=0.3)
    margins = np.sort(found.table.margin)
    assert found.quantiles(at=[0.01, 0.5, 1.0]).tolist() == margins[[0, 49, 99]].tolist()
    share = found.share_below(0.3)
    assert share.number == (margins < 0.3).sum() and share.of == 100
    assert 0 < share.number < 100
    said = found.describe()
    assert f"Margin below 300 mm: {share.number} " in said and "seed 0" in said
    # Of the parallel guide no misalignment of a point changes the verdict.
    never = tolerances(guide(), sd=1e-6, samples=5)
    assert math.isinf(never.quantiles(at=[0.5])[0]) == math.isinf(never.table.margin.max())


def test_the_picture_counts_every_sample(tmp_path: Path) -> None:
    found = tolerances(platform(88.0), sd=0.02, samples=80, below=0.01)
    figure: Any = found.plot(path=tmp_path / "spread.png")
    assert (tmp_path / "spread.png").stat().st_size > 1000
    for axes in figure.axes:
        heights = [patch.get_height() for patch in axes.patches]
        assert sum(heights) == pytest.approx(80)
    assert "exactly constrained: 80" in figure.legends[0].get_texts()[0].get_text()


@pytest.mark.parametrize(
    ("given", "kind", "words"),
    [
        ({"sd": -1.0}, ValueError, "negative"),
        ({"sd": math.nan}, ValueError, "finite"),
        ({"sd": "wide"}, ValueError, "a length"),
        ({"sd": [1.0, 2.0]}, ValueError, "nodes"),
        ({"sd": {"clamp 3": 1.0}}, flexact.ModelError, "clamp 3"),
        ({"sd": {99: 1.0}}, flexact.ModelError, "99"),
        ({"sd": {"clamp 1": [1, 2]}}, ValueError, "each of x, y and z"),
        ({"sd": 1e-3, "samples": 0}, ValueError, "samples"),
        ({"sd": 1e-3, "samples": 1.5}, TypeError, "samples"),
        ({"sd": 1e-3, "seed": -1}, ValueError, "seed"),
        ({"sd": 1e-3, "below": 0.0}, ValueError, "positive"),
        ({"sd": 1e-3, "below": "1 kg"}, ValueError, "a mass"),
        ({"sd": 1e-3, "below": b"1 mm"}, TypeError, "bytes"),
    ],
)
def test_wrong_calls_are_refused_in_words(given: Any, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words):
        tolerances(guide(), **{"samples": 2, **given})


def test_only_models_have_tolerances() -> None:
    with pytest.raises(TypeError, match="Model"):
        tolerances("deck.dat", sd=1e-3)  # type: ignore[arg-type]
