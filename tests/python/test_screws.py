# SPDX-License-Identifier: BSD-3-Clause
"""The screw of a rigid body: axis, point and pitch against closed forms.

Sources: Chasles's theorem for single twists; the poles of hinges, of crossing sheets and of
linkages from their geometry; the linear complex of the tangents of a helix, whose reciprocal
screw has the pitch -R^2/c (Ball, *A Treatise on the Theory of Screws*, 1900, section 9).
"""

import math

import numpy as np
import pytest
from known_models import guide as unnamed_guide
from part_models import (
    CROSSING,
    EY,
    EZ,
    PLACES,
    RADIUS,
    RISE,
    Place,
    cross_hinge,
    guide,
    turn_about,
    wires_on_a_helix,
)

from flexact import Model, analyse
from flexact.analysis.screws import Screw, ScrewKind, screw_of

TOLERANCE = 1e-9


def distance_of_lines(screw: Screw, point: np.ndarray, direction: np.ndarray) -> float:
    """How far a point of a line is from the axis of a screw with the same direction."""
    return float(np.linalg.norm(np.cross(screw.point - point, direction)))


def is_along(screw: Screw, direction: np.ndarray) -> bool:
    return bool(np.linalg.norm(np.cross(screw.direction, direction)) < TOLERANCE)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e3])
def test_a_twist_made_of_its_axis_gives_it_back(seed: int, scale: float) -> None:
    random = np.random.default_rng(seed)
    axis, point, centre = random.normal(size=(3, 3))
    axis /= np.linalg.norm(axis)
    turn, pitch = random.normal(), scale * random.normal()
    point, centre = scale * point, scale * centre
    velocity = turn * (np.cross(axis, centre - point) + pitch * axis)
    screw = screw_of(turn * axis, velocity, centre, scale)
    assert screw.kind is ScrewKind.SCREW and is_along(screw, axis)
    assert screw.pitch == pytest.approx(pitch, rel=1e-12)
    assert distance_of_lines(screw, point, axis) < 1e-12 * scale
    # Its point is the one nearest to the centre, its velocities are those of the body.
    assert abs((screw.point - centre) @ axis) < 1e-12 * scale
    there = scale * random.normal(size=3)
    wanted = velocity + np.cross(turn * axis, there - centre)
    assert screw.at(there) == pytest.approx(wanted, abs=1e-12 * scale)
    assert screw.magnitude * screw.direction == pytest.approx(turn * axis, abs=1e-15)


def test_kinds_by_how_large_the_parts_are() -> None:
    x, z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    none = np.zeros(3)
    kinds = [
        (none, none, ScrewKind.NONE),
        (none, x, ScrewKind.TRANSLATION),
        (1e-10 * z, x, ScrewKind.TRANSLATION),
        (1e-7 * z, x, ScrewKind.ROTATION),
        (z, none, ScrewKind.ROTATION),
        (z, 1e-10 * z, ScrewKind.ROTATION),
        (z, 1e-7 * z, ScrewKind.SCREW),
        (z, 1e3 * x + 1e-8 * z, ScrewKind.ROTATION),
    ]
    for rotation, velocity, kind in kinds:
        screw = screw_of(rotation, velocity, none, 1.0)
        assert screw.kind is kind and bool(screw) is (kind is not ScrewKind.NONE)
    assert not screw_of(1e-12 * z, none, none, 1.0, rest=1e-9)
    assert screw_of(z, 1e-4 * z, none, 1.0, rounding=1e-3).kind is ScrewKind.ROTATION
    assert math.isinf(screw_of(none, x, none, 1.0).pitch)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_sense_of_the_axis_is_canonical_and_the_magnitude_has_the_sign(sign: float) -> None:
    rotation = sign * np.array([-1e-9, -0.6, 0.8])
    screw = screw_of(rotation, np.zeros(3), np.zeros(3), 1.0)
    assert screw.direction[1] > 0.0
    assert screw.magnitude == pytest.approx(-sign)


@pytest.mark.parametrize("name", PLACES)
def test_axis_of_a_cross_hinge_is_where_the_sheets_cross(name: str) -> None:
    place = PLACES[name]
    (motion,) = analyse(cross_hinge(place)).motions
    screw, size = motion.of("arm"), 0.1 * place.scale
    assert screw.kind is ScrewKind.ROTATION
    assert screw.pitch == 0.0
    assert is_along(screw, place.direction(EZ))
    off = distance_of_lines(screw, place.point(CROSSING), place.direction(EZ))
    assert off < TOLERANCE * size


@pytest.mark.parametrize("name", PLACES)
def test_a_stage_between_parallel_sheets_moves_straight(name: str) -> None:
    place = PLACES[name]
    (motion,) = analyse(guide(place)).motions
    screw = motion.of("stage")
    assert screw.kind is ScrewKind.TRANSLATION and math.isinf(screw.pitch)
    assert is_along(screw, place.direction(EY))
    assert abs(screw.magnitude) == pytest.approx(1.0)


@pytest.mark.parametrize("name", PLACES)
def test_wires_along_tangents_of_a_helix_leave_a_screw(name: str) -> None:
    place = PLACES[name]
    (motion,) = analyse(wires_on_a_helix(place)).motions
    screw = motion.of("body")
    assert screw.kind is ScrewKind.SCREW
    assert is_along(screw, place.direction(EZ))
    assert screw.pitch == pytest.approx(-(RADIUS**2) / RISE * place.scale, rel=TOLERANCE)
    off = distance_of_lines(screw, place.point((0, 0, 0)), place.direction(EZ))
    assert off < TOLERANCE * 0.1 * place.scale


def test_an_axis_a_kilometre_away_from_the_origin() -> None:
    # Numbers of a kilometre hold 1e-13 m: of a hinge of 0.1 m that is 1e-12.
    place = Place(turn=turn_about((1, 2, 3), 0.4), offset=(1000.0, -700.0, 300.0))
    (motion,) = analyse(cross_hinge(place)).motions
    screw = motion.of("arm")
    assert screw.kind is ScrewKind.ROTATION and is_along(screw, place.direction(EZ))
    assert distance_of_lines(screw, place.point(CROSSING), place.direction(EZ)) < 1e-10


@pytest.mark.parametrize("axis", [(0, 0, 1), (1, 2, -2), (-1, 0.1, 0)])
def test_axis_of_a_hinge(axis: tuple[float, float, float]) -> None:
    model = Model()
    ground = model.node(0.3, -0.2, 0.1)
    beyond = model.hinge(ground, axis, name="hinge")
    model.rigid(beyond, model.node(0.5, 0.4, 0.2), name="lever")
    model.fix(ground)
    (motion,) = analyse(model).motions
    screw, unit = motion.of("lever"), np.array(axis) / np.linalg.norm(axis)
    assert screw.kind is ScrewKind.ROTATION and is_along(screw, unit)
    assert distance_of_lines(screw, np.array([0.3, -0.2, 0.1]), unit) < 1e-12


def test_pole_of_a_coupler_in_the_plane_is_where_its_cranks_meet() -> None:
    # Cranks from (0, 0) to (0, 1) and from (4, 0) to (3, 3): their lines meet at (0, 12).
    model = Model(planar=True)
    points = [model.node(*at) for at in ((0, 0), (0, 1), (3, 3), (4, 0))]
    a, b, c, d = points
    model.rigid(a, b, name="crank")
    model.truss(d, c, name="rocker")
    model.rigid(model.pivot(b), c, name="coupler")
    model.fix(a, "x", "y")
    model.fix(d, "x", "y")
    (motion,) = analyse(model).motions
    screw = motion.of("coupler")
    assert screw.kind is ScrewKind.ROTATION
    assert screw.direction.tolist() == [0.0, 0.0, 1.0]
    assert screw.point == pytest.approx([0.0, 12.0, 0.0], abs=1e-9)
    crank = motion.of("crank")
    assert crank.point == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    # The velocity of their joint from either: 11 and 1 from the poles, in opposite senses.
    assert screw.magnitude / crank.magnitude == pytest.approx(-1 / 11)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_screws_without_names_are_asked_for_by_index(size: float) -> None:
    (motion,) = analyse(unnamed_guide(size=size)).motions
    assert motion.of(0).kind is ScrewKind.TRANSLATION
