# SPDX-License-Identifier: BSD-3-Clause
"""Clamps as blocks of ground: one where several members are clamped at one place."""

import numpy as np
import pytest

import flexact
from flexact.model.parts.parts import Parts
from flexact.show.drawing import Drawing, Support, drawing_of
from flexact.show.page.drawing import frames_of, static_data

TOP = (0.0, 0.0, 0.1)


def drawn(model: flexact.Model) -> Drawing:
    return drawing_of(flexact.analyse(model).given)


def corners(drawing: Drawing, row: int) -> np.ndarray:
    """(8, 3) of a block."""
    support = drawing.supports[row]
    sizes = np.array((support.depth, *support.extent))
    unit = np.array([(i, j, k) for i in (-1, 0) for j in (-1, 1) for k in (-1, 1)])
    return np.asarray(support.middle + (unit * sizes) @ support.frame.T)


def fan(*feet: tuple[float, float, float]) -> flexact.Model:
    """Wires from feet, each a clamped point of its own, to a body."""
    model = flexact.Model(name="fan")
    for number, foot in enumerate(feet):
        point = model.node(*foot, name=f"foot {number}")
        model.wire(point, (0.05 * number, 0.02 * number**2, 0.1), name=f"wire {number}")
        model.fix(point)
    model.body([(0.05 * k, 0.02 * k**2, 0.1) for k in range(len(feet))], name="stage")
    return model


def test_members_at_one_point_have_one_block() -> None:
    """Three wires end at points of their own in one place: one block that knows all of them."""
    model = fan((0, 0, 0), (0, 0, 0), (0, 0, 0))
    drawing = drawn(model)
    (support,) = drawing.supports
    assert support.kind == Support.CLAMP
    assert len(support.held) in (1, 3)
    data = static_data(Parts(drawing.data), frames_of(drawing)[0], 16)
    (names,) = data["supports"]["names"]
    assert {"wire 0", "wire 1", "wire 2"} <= set(names)
    # The block is below what it holds: the wires stand on the same side of its face.
    away = np.sum(drawing.members.frame[:3, :, 0] * support.frame[:, 0], axis=1)
    assert np.all(np.abs(away) > 0.2)


@pytest.mark.parametrize(("gap", "blocks"), [(0.001, 1), (0.05, 2)])
def test_blocks_that_would_overlap_are_one(gap: float, blocks: int) -> None:
    drawing = drawn(fan((0, 0, 0), (0, gap, 0)))
    supports = drawing.supports
    assert len(supports) == blocks
    assert sum(len(each.held) for each in supports) == 2
    for row, each in enumerate(supports):
        middle = corners(drawing, row).mean(axis=0)
        inside = (drawing.reference.position[list(each.held)] - middle) @ each.frame
        sizes = np.array((each.depth / 2, *each.extent))
        assert np.all(np.abs(inside) <= sizes + 1e-12)


def test_a_block_covers_the_widths_of_crossing_sheets() -> None:
    """Two sheets at right angles are clamped at one point; their ends lie over the block."""
    model = flexact.Model(name="cross")
    foot = model.node(0, 0, 0)
    model.sheet(foot, (0, 0, 0.1), width=(0, 1, 0), name="one")
    model.sheet(foot, (0.0, 0.1, 0.1), width=(1, 0, 0), name="other")
    model.fix(foot)
    model.body([(0, 0, 0.1), (0.0, 0.1, 0.1)], name="stage")
    drawing = drawn(model)
    (row,) = (k for k, each in enumerate(drawing.supports) if each.kind == Support.CLAMP)
    members, frame = drawing.members, drawing.supports[row].frame
    centre = corners(drawing, row).mean(axis=0)
    for k in range(2):
        wide = int(np.argmax(members.section[k]))
        for side in (-0.5, 0.5):
            edge = side * members.section[k, wide] * members.frame[k, :, 1 + wide]
            assert np.all(np.abs((edge - centre) @ frame)[1:] <= drawing.supports[row].extent)


def test_a_clamp_of_one_member_lies_along_its_section() -> None:
    model = flexact.Model(name="sheet")
    model.sheet((0, 0, 0), (0.1, 0.03, 0), width=(0, 0, 1))
    model.fix((0, 0, 0))
    drawing = drawn(model)
    own, (support,) = drawing.members.frame[0], drawing.supports
    frame = support.frame
    np.testing.assert_allclose(np.abs(np.sum(own * frame, axis=0)), 1.0, atol=1e-12)
    assert np.all(support.extent > drawing.members.section[0] / 2)
    place = drawing.reference.position[support.held[0]]
    np.testing.assert_allclose(support.middle, place, atol=1e-12)
