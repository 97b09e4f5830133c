# SPDX-License-Identifier: BSD-3-Clause
"""Properties that hold of every model: decks read back, counts agree, frames do not matter."""

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from random_models import framework, mechanism, transformed

import flexact
from flexact import Model

seeds = st.integers(0, 2**32 - 1)
often = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])


def assert_same(model: Model, again: Model) -> None:
    for name, ours, theirs in zip(
        model.data.arrays._fields, model.data.arrays, again.data.arrays, strict=True
    ):
        assert np.array_equal(ours, theirs), name
        assert ours.dtype == theirs.dtype
    assert list(model.element_names) == list(again.element_names)
    assert model.planar == again.planar


@often
@given(seeds, st.booleans())
def test_decks_read_back_to_the_same_model(seed: int, planar: bool) -> None:
    model = mechanism(np.random.default_rng(seed), planar)
    assume(model.element_numbers.size)
    deck = model.to_deck()
    again = flexact.read_text(deck)
    assert_same(model, again)
    ours, theirs = flexact.analyse(model), flexact.analyse(again)
    assert ours.verdict is theirs.verdict
    assert np.array_equal(ours.singular_values, theirs.singular_values)
    second = again.to_deck()
    assert second.split("\n")[1:] == deck.split("\n")[1:], "but for the title"


@often
@given(seeds, st.booleans())
def test_changed_decks_are_as_if_made_so(seed: int, planar: bool) -> None:
    model = mechanism(np.random.default_rng(seed), planar)
    assume(model.element_numbers.size)
    again = flexact.read_text(model.to_deck())
    positions = model.node_numbers[model.node_kinds <= 2].tolist()
    assume(positions)
    for each in (model, again):
        start = each.handle(positions[0])
        each.truss(start, each.node(9, 9, 0 if planar else 9))
    for name in ("element_kinds", "deformation_classes", "positions", "coordinate_classes"):
        ours, theirs = getattr(model, name), getattr(again, name)
        assert np.array_equal(ours, theirs), name


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False, width=64), min_size=3, max_size=3))
def test_every_double_reads_back_to_the_last_bit(values: list[float]) -> None:
    model = Model()
    model.truss(model.node(*values), model.node(1, 2, 3))
    assume(not model.data.problems.errors)
    assert_same(model, flexact.read_text(model.to_deck()))


@often
@given(seeds, st.integers(3, 9), st.integers(1, 24), st.integers(0, 4), st.booleans())
def test_maxwell_calladine(seed: int, joints: int, bars: int, supports: int, planar: bool) -> None:
    # Calladine 1978: m - s = d j - b - supports, whatever the geometry.
    model = framework(np.random.default_rng(seed), joints, bars, supports, planar)
    analysis = flexact.analyse(model)
    m, s = analysis.under_constrained, analysis.over_constrained
    assert m - s == analysis.columns - analysis.rows
    classes = model.coordinate_classes
    size = 2 if planar else 3
    free = size * model.node_numbers.size - int((classes == 1).sum())
    assert m - s == free - model.element_numbers.size


@often
@given(seeds, st.booleans(), st.sampled_from([1e-6, 1.0, 1e6]))
def test_rotation_translation_and_scale_do_not_matter(
    seed: int, planar: bool, scale: float
) -> None:
    random = np.random.default_rng(seed)
    joints, bars = int(random.integers(3, 8)), int(random.integers(2, 18))
    model = framework(random, joints, bars, int(random.integers(0, 3)), planar)
    turn = np.eye(3)
    size = 2 if planar else 3
    turn[:size, :size] = np.linalg.qr(random.normal(size=(size, size)))[0]
    shift = scale * random.normal(size=3) * ([1, 1, 0] if planar else [1, 1, 1])
    other = transformed(model, turn, shift, scale)
    ours, theirs = flexact.analyse(model), flexact.analyse(other)
    assert (ours.rank, ours.verdict) == (theirs.rank, theirs.verdict)
    # Elongation against displacement has no unit: the singular values stay, too.
    assert theirs.singular_values == pytest.approx(ours.singular_values, abs=1e-9)


@often
@given(seeds, st.booleans())
def test_free_mechanisms_keep_their_rigid_motions(seed: int, planar: bool) -> None:
    model = mechanism(np.random.default_rng(seed), planar, held=False)
    assume(model.element_numbers.size)
    matrix = flexact.jacobian(model)
    place = dict(zip(model.node_numbers.tolist(), model.positions, strict=True))
    for axis in [2] if planar else range(3):
        turn = np.eye(3)[axis]
        motion = [
            turn["xyz".index(name[1])]
            if name[0] == "r"
            else np.cross(turn, place[number])["xyz".index(name)]
            for number, name in matrix.column_labels
        ]
        assert np.abs(matrix.toarray() @ motion).max() < 1e-12
