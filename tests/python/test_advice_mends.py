# SPDX-License-Identifier: BSD-3-Clause
"""Limbs that repeat what others hold, turned so that they stop what is free.

The paper's own mend of Fig. 5 is Fig. 3(b): the lower two at right angles, which is exact.
"""

from __future__ import annotations

import re

import numpy as np
import pytest
from reference_decks import text_of

import flexact
from flexact import Model
from flexact.advice.causes.causes import causes_of
from flexact.advice.causes.realignment import JointMove, Mend
from flexact.advice.step import Purpose
from flexact.analysis.change import Change
from flexact.analysis.naming import plain
from flexact.analysis.places import direction_words
from flexact.analysis.screws import Screw

SYMMETRIC = "paper/five_folded_sheets_symmetric"


def mends_of_deck(name: str) -> tuple[Model, tuple[Mend, ...]]:
    model = flexact.read_text(text_of(name), name)
    mends = causes_of(flexact.analyse(model)).mends
    assert all(isinstance(one, Mend) for one in mends)
    return model, mends  # type: ignore[return-value]


def test_the_lower_two_are_put_at_right_angles() -> None:
    model, mends = mends_of_deck(SYMMETRIC)
    best = mends[0]
    assert best.purpose is Purpose.MEND
    assert {part.name.split(",")[0] for part in best.parts} == {"lower 0"}
    assert {part.name.split(",")[0] for part in best.repeats} == {"lower 180"}
    assert abs(best.angle) == pytest.approx(np.pi / 2)
    np.testing.assert_allclose(best.direction, (0, 0, 1), atol=1e-9)
    # The same turn of the other one, and both the other way round.
    assert len(best.alternatives) == 3
    turned = best.change.apply(model.data)
    moved = turned.positions[turned.data.node_index[41]]
    np.testing.assert_allclose(moved[2], -0.09)
    # From x about z towards y.
    np.testing.assert_allclose(moved[:2], (0, 0.06 * np.sign(best.angle)), atol=1e-12)


@pytest.mark.parametrize(
    "name",
    [
        SYMMETRIC,
        "flexures/five_wires_lower_two_parallel",
        "linkages/parallelogram_three_cranks",
    ],
)
def test_every_mend_makes_it_exact(name: str) -> None:
    model, mends = mends_of_deck(name)
    assert 1 <= len(mends) <= 3
    for mend in mends:
        for change in (mend.change, *mend.alternatives):
            after = flexact.analyse(change.apply(model.data))
            assert (after.under_constrained, after.over_constrained) == (0, 0)
        assert mend.after.smallest is not None
        assert mend.condition >= 1.0


@pytest.mark.parametrize(
    "name",
    [
        SYMMETRIC,
        "flexures/five_wires_lower_two_parallel",
        "flexures/six_folded_sheets_undeclared",
        "linkages/parallelogram_three_cranks",
    ],
)
def test_limbs_turn_right_handed_as_the_words_say(name: str) -> None:
    """By Rodrigues' formula, v cos + (k x v) sin + k (k.v) (1 - cos), about the line as printed."""
    model, mends = mends_of_deck(name)
    for mend in mends:
        line, angle = mend.direction * np.sign(mend.angle), abs(mend.angle)
        words = plain(mend.words())
        sense = "anticlockwise" if mend.angle > 0.0 else "clockwise"
        said = sense if model.data.planar else direction_words(line)
        assert f"by {np.degrees(angle):.4g} degrees" in words
        if model.data.planar or "line along" in words:
            assert re.search(rf"(line along |, ){re.escape(said)}[ ,;.]", words), words
        assert mend.change.places
        for number, place in mend.change.places:
            arm = model.positions[model.data.node_index[number]] - mend.point
            turned = arm * np.cos(angle) + np.cross(line, arm) * np.sin(angle)
            turned += line * (line @ arm) * (1.0 - np.cos(angle))
            np.testing.assert_allclose(place, mend.point + turned, atol=1e-9)


def test_members_keep_their_lengths_and_sheets_their_angles() -> None:
    model, mends = mends_of_deck(SYMMETRIC)
    turned = mends[0].change.apply(model.data)
    before, after = model.data.frames, turned.data.frames
    np.testing.assert_allclose(after.length, before.length, rtol=1e-9)
    for index in range(10):
        across = [frames.frame[index][:, 2] for frames in (before, after)]
        moved = {int(number) for number, _ in mends[0].change.vectors}
        if int(model.data.arrays.element_number[index]) not in moved:
            np.testing.assert_allclose(*across, atol=1e-12)


def test_what_any_geometry_has_is_not_turned() -> None:
    _, mends = mends_of_deck("flexures/parallel_guide_undeclared")
    assert mends == ()


@pytest.mark.parametrize(
    "name", ["paper/twelve_trusses", "frameworks/k33_circle", "frameworks/ring_6"]
)
def test_a_joint_is_moved_where_no_limb_can_be_turned(name: str) -> None:
    model = flexact.read_text(text_of(name), name)
    (move,) = causes_of(flexact.analyse(model)).mends
    assert isinstance(move, JointMove)
    for change in (move.change, *move.alternatives):
        after = flexact.analyse(change.apply(model.data))
        assert (after.under_constrained, after.over_constrained) == (0, 0)
        assert after.gap.smallest_nonzero == pytest.approx(move.after.smallest, rel=1e-4)


def test_a_turn_says_what_it_stops_only_where_it_does() -> None:
    """A wire in line with another, turned about its end, leaves what does not move that end."""
    model = Model()
    for k, (ground, end) in enumerate((((0, 0, 0), (0.1, 0, 0)), ((0.3, 0, 0), (0.2, 0, 0)))):
        model.wire(ground, end, name=f"wire {k + 1}")
        model.fix(ground)
    model.body([(0.1, 0, 0), (0.2, 0, 0)], name="stage")
    result = flexact.analyse(model)
    mends = causes_of(result).mends
    assert mends
    for mend in mends:
        assert isinstance(mend, Mend)
        if mend.stops is None:
            continue
        after = flexact.analyse(mend.change.apply(model.data))
        twists = np.array(
            [[*screw.rotation, *screw.at((0, 0, 0))] for screw in _screws(after, "stage")]
        )
        mine = np.array([*mend.stops.rotation, *mend.stops.at((0, 0, 0))])
        rank = np.linalg.matrix_rank(twists, tol=1e-9)
        assert np.linalg.matrix_rank(np.vstack((twists, mine)), tol=1e-9) == rank + 1


def _screws(result: flexact.Analysis, body: str) -> list[Screw]:
    return [motion.of(body) for motion in result.motions if motion.of(body)]


def test_a_changed_vector_is_written_and_read() -> None:
    model = flexact.read_text(text_of(SYMMETRIC), SYMMETRIC)
    change = Change(vectors=((1, (0.0, -1.0, 0.25)),))
    text = change.apply(model.data).to_deck()
    assert "% upper 90, ground to fold" in text
    again = flexact.read_text(text)
    vectors = again.element_vectors
    np.testing.assert_allclose(vectors[0], (0, -1, 0.25))
    np.testing.assert_allclose(vectors[1:], model.element_vectors[1:])


def test_a_vector_of_an_element_that_is_not_there() -> None:
    model = flexact.read_text(text_of(SYMMETRIC), SYMMETRIC)
    with pytest.raises(KeyError):
        Change(vectors=((99, (0.0, 0.0, 1.0)),)).apply(model.data)


def test_a_step_on_divided_sheets_says_what_its_deck_gives() -> None:
    """Without declarations, as it stands: the cross hinge with one sheet that is held."""
    name = "flexures/cross_hinge_four_beams_undeclared"
    text = text_of(name).replace("RLSE 2 2 5 6\n", "")
    model = flexact.read_text(text, name)
    analysis = flexact.analyse(model)
    steps = [one for one in analysis.advice().steps if one.purpose is Purpose.MEND]
    assert analysis.with_internal_declared is not None
    for step in steps:
        after = flexact.analyse(step.apply())
        assert step.after.under_constrained == after.under_constrained
        assert step.after.over_constrained == after.over_constrained
