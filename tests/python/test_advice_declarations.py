# SPDX-License-Identifier: BSD-3-Clause
"""Sets of declarations: their number, and that those listed work, by routes that share nothing."""

import re

import numpy as np
import pytest
from counted_sets import declarations_counted, motions, self_stresses
from known_models import folded_sheet, twelve_trusses
from random_models import framework, mechanism
from reference_decks import NAMES, text_of, transform

import flexact
from flexact import Analysis, Model, analyse
from flexact.advice.releases.releases import declarations_of
from flexact.advice.step import Purpose
from flexact.analysis.change import Change
from flexact.analysis.naming import Named, plain
from flexact.core.elements import Class


def of_deck(name: str) -> Analysis:
    return analyse(flexact.read_text(text_of(name), name))


def test_the_twelve_trusses_have_four_declarations() -> None:
    """Table 2 of the paper: each of the four top nodes moves along one axis."""
    declarations = declarations_of(analyse(twelve_trusses()))
    assert (declarations.size, declarations.count) == (1, 4)
    (one,) = declarations.sets
    assert one.change.coordinates == ((9, "y", Class.INDEPENDENT),)
    others = {other.coordinates[0][:2] for other in one.alternatives}
    assert others == {(11, "x"), (13, "y"), (15, "x")}
    assert one.condition == pytest.approx(2.0)
    assert declarations.others == ()


def test_the_guide_has_two_declarations_of_one_body() -> None:
    """Both ends of the body move in the same way: that is said once."""
    declarations = declarations_of(of_deck("flexures/parallel_guide_undeclared"))
    assert (declarations.size, declarations.count) == (1, 2)
    assert len(declarations.sets) == 1
    assert not declarations.sets[0].alternatives


@pytest.mark.parametrize("name", NAMES)
def test_of_every_deck_the_count_is_right_and_the_sets_work(name: str) -> None:
    analysis = of_deck(name)
    declarations = declarations_of(analysis)
    truth = declarations_counted(analysis.given)
    assert truth is None or declarations.count == truth
    assert bool(declarations.sets) == (declarations.count != 0)
    stresses = self_stresses(analysis.given)
    for proposal in (*declarations.sets, *declarations.others):
        changed = proposal.change.apply(analysis.given).data
        assert motions(changed) == 0
        assert self_stresses(changed) == stresses
    assert all(each.purpose is Purpose.DECLARE for each in declarations.sets)
    assert all(each.purpose is Purpose.HOLD for each in declarations.others)


@pytest.mark.parametrize("seed", range(2))
def test_of_random_models_the_count_is_right(seed: int) -> None:
    random = np.random.default_rng(10 + seed)
    with_several = 0
    for k in range(16):
        if k % 2:
            made = mechanism(random, planar=bool(k % 4 == 1))
        else:
            bars, supports = int(random.integers(4, 12)), int(random.integers(1, 4))
            made = framework(random, int(random.integers(4, 8)), bars, supports, bool(k % 4))
        try:
            analysis = analyse(made)
        except flexact.ModelError:
            continue
        truth = declarations_counted(analysis.given)
        if truth is None:
            continue
        declarations = declarations_of(analysis)
        assert declarations.count == truth
        assert bool(declarations.sets) == (truth != 0)
        with_several += declarations.size > 1
    assert with_several > 1


def test_bodies_come_before_joints_and_displacements_before_rotations() -> None:
    declarations = declarations_of(of_deck("flexures/cross_hinge_undeclared"))
    names = [each.change.coordinates[0][1] for each in declarations.sets]
    assert names == ["x", "z", "ry"]
    folded = declarations_of(of_deck("paper/five_folded_sheets_symmetric"))
    decade = [each for each in folded.sets if each.condition < 10.0 * folded.sets[0].condition]
    kinds = [name.startswith("r") for each in decade for _, name, _ in each.change.coordinates]
    assert kinds == sorted(kinds)


def test_what_is_inside_of_sheets_is_declared_with_the_body() -> None:
    """Two sheets of four beams: nine internal motions each, and that of the guide."""
    analysis = of_deck("flexures/parallel_guide_four_beams_undeclared")
    declarations = declarations_of(analysis)
    assert (declarations.size, declarations.count) == (19, 2)
    (one,) = declarations.sets
    named = [each for each in one.words() if isinstance(each, Named)]
    assert [each.words for each in named] == ["the body", "the left sheet", "the right sheet"]


def test_what_may_be_held_is_what_the_motion_bends() -> None:
    """tests/reference/known_answers.md, Flexures: e6 of the first sheet or e5 of the second."""
    declarations = declarations_of(analyse(folded_sheet(clamped=True)))
    (one,) = declarations.others
    held = {each.deformations for each in (one.change, *one.alternatives)}
    assert held == {((1, 6, Class.FIXED),), ((2, 5, Class.FIXED),)}


def test_a_model_made_in_python_gets_calls_and_a_deck_statements() -> None:
    made = analyse(twelve_trusses())
    words = plain(declarations_of(made).sets[0].words())
    assert 'model.independent((0, -1, 1), "y")' in words
    assert 'model.fix((0, -1, 1), "y")' in words
    deck = of_deck("paper/twelve_trusses")
    words = plain(declarations_of(deck).sets[0].words())
    assert "DYNX 5 2" in words
    assert "FIX 5 2" in words


@pytest.mark.parametrize("name", NAMES[::3])
def test_words_do_not_depend_on_units(name: str) -> None:
    def words_of(analysis: Analysis) -> list[str]:
        found = declarations_of(analysis)
        told = (plain(e.words()) for e in (*found.sets, *found.others))
        return [str(found.count), *(re.sub(r" \((DYNX|FIX)[^)]*\)", "", each) for each in told)]

    scaled = flexact.read_text(transform.scaled(text_of(name), 1e3))
    assert words_of(analyse(scaled)) == words_of(of_deck(name))


def test_a_mechanism_without_motions_has_nothing_to_declare() -> None:
    model = Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), width=(0, 0, 1))
    model.fix((0, 0, 0))
    model.fix((0.1, 0, 0))
    declarations = declarations_of(analyse(model))
    assert (declarations.size, declarations.count) == (0, 1)
    assert [one.change for one in declarations.sets] == [Change()]
