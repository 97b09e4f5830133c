# SPDX-License-Identifier: BSD-3-Clause
"""Words do not depend on how elements are told: the sense of a width, and which end is p.

Calls of Python do, as a row of beams has a name only if each goes on where the one before ends,
and a body stands for the first point of its first link; they do what is said for all that.
"""

import pytest
from pasting import analysis_pasted, without_notes
from reference_decks import NAMES, text_of
from turned_elements import plain, turned

import flexact
from flexact import Model


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES)
def test_a_result_is_told_in_the_same_words(name: str) -> None:
    data = flexact.read_text(text_of(name), name).data
    words = without_notes(flexact.analyse(Model.from_data(plain(data))).describe(verbose=True))
    for seed in range(2):
        result = flexact.analyse(turned(data, seed))
        model = Model.from_data(result.given)
        assert without_notes(result.describe(verbose=True)) == words
        assert [each for each in analysis_pasted(model, result) if not each.is_right] == []
