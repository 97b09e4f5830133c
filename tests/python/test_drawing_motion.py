# SPDX-License-Identifier: BSD-3-Clause
"""Motions as they are drawn: shapes of beams, paths, screws, and degrees of freedom."""

import numpy as np
import pytest
from reference_decks import DRIVEN, MOVING, NAMES, text_of

import flexact
from flexact.core.elements import Class, NodeKind
from flexact.show.drawing import (
    Drawing,
    Form,
    Movement,
    Pose,
    drawing_of,
    field_along,
    move,
    stations,
)
from flexact.show.drawing.movement import moved_by_screws
from flexact.util.rotations import matrix_of, vector_of

pytestmark = pytest.mark.dear(100)


def moved(name: str, index: int = 0) -> tuple[flexact.Analysis, Drawing, Movement]:
    analysis = flexact.analyse(flexact.read_text(text_of(name), name))
    drawing = drawing_of(analysis.given)
    return analysis, drawing, move(drawing, analysis.motions[index])


def cantilever() -> Drawing:
    model = flexact.Model()
    ends = model.node(1.0, 2.0, 3.0), model.node(1.0, 5.0, 3.0)
    model.fix(ends[0])
    model.wire(*ends, y=(0, 0, 1))
    return drawing_of(model.data)


def test_a_bent_beam_is_the_cubic_of_beam_theory() -> None:
    # A force at the tip of a cantilever: v = w s^2 (3 - s) / 2, slope 3 w / (2 l) at the tip.
    drawing, w, length = cantilever(), 1.0e-4, 3.0
    _, _, q, oq = drawing.members.nodes[0]
    position, rotation = drawing.reference.position.copy(), drawing.reference.rotation.copy()
    # Local y is global z: the deflection is along z, the slope a rotation about global x.
    position[q, 2] += w
    rotation[oq] = matrix_of(np.array([1.5 * w / length, 0.0, 0.0]))
    (strip,) = stations(drawing.members, Pose(position, rotation), 12)
    s = strip.at
    np.testing.assert_allclose(
        strip.centre[0, :, 2] - 3.0, w * s**2 * (3 - s) / 2, atol=1e-8 * w, rtol=0
    )
    slope = w * (6 * s - 3 * s**2) / (2 * length)
    np.testing.assert_allclose(strip.frame[0, :, 2, 0], slope, atol=1e-7 * w, rtol=0)
    assert s.size == 13


def test_shapes_turn_with_the_mechanism() -> None:
    # Whatever the deformed pose: turned and moved as a whole, every shape turns with it.
    rng = np.random.default_rng(3)
    for name in ("paper/six_folded_sheets", "linkages/sarrus", "frameworks/ring_4"):
        drawing = drawing_of(flexact.read_text(text_of(name)).data)
        nodes = len(drawing.reference.position)
        deformed = Pose(
            drawing.reference.position + 0.05 * drawing.size * rng.normal(size=(nodes, 3)),
            matrix_of(0.3 * rng.normal(size=(nodes, 3))),
        )
        turn, shift = matrix_of(np.array([0.4, -1.1, 0.7])), np.array([1.0, 2.0, -3.0])
        whole = Pose(deformed.position @ turn.T + shift, turn @ deformed.rotation)
        before, after = (list(stations(drawing.members, pose)) for pose in (deformed, whole))
        for one, other in zip(before, after, strict=True):
            np.testing.assert_allclose(one.centre @ turn.T + shift, other.centre, atol=1e-12)
            # Of a bar, which has no orientation, the axis alone.
            known = 3 if drawing.members.form[one.member[0]] != Form.BAR else 1
            np.testing.assert_allclose(
                (turn @ one.frame)[..., :known], other.frame[..., :known], atol=1e-12
            )


@pytest.mark.grid
@pytest.mark.parametrize("name", MOVING)
def test_stiff_members_keep_their_length_and_all_start_in_the_reference(name: str) -> None:
    analysis = flexact.analyse(flexact.read_text(text_of(name), name))
    drawing = drawing_of(analysis.given)
    members = drawing.members
    for motion in analysis.motions:
        movement = move(drawing, motion)
        for pose in movement.poses:
            for strip in stations(members, pose):
                stiff = members.stiff[strip.member]
                ends = strip.centre[stiff][:, [0, -1]]
                np.testing.assert_allclose(
                    np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1),
                    members.length[strip.member][stiff],
                    rtol=1e-12,
                )
        middle = movement.poses[len(movement.poses) // 2]
        np.testing.assert_array_equal(middle.position, drawing.reference.position)


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES)
def test_the_largest_displacement_is_a_tenth_of_the_size(name: str) -> None:
    analysis = flexact.analyse(flexact.read_text(text_of(name), name))
    drawing = drawing_of(analysis.given)
    reference = list(stations(drawing.members, drawing.reference))
    freedoms = [freedom.motion for freedom in analysis.freedoms if freedom.motion is not None]
    for motion in (*analysis.motions[:4], *freedoms[:2]):
        movement = move(drawing, motion)
        along = field_along(drawing.members, motion.displacement, motion.rotation)
        first_order = max(np.linalg.norm(each, axis=-1).max() for _, each, _ in along)
        assert movement.scale * first_order <= 0.1 * drawing.size * (1 + 1e-12)
        drawn = turned = 0.0
        for pose in (movement.poses[0], movement.poses[-1]):
            for here, there in zip(stations(drawing.members, pose), reference, strict=True):
                way = np.linalg.norm(here.centre - there.centre, axis=-1).max()
                drawn = max(drawn, float(way) / drawing.size)
            turned = max(turned, float(np.linalg.norm(vector_of(pose.rotation), axis=1).max()))
        assert drawn <= 0.1 * 1.003
        # Less where rotations would be too large, or where the path ends before.
        ends = name == "flexures/parallel_guide_four_beams_undeclared"
        far = 0.1 if movement.part == 1.0 else 0.25 * movement.part
        assert far <= 0.1
        assert drawn >= far * 0.985 or turned >= 0.99 or (ends and drawn > 0.8 * far)


def test_the_twelve_trusses_move_on_their_true_path() -> None:
    # 1 + sin a + sin b - cos a cos b = 0: E and G lean out by a, F and H by b
    # (tests/reference/known_answers.json; a = 0.1 gives b = -0.111204276782).
    _, drawing, movement = moved("paper/twelve_trusses")
    assert movement.deviation <= 1.0e-9
    e, f = (drawing.data.node_index[number] for number in (5, 6))
    a = [np.arcsin(-pose.position[e, 1] - 1.0) for pose in movement.poses]
    b = [np.arcsin(pose.position[f, 0] - 1.0) for pose in movement.poses]
    np.testing.assert_allclose(1 + np.sin(a) + np.sin(b) - np.cos(a) * np.cos(b), 0.0, atol=1e-9)
    assert np.interp(0.1, np.sort(a), np.sort(b)[::-1]) == pytest.approx(-0.1112, abs=2e-3)
    reached = np.linalg.norm(movement.poses[-1].position - drawing.reference.position, axis=1)
    assert reached.max() == pytest.approx(0.1 * drawing.size, rel=0.01)


#: Classical answers, as in tests/reference/known_answers.json: Tarnai (1980) for the rings,
#: Dixon for K3,3 on two lines, Bennett, Sarrus; Connelly and Servatius (1994) for the third
#: order. Infinitesimal: collinear bars, the prism, K3,3 on a circle, the platform at 90 deg.
FINITE = {
    "frameworks/ring_4": True,
    "frameworks/ring_6": True,
    "frameworks/k33_two_lines": True,
    "frameworks/third_order_finite": True,
    "linkages/bennett": True,
    "linkages/sarrus": True,
    "linkages/four_bar_in_space": True,
    "frameworks/collinear_bars_space": False,
    "frameworks/k33_circle": False,
    "frameworks/prism_twist_30": False,
    "frameworks/third_order": False,
    "frameworks/octahedral_platform_yaw_90": False,
}


@pytest.mark.parametrize(("name", "finite"), FINITE.items())
def test_finite_and_infinitesimal_motions_are_told_apart(name: str, finite: bool) -> None:
    _, _, movement = moved(name)
    assert (movement.deviation <= 1.0e-9) == finite


@pytest.mark.parametrize("name", [name for name, finite in FINITE.items() if finite])
def test_on_a_true_path_every_held_deformation_stays_zero(name: str) -> None:
    # With the deformation functions of eq. (2) to (4), called apart from the path's own steps.
    analysis, drawing, movement = moved(name)
    kinds = analysis.data.arrays.node_kind
    held = analysis.data.arrays.deformation_class.T
    held = held[held != Class.NONE] == Class.FIXED
    for pose in movement.poses:
        value = analysis.data.arrays.node_value.T.copy()
        placed = kinds <= NodeKind.POSITION
        value[placed, :3] = pose.position[placed]
        reference = flexact.Configuration(kinds, value)
        delta = np.where(kinds[:, None] > NodeKind.POSITION, vector_of(pose.rotation), 0.0)
        there = flexact.deformations(analysis.model, reference.moved(delta))
        assert np.abs(there[held]).max() <= 1e-8 * drawing.size


def test_a_rigid_body_moves_on_its_screw() -> None:
    # A body of two links, turned about z through a point off the body and moved along z.
    model = flexact.Model()
    points = [model.node(1.0, 0.0, 0.0), model.node(2.0, 0.0, 0.0), model.node(1.0, 3.0, 0.0)]
    model.rigid(points[0], points[1])
    model.rigid(points[0], points[2])

    class Turning:
        data = model.data
        displacement = np.zeros((len(model.node_numbers), 3))
        rotation = np.zeros_like(displacement)

    about = np.array([0.0, 0.0, 1.0])
    positions = model.positions
    placed = model.node_kinds <= NodeKind.POSITION
    Turning.displacement[placed] = np.cross(about, positions[placed]) + 0.25 * about
    Turning.rotation[~placed] = about
    (pose,) = moved_by_screws(Turning(), [0.8])
    expected = positions @ matrix_of(0.8 * about).T + [0.0, 0.0, 0.2]
    np.testing.assert_allclose(pose.position[placed], expected[placed], atol=1e-14)


@pytest.mark.parametrize("name", MOVING)
def test_the_field_is_the_derivative_of_the_shapes(name: str) -> None:
    analysis = flexact.analyse(flexact.read_text(text_of(name), name))
    drawing = drawing_of(analysis.given)
    step = 1e-6 * drawing.size
    for motion in analysis.motions[:2]:
        pose = [
            Pose(
                drawing.reference.position + sign * step * motion.displacement,
                matrix_of(sign * step * motion.rotation),
            )
            for sign in (-1, 1)
        ]
        both = (stations(drawing.members, each) for each in pose)
        fields = field_along(drawing.members, motion.displacement, motion.rotation)
        for before, after, (_, way, _) in zip(*both, fields, strict=True):
            slope = (after.centre - before.centre) / (2 * step)
            np.testing.assert_allclose(way, slope, atol=1e-6)


def test_what_lies_between_two_poses_is_between_them() -> None:
    _, drawing, movement = moved("paper/twelve_trusses")
    np.testing.assert_array_equal(movement.pose(0.0).position, drawing.reference.position)
    np.testing.assert_array_equal(movement.pose(1.0).position, movement.poses[-1].position)
    phases = np.linspace(-1.0, 1.0, len(movement.poses))
    middle = movement.pose((phases[3] + phases[4]) / 2)
    expected = (movement.poses[3].position + movement.poses[4].position) / 2
    np.testing.assert_allclose(middle.position, expected, atol=1e-15)


@pytest.mark.parametrize("name", DRIVEN)
def test_degrees_of_freedom_move_alone_and_hold_what_is_held(name: str) -> None:
    analysis = flexact.analyse(flexact.read_text(text_of(name), name))
    classes = analysis.data.arrays
    # Of a divided sheet that is declared the ends alone.
    jacobian = flexact.jacobian(flexact.Model.from_data(analysis.data)).toarray()
    nodes = analysis.condensed.nodes
    coordinate = classes.coordinate_class.T
    deformation = classes.deformation_class.T[classes.deformation_class.T != Class.NONE]
    for freedom in analysis.freedoms:
        if freedom.motion is None:
            # Only where a self-stress does work on it.
            assert analysis.over_constrained
            continue
        velocity = (freedom.motion.displacement + freedom.motion.rotation)[nodes]
        rates = jacobian @ velocity[coordinate != Class.NONE]
        scale = max(1.0, np.abs(velocity).max())
        assert np.abs(rates[deformation == Class.FIXED]).max(initial=0.0) <= 1e-9 * scale
        assert np.all(velocity[coordinate == Class.FIXED] == 0.0)
        declared = [
            *velocity[coordinate == Class.INDEPENDENT],
            *rates[deformation == Class.INDEPENDENT],
        ]
        np.testing.assert_allclose(
            np.sort(declared), [0.0] * (len(declared) - 1) + [1.0], atol=1e-9
        )


def test_the_guided_motion_of_the_paper_is_a_translation() -> None:
    analysis = flexact.analyse(flexact.read_text(text_of("paper/five_wires")))
    (freedom,) = analysis.freedoms
    assert freedom.label == "centre of the body z"
    assert freedom.motion is not None
    body = [analysis.model.node_index(number) for number in (1, 13, 23, 33, 43, 53)]
    np.testing.assert_allclose(freedom.motion.displacement[body], [[0, 0, 1]] * 6, atol=1e-12)


def test_a_freedom_that_a_stress_stops_has_no_motion() -> None:
    # Its bending at the clamped end cannot be free: the trap of tests/reference.
    analysis = flexact.analyse(flexact.read_text(text_of("flexures/folded_sheet_clamped_trap")))
    assert [freedom.motion for freedom in analysis.freedoms] == [None]


def test_pin_jointed_bodies_move_each_on_its_own_screw() -> None:
    # Two cranks on a bar, that share positions and no orientation: the supports stay.
    analysis = flexact.analyse(flexact.read_text(text_of("linkages/parallelogram_flat")))
    model = analysis.model
    fixed = np.flatnonzero(np.all(model.coordinate_classes[:, :2] == Class.FIXED, axis=1))
    assert fixed.size == 2
    for motion in analysis.motions:
        (pose,) = moved_by_screws(motion.analysed, [0.5])
        np.testing.assert_allclose(pose.position[fixed], model.positions[fixed], atol=1e-15)


def test_a_path_is_found_far_from_the_origin() -> None:
    # A parallel guide of 0.1 m a million metres away: its motion is finite as anywhere.
    model = flexact.Model()
    x, y = 1.0e6, -1.0e6
    ground = [model.node(x, y + d, 0.0) for d in (0.0, 0.05)]
    stage = [model.node(x + 0.1, y + d, 0.0) for d in (0.0, 0.05)]
    for k in (0, 1):
        model.fix(ground[k])
        model.sheet(ground[k], stage[k], width=(0, 0, 1))
    model.rigid(stage[0], stage[1])
    analysis = flexact.analyse(model)
    movement = move(drawing_of(analysis.given), analysis.motions[0])
    assert movement.deviation <= 1.0e-9
    placed = model.node_kinds <= NodeKind.POSITION
    way = movement.poses[-1].position - model.positions
    assert 0.005 < np.linalg.norm(way[placed], axis=1).max() < 0.02


def test_a_freedom_of_many_motions_is_the_one_with_the_least_part_in_them() -> None:
    # A row of beams whose twists are left over; the tip is declared.
    model = flexact.Model()
    nodes = [model.node(0.1 * k, 0.0, 0.0) for k in range(6)]
    model.fix(nodes[0])
    for k in range(5):
        model.beam(nodes[k], nodes[k + 1], y=(0, 1, 0), release=(2, 5, 6))
    model.independent(nodes[-1], "y")
    analysis = flexact.analyse(model)
    (freedom,) = analysis.freedoms
    assert analysis.under_constrained > 5
    assert freedom.motion is not None
    moved = freedom.motion.displacement
    assert moved[model.node_index(nodes[-1].position), 1] == pytest.approx(1.0, abs=1e-12)
    both = (moved + freedom.motion.rotation).ravel()
    for motion in analysis.motions:
        part = (motion.displacement + motion.rotation).ravel() @ both
        assert abs(part) <= 1e-9 * np.linalg.norm(both)
