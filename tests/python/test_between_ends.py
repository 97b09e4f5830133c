# SPDX-License-Identifier: BSD-3-Clause
"""Which motions move nothing but what is between the ends of flexures: insides and folds.

How many there are follows from the rank of the columns of D(c) that belong to these nodes, by
numpy; of the paper's mechanisms it is known.
"""

from itertools import pairwise

import numpy as np
import pytest
from reference_decks import ROOT

from flexact import Analysis, Model, analyse


def deck(name: str) -> Analysis:
    return analyse(ROOT / "input_decks" / f"{name}.dat")


def of_columns(analysis: Analysis, nodes: set[int]) -> int:
    """The dimension of the motions that move some nodes alone."""
    mine = [k for k, (node, _) in enumerate(analysis.column_labels) if node in nodes]
    part = analysis.dense_jacobian()[:, mine]
    return len(mine) - int(np.linalg.matrix_rank(part))


@pytest.mark.parametrize(
    ("name", "motions", "internal"),
    [
        ("paper/folded_sheet_free", 6, 1),
        ("paper/folded_sheet_clamped", 1, 1),
        ("flexures/five_folded_sheets_undeclared", 6, 5),
        ("flexures/six_folded_sheets_undeclared", 7, 6),
        ("flexures/folded_sheet_free_internal", 5, 0),
        ("flexures/parallel_guide_undeclared", 1, 0),
        ("flexures/parallel_guide_four_beams_undeclared", 19, 18),
        ("flexures/five_wires_undeclared", 1, 0),
        ("paper/twelve_trusses", 1, 0),
        ("frameworks/collinear_bars_space", 2, 0),
        ("linkages/bennett", 1, 0),
    ],
)
def test_motions_of_the_paper_are_internal_or_not(name: str, motions: int, internal: int) -> None:
    """Folded sheets turn at each fold that nobody declares; a framework has no inside."""
    analysis = deck(name)
    assert analysis.under_constrained == motions == len(analysis.are_between_ends)
    assert sum(analysis.are_between_ends) == internal


def folded(points: list[tuple[float, float, float]], clamped: bool) -> tuple[Model, set[int]]:
    """Sheets in series whose widths are along y; the nodes of their folds."""
    model = Model()
    nodes = [model.node(*point) for point in points]
    for k, (p, q) in enumerate(pairwise(nodes), start=1):
        model.sheet(p, q, (0, 1, 0), name=f"sheet {k}")
    model.fix(*([nodes[0], nodes[-1]] if clamped else nodes[:1]))
    return model, {n for node in nodes[1:-1] for n in (node.position, node.orientation)}


@pytest.mark.parametrize("clamped", [False, True])
@pytest.mark.parametrize("sheets", [2, 3, 4, 5])
def test_folds_in_series_are_internal(sheets: int, clamped: bool) -> None:
    points = [(0.1 * k, 0.0, 0.1 * (k % 2)) for k in range(sheets + 1)]
    model, folds = folded(points, clamped)
    analysis = analyse(model)
    wanted = of_columns(analysis, folds)
    assert wanted >= 1
    assert sum(analysis.are_between_ends) == wanted
    for motion, inside in zip(analysis.motions, analysis.are_between_ends, strict=True):
        moved = {node for node, _, _ in motion.largest(100)}
        assert (moved <= folds) == inside


def test_a_body_at_a_fold_is_no_inside() -> None:
    model = Model()
    ground, fold, end = (model.node(x, 0, z) for x, z in ((0, 0), (0.1, 0), (0.1, -0.1)))
    model.sheet(ground, fold, (0, 1, 0), name="leaf 1")
    model.sheet(fold, end, (0, 1, 0), name="leaf 2")
    model.fix(ground, end)
    assert analyse(model).are_between_ends == (True,)
    model.body([fold, (0.1, 0.05, 0.0)], name="block")
    assert analyse(model).are_between_ends == (False,)


def test_a_point_that_three_sheets_carry_is_a_body() -> None:
    model = Model()
    middle = model.node(0, 0, 0)
    for k, (x, y) in enumerate(((1, 0), (0, 1), (-1, 0)), start=1):
        end = model.node(0.1 * x, 0.1 * y, 0)
        model.sheet(middle, end, (-y, x, 0), name=f"sheet {k}")
        model.fix(end)
    analysis = analyse(model)
    assert analysis.under_constrained == 3
    assert not any(analysis.are_between_ends)


def test_an_analysis_without_motions_has_none() -> None:
    assert deck("paper/five_wires").are_between_ends == ()
