# SPDX-License-Identifier: BSD-3-Clause
"""What bodies, joints and insides of sheets do in a motion.

Answers follow from the geometry; dimensions of internal motions from the rank of the part of D(c)
that belongs to inner nodes, by numpy.
"""

from collections.abc import Callable

import numpy as np
import pytest
from known_models import folded_sheet, twelve_trusses
from part_models import EZ, HERE, Placed, cross_hinge, guide
from reference_decks import ROOT

import flexact
from flexact import Analysis, Model, ModelError, analyse
from flexact.analysis.screws import ScrewKind


def stages() -> Model:
    """Two guides in series: sheets carry a carriage, which carries a stage by sheets."""
    points = {
        f"{what} {k}": (x, 0.05 * k, 0.0)
        for what, x in (("ground", 0.0), ("carriage", 0.1), ("stage", 0.2))
        for k in (0, 1)
    }
    made = Placed(HERE, points)
    for k in (0, 1):
        made.sheet(f"ground {k}", f"carriage {k}", EZ, f"outer sheet {k + 1}")
        made.sheet(f"carriage {k}", f"stage {k}", EZ, f"inner sheet {k + 1}")
        made.fix(f"ground {k}")
    made.body(["carriage 0", "carriage 1"], "carriage")
    made.body(["stage 0", "stage 1"], "stage")
    return made.model


def divided_guide(beams: int, *, declared: bool) -> Model:
    """The guide with sheets of several beams: free inside, or declared as one sheet each."""
    model, ends = Model(), []
    for k in (0, 1):
        points = [model.node(0.1 * i / beams, 0.05 * k, 0.0) for i in range(beams + 1)]
        model.fix(points[0])
        for i in range(beams):
            name = f"sheet {k + 1}, {i + 1}"
            free = (2, 5, 6) if i == 0 or not declared else ()
            beam = model.beam(points[i], points[i + 1], (0, 1, 0), free, name=name)
            if not free:
                model.independent(beam, 2, 5, 6)
        ends.append(points[-1])
    model.rigid(*ends, name="stage")
    return model


def test_bodies_that_move_alone_have_a_motion_each() -> None:
    analysis = analyse(stages())
    moved = [[str(part) for part in body.bodies] for m in analysis.motions for body in m.bodies]
    assert sorted(moved) == [["carriage"], ["stage"]]
    for motion in analysis.motions:
        (moving,) = motion.bodies
        other = "stage" if moving.names == ("carriage",) else "carriage"
        assert motion.of(other).kind is ScrewKind.NONE and not motion.of(other)
        assert moving.screw.kind is ScrewKind.TRANSLATION
        assert moving.screw.direction == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)
        assert motion.of(moving.bodies[0]).magnitude == pytest.approx(1.0)


def test_bodies_that_move_as_one_are_one_group() -> None:
    # A plate on a stage: six wires hold it, so that it goes along.
    model = guide()
    stage, corner = model.handle(3, 4), model.node(0.12, 0.01, 0.05)
    plate = [corner, model.node(0.16, 0.01, 0.05), model.node(0.13, 0.06, 0.05)]
    for other in plate[1:]:
        model.rigid(plate[0], other, name="plate")
    random = np.random.default_rng(3)
    for k in range(6):
        foot = model.node(*(np.array([0.14, 0.02, 0.0]) + 0.03 * random.normal(size=3)))
        model.rigid(stage, foot, name="stage")
        model.wire(foot, plate[k % 3], name=f"wire {k + 1}")
    analysis = analyse(model)
    (motion,) = analysis.motions
    (together,) = motion.bodies
    assert together.names == ("plate", "stage")
    assert together.screw.kind is ScrewKind.TRANSLATION and not motion.is_internal


def test_points_bodies_and_handles() -> None:
    model = guide()
    analysis = analyse(model)
    (motion,) = analysis.motions
    node = model.handle(3, 4)
    at = motion.at(node)
    assert at.displacement == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)
    assert at.rotation is not None and not np.abs(at.rotation).max() > 1e-12
    assert motion.at(3).displacement.tolist() == at.displacement.tolist()
    part = analysis.parts.named("stage")
    screws = [motion.of(part), motion.of("stage"), motion.of(0)]
    assert {str(screw) for screw in screws} == {str(screws[0])}
    assert screws[0].at((1.0, 2.0, 3.0)) == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)


def test_what_the_builder_hands_out_is_understood() -> None:
    model = Model()
    clamp = model.node(0.0, 0.0, 0.0, name="clamp")
    fold = model.node(0.1, 0.0, 0.0, name="fold")
    end = model.node(0.1, 0.1, 0.0, name="end")
    first = model.sheet(clamp, fold, EZ, name="first")
    model.sheet(fold, end, EZ, name="second")
    table = model.body([end, (0.2, 0.1, 0.0), (0.1, 0.2, 0.05)], "table")
    model.fix(clamp)
    analysis = analyse(model)
    (motion,) = [motion for motion in analysis.motions if not motion.of(table)]
    # The fold turns about its line, and nothing else moves.
    for screw in (motion.of("fold"), motion.of(fold)):
        assert screw.kind is ScrewKind.ROTATION
        assert screw.direction == pytest.approx([0, 0, 1]) and screw.point[0] == pytest.approx(0.1)
    assert motion.at("fold").displacement == pytest.approx([0, 0, 0], abs=1e-12)
    assert str(analysis.motions[-1].of(table)) == str(analysis.motions[-1].of("table"))
    with pytest.raises(ModelError):
        motion.of(first)


@pytest.mark.parametrize(
    "ask",
    [
        lambda motion: motion.of("sheet 1"),
        lambda motion: motion.of("table"),
        lambda motion: motion.of(1),
        lambda motion: motion.of(-1),
        lambda motion: motion.at("table"),
        lambda motion: motion.at(999),
        lambda motion: motion.at(2),
    ],
)
def test_what_is_not_there_is_said(ask: Callable[[flexact.Motion], object]) -> None:
    (motion,) = analyse(guide()).motions
    with pytest.raises(ModelError):
        ask(motion)
    with pytest.raises(TypeError):
        motion.of(1.5)
    with pytest.raises(TypeError):
        motion.at(None)


def test_a_declared_degree_of_freedom_says_what_moves() -> None:
    model = guide()
    model.independent(model.handle(3, 4), "y")
    (freedom,) = analyse(model).freedoms
    assert freedom.motion is not None
    (moving,) = freedom.motion.bodies
    assert moving.names == ("stage",) and moving.screw.magnitude == pytest.approx(1.0)
    assert freedom.motion.of("stage").direction == pytest.approx([0, 1, 0], abs=1e-12)
    assert freedom.motion.internal_to == () or not freedom.motion.is_internal


def test_a_joint_is_told_apart_from_a_body() -> None:
    # Fig. 4 of the paper, clamped: the fold turns about z and nothing else moves.
    (motion,) = analyse(folded_sheet(clamped=True)).motions
    (moving,) = motion.bodies
    assert moving.is_joint and not moving.bodies and len(moving.joints) == 1
    assert {part.name for part in moving.joints[0].parts} == {"first", "second"}
    assert moving.screw.kind is ScrewKind.ROTATION
    assert moving.screw.point == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)
    assert moving.screw.direction == pytest.approx([0.0, 0.0, 1.0], abs=1e-12)


def test_points_without_an_orientation_have_a_velocity_alone() -> None:
    (motion,) = analyse(twelve_trusses()).motions
    assert all(moving.is_joint for moving in motion.bodies)
    assert {moving.screw.kind for moving in motion.bodies} == {ScrewKind.TRANSLATION}
    assert sum(len(moving.joints) for moving in motion.bodies) == 4
    assert motion.at(5).rotation is None


@pytest.mark.parametrize("planar", [False, True])
def test_points_that_move_as_a_body_would_are_told_so(planar: bool) -> None:
    # A triangle of bars that one point holds; in space further bars stop the other turns.
    model = Model(planar=planar)
    here = [(0.0, 0.0), (1.0, 0.0), (0.3, 0.8)]
    corners = [model.node(*place) for place in here]
    for k in range(3):
        model.truss(corners[k], corners[(k + 1) % 3], name=f"side {k + 1}")
    model.fix(corners[0])
    if not planar:
        for corner in corners[1:]:
            model.fix(corner, "z")
    (motion,) = analyse(model).motions
    if not planar:
        # They could turn about the line between them as well: nothing is claimed.
        assert [len(moving.joints) for moving in motion.bodies] == [1, 1]
        return
    (together,) = motion.bodies
    assert together.is_joint and len(together.joints) == 2
    assert together.screw.kind is ScrewKind.ROTATION
    assert together.screw.point == pytest.approx([0, 0, 0], abs=1e-12)


@pytest.mark.parametrize(
    ("deck", "legs"), [("prism_twist_30", 3), ("octahedral_platform_yaw_90", 3)]
)
def test_a_platform_of_bars_in_a_singular_position_screws_about_its_axis(
    deck: str, legs: int
) -> None:
    # By its threefold symmetry (Hunt, *Kinematic Geometry of Mechanisms*, 1978).
    (motion,) = analyse(ROOT / "input_decks" / "frameworks" / f"{deck}.dat").motions
    (together,) = motion.bodies
    assert len(together.joints) == legs and together.screw.kind is ScrewKind.SCREW
    assert np.abs(together.screw.direction) == pytest.approx([0, 0, 1], abs=1e-12)
    assert together.screw.point[:2] == pytest.approx([0, 0], abs=1e-9)


def inner_dimension(analysis: Analysis) -> int:
    """How many motions of inner nodes of rows of beams D(c) allows, by its columns of them."""
    data = analysis.data
    inner = [
        n for chain in data.chains for n in (*chain.positions[1:-1], *chain.orientations[1:-1])
    ]
    numbers = set(data.arrays.node_number[inner].tolist())
    columns = [k for k, (node, _) in enumerate(analysis.column_labels) if node in numbers]
    matrix = analysis.dense_jacobian()[:, columns]
    return len(columns) - int(np.linalg.matrix_rank(matrix))


@pytest.mark.parametrize("beams", [2, 4])
def test_motions_inside_sheets_are_counted_apart(beams: int) -> None:
    analysis = analyse(divided_guide(beams, declared=False))
    # Each inner node of a sheet can move out of its plane, and turn about two axes.
    assert analysis.internal_motions == 2 * 3 * (beams - 1) == inner_dimension(analysis)
    internal = [motion for motion in analysis.motions if motion.is_internal]
    assert len(internal) == analysis.internal_motions
    assert {part.name for motion in internal for part in motion.internal_to} == {
        "sheet 1",
        "sheet 2",
    }
    assert all(len(motion.internal_to) == 1 for motion in internal)
    assert all(motion.bodies == () for motion in internal)
    # The stage comes first, as if the sheets had not been divided.
    first = analysis.motions[0]
    assert not first.is_internal and first.of("stage").kind is ScrewKind.TRANSLATION
    assert first.of("stage").magnitude == pytest.approx(1.0)


def test_a_sheet_that_is_declared_has_no_motion_inside() -> None:
    analysis = analyse(divided_guide(4, declared=True))
    assert analysis.internal_motions == 0 and len(analysis.motions) == 1
    (moving,) = analysis.motions[0].bodies
    assert moving.names == ("stage",)


@pytest.mark.parametrize(
    "deck", ["cross_hinge_four_beams", "parallel_guide_four_beams", "six_folded_sheets_undeclared"]
)
def test_decks_of_others(deck: str) -> None:
    analysis = analyse(ROOT / "input_decks" / "flexures" / f"{deck}.dat")
    assert analysis.internal_motions == inner_dimension(analysis)


def test_a_wire_that_can_spin_between_joints_moves_inside() -> None:
    # Its torsion is held, but bars alone hold its ends, so that it can turn about itself.
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.beam(a, b, (0, 0, 1), release=(3, 4, 5, 6), name="shaft")
    model.fix(a, "x", "y", "z")
    model.fix(b, "x", "y", "z")
    analysis = analyse(model)
    internal = [motion for motion in analysis.motions if motion.is_internal]
    assert analysis.internal_motions == len(internal) == analysis.under_constrained == 5
    assert {part.name for motion in internal for part in motion.internal_to} == {"shaft"}


def test_motions_are_readable() -> None:
    (motion,) = analyse(cross_hinge()).motions
    (moving,) = motion.bodies
    assert str(moving).startswith("arm turns by") and repr(moving.screw).startswith("<Screw: ")
    assert "node" not in str(moving)
