# SPDX-License-Identifier: BSD-3-Clause
"""Folded sheets, cross hinges, parallel guides, hexapods, notches: geometry by hand, counts
from the reference cases and the paper."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from wrong_use import code_of

import flexact
from flexact import Model, ModelError, Notch, analyse


def counts(model: Model) -> tuple[int, int]:
    analysis = analyse(model)
    return analysis.under_constrained, analysis.over_constrained


def vector_of(model: Model, name: str) -> np.ndarray:
    """The y vector of the element with this name, of length 1: the normal of a sheet."""
    made = model.element_vectors[list(model.element_names).index(name)]
    return made / np.linalg.norm(made)


@pytest.mark.parametrize("beams", [1, 3])
@pytest.mark.parametrize("degrees", [30.0, 60.0, 90.0, 179.0])
def test_a_folded_sheet_takes_one_motion_and_declares_its_fold(beams: int, degrees: float) -> None:
    """Far end free: one constraint, the force along the fold line (paper, section 4.2)."""
    model = Model()
    far = 1 + math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0.0
    folded = model.folded_sheet((0, 0, 0), (1, 0, 0), far, name="folded", beams=beams)
    model.fix((0, 0, 0))
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (5, 0)
    # The fold line is normal to the plane of the points, z: what is fastened to the end does not
    # move along it, where the fold is.
    end, arm = folded.nodes[2], np.array([1.0, 0, 0]) - far
    for motion in analysis.motions:
        turn = motion.rotation[model.node_index(end.orientation)]
        moved = motion.displacement[model.node_index(end.position)] + np.cross(turn, arm)
        assert abs(moved[2]) < 1e-12
    assert len(analysis.freedoms) == 1
    assert analysis.degrees_of_freedom == 1 + 12 * (beams - 1) // 2
    assert [leaf.name for leaf in folded.leaves] == ["folded, leaf 1", "folded, leaf 2"]
    assert (folded.name, folded.fold.name) == ("folded", "folded, fold")
    assert repr(folded) == "<FoldedSheet 'folded' from (0, 0, 0) over 'folded, fold' to " + (
        f"({far[0]:g}, {far[1]:g}, 0)>"
    )


def test_a_folded_sheet_clamped_twice_is_as_in_the_paper() -> None:
    """One motion, which is declared, and one self-stress (Fig. 4 b and c)."""
    model = Model()
    model.folded_sheet((0, 0, 0), (1, 0, 0), (1, 1, 0))
    model.fix((0, 0, 0), (1, 1, 0))
    assert counts(model) == (0, 1)


def test_the_statements_of_a_folded_sheet_are_those_of_the_paper_deck() -> None:
    """input_decks/paper/five_folded_sheets.dat: RLSE 1 2 5, DYNE 1 6; RLSE 2 2 5 6."""
    model = Model()
    model.folded_sheet((0, 0.06, 0.09), (0, 0.06, 0.03), (0, 0, 0), name="upper 90")
    assert model.deformation_classes.tolist() == [[1, 2, 1, 1, 2, 3], [1, 2, 1, 1, 2, 2]]
    # The normals of the sheets, up to their sense.
    for name, normal in (
        ("upper 90, leaf 1", [0, -1, 0]),
        ("upper 90, leaf 2", [0, -0.44721359549995787, 0.8944271909999157]),
    ):
        assert abs(vector_of(model, name) @ normal) == pytest.approx(1.0, abs=1e-14)


def test_a_straight_folded_sheet_needs_a_width() -> None:
    model = Model()
    with pytest.raises(ModelError) as error:
        model.folded_sheet((0, 0, 0), (1, 0, 0), (2, 0, 0), name="flat")
    assert code_of(error) == "missing-vector"
    assert "folded_sheet 'flat': " in str(error.value)
    model.folded_sheet((0, 0, 0), (1, 0, 0), (2, 0, 0), "z", name="flat")
    model.fix((0, 0, 0))
    # Two sheets in one plane are one long sheet with three motions, one of them at the fold.
    assert model.element_numbers.size == 2


@pytest.mark.parametrize(("degrees", "apart"), [(40, 0.0), (90, 0.0), (90, 0.02), (130, 0.01)])
def test_a_cross_hinge_turns_about_the_line_in_which_its_sheets_cross(
    degrees: float, apart: float
) -> None:
    a = math.radians(degrees / 2)
    x, z = 0.1 * math.sin(a), 0.1 * math.cos(a)
    model = Model()
    hinge = model.cross_hinge(
        [(-x, -apart, 0), (x, apart, 0)], [(x, -apart, 2 * z), (-x, apart, 2 * z)], name="hinge"
    )
    model.fix(*hinge.ground)
    analysis = analyse(model)
    # One motion, one self-stress: a force along the axis (reference cases of flexures).
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 1)
    motion = analysis.motions[0]
    point = hinge.points["body 1"]
    turn = motion.rotation[model.node_index(point.orientation)]
    moved = motion.displacement[model.node_index(point.position)]
    turn, moved = turn / np.linalg.norm(turn), moved / np.linalg.norm(turn)
    assert np.abs(turn[[0, 2]]).max() < 1e-12
    assert np.allclose(moved, np.cross(turn, [x, 0, z]), atol=1e-12), "about (0, *, z)"
    assert hinge.name == "hinge" and list(hinge.parts) == ["sheet 1", "sheet 2", "body"]
    assert [part.name for part in hinge.parts.values()] == [
        "hinge sheet 1",
        "hinge sheet 2",
        "hinge body",
    ]
    assert hinge["body"] == hinge.body == model.part("hinge body")
    assert hinge["ground 1"] == model.point("hinge ground 1")


def test_a_cross_hinge_of_three_sheets() -> None:
    """Planes that meet in one line: five motions held, of 9 held deformations."""
    model = Model()
    ground, moving = [], []
    for k, y in enumerate((-0.02, 0.0, 0.02)):
        side = (-1) ** k * 0.03
        ground.append((-side, y, 0))
        moving.append((side, y, 0.08))
    hinge = model.cross_hinge(ground, moving)
    model.fix(*hinge.ground)
    assert counts(model) == (1, 4)


def test_parallel_guides_translate_along_the_normal_of_their_sheets() -> None:
    random = np.random.default_rng(2)
    for _ in range(5):
        p, along, other = random.normal(size=(3, 3))
        model = Model()
        guide = model.parallel_guide(p, p + along, other, name="guide")
        model.fix(*guide.ground)
        analysis = analyse(model)
        assert (analysis.under_constrained, analysis.over_constrained) == (1, 1)
        motion = analysis.motions[0]
        moves = [
            motion.displacement[model.node_index(guide.points[f"stage {k}"].position)]
            for k in (1, 2)
        ]
        normal = np.cross(along, np.cross(along, other))
        cosine = moves[0] @ normal / np.linalg.norm(moves[0]) / np.linalg.norm(normal)
        assert abs(cosine) == pytest.approx(1, abs=1e-12)
        assert np.allclose(*moves, atol=1e-12)


def test_a_guide_of_more_sheets_adds_a_self_stress_a_sheet() -> None:
    # Planar guide of three sheets and spatial counts: each further sheet holds 3 and frees none.
    for sheets, stress in ((2, 1), (3, 4), (5, 10)):
        model = Model()
        guide = model.parallel_guide((0, 0, 0), (0.1, 0, 0), (0, 0.05, 0), sheets=sheets)
        model.fix(*guide.ground)
        assert counts(model) == (1, stress)
        assert len(guide.ground) == sheets


def test_a_planar_guide_is_exact_with_its_motion_declared() -> None:
    """input_decks/flexures/planar_parallel_guide.dat: two held elongations of three motions."""
    model = Model(planar=True)
    guide = model.parallel_guide((0, 0), (0.1, 0), (0, 0.05))
    model.fix(*guide.ground)
    assert counts(model) == (1, 0)
    model.independent(guide.body, "y")
    assert analyse(model).verdict is flexact.Verdict.EXACT


@pytest.mark.parametrize("spread", [0.0, 20.0, (10.0, 35.0)])
def test_a_hexapod_is_exact(spread: float | tuple[float, float]) -> None:
    model = Model()
    hexapod = model.hexapod(1.0, 0.6, 1.0, spread=spread, at=(0, 0, 2))
    model.fix(*hexapod.ground)
    assert counts(model) == (0, 0)
    a, b = spread if isinstance(spread, tuple) else (spread, spread)
    base = np.array([node.place for node in hexapod.ground])
    angles = np.degrees(np.arctan2(base[:, 1], base[:, 0])) % 360
    wanted = {(c + s * a / 2) % 360 for c in (0, 120, 240) for s in (-1, 1)}
    assert sorted(angles) == pytest.approx(sorted(wanted))
    assert np.allclose(np.hypot(*base[:, :2].T), 1) and (base[:, 2] == 2).all()
    top = np.array([n.place for k, n in hexapod.points.items() if k.startswith("platform")])
    angles = np.degrees(np.arctan2(top[:, 1], top[:, 0])) % 360
    assert sorted(angles) == pytest.approx(
        sorted({(c + s * b / 2) % 360 for c in (60, 180, 300) for s in (-1, 1)})
    )
    assert np.allclose(np.hypot(*top[:, :2].T), 0.6) and (top[:, 2] == 3).all()
    lengths = [
        math.dist(*(node.place for node in part.nodes)) for part in list(hexapod.parts.values())[:6]
    ]  # type: ignore[union-attr]
    assert lengths == pytest.approx([lengths[0]] * 6), "wires are alike"


def test_a_hexapod_turned_by_90_degrees_is_the_known_singular_one() -> None:
    """Octahedral platform of the reference cases: yaw 0 exact, yaw 90 one motion more."""
    for yaw, wanted in ((0, (0, 0)), (80, (0, 0)), (90, (1, 1))):
        base = [_on(1.0, a, 0) for a in (0, 120, 240)]
        platform = [_on(0.6, a + yaw, 1) for a in (60, 180, 300)]
        model = Model()
        hexapod = model.hexapod(base, platform)
        model.fix(*hexapod.ground)
        assert counts(model) == wanted
        assert len(hexapod.ground) == 3


def _on(radius: float, degrees: float, z: float) -> tuple[float, float, float]:
    a = math.radians(degrees)
    return radius * math.cos(a), radius * math.sin(a), z


def test_a_notch_turns_about_its_axis_alone() -> None:
    model = Model()
    notch = model.notch((0, 0, 0), "z", name="notch 1")
    model.body([notch.q, (1, 0, 0)], name="lever")
    model.fix(notch.p)
    assert isinstance(notch, Notch) and repr(notch) == "<Notch 'notch 1' at (0, 0, 0)>"
    assert model.part("notch 1") == notch
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 0)
    tip = analysis.motions[0].displacement[model.node_index(model.point((1, 0, 0)).position)]
    assert np.abs(tip[[0, 2]]).max() < 1e-15 < abs(tip[1])
    model.independent("notch 1", "rotation")
    assert analyse(model).verdict is flexact.Verdict.EXACT


def test_names_of_assemblies_go_on() -> None:
    model = Model()
    for k in range(3):
        model.parallel_guide((0, 0, k), (0.1, 0, k), (0, 0.05, 0))
    names = [f"sheet {k}" for k in range(1, 7)]
    assert [name for name in model.element_names if name.startswith("sheet")] == names
    assert model.part("stage 3").name == "stage 3"
    assert len(set(model.element_names)) == model.element_numbers.size


Call = Callable[[Model], object]
WRONG: list[tuple[str, Call]] = [
    ("missing-vector", lambda m: m.parallel_guide((0, 0, 0), (1, 0, 0), (1, 0, 0), name="a")),
    (
        "out-of-range",
        lambda m: m.parallel_guide((0, 0, 0), (1, 0, 0), (0, 1, 0), name="a", sheets=1),
    ),
    ("bad-number", lambda m: m.cross_hinge([(0, 0, 0)], [(1, 0, 0), (0, 0, 1)], name="a")),
    (
        "missing-vector",
        lambda m: m.cross_hinge([(0, 0, 0), (1, 0, 0)], [(0, 0, 1), (1, 0, 1)], name="a"),
    ),
    ("bad-number", lambda m: m.hexapod(1, 1, name="a")),
    ("bad-number", lambda m: m.hexapod(1, [(0, 0, 1)], name="a")),
    ("bad-number", lambda m: m.hexapod([(0, 0, 0)] * 4, [(0, 0, 1)] * 3, name="a")),
    ("bad-size", lambda m: m.hexapod(-1, 1, 1, name="a")),
    ("no-such-point", lambda m: m.folded_sheet("p", "q", "r", name="a")),
]


@pytest.mark.parametrize(("code", "call"), WRONG)
def test_wrong_assemblies_say_which_call(code: str, call: Call) -> None:
    model = Model()
    with pytest.raises(ModelError) as error:
        call(model)
    assert code_of(error) == code
    assert " 'a': " in error.value.diagnostics[0].message
    assert model.element_numbers.size == 0
