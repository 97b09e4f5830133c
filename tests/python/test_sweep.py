# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps: the same rows as one analysis each, however parameters come, and errors in words."""

import itertools
import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from divided import MAKERS, Division

import flexact
from flexact import Model, Verdict, analyse, grid, sweep

DECKS = Path(__file__).parents[2] / "input_decks"


def platform(yaw: float, height: float = 1.0, name: str = "") -> Model:
    """Hunt and Fichter's octahedral platform, [7] of the known answers; singular at 90 degrees."""
    base = [(math.cos(a), math.sin(a), 0.0) for a in np.radians((0, 120, 240))]
    top = [
        (0.6 * math.cos(a), 0.6 * math.sin(a), height)
        for a in np.radians((60 + yaw, 180 + yaw, 300 + yaw))
    ]
    model = Model(name=name)
    for i, j in ((0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)):
        model.truss(base[i], top[j])
    for i, j in ((0, 1), (1, 2), (2, 0)):
        model.truss(top[i], top[j])
    model.fix(*base)
    return model


def choosy(yaw: float) -> Any:
    """A function with every way to fail."""
    if yaw == 1:
        raise RuntimeError("no\nsuch   angle")
    if yaw == 2:
        return "a text"
    if yaw == 3:
        return Model()
    if yaw == 4:
        model = Model()
        model.truss((0, 0, 0), model.node(0, 0, 0))
        return model
    if yaw == 5:
        raise ValueError
    return platform(yaw)


def same_as_analysis(table: flexact.Table, models: list[Model]) -> None:
    for row, model in zip(table, models, strict=True):
        one = analyse(model)
        assert row["error"] == ""
        assert row["verdict"] == one.verdict.value
        assert row["rank"] == one.rank
        assert row["under_constrained"] == one.under_constrained
        assert row["over_constrained"] == one.over_constrained
        assert row["certainty"] == one.certainty.value
        if table.want == "verdict":
            continue
        assert row["gap"] == pytest.approx(one.gap.smallest_nonzero, rel=1e-9)
        assert row["smallest_singular_value"] == pytest.approx(
            one.singular_values[-1], rel=1e-9, abs=1e-13
        )
        margin = math.inf if one.margin.length is None else one.margin.length
        assert row["margin"] == pytest.approx(margin, rel=1e-6)
        if one.condition_number is None:
            assert math.isnan(row["condition_number"])
        else:
            assert row["condition_number"] == pytest.approx(one.condition_number, rel=1e-9)


@pytest.mark.parametrize("name", MAKERS)
@pytest.mark.parametrize("scale", [1e-4, 3e-2])
def test_rows_of_beams_that_count_as_one_are_their_analyses(name: str, scale: float) -> None:
    """Until they bend so far that they are one sheet no more, or one has no length."""
    model = MAKERS[name](Division(beams=4, amplitude=1e-4, against=True))
    rng = np.random.default_rng(7)
    places = model.positions + scale * rng.standard_normal((8, *model.positions.shape))
    row = list(model.data.chains[0].positions)
    places[7, row[1]] = places[7, row[2]]
    table = sweep(model, positions=places, want="values")
    same_as_analysis(table[:7], [model.with_positions(each) for each in places[:7]])
    assert "length" in table[7]["error"]


@pytest.mark.parametrize("want", ["verdict", "values", "all"])
def test_rows_of_a_function_are_its_analyses(want: str) -> None:
    yaws = [0.0, 30.0, 80.0, 90.0, 170.0]
    table = sweep(platform, {"yaw": yaws}, want=want, workers=2)
    same_as_analysis(table, [platform(yaw) for yaw in yaws])
    assert table["yaw"].tolist() == yaws


@pytest.mark.parametrize("want", ["verdict", "values", "all"])
def test_rows_of_positions_are_analyses_of_the_models(want: str) -> None:
    model = flexact.read(DECKS / "flexures" / "five_wires.dat")
    rng = np.random.default_rng(3)
    positions = model.positions + 0.01 * rng.standard_normal((5, *model.positions.shape))
    positions[2] = model.positions
    table = sweep(model, positions=positions, want=want, workers=2)
    same_as_analysis(table, [model.with_positions(each) for each in positions])
    labelled = sweep(model, {"k": range(5)}, positions=positions, want="verdict")
    assert labelled.columns[:2] == ("k", "verdict")
    assert labelled.rank.tolist() == table.rank.tolist()


def test_rows_of_masks_are_analyses_of_the_models() -> None:
    model = flexact.read(DECKS / "flexures" / "five_wires.dat")
    held = np.repeat((model.deformation_classes == 1)[None], 3, axis=0)
    held[1, 0, 0] = False
    held[2, 0, 1] = True
    table = sweep(model, held=held)
    same_as_analysis(table, [model.with_held(each) for each in held])
    assert table.verdict.tolist() == [
        Verdict.EXACT.value,
        Verdict.UNDER.value,
        Verdict.OVER.value,
    ]


def test_a_variant_without_length_is_a_row_with_an_error() -> None:
    model = platform(0.0)
    positions = np.repeat(model.positions[None], 3, axis=0)
    positions[1] = 0.0
    for want in ("values", "all"):
        table = sweep(model, positions=positions, want=want, workers=1)
        assert table.has_error.tolist() == [False, True, False]
        assert "length" in table.error[1] and "\n" not in table.error[1]
        assert table.verdict[1] == "" and table.rank[1] == -1 and math.isnan(table.gap[1])


def test_motions_and_self_stresses_are_kept_as_arrays() -> None:
    yaws = [0.0, 90.0]
    for table in (
        sweep(platform, {"yaw": yaws}, want="all", workers=1),
        sweep(
            platform(0.0),
            positions=np.array([platform(yaw).positions for yaw in yaws]),
            want="all",
            workers=1,
        ),
    ):
        one = analyse(platform(90.0))
        assert table.motions is not None and table.self_stresses is not None
        assert table.motions[0].displacement.shape == (0, 6, 3)
        assert table.self_stresses[0].forces.shape == (0, 9, 6)
        displacement, stress = one.motions[0].displacement, one.self_stresses[0].forces
        assert table.motions[1].displacement.shape == (1, 6, 3)
        assert table.motions[1].displacement[0] == pytest.approx(displacement, abs=1e-9)
        assert table.self_stresses[1].forces[0] == pytest.approx(stress, abs=1e-9)
        assert not table.motions[1].displacement.flags.writeable
        assert len(table[1:].motions or ()) == 1
    assert sweep(platform, {"yaw": yaws}, workers=1).motions is None


class Frame:
    """What a data frame is to a sweep."""

    columns = ("yaw", "height")

    def __getitem__(self, name: str) -> np.ndarray:
        return {"yaw": np.array([0.0, 90.0]), "height": np.array([1, 2])}[name]


def generated() -> Iterator[dict[str, Any]]:
    yield {"yaw": 0.0, "height": 1}
    yield {"yaw": np.float64(90.0), "height": np.int32(2)}


@pytest.mark.parametrize(
    "parameters",
    [
        {"yaw": [0.0, 90.0], "height": (1, 2)},
        {"yaw": np.array([0.0, 90.0]), "height": np.array([1, 2])},
        [{"yaw": 0.0, "height": 1}, {"yaw": 90.0, "height": 2}],
        np.array([(0.0, 1), (90.0, 2)], [("yaw", float), ("height", int)]),
        Frame(),
        generated(),
    ],
    ids=["lists", "arrays", "rows", "structured", "frame", "generator"],
)
def test_parameters_come_in_many_ways(parameters: Any) -> None:
    table = sweep(platform, parameters, want="verdict", workers=1)
    assert table.columns == (
        *("yaw", "height", "verdict", "under_constrained", "over_constrained", "rank"),
        *("certainty", "error"),
    )
    assert table["yaw"].tolist() == [0.0, 90.0]
    assert table["height"].tolist() == [1, 2] and table["height"].dtype.kind == "i"
    assert table.under_constrained.tolist() == [0, 1]


def test_a_data_frame_of_pandas_is_a_table_of_parameters() -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"yaw": [0.0, 90.0], "name": ["a", "b"]})
    table = sweep(platform, frame, workers=1)
    assert table["name"].tolist() == ["a", "b"]
    back = table.to_pandas()
    assert list(back.columns) == list(table.columns)
    assert back["rank"].tolist() == table.rank.tolist()


def test_a_grid_has_every_combination_and_its_last_parameter_changes_fastest() -> None:
    made = grid(yaw=[0, 90], height=[1.0, 2.0, 3.0])
    assert made.shape == (2, 3) and len(made) == 6
    table = sweep(platform, made, workers=1, want="verdict")
    assert table["yaw"].tolist() == [0, 0, 0, 90, 90, 90]
    assert table["height"].tolist() == [1.0, 2.0, 3.0] * 2


def test_a_single_value_stands_for_all_rows() -> None:
    parameters = {"yaw": [0.0, 10.0], "name": "both", "height": np.float64(2.0)}
    table = sweep(platform, parameters, workers=1)
    assert table["name"].tolist() == ["both", "both"] and table["height"].tolist() == [2.0, 2.0]


def test_decks_are_swept_by_their_paths() -> None:
    paths = sorted(str(path) for path in (DECKS / "paper").glob("*.dat"))[:3]
    table = sweep(flexact.read, {"path": [*paths, "nowhere.dat"]}, workers=1)
    assert table.rank.tolist()[:3] == [analyse(path).rank for path in paths]
    assert table.error[3] == "DeckError: there is no such file"


def test_what_fails_is_a_row_and_the_others_stay() -> None:
    table = sweep(choosy, {"yaw": range(8)}, workers=2)
    assert table.error.tolist()[0] == "" and set(table.error[6:]) == {""}
    assert table.error[1] == "RuntimeError: no such angle"
    assert table.error[2] == "TypeError: the function must return a flexact.Model, not str"
    assert table.error[3].startswith("ModelError: ") and table.error[4].startswith("ModelError: ")
    assert table.error[5] == "ValueError"
    assert not any("\n" in each or "Traceback" in each for each in table.error)
    assert table.has_error.sum() == 5
    assert "5 with an error" in repr(table)


def breaking() -> Iterator[Any]:
    yield {"yaw": 0.0}
    yield {"yaw": 45.0}
    raise KeyError("the end of the file")


def test_a_generator_that_raises_has_a_row_with_its_error() -> None:
    for workers in (1, 2):
        table = sweep(platform, breaking(), workers=workers)
        assert table.verdict.tolist() == [Verdict.EXACT.value] * 2 + [""]
        assert "KeyError" in table.error[2] and "the end of the file" in table.error[2]
        assert table["yaw"][:2].tolist() == [0.0, 45.0] and math.isnan(table["yaw"][2])


def test_a_row_of_a_generator_that_is_none_is_told_in_its_place() -> None:
    rows = iter([{"yaw": 0.0}, 7, {"yaw": [1, 2]}, {"error": 1}, {"yaw": 90.0}])
    table = sweep(platform, rows, workers=1)
    assert [bool(each) for each in table.error] == [False, True, True, True, False]
    assert "7" in table.error[1] and "yaw" in table.error[2] and "'error'" in table.error[3]
    assert table.under_constrained[4] == 1


def test_a_worker_that_dies_leaves_a_row() -> None:
    def make(yaw: float) -> Model:
        if yaw == 2:
            import os

            os._exit(3)
        return platform(yaw)

    table = sweep(make, {"yaw": range(5)}, want="verdict", workers=2)
    assert [bool(each) for each in table.error] == [False, False, True, False, False]


def test_an_executor_does_the_work() -> None:
    with ThreadPoolExecutor(2) as executor:
        table = sweep(platform, {"yaw": range(0, 100, 10)}, executor=executor)
        model = platform(0.0)
        moved = sweep(model, positions=model.positions[None], executor=executor)
    assert table.under_constrained.tolist() == [0] * 9 + [1]
    assert moved.rank.tolist() == [9]


def test_a_lost_executor_leaves_what_was_done() -> None:
    executor = ThreadPoolExecutor(1)

    def make(yaw: float) -> Model:
        if yaw == 30:
            executor.shutdown(wait=False)
        return platform(yaw)

    table = sweep(make, {"yaw": range(2000)}, executor=executor)
    assert len(table) == 2000
    assert not table.error[0] and table.error[-1].startswith("not done: ")
    assert table["yaw"].tolist() == list(range(2000))


def test_a_lost_executor_ends_rows_that_have_no_end() -> None:
    executor = ThreadPoolExecutor(1)

    def make(yaw: float) -> Model:
        if yaw == 30:
            executor.shutdown(wait=False)
        return platform(yaw)

    table = sweep(make, ({"yaw": k} for k in itertools.count()), executor=executor)
    assert not table.error[0]
    assert table.error[-1].startswith("not done, nor is what would follow: ")


def test_progress_goes_to_one() -> None:
    told: list[tuple[str, float]] = []
    sweep(platform, {"yaw": range(4)}, progress=lambda *each: told.append(each), workers=1)
    assert told[-1] == ("variant 4", 1.0)
    assert [share for _, share in told] == sorted(share for _, share in told)


def test_method_and_tolerance_are_those_of_an_analysis() -> None:
    model = platform(89.0)
    plain = sweep(model, positions=model.positions[None], workers=1)
    loose = sweep(model, positions=model.positions[None], tolerance=0.1, workers=1)
    assert (plain.under_constrained[0], loose.under_constrained[0]) == (0, 1)
    made = sweep(platform, {"yaw": [89.0]}, tolerance=0.1, method="jacobi", workers=1)
    assert made.under_constrained[0] == 1


MODEL = platform(0.0)


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (lambda: sweep(MODEL), TypeError, "positions"),
        (lambda: sweep(MODEL, positions=MODEL.positions), ValueError, "shape"),
        (lambda: sweep(MODEL, positions=np.full((2, 6, 3), np.nan)), ValueError, "variant 0"),
        (lambda: sweep(MODEL, held=np.ones((2, 9, 6))), TypeError, "bool"),
        (
            lambda: sweep(
                MODEL, positions=MODEL.positions[None], held=np.ones((2, 9, 6), np.bool_)
            ),
            ValueError,
            "1 positions, but 2 masks",
        ),
        (
            lambda: sweep(MODEL, {"k": [1, 2]}, positions=MODEL.positions[None]),
            ValueError,
            "1 variants, but parameters of 2",
        ),
        (lambda: sweep(platform), TypeError, "parameters"),
        (lambda: sweep("deck.dat", {"yaw": [1]}), TypeError, "str"),
        (lambda: sweep(platform, {"yaw": [1]}, positions=[]), TypeError, "belong to a model"),
        (lambda: sweep(platform, 7), TypeError, "7"),
        (lambda: sweep(platform, "yaw"), TypeError, "yaw"),
        (lambda: sweep(platform, [1, 2]), TypeError, "mapping"),
        (lambda: sweep(platform, iter([1, 2])), TypeError, "mapping"),
        (lambda: sweep(platform, {"yaw": [1], "height": [1, 2]}), ValueError, "yaw 1, height 2"),
        (lambda: sweep(platform, {"verdict": [1]}), ValueError, "'verdict'"),
        (lambda: sweep(platform, {"error": [1]}), ValueError, "'error'"),
        (lambda: sweep(platform, {1: [1]}), TypeError, "text"),
        (lambda: sweep(platform, {"yaw": [(1, 2)]}), TypeError, "yaw"),
        (lambda: grid(rank=[1]), ValueError, "'rank'"),
        (lambda: grid(yaw=1), TypeError, "yaw"),
        (lambda: sweep(platform, {"yaw": [1]}, want="more"), ValueError, "verdict, values, all"),
        (lambda: sweep(platform, {"yaw": [1]}, method="qr2"), ValueError, "qr2"),
        (lambda: sweep(platform, {"yaw": [1]}, workers=0), ValueError, "workers"),
        (lambda: sweep(MODEL, positions=MODEL.positions[None], workers=0), ValueError, "workers"),
        (lambda: sweep(MODEL, positions=MODEL.positions[None], workers="2"), TypeError, "str"),
        (lambda: sweep(platform, {"yaw": [1]}, progress=3), TypeError, "progress"),
        (lambda: sweep(Model(), positions=np.zeros((1, 0, 3))), flexact.ModelError, "nothing"),
    ],
)
def test_wrong_calls_are_refused_in_words(call: Any, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words):
        call()


def test_no_variants_are_a_table_without_rows() -> None:
    for table in (
        sweep(platform, {"yaw": []}, workers=1),
        sweep(platform, iter([]), workers=1),
        sweep(MODEL, positions=np.zeros((0, 6, 3))),
        sweep(platform, [], want="all", workers=1),
    ):
        assert len(table) == 0 and list(table) == []
        assert "0 variants" in table.describe()
        assert len(table.gap) == 0
        assert repr(table) == "<Table: 0 variants>"
