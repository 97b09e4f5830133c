# SPDX-License-Identifier: BSD-3-Clause
"""What outputs print can be pasted: statements and calls give the counts that are said."""

import pytest
from pasting import notes_in, pasted

from flexact import FlexactError, Model

DECK = "BEAM 1 1 2 3 4 0 1 0\nX 3 0.1 0 0\nFIX 1\nFIX 2\nRLSE 1 2 5 6\nEND\nHALT\n"


def sheet() -> Model:
    model = Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), "y", name="leaf (1)")
    model.fix((0, 0, 0))
    return model


def test_notes_are_found_where_names_hold_parentheses() -> None:
    call = 'model.release("leaf (1)", "in-plane bending", at=(0, 0, 0))'
    assert notes_in(f"Cut it (free there) ({call}, {call}); likewise (b).") == [f"{call}, {call}"]
    words = "Declare it (DYNX 1 2, DYNX\n 4 1), or hold it (FIX 1 2). It is (0, 1) m off."
    assert notes_in(words) == ["DYNX 1 2, DYNX 4 1", "FIX 1 2"]


def test_a_deck_is_edited_as_a_note_says() -> None:
    assert pasted(DECK) == (3, 0)
    assert pasted(DECK, "DYNX 3 2 or FIX 3 2") == (2, 0)
    assert pasted(DECK, "without RLSE 1 2 5") == (1, 0)
    assert pasted(DECK, "DYNE 1 2 instead of RLSE 1 2", "RLSE 1 2 instead") == (3, 0)
    assert pasted(DECK, "DYNX 3 2", "without DYNX 3 2") == (3, 0)
    with pytest.raises(AssertionError):
        pasted(DECK, "without RLSE 1 3")
    with pytest.raises(AssertionError):
        pasted(DECK, "DYNX 3 2, ...")


def test_calls_are_made_on_a_copy_of_the_model_as_its_script_left_it() -> None:
    model = sheet()
    assert pasted(model, 'model.independent((0.1, 0, 0), "z")') == (2, 0)
    assert pasted(model) == (3, 0)
    with pytest.raises(FlexactError):
        pasted(model, 'model.independent("nowhere", "z")')
