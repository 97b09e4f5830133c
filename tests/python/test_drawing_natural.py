# SPDX-License-Identifier: BSD-3-Clause
"""Declared degrees of freedom in the shape in which what is free bends least."""

import numpy as np
import pytest

import flexact
from flexact.analysis.freedoms import FreeMotion
from flexact.show.drawing import drawing_of, move
from flexact.show.drawing.movement import natural_shape
from flexact.show.drawing.selection import way_of

#: A lever on a hinge at node 1 moves the near end of a wire; nothing holds the turns of that end
#: (node 6) and the far end (node 8) of the wire stands on a fixed point.
LEVER = """\
HINGE 1 2 3 0 0 1
RBEAM 2 1 3 4
BEAM 3 4 6 7 8 0 1 0
X 4 0.1 0 0
X 7 0.1 0.2 0
FIX 1
FIX 2
FIX 7 1 3
FIX 8
RLSE 3 2 3 4 5 6
DYNE 1 1
"""


def shape_of(text: str) -> tuple[flexact.Analysis, FreeMotion]:
    analysis = flexact.analyse(flexact.read_text(text))
    motion = way_of(analysis.freedoms[0])
    assert motion.is_natural
    return analysis, motion


def turns_of(text: str) -> tuple[float, float]:
    """Turn of the wire's free end about z, over the lever's, and of its chord likewise."""
    analysis, motion = shape_of(text)
    number = analysis.data.arrays.node_number.tolist()
    turn, lever = motion.rotation[number.index(6), 2], motion.rotation[number.index(3), 2]
    moved = motion.displacement[number.index(4)] - motion.displacement[number.index(7)]
    return turn / lever, moved[0] / 0.2 / lever


def test_the_free_end_of_a_clamped_wire_turns_as_a_cantilever_does() -> None:
    """A cantilever without a moment at its end turns by 3/2 of its chord (Gere, app. G)."""
    # Only the y of node 7 is free; the lever turns node 4 by 0.1 m along y, the wire stays as long.
    text = LEVER.replace("X 7 0.1 0.2 0", "X 7 0.3 0 0").replace("FIX 7 1 3", "FIX 7")
    text = text.replace("RLSE 3 2", "RLSE 3 1 2")
    analysis, motion = shape_of(text)
    number = analysis.data.arrays.node_number.tolist()
    lever = motion.rotation[number.index(3), 2]
    chord = -motion.displacement[number.index(4), 1] / 0.2
    assert chord == pytest.approx(-0.5 * lever)
    assert motion.rotation[number.index(6), 2] == pytest.approx(1.5 * chord)
    np.testing.assert_allclose(motion.rotation[number.index(6), :2], 0.0, atol=1e-12)


def test_least_norm_would_kink_it() -> None:
    """Without the least of bending the end would not turn at all."""
    text = LEVER.replace("X 7 0.1 0.2 0", "X 7 0.3 0 0").replace("FIX 7 1 3", "FIX 7")
    analysis = flexact.analyse(flexact.read_text(text.replace("RLSE 3 2", "RLSE 3 1 2")))
    plain = analysis.freedoms[0].motion
    assert plain is not None
    number = analysis.data.arrays.node_number.tolist()
    assert plain.rotation[number.index(6), 2] == pytest.approx(0.0, abs=1e-12)
    assert "bends least" in move(drawing_of(analysis.given), way_of(analysis.freedoms[0])).remark  # type: ignore[arg-type]


def test_stiffness_of_the_deck_decides_between_two_wires() -> None:
    """A point between two clamped wires in line, moved across: it turns to the softer one's side.

    Two cantilevers of lengths 1 and 2 share the turn t of their ends, moved by w = 1: with
    bending stiffnesses E1, E2 the energy E1 (2 t^2 - 6 t w + 6 w^2) + E2 (t^2 + 3/2 t w + 3/4 w^2)
    has its least at t = (6 E1 - 1.5 E2)/(4 E1 + 2 E2).
    """
    deck = """\
BEAM 1 1 2 3 4 0 1 0
BEAM 2 3 4 5 6 0 1 0
X 3 1 0 0
X 5 3 0 0
FIX 1
FIX 2
FIX 5
FIX 6
FIX 3 1 3
RLSE 1 2 3 4 5 6
RLSE 2 2 3 4 5 6
DYNX 3 2
END
ESTIFF 1 1e6 1e3 1e3 {}
ESTIFF 2 1e6 1e3 1e3 {}
END
"""
    for one, two in ((1.0, 1.0), (1.0, 5.0), (7.0, 1.0)):
        analysis = flexact.analyse(flexact.read_text(deck.format(one, two)))
        motion = way_of(analysis.freedoms[0])
        assert motion is not None
        number = analysis.given.arrays.node_number.tolist()
        expected = (6 * one - 1.5 * two) / (4 * one + 2 * two)
        assert motion.rotation[number.index(4), 2] == pytest.approx(expected, rel=1e-6)


def test_what_is_determined_stays_as_it_is() -> None:
    guide = flexact.Model(name="guide")
    parallel = guide.parallel_guide((0, 0, 0), (0.1, 0, 0), offset=(0, 0.05, 0))
    guide.fix(*parallel.ground)
    guide.independent("stage", "y")
    freedom = flexact.analyse(guide).freedoms[0]
    assert freedom.motion is not None
    assert natural_shape(freedom.analysis, freedom.motion) is freedom.motion
