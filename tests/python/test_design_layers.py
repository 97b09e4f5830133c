# SPDX-License-Identifier: BSD-3-Clause
"""Layouts in layers and with limbs, by an analysis of their own beside that of the package.

The rows of each flexure are made here from its places; stage and bodies have six unknowns each, and
what remains is compared with the wanted freedom. Distances are those of `design_oracle.py`.
"""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from design_answers_by_hand import design_oracle, problems

from flexact.designs.candidates import Place, Sizes, boxes_of
from flexact.designs.design import asked_group, sizes_of
from flexact.designs.frame import scaled
from flexact.designs.layers import layered
from flexact.designs.layouts import flexures_of, model_of, verified
from flexact.designs.limbs import hinges, limbs, pairs, wrenches_of
from flexact.designs.possible import possible
from flexact.designs.problem import Box
from flexact.designs.reading import problem_of
from flexact.designs.rooms import asides, corners_between, proposed, stacks

SHARED = problems()


def given(name, wanted=None, boxes=True, ground=None, **limits):
    """A shared problem, changed: other motions, no boxes for bodies, other ground, limits."""
    asked = {k: v for k, v in SHARED[name].items() if k not in ("expect", "source", "id")}
    asked |= {"wanted": wanted} if wanted else {}
    asked |= {"ground": {"boxes": ground}} if ground else {}
    asked["limits"] = asked["limits"] | limits
    if not boxes:
        asked.pop("intermediate", None)
    return problem_of(asked)


def found(source, problem, count):
    """The first arrangements, with their flexures and bodies."""
    frame = scaled(problem)
    made = itertools.islice(source(problem, frame, sizes_of(problem), problem.limits.kinds), count)
    return [(each, *flexures_of(problem, frame, each)) for each in made]


def force(at, along):
    along = along / np.linalg.norm(along)
    return np.concatenate((along, np.cross(at, along)))


def rows_of(flexure, centre, size):
    """(n, 6) what a flexure holds: wrenches (f, m / L) about the centre."""
    p, q = (flexure.ends - centre) / size
    if flexure.kind == "wire":
        return np.array([force(p, q - p)])
    if flexure.kind == "folded sheet":
        return np.array([force((flexure.via[0] - centre) / size, flexure.axes[0])])
    across = np.cross(flexure.normal, q - p)
    if flexure.kind == "waisted sheet":
        waist = (flexure.via[0] - centre) / size
        return np.array([force(waist, q - p), force(waist, across)])
    assert flexure.kind == "sheet"
    return np.array([force(p, q - p), force(p, across), force(q, across)])


def constraints(problem, flexures, bodies):
    """All rows of a layout: columns of twists (w L, v) of the stage, and of each body between."""
    names = ["stage", *(name for name, _ in bodies)]
    made = []
    for flexure in flexures:
        for row in rows_of(flexure, problem.centre, problem.size):
            line = np.zeros((len(names), 6))
            for sign, body in zip((1.0, -1.0), flexure.between, strict=True):
                if body != "ground":
                    line[names.index(body)] += sign * np.roll(row, 3)
            made.append(line.ravel())
    return np.array(made)


def assert_exact(problem, flexures, bodies):
    """No self-stress, the wanted freedom to 1e-9, and bodies that rest while the stage does."""
    rows = constraints(problem, flexures, bodies)
    values = np.linalg.svd(rows, compute_uv=False)
    assert len(values) == len(rows)
    assert values[-1] > 1e-6 * values[0]
    free = np.linalg.svd(rows)[2][len(rows) :]
    wanted = problem.freedom.scaled
    assert len(free) == len(wanted)
    stage = np.linalg.qr(free[:, :6].T)[0].T
    assert np.linalg.norm(stage - stage @ wanted.T @ wanted, 2) < 1e-9
    between = np.linalg.svd(rows[:, 6:], compute_uv=False)
    assert between[6 * len(bodies) - 1] > 1e-6 * values[0]


def as_json(flexure):
    made = {"kind": flexure.kind, "ends": flexure.ends, "normal": flexure.normal}
    made |= {key: getattr(flexure, key) for key in ("width", "thickness", "diameter")}
    if flexure.kind == "folded sheet":
        made["fold"] = {"point": flexure.via[0], "direction": flexure.axes[0]}
    return made


def boxed(boxes):
    return [np.array((box.low, box.high)) for box in boxes]


def assert_in_place(problem, flexures, bodies):
    """Ends in their regions, each body in one box, lengths and breadths within the limits."""
    regions = {"stage": boxed(problem.stage.boxes), "ground": boxed(problem.ground.boxes)}
    slack, limits = 1e-9 * problem.size, problem.limits
    for flexure in flexures:
        length = np.linalg.norm(flexure.ends[1] - flexure.ends[0])
        assert limits.length[0] - slack <= length <= limits.length[1] + slack
        half = np.zeros(3)
        if flexure.kind != "wire":
            assert limits.width[0] - slack <= flexure.width <= limits.width[1] + slack
            half = np.cross(flexure.normal, flexure.ends[1] - flexure.ends[0])
            half *= flexure.width / 2 / np.linalg.norm(half)
        for end, body in zip(flexure.ends, flexure.between, strict=True):
            if body in regions:
                assert design_oracle.covered(end - half, end + half, regions[body], slack)
    ends = {name: [] for name, _ in bodies}
    for flexure in flexures:
        for end, body in zip(flexure.ends, flexure.between, strict=True):
            ends.get(body, []).append(end)
    for name, points in ends.items():
        assert len(points) >= 2, name
        if problem.intermediate:
            assert any(
                ((points >= low - slack) & (points <= high + slack)).all()
                for low, high in boxed(problem.intermediate)
            ), name


def assert_apart(problem, flexures):
    """Flexures are clear of each other, and of stage and ground where they do not end there."""
    shapes = [design_oracle.solids(as_json(flexure)) for flexure in flexures]
    least = problem.limits.clearance - 1e-9 * problem.size
    for one, other in itertools.combinations(shapes, 2):
        assert min(design_oracle.distance(a, b) for a in one for b in other) >= least
    solid = {"stage": problem.stage.boxes, "ground": problem.ground.boxes}
    for flexure, shape in zip(flexures, shapes, strict=True):
        for body in set(solid) - set(flexure.between):
            for box in boxed(solid[body]):
                gap = min(design_oracle.distance(a, design_oracle.box_solid(box)) for a in shape)
                assert gap >= least, (flexure.name, body)


def assert_right(problem, flexures, bodies):
    """By the computation of this file, and by the analysis of the package."""
    assert_exact(problem, flexures, bodies)
    assert_in_place(problem, flexures, bodies)
    assert_apart(problem, flexures)
    result = verified(problem, model_of(problem, flexures, bodies))
    assert (result.over_constrained, result.under_constrained, result.internal) == (0, 0, 0)
    assert result.freedom_error < 1e-9
    assert result.analysis.proof is not None


def motion(kind, direction, point=(0, 0, 0), pitch=None):
    made = {"kind": kind, "direction": direction}
    made |= {} if kind == "translation" else {"point": point}
    return made if pitch is None else made | {"pitch": pitch}


MEETING = [motion("rotation", [1, 0, 0]), motion("rotation", [0, 1, 0])]
OBLIQUE = [motion("translation", [1, 0.2, 0]), motion("translation", [0, 1, 0.5])]
BELOW = [[[-0.12, -0.12, -0.10], [0.12, 0.12, -0.06]]]
LAYERS = {
    "xy": lambda: given("xy"),
    "xyz": lambda: given("xyz"),
    "screws of one sense": lambda: given("screws_of_one_sense"),
    "x, y, z, turn": lambda: given("schoenflies"),
    "xy without boxes": lambda: given("xy", boxes=False),
    "xyz without boxes": lambda: given("xyz", boxes=False),
    "xyz above the ground": lambda: given("xyz", boxes=False, ground=BELOW),
    "oblique translations": lambda: given("xy", OBLIQUE, boxes=False),
    "rotations that meet": lambda: given("universal_joint"),
    "rotations and a translation": lambda: given(
        "universal_joint", [*MEETING, motion("translation", [0, 1, 0])]
    ),
    "of folded sheets": lambda: given(
        "xy", boxes=False, kinds=["folded sheet"], length=[0.02, 0.08], width=[0.005, 0.02]
    ),
    "of waisted sheets": lambda: given("xy", boxes=False, kinds=["sheet", "waisted sheet"]),
}
#: Folds are inner motions, one each, that the analysis of the package counts.
FOLDED = ("of folded sheets",)


@pytest.mark.dear(4)
@pytest.mark.parametrize("name", LAYERS)
def test_layers_hold_what_is_to_be_held(name):
    problem = LAYERS[name]()
    made = found(layered, problem, 3)
    assert made
    for arrangement, flexures, bodies in made:
        assert len(bodies) == len(arrangement.parts) - 1 <= problem.limits.bodies
        if name in FOLDED:
            assert_exact(problem, flexures, bodies)
            result = verified(problem, model_of(problem, flexures, bodies))
            assert result.internal == len(flexures)
            assert (result.over_constrained, result.under_constrained) == (0, 0)
        else:
            assert_right(problem, flexures, bodies)


def test_layers_are_as_typed_where_they_work():
    """Of x and y each layer of the first layouts has one, and of x, y, z each of three."""
    for name in ("xy", "xyz"):
        problem = given(name)
        frame = scaled(problem)
        (arrangement, *_), *_ = found(layered, problem, 1)
        for part in arrangement.parts:
            rows = np.concatenate(
                [candidates.rows[k] for candidates, k in part.found.chosen.members]
            )
            free = np.linalg.svd(rows)[2][-1]
            moved = frame.turned_back(free[:3])
            assert sorted(np.abs(moved).round(9)) == [0, 0, 1]


def test_two_whole_sheets_in_each_layer_are_over_constrained_by_one_each():
    problem = given("xy", boxes=False, kinds=["sheet"], over_constraint=2)
    (_, flexures, bodies), *_ = found(layered, problem, 1)
    result = verified(problem, model_of(problem, flexures, bodies))
    assert (result.over_constrained, result.under_constrained) == (2, 0)
    assert result.freedom_error < 1e-9
    assert [flexure.kind for flexure in flexures] == ["sheet"] * 4


def test_no_more_bodies_than_are_allowed():
    assert not found(layered, given("xyz", bodies=1), 1)
    assert not found(limbs, given("xyz", bodies=2), 1)
    assert not found(layered, given("xy", bodies=0), 1)


LIMBS = {
    "a couple and forces": lambda: given("xy"),
    "two couples": lambda: given("schoenflies"),
    "three couples": lambda: given("xyz", bodies=3),
    "two wrenches with pitch": lambda: given("screws_of_one_sense"),
    "a couple and forces in free space": lambda: given("xy", boxes=False),
    "two couples in free space": lambda: given("schoenflies", boxes=False),
    "three couples in free space": lambda: given("xyz", boxes=False, bodies=3),
    "wrenches with pitch in free space": lambda: given("screws_of_one_sense", boxes=False),
}


@pytest.mark.dear(3)
@pytest.mark.parametrize("name", LIMBS)
def test_limbs_hold_couples_and_wrenches_with_pitch(name):
    problem = LIMBS[name]()
    made = found(limbs, problem, 2)
    assert made
    for _, flexures, bodies in made:
        assert_right(problem, flexures, bodies)


@pytest.mark.parametrize(("name", "count", "order"), [("xyz", 3, 3), ("schoenflies", 2, 4)])
def test_limbs_are_images_of_each_other_where_they_can_be(name, count, order):
    """A Delta has three limbs, each a third of a turn from the next; x, y, z, turn has two."""
    problem = given(name, boxes=False, bodies=3)
    (_, flexures, bodies), *_ = found(limbs, problem, 1)
    assert len(bodies) == count
    axis = next(
        axis
        for axis in np.eye(3)
        if all(_has_image(flexures, bodies, k, axis, order) for k in range(count - 1))
    )
    assert axis.any()


@pytest.mark.parametrize(("name", "symmetry"), [("xy", "mirror x"), ("xyz", "3-fold about z")])
def test_limbs_have_the_symmetry_that_is_asked_for(name, symmetry):
    """By the solids: `design_oracle.symmetric`."""
    problem = given(name, boxes=False, bodies=3)
    frame = scaled(problem)
    group = asked_group(replace(problem, symmetry=symmetry), frame)
    made = limbs(problem, frame, sizes_of(problem), problem.limits.kinds, group)
    _, flexures, bodies = next((each, *flexures_of(problem, frame, each)) for each in made)
    assert_right(problem, flexures, bodies)
    asked = {"centre": problem.centre, "size": problem.size}
    every = [as_json(flexure) | {"between": flexure.between} for flexure in flexures]
    assert design_oracle.symmetric(asked, every, symmetry)


def _has_image(flexures, bodies, k, axis, order):
    """Whether the flexures of a body, after a part of a turn, are those of the next one."""
    angle = 2 * np.pi / order
    cross = np.cross(np.eye(3), axis)
    turn = np.eye(3) - np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    for sense in (turn, turn.T):
        ours, theirs = (
            np.array([f.ends for f in flexures if bodies[j][0] in f.between]) for j in (k, k + 1)
        )
        apart = np.linalg.norm((ours @ sense.T)[:, None] - theirs[None], axis=3).max(axis=2)
        if (apart.min(axis=1) < 1e-9).all():
            return True
    return False


def test_a_limb_alone_has_five_freedoms_and_holds_its_wrench():
    """6 - 1: a body between that had a motion of its own would be a sixth."""
    problem = given("schoenflies")
    arrangement, flexures, bodies = found(limbs, problem, 1)[0]
    for name, _ in bodies:
        own = [flexure for flexure in flexures if name in flexure.between]
        rows = constraints(problem, own, [(name, None)])
        free = np.linalg.svd(rows)[2][len(rows) :]
        stage = free[:, :6]
        assert np.linalg.matrix_rank(stage, 1e-6) == len(free) == 5
        held = np.roll(np.linalg.svd(stage)[2][-1], 3)
        # A couple, across z.
        assert np.abs(held[:3]).max() < 1e-9
        assert abs(held[5]) < 1e-9
    assert len(arrangement.parts) == 2 * len(bodies)


# Pieces ---------------------------------------------------------------------------------

SIZES = Sizes((0.5, 3.0), (0.2, 0.5), 0.01, 0.02, 0.04, 2.6)
HERE = Box(np.array([-0.5, -0.5, -0.2]), np.array([0.5, 0.5, 0.2]))
THERE = Box(np.array([-0.5, -0.5, -1.4]), np.array([0.5, 0.5, -1.2]))


@pytest.mark.parametrize(
    "wrench",
    [
        (0, 0, 0, 1, 0, 0),
        (0, 0, 0, 0.6, 0.8, 0),
        (0, 0, 1, 0, 0, 0.2),
        (0.6, 0, 0.8, -0.1, 0.3, 0.2),
    ],
)
def test_two_wires_of_a_limb_have_its_wrench_as_one_combination(wrench):
    wrench = np.array(wrench, float) / np.linalg.norm(wrench)
    place = Place(np.zeros((0, 6)), (HERE,), (THERE,), (), SIZES)
    made = list(itertools.islice(pairs(place, wrench), 3))
    assert made
    for each in made:
        rows = np.array([candidates.rows[k, 0] for candidates, k in each.chosen.members])
        shares, *_ = np.linalg.lstsq(rows.T, wrench, rcond=None)
        assert np.abs(shares @ rows - wrench).max() < 1e-12
        axis = next(hinges(np.array([[0.4, 0.3, -1.3], [-0.4, 0.2, -1.3]]), wrench, rows[0]))
        # A rotation about a line, that does no work on the wrench, but on both wires.
        assert abs(axis[:3] @ axis[3:]) < 1e-12
        assert abs(wrench @ np.roll(axis, 3)) < 1e-12
        assert np.abs(rows @ np.roll(axis, 3)).min() > 0.02


def test_wrenches_for_limbs_are_what_wires_do_not_hold():
    """W of x and y is the force and the couples across, which wires hold, and the couple z."""
    freedom = possible(scaled(given("xy")).space)
    held = freedom.forces.scaled
    for row in wrenches_of(freedom.constraint.scaled, held, False):
        assert np.linalg.norm(row) == pytest.approx(1)
        assert np.abs(row[:3]).max() < 1e-12
        assert np.linalg.norm(row - row @ held.T @ held) > 0.2


def test_bodies_that_are_proposed_are_clear_of_all_that_is_there():
    problem = given("xy", boxes=False)
    keep = (Box(np.array([-0.05, -0.05, 0.015]), np.array([0.05, 0.05, 0.055])),)
    problem = replace(problem, keep_out=keep)
    frame = scaled(problem)
    solid = (*boxes_of(frame.stage), *boxes_of(frame.ground), *frame.keep_out)
    made = proposed(frame, sizes_of(problem))
    assert made
    for boxes, other in itertools.product(made, solid):
        for box in boxes:
            gaps = np.maximum(box.low - other.high, other.low - box.high)
            assert gaps.max() >= problem.limits.clearance / problem.size - 1e-9


def test_bodies_in_a_row_share_no_room():
    frame = scaled(given("xyz", boxes=False))
    made = list(itertools.islice(stacks(frame, SIZES, 2), 40))
    assert made
    for one, other in made:
        for a, b in itertools.product(one, other):
            assert np.maximum(a.low - b.high, b.low - a.high).max() >= SIZES.clearance - 1e-9


def test_one_box_is_cut_for_two_bodies():
    """Limbs of x, y, z, turn: two bodies, one box of which they are given halves."""
    problem = given("schoenflies")
    frame = scaled(problem)
    (places,) = asides(frame, sizes_of(problem), 2)
    (one,), (other,) = places
    (whole,) = frame.intermediate
    assert np.array_equal(np.minimum(one.low, other.low), whole.low)
    assert np.array_equal(np.maximum(one.high, other.high), whole.high)
    gap = np.maximum(one.low - other.high, other.low - one.high).max()
    assert gap == pytest.approx(problem.limits.clearance / problem.size)


def test_arms_of_a_frame_go_around():
    """Each next corner shares a bar with the one before, so that no arm crosses the middle."""
    bars = (
        Box(np.array([-1.2, -1.2, 0.0]), np.array([1.2, -1.0, 0.2])),
        Box(np.array([-1.2, 1.0, 0.0]), np.array([1.2, 1.2, 0.2])),
        Box(np.array([-1.2, -1.0, 0.0]), np.array([-1.0, 1.0, 0.2])),
        Box(np.array([1.0, -1.0, 0.0]), np.array([1.2, 1.0, 0.2])),
    )
    corners = corners_between(bars)
    assert len(corners) == 4
    for one, other in itertools.pairwise(corners):
        assert np.abs((one + other) / 2)[:2].max() == pytest.approx(1.1, abs=0.11)
    assert len(corners_between(bars[:1])) == 0
