# SPDX-License-Identifier: BSD-3-Clause
"""The margin: misalign by it, and the verdict changes."""

import json
import math
import re

import numpy as np
import pytest
from known_models import folded_sheet, ring, twelve_trusses

from flexact import Certainty, Model, analyse, read_text, sweep
from flexact.advice.describe import describe
from flexact.core import calls
from flexact.core.arrays import packed


def two_wires(angle: float, length: float = 1.0) -> Model:
    """From the points 0 and `angle` along y to one joint at x = `length`."""
    model = Model(planar=True)
    a, b = model.node(0, 0), model.node(0, length * angle)
    joint = model.node(length, 0)
    for end in (a, b):
        model.truss(end, joint)
        model.fix(end)
    return model


@pytest.mark.parametrize("length", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("angle", [1e-2, 1e-4, 1e-6, 1e-8])
def test_margin_of_two_wires_is_their_angle(angle: float, length: float) -> None:
    """They are parallel once one of them turns by it, or an end moves by its arc."""
    margin = analyse(two_wires(angle, length)).margin
    assert margin.angle == pytest.approx(angle, rel=2 * angle + 1e-6)
    assert margin.length == pytest.approx(angle * length, rel=2 * angle + 1e-6)
    assert margin.element in (1, 2)
    assert margin.singular_value == pytest.approx(angle / 2, rel=2 * angle + 1e-6)


def smallest_after_move(model: Model, node: int, move: np.ndarray) -> float:
    """Smallest singular value of the scaled D(c) where a node stands elsewhere."""
    places = model.positions.copy()
    places[model.node_index(node)] += move
    moved = Model()
    nodes = [moved.node(*place) for place in places]
    for p, _, q, _ in model.element_nodes.tolist():
        moved.truss(nodes[p], nodes[q])
    for index in np.flatnonzero((model.coordinate_classes == 1).all(axis=1)):
        moved.fix(nodes[index])
    return float(analyse(moved).scaled_singular_values[-1])


def near_yaw_90(degrees: float) -> Model:
    """Hunt and Fichter's platform, singular at a yaw of 90 degrees."""
    model = Model()
    base = [model.node(*polar(1.0, k), 0) for k in (0, 120, 240)]
    top = [model.node(*polar(0.6, k + degrees), 1) for k in (60, 180, 300)]
    for k in range(3):
        model.fix(base[k])
        model.truss(base[k], top[k])
        model.truss(base[(k + 1) % 3], top[k])
        model.truss(top[k], top[(k + 1) % 3])
    return model


def polar(radius: float, degrees: float) -> tuple[float, float]:
    return radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees))


def test_moving_the_node_by_the_margin_makes_a_zero() -> None:
    model = near_yaw_90(89.9)
    analysis = analyse(model)
    margin = analysis.margin
    assert margin.length is not None
    assert margin.node is not None
    random = np.random.default_rng(7)
    directions = random.normal(size=(400, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    moved = [smallest_after_move(model, margin.node, margin.length * d) for d in directions]
    (small, _) = analysis.gap
    assert small is not None
    assert min(moved) < 0.1 * small
    shorter = [smallest_after_move(model, margin.node, 0.5 * margin.length * d) for d in directions]
    assert min(shorter) > 0.4 * small


def bars_in_line() -> Model:
    model = Model(planar=True)
    a, b, c = (model.node(x, 0) for x in (-1, 0, 1))
    model.truss(a, b)
    model.truss(b, c)
    model.fix(a)
    model.fix(c)
    return model


def test_a_zero_that_any_misalignment_lifts_has_no_margin() -> None:
    """Two bars in a line are tight only as long as they are in a line: no length of a machine.

    To first order u' dD v = 2 d / 2 where the joint is moved by d, whatever d is.
    """
    analysis = analyse(bars_in_line())
    for margin in (analysis.margin, analysis.margins[0]):
        assert (margin.length, margin.angle, margin.exact_alignment) == (0.0, 0.0, True)
        assert (margin.node, margin.element) == (3, 1)
        assert margin.singular_value == pytest.approx(0.0, abs=1e-15)
    told = " ".join(describe(analysis).split())
    assert "depend on exact alignment" in told
    assert "exact alignment" in repr(analysis)
    assert not re.search(r"\d (nm|um|mm|nrad|urad|mrad)", told)


def test_any_move_lifts_such_a_zero() -> None:
    """By exact arithmetic, on the decimals as typed: far below what floats could tell."""
    deck = bars_in_line().to_deck()
    lifted = re.sub(r"^X 3 .*$", "X 3 0 1e-12", deck, flags=re.MULTILINE)
    assert lifted != deck
    proof = analyse(read_text(lifted)).proof
    assert proof is not None and proof.rank == 2
    assert analyse(read_text(deck)).rank == 1


def test_with_a_tolerance_a_zero_is_lifted_by_so_much() -> None:
    """u = (1, 1) / sqrt(2), v = (0, 1), rows scaled by 1 / sqrt(2): u' dD v = d."""
    analysis = analyse(bars_in_line(), tolerance=1e-3)
    margin = analysis.margin
    assert margin.length == pytest.approx(1e-3, rel=1e-6)
    assert not margin.exact_alignment and margin.node == 3


def test_units_do_not_matter() -> None:
    metres, millimetres = (analyse(folded_sheet(False, 2, s)) for s in (0.06, 60.0))
    assert len(metres.margins) == len(millimetres.margins) > 0
    for one, other in zip(metres.margins, millimetres.margins, strict=True):
        assert one.singular_value == pytest.approx(other.singular_value, rel=1e-9)
    assert metres.margin.length is not None
    assert millimetres.margin.length == pytest.approx(1000 * metres.margin.length, rel=1e-6)
    assert millimetres.margin.angle == pytest.approx(metres.margin.angle, rel=1e-6)


def test_no_misalignment_frees_a_clamped_fold() -> None:
    """Fig. 4 of the paper: its motion and its self-stress hold for any angle and length."""
    analysis = analyse(folded_sheet(clamped=True))
    assert analysis.margins[0][:4] == (None, None, None, None)


def test_one_margin_for_each_zero_and_each_pair() -> None:
    analysis = analyse(twelve_trusses())
    assert len(analysis.margins) == 1 + analysis.raw.pair_value.size > 1
    assert [margin.exact_alignment for margin in analysis.margins[:2]] == [True, False]
    assert all(margin.length for margin in analysis.margins[1:])
    assert analysis.margin == analysis.margins[0]


def test_motions_alone_have_no_margin() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.truss(a, b)
    model.fix(a)
    analysis = analyse(model)
    assert analysis.under_constrained == 2
    assert not [m for m in analysis.margins if m.singular_value == 0.0]


def test_margin_in_json() -> None:
    model = two_wires(1e-4)
    analysis = analyse(model)
    made = json.loads(analysis.to_json())["margin"]
    length, angle = made["length"], made["angle"]
    assert (length["value"], length["unit"]) == (analysis.margin.length, "m")
    assert (angle["value"], angle["unit"]) == (analysis.margin.angle, "rad")
    assert (length["node"], angle["element"]) == (analysis.margin.node, analysis.margin.element)
    assert (angle["name"], angle["keyword"], made["exact_alignment"]) == ("", "PLTRUSS", False)
    assert analysis.certainty is Certainty.CERTAIN
    assert angle["value"] == pytest.approx(1e-4, rel=1e-3)


def test_a_mechanism_far_from_another_verdict_has_no_small_margin() -> None:
    """Tarnai's ring of five: a tenth of the characteristic length, or of a radian, and more."""
    analysis = analyse(ring(5))
    margin = analysis.margin
    assert margin.length is None or margin.length > 0.1 * analysis.characteristic_length
    assert margin.angle is None or margin.angle > 0.1


def test_pairs_of_wrong_size_are_refused() -> None:
    arrays = ring(3).data.arrays
    pairs = np.zeros((2, 1), np.int32)
    with pytest.raises(ValueError):
        calls.find_sensitivities(packed(arrays), np.zeros((2, 1)), np.zeros((9, 1)), pairs)
    with pytest.raises(ValueError):
        calls.find_sensitivities(packed(arrays), np.zeros((9, 1)), np.zeros((9, 1)), pairs + 1)


def test_sensitivities_are_double() -> None:
    """One third in every real argument; a truss along y, dn_x/dx = 1 / l."""
    model = Model()
    a, b = model.node(0, 0, 0), model.node(0, 3, 0)
    model.truss(a, b)
    model.fix(a)
    u, v = np.full((1, 1), 1 / 3), np.array([[1 / 3], [0.0], [0.0]])
    effect, _ = calls.find_sensitivities(model.data.packed, u, v, np.zeros((2, 1), np.int32))
    assert effect[3, 0] == pytest.approx(1 / 27, rel=1e-9)
    assert effect[4, 0] == pytest.approx(1 / 9, rel=1e-9)


def test_margins_of_equal_values_do_not_depend_on_their_basis() -> None:
    """Three sheets alike about z make pairs of equal singular values.

    Their vectors are turned as rounding has it, and as two decompositions have it: margins stay.
    """
    model = Model()
    model.fix(model.node(0.04, -0.025, 0, name="clamp"))
    model.sheet("clamp", (0.04, 0.005, 0), "z", name="sheet")
    model.body([(0, 0, 0), (0.04, 0.005, 0)], name="lens")
    model.pattern(3, "z", names="{} {}")
    first = analyse(model)
    value, motion = first.raw.pair_value, first.raw.pair_motion
    assert value[1] - value[0] < 1e-12 * value[0], "the first two are equal"
    np.testing.assert_allclose(motion.T @ motion, np.eye(value.size), atol=1e-12)
    most = np.argmax(np.hypot(*motion[:, :2].T))
    assert abs(motion[most, 1]) < 1e-9 < motion[most, 0], "that place is moved by one of them"
    (row,) = sweep(model, positions=model.positions[None], want="values")
    assert row["margin"] == pytest.approx(first.margin.length, rel=1e-9)
    assert row["margin_angle"] == pytest.approx(first.margin.angle, rel=1e-9)
