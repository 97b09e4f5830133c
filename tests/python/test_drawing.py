# SPDX-License-Identifier: BSD-3-Clause
"""What is drawn of a model: forms, sizes, symbols, and the surfaces of members."""

import numpy as np
import pytest
from reference_decks import NAMES, text_of

import flexact
from flexact.show.drawing import Drawing, Form, Strip, Support, drawing_of, solid, stations
from flexact.util.rotations import aligned, euler_of, matrix_of, matrix_of_euler, vector_of


def bare(name: str) -> str:
    """The text of a deck without its picture block."""
    return text_of(name).split("VISUALIZATION")[0].rstrip() + "\n"


def drawing_of_deck(name: str) -> Drawing:
    return drawing_of(flexact.read_text(bare(name), name).data)


def strips_of(drawing: Drawing) -> list[Strip]:
    return list(stations(drawing.members, drawing.reference))


@pytest.mark.parametrize(
    ("deck", "forms"),
    [
        ("paper/twelve_trusses", {Form.BAR: 12}),
        ("paper/five_wires", {Form.WIRE: 5, Form.RIGID: 5}),
        ("paper/six_folded_sheets", {Form.SHEET: 12, Form.RIGID: 7}),
        ("paper/six_folded_sheets_released", {Form.SHEET: 12, Form.RIGID: 7}),
        ("paper/six_folded_sheets_body_torsion", {Form.SHEET: 12, Form.BEAM: 1, Form.RIGID: 6}),
        ("flexures/planar_parallel_guide", {Form.SHEET: 2, Form.RIGID: 1}),
    ],
)
def test_forms_follow_from_what_is_held(deck: str, forms: dict[Form, int]) -> None:
    found = drawing_of_deck(deck).members.form
    assert {form: int(np.sum(found == form)) for form in Form if np.any(found == form)} == forms


@pytest.mark.parametrize("deck", ["parallel_guide", "parallel_guide_width_as_y"])
def test_a_sheet_is_wide_in_the_plane_in_which_its_bending_is_held(deck: str) -> None:
    # The two decks state one mechanism, with the width along local z and along local y.
    members = drawing_of_deck(f"flexures/{deck}").members
    sheets = members.form == Form.SHEET
    widest = np.argmax(members.section[sheets], axis=1)
    width = np.stack([f[:, 1 + w] for f, w in zip(members.frame[sheets], widest, strict=True)])
    np.testing.assert_allclose(np.abs(width), [[0.0, 1.0, 0.0]] * 2, atol=1e-15)


def test_all_beams_of_a_sheet_are_equally_wide_whatever_their_number() -> None:
    widths = []
    for beams in (1, 8):
        model = flexact.Model()
        ends = model.node(0, 0, 0), model.node(0.1, 0, 0)
        model.fix(ends[0])
        model.sheet(*ends, width=(0, 0, 1), beams=beams)
        widths.append(set(np.round(drawing_of(model.data).members.section[:, 1], 12)))
    assert widths[0] == widths[1] and len(widths[0]) == 1


def test_supports_say_what_is_fixed() -> None:
    drawing = drawing_of_deck("paper/six_folded_sheets")
    assert [each.kind for each in drawing.supports] == [Support.CLAMP] * 6
    # The sheets hang down from the upper grounds and stand on the lower ones.
    numbers = drawing.data.arrays.node_number[[each.held[0] for each in drawing.supports]]
    down = np.where(numbers < 40, -1.0, 1.0)
    found = [each.frame[2, 0] for each in drawing.supports]
    np.testing.assert_allclose(found, down, atol=1e-12)
    pins = drawing_of_deck("paper/twelve_trusses").supports
    assert [each.kind for each in pins] == [Support.PIN] * 4


def test_a_clamped_member_is_clamped_though_another_turns_at_its_end() -> None:
    # Beam 1 is clamped at node 1; beam 2 ends there with an orientation of its own.
    text = "BEAM 1 1 2 3 4\nBEAM 2 1 5 6 7\nX 3 1. 0. 0.\nX 6 0. 1. 0.\nFIX 1\nFIX 2\nEND\n"
    supports = drawing_of(flexact.read_text(text).data).supports
    assert [each.kind for each in supports] == [Support.CLAMP]
    # Two orientations that are fixed in part make no clamp.
    text = text.replace("FIX 2\n", "FIX 2 2\nFIX 5 3 4\n")
    supports = drawing_of(flexact.read_text(text).data).supports
    assert [each.kind for each in supports] == [Support.PIN] + [Support.TURN] * 3


def test_sizes_along_local_axes_are_kept_where_stiffness_does_not_decide() -> None:
    model = flexact.Model()
    ends = model.node(0, 0, 0), model.node(1, 0, 0)
    model.fix(ends[0])
    model.beam(*ends, y=(0, 1, 0), release=(3,), section=(0.01, 0.05))
    model.beam(*ends, y=(0, 1, 0), release=(3, 4), section=(0.01, 0.05))
    found = drawing_of(model.data).members.section.tolist()
    assert found == [[0.01, 0.05], [0.05, 0.01]]


def test_partly_fixed_nodes_have_one_symbol_a_coordinate() -> None:
    text = "BEAM 1 1 2 3 4\nX 3 1. 0. 0.\nFIX 1 2 3\nFIX 2 3\nEND\n"
    supports = drawing_of(flexact.read_text(text).data).supports
    found = {(int(each.kind), *np.abs(each.frame[:, 0]).tolist()) for each in supports}
    # Component 3 of an orientation is the rotation about y.
    slide, turn = int(Support.SLIDE), int(Support.TURN)
    assert found == {(slide, 0, 1, 0), (slide, 0, 0, 1), (turn, 0, 1, 0)}


def test_declared_freedoms_have_arrows() -> None:
    _, direction, turning = drawing_of_deck("paper/five_folded_sheets").arrows
    assert direction.tolist() == [[0.0, 0.0, 1.0]]
    assert not turning.any()
    _, _, turning = drawing_of_deck("flexures/cross_hinge_sheet_and_wires").arrows
    # The rotation is one, at three positions of the body.
    assert turning.tolist() == [True]


@pytest.mark.parametrize("name", NAMES)
def test_surfaces_are_closed_and_face_outwards(name: str) -> None:
    # The divergence theorem: their volume is that of a prism on the section's polygon.
    drawing = drawing_of_deck(name)
    for strip in strips_of(drawing):
        for part in solid(strip, drawing.members):
            points = part.points.reshape(-1, 3)
            corner = points[part.quads]
            inner = drawing.members.frame[part.member]
            middle = part.points.mean(axis=(1, 2))[:, None, None]
            a, b, c, d = np.moveaxis(corner - middle, 2, 0)
            volume = (np.sum(np.cross(a, b) * c, -1) + np.sum(np.cross(a, c) * d, -1)).sum(1) / 6
            x, y = np.moveaxis(part.offset, 2, 0)
            area = np.sum(x * np.roll(y, -1, 1) - y * np.roll(x, -1, 1), axis=1) / 2
            length = drawing.members.length[part.member]
            whole = ~drawing.members.neck[part.member].any(axis=1)
            np.testing.assert_allclose(volume[whole], (area * length)[whole], rtol=1e-9)
            # Less where something is cut out.
            assert np.all(volume[~whole] < 0.9 * (area * length)[~whole])
            assert inner.shape == (part.member.size, 3, 3)


@pytest.mark.parametrize("name", [name for name in NAMES if "planar" in name])
def test_planar_drawings_are_flat_and_face_the_eye(name: str) -> None:
    drawing = drawing_of_deck(name)
    assert drawing.planar
    for strip in strips_of(drawing):
        for part in solid(strip, drawing.members, planar=True):
            a, b, c, _ = np.moveaxis(part.points.reshape(-1, 3)[part.quads], 2, 0)
            normal = np.cross(b - a, c - a)
            assert np.all(part.points[..., 2] == 0.0)
            assert np.all(normal[..., 2] > 0.0)


def test_elements_that_the_deck_does_not_draw_are_left_out() -> None:
    text = f"{bare('paper/six_folded_sheets')}VISUALIZATION"
    drawing = drawing_of(flexact.read_text(f"{text}\nDONOTDRAW 21 22 23\n").data)
    assert drawing.members.number.tolist() == [*range(1, 13), 24, 25, 26, 27]


def test_sizes_of_the_picture_block_are_used() -> None:
    members = drawing_of(flexact.read_text(text_of("paper/six_folded_sheets")).data).members
    np.testing.assert_array_equal(members.section[:12], [[0.0003, 0.04]] * 12)
    body = members.number == 21
    np.testing.assert_array_equal(members.section[body], [[0.04, 0.04]])
    assert members.round[body].all()


def test_a_rectangle_lies_the_way_the_sheet_is_stiff() -> None:
    block = "VISUALIZATION\nBEAMPROPS 1\nCROSSTYPE RECT\nCROSSDIM 0.04 0.0003\n"
    text = bare("paper/folded_sheet_clamped")
    members = drawing_of(flexact.read_text(f"{text}{block}").data).members
    np.testing.assert_array_equal(members.section[0], [0.0003, 0.04])


def test_rotations_agree_with_each_other() -> None:
    rng = np.random.default_rng(7)
    vectors = rng.normal(size=(200, 3)) * rng.choice([1e-9, 0.1, 1.0], size=(200, 1))
    vectors *= np.minimum(1.0, 3.1 / np.linalg.norm(vectors, axis=1))[:, None]
    vectors[0] = 0.0
    matrices = matrix_of(vectors)
    np.testing.assert_allclose(
        matrices @ np.swapaxes(matrices, 1, 2), np.tile(np.eye(3), (200, 1, 1)), atol=1e-14
    )
    np.testing.assert_allclose(np.linalg.det(matrices), 1.0, rtol=1e-14)
    np.testing.assert_allclose(vector_of(matrices), vectors, atol=1e-13)
    np.testing.assert_allclose(matrix_of_euler(euler_of(matrices)), matrices, atol=1e-14)
    # A quarter turn about z brings x to y.
    quarter = matrix_of(np.array([0.0, 0.0, np.pi / 2]))
    np.testing.assert_allclose(quarter[:, 0], [0.0, 1.0, 0.0], atol=1e-15)


def test_aligned_frames_point_where_they_are_asked_to() -> None:
    rng = np.random.default_rng(8)
    frames = matrix_of(rng.normal(size=(50, 3)))
    towards = rng.normal(size=(50, 3))
    towards /= np.linalg.norm(towards, axis=1)[:, None]
    towards[0] = -frames[0, :, 0]
    made = aligned(frames, towards)
    np.testing.assert_allclose(made[..., 0], towards, atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(made), 1.0, rtol=1e-12)
    # The smallest rotation is about an axis across both directions.
    axis = vector_of(made[1:] @ np.swapaxes(frames[1:], 1, 2))
    np.testing.assert_allclose(np.sum(axis * towards[1:], axis=1), 0.0, atol=1e-12)
