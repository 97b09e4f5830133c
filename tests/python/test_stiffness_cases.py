# SPDX-License-Identifier: BSD-3-Clause
"""Known answers about stiffness, frequencies, buckling, strokes and misalignment.

Each case names its source; `reference` is what an independent program finds with the deck's own
elements, which the same element must meet far more closely than the closed form.
"""

import json
from typing import Any

import numpy as np
import pytest
from reference_decks import REFERENCE
from stiffness_quantities import Case

import flexact

CASES = json.loads((REFERENCE / "stiffness_cases.json").read_text(encoding="utf-8"))["cases"]


def elastic(text: str, **options: Any) -> Any:
    return flexact.elastic(flexact.read_text(text), **options)


@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_known_answer_is_met(case: dict[str, Any]) -> None:
    found = Case(elastic, case).values()
    tolerance = case["tolerance"]
    np.testing.assert_allclose(
        found,
        np.ravel(case["value"]),
        rtol=tolerance.get("rel", 0.0),
        atol=tolerance.get("abs", 0.0),
    )
    # a reference that is zero is zero to the tolerance of its value
    np.testing.assert_allclose(
        found, np.ravel(case["reference"]), rtol=1e-5, atol=tolerance.get("abs", 0.0) * 1e-3
    )
