# SPDX-License-Identifier: BSD-3-Clause
"""Known answers beyond the public cases, and the oracle that shares nothing with the package."""

import importlib
import sys
from typing import Any

import numpy as np
import pytest
from reference_decks import REFERENCE
from stiffness_answers import ANSWERS, Answer

import flexact

sys.path.append(str(REFERENCE / "elastic"))
Oracle: Any = importlib.import_module("states").Oracle


def package(answer: Answer) -> Any:
    def model(**options: Any) -> Any:
        return flexact.elastic(flexact.read_text(answer.deck), **({"beams": 1} | options))

    return np.asarray(answer.ask(model), dtype=float)


def oracle(answer: Answer) -> Any:
    def model(**options: Any) -> Any:
        return Oracle(answer.deck, **options)

    return np.asarray(answer.ask(model), dtype=float)


@pytest.mark.grid
@pytest.mark.parametrize("answer", ANSWERS, ids=[answer.id for answer in ANSWERS])
def test_closed_form_is_met(answer: Answer) -> None:
    found = package(answer)
    if answer.value is not None:
        np.testing.assert_allclose(found, answer.value, rtol=answer.rel, atol=answer.abs)
    # the same element, computed apart: both differ from the closed form alike
    truth = oracle(answer)
    rounding = 1e-9 * np.max(np.abs(truth[np.isfinite(truth)]), initial=0.0)
    np.testing.assert_allclose(found, truth, rtol=1e-6, atol=max(answer.abs, rounding))


KNOWN = [answer for answer in ANSWERS if answer.value is not None]


@pytest.mark.parametrize("answer", KNOWN, ids=[answer.id for answer in KNOWN])
def test_oracle_meets_the_closed_form(answer: Answer) -> None:
    np.testing.assert_allclose(oracle(answer), answer.value, rtol=answer.rel, atol=answer.abs)
