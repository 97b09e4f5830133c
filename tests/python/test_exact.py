# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses as fractions: of frameworks whose vectors geometry gives."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from known_models import twelve_trusses

import flexact
from flexact import Analysis, Model, analyse
from flexact.core.arrays import Basis, FloatArray

#: Two cranks of one length side by side, and what joins them; the last bar is parallel to it.
PARALLELOGRAM = """
PLTRUSS 1 1 2
PLTRUSS 2 2 3
PLTRUSS 3 3 4
X 1 0 0
X 2 0.1 0.7
X 3 1.1 0.7
X 4 1 0
FIX 1
FIX 4
"""
#: Three bars in a line through decimals whose doubles are in none.
COLLINEAR = """
PLTRUSS 1 1 2
PLTRUSS 2 2 3
PLTRUSS 3 3 4
X 1 0 0
X 2 0.1 0.3
X 3 0.2 0.6
X 4 0.3 {}
FIX 1
FIX 4
"""


def dense(basis: Basis) -> FloatArray:
    made = np.zeros((basis.size, basis.vectors))
    made[basis.place, basis.of_entries()] = basis.value
    return made


def assert_same_spaces(analysis: Analysis) -> None:
    """Motions span the same space, and there are as many self-stresses."""
    exact = analysis.exact()
    motions = np.array(exact.motions, float).reshape(-1, analysis.columns).T
    found = dense(analysis.raw.motions)
    assert motions.shape == found.shape
    q = np.linalg.qr(motions)[0]
    assert np.abs(found - q @ (q.T @ found)).max(initial=0.0) < 1e-12
    assert np.abs(analysis.dense_jacobian() @ q).max(initial=0.0) < 1e-12
    assert len(exact.self_stresses) == analysis.over_constrained


def test_twelve_trusses() -> None:
    """Fig. 2 of the paper: all is of whole numbers, and all twelve bars are in the self-stress."""
    analysis = analyse(twelve_trusses())
    exact = analysis.exact()
    (motion,), (stress,) = exact.motions, exact.self_stresses
    assert exact.of == "decimals"
    assert len(motion) == len(analysis.column_labels) == 12
    assert len(stress) == len(analysis.row_labels) == 12
    assert {abs(part) for part in stress} <= {Fraction(1), Fraction(1, 2), Fraction(2)}
    assert_same_spaces(analysis)


def test_a_parallelogram_moves_across_its_cranks() -> None:
    analysis = analyse(flexact.read_text(PARALLELOGRAM))
    exact = analysis.exact()
    (motion,) = exact.motions
    assert motion == (Fraction(-7), Fraction(1), Fraction(-7), Fraction(1))
    assert exact.self_stresses == ()
    assert_same_spaces(analysis)


def test_bars_in_a_line() -> None:
    """Forces over lengths are the same in all; points move across the line, (-3, 1)."""
    analysis = analyse(flexact.read_text(COLLINEAR.format("0.9")))
    exact = analysis.exact()
    none, one, three = Fraction(0), Fraction(1), Fraction(-3)
    assert (exact.of, exact.self_stresses) == ("decimals", ((one, one, one),))
    assert exact.motions == ((three, one, none, none), (none, none, three, one))
    assert_same_spaces(analysis)


def test_doubles_that_are_not_quite_in_a_line() -> None:
    """With a digit too much in one decimal the doubles count: one motion, of large fractions."""
    analysis = analyse(flexact.read_text(COLLINEAR.format("0.90000000000000001")))
    exact = analysis.exact()
    assert (exact.of, len(exact.motions), exact.self_stresses) == ("doubles", 1, ())
    x = [[Fraction(part) for part in place] for place in ((0.0, 0.0), (0.1, 0.3), (0.2, 0.6))]
    x.append([Fraction(0.3), Fraction(0.9)])
    (motion,) = exact.motions
    move = [(Fraction(0),) * 2, motion[:2], motion[2:], (Fraction(0),) * 2]
    for p in range(3):
        pairs = zip(x[p], x[p + 1], move[p], move[p + 1], strict=True)
        assert sum((b - a) * (v - u) for a, b, u, v in pairs) == 0


@pytest.mark.parametrize("bars", [30, 100])
def test_fractions_of_many_digits(bars: int) -> None:
    """Points in guides along y and x by turns: each bar passes the motion on by its slope."""
    random = np.random.default_rng(7)
    place = np.round(np.cumsum(random.uniform(0.2, 1.0, (bars + 1, 2)), axis=0), 6)
    lines = [f"PLTRUSS {i} {i} {i + 1}" for i in range(1, bars + 1)]
    lines += [f"X {i} {x} {y}" for i, (x, y) in enumerate(place.tolist(), start=1)]
    lines += ["FIX 1", *(f"FIX {i} {1 + i % 2}" for i in range(3, bars + 2))]
    analysis = analyse(flexact.read_text("\n".join(lines)))
    (motion,) = analysis.exact().motions
    x = [[Fraction(str(part)) for part in point] for point in place.tolist()]
    move = [[Fraction(0), Fraction(0)] for _ in x]
    for (node, axis), part in zip(analysis.column_labels, motion, strict=True):
        move[node - 1]["xy".index(axis)] = part
    for p in range(bars):
        pairs = zip(x[p], x[p + 1], move[p], move[p + 1], strict=True)
        assert sum((b - a) * (v - u) for a, b, u, v in pairs) == 0
    assert max(part.denominator.bit_length() for part in motion) > 10 * bars
    assert_same_spaces(analysis)


def test_a_model_that_cannot_move() -> None:
    deck = "PLTRUSS 1 1 3\nPLTRUSS 2 2 3\nX 1 0 0\nX 2 2 0\nX 3 1 1\nFIX 1\nFIX 2\n"
    exact = analyse(flexact.read_text(deck)).exact()
    assert (exact.motions, exact.self_stresses) == ((), ())


def test_without_coordinates_every_deformation_is_a_stress() -> None:
    exact = analyse(flexact.read_text("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\nFIX 2\n")).exact()
    assert (exact.motions, exact.self_stresses) == ((), ((Fraction(1),),))


def test_what_is_too_large_is_refused() -> None:
    model = Model(planar=True)
    nodes = [model.node(float(i), 0.0) for i in range(503)]
    for p, q in itertools.pairwise(nodes):
        model.truss(p, q)
    with pytest.raises(flexact.AnalysisError, match="1006 columns"):
        analyse(model).exact()
