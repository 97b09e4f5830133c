# SPDX-License-Identifier: BSD-3-Clause
"""Divided sheets and wires: what is declared as one is one, whatever is inside.

Counts are those of tests/reference/known_answers.md; what happens between the ends of a straight
sheet has closed forms, and the rank of all its beams together is found by numpy.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from divided import (
    MAKERS,
    OTHER_END,
    SHEET,
    TRUTH,
    WIRE,
    Division,
    counts,
    cross_hinge,
    parallel_guide,
    wire_guide,
)
from pasting import without_notes
from reference_decks import text_of

import flexact
from flexact import Model, analyse, read_text
from flexact.core.elements import Class, NodeKind
from flexact.model.names import part_name
from flexact.show.drawing import Form, drawing_of
from flexact.show.page import page
from flexact.show.spacar_log import spacar_log

pytestmark = pytest.mark.dear(15)

SHAPES = {
    "straight": Division(),
    "wavy at 1e-12": Division(amplitude=1e-12),
    "wavy at 1e-6": Division(amplitude=1e-6),
    "wavy at 1e-3": Division(amplitude=1e-3),
    "at mid-stroke": Division(stroke=0.01),
    "wavy at mid-stroke": Division(stroke=0.01, amplitude=1e-4),
}
CASES = [
    pytest.param(name, shape, id=f"{name}, {shape}")
    for name, shape in itertools.product(MAKERS, SHAPES)
    if not SHAPES[shape].stroke or name not in ("cross hinge", "wire guide")
]


# Verdict, words and margin


@pytest.mark.grid
@pytest.mark.parametrize(("name", "shape"), CASES)
def test_whatever_the_number_of_beams_it_is_one_sheet(name: str, shape: str) -> None:
    make, how = MAKERS[name], SHAPES[shape]
    one = analyse(make(how.undivided))
    assert counts(one) == TRUTH[name]
    assert one.data is one.given
    for beams in range(2, 17):
        for against, turned in ((False, False), (True, True)):
            division = replace(how, beams=beams, seed=beams, against=against, turned=turned)
            several = analyse(make(division))
            mine_told, told = but_own_counts(several), but_own_counts(one)
            if against:
                # No name stands for beams that run against each other, but their numbers do.
                mine_told, told = without_notes(mine_told), without_notes(told)
            assert mine_told == told
            for mine, wanted in zip(several.margins, one.margins, strict=True):
                for size, of_one in ((mine.length, wanted.length), (mine.angle, wanted.angle)):
                    assert (size is None) == (of_one is None)
                    assert of_one is None or size == pytest.approx(of_one, rel=1e-9)
            assert several.certainty is one.certainty
            np.testing.assert_allclose(
                several.singular_values, one.singular_values, rtol=1e-12, atol=1e-14
            )


def but_own_counts(analysis: flexact.Analysis) -> str:
    """The words but for the counts, which are the deck's own, and what is taken as one beam."""
    verdict, _, decision, *rest = analysis.describe(verbose=True).split("\n\n")
    decision = re.sub(r"Taken as one beam.*?(?=D\(c\) has)", "", decision, flags=re.S)
    return "\n\n".join((verdict, decision, *rest))


def components(analysis: flexact.Analysis) -> list[list[tuple[str, str, float]]]:
    """Of each self-stress in the JSON: parts with units and sizes of what they carry.

    An element and its deformation are those of the beam at that end.
    """
    return [
        sorted(
            (part_name(each["name"]), each["unit"], round(abs(each["value"]), 9))
            for each in mode["components"]
        )
        for mode in analysis.to_dict()["self_stresses"]
    ]


@pytest.mark.parametrize("name", ["parallel guide", "cross hinge"])
def test_the_json_has_the_components_of_one_beam(name: str) -> None:
    one = components(analyse(MAKERS[name](Division())))
    assert len(one) == 1 and len(one[0]) >= 5
    for beams, amplitude in ((2, 0.0), (7, 1e-3)):
        several = Division(beams=beams, amplitude=amplitude, against=True)
        assert components(analyse(MAKERS[name](several))) == one


@pytest.mark.parametrize("name", MAKERS)
def test_beams_need_no_names(name: str) -> None:
    how = Division(named=False)
    several = replace(how, beams=5, amplitude=1e-4, against=True, turned=True)
    one, divided = analyse(MAKERS[name](how)), analyse(MAKERS[name](several))
    assert counts(divided) == counts(one) == TRUTH[name]
    assert divided.margin.length == pytest.approx(one.margin.length, rel=1e-9)


def test_without_a_vector_the_default_is_that_of_the_chord() -> None:
    """Beams that are off the line by nothing to speak of have another default axis each."""
    found, told = [], []
    for beams, amplitude in ((1, 0.0), (6, 0.0), (6, 1e-9)):
        rng, model, stage = np.random.default_rng(2), Model(), []
        for k in (0, 1):
            line = np.linspace((0.0, 0.05 * k, 0.0), (0.1, 0.05 * k, 0.0), beams + 1)
            line[1:-1] += amplitude * rng.uniform(-1, 1, (beams - 1, 3))
            points = [model.node(*place) for place in line]
            model.fix(points[0])
            for i, (p, q) in enumerate(itertools.pairwise(points)):
                beam = model.beam(p, q, release=() if i else SHEET, name=f"sheet {k + 1}, {i + 1}")
                if i:
                    model.independent(beam, *SHEET)
            stage.append(points[-1])
        model.rigid(*stage)
        model.independent(stage[0], "y")
        found.append(analyse(model))
        told.append([each.code for each in model.diagnostics])
    assert {counts(each) for each in found} == {(0, 1)}
    assert {each.rows for each in found} == {12}
    assert told == [[], [], ["nearly-equal-components"]]


def test_an_arc_has_its_plane_across_the_chord() -> None:
    """Normals that turn round by 150 degrees: their mean, and not a difference, is the normal."""
    angle = np.radians(np.linspace(-75.0, 75.0, 13))
    line = np.stack([np.sin(angle), np.zeros(13), np.cos(angle)], axis=1) * 0.05
    model = Model()
    points = [model.node(*place) for place in line]
    model.fix(points[0])
    for i, (p, q) in enumerate(itertools.pairwise(points)):
        way = line[i + 1] - line[i]
        beam = model.beam(p, q, np.cross((0, 1, 0), way) * (-1) ** i, () if i else SHEET)
        if i:
            model.independent(beam, *SHEET)
    (vector,) = analyse(model).data.arrays.element_vector.T
    np.testing.assert_allclose(np.abs(vector / np.linalg.norm(vector)), [0, 0, 1], atol=1e-12)


# What is given comes back


@pytest.mark.parametrize("name", MAKERS)
def test_the_model_as_given_is_kept(name: str) -> None:
    model = MAKERS[name](Division(beams=4, amplitude=1e-4, against=True, turned=True))
    analysis = analyse(model)
    for field, value in analysis.given.arrays._asdict().items():
        np.testing.assert_array_equal(value, getattr(model.data.arrays, field), err_msg=field)
    assert analysis.model.to_deck() == model.to_deck()
    again = flexact.read_text(model.to_deck())
    assert again.to_deck().splitlines()[1:] == model.to_deck().splitlines()[1:]
    read = analyse(again)
    assert counts(read) == TRUTH[name]
    assert read.margin.length == pytest.approx(analysis.margin.length, rel=1e-12)
    nodes = model.data.arrays.node_number.size
    for motion in [freedom.motion for freedom in analysis.freedoms]:
        assert motion is not None
        assert motion.displacement.shape == motion.rotation.shape == (nodes, 3)
    for stress in analysis.self_stresses:
        assert stress.moments.shape == (model.data.arrays.element_number.size, 6)


# Between the ends


def inside(analysis: flexact.Analysis) -> list[tuple[np.ndarray, list[int], list[int]]]:
    """Of each row where its inner nodes are, 0 to 1, and they: positions, orientations."""
    return [
        (inner.share, inner.positions.tolist(), inner.orientations.tolist())
        for inner in analysis.condensed.inner
    ]


@pytest.mark.parametrize("beams", [2, 3, 8])
def test_a_guided_sheet_moves_as_a_cubic(beams: int) -> None:
    """Ends that stay parallel: u (3 t^2 - 2 t^3), slope 6 u (t - t^2) / L."""
    how = Division(beams=beams, against=True)
    declared, left = analyse(parallel_guide(how)), analyse(parallel_guide(how, guided=False))
    assert counts(left) == (1, 1)
    for motion in (declared.freedoms[0].motion, left.motions[0]):
        assert motion is not None
        u = motion.displacement[:, 2].flat[np.abs(motion.displacement[:, 2]).argmax()]
        for t, positions, orientations in inside(declared):
            np.testing.assert_allclose(t, np.arange(1, beams) / beams, atol=1e-15)
            zero = np.zeros_like(t)
            wanted = np.stack([zero, zero, u * (3 * t**2 - 2 * t**3)], axis=1)
            np.testing.assert_allclose(motion.displacement[positions], wanted, atol=1e-14)
            wanted = np.stack([zero, -6 * u * (t - t**2) / 0.1, zero], axis=1)
            np.testing.assert_allclose(motion.rotation[orientations], wanted, atol=1e-13)


@pytest.mark.parametrize("beams", [2, 5, 16])
def test_a_sheet_of_a_cross_hinge_bends_to_an_arc(beams: int) -> None:
    """The body turns by a about the middle: a L t^2 / 2 across the sheet, slope a t."""
    analysis = analyse(cross_hinge(Division(beams=beams, turned=True)))
    (freedom,) = analysis.freedoms
    assert freedom.motion is not None
    for side, (t, positions, orientations) in zip((-1.0, 1.0), inside(analysis), strict=True):
        # Turning about y by 1 rad moves what is along the sheet across it.
        across = np.cross((0.0, 1.0, 0.0), (-0.6 * side, 0.0, 0.8))
        wanted = (0.1 * t**2 / 2)[:, None] * across
        np.testing.assert_allclose(freedom.motion.displacement[positions], wanted, atol=1e-14)
        wanted = np.outer(t, (0.0, 1.0, 0.0))
        np.testing.assert_allclose(freedom.motion.rotation[orientations], wanted, atol=1e-13)


@pytest.mark.parametrize("make", [parallel_guide, wire_guide])
def test_what_moves_as_a_rigid_body_does_so_inside(make: Callable[[Division], Model]) -> None:
    analysis = analyse(make(Division(beams=7, amplitude=1e-3, stroke=0.01, against=True)))
    place = analysis.given.arrays.node_value[:3].T
    turning = analysis.given.arrays.node_kind > 2
    shift, turn = np.array([0.3, -0.2, 0.5]), np.array([0.7, 0.4, -0.6])
    moved = np.where(turning[:, None], 0.0, shift + np.cross(turn, place))
    turned = np.where(turning[:, None], turn, 0.0)
    nodes = analysis.condensed.nodes
    found = analysis.condensed.motion(moved[nodes], turned[nodes])
    np.testing.assert_allclose(found[0], moved, atol=1e-14)
    np.testing.assert_allclose(found[1], turned, atol=1e-14)


@pytest.mark.parametrize(
    ("make", "course"),
    [(parallel_guide, lambda t: np.ones_like(t)), (cross_hinge, lambda t: 1 - 2 * t)],
    ids=["constant", "zero at the crossing"],
)
@pytest.mark.parametrize("amplitude", [0.0, 1e-12])
def test_moments_are_linear_along_a_sheet(
    make: Callable[[Division], Model],
    course: Callable[[np.ndarray], np.ndarray],
    amplitude: float,
) -> None:
    """By balance of the body (tests/reference/known_answers.md), whatever the local axes."""
    how = Division(beams=6, amplitude=amplitude, against=True, turned=True, seed=4)
    analysis = analyse(make(how))
    (stress,) = analysis.self_stresses
    sheets = [beam for chain in analysis.given.chains for beam in chain.elements]
    assert np.abs(stress.moments[sheets][:, 4:]).max() <= 1e-9 * np.abs(stress.moments).max()
    largest = []
    for chain in analysis.given.chains:
        beams, against = list(chain.elements), np.array(chain.reversed)
        # In the sense of the row, and about one axis.
        both = np.where(against[:, None], stress.moments[beams, 3:1:-1], stress.moments[beams, 2:4])
        axes = analysis.given.frames.frame[beams, :, 1]
        sense = np.where(against, -1.0, 1.0) * np.sign(axes @ axes[0])
        t = np.arange(7) / 6
        wanted = course(np.stack([t[:-1], t[1:]], axis=1))
        largest.append((both * sense[:, None])[0, 0])
        np.testing.assert_allclose(both * sense[:, None], largest[-1] * wanted, atol=1e-9)
    assert len(largest) == 2
    assert np.abs(largest[0]) == pytest.approx(np.abs(largest[1]), rel=1e-9) and largest[0]


def test_forces_are_the_same_along_a_wire() -> None:
    """Six wires in a plane at one point: four too many, and no bending."""
    model, angles = Model(), np.radians([0, 50, 110, 170, 240, 310])
    hub = model.node(0, 0, 0)
    for k, (x, y) in enumerate(zip(np.cos(angles), np.sin(angles), strict=True)):
        line = np.linspace((0.1 * x, 0.1 * y, 0.0), (0.0, 0.0, 0.0), 4)
        points = [*(model.node(*place) for place in line[:-1]), hub]
        model.fix(points[0])
        for i, (p, q) in enumerate(itertools.pairwise(points)):
            beam = model.beam(q, p, (0, 0, 1), () if i else WIRE, name=f"wire {k + 1}, {i + 1}")
            if i:
                model.independent(beam, *WIRE)
    analysis = analyse(model)
    assert counts(analysis) == (4, 4)
    for stress in analysis.self_stresses:
        force = stress.forces[:, 0].reshape(6, 3)
        np.testing.assert_allclose(force, force[:, :1] * np.ones(3), atol=1e-15)
        assert abs(force[:, 0] @ np.cos(angles)) + abs(force[:, 0] @ np.sin(angles)) < 1e-14


@pytest.mark.parametrize("shape", ["straight", "wavy at 1e-3", "at mid-stroke"])
def test_a_divided_sheet_is_drawn_as_wide_all_along(shape: str) -> None:
    how = SHAPES[shape]
    one, several = (
        drawing_of(parallel_guide(each).data) for each in (how, replace(how, beams=16, seed=5))
    )
    sections = several.members.section[several.members.form == Form.SHEET]
    np.testing.assert_allclose(sections, np.tile(sections[0], (32, 1)), rtol=1e-12)
    # What is off the line may make the drawing larger.
    np.testing.assert_allclose(sections[0], one.members.section[0], rtol=0.1)


@pytest.mark.parametrize("make", [parallel_guide, cross_hinge])
def test_a_wavy_sheet_holds_what_one_beam_holds(make: Callable[[Division], Model]) -> None:
    (one,) = analyse(make(Division())).self_stresses
    (several,) = analyse(make(Division(beams=5, amplitude=1e-3, against=True))).self_stresses
    for name in ("sheet 1", "sheet 2"):
        mine, wanted = several.of(name), one.of(name)
        np.testing.assert_allclose(mine.normal, wanted.normal, atol=1e-14)
        np.testing.assert_allclose(mine.direction, wanted.direction, atol=1e-14)
        np.testing.assert_allclose(mine.in_plane_moments, wanted.in_plane_moments, rtol=1e-9)


# What is no sheet


@pytest.mark.parametrize("beams", [2, 5])
def test_undeclared_rows_keep_their_motions(beams: int) -> None:
    """Three motions at each inner node: out of the plane, and two rotations."""
    for make in (parallel_guide, cross_hinge):
        analysis = analyse(make(Division(beams=beams, declared=False)))
        assert counts(analysis) == (6 * (beams - 1), 1)
        assert analysis.data is analysis.given
        assert [len(chain.surplus) for chain in analysis.given.chains] == [beams - 1] * 2


@pytest.mark.parametrize(
    ("name", "one"),
    [
        ("parallel_guide", "parallel_guide_undeclared"),
        ("cross_hinge", "cross_hinge_undeclared"),
        ("sheet_clamped_both_ends", "sheet_clamped_both_ends"),
    ],
)
def test_one_step_declares_an_undeclared_deck(name: str, one: str) -> None:
    model = flexact.read_text(text_of(f"flexures/{name}_four_beams_undeclared"))
    motions = analyse(model).under_constrained
    for chain in model.data.chains:
        for element, deformations in chain.surplus:
            number = int(model.data.arrays.element_number[element])
            model.independent(number, *deformations)
    wanted = analyse(flexact.read_text(text_of(f"flexures/{one}")))
    assert counts(analyse(model)) == counts(wanted)
    assert motions - wanted.under_constrained == 9 * len(model.data.chains)


def row_of_any_releases(rng: np.random.Generator, beams: int) -> Model:
    """A straight row between two clamps, each of some deformations released in one beam."""
    model = Model()
    points = [model.node(0.1 * i / beams, 0, 0) for i in range(beams + 1)]
    model.fix(points[0])
    model.fix(points[-1])
    loose = [d for d in range(1, 7) if rng.random() < 0.6]
    where = {d: int(rng.integers(beams)) for d in loose}
    for i, (p, q) in enumerate(itertools.pairwise(points)):
        against = rng.random() < 0.4
        own = (lambda d: OTHER_END.get(d, d)) if against else (lambda d: d)
        ends = (q, p) if against else (p, q)
        beam = model.beam(*ends, (0, 1, 0), [own(d) for d in loose if where[d] == i])
        rest = [own(d) for d in loose if where[d] != i]
        if rest:
            model.independent(beam, *rest)
    return model


def test_a_row_has_the_counts_of_all_its_beams() -> None:
    """Whether or not it is taken for one beam: the rank of the whole D(c), by numpy."""
    rng, condensed = np.random.default_rng(8), 0
    for beams in (2, 3, 4):
        for _ in range(60):
            model = row_of_any_releases(rng, beams)
            analysis = analyse(model)
            jacobian = flexact.jacobian(model).toarray()
            classes = model.data.arrays
            rows = classes.deformation_class.T[classes.deformation_class.T != Class.NONE]
            columns = classes.coordinate_class.T[classes.coordinate_class.T != Class.NONE]
            whole = jacobian[rows != Class.DEPENDENT][:, columns == Class.DEPENDENT]
            rank = np.linalg.matrix_rank(whole, tol=1e-9)
            assert counts(analysis) == (whole.shape[1] - rank, whole.shape[0] - rank)
            condensed += analysis.data is not analysis.given
    assert 20 < condensed < 160


def test_two_hinges_at_one_place_are_no_beam() -> None:
    """Between them a node turns idly, and the row is stiff across."""
    model = Model()
    p, middle, q = (model.node(x, 0, 0) for x in (0.0, 0.05, 0.1))
    model.fix(p)
    for ends, released, declared in (((p, middle), 6, 5), ((middle, q), 5, 6)):
        beam = model.beam(*ends, (0, 1, 0), (released,))
        model.independent(beam, declared)
    analysis = analyse(model)
    assert analysis.data is analysis.given
    assert counts(analysis) == (2, 0)


def test_sheets_in_different_planes_are_two() -> None:
    model = Model()
    points = [model.node(x, 0, 0) for x in (0.0, 0.05, 0.1)]
    model.fix(points[0])
    model.beam(points[0], points[1], (0, 1, 0), SHEET)
    model.beam(points[1], points[2], (0, 0, 1), SHEET)
    assert model.data.chains == ()
    # As wires they are one: what they hold does not depend on the vectors.
    for element in (1, 2):
        model.release(element, 3, 4)
    (chain,) = model.data.chains
    assert chain.elements == (0, 1)


# Counts are the deck's own


def mechanism(seed: int) -> Model:
    """Sheets and wires, some of them divided, from the ground to a stage; planar or spatial."""
    dice = np.random.default_rng(seed)
    planar = bool(seed % 2)
    model = Model(planar=planar)
    ends = []
    for k in range(int(dice.integers(1, 5))):
        place = [0.02 * k, 0.03 * (k % 2), *([] if planar else [0.01 * k * k])]
        end = [*place[:-1], place[-1] + 0.1]
        across = {} if planar else {"width": (0, 1, 0)}
        add = model.wire if dice.integers(2) and not planar else model.sheet
        more = across if add == model.sheet else {}
        beams = int(dice.integers(1, 6))
        add(place, end, beams=beams, name=f"part {k + 1}", **more)  # type: ignore[operator]
        model.fix(place)
        ends.append(end)
    if len(ends) > 1:
        model.body(ends, name="stage")
    model.independent(ends[0], "x")
    return model


@pytest.mark.parametrize("seed", range(12))
def test_counts_are_the_decks_own(seed: int) -> None:
    """As SPACAR counts, which knows no rows of beams: but for what it has of Euler parameters."""
    deck = mechanism(seed).to_deck()
    analysis = analyse(read_text(deck, "deck.dat"))
    found = dict(
        re.findall(r"\b(NE\w*|NX\w*) *= *(\d+)", spacar_log(analysis).partition("WITHOUT")[0])
    )
    n = {name: int(count) for name, count in found.items()}
    (ndof,) = map(int, re.findall(r"NDOF= *(\d+)", spacar_log(analysis)))
    euler = int(np.count_nonzero(analysis.given.arrays.node_kind == NodeKind.ORIENTATION))
    own, declared = analysis.counts, analysis.degrees_of_freedom
    assert own.coordinates == (
        n["NXM"] - euler,
        n["NXO"],
        n["NXC"] - n["NXO"] - euler,
        n["NXM"] - n["NXC"],
    )
    assert own.deformations == (
        n["NEC"] - euler,
        n["NEO"] - euler,
        n["NEC"] - n["NEM"],
        n["NEM"] - n["NEO"],
    )
    assert declared == ndof
    # The same in every form, beside the size of what was decomposed.
    record = analysis.to_dict()
    assert record["counts"]["coordinates"] == own.coordinates._asdict()
    assert record["counts"]["deformations"] == own.deformations._asdict()
    assert record["degrees_of_freedom"] == declared
    assert (record["rows"], record["columns"]) == (analysis.rows, analysis.columns)
    words = analysis.describe(verbose=True)
    for name, part in own._asdict().items():
        assert [int(word) for word in re.findall(rf"{name} +(.*)", words)[0].split()] == [*part]
    head, table = (
        " ".join(re.sub("<[^>]*>", " ", part).split()) for part in pieces(page(analysis))
    )
    assert f"{declared} degree" in words and f"{declared} degree" in head
    assert " ".join(map(str, own.coordinates)) in table
    rows = [each for each in analysis.given.chains if len(each.elements) > 1]
    assert len(record["taken_as_one"]) == len(rows)
    assert ("Taken as one beam" in words) == ("Taken as one beam" in table) == bool(rows)
    assert bool(rows) == (analysis.rows < own.deformations.fixed + own.deformations.independent)


def pieces(text: str) -> tuple[str, str]:
    """Head and decision of a page, as words."""
    head, *_ = re.findall(r"<header.*?</header>", text, re.S)
    table, *_ = re.findall(r'<section id="decision".*?</section>', text, re.S)
    return words_in(head), words_in(table)


def words_in(text: str) -> str:
    return " ".join(re.sub("<[^>]*>", " ", text).split())


def test_a_chain_of_which_all_is_declared_has_the_freedoms_of_all_its_beams() -> None:
    """27 planar beams, 28 points: 84 coordinates and 81 deformations, each of them declared."""
    deck = "".join(
        f"PLBEAM {k} {2 * k - 1} {2 * k} {2 * k + 1} {2 * k + 2}\n" for k in range(1, 28)
    )
    deck += "".join(f"X {2 * k + 1} {0.01 * k} {0.004 * (k // 9)}\n" for k in range(28))
    deck += "FIX 1\nFIX 2\n" + "".join(f"DYNE {k}\n" for k in range(1, 28))
    analysis = analyse(read_text(deck, "deck.dat"))
    assert analysis.counts.coordinates.total == 84
    assert analysis.counts.deformations == (81, 0, 0, 81)
    assert analysis.degrees_of_freedom == 81
