# SPDX-License-Identifier: BSD-3-Clause
"""Causes in words name the designer's parts, and do not depend on how a deck is told."""

from __future__ import annotations

import re

import numpy as np
import pytest
from divided import Division
from known_models import bar_driven_twice
from reference_decks import text_of, transform
from test_advice_causes import wires
from turned_elements import plain as told_plainly
from turned_elements import turned

import flexact
from flexact import Model
from flexact.advice.causes.causes import causes_of
from flexact.advice.causes.realignment import both_in_words
from flexact.advice.causes.words import (
    cause_of_motion_in_words,
    cause_of_stress_in_words,
)
from flexact.analysis.naming import plain

pytestmark = pytest.mark.dear(16)

DECKS = [
    "flexures/five_wires_lower_two_parallel",
    "flexures/parallel_guide_undeclared",
    "frameworks/collinear_bars_space",
    "frameworks/k33_circle",
    "frameworks/octahedral_platform_yaw_90",
    "frameworks/ring_4",
    "linkages/bennett",
    "linkages/four_bar_in_space",
    "linkages/parallelogram_three_cranks",
    "linkages/sarrus",
    "paper/five_folded_sheets_symmetric",
    "paper/twelve_trusses",
]


def words_of(model: Model) -> list[str]:
    result = flexact.analyse(model)
    causes = causes_of(result)
    pieces = [cause_of_motion_in_words(result, k, causes) for k in range(len(causes.motions))]
    stresses = range(len(causes.self_stresses))
    pieces += [cause_of_stress_in_words(result, k, causes) for k in stresses]
    pieces += [both_in_words(result, causes)]
    pieces += [one.words() for one in causes.mends]
    return [plain(each) for each in pieces]


def without_numbers(words: list[str]) -> list[str]:
    """Sentences without numbers, axes, points and units of length."""
    made = [
        re.sub(r"\([-\d., e*]*\)( m\b)?|-?\b[xyz]\b|-?[\d.]+(e[-+]?\d+)?", "#", w) for w in words
    ]
    return [re.sub(r"# ([munk]?m)\b", "# m", re.sub("-#", "#", each)) for each in made]


@pytest.mark.parametrize("name", DECKS)
def test_the_words_stay_where_the_deck_is_told_otherwise(name: str) -> None:
    text = text_of(name)
    expected = without_numbers(words_of(flexact.read_text(text)))
    turn = transform.about("x", 0.7) @ transform.about("y", -1.1) @ transform.about("z", 2.3)
    others = [
        transform.scaled(text, 1e3),
        transform.turned(text, turn),
        transform.turned(text, transform.about("z", 0.9)),
    ]
    for other in others:
        if other is not None:
            assert without_numbers(words_of(flexact.read_text(other))) == expected


@pytest.mark.parametrize("name", DECKS)
def test_the_words_stay_where_elements_are_told_otherwise(name: str) -> None:
    data = flexact.read_text(text_of(name), name).data
    expected = words_of(Model.from_data(told_plainly(data)))
    assert words_of(turned(data, 1)) == expected


def test_the_words_stay_where_wires_are_divided() -> None:
    expected = words_of(wires(Division()))
    assert words_of(wires(Division(beams=3))) == expected
    undeclared = words_of(wires(Division(beams=3, declared=False)))
    assert [words for words in undeclared if not words.startswith("generic")] == expected
    # Bent by a tenth of a millimetre it has no self-stress as it stands.
    bent = flexact.analyse(wires(Division(beams=3, declared=False, amplitude=1e-4, seed=2)))
    assert bent.over_constrained == 0
    assert causes_of(bent).self_stresses == ()


def test_a_designer_is_told_the_names_of_parts() -> None:
    """Of Fig. 5: which flexures repeat each other, what is free, and which is turned."""
    *_, both, mend = words_of(flexact.read_text(text_of("paper/five_folded_sheets_symmetric")))[:4]
    for word in ("lower 0", "lower 180", "rotation of the body about y"):
        assert word in both
        assert word in mend
    assert "by 90 degrees" in mend
    assert "exactly constrained" in mend


def test_what_is_declared_where_it_is_held_is_told() -> None:
    """The trap: the bending of a clamped folded sheet is declared where the sheet cannot bend."""
    *_, held, _ = words_of(flexact.read_text(text_of("flexures/folded_sheet_clamped_trap")))
    assert "declared, the first sheet, ground to fold: out-of-plane bending" in held
    assert "hold already" in held
    other = words_of(flexact.read_text(text_of("flexures/folded_sheet_clamped_internal")))
    assert not any("declared" in each for each in other)


def test_declarations_that_depend_on_each_other_are_told() -> None:
    """Driven at its end and in length, a bar is driven twice."""
    (stress, _) = words_of(bar_driven_twice())
    assert "cannot be driven one by one" in stress


def test_a_guide_is_told_what_both_sheets_hold_and_what_is_free() -> None:
    *_, both = words_of(flexact.read_text(text_of("flexures/parallel_guide_undeclared")))
    for word in ("left sheet", "right sheet", "rotation about x", "translation of the body"):
        assert word in both


def test_small_misalignments_are_in_units_of_the_workshop() -> None:
    model = flexact.read_text(text_of("paper/five_folded_sheets_symmetric"))
    (motion, *_) = words_of(model)
    assert re.search(r"by 100 um .* to about [\d.e-]+ \([\d.]+ per metre\)", motion)
    assert re.search(r"by 1 mrad to about [\d.e-]+ \([\d.]+ per radian\)", motion)


def test_a_stress_of_nothing_but_internal_motions_is_not_both() -> None:
    """Sheets that are divided and not declared move inside: that is not what a designer asks."""
    model = Model()
    a, b = np.zeros(3), np.array([0.1, 0.0, 0.0])
    p, q = model.node(*a), model.node(*b)
    middle = model.node(0.05, 0, 0)
    model.sheet(p, middle, (0, 0, 1), name="sheet, 1")
    model.sheet(middle, q, (0, 0, 1), name="sheet, 2")
    model.fix(p)
    model.fix(q)
    result = flexact.analyse(model)
    assert result.under_constrained == 3
    assert both_in_words(result, causes_of(result)) == ()
