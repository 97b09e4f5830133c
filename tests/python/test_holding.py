# SPDX-License-Identifier: BSD-3-Clause
"""What each flexure of an exactly constrained mechanism holds, and how well."""

import io

import numpy as np
import pytest
from reference_decks import text_of

import flexact
from flexact.advice.constraint_quality import Hold, holds_of
from flexact.advice.spaces.screws import FamilyKind
from flexact.show.drawing import drawing_of
from flexact.show.page.drawing import frames_of
from flexact.show.page.viewer import holds_data
from flexact.show.spaces import shape_of_hold


def holds_in(name: str) -> dict[str, Hold]:
    return {each.name: each for each in holds_of(flexact.analyse(flexact.read_text(text_of(name))))}


def hexapod(feet: np.ndarray, heads: np.ndarray) -> flexact.Analysis:
    """Six wires from the ground to a body."""
    model = flexact.Model(name="six wires")
    for k, (foot, head) in enumerate(zip(feet.tolist(), heads.tolist(), strict=True)):
        model.wire(foot, head, name=f"wire {k}")
        model.fix(foot)
    model.body(heads.tolist(), name="stage")
    return flexact.analyse(model)


@pytest.mark.parametrize("seed", range(3))
def test_wires_hold_along_their_lines_by_their_angle_to_the_others(seed: int) -> None:
    """Against plain screws: of each unit wrench the part that five others cannot make."""
    random = np.random.default_rng(seed)
    feet, heads = random.uniform(-0.1, 0.1, (2, 6, 3))
    analysis = hexapod(feet - (0, 0, 0.2), heads)
    holds = holds_of(analysis)
    assert [each.name for each in holds] == [f"wire {k}" for k in range(6)]
    way = heads - (feet - (0, 0, 0.2))
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    nodes = analysis.given.arrays
    bodied = [n for n in analysis.parts.bodies[0].positions]
    arm = heads - nodes.node_value[:3, bodied].T.mean(axis=0)
    rows = np.hstack((way, np.cross(arm, way) / analysis.characteristic_length))
    for k, hold in enumerate(holds):
        others = np.delete(rows, k, axis=0)
        rest = rows[k] - others.T @ np.linalg.lstsq(others.T, rows[k], rcond=None)[0]
        expected = np.linalg.norm(rest) / np.linalg.norm(rows[k])
        assert hold.sine == pytest.approx(expected, rel=1e-6)
        (family,) = hold.space.families
        assert family.kind is FamilyKind.LINE
        assert abs(family.direction @ way[k]) == pytest.approx(1.0, abs=1e-9)
        off = np.cross(family.point - heads[k], way[k])
        np.testing.assert_allclose(off, 0.0, atol=1e-9)


def test_a_wire_that_nearly_repeats_others_holds_badly() -> None:
    """Three wires in a plane that nearly meet in a point hold rotation about it badly."""
    wide, narrow = (
        holds_of(
            hexapod(
                np.array(
                    ((0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0.2, 0.0, 0.1), (0.2, gap, 0.1),
                     (0, 0.3, 0.1))
                ),
                np.array(
                    ((0, 0, 0.1), (0.1, 0, 0.1), (0, 0.1, 0.1), (0.1, 0.0, 0.1), (0.1, gap, 0.1),
                     (0, 0.1, 0.1))
                ),
            )
        )
        for gap in (0.1, 0.002)
    )  # fmt: skip
    assert narrow[3].sine < 0.05 < 0.3 < wide[3].sine


def test_sheets_notches_and_folds_hold_what_they_are_known_to() -> None:
    sheet = next(
        each for each in holds_in("flexures/cross_hinge_sheet_and_wires").values()
        if each.space.dimension == 3
    )  # fmt: skip
    plane = sheet.space.families[0]
    assert plane.kind is FamilyKind.PLANE
    drawing = drawing_of(flexact.read_text(text_of("flexures/cross_hinge_sheet_and_wires")).data)
    made = shape_of_hold(sheet, drawing.size, planar=False)
    for line in (*made.lines, *made.faces):
        np.testing.assert_allclose((line - plane.point) @ plane.normal, 0.0, atol=1e-9)
    notches = [e for n, e in holds_in("flexures/notch_guide_exact").items() if "notch" in n]
    assert [each.space.dimension for each in notches] == [5, 5]
    for hold in holds_in("paper/five_folded_sheets").values():
        (family,) = hold.space.families
        assert family.kind is FamilyKind.LINE
        # The fold: where the two sheets of it meet.
        assert len(hold.parts) == 2
        (fold,) = set(hold.parts[0].ends) & set(hold.parts[1].ends)
        data = flexact.read_text(text_of("paper/five_folded_sheets")).data
        off = np.cross(data.arrays.node_value[:3, fold] - family.point, family.direction)
        np.testing.assert_allclose(off, 0.0, atol=1e-9)


@pytest.mark.parametrize("name", ["flexures/parallel_guide", "paper/twelve_trusses"])
def test_what_is_not_exact_has_none(name: str) -> None:
    analysis = flexact.analyse(flexact.read_text(text_of(name)))
    assert holds_of(analysis) == ()
    (frame,) = frames_of(drawing_of(analysis.given))
    assert holds_data(analysis, frame) == []
    pytest.importorskip("matplotlib")
    from flexact.show.picture import PictureError, picture_bytes

    with pytest.raises(PictureError, match="exactly constrained"):
        picture_bytes(analysis, ".png", held=True)


def test_a_picture_and_the_page_show_it() -> None:
    pytest.importorskip("matplotlib")
    from flexact.show.picture import draw, picture_bytes

    analysis = flexact.analyse(flexact.read_text(text_of("flexures/six_wires")))
    words = [text.get_text() for text in draw(analysis, held=True).texts]
    for hold in holds_of(analysis):
        assert f"{hold.sine:.2f}" in words
    assert io.BytesIO(picture_bytes(analysis, ".svg", held=True)).read(5) == b"<?xml"
    (frame,) = frames_of(drawing_of(analysis.given))
    _, *each = holds_data(analysis, frame)
    assert len(each) == 6
    assert "How well" in each[0]["title"]
