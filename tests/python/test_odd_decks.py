# SPDX-License-Identifier: BSD-3-Clause
"""Odd decks that fuzzing found (tests/fuzz): what must hold of every deck did not of these."""

import pytest

import flexact

BAR = "TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\nFIX 2 2 3\n"


def test_an_error_is_shown_however_many_warnings_stand_before_it() -> None:
    text = BAR + "X 2 1 0 0\n" * 150 + "FIX 7\n"
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(text)
    items = caught.value.diagnostics
    assert len(items) == 100
    assert [item.line for item in items if item.is_error] == [155]
    assert [item.line for item in items] == sorted(item.line for item in items)
    assert "FIX 7" in str(caught.value)


def test_names_may_hold_any_number_of_digits() -> None:
    names = [f"wire {digits}" for digits in ("9" * 5000, "1" + "0" * 5000, "12", "0" * 5000 + "3")]
    lines = [f"TRUSS {i} 1 2 % {name}" for i, name in enumerate(names, start=1)]
    analysis = flexact.analyse(flexact.read_text("\n".join([*lines, "X 2 1 0 0", "FIX 1"])))
    assert analysis.over_constrained == 3
    assert analysis.describe() and analysis.to_json()


@pytest.mark.parametrize("comment", ["\u00a0END", "\x85 END", "%\x0b#% END", "\u2028\u3000END"])
def test_comments_that_begin_with_odd_blanks_are_written_once(comment: str) -> None:
    deck = flexact.read_text(f"{BAR}DYNX 2 1 % {comment}\n").to_deck()
    assert "DYNX 2 1 % END\n" in deck
    assert flexact.read_text(deck).to_deck() == deck


def test_numbers_may_begin_with_thousands_of_zeros() -> None:
    zeros = "0" * 5000
    model = flexact.read_text(f"{BAR}DYNX {zeros}2 1 % moves\n")
    assert "DYNX 2 1 % moves\n" in model.to_deck()


def test_a_row_that_begins_and_ends_at_one_orientation_is_no_sheet() -> None:
    """One beam between its ends would have one node at both; the rows of a ring are as well."""
    beams = ("1 1 2 3 4", "2 3 4 5 6", "3 5 6 7 2")
    lines = [f"BEAM {beam} 0 1 0 % sheet, part {beam[0]} of 3" for beam in beams]
    lines += ["X 3 0.1 0 0", "X 5 0.2 0 0", "X 7 0.3 0 0", "FIX 1", "FIX 2", "RLSE 1 5"]
    lines += ["DYNE 2 5", "DYNE 3 5"]
    analysis = flexact.analyse(flexact.read_text("\n".join(lines)))
    assert analysis.rows == analysis.model.deformation_classes.astype(bool).sum() - 1
    assert analysis.to_json() and analysis.describe()
