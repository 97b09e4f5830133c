# SPDX-License-Identifier: BSD-3-Clause
"""The analysis against published and classical answers.

Sources: the paper (Aarts, Meijaard, Jonker 2011) by section and table; classical cases
by name. Geometry stands beside each.
"""

import math

import numpy as np
import pytest
from known_models import folded_sheet, ring, twelve_trusses

from flexact import Analysis, Model, Verdict, analyse


def numbers(analysis: Analysis) -> tuple[int, int]:
    return analysis.under_constrained, analysis.over_constrained


def test_twelve_trusses_of_the_paper() -> None:
    analysis = analyse(twelve_trusses())
    golden = (1 + math.sqrt(5)) / 2
    wanted = [math.sqrt(3), golden, golden, math.sqrt(2), *[1.0] * 5, 1 / golden, 1 / golden, 0.0]
    assert np.abs(analysis.singular_values - wanted).max() < 1e-14
    assert (analysis.rows, analysis.columns, analysis.rank) == (12, 12, 11)
    assert analysis.verdict is Verdict.BOTH
    assert analysis.degrees_of_freedom == 0
    assert analysis.counts.coordinates == (24, 12, 12, 0)
    assert analysis.counts.deformations == (12, 12, 0, 0)
    (motion,), (stress,) = analysis.motions, analysis.self_stresses
    table_2 = np.zeros((8, 3))
    table_2[4:] = [[0, -0.5, 0], [-0.5, 0, 0], [0, 0.5, 0], [0.5, 0, 0]]
    # The table has vectors of unit norm; here the largest is one.
    sign = -np.sign(motion.displacement[4, 1])
    assert np.abs(sign * motion.displacement - 2.0 * table_2).max() < 1e-14
    assert not motion.rotation.any()
    assert np.abs(np.abs(stress.vector) - 1.0).max() < 1e-14
    assert np.abs(np.abs(analysis.raw.stresses.vector(0)) - math.sqrt(3) / 6).max() < 1e-14
    assert (stress.vector > 0).sum() == 6
    assert np.array_equal(stress.forces[:, 0], stress.vector)
    assert not stress.moments.any()
    assert analysis.condition_number is None


@pytest.mark.parametrize(("n", "left"), [(3, 0), (4, 1), (5, 0), (6, 1)])
def test_rings_move_where_their_number_is_even(n: int, left: int) -> None:
    assert numbers(analyse(ring(n))) == (left, left)


@pytest.mark.parametrize(("planar", "motions"), [(True, 1), (False, 2)])
def test_two_collinear_bars(planar: bool, motions: int) -> None:
    model = Model(planar=planar)
    a, b, c = (model.node(x, 0) for x in (-1, 0, 1))
    model.truss(a, b)
    model.truss(b, c)
    model.fix(a)
    model.fix(c)
    assert numbers(analyse(model)) == (motions, 1)


@pytest.mark.parametrize(("yaw", "left"), [(0, 0), (80, 0), (89, 0), (90, 1)])
def test_octahedral_platform_is_singular_at_ninety_degrees(yaw: float, left: int) -> None:
    # Hunt and Fichter: base radius 1, platform radius 0.6, height 1.
    model = Model()
    base = [model.node(*polar(1, k), 0) for k in (0, 120, 240)]
    top = [model.node(*polar(0.6, k + yaw), 1) for k in (60, 180, 300)]
    for k in range(3):
        model.fix(base[k])
        model.truss(base[k], top[k])
        model.truss(base[(k + 1) % 3], top[k])
        model.truss(top[k], top[(k + 1) % 3])
    assert numbers(analyse(model)) == (left, left)


def polar(radius: float, degrees: float) -> tuple[float, float]:
    return radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees))


def test_bennett_linkage() -> None:
    # Bennett 1903: a / sin(alpha) = b / sin(beta); one motion, and three self-stresses.
    a, alpha, beta = 1.0, math.radians(50), math.radians(80)
    links = [(a, alpha), (a * math.sin(beta) / math.sin(alpha), beta)] * 2
    points, axes = bennett_loop(links)
    model = Model()
    here = [model.node(*point) for point in points]
    beyond = [model.hinge(node, axis) for node, axis in zip(here, axes, strict=True)]
    model.fix(here[0])
    for k in range(4):
        model.beam(beyond[k], here[(k + 1) % 4])
    assert numbers(analyse(model)) == (1, 3)


def bennett_loop(links: list[tuple[float, float]]) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Joints and axes of a Bennett loop at the joint angle 70 degrees, closed by its law."""
    alpha, beta = links[0][1], links[1][1]
    first = math.radians(70)
    ratio = math.sin((beta + alpha) / 2) / math.sin((beta - alpha) / 2)
    second = 2 * math.atan(ratio / math.tan(first / 2))
    turns = [first, second, -first, -second]
    frame, points, axes = np.eye(4), [], []
    for (length, twist), turn in zip(links, turns, strict=True):
        points.append(frame[:3, 3].copy())
        axes.append(frame[:3, 2].copy())
        frame = frame @ about_z(turn) @ along_x(length, twist)
    assert np.abs(frame[:3, 3]).max() < 1e-12, "the loop closes"
    return points, axes


def about_z(turn: float) -> np.ndarray:
    made = np.eye(4)
    made[:2, :2] = [[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]]
    return made


def along_x(length: float, twist: float) -> np.ndarray:
    made = np.eye(4)
    made[1:3, 1:3] = [[math.cos(twist), -math.sin(twist)], [math.sin(twist), math.cos(twist)]]
    made[0, 3] = length
    return made


@pytest.mark.parametrize("beams", [1, 2, 5])
@pytest.mark.parametrize("clamped", [False, True])
def test_folded_sheet(clamped: bool, beams: int) -> None:
    # Section 4.2 of the paper; each further beam of a sheet adds three internal motions.
    motions = (1 if clamped else 6) + 6 * (beams - 1)
    assert numbers(analyse(folded_sheet(clamped, beams))) == (motions, int(clamped))


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_self_stress_of_the_clamped_fold_is_two_moments(size: float) -> None:
    # Fig. 4(c): in-plane moments at the clamped ends, equal and opposite.
    analysis = analyse(folded_sheet(clamped=True, size=size))
    (stress,), (motion,) = analysis.self_stresses, analysis.motions
    assert not stress.forces.any()
    first, second = stress.moments[0, 2], stress.moments[1, 3]
    assert first == pytest.approx(-second, rel=1e-12)
    assert abs(first) == pytest.approx(1.0, rel=1e-12)
    rest = stress.moments.copy()
    rest[0, 2] = rest[1, 3] = 0
    assert np.abs(rest).max() < 1e-14
    assert {(e, d) for e, d, _ in stress.largest()} == {(1, 3), (2, 4)}
    (node, coordinate, value) = motion.largest()[0]
    assert (node, coordinate, abs(value)) == (4, "rz", pytest.approx(1.0))


def test_parts_are_ranked_by_moments_not_by_raw_entries() -> None:
    # As Fig. 4, the second sheet ten times as long. The fold passes on a shear force alone,
    # M1 / l1 = M2 / l2: raw entries sigma = M / l0 are equal, moments are as the lengths.
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(1, 10, 0)
    model.sheet(a, b, (0, 0, 1))
    model.sheet(b, c, (0, 0, 1))
    model.fix(a)
    model.fix(c)
    (stress,) = analyse(model).self_stresses
    *_, one, other = np.sort(np.abs(stress.vector))
    assert one == pytest.approx(other)
    first, second = stress.largest()
    assert (first[:2], second[:2]) == ((2, 4), (1, 3))
    assert first[2] == pytest.approx(-10 * second[2])


def test_forces_and_moments_of_a_clamped_beam() -> None:
    # Each alone in one self-stress, of 1 N or 1 N m, however long the beam is.
    model = Model()
    a, b = model.node(0, 0, 0), model.node(100, 0, 0)
    model.beam(a, b)
    model.fix(a)
    model.fix(b)
    stresses = analyse(model).self_stresses
    assert len(stresses) == 6
    total_forces = sum(np.square(stress.forces) for stress in stresses)
    total_moments = sum(np.square(stress.moments) for stress in stresses)
    assert total_forces[0] == pytest.approx([1, 0, 0, 0, 0, 0], abs=1e-12)
    assert total_moments[0] == pytest.approx([0, 1, 1, 1, 1, 1], rel=1e-12)


def test_hinge_moments_are_moments_as_they_are() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(3, 0, 0)
    far = model.hinge(a, (0, 0, 1))
    model.rigid(far, b)
    model.fix(a)
    model.fix(far)
    stress = analyse(model).self_stresses
    assert sum((s.moments[0, 1:3] ** 2).sum() for s in stress) == pytest.approx(2.0)


def test_independent_coordinate_takes_the_motion_away() -> None:
    model = folded_sheet(clamped=True)
    model.independent(1, 6)
    analysis = analyse(model)
    # The row added is regular; the self-stress of the clamped ends stays.
    assert numbers(analysis) == (0, 1)
    assert analysis.degrees_of_freedom == 1
