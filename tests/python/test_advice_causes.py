# SPDX-License-Identifier: BSD-3-Clause
"""Which motions and self-stresses any geometry has, which this one, and what lifts those.

Counts of the generic case follow from the numbers of constraints and coordinates (Maxwell,
Gruebler), or from a rigidity matrix made here; special cases are those of
tests/reference/known_answers.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from divided import WIRE, Division, Rows
from known_models import ring, twelve_trusses
from random_models import framework
from reference_decks import NAMES, text_of, transform

import flexact
from flexact import Model
from flexact.advice.causes.cause import CauseKind, Causes
from flexact.advice.causes.causes import causes_of
from flexact.advice.causes.gradients import generic_rank
from flexact.model.variation import with_positions

pytestmark = pytest.mark.dear(70)

#: Places of both ends of flexures, the one at the ground first.
Ends = Sequence[tuple[Sequence[float], Sequence[float]]]

#: Special motions, special self-stresses, and motions and self-stresses in all.
KNOWN = {
    # Two flat sheets between the ground and one body, whatever their tilt.
    "flexures/parallel_guide_undeclared": (0, 0, 1, 1),
    "flexures/cross_hinge_undeclared": (0, 0, 1, 1),
    "flexures/two_tilted_sheets": (0, 0, 0, 1),
    # A folded sheet clamped at both ends, whatever the angle of the fold.
    "paper/folded_sheet_clamped": (0, 0, 1, 1),
    "flexures/folded_sheet_clamped_at_60_degrees": (0, 0, 1, 1),
    "flexures/five_folded_sheets_trap": (0, 0, 5, 5),
    # Six lines in general hold six motions; with the guided one declared they are one too many.
    "flexures/six_folded_sheets_undeclared": (1, 1, 7, 1),
    "paper/six_folded_sheets": (0, 0, 0, 1),
    "paper/five_folded_sheets_symmetric": (1, 1, 1, 1),
    "flexures/five_wires_lower_two_parallel": (1, 1, 1, 1),
    # Maxwell: twelve bars, twelve coordinates.
    "paper/twelve_trusses": (1, 1, 1, 1),
    "frameworks/twelve_trusses_without_ef": (0, 0, 1, 0),
    "frameworks/collinear_bars_plane": (1, 1, 1, 1),
    "frameworks/collinear_bars_space": (1, 1, 2, 1),
    "frameworks/prism_twist_30": (1, 1, 1, 1),
    "frameworks/k33_circle": (1, 1, 1, 1),
    "frameworks/k33_two_lines": (1, 1, 1, 1),
    "frameworks/octahedral_platform_yaw_90": (1, 1, 1, 1),
    "frameworks/third_order": (1, 1, 1, 1),
    "frameworks/ring_4": (1, 1, 1, 1),
    "frameworks/ring_6": (1, 1, 1, 1),
    # A loop of four hinges lacks two freedoms of being rigid, one of six none, one of seven moves.
    "linkages/bennett": (1, 1, 1, 3),
    "linkages/four_bar_in_space": (1, 1, 1, 3),
    "linkages/sarrus": (1, 1, 1, 1),
    "linkages/loop_7r": (0, 0, 1, 0),
    "linkages/four_bar_planar": (0, 0, 1, 0),
}


def causes_of_deck(name: str) -> Causes:
    return causes_of(flexact.analyse(flexact.read_text(text_of(name), name)))


def special(causes: Causes) -> tuple[int, int]:
    """How many motions and how many self-stresses are special."""
    return (
        sum(one.kind is CauseKind.SPECIAL for one in causes.motions),
        sum(one.kind is CauseKind.SPECIAL for one in causes.self_stresses),
    )


@pytest.mark.parametrize("name", KNOWN)
def test_what_is_special_of_known_mechanisms(name: str) -> None:
    causes = causes_of_deck(name)
    assert (*special(causes), len(causes.motions), len(causes.self_stresses)) == KNOWN[name]


def rigidity_rank(model: Model, places: np.ndarray) -> int:
    """Rank of the rigidity matrix of bars, whose rows are (p - q, q - p)."""
    arrays = model.data.arrays
    size = 2 if model.planar else 3
    rows = np.zeros((arrays.element_number.size, arrays.node_kind.size, size))
    for row, (p, _, q, _) in zip(rows, (arrays.element_node.T - 1).tolist(), strict=True):
        row[p], row[q] = places[p] - places[q], places[q] - places[p]
    free = arrays.coordinate_class.T[:, :size] == 2
    return int(np.linalg.matrix_rank(rows[:, free]))


@pytest.mark.parametrize("seed", range(30))
def test_generic_rank_of_frameworks(seed: int) -> None:
    rng = np.random.default_rng(seed)
    planar = bool(seed % 2)
    model = framework(rng, int(rng.integers(5, 9)), int(rng.integers(8, 18)), 2, planar)
    # On a coarse grid many bars are parallel or in line.
    snapped = with_positions(model.data, np.round(model.positions * 1.5) / 1.5)
    if snapped.problems.errors:
        snapped = model.data
    result = flexact.analyse(Model.from_data(snapped))
    expected = rigidity_rank(model, rng.normal(size=(len(model.positions), 2 if planar else 3)))
    assert generic_rank(result) == expected
    assert special(causes_of(result)) == (expected - result.rank,) * 2


def test_what_no_misalignment_lifts_is_generic() -> None:
    """Beside a special pair: a joint on two bars in space, and a line of two bars."""
    model = Model()
    a, b = model.node(-1, 0, 0), model.node(1, 0, 0)
    line = model.node(0, 0, 0)
    model.truss(a, line)
    model.truss(line, b)
    corner = model.node(0, 2, 0)
    for k, place in enumerate(((-1, 3, 0), (1, 3, 0), (0, 3, 1), (0.2, 2.7, -1))):
        foot = model.node(*place)
        model.fix(foot)
        model.truss(foot, corner, name=f"leg {k + 1}")
    model.fix(a)
    model.fix(b)
    result = flexact.analyse(model)
    assert (result.under_constrained, result.over_constrained) == (2, 2)
    causes = causes_of(result)
    kinds = {
        "leg" in stress.parts[0].part.name: cause.kind
        for stress, cause in zip(result.self_stresses, causes.self_stresses, strict=True)
    }
    assert kinds == {True: CauseKind.GENERIC, False: CauseKind.SPECIAL}
    assert all(one.together == () for one in causes.self_stresses)
    # Which of the two motions is left depends on where the joint is moved.
    assert [one.together for one in causes.motions] == [(0, 1), (0, 1)]
    assert special(causes) == (1, 1)


def test_a_lift_has_the_closed_form() -> None:
    """Two bars of 1 m in line: with the joint off by d the rows are (1, d) and (-1, d) over root 2.

    So the smallest singular value is d; to turn a bar about its middle moves the joint by half.
    """
    (motion,) = causes_of_deck("frameworks/collinear_bars_plane").motions
    assert motion.lift is not None
    assert motion.lift.by_move == pytest.approx(1.0, rel=1e-6)
    assert motion.lift.by_turn == pytest.approx(0.5, rel=1e-6)
    assert motion.lift.node == 2


@pytest.mark.parametrize(
    "name",
    [
        "paper/twelve_trusses",
        "frameworks/prism_twist_30",
        "paper/five_folded_sheets_symmetric",
        "frameworks/octahedral_platform_yaw_90",
        "flexures/five_wires_lower_two_parallel",
    ],
)
def test_a_lift_is_what_a_moved_node_makes(name: str) -> None:
    """The gradient's length, from three analyses with the node moved along the axes."""
    model = flexact.read_text(text_of(name), name)
    result = flexact.analyse(model)
    (cause,) = causes_of(result).self_stresses
    assert cause.lift is not None
    assert cause.lift.node is not None
    index = model.data.node_index[cause.lift.node]
    step = 1e-6 * result.characteristic_length
    rates = []
    for axis in range(3):
        places = model.positions.copy()
        places[index, axis] += step
        moved = flexact.analyse(Model.from_data(with_positions(model.data, places)))
        rates.append(moved.scaled_singular_values[-1] / step)
    assert cause.lift.by_move == pytest.approx(float(np.linalg.norm(rates)), rel=1e-3)


def test_what_is_lifted_to_second_order_only_has_no_lift() -> None:
    causes = causes_of_deck("frameworks/third_order")
    assert causes.motions[0].kind is CauseKind.SPECIAL
    assert causes.motions[0].lift is None
    assert not causes.motions[0].is_first_order


RELATIONS = {
    "frameworks/collinear_bars_plane": ["one line"],
    "frameworks/k33_circle": ["circle"],
    "frameworks/k33_two_lines": ["two lines"],
    "frameworks/octahedral_platform_yaw_90": ["complex"],
    "frameworks/prism_twist_30": ["complex"],
    "linkages/bennett": ["regulus"],
    "linkages/four_bar_in_space": ["parallel"],
    "linkages/sarrus": ["parallel", "parallel"],
    "linkages/parallelogram_three_cranks": ["parallel"],
    "flexures/five_wires_lower_two_parallel": ["parallel"],
    "flexures/six_folded_sheets_undeclared": ["across"],
    "paper/five_folded_sheets_symmetric": ["one plane", "parallel"],
    "paper/twelve_trusses": ["reflection"],
    "frameworks/ring_6": ["reflection"],
}


@pytest.mark.parametrize("name", RELATIONS)
def test_what_makes_a_geometry_special(name: str) -> None:
    causes = causes_of_deck(name)
    found = next(one for one in causes.self_stresses if one.kind is CauseKind.SPECIAL)
    assert [one.kind for one in found.relations] == RELATIONS[name]
    assert all(
        one.relations == found.relations for one in causes.motions if one.kind is CauseKind.SPECIAL
    )


def test_fold_lines_that_fight_over_a_rotation() -> None:
    """Fig. 5: the upper three and the lower two both make a couple about the vertical."""
    (stress,) = causes_of_deck("paper/five_folded_sheets_symmetric").self_stresses
    upper, lower = stress.relations
    assert {part.name[:5] for part in upper.parts} == {"upper"}
    assert {part.name.split(",")[0] for part in lower.parts} == {"lower 0", "lower 180"}
    for one in (upper, lower):
        np.testing.assert_allclose(np.abs(one.couple), (0, 0, 1), atol=1e-9)


def test_an_octahedral_platform_screws_about_the_vertical() -> None:
    """Fichter's singularity: at yaw 90 degrees it turns and rises.

    A leg from (r cos a, r sin a, 0) to (p cos b, p sin b, h) does no work on a turn by 1 and a rise
    by t where t h + r p sin(b - a) = 0; here sin(b - a) = 1/2, r = h = 1, p = 0.6: t = -0.3.
    """
    (stress,) = causes_of_deck("frameworks/octahedral_platform_yaw_90").self_stresses
    (complex_,) = stress.relations
    assert abs(complex_.pitch) == pytest.approx(0.3)
    np.testing.assert_allclose(complex_.direction, (0, 0, 1), atol=1e-9)
    np.testing.assert_allclose(complex_.point[:2], 0, atol=1e-9)


def test_a_symmetry_is_told_where_it_is_enough() -> None:
    """Not of a ring whose joints are moved so that it is symmetric no more."""
    model = ring(4)
    places = model.positions.copy()
    (stress,) = causes_of(flexact.analyse(model)).self_stresses
    assert stress.relations[0].is_sufficient
    places[-1] += (0.05, 0.02, 0.1)
    moved = flexact.analyse(Model.from_data(with_positions(model.data, places)))
    assert moved.over_constrained == 0


def test_concurrent_axes_are_enough() -> None:
    """A spherical four-bar linkage: four axes through one point move, three times held too much."""
    model = Model()
    rng = np.random.default_rng(3)
    places = rng.normal(size=(4, 3))
    first = model.node(*places[0])
    model.fix(first)
    node = first
    for k in range(4):
        node = model.hinge(node, places[k], name=f"joint {k + 1}")
        if k < 3:
            following = model.node(*places[k + 1])
            model.rigid(node, following, name=f"link {k + 1}")
            node = following
    model.fix(node)
    result = flexact.analyse(model)
    assert (result.under_constrained, result.over_constrained) == (1, 3)
    causes = causes_of(result)
    assert special(causes) == (1, 1)
    (relation,) = causes.motions[0].relations
    assert relation.kind == "concurrent"
    assert relation.is_sufficient
    np.testing.assert_allclose(relation.point, 0, atol=1e-6)


def wires(how: Division) -> Model:
    """Five wires of which four are parallel, as five_wires_lower_two_parallel.dat."""
    model = Model(name="wires")
    rows, centre = Rows(model, how), model.node(0, 0, 0)
    directions = ((1, 0, -0.03, 0.02), (1, 0, 0.03, 0.02), (0, 1, 0, 0.02))
    lower = ((1, 0, -0.03, -0.02), (1, 0, 0.03, -0.02))
    for k, (x, y, beside, z) in enumerate((*directions, *lower)):
        way, off = np.array([x, y, 0.0]), np.array([beside * y, beside * x, z])
        places = 0.1 * way + off, 0.04 * way + off
        ends = model.node(*places[0]), model.node(*places[1])
        model.fix(ends[0])
        rows.add(ends, places, (0.0, 0.0, 1.0), WIRE, f"wire {k + 1}")
        model.rigid(centre, ends[1], name="body")
    return model


@pytest.mark.parametrize(
    "how",
    [Division(beams=3), Division(beams=3, declared=False), Division(beams=4, against=True, seed=1)],
)
def test_division_changes_no_cause(how: Division) -> None:
    plain = causes_of(flexact.analyse(wires(Division())))
    result = flexact.analyse(wires(how))
    causes = causes_of(result)
    assert special(causes) == special(plain) == (1, 1)
    internal = [motion.is_internal for motion in result.motions]
    kinds = [one.kind for one, inside in zip(causes.motions, internal, strict=True) if not inside]
    assert kinds == [one.kind for one in plain.motions]
    assert all(
        one.kind is CauseKind.GENERIC
        for one, inside in zip(causes.motions, internal, strict=True)
        if inside
    )
    (stress,), (expected,) = causes.self_stresses, plain.self_stresses
    assert [one.kind for one in stress.relations] == [one.kind for one in expected.relations]
    assert stress.lift is not None
    assert expected.lift is not None
    assert stress.lift.by_turn == pytest.approx(expected.lift.by_turn, rel=1e-6)


def on_a_stage(sheets: Ends = (), wires: Ends = ()) -> Model:
    """A stage on sheets, whose width is along z, and wires, from the ground to the stage."""
    model = Model(name="stage")
    ends = []
    for k, (ground, end) in enumerate(sheets, 1):
        model.sheet(ground, end, width=(0, 0, 1), name=f"sheet {k}")
        model.fix(ground)
        ends.append(end)
    for k, (ground, end) in enumerate(wires, 1):
        model.wire(ground, end, name=f"wire {k}")
        model.fix(ground)
        ends.append(end)
    model.body(ends, name="stage")
    return model


def ray(angle: float) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """From 50 to 20 mm towards the z axis."""
    x, y = np.cos(angle), np.sin(angle)
    return (0.05 * x, 0.05 * y, 0.0), (0.02 * x, 0.02 * y, 0.0)


#: What presses on the stage, motions and self-stresses, special ones, and what makes them so. A
#: sheet has three constraints, a wire one; the generic counts are theirs against six.
STAGES = {
    "three parallel sheets": (
        on_a_stage([((0, y, 0), (0.1, y, 0)) for y in (0, 0.03, 0.07)]),
        (1, 4, 1),
        ("across", "sheet"),
    ),
    "three sheets through a line": (
        on_a_stage([ray(0.1), ray(2.2), ray(4.0)]),
        (1, 4, 1),
        ("one transversal", "sheet"),
    ),
    "a wire in the plane of a sheet": (
        on_a_stage(
            [((0, 0, 0), (0.1, 0, 0))],
            [((0.15, 0, 0.03), (0.12, 0, 0.02)), ((0.1, 0.1, 0), (0.1, 0.05, 0.01))],
        ),
        (2, 1, 1),
        ("one plane", "sheet"),
    ),
    "two sheets in one plane": (
        on_a_stage([((0, 0, 0), (0.1, 0, 0)), ((0.3, 0, 0.01), (0.2, 0, 0))]),
        (3, 3, 2),
        ("one plane", "sheet"),
    ),
    "two wires in one line": (
        on_a_stage(wires=[((0, 0, 0), (0.1, 0, 0)), ((0.3, 0, 0), (0.2, 0, 0))]),
        (5, 1, 1),
        ("one line", "force"),
    ),
    "four wires through a point": (
        on_a_stage(
            wires=[
                (tuple(0.1 * np.array(way)), tuple(0.05 * np.array(way)))
                for way in ((1, 0, 0.2), (0, 1, -0.3), (-1, -1, 0.4), (0.3, -0.8, -1))
            ]
        ),
        (3, 1, 1),
        ("concurrent", "force"),
    ),
    "six wires that meet a line": (
        on_a_stage(
            wires=[
                ((0.1 * np.cos(k), 0.1 * np.sin(k), 0.02 * k * k), (0, 0, 0.03 * k))
                for k in range(6)
            ]
        ),
        (1, 1, 1),
        ("one transversal", "force"),
    ),
}


@pytest.mark.parametrize("name", STAGES)
def test_what_flexures_of_a_stage_have_in_common(name: str) -> None:
    model, (motions, stresses, count), told = STAGES[name]
    result = flexact.analyse(model)
    external = sum(not motion.is_internal for motion in result.motions)
    assert (external, result.over_constrained) == (motions, stresses)
    causes = causes_of(result)
    assert special(causes) == (count, count)
    found = next(one for one in causes.self_stresses if one.kind is CauseKind.SPECIAL)
    relation = found.relations[0]
    assert (relation.kind, relation.of) == told


def test_what_a_tolerance_makes_zero_is_special() -> None:
    """The prism turned by 2.9 degrees more has a smallest singular value of 0.038."""
    model = flexact.read_text(text_of("frameworks/prism_twist_32_9"))
    assert causes_of(flexact.analyse(model)).motions == ()
    causes = causes_of(flexact.analyse(model, tolerance=0.05))
    assert special(causes) == (1, 1)


def test_what_cannot_be_tried_is_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("flexact.advice.causes.gradients.rank_at", lambda *_: None)
    causes = causes_of_deck("paper/twelve_trusses")
    assert {one.kind for one in (*causes.motions, *causes.self_stresses)} == {CauseKind.UNKNOWN}
    assert causes.generic_rank is None


def test_mechanisms_beside_each_other_are_told_apart() -> None:
    """Two stages on five wires, four of them parallel: each has one motion too many."""
    model = Model()
    for unit, shift in (("a", 0.0), ("b", 0.5)):
        ends = []
        for k, (x, y, z) in enumerate(
            ((1, -0.03, 0.02), (1, 0.03, 0.02), (0, 0, 0.02), (1, -0.03, -0.02), (1, 0.03, -0.02))
        ):
            way = np.array([x, 1 - x, 0])
            ground, end = (r * way + (shift, y, z) for r in (0.1, 0.04))
            model.wire(ground, end, name=f"{unit} wire {k + 1}")
            model.fix(ground)
            ends.append(end)
        model.body(ends, name=f"{unit} stage")
    result = flexact.analyse(model)
    assert (result.under_constrained, result.over_constrained) == (4, 2)
    causes = causes_of(result)
    assert special(causes) == (2, 2)
    for motion, cause in zip(result.motions, causes.motions, strict=True):
        names = {result.motions[k].bodies[0].names[0][0] for k in cause.together}
        assert names == {motion.bodies[0].names[0][0]}
        assert (len(cause.together), cause.special) == (2, 1)
    for stress, cause in zip(result.self_stresses, causes.self_stresses, strict=True):
        (relation,) = cause.relations
        assert {part.name[0] for part in relation.parts} == {stress.parts[0].part.name[0]}


def test_very_many_are_counted_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    expected = causes_of_deck("frameworks/collinear_bars_space")
    monkeypatch.setattr("flexact.advice.causes.gradients.MOST_ENTRIES", 1)
    causes = causes_of_deck("frameworks/collinear_bars_space")
    assert special(causes) == special(expected)
    assert all(one.lift is None and one.is_first_order is None for one in causes.motions)


TURN = transform.about("x", 0.7) @ transform.about("y", -1.1) @ transform.about("z", 2.3)


@pytest.mark.parametrize(
    "name", [name for name in NAMES if name in KNOWN and "six_folded" not in name]
)
def test_units_and_turns_change_no_cause(name: str) -> None:
    expected = causes_of_deck(name)
    texts = [transform.scaled(text_of(name), 1e3), transform.turned(text_of(name), TURN)]
    for text in texts:
        if text is None:
            continue
        found = causes_of(flexact.analyse(flexact.read_text(text)))
        assert special(found) == special(expected)
        for one, other in (
            *zip(found.motions, expected.motions, strict=True),
            *zip(found.self_stresses, expected.self_stresses, strict=True),
        ):
            assert [r.kind for r in one.relations] == [r.kind for r in other.relations]
            assert one.together == other.together
            assert (one.lift is None) == (other.lift is None)


def test_lengths_scale_lifts_by_their_units() -> None:
    text = text_of("paper/five_folded_sheets_symmetric")
    found = []
    for factor in (1.0, 1e3):
        deck = transform.scaled(text, factor)
        (motion,) = causes_of(flexact.analyse(flexact.read_text(deck))).motions
        assert motion.lift is not None
        found.append((motion.lift.by_move * factor, motion.lift.by_turn, motion.lift.node))
    for one, other in pairwise(found):
        assert one == pytest.approx(other, rel=1e-6)


def test_numbers_change_no_cause() -> None:
    model = twelve_trusses()
    data = model.data
    arrays = data.arrays
    order = np.random.default_rng(5).permutation(arrays.element_number.size)
    shuffled = Model()
    places = model.positions
    nodes = {}
    for index in order.tolist():
        p, _, q, _ = (arrays.element_node[:, index] - 1).tolist()
        for node in (q, p):
            if node not in nodes:
                nodes[node] = shuffled.node(*places[node])
        shuffled.truss(nodes[q], nodes[p])
    for node in range(4):
        shuffled.fix(nodes[node])
    (one,), (other,) = (causes_of(flexact.analyse(m)).motions for m in (model, shuffled))
    assert one.lift is not None
    assert other.lift is not None
    assert one.lift.by_move == pytest.approx(other.lift.by_move, rel=1e-6)
    assert one.relations[0].kind is other.relations[0].kind


def test_a_large_lattice_is_looked_at_once() -> None:
    """A square lattice of bars with few diagonals, of some 700 members."""
    model = Model(planar=True)
    rng = np.random.default_rng(0)
    size = 18
    nodes = [[model.node(i, j) for j in range(size)] for i in range(size)]
    for i in range(size):
        for j in range(size):
            for p, q in ((1, 0), (0, 1), (1, 1)):
                is_there = i + p < size and j + q < size
                if is_there and (p * q == 0 or rng.random() < 0.15):
                    model.truss(nodes[i][j], nodes[i + p][j + q])
    model.fix(nodes[0][0])
    model.fix(nodes[-1][0])
    result = flexact.analyse(model)
    causes = causes_of(result)
    expected = rigidity_rank(model, rng.normal(size=(size * size, 2)))
    assert causes.generic_rank == expected
    assert special(causes)[0] == expected - result.rank > 0
