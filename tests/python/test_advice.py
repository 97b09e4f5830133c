# SPDX-License-Identifier: BSD-3-Clause
"""Advice: each offer removes one motion or one self-stress, and sets of them remove all."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from known_models import (
    folded_sheet,
    hinges_in_a_point,
    ring,
    sheet_clamped_twice,
    twelve_trusses,
)

from flexact import Analysis, Model, analyse
from flexact.analysis import ways as leverage

DECKS = Path(__file__).resolve().parents[2] / "input_decks"

#: Number of an element and of its deformation, or of a node and name of its coordinate.
Deformation = tuple[int, int]


def released(analysis: Analysis) -> list[Deformation]:
    """Rows that can be released, the largest share first."""
    return [analysis.row_labels[row] for row in leverage.releases(analysis)]


def declared(analysis: Analysis) -> list[tuple[int, str]]:
    """Columns that can be declared or held, the largest share first."""
    return [analysis.column_labels[column] for column in leverage.coordinates(analysis)]


def numbered(analysis: Analysis, places: list[tuple[int, int]]) -> list[Deformation]:
    """Deformations by the number of their element in place of its index."""
    numbers = analysis.model.element_numbers.tolist()
    return [(numbers[index], deformation) for index, deformation in places]


def test_the_twelve_trusses_offer_all_that_takes_part() -> None:
    """Table 2 of the paper: each top node moves along one axis; all twelve bars are stressed."""
    analysis = analyse(twelve_trusses())
    assert set(released(analysis)) == {(bar, 1) for bar in range(1, 13)}
    assert declared(analysis) == [(9, "y"), (11, "x"), (13, "y"), (15, "x")]
    assert leverage.deformations(analysis) == []


def test_the_clamped_fold_offers_its_ends_to_the_stress_and_its_middle_to_the_motion() -> None:
    """tests/reference/known_answers.md, Flexures: the independent bending belongs at the fold,
    e6 of the first sheet or e5 of the second; the stress is in e3 and e4 of the clamped ends.
    """
    analysis = analyse(folded_sheet(clamped=True))
    assert released(analysis) == [(1, 3), (2, 4)]
    assert declared(analysis) == [(4, "rz")]
    assert numbered(analysis, leverage.deformations(analysis)) == [(1, 6), (2, 5)]
    assert len(leverage.supports(analysis)) > 0


def test_a_sheet_clamped_twice_offers_all_that_it_holds() -> None:
    analysis = analyse(sheet_clamped_twice())
    assert (analysis.rows, analysis.columns, analysis.rank) == (3, 0, 0)
    assert released(analysis) == [(1, 1), (1, 3), (1, 4)]
    assert declared(analysis) == []
    html = analysis._repr_html_()
    assert "leaf &lt;1&gt;" in html and "<1>" not in html


def test_what_is_exact_gets_no_advice() -> None:
    analysis = analyse(ring(5))
    assert released(analysis) == declared(analysis) == leverage.deformations(analysis) == []
    assert leverage.supports(analysis) == leverage.driven_coordinates(analysis) == []


def test_a_zero_has_no_sign() -> None:
    # LAPACK gives -0.0 for this deck's zero.
    analysis = analyse(DECKS / "flexures" / "parallel_guide_undeclared.dat")
    zero = analysis.gap.largest_zero
    assert zero is not None and math.copysign(1.0, zero) == 1.0
    assert not np.signbit(analysis.scaled_singular_values).any()
    assert analysis.gap.ratio is not None and math.copysign(1.0, analysis.gap.ratio) == 1.0


def test_mechanism_without_extent() -> None:
    analysis = analyse(hinges_in_a_point())
    assert (analysis.under_constrained, analysis.over_constrained) == (5, 0)
    assert len(declared(analysis)) >= 5
    assert {coordinate for _, coordinate in declared(analysis)} <= {"rx", "ry", "rz"}


def counts(model: Model) -> tuple[int, int]:
    analysis = analyse(model)
    return analysis.under_constrained, analysis.over_constrained


@pytest.mark.parametrize("make", [twelve_trusses, lambda: folded_sheet(True, 2), lambda: ring(6)])
def test_each_offer_removes_one(make: Callable[[], Model]) -> None:
    analysis = analyse(make())
    m, s = counts(make())
    for row in leverage.releases(analysis):
        model = make()
        element, deformation = analysis.row_labels[row]
        model.release(element, deformation)
        assert counts(model) == (m, s - 1)
    for column in leverage.coordinates(analysis):
        model = make()
        node, coordinate = analysis.column_labels[column]
        model.independent(node, coordinate)
        assert counts(model) == (m - 1, s)
    for index, deformation in leverage.deformations(analysis):
        model = make()
        model.independent(int(model.element_numbers[index]), deformation)
        assert counts(model) == (m - 1, s)


@pytest.mark.parametrize("beams", [1, 2, 3])
def test_sets_of_offers_remove_all(beams: int) -> None:
    model = folded_sheet(False, beams)
    analysis = analyse(model)
    for column in leverage.coordinate_set(analysis):
        node, coordinate = analysis.column_labels[column]
        model.independent(node, coordinate)
    assert counts(model) == (0, 0)


def test_release_set_removes_all_self_stresses() -> None:
    def frame() -> Model:
        model = Model()
        corners = [model.node(x, y, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for k in range(4):
            model.beam(corners[k], corners[(k + 1) % 4])
        model.fix(corners[0])
        return model

    model = frame()
    analysis = analyse(model)
    assert counts(model) == (0, 6)
    for row in leverage.release_set(analysis):
        model.release(*analysis.row_labels[row])
    assert counts(model) == (0, 0)
