# SPDX-License-Identifier: BSD-3-Clause
"""Paths on D(x) = 0: derivatives, how far they go, why they end, and the least error beside one."""

import numpy as np
import pytest
from reference_decks import ROOT

import flexact
from flexact.motion import Ending, Followed, Held, Wishes, constraints, follow, least_error
from flexact.motion.bordered import smallest_of
from flexact.util.rotations import left_jacobian

DECKS = ROOT / "input_decks"


def analysed(name: str) -> flexact.Analysis:
    return flexact.analyse(DECKS / f"{name}.dat")


def both_ways(analysis: flexact.Analysis, wishes: Wishes) -> list[Followed]:
    """The path of the first motion, against it and along it."""
    motion = analysis.motions[0].analysed
    held = Held(motion.data)
    direction = held.direction(motion)
    return [follow(held, sign * direction, analysis.rank, wishes) for sign in (-1.0, 1.0)]


@pytest.mark.parametrize(
    "name", ["linkages/bennett", "flexures/two_tilted_sheets", "linkages/slider_crank_planar"]
)
def test_derivatives_are_those_of_the_deformations(name: str) -> None:
    """Central differences, also where the nodes have turned by as much as a radian."""
    held = Held(analysed(name).data)
    rng = np.random.default_rng(7)
    change = rng.uniform(-0.4, 0.4, held.columns.size)
    jacobian, h = held.at(held.reference, change).jacobian, 1e-6
    for k in range(change.size):
        step = np.zeros(change.size)
        step[k] = h
        there, back = (held.at(held.reference, change + s * step).error for s in (1.0, -1.0))
        assert (there - back) / (2 * h) == pytest.approx(jacobian[:, k], abs=2e-9)


def test_the_derivative_of_a_rotation_vector_is_that_of_its_matrix() -> None:
    """T(v) dv is the small rotation between exp(v) and exp(v + dv): T(v) v = v for any v."""
    for size in (1e-9, 1e-5, 1e-3, 1.0, 3.0):
        v = size * np.array([[0.6, 0.0, 0.8]])
        assert left_jacobian(v)[0] @ v[0] == pytest.approx(v[0], rel=1e-15)
        # About an axis across v it is sin|v|/|v|.
        across = np.array([0.0, 1.0, 0.0])
        assert across @ left_jacobian(v)[0] @ across == pytest.approx(np.sinc(size / np.pi))


def test_a_difference_leads_from_one_configuration_to_another() -> None:
    held = Held(analysed("linkages/bennett").data)
    change = np.random.default_rng(3).uniform(-0.5, 0.5, held.columns.size)
    there = held.at(held.reference, change).configuration
    assert held.difference(held.reference, there) == pytest.approx(change, abs=1e-14)


@pytest.mark.parametrize(
    "name",
    [
        *("paper/twelve_trusses", "linkages/bennett", "linkages/sarrus", "frameworks/ring_4"),
        *("frameworks/k33_two_lines", "frameworks/third_order_finite", "linkages/loop_7r"),
        *("linkages/four_bar_in_space", "linkages/parallelogram_three_cranks"),
    ],
)
def test_finite_motions_go_on(name: str) -> None:
    """Classical; see references: a tenth of the size both ways, with nothing left but rounding."""
    analysis = analysed(name)
    for way in both_ways(analysis, Wishes()):
        assert way.stop.ending is Ending.LENGTH and 0.0999 < way.length < 0.101
        assert way.residual < 1e-14
        assert {station.rank for station in way.stations} == {analysis.rank}


@pytest.mark.parametrize(
    "name",
    [
        *("frameworks/collinear_bars_plane", "frameworks/prism_twist_30", "frameworks/k33_circle"),
        *("frameworks/octahedral_platform_yaw_90", "frameworks/third_order"),
    ],
)
def test_infinitesimal_motions_do_not(name: str) -> None:
    analysis = analysed(name)
    for way in both_ways(analysis, Wishes()):
        assert way.stop.ending is Ending.NOT_ZERO and way.length < 1e-3


def test_the_least_error_is_that_of_the_closed_form() -> None:
    """Two collinear bars whose joint goes aside by y: both are sqrt(1 + y^2) long."""
    analysis = analysed("frameworks/collinear_bars_plane")
    held = Held(analysis.data)
    direction = held.direction(analysis.motions[0].analysed)
    for t in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
        y = 2.0 * t
        longer = y * y / (np.sqrt(1.0 + y * y) + 1.0)
        error, _ = least_error(held, direction, t)
        assert error == pytest.approx(np.sqrt(2.0) * longer / 2.0, rel=1e-9, abs=3e-16)


def test_orders_of_the_error_down_to_rounding() -> None:
    for name, order, least in (
        ("frameworks/prism_twist_30", 2, 1e-6),
        ("frameworks/k33_circle", 2, 1e-6),
        ("frameworks/third_order", 4, 1e-3),
    ):
        analysis = analysed(name)
        held = Held(analysis.data)
        direction = held.direction(analysis.motions[0].analysed)
        t = least * 2.0 ** np.arange(4)
        errors = [least_error(held, direction, each)[0] for each in t.tolist()]
        assert np.diff(np.log2(errors)) == pytest.approx(np.full(3, order), abs=0.02)


@pytest.mark.parametrize("far", [0.0, 1e3, 1e6])
def test_where_the_model_stands_costs_no_digits_of_the_residual(far: float) -> None:
    """Numbers that moving rounds to whole bits are those of a model a little beside."""
    text = (DECKS / "linkages" / "four_bar_planar.dat").read_text()
    for old in ("X 11  0.  0.", "X 21  0.  1.", "X 31  3.  3.", "X 41  4.  0."):
        name, node, x, y = old.split()
        text = text.replace(old, f"{name} {node} {float(x) + far!r} {float(y) + far!r}")
    analysis = flexact.analyse(flexact.read_text(text))
    for way in both_ways(analysis, Wishes(length=1.0)):
        assert way.stop.ending is Ending.LENGTH and way.residual < 1e-14


def test_steps_may_be_few() -> None:
    analysis = analysed("linkages/four_bar_planar")
    held = Held(analysis.data)
    direction = held.direction(analysis.motions[0].analysed)
    way = follow(held, direction, analysis.rank, Wishes(length=1.0, steps=3))
    assert way.stop.ending is Ending.STEPS and len(way.stations) == 4


def test_a_branch_stops_or_is_passed() -> None:
    """A parallelogram comes to a branch where its cranks lie along its base: a quarter turn."""
    analysis = analysed("linkages/parallelogram_three_cranks")
    size = np.sqrt(5.0)
    for way in both_ways(analysis, Wishes(length=1.0)):
        assert way.stop.ending is Ending.BRANCHES and way.stop.directions == 2
        assert way.length * size == pytest.approx(np.pi / 2, rel=1e-12)
        assert way.branches[-1] is way.stations[-1]
    for way in both_ways(analysis, Wishes(length=1.0, through=True)):
        assert way.stop.ending is Ending.LENGTH and len(way.branches) == 1


def test_singular_values_that_pass_zero_together_are_found() -> None:
    """The ring above a hexagon: two at once, so that no sign tells; ranks by the bars' lines."""
    analysis = analysed("frameworks/ring_6")
    arrays = analysis.data.arrays
    for way in both_ways(analysis, Wishes(length=0.2, through=True)):
        (branch,) = way.branches
        place = Held(analysis.data).outside(branch.within).value[:, :3]
        rows = []
        for p, q in (arrays.element_node[[0, 2]] - 1).T.tolist():
            row = np.zeros(place.shape)
            row[q], row[p] = place[q] - place[p], place[p] - place[q]
            rows.append(row[6:].ravel())
        values = np.linalg.svd(np.array(rows), compute_uv=False)
        assert values[-4] > 0.05 and values[-3] < 1e-9
        assert branch.directions == 3


@pytest.mark.parametrize(
    "name", ["linkages/sarrus", "frameworks/ring_6", "flexures/six_folded_sheets_undeclared"]
)
def test_large_matrices_give_the_paths_of_small_ones(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Sparse with borders, or in full: the same stations, ranks, values and branches."""
    analysis, wishes = analysed(name), Wishes(length=0.4, through=True)
    whole = both_ways(analysis, wishes)
    monkeypatch.setattr(constraints, "_MOST_IN_FULL", 0)
    for one, other in zip(whole, both_ways(analysis, wishes), strict=True):
        assert one.stop.ending is other.stop.ending
        assert len(one.branches) == len(other.branches)
        for a, b in zip(one.stations, other.stations, strict=True):
            assert (a.rank, a.arc) == (b.rank, pytest.approx(b.arc, rel=1e-11, abs=1e-14))
            assert a.within.value == pytest.approx(b.within.value, abs=1e-10)
            assert a.signed == pytest.approx(b.signed, abs=1e-12)
            many = b.smallest.values.size
            assert a.smallest.values[:many] == pytest.approx(b.smallest.values, abs=1e-12)


def test_smallest_singular_values_of_sparse_matrices() -> None:
    """Against LAPACK: zeros are counted, also many, and values that stand twice found twice."""
    sparse = pytest.importorskip("scipy.sparse")
    random = np.random.default_rng(11)
    block = sparse.random_array((60, 60), density=0.06, rng=random) + 2.0 * sparse.eye_array(60)
    for zeros, rows in ((0, 120), (1, 120), (9, 120), (40, 120), (3, 110), (3, 135)):
        matrix = sparse.block_diag([block, block]).tolil()
        matrix[:, :zeros] = 0.0
        matrix = sparse.vstack([matrix[:rows], random.standard_normal((1, 120)) @ matrix])
        matrix = sparse.csc_array(matrix)
        found = smallest_of(matrix, 1e-10)
        known = np.linalg.svd(matrix.toarray(), compute_uv=False)
        assert found.rank(1e-10) == np.count_nonzero(known > 1e-10)
        assert found.values == pytest.approx(known[::-1][: found.values.size], abs=1e-12)
        again = smallest_of(matrix, 1e-10, found)
        assert again.values == pytest.approx(found.values, abs=1e-12)
        left, right = found.null(found.rank(1e-10))
        assert np.abs(matrix @ right).max(initial=0.0) < 1e-12
        assert np.abs(matrix.T @ left).max(initial=0.0) < 1e-12
