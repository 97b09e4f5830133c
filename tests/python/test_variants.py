# SPDX-License-Identifier: BSD-3-Clause
"""Variants of one topology in the core say what an analysis of each says."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import flexact
from flexact.core.elements import Class
from flexact.model.data import ModelData
from flexact.model.variation import positions_given
from flexact.sweeps import evaluate
from flexact.sweeps.columns import WANTS, row_of

DECKS = Path(__file__).resolve().parents[2] / "input_decks"
SAMPLES = (
    *("paper/five_folded_sheets", "paper/six_folded_sheets", "paper/twelve_trusses"),
    *("flexures/parallel_guide", "flexures/cross_hinge", "frameworks/octahedral_platform_yaw_90"),
    *("linkages/sarrus", "linkages/slider_crank_planar", "flexures/six_wires"),
)
#: Numbers that are the same but for rounding, and the margin where the value is one of one.
CLOSE = {
    "gap": 1e-9,
    "largest_zero": math.inf,
    "smallest_singular_value": 1e-8,
    "condition_number": 1e-8,
    "margin": 1e-6,
    "margin_angle": 1e-6,
}


def swept(
    data: ModelData,
    positions: np.ndarray | None = None,
    held: np.ndarray | None = None,
    want: str = "values",
    **how: Any,
) -> dict[str, np.ndarray]:
    return evaluate.swept(evaluate.Positions(data, positions, held), want, **how)


def deck(name: str) -> flexact.Model:
    return flexact.read(DECKS / f"{name}.dat")


def misaligned(model: flexact.Model, seed: int, count: int = 12) -> np.ndarray:
    """Nodes off by much, by little, by hardly anything, and not at all; one variant rounded."""
    random = np.random.default_rng(seed)
    sizes = np.array([0.0, 1e-15, 1e-13, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0])
    extent = np.ptp(model.positions)
    off = random.standard_normal((count, *model.positions.shape))
    made = model.positions + extent * np.resize(sizes, count)[:, None, None] * off
    made[-1] = np.round(made[-1], 3)
    return made


def have_equals(analysis: flexact.Analysis) -> bool:
    """Whether some of the smallest values are equal: which vectors stand for them is open, and
    the margin is theirs."""
    values = np.array([pair.value for pair in analysis.pairs])
    beyond = analysis.scaled_singular_values[: analysis.rank][::-1][: values.size + 1]
    return bool(np.any(np.diff(beyond) < 1e-6 * beyond[:-1]))


def expect_rows(table: dict[str, np.ndarray], models: list[flexact.Model], want: str) -> None:
    for i, model in enumerate(models):
        try:
            analysis = flexact.analyse(model)
        except flexact.FlexactError as error:
            assert str(error) == table["error"][i] and table["verdict"][i] == ""
            continue
        open_choice = have_equals(analysis)
        for name, value in row_of(analysis, want).items():
            found = table[name][i]
            if open_choice and name.startswith("margin"):
                continue
            if isinstance(value, float) and not (math.isnan(value) or math.isinf(value)):
                assert found == pytest.approx(value, rel=CLOSE[name], abs=1e-14), (i, name)
            elif isinstance(value, float):
                assert str(float(found)) == str(value), (i, name)
            else:
                assert found == value, (i, name)


@pytest.mark.parametrize("want", ["verdict", "values"])
@pytest.mark.parametrize("name", SAMPLES)
def test_positions_say_what_an_analysis_says(name: str, want: str) -> None:
    model = deck(name)
    positions = misaligned(model, 7)
    table = swept(model.data, positions=positions, want=want)
    expect_rows(table, [model.with_positions(p) for p in positions], want)


@pytest.mark.parametrize("want", ["verdict", "values"])
def test_masks_of_what_is_held(want: str) -> None:
    model = deck("paper/five_folded_sheets")
    own = model.deformation_classes == Class.FIXED
    masks = np.repeat(own[None], 40, axis=0)
    random = np.random.default_rng(3)
    for mask in masks[1:]:
        element, deformation = random.integers(own.shape)
        mask[element, deformation] ^= True
    table = swept(model.data, held=masks, want=want)
    expect_rows(table, [model.with_held(mask) for mask in masks], want)
    assert len(set(table["verdict"])) > 2


def test_positions_and_masks_together() -> None:
    model = deck("flexures/parallel_guide")
    positions = misaligned(model, 5)
    held = np.repeat((model.deformation_classes == Class.FIXED)[None], len(positions), axis=0)
    held[::2, 0, :] = True
    table = swept(model.data, positions=positions, held=held)
    models = [model.with_positions(p).with_held(h) for p, h in zip(positions, held, strict=True)]
    expect_rows(table, models, "values")


def test_a_variant_that_cannot_be_is_a_row_with_its_error() -> None:
    model = deck("flexures/parallel_guide")
    positions = np.repeat(model.positions[None], 3, axis=0)
    p, q = model.element_nodes[0, [0, 2]]
    positions[1, q] = positions[1, p]
    table = swept(model.data, positions=positions)
    assert table["error"][0] == table["error"][2] == ""
    assert "has zero length" in table["error"][1]
    assert table["rank"][1] == -1 and math.isnan(table["gap"][1]) and table["verdict"][1] == ""


def test_divided_sheets_count_as_one_beam_in_each_variant() -> None:
    guide = flexact.Model()
    for k, y in enumerate((0.0, 0.05), start=1):
        guide.sheet((0, y, 0), (0.1, y, 0), width=(0, 0, 1), name=f"sheet {k}", beams=4)
        guide.fix((0, y, 0))
    guide.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    guide.independent("stage", "y")
    positions = misaligned(guide, 2)
    expect_rows(
        swept(guide.data, positions=positions),
        [guide.with_positions(p) for p in positions],
        "values",
    )


def test_threads_give_what_one_gives() -> None:
    model = deck("paper/five_folded_sheets")
    positions = misaligned(model, 11, 500)
    one, four = (swept(model.data, positions=positions, workers=n) for n in (1, 4))
    for name in one:
        assert np.array_equal(one[name], four[name], equal_nan=one[name].dtype.kind == "f")


def test_progress_ends_at_all() -> None:
    model = deck("flexures/parallel_guide")
    heard: list[float] = []
    positions = misaligned(model, 1, 300)
    swept(model.data, positions=positions, progress=lambda what, part: heard.append(part))
    assert heard[-1] == 1.0 and heard == sorted(heard)


def test_no_variants_are_an_empty_table() -> None:
    model = deck("flexures/parallel_guide")
    for want in WANTS:
        table = swept(model.data, positions=np.empty((0, *model.positions.shape)), want=want)
        assert all(len(column) == 0 for column in table.values())


def test_with_positions_and_with_held_give_the_same_model_back() -> None:
    model = deck("paper/five_folded_sheets")
    deck_text = model.to_deck()
    assert model.with_positions(model.positions).to_deck() == deck_text
    assert model.with_held(model.deformation_classes == Class.FIXED).to_deck() == deck_text


def test_vectors_and_orientations_stay() -> None:
    model = deck("paper/five_folded_sheets")
    moved = model.with_positions(model.positions + np.array([1.0, 2.0, 3.0]))
    assert np.array_equal(moved.element_vectors, model.element_vectors)
    orientations = model.node_kinds == 4
    assert np.array_equal(moved.node_values[orientations], model.node_values[orientations])
    assert moved.positions[0] == pytest.approx(model.positions[0] + [1, 2, 3])


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        ([[0.0] * 3] * 3, ValueError, r"the shape \(2 nodes, 3\), not \(3, 3\)"),
        (None, TypeError, "must be numbers"),
        ([[0.0] * 3, [0.0, math.nan, 0.0]], ValueError, "nan as y of node 3"),
    ],
)
def test_wrong_positions_in_words(given: object, error: type[Exception], words: str) -> None:
    model = flexact.read_text("TRUSS 1 1 3\nX 3 1 0 0\nFIX 1\n")
    with pytest.raises(error, match=words):
        model.with_positions(given)


def test_numbers_of_orientations_are_not_looked_at() -> None:
    model = deck("paper/five_folded_sheets")
    positions = model.positions.copy()
    positions[model.node_kinds == 4] = math.nan
    assert positions_given(model.data, positions, many=False).shape == positions.shape
    assert flexact.analyse(model.with_positions(positions)).rank == flexact.analyse(model).rank
