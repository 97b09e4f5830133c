# SPDX-License-Identifier: BSD-3-Clause
"""Parts that are read off models: sheets, wires, bodies, and rows of beams that are one."""

from itertools import pairwise

import numpy as np
import pytest
from reference_decks import text_of

import flexact
from flexact.core.elements import Class
from flexact.model.names import part_name
from flexact.model.parts.condensing import condensed
from flexact.model.parts.parts import Part, PartKind, Parts, natural


def parts_of(deck: str) -> Parts:
    return Parts(flexact.read_text(text_of(deck)).data)


def row_of_beams(
    points: list[tuple[float, float, float]], released: tuple[int, ...] = (2, 5, 6)
) -> flexact.Model:
    model = flexact.Model()
    nodes = [model.node(*point) for point in points]
    model.fix(nodes[0])
    for p, q in pairwise(nodes):
        model.beam(p, q, (0, 0, 1), released)
    return model


@pytest.mark.parametrize(
    ("name", "part"),
    [
        ("sheet 1, 3", "sheet 1"),
        ("left sheet, part 2 of 4", "left sheet"),
        ("left sheet part 2 of 4", "left sheet"),
        ("upper 90, ground to fold", "upper 90, ground to fold"),
        ("sheet 1", "sheet 1"),
        ("element 2 beam 3", "element 2"),
        ("element 2 beam", "element 2 beam"),
        ("cross beam 3", "cross beam 3"),
        ("beam 3", "beam 3"),
        ("", ""),
    ],
)
def test_names_of_beams_of_one_part(name: str, part: str) -> None:
    assert part_name(name) == part


def test_names_are_sorted_as_people_do() -> None:
    assert sorted(["sheet 10", "sheet 2", "arm"], key=natural) == ["arm", "sheet 2", "sheet 10"]


def kinds(parts: Parts) -> dict[str, PartKind]:
    return {part.name: part.kind for part in parts.all}


def test_parts_of_the_six_folded_sheets() -> None:
    found = kinds(parts_of("paper/six_folded_sheets"))
    assert [name for name, kind in found.items() if kind is PartKind.BODY] == ["cylinder"]
    assert sum(kind is PartKind.SHEET for kind in found.values()) == 12


def test_parts_of_wires_bars_and_hinges() -> None:
    assert PartKind.WIRE in kinds(parts_of("paper/five_wires")).values()
    assert set(kinds(parts_of("paper/twelve_trusses")).values()) == {PartKind.BAR}
    assert PartKind.HINGE in kinds(parts_of("flexures/notch_guide")).values()


def test_a_body_carries_all_that_hangs_rigidly_together() -> None:
    parts = parts_of("paper/six_folded_sheets")
    (body,) = parts.bodies
    numbers = parts.data.arrays.node_number
    assert set(numbers[list(body.positions)].tolist()) == {1, 3, 15, 25, 35, 45, 55, 65}
    assert set(numbers[list(body.orientations)].tolist()) == {2, 4}
    # What carries only points is no place for a hinge; the cylinder is.
    names = [parts.data.element_names[i] for i in range(len(parts.data.element_names))]
    assert [names[i] for i in body.elements if i not in parts.links] == ["cylinder"]


def test_bodies_that_share_a_position_alone_are_two() -> None:
    model = flexact.Model()
    centre = model.node(0, 0, 0)
    other = model.pivot(centre)
    model.rigid(centre, model.node(1, 0, 0))
    model.rigid(other, model.node(0, 1, 0))
    assert len(Parts(model.data).bodies) == 2


def test_parts_without_names_are_called_by_what_they_are() -> None:
    model = row_of_beams([(0, 0, 0), (1, 0, 0), (2, 0, 0)])
    (part,) = Parts(model.data).all
    assert part == Part(PartKind.SHEET, "sheet 1", (0, 1), part.ends, 1, is_named=False)


def test_a_part_is_found_by_its_name() -> None:
    parts = parts_of("paper/six_folded_sheets")
    assert parts.named("cylinder").kind is PartKind.BODY
    with pytest.raises(flexact.ModelError, match="no part called"):
        parts.named("spoke")


@pytest.mark.parametrize(
    ("points", "rows"),
    [
        ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [2]),
        ([(0, 0, 0), (1, 0, 0), (2, 1e-12, 0)], [2]),
        ([(0, 0, 0), (1, 0, 0), (2, 0.9, 0)], [2]),
        # A fold.
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0)], []),
        # Ends that meet are no sheet.
        ([(np.cos(t), np.sin(t), 0) for t in np.linspace(0, 5, 20)], []),
    ],
)
def test_what_is_a_row_of_beams(points: list[tuple[float, float, float]], rows: list[int]) -> None:
    assert [len(chain.elements) for chain in row_of_beams(points).data.chains] == rows


def test_a_node_that_is_held_or_joins_more_ends_a_row() -> None:
    points = [(float(i), 0.0, 0.0) for i in range(5)]
    assert [len(c.elements) for c in row_of_beams(points).data.chains] == [4]
    model = row_of_beams(points)
    model.fix(5, "y")  # the middle
    assert [len(c.elements) for c in model.data.chains] == [2, 2]


def test_beams_that_bend_differently_or_have_other_names_make_no_row() -> None:
    model = flexact.Model()
    a, b, c = (model.node(float(i), 0, 0) for i in range(3))
    model.beam(a, b, (0, 0, 1), (2, 5, 6))
    model.beam(b, c, (0, 0, 1), (2, 3, 4, 5, 6))
    assert model.data.chains == ()
    model = flexact.Model()
    a, b, c = (model.node(float(i), 0, 0) for i in range(3))
    model.beam(a, b, (0, 0, 1), (2, 5, 6), name="left")
    model.beam(b, c, (0, 0, 1), (2, 5, 6), name="right")
    assert model.data.chains == ()


def test_a_row_of_reversed_beams_is_one_beam_in_its_sense() -> None:
    model = flexact.Model()
    a, b, c, d = (model.node(float(i), 0, 0) for i in range(4))
    # A waist at the far end: that beam is reversed, so that its p is the end of the row.
    model.beam(a, b, (0, 0, 1), (2, 5, 6))
    for p, q in ((c, b), (d, c)):
        beam = model.beam(p, q, (0, 0, 1))
        model.independent(beam, 2, 5, 6)
        if q is c:
            model.release(beam, 3)
    one = condensed(model.data)
    assert one.data.arrays.deformation_class[:, 0].tolist() == [
        *(Class.FIXED, Class.DEPENDENT, Class.FIXED),
        *(Class.DEPENDENT, Class.DEPENDENT, Class.DEPENDENT),
    ]
    assert one.in_given(0, 4) == (2, 3)
    assert one.in_given(0, 3) == (0, 3)


def test_where_nothing_is_divided_the_model_is_analysed_as_it_is() -> None:
    data = flexact.read_text(text_of("paper/six_folded_sheets")).data
    assert condensed(data).data is data


def test_declaring_what_is_inside_makes_one_beam() -> None:
    model = row_of_beams([(float(i), 0.0, 0.0) for i in range(4)])
    before = flexact.analyse(model)
    assert before.under_constrained == 9 and before.over_constrained == 0
    declared = before.with_internal_declared
    assert declared is not None
    model.declare_internal_motions()
    after = flexact.analyse(model)
    # Six of one end, less the three that a sheet holds.
    assert after.under_constrained == declared.under_constrained == 3
    assert after.with_internal_declared is None
    deck = model.to_deck()
    assert "DYNE 2 2 5 6" in deck
    assert flexact.analyse(flexact.read_text(deck)).under_constrained == 3


def test_motions_inside_a_row_are_the_cubic_of_a_beam() -> None:
    # A cantilever's free end, out of its plane by 1 without turning: z = 3 t^2 - 2 t^3.
    points = [(0.1 * t, 0.0, 0.0) for t in (0.0, 0.2, 0.5, 0.9, 1.0)]
    model = row_of_beams(points)
    model.declare_internal_motions()
    end = model.handle(9, 10)
    model.fix(end, "x", "y", "rx", "ry", "rz")
    (motion,) = flexact.analyse(model).motions
    t = np.array([0.0, 0.2, 0.5, 0.9, 1.0])
    moved = motion.displacement[::2]
    expected = 3 * t**2 - 2 * t**3
    np.testing.assert_allclose(moved[:, 2] / moved[-1, 2], expected, atol=1e-12)
    slope = (6 * t - 6 * t**2) / 0.1
    np.testing.assert_allclose(motion.rotation[1::2, 1] / moved[-1, 2], -slope, atol=1e-10)
