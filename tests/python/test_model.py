# SPDX-License-Identifier: BSD-3-Clause
"""The builder: what its methods make, and the codes of what they refuse."""

import dataclasses
import sys

import numpy as np
import pytest
from wrong_use import code_of

import flexact
from flexact import Model, ModelError


def test_truss_model_has_no_rotations() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 2, 3)
    model.truss(a, b, name="bar")
    assert model.node_numbers.tolist() == [a.position, b.position]
    assert model.node_kinds.tolist() == [2, 2]
    assert model.positions.tolist() == [[0, 0, 0], [1, 2, 3]]
    assert model.element_nodes.tolist() == [[0, -1, 1, -1]]
    assert list(model.element_names) == ["bar"]


def test_planar_model_has_two_coordinates_and_an_angle() -> None:
    model = Model(planar=True)
    a, b = model.node(0, 0), model.node(1, 0)
    model.beam(a, b)
    assert model.element_keywords == ("PLBEAM",)
    assert model.node_kinds.tolist() == [1, 3, 1, 3]
    assert model.coordinate_classes.tolist() == [[2, 2, 0], [0, 0, 2]] * 2
    with pytest.raises(ModelError) as error:
        model.node(0, 0, 1)
    assert code_of(error) == "no-coordinate"


def test_wire_holds_its_elongation_alone() -> None:
    model = Model()
    model.wire(model.node(0, 0, 0), model.node(1, 0, 0))
    assert model.deformation_classes.tolist() == [[1, 2, 2, 2, 2, 2]]


def test_sheet_follows_the_paper() -> None:
    # Section 4.2: local z in the plane of the sheet; held are e1, e3, e4.
    model = Model()
    sheet = model.sheet(model.node(0, 0, 0), model.node(3, 0, 0), width=(5, 0, 2), beams=3)
    # What the first beam releases is declared in the others, so that D(c) is that of one beam.
    inner = [[1, 3, 1, 1, 3, 3]] * 2
    assert model.deformation_classes.tolist() == [[1, 2, 1, 1, 2, 2], *inner]
    ex, y = np.array([1, 0, 0]), model.element_vectors
    assert np.allclose(np.cross(ex, y), [[0, 0, 1]] * 3), "ez = ex x ey along the width"
    assert len(sheet.elements) == 3 and len(sheet.nodes) == 4
    inner = [model.positions[model.node_index(node.position), 0] for node in sheet.nodes]
    assert inner == pytest.approx([0, 1, 2, 3], abs=1e-15)


def test_planar_sheet_bends() -> None:
    model = Model(planar=True)
    sheet = model.sheet(model.node(0, 0), model.node(1, 0))
    assert model.element_keywords == ("PLBEAM",)
    assert model.deformation_classes[0, :3].tolist() == [1, 2, 2]
    with pytest.raises(ModelError) as error:
        model.sheet(*sheet.nodes, width=(0, 1, 0))
    assert code_of(error) == "surplus-vector"


def test_rigid_is_an_rbeam_where_nobody_needs_the_far_orientation() -> None:
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(1, 1, 0)
    model.rigid(a, b)
    assert model.element_keywords == ("RBEAM",)
    assert model.deformation_classes.tolist() == [[1, 1, 1, 0, 0, 0]]
    model.truss(b, c)
    assert model.element_keywords == ("RBEAM", "TRUSS")
    model.wire(b, model.node(2, 0, 0))
    assert model.element_keywords == ("BEAM", "TRUSS", "BEAM")
    assert model.deformation_classes[0].tolist() == [1] * 6


def test_rigid_chain_needs_orientations_in_between() -> None:
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(2, 0, 0)
    model.rigid(a, b)
    model.rigid(b, c)
    assert model.element_keywords == ("BEAM", "RBEAM")


def test_rigid_is_a_beam_where_its_deformation_or_far_rotation_is_named() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    body = model.rigid(a, b)
    model.fix(b, "x", "y", "z")
    assert model.element_keywords == ("RBEAM",)
    model.release(body, 2)
    assert model.element_keywords == ("BEAM",)
    assert model.deformation_classes[0].tolist() == [1, 2, 1, 1, 1, 1]
    other = Model()
    a, b = other.node(0, 0, 0), other.node(1, 0, 0)
    other.rigid(a, b)
    other.independent(b, "rx")
    assert other.element_keywords == ("BEAM",)


@pytest.mark.parametrize("end", [0, 1, 2])
@pytest.mark.parametrize("planar", [False, True])
def test_a_body_is_clamped_at_any_of_its_points(end: int, planar: bool) -> None:
    model = Model(planar=planar)
    places = [(0.1 * k, 0.2 * k**2) for k in range(3)]
    body = model.body(places, name="arm")
    model.truss(places[0], (0, 1))
    model.fix((0, 1))
    model.fix(body.nodes[end])
    # The bar runs between two points that are held, and so is stressed without a load.
    result = flexact.analyse(model)
    assert (result.under_constrained, result.over_constrained) == (0, 1)


def test_rigid_links_of_either_kind_give_one_answer() -> None:
    # A body of three points on six bars, with and without its orientations in use.
    def platform(use: bool) -> flexact.Analysis:
        model = Model()
        top = [model.node(np.cos(t), np.sin(t), 1) for t in (0, 2.1, 4.2)]
        base = [model.node(2 * np.cos(t), 2 * np.sin(t), 0) for t in (1, 3.1, 5.2)]
        for k in (1, 2):
            model.rigid(top[0], top[k])
        for k in range(3):
            model.truss(base[k], top[k])
            model.truss(base[k], top[k - 2])
            model.fix(base[k])
            if use:
                model.wire(top[k], model.node(0, 0, 5 + k))
        return flexact.analyse(model)

    short, full = platform(False), platform(True)
    assert short.verdict is flexact.Verdict.EXACT
    assert full.over_constrained == 0
    assert full.under_constrained == 3 * 6 - 3


def test_hinge_releases_the_rotation_about_its_axis() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    beyond = model.hinge(a, axis=(0, 0, 2))
    assert beyond.position == a.position and beyond.orientation != a.orientation
    model.rigid(beyond, b)
    model.fix(a)
    assert model.element_keywords == ("HINGE", "RBEAM")
    assert model.deformation_classes[0].tolist() == [2, 1, 1, 0, 0, 0]
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 0)
    motion = analysis.motions[0].displacement[model.node_index(b.position)]
    assert np.abs(motion[[0, 2]]).max() < 1e-15 < abs(motion[1])


def test_planar_hinge() -> None:
    model = Model(planar=True)
    a = model.node(0, 0)
    b = model.hinge(a)
    model.rigid(b, model.node(1, 0))
    model.fix(a)
    assert model.element_keywords == ("PLHINGE", "PLRBEAM")
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 0)


def test_fix_and_independent_by_name_and_number() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    wire = model.wire(a, b)
    model.fix(a)
    model.fix(a, "x")
    model.fix(b.orientation)
    model.independent(b, "z")
    model.independent(wire, 5)
    model.independent(wire.number, 6)
    assert model.coordinate_classes.tolist() == [[1, 1, 1], [1, 1, 1], [2, 2, 3], [1, 1, 1]]
    assert model.deformation_classes[0].tolist() == [1, 2, 2, 2, 3, 3]
    assert flexact.analyse(model).degrees_of_freedom == 3


def test_a_divided_sheet_is_released_in_the_beam_at_that_end() -> None:
    model = Model()
    sheet = model.sheet(model.node(0, 0, 0), model.node(1, 0, 0), (0, 0, 1), beams=2)
    model.release(sheet, 3)
    assert model.deformation_classes.tolist() == [[1, 2, 2, 1, 2, 2], [1, 3, 1, 1, 3, 3]]
    model.release(sheet, 4)
    assert model.deformation_classes.tolist() == [[1, 2, 2, 1, 2, 2], [1, 3, 1, 2, 3, 3]]


def test_old_arrays_stay_as_they_were() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.truss(a, b)
    before = model.coordinate_classes
    analysis = flexact.analyse(model)
    assert model.coordinate_classes.base is before.base, "made once"
    model.fix(a)
    assert before.tolist() == [[2, 2, 2]] * 2
    assert model.coordinate_classes.tolist() == [[1, 1, 1], [2, 2, 2]]
    assert analysis.model.coordinate_classes.tolist() == before.tolist()
    assert len(analysis.motions[0].displacement) == 2
    with pytest.raises(ValueError, match="read-only"):
        before[0, 0] = 1


def test_handles_are_frozen() -> None:
    node = Model().node(0, 0, 0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        node.position = 5  # type: ignore[misc]


def test_deck_model_takes_the_same_methods() -> None:
    deck = "BEAM 4 1 2 5 6 0 1 0 % first beam\nX 5 1 0 0\nFIX 1\nFIX 2\nRLSE 4 5\n"
    model = flexact.read_text(deck)
    end = model.handle(5, 6)
    tip = model.node(2, 0, 0)
    assert tip.position == 7
    model.wire(end, tip, name="second")
    model.truss(1, tip)
    model.fix(5, "z")
    model.release(4, 6)
    assert model.element_numbers.tolist() == [4, 5, 6]
    assert list(model.element_names) == ["first beam", "second", ""]
    assert model.element_keywords == ("BEAM", "BEAM", "TRUSS")
    assert model.deformation_classes[0].tolist() == [1, 1, 1, 1, 2, 2]
    assert model.coordinate_classes[2].tolist() == [2, 2, 1]
    assert model.element_vectors[0].tolist() == [0, 1, 0]


def test_names_fit_into_a_deck() -> None:
    model = Model(name="two\nlines")
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    for name in ("% 50 # of\tit", "a\nTRUSS 9 1 3", "  Blattfeder \u00bc\u2033 ", "#%"):
        model.truss(a, b, name=name)
    names = ["50 # of it", "a TRUSS 9 1 3", "Blattfeder \u00bc\u2033", ""]
    assert list(model.element_names) == names
    again = flexact.read_text(model.to_deck())
    assert list(again.element_names) == names


def steps_of_a_lattice(bars: int) -> int:
    """Calls of functions, in Python and in C, that making so many bars takes."""
    steps = 0

    def count(_: object, event: str, __: object) -> None:
        nonlocal steps
        steps += event in ("call", "c_call")

    model = Model()
    nodes = [model.node(i % 100, i // 100 % 100, i // 10000) for i in range(bars // 3)]
    sys.setprofile(count)
    try:
        for i in range(bars):
            model.truss(nodes[i % len(nodes)], nodes[(i + 1 + i // len(nodes)) % len(nodes)])
        arrays = model.element_nodes
    finally:
        sys.setprofile(None)
    assert arrays.shape == (bars, 4)
    return steps


def test_the_work_for_a_lattice_grows_with_its_bars() -> None:
    few, many = steps_of_a_lattice(3_000), steps_of_a_lattice(30_000)
    assert many <= 10.5 * few


def test_a_lattice_of_a_hundred_thousand_bars_is_no_task() -> None:
    """With copies of all arrays for each bar it would take hours."""
    model = Model()
    nodes = [model.node(i % 100, i // 100 % 100, i // 10000) for i in range(30_000)]
    for i in range(100_000):
        model.truss(nodes[i % 30_000], nodes[(i + 1 + i // 30_000) % 30_000])
    assert model.element_nodes.shape == (100_000, 4)


def test_indices_are_found_by_number() -> None:
    model = flexact.read_text("BEAM 4 9 2 5 6\nTRUSS 7 5 1\nX 5 1 0 0\nX 1 1 1 0\n")
    assert [model.node_index(number) for number in (1, 2, 5, 6, 9)] == [0, 1, 2, 3, 4]
    assert (model.element_index(4), model.element_index(7)) == (0, 1)
    with pytest.raises(ModelError) as error:
        model.node_index(3)
    assert code_of(error) == "no-such-node"
    with pytest.raises(ModelError) as error:
        model.element_index(5)
    assert code_of(error) == "no-such-element"


def test_an_orientation_that_no_element_uses_has_no_index() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.truss(a, b)
    assert model.node_index(b.position) == 1
    with pytest.raises(ModelError) as error:
        model.node_index(b.orientation)
    assert code_of(error) == "no-such-node"


def test_driven_hinge_is_a_degree_of_freedom() -> None:
    """A crank on the ground turns when nothing is declared, and is exact when its hinge is."""
    for driven, motions in ((False, 1), (True, 0)):
        model = Model()
        ground, end = model.node(0, 0, 0), model.node(1, 0, 0)
        model.fix(ground)
        model.rigid(model.hinge(ground, axis=(0, 0, 1), independent=driven), end)
        analysis = flexact.analyse(model)
        assert (analysis.under_constrained, analysis.over_constrained) == (motions, 0)
        assert analysis.degrees_of_freedom == int(driven)
