# SPDX-License-Identifier: BSD-3-Clause
"""The table of a sweep: columns, rows, words, files and pictures."""

import copy
import csv
import importlib
import json
import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_sweep import platform

import flexact
from flexact import Crossings, Table, Verdict, grid, sweep


def many(yaw: float, height: float) -> flexact.Model:
    if yaw > 100 and height > 1:
        raise RuntimeError("too high")
    return platform(yaw, height)


@pytest.fixture(scope="module")
def table() -> Table:
    """A grid with each kind of row."""
    return sweep(many, grid(yaw=[-80.0, 0.0, 90.0, 120.0], height=[0.5, 1.5]), workers=1)


def test_columns_are_attributes_and_go_by_name(table: Table) -> None:
    assert table.columns == (
        *("yaw", "height", "verdict", "under_constrained", "over_constrained", "rank"),
        *("certainty", "gap", "margin", "largest_zero", "smallest_singular_value"),
        *("condition_number", "margin_angle", "error"),
    )
    for name in table.columns:
        assert table[name] is getattr(table, name)
        assert table[name].shape == (8,) and not table[name].flags.writeable
        assert name in dir(table)
    with pytest.raises(AttributeError, match="no column 'length'"):
        _ = table.length
    with pytest.raises(KeyError, match="no column 'length'"):
        _ = table["length"]
    few = sweep(platform, {"yaw": [1.0]}, want="verdict", workers=1)
    with pytest.raises(AttributeError, match="values"):
        _ = few.margin


def test_rows_are_dictionaries(table: Table) -> None:
    assert len(table) == len(list(table)) == 8
    assert str(table[2]) == str(list(table)[2])
    assert table[4]["yaw"] == 90.0 and table[4]["verdict"] == Verdict.BOTH.value
    assert type(table[4]["yaw"]) is float and type(table[4]["rank"]) is int
    assert table[-1]["error"] == "RuntimeError: too high"
    with pytest.raises(IndexError):
        _ = table[8]


def test_some_rows_are_a_table(table: Table) -> None:
    chosen = table[table["height"] == 0.5]
    assert chosen["yaw"].tolist() == [-80.0, 0.0, 90.0, 120.0]
    assert chosen.crossings(workers=1)[0].parameters == {"yaw": 90.0, "height": 0.5}
    assert table[1:3]["yaw"].tolist() == [-80.0, 0.0]
    assert table[[3, 0]]["height"].tolist() == [1.5, 0.5]


def test_a_table_is_copied_and_pickled(table: Table) -> None:
    for again in (copy.copy(table), copy.deepcopy(table), pickle.loads(pickle.dumps(table))):
        assert again.columns == table.columns
        assert again.verdict.tolist() == table.verdict.tolist()
        assert not again.gap.flags.writeable
    # A function of a module is found again.
    assert len(pickle.loads(pickle.dumps(table)).crossings(workers=1)) == 2


def test_words_say_what_there_is(table: Table) -> None:
    said = table.describe()
    counts = {v: int((table.verdict == v.value).sum()) for v in Verdict}
    assert counts[Verdict.EXACT] == 5 and counts[Verdict.BOTH] == 2
    assert "8 variants of yaw (-80, 0, 90, 120), height (0.5, 1.5)." in said
    assert "Exactly constrained: 5 (62.5 %)." in said
    assert "With an error: 1 (12.5 %)." in said
    assert "variant 7: yaw 120, height 1.5: RuntimeError: too high" in said
    assert repr(table).startswith("<Table: 8 variants: 5 exactly constrained, 2 under")
    html = table._repr_html_()
    assert html.count("<tr>") == 9 and "too high" in html


def test_html_is_harmless() -> None:
    shown = sweep(platform, {"yaw": [1.0], "name": "<script>\x1b[2J"}, workers=1)._repr_html_()
    assert "<script>" not in shown and "\x1b" not in shown


def test_per_cents_never_say_all_where_one_is_missing() -> None:
    from flexact.sweeps.table import share_in_words

    assert share_in_words(3, 3) == "3 (100 %)"
    assert share_in_words(99_999, 100_000) == "99999 (99.999 %)"
    assert share_in_words(1, 3) == "1 (33.3 %)"


def test_files_hold_the_same(table: Table, tmp_path: Path) -> None:
    table.to_csv(tmp_path / "t.csv")
    table.to_jsonl(tmp_path / "t.jsonl")
    table.to_parquet(tmp_path / "t.parquet")
    with open(tmp_path / "t.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == list(table.columns)
    assert [float(row["yaw"]) for row in rows] == table["yaw"].tolist()
    assert [float(row["gap"]) for row in rows[:7]] == table.gap[:7].tolist()
    assert rows[7]["error"] == "RuntimeError: too high" and rows[7]["gap"] == rows[7]["rank"] == ""
    lines = [json.loads(line) for line in (tmp_path / "t.jsonl").read_text("utf-8").splitlines()]
    assert [line["rank"] for line in lines[:7]] == table.rank[:7].tolist()
    assert lines[7]["rank"] is None
    parquet = importlib.import_module("pyarrow.parquet").read_table(tmp_path / "t.parquet")
    assert parquet.column_names == list(table.columns)
    assert parquet["gap"].to_pylist()[:7] == table.gap[:7].tolist()
    with pytest.raises(flexact.FlexactError, match=r"\.csv"):
        table.to_csv(tmp_path / "t.txt")


def test_columns_of_any_values_are_written(tmp_path: Path) -> None:
    rows: list[dict[str, Any]] = [
        {"yaw": 1.0, "name": "a"},
        {"yaw": 2.0, "name": "b"},
        {"yaw": 3.0, "height": 2},
    ]
    table = sweep(platform, rows, workers=1)
    assert table["height"][2] == 2 and math.isnan(table["height"][0])
    assert table["name"].tolist() == ["a", "b", None]
    assert table.has_error.sum() == 0
    table.to_csv(tmp_path / "t.csv")
    assert (tmp_path / "t.csv").read_text().splitlines()[3].startswith("3.0,,2.0,")


def test_without_pandas_the_reason_is_told(monkeypatch: pytest.MonkeyPatch, table: Table) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(flexact.FlexactError, match="pandas"):
        table.to_pandas()


def test_models_of_rows_and_of_singular_variants(table: Table) -> None:
    assert flexact.analyse(table.model(1)).gap.smallest_nonzero == pytest.approx(table.gap[1])
    chosen = table[table["height"] == 0.5]
    (found,) = chosen.crossings(workers=1)
    assert flexact.analyse(chosen.model(found), prove=False).under_constrained == 1
    with pytest.raises(RuntimeError, match="too high"):
        table.model(7)
    with pytest.raises(IndexError):
        table.model(8)
    model = platform(0.0)
    places = np.array([platform(yaw).positions for yaw in (80.0, 95.0)])
    moved = sweep(model, positions=places)
    (found,) = moved.crossings(workers=1)
    assert moved.model(1).positions == pytest.approx(places[1])
    assert moved.model(found).positions == pytest.approx(
        places[0] + found.share * (places[1] - places[0])
    )


# Pictures: what is drawn, not how it looks.


def singular_lines(figure: Any) -> np.ndarray:
    """All ends of the singular curves of a map."""
    collections = figure.axes[0].collections
    lines = [each for each in collections if type(each).__name__ == "LineCollection"]
    return np.concatenate([each.get_segments() for each in lines])


def legend_of(figure: Any) -> list[str]:
    return [text.get_text() for text in figure.legends[0].get_texts()]


def test_a_map_of_two_parameters(table: Table, tmp_path: Path) -> None:
    figure: Any = table.plot(path=tmp_path / "map.png")
    assert (tmp_path / "map.png").read_bytes()[1:4] == b"PNG"
    assert singular_lines(figure)[..., 0] == pytest.approx(90.0)
    assert legend_of(figure) == [
        "exactly constrained: 5",
        "under-constrained and over-constrained: 2",
        "singular",
        "rank doubtful: 2",
        "error: 1",
    ]
    axes = figure.axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("yaw", "height")
    (mesh,) = [each for each in axes.collections if type(each).__name__ == "QuadMesh"]
    colours = np.asarray(mesh.get_array()).reshape(2, 4, -1)[..., :3]
    from matplotlib.colors import to_rgb

    assert colours[0, 2] == pytest.approx(to_rgb(Verdict.BOTH.colour))
    assert figure._repr_png_()[1:4] == b"PNG"


def test_a_curve_over_one_parameter(tmp_path: Path) -> None:
    table = sweep(platform, {"yaw": np.linspace(-140, 150, 14)}, workers=1)
    figure: Any = table.plot(path=tmp_path / "curve.svg")
    assert b"<svg" in (tmp_path / "curve.svg").read_bytes()
    upper, lower = figure.axes
    assert upper.get_yscale() == lower.get_yscale() == "log"
    assert lower.get_xlabel() == "yaw" and lower.get_ylabel() == "margin [m]"
    (points,) = [each for each in upper.collections if len(each.get_offsets()) == 14]
    assert np.asarray(points.get_offsets())[:, 1] == pytest.approx(table.gap)
    places = [line.get_xdata()[0] for line in upper.lines if len(set(line.get_xdata())) == 1]
    assert places == pytest.approx([-90, 90])
    assert {text.get_text() for text in upper.texts} == {"-90", "90"}


def test_a_curve_is_broken_at_errors_and_ends_below_at_zeros() -> None:
    def make(yaw: float) -> flexact.Model:
        if yaw == 40:
            raise RuntimeError("no")
        return platform(yaw)

    table = sweep(make, {"yaw": [20.0, 40.0, 60.0, 90.0, 120.0]}, workers=1)
    figure: Any = table.plot()
    axes = figure.axes[0]
    (line,) = [each for each in axes.lines if len(each.get_xdata()) > 2]
    drawn = dict(zip(line.get_xdata(), line.get_ydata(), strict=True))
    assert math.isnan(drawn[40.0]) and drawn[20.0] == table.gap[0]
    assert drawn[90.0] == axes.get_ylim()[0] < table.gap[[2, 4]].min()


def test_a_condition_number_does_not_fall_at_singular_places() -> None:
    table = sweep(platform, {"yaw": [60.0, 80.0, 95.0, 110.0]}, workers=1)
    figure: Any = table.plot("yaw", "condition_number")
    axes = figure.axes[0]
    (line,) = [each for each in axes.lines if len(each.get_xdata()) > 2]
    assert line.get_ydata() == pytest.approx(table.condition_number)


def test_a_curve_of_any_column_and_one_over_rows(table: Table) -> None:
    figure: Any = table.plot("yaw", "condition_number", crossings=False)
    (axes,) = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("yaw", "condition_number")
    model = platform(0.0)
    moved = sweep(model, positions=np.array([platform(y).positions for y in (80.0, 95.0)]))
    figure = moved.plot()
    assert figure.axes[-1].get_xlabel() == "variant"
    few: Any = moved[:1].plot()
    assert len(few.axes) == 2


def test_scattered_parameters_are_points() -> None:
    rng = np.random.default_rng(1)
    table = sweep(
        many, {"yaw": rng.uniform(-80, 150, 12), "height": rng.uniform(0.5, 2, 12)}, workers=1
    )
    figure: Any = table.plot("yaw", "height")
    sound = ~table.has_error
    drawn = [np.asarray(each.get_offsets()) for each in figure.axes[0].collections]
    points = next(each for each in drawn if len(each) == sound.sum())
    assert points[:, 0] == pytest.approx(table["yaw"][sound])
    assert 0 < sound.sum() < 12
    assert legend_of(figure)[-1] == f"error: {table.has_error.sum()}"


def test_a_table_without_values_is_drawn() -> None:
    table = sweep(many, grid(yaw=[0.0, 90.0, 120.0], height=[0.5, 1.5]), want="verdict", workers=1)
    assert singular_lines(table.plot())[..., 0] == pytest.approx(90.0)
    curve: Any = table.plot("yaw", "rank")
    assert curve.axes[0].get_ylabel() == "rank"
    line: Any = sweep(platform, {"yaw": [0.0, 10.0]}, want="verdict", workers=1).plot()
    assert line.axes[0].get_ylabel() == "rank of D(c)"


@pytest.mark.parametrize(
    "parameters",
    [
        {"yaw": [math.nan, 1.0, 2.0]},
        {"yaw": [math.nan] * 3},
        {"yaw": [0.0, 1.0, 0.0, 1.0], "height": [1.0, 1.0, math.inf, 2.0]},
        {"yaw": [None, "a", True]},
        grid(yaw=[100.5, 130.0], height=[2.0, 3.0]),
        {"yaw": [5.0], "height": [2.0]},
        [],
    ],
)
def test_whatever_the_rows_are_they_are_drawn_and_told(parameters: Any) -> None:
    for want in ("verdict", "values"):
        table = sweep(lambda yaw, height=1.0: many(yaw, height), parameters, want=want, workers=1)
        figure = table.plot()
        assert table.describe() and table._repr_html_()
    assert figure._repr_png_()  # type: ignore[attr-defined]


def test_what_cannot_be_drawn_is_told_in_words(table: Table, tmp_path: Path) -> None:
    with pytest.raises(KeyError, match="length"):
        table.plot("length")
    with pytest.raises(ValueError, match="no numbers"):
        table.plot("verdict")
    with pytest.raises(flexact.FlexactError, match=r"\.png, \.svg or \.pdf"):
        table.plot(path=tmp_path / "map.jpg")
    twice = sweep(platform, grid(yaw=[0.0, 1.0], height=[1.0, 2.0], name=["a", "b"]), workers=1)
    with pytest.raises(ValueError, match="name"):
        twice.plot("yaw", "height")


def test_singular_curves_go_from_edge_to_edge_of_the_cells() -> None:
    """A straight line across a grid gives one chain of segments, all of them on it."""

    def make(x: float, y: float) -> flexact.Model:
        # The third of three bars in a plane passes the point of the others by x + y - 1.
        model = flexact.Model(planar=True)
        offset = x + y - 1
        ends = ((-1, 0, -1, 0), (0, -1, 0, -1), (1, 1 + offset, 1, 1))
        for a, b, u, v in ends:
            model.truss((a, b), (a + u, b + v))
            model.fix((a + u, b + v))
        model.body([(a, b) for a, b, _, _ in ends])
        return model

    table = sweep(make, grid(x=np.linspace(0, 1, 5), y=np.linspace(-0.03, 1.04, 6)), workers=1)
    found = table.crossings(workers=1)
    assert isinstance(found, Crossings) and len(found) == 9
    ends = singular_lines(table.plot(crossings=found))
    assert ends.sum(axis=-1) == pytest.approx(1.0)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    # Drawn twice, with a white rim.
    assert lengths.sum() / 2 == pytest.approx(math.sqrt(2), rel=1e-9)
