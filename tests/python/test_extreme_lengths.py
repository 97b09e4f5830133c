# SPDX-License-Identifier: BSD-3-Clause
"""Lengths from 1e-9 to 1e9, also within one drawing; slender ones; many beams a sheet."""

import pytest
from known_models import folded_sheet, undeclared_sheet
from reference_decks import NAMES, text_of, transform, truth_of
from verdicts import (
    METHODS,
    assert_all_right,
    assert_all_right_or_nearly,
    assert_right,
)

from flexact import Model, Node, analyse, read_text


@pytest.mark.parametrize("factor", [1e-9, 1e-4, 1e4, 1e9])
@pytest.mark.parametrize("name", NAMES)
def test_every_method_in_any_unit(name: str, factor: float) -> None:
    model = read_text(transform.scaled(text_of(name), factor))
    for method in METHODS:
        assert_right(analyse(model, method=method), truth_of(name))


# Slender mechanisms


def add_guide(model: Model, at: float, length: float, apart: float, beams: int = 1) -> Node:
    """Two parallel sheets and a stage: one motion, one self-stress, whatever their distance."""
    a, b = model.node(at, 0, 0), model.node(at + length, 0, 0)
    c, d = model.node(at, apart, 0), model.node(at + length, apart, 0)
    undeclared_sheet(model, a, b, beams)
    undeclared_sheet(model, c, d, beams)
    model.rigid(b, d)
    model.fix(a)
    model.fix(c)
    return d


@pytest.mark.parametrize("apart", [1e-6, 1e-3, 1e3, 1e6])
def test_guide_with_sheets_close_by_or_far_apart(apart: float) -> None:
    model = Model()
    add_guide(model, 0.0, 1.0, apart)
    assert_all_right_or_nearly(model, (1, 1))


def five_wires(length: float, arm: float, height: float) -> Model:
    """A guide along z: two wires along x and one along y above, one of each below."""
    model = Model()
    body = model.node(0, 0, 0)
    along_x = [(arm, height), (-arm, height), (0.0, -height)]
    ends = [((0.0, y, z), (length, y, z)) for y, z in along_x]
    ends += [((arm, 0.0, z), (arm, length, z)) for z in (height, -height)]
    for near, far in ends:
        inner, ground = model.node(*near), model.node(*far)
        model.rigid(body, inner)
        model.truss(inner, ground)
        model.fix(ground)
    return model


@pytest.mark.parametrize("length", [1e-2, 1.0, 1e6])
@pytest.mark.parametrize("height", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_slender_body_on_five_wires(length: float, height: float) -> None:
    assert_all_right_or_nearly(five_wires(length, 1.0, height), (1, 0))


# Sheets divided into beams: three internal motions more a beam (paper, section 4.2)


@pytest.mark.parametrize("beams", [1, 2, 5, 16])
def test_divided_sheets_by_every_method(beams: int) -> None:
    more = 3 * 2 * (beams - 1)
    model = Model()
    add_guide(model, 0.0, 1.0, 0.25, beams)
    assert_all_right(model, (1 + more, 1))
    assert_all_right(folded_sheet(True, beams), (1 + more, 1))
    assert_all_right(folded_sheet(False, beams), (6 + more, 0))


@pytest.mark.parametrize("beams", [32, 64, 128, 256])
@pytest.mark.parametrize("method", ["sparse", "auto"])
def test_sheets_of_very_many_beams(method: str, beams: int) -> None:
    more = 3 * 2 * (beams - 1)
    model = Model()
    add_guide(model, 0.0, 1e-3, 1e-3, beams)
    assert_right(analyse(model, method=method), (1 + more, 1))
    assert_right(analyse(folded_sheet(True, beams), method=method), (1 + more, 1))


def test_a_single_sheet_of_very_many_beams() -> None:
    """Clamped at both ends it keeps its three self-stresses."""
    for beams in (1, 2, 64, 256):
        model = Model()
        a, b = model.node(0, 0, 0), model.node(1, 0, 0)
        undeclared_sheet(model, a, b, beams)
        model.fix(a)
        model.fix(b)
        assert_right(analyse(model, method="sparse"), (3 * (beams - 1), 3))


# Lengths that differ within one drawing


RATIOS = [1e2, 1e4, 1e6, 1e8]


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("others", [1, 5])
def test_separate_guides_of_very_different_size(ratio: float, others: int) -> None:
    large, small = Model(), Model()
    add_guide(large, 0.0, 1.0, 0.25)
    add_guide(small, 0.0, 1.0, 0.25)
    for k in range(others):
        add_guide(large, (3 + 3 * k) * ratio, ratio, 0.25 * ratio)
        add_guide(small, 2.0 + 2 * k / ratio, 1 / ratio, 0.25 / ratio)
    truth = (1 + others, 1 + others)
    for model in (large, small):
        assert_all_right_or_nearly(model, truth)


@pytest.mark.parametrize("ratio", RATIOS)
def test_separate_cantilevers_of_very_different_length(ratio: float) -> None:
    for first, other in ((1.0, 1 / ratio), (1.0, ratio)):
        model = Model(planar=True)
        for k in range(10):
            length = other if k else first
            foot, tip = model.node(2 * k * length, 0), model.node((2 * k + 1) * length, 0)
            model.beam(foot, tip)
            model.fix(foot)
        assert_all_right_or_nearly(model, (0, 0))


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("first", ["long", "short"])
def test_folded_sheet_with_legs_of_very_different_length(ratio: float, first: str) -> None:
    """Six motions with a free end, one and one self-stress with both ends clamped."""
    here, there = (1.0, 1 / ratio) if first == "long" else (1 / ratio, 1.0)
    for clamped, truth in ((False, (6, 0)), (True, (1, 1))):
        model = Model()
        a, b, c = model.node(0, 0, 0), model.node(here, 0, 0), model.node(here, there, 0)
        model.sheet(a, b, (0, 0, 1))
        model.sheet(b, c, (0, 0, 1))
        model.fix(a)
        if clamped:
            model.fix(c)
        assert_all_right_or_nearly(model, truth)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("planar", [True, False])
def test_cantilever_of_a_long_and_a_short_beam(ratio: float, planar: bool) -> None:
    """Held exactly: whatever their lengths, each beam carries the next one."""
    for first, second in ((1.0, 1 / ratio), (1 / ratio, 1.0)):
        model = Model(planar=planar)
        a, b, c = model.node(0, 0), model.node(first, 0), model.node(first, second)
        model.beam(a, b)
        model.beam(b, c)
        model.fix(a)
        assert_all_right_or_nearly(model, (0, 0))


@pytest.mark.parametrize("ratio", RATIOS)
def test_stage_on_a_stage_of_very_different_size(ratio: float) -> None:
    """Each guide adds a motion and a self-stress."""
    for first, second in ((1.0, 1 / ratio), (1 / ratio, 1.0)):
        model = Model()
        stage = add_guide(model, 0.0, first, first / 4)
        low = model.node(first + second, first / 4, 0)
        foot = model.node(first, first / 4 + second / 4, 0)
        high = model.node(first + second, first / 4 + second / 4, 0)
        model.rigid(stage, foot)
        model.sheet(stage, low, (0, 0, 1))
        model.sheet(foot, high, (0, 0, 1))
        model.rigid(low, high)
        assert_all_right_or_nearly(model, (2, 2))
