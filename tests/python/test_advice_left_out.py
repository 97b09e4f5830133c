# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be made of an advice, or would take too long, is left out and said."""

from __future__ import annotations

import json
from itertools import product

import numpy as np
import pytest

import flexact
from flexact import Analysis, Model
from flexact.util.partial import STRICT

pytestmark = pytest.mark.dear(12)


def guide() -> Analysis:
    """A stage on two parallel sheets, nothing of which is declared."""
    model = Model(name="guide")
    for y in (0.0, 0.05):
        model.sheet((0, y, 0), (0.1, y, 0), width=(0, 0, 1))
        model.fix((0, y, 0))
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    return flexact.analyse(model)


#: What is made to fail, and what is said to be left out.
FAILING = {
    "flexact.advice.advice.causes_of": "causes",
    "flexact.advice.advice.extents_of": "how far motions go",
    "flexact.advice.advice.releases_of": "releases",
    "flexact.advice.advice.declarations_of": "declarations",
    "flexact.advice.advice.undeclarations_of": "declarations to take back",
    "flexact.advice.advice.spaces_of": "freedom and constraint",
    "flexact.advice.spaces.spaces.wires_for": "wires and sheets to add",
    "flexact.advice.advice.both_in_words": "a pair",
    "flexact.advice.advice.spaces_lines": "words of freedom and constraint",
    "flexact.advice.motions.motion_in_sentence": "a motion",
    "flexact.advice.motions.stress_in_sentence": "a self-stress",
    "flexact.advice.releases.words.statements_in_words": "a step",
}


@pytest.mark.parametrize("target", FAILING)
def test_no_advice_dies_of_one_piece(target: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object, **__: object) -> None:
        raise KeyError("a mistake of the program")

    monkeypatch.setattr(target, fails)
    with pytest.raises(KeyError):
        _ = guide().advice().describe()
    monkeypatch.delenv(STRICT)
    advice = guide().advice()
    words = " ".join(advice.describe().split())
    assert f"{FAILING[target]}, which failed (a mistake of Flexact's own" in words
    assert "Under-constrained by 1" in words
    assert json.loads(json.dumps(advice.to_dict()))["left_out"]


def test_a_wrong_name_is_told_and_not_left_out() -> None:
    with pytest.raises(flexact.ModelError):
        guide().advice(body="stag")


@pytest.mark.parametrize("turns", list(product((0, 1, 2), repeat=2)))
def test_chains_with_a_free_end_are_advised_on(turns: tuple[int, int]) -> None:
    """A sheet that is added at the free end may go on in line with the one that is there."""
    model, place = Model(), np.zeros(3)
    for way in np.eye(3)[[0, *turns]]:
        width = (0, 1, 0) if way[1] == 0 else (0, 0, 1)
        model.sheet(place, place + way, width=width)
        place = place + way
    model.fix(place)
    advice = flexact.analyse(model).advice()
    assert len(advice)
    assert advice.describe()


def at_one_joint(count: int) -> Model:
    """A joint that so many bars hold."""
    model, rng = Model(), np.random.default_rng(1)
    joint = model.node(0, 0, 0)
    for _ in range(count):
        foot = model.node(*rng.normal(size=3))
        model.fix(foot)
        model.truss(foot, joint)
    return model


def test_what_takes_long_is_left_out() -> None:
    """Of 400 bars at a joint sets are found step by step, and some self-stresses are told."""
    advice = flexact.analyse(at_one_joint(400)).advice()
    assert advice.releases.is_too_large
    assert advice.releases.count is None
    assert all(step.after.over_constrained == 0 for step in advice)
    entries = sum(len(one.stress.parts) for one in advice.self_stresses)
    assert entries <= 20_000
    words = " ".join(advice.describe().split())
    assert f"of 397 self-stresses all but {len(advice.self_stresses)}" in words
    assert "sets of releases, for so many self-stresses" in words


def test_a_pair_has_to_do_with_each_other() -> None:
    """Two sheets hold a clamped-in stage twice; what hangs on it by a hinge is another matter."""
    model = Model()
    for y in (0.0, 0.05):
        model.sheet((0, y, 0), (0.1, y, 0), width=(0, 0, 1))
        model.fix((0, y, 0))
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    model.independent((0.1, 0, 0), "y")
    foot = model.node(1.0, 0.0, 0.0)
    model.fix(foot)
    lever = model.hinge(foot, "z")
    model.body([lever, (1.1, 0.0, 0.0)], name="lever")
    result = flexact.analyse(model)
    assert (result.under_constrained, result.over_constrained) == (1, 1)
    assert "while nothing stops" not in " ".join(result.advice().describe().split())
    assert "while nothing stops" in " ".join(guide().advice().describe().split())
