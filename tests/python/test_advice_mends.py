# SPDX-License-Identifier: BSD-3-Clause
"""Limbs that repeat what others hold, turned so that they stop what is free.

The paper's own mend of Fig. 5 is Fig. 3(b): the lower two at right angles, which is exact.
"""

from __future__ import annotations

import numpy as np
import pytest
from reference_decks import text_of

import flexact
from flexact import Model
from flexact.advice.causes.causes import causes_of
from flexact.advice.causes.mend import Mend
from flexact.advice.change import Change
from flexact.advice.proposal import Purpose

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
    np.testing.assert_allclose(np.abs(moved[:2]), (0, 0.06), atol=1e-12)


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
