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


@pytest.mark.parametrize("answer", ANSWERS, ids=[answer.id for answer in ANSWERS])
def test_closed_form_is_met(answer: Answer) -> None:
    found = package(answer)
    if not np.any(np.isnan(answer.value)):
        np.testing.assert_allclose(found, answer.value, rtol=answer.rel, atol=answer.abs)
    # the same element, computed apart: both differ from the closed form alike
    np.testing.assert_allclose(found, oracle(answer), rtol=1e-6, atol=max(answer.abs, 1e-13))


@pytest.mark.parametrize("answer", ANSWERS, ids=[answer.id for answer in ANSWERS])
def test_oracle_meets_the_closed_form(answer: Answer) -> None:
    if not np.any(np.isnan(answer.value)):
        np.testing.assert_allclose(oracle(answer), answer.value, rtol=answer.rel, atol=answer.abs)
