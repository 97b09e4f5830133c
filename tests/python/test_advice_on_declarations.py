# SPDX-License-Identifier: BSD-3-Clause
"""Self-stresses against declared freedoms and supports: what is offered works, and nothing else."""

from pathlib import Path

import numpy as np
import pytest
from known_models import bar_driven_twice, folded_sheet, frame, twelve_trusses
from random_models import mechanism

from flexact import Analysis, Model, analyse
from flexact.analysis import ways as leverage
from flexact.analysis.ways import coordinate_of
from flexact.core.elements import Class
from flexact.model.data import ModelData

DECKS = Path(__file__).resolve().parents[2] / "input_decks"
DRIVEN = [
    "flexures/folded_sheet_clamped_trap",
    "flexures/five_folded_sheets_trap",
    "paper/five_folded_sheets_symmetric",
    "paper/six_folded_sheets",
    "linkages/bennett",
]


def changed(analysis: Analysis, array: str, place: tuple[int, int]) -> Analysis:
    """The same model with one coordinate or deformation dependent, analysed anew."""
    data = analysis.data
    classes = getattr(data.arrays, array).copy(order="F")
    classes[place] = Class.DEPENDENT
    arrays = data.arrays._replace(**{array: classes})
    names = tuple(data.element_names)
    return analyse(Model.from_data(ModelData(arrays, data.planar, "changed", names)))


def counts(analysis: Analysis) -> tuple[int, int]:
    return analysis.under_constrained, analysis.over_constrained


def offered_coordinates(analysis: Analysis) -> set[tuple[int, int]]:
    return {*leverage.driven_coordinates(analysis), *leverage.supports(analysis)}


def require_that_offers_work(analysis: Analysis) -> None:
    """Each offer takes one self-stress away and makes no motion; the others take none."""
    m, s = counts(analysis)
    offers = offered_coordinates(analysis)
    classes = analysis.data.arrays.coordinate_class
    for axis, node in np.argwhere((classes == Class.FIXED) | (classes == Class.INDEPENDENT)):
        after = changed(analysis, "coordinate_class", (axis, node))
        better = s - after.over_constrained
        assert better == ((node, axis) in offers)
        assert after.under_constrained == m + 1 - better
    driven = leverage.driven_deformations(analysis)
    classes = analysis.data.arrays.deformation_class
    for row, element in np.argwhere(classes == Class.INDEPENDENT):
        after = changed(analysis, "deformation_class", (row, element))
        better = s - after.over_constrained
        assert better == ((element, row + 1) in driven)
        assert after.under_constrained == m + 1 - better


@pytest.mark.parametrize("name", DRIVEN)
def test_offers_of_a_deck_remove_one_self_stress_each(name: str) -> None:
    analysis = analyse(DECKS / f"{name}.dat")
    assert offered_coordinates(analysis)
    require_that_offers_work(analysis)


@pytest.mark.parametrize("planar", [False, True])
def test_offers_of_random_mechanisms_remove_one_self_stress_each(planar: bool) -> None:
    random = np.random.default_rng(6)
    kinds = np.zeros(3, int)
    for _ in range(60):
        model = mechanism(random, planar)
        if not model.element_numbers.size or model.data.problems.errors:
            continue
        analysis = analyse(model)
        if analysis.over_constrained:
            require_that_offers_work(analysis)
            kinds += (
                len(leverage.driven_deformations(analysis)),
                len(leverage.driven_coordinates(analysis)),
                len(leverage.supports(analysis)),
            )
    assert (kinds > 0).all(), "offers of all kinds were tried"


def test_a_size_changes_no_offer() -> None:
    offers = [
        (leverage.supports(analysis), leverage.releases(analysis))
        for analysis in (analyse(folded_sheet(True, size=size)) for size in (1e-6, 1.0, 1e6))
    ]
    assert offers[0] == offers[1] == offers[2] and offers[0][0]


def test_stresses_within_a_free_frame_load_no_support() -> None:
    analysis = analyse(frame(1.0))
    assert analysis.over_constrained == 6
    assert leverage.supports(analysis) == []


@pytest.mark.parametrize("size", [1.0, 1e-9, 1e-40])
def test_a_small_part_beside_a_large_one_hides_and_adds_no_support(size: float) -> None:
    model = frame(size)
    bar = model.node(1, 0, 0), model.node(0, 1, 1)
    model.truss(*bar)
    for node in bar:
        model.fix(node)
    analysis = analyse(model)
    assert analysis.over_constrained == 7
    ends = [model.node_index(node.position) for node in bar]
    assert set(leverage.supports(analysis)) == {(end, axis) for end in ends for axis in range(3)}


def test_declarations_are_offered_beside_supports() -> None:
    """tests/reference/known_answers.md, Flexures: the bending at the clamped end of a clamped
    fold does not change, so that declaring it independent, e5 of the first sheet, is no freedom.
    """
    analysis = analyse(DECKS / "flexures/folded_sheet_clamped_trap.dat")
    assert counts(analysis) == (1, 2)
    assert leverage.driven_deformations(analysis) == [(analysis.model.element_index(1), 5)]
    assert leverage.driven_coordinates(analysis) == []
    numbers = analysis.model.node_numbers
    node, axis = leverage.supports(analysis)[0]
    assert (numbers[node], axis) == (2, 2)
    assert len(leverage.supports(analysis)) >= 3
    assert len(leverage.release_set(analysis)) == 2


def test_a_driven_coordinate_is_offered_where_nothing_can_be_released() -> None:
    analysis = analyse(bar_driven_twice())
    assert counts(analysis) == (0, 1)
    first, driven = (analysis.model.node_index(number) for number in (1, 3))
    assert leverage.releases(analysis) == []
    assert leverage.driven_deformations(analysis) == [(0, 1)]
    assert leverage.driven_coordinates(analysis) == [(driven, 0)]
    assert leverage.supports(analysis) == [(first, 0)]


def test_operands_are_those_of_a_deck() -> None:
    # docs/decks.md, Nodes: of Euler parameters the components 2, 3 and 4 turn about x, y and z.
    analysis = analyse(folded_sheet(clamped=True))
    assert coordinate_of(analysis, 0, 2).operands == "1 3"
    assert coordinate_of(analysis, 1, 0).operands == "2 2"
    planar = Model(planar=True)
    planar.beam(planar.node(0, 0), planar.node(1, 0))
    assert coordinate_of(analyse(planar), 1, 2).operands == "2 1"
    trusses = analyse(twelve_trusses())
    assert coordinate_of(trusses, trusses.model.node_index(9), 1).operands == "9 2"
