# SPDX-License-Identifier: BSD-3-Clause
"""Words do not depend on how elements are told: the sense of a width, and which end is p."""

import pytest
from reference_decks import NAMES, text_of
from turned_elements import plain, turned

import flexact


@pytest.mark.parametrize("name", NAMES)
def test_a_result_is_told_in_the_same_words(name: str) -> None:
    data = flexact.read_text(text_of(name), name).data
    words = flexact.analyse(flexact.Model.from_data(plain(data))).describe()
    for seed in range(2):
        assert flexact.analyse(turned(data, seed)).describe() == words
