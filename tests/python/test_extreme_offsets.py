# SPDX-License-Identifier: BSD-3-Clause
"""A mechanism that stands up to 1e8 of its lengths from the origin keeps its verdict.

The stored coordinates have lost eight digits there, so that a certain answer cannot be asked
for, but the counts are those of the deck, and stay so if what is in doubt is zero.
"""

import numpy as np
import pytest
from reference_decks import NAMES, text_of, transform, truth_of
from verdicts import METHODS, assert_right_or_nearly, counts

from flexact import Model, analyse, read_text


def size_of(model: Model) -> float:
    """Largest extent of the drawing along an axis."""
    return float(np.max(np.ptp(model.positions, axis=0), initial=0.0))


def direction_of(model: Model) -> np.ndarray:
    return np.array([0.7310585786300049, -0.5963, 0.0 if model.planar else 0.4123105625617661])


@pytest.mark.grid
@pytest.mark.parametrize("far", [1e4, 1e8])
@pytest.mark.parametrize("name", NAMES)
def test_every_method_far_from_the_origin(name: str, far: float) -> None:
    """In characteristic lengths, and in sizes of the whole drawing."""
    here = read_text(text_of(name))
    for length in {analyse(here).characteristic_length, size_of(here)}:
        there = read_text(transform.moved(text_of(name), far * length * direction_of(here)))
        for method in METHODS:
            analysis = analyse(there, method=method)
            assert counts(analysis) == truth_of(name)
            assert analysis.nearly is None or analysis.nearly[:2] == truth_of(name)


@pytest.mark.grid
@pytest.mark.parametrize("factor", [1e-9, 1e9])
@pytest.mark.parametrize("name", NAMES)
def test_far_from_the_origin_in_other_units(name: str, factor: float) -> None:
    here = read_text(text_of(name))
    move = 1e8 * factor * analyse(here).characteristic_length * direction_of(here)
    there = transform.moved(transform.scaled(text_of(name), factor), move)
    for method in METHODS:
        assert_right_or_nearly(analyse(read_text(there), method=method), truth_of(name))
