# SPDX-License-Identifier: BSD-3-Clause
"""Screw systems whose lines are known in closed form.

Sources: R. S. Ball, *A Treatise on the Theory of Screws*, 1900 (the cylindroid); K. H. Hunt,
*Kinematic Geometry of Mechanisms*, 1978, chapters 11 and 12 (pitch quadric, linear congruences).
"""

from __future__ import annotations

import numpy as np
import pytest

from flexact.advice.spaces.screws import FamilyKind, ScrewSpace, canonical

K = FamilyKind
X, Y, Z = np.eye(3)


def screw(axis: np.ndarray, pitch: float, point: object = (0, 0, 0)) -> np.ndarray:
    """About or along a line, its moment about the origin."""
    return np.concatenate((axis, np.cross(np.array(point, float), axis) + pitch * axis))


def space(*screws: np.ndarray, about: object = (0.3, -0.2, 0.1), length: float = 0.7) -> ScrewSpace:
    """The space that some screws span, about another point, with another length."""
    middle = np.array(about, float)
    rows = np.array([np.concatenate((s[:3], s[3:] + np.cross(s[:3], middle))) for s in screws])
    factors = np.repeat((length, 1.0), 3)
    return ScrewSpace(np.linalg.qr((rows * factors).T)[0].T / factors, middle, length)


@pytest.mark.parametrize(("a", "b"), [(1.0, -1.0), (0.3, -1.2)])
def test_a_cylindroid_with_pitches_of_both_signs_holds_two_lines(a: float, b: float) -> None:
    """At t from x, the pitch is a cos^2 t + b sin^2 t, at the height (b - a) cos t sin t."""
    lines = space(screw(X, a), screw(Y, b)).families
    angle = np.arctan(np.sqrt(-a / b))
    assert [each.kind for each in lines] == [K.LINE, K.LINE]
    for sign in (1.0, -1.0):
        way = np.array((np.cos(angle), sign * np.sin(angle), 0.0))
        place = np.array((0.0, 0.0, sign * (b - a) * np.cos(angle) * np.sin(angle)))
        near = [
            np.linalg.norm(np.cross(each.direction, way))
            + np.linalg.norm(np.cross(each.point - place, way))
            for each in lines
        ]
        assert min(near) < 1e-9


def test_a_cylindroid_with_pitches_of_one_sign_is_told_by_its_principal_screws() -> None:
    found = space(screw(X, 0.5), screw(Y, 0.2)).families
    assert [each.kind for each in found] == [K.SCREW, K.SCREW]
    by_pitch = sorted(found, key=lambda each: each.pitch)
    for each, (axis, pitch) in zip(by_pitch, ((Y, 0.2), (X, 0.5)), strict=True):
        assert each.pitch == pytest.approx(pitch)
        assert np.allclose(each.direction, axis, atol=1e-9)
        assert np.allclose(np.cross(each.point, axis), 0.0, atol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_screws_of_one_pitch_do_not_depend_on_the_basis(seed: int) -> None:
    """All screws of the pencil, or of the bundle, have that pitch: those along x, y, z are told."""
    random = np.random.default_rng(seed)
    for axes in ((X, Y), (X, Y, Z)):
        rows = np.array([screw(axis, 0.5, (0.1, 0.2, 0)) for axis in axes])
        found = space(*random.normal(size=(len(axes), len(axes))) @ rows).families
        assert [each.kind for each in found] == [K.SCREW] * len(axes)
        for each in found:
            assert each.pitch == pytest.approx(0.5)
            assert np.abs(each.direction).max() == pytest.approx(1.0)


def test_one_line_of_a_cylindroid_and_the_screw_across_it() -> None:
    found = space(screw(X, 0.0), screw(Y, 0.2)).families
    assert [each.kind for each in found] == [K.LINE, K.SCREW]
    assert np.allclose(np.abs(found[0].direction), X)
    assert found[1].pitch == pytest.approx(0.2)


def test_a_rotation_and_a_translation_along_it_hold_one_line() -> None:
    found = space(screw(Z, 0.0), ScrewSpace.free(Z)).families
    assert [each.kind for each in found] == [K.LINE, K.DIRECTION]


def test_a_screw_and_a_translation_across_it_hold_parallel_screws() -> None:
    found = space(screw(Z, 0.4), ScrewSpace.free(X)).families
    assert [each.kind for each in found] == [K.DIRECTION, K.SCREW]
    assert found[1].pitch == pytest.approx(0.4)


def test_lines_of_three_principal_screws_lie_on_the_pitch_quadric() -> None:
    """On h1 x^2 + h2 y^2 + h3 z^2 + h1 h2 h3 = 0."""
    pitches = np.array((0.5, 0.3, -0.4))
    (regulus,) = space(*(screw(a, h) for a, h in zip((X, Y, Z), pitches, strict=True))).families
    assert regulus.kind is K.REGULUS
    assert np.allclose(regulus.point, 0.0, atol=1e-9)
    assert np.allclose(np.abs(regulus.direction), Z, atol=1e-9)
    assert len(regulus.points) == 12
    for point, way in zip(regulus.points, regulus.directions, strict=True):
        for t in (-1.0, 0.0, 2.0):
            place = point + t * way
            assert abs(pitches @ place**2 + np.prod(pitches)) < 1e-9


def test_three_screws_of_one_sign_hold_no_line() -> None:
    found = space(screw(X, 0.5), screw(Y, 0.3), screw(Z, 0.4)).families
    assert [each.kind for each in found] == [K.SCREW] * 3


def test_a_regulus_with_a_translation_is_on_a_paraboloid() -> None:
    """Lines along x cos t + y sin t at the height k tan t, and the translation that closes it."""
    rows = [
        screw(np.array((1.0, t, 0.0)) / np.hypot(1.0, t), 0.0, (0, 0, 0.4 * t)) for t in (0, 1, -2)
    ]
    found = space(*rows).families
    assert [each.kind for each in found] == [K.REGULUS, K.DIRECTION]
    assert np.allclose(np.abs(found[0].normal), Z, atol=1e-9)
    assert not found[0].direction.any()


def test_two_pencils_that_share_a_line() -> None:
    """Through two points of the line, in two planes through it (Hunt, section 12.7)."""
    both = space(screw(X, 0.0), screw(Y, 0.0), screw(Z, 0.0, (0.2, 0, 0)))
    assert [each.kind for each in both.families] == [K.PENCIL, K.PENCIL]
    points = sorted(each.point[0] for each in both.families)
    assert np.allclose(points, (0.0, 0.2), atol=1e-9)


def test_wrenches_of_one_sign_leave_an_elliptic_congruence() -> None:
    freedom = space(screw(X, 0.5), screw(Y, 0.2)).reciprocal
    assert freedom.dimension == 4
    kinds = [each.kind for each in freedom.families]
    assert kinds == [K.CONGRUENCE, K.DIRECTION]
    lines = freedom.families[0]
    assert len(lines.points) == 12
    for point, way in zip(lines.points, lines.directions, strict=True):
        assert freedom.has(freedom.line(point, way), 1e-9)


def test_a_force_and_a_couple_along_it_leave_lines_that_meet_it_at_right_angles() -> None:
    freedom = space(screw(Z, 0.0), ScrewSpace.free(Z)).reciprocal
    (lines,) = freedom.lines
    assert lines.kind is K.MEETING_ACROSS
    assert np.allclose(np.abs(lines.direction), Z)
    assert freedom.has(freedom.line((0, 0, 0.4), (1, 2, 0)), 1e-9)
    assert not freedom.has(freedom.line((0, 0, 0.4), (1, 2, 1)))


def test_nothing_and_everything() -> None:
    everything = space(*np.eye(6))
    assert [each.kind for each in everything.families] == [K.EVERY, K.EVERY_DIRECTION]
    nothing = everything.reciprocal
    assert nothing.dimension == 0
    assert nothing.families == ()
    assert nothing.reciprocal.dimension == 6


def test_a_small_offset_is_none_and_a_larger_one_is_told() -> None:
    """What is off by less than 1e-4 of the length is not told apart."""
    one = space(screw(X, 0.0), screw(Y, 0.0, (0, 0, 1e-6)))
    other = space(screw(X, 0.0), screw(Y, 0.0, (0, 0, 1e-3)))
    assert [each.kind for each in one.families] == [K.PENCIL]
    assert [each.kind for each in other.families] == [K.LINE, K.LINE]


@pytest.mark.parametrize("count", range(1, 6))
def test_rows_follow_from_the_space_alone(count: int) -> None:
    random = np.random.default_rng(count)
    rows = np.linalg.qr(random.normal(size=(6, count)))[0].T
    turned = np.linalg.qr(random.normal(size=(count, count)))[0] @ rows
    one, other = canonical(rows), canonical(turned)
    assert np.allclose(one, other, atol=1e-9)
    assert np.allclose(one @ one.T, np.eye(count), atol=1e-9)
    assert np.allclose(one.T @ one, rows.T @ rows, atol=1e-9)
