"""Self-stresses against declared freedoms and supports: what is offered works, and nothing else."""

import re
from pathlib import Path

import numpy as np
import pytest
from known_models import folded_sheet, twelve_trusses
from random_models import mechanism

from flexact import Analysis, Model, analyse, remedies
from flexact.elements import Class
from flexact.model_data import ModelData
from flexact.words import describe

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
    return {*remedies.driven_coordinates(analysis), *remedies.supports(analysis)}


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
    driven = remedies.driven_deformations(analysis)
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
                len(remedies.driven_deformations(analysis)),
                len(remedies.driven_coordinates(analysis)),
                len(remedies.supports(analysis)),
            )
    assert (kinds > 0).all(), "offers of all kinds were tried"


def test_a_size_changes_no_offer() -> None:
    offers = [
        (remedies.supports(analysis), remedies.releases(analysis))
        for analysis in (analyse(folded_sheet(True, size=size)) for size in (1e-6, 1.0, 1e6))
    ]
    assert offers[0] == offers[1] == offers[2] and offers[0][0]


def frame(size: float) -> Model:
    """Four beams in a skew ring, held at one corner."""
    model = Model()
    places = size * np.array([[0, 0, 0], [1, 0.3, 0.2], [1.1, 1.3, 0.7], [0, 1, 0.4]])
    corners = [model.node(*place) for place in places]
    for k in range(4):
        model.beam(corners[k], corners[(k + 1) % 4])
    model.fix(corners[0])
    return model


def test_stresses_within_a_free_frame_load_no_support() -> None:
    analysis = analyse(frame(1.0))
    assert analysis.over_constrained == 6
    assert remedies.supports(analysis) == []
    assert "support" not in describe(analysis)


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
    assert set(remedies.supports(analysis)) == {(end, axis) for end in ends for axis in range(3)}


def words(analysis: Analysis) -> str:
    return re.sub(r"\s+", " ", describe(analysis))


def test_words_offer_declarations_before_supports() -> None:
    # references.md: of a clamped fold the bending at the clamped end does not change.
    text = words(analyse(DECKS / "flexures/folded_sheet_clamped_trap.dat"))
    first = "element 1 (first sheet, ground to fold)"
    assert (
        "Or take a declaration away (driven against a constraint): "
        f"{first} e5 bending at p in the local xy plane (RLSE 1 5 instead) "
        "Or free a support: node 2 rz; "
    ) in text
    assert "To remove both, release all of: " in text
    supports = re.search(r"Or free a support: (.*?) To remove", text)
    assert supports is not None and supports[1].count("node") == 3


def test_words_offer_a_driven_coordinate_where_nothing_can_be_released() -> None:
    """A bar driven at its one free end, its elongation independent as well."""
    model = Model(planar=True)
    a, b = model.node(0, 0), model.node(2, 0)
    bar = model.truss(a, b)
    model.fix(a)
    model.fix(b, "y")
    model.independent(b, "x")
    model.independent(bar, 1)
    analysis = analyse(model)
    assert counts(analysis) == (0, 1)
    assert (
        "To remove it, take a declaration away (driven against a constraint): "
        "element 1 e1 elongation (RLSE 1 1 instead); node 3 x "
        "Or free a support: node 1 x"
    ) in words(analysis)


def test_operands_are_those_of_a_deck() -> None:
    # deck-language.md: of Euler parameters the components 2, 3 and 4 turn about x, y and z.
    analysis = analyse(folded_sheet(clamped=True))
    assert remedies.coordinate_operands(analysis, 0, 2) == "1 3"
    assert remedies.coordinate_operands(analysis, 1, 0) == "2 2"
    planar = Model(planar=True)
    planar.beam(planar.node(0, 0), planar.node(1, 0))
    assert remedies.coordinate_operands(analyse(planar), 1, 2) == "2 1"
    assert "(DYNX 9 2 or FIX 9 2)" in words(analyse(twelve_trusses()))
