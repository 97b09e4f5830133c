# SPDX-License-Identifier: BSD-3-Clause
"""Random mechanisms against the oracle, which shares nothing with the package.

Loads and strokes are small enough for one path: far ones may cross a bifurcation, behind which
two programs may follow different branches and both be right.
"""

import importlib
import sys
from typing import Any

import numpy as np
import pytest
from random_elastic import QUESTIONS, Draw
from reference_decks import REFERENCE

import flexact

sys.path.append(str(REFERENCE / "elastic"))
Oracle: Any = importlib.import_module("states").Oracle

#: Refined ones divide a row of beams by its own rule.
ASKED = [name for name in QUESTIONS if "three beams" not in name and name != "kept"]
SEEDS = (1, 6, 9, 12)


class Once:
    """A model that remembers its loaded state, for which many questions ask."""

    def __init__(self, model: Any) -> None:
        self.model, self.loaded = model, None

    def __getattr__(self, name: str) -> Any:
        return getattr(self.model, name)

    def equilibrium(self) -> Any:
        self.loaded = self.loaded or self.model.equilibrium()
        return self.loaded


def flat(answer: Any) -> Any:
    parts = answer if isinstance(answer, (list, tuple)) else [answer]
    if not parts:
        return np.zeros(0)
    return np.concatenate([np.ravel(np.asarray(part, dtype=float)) for part in parts])


def nearest(values: Any) -> Any:
    """The eight nearest to zero, without those that are rounding."""
    size = np.abs(values)
    there = values[size < 1e6 * np.min(size, initial=np.inf)]
    return np.sort(there[np.argsort(np.abs(there))[:8]])


@pytest.mark.parametrize("seed", SEEDS)
def test_random_mechanism_as_by_the_oracle(seed: int) -> None:
    draw = Draw(seed, 0.1)

    def package(**options: Any) -> Any:
        return flexact.elastic(flexact.read_text(draw.text), **({"beams": 1} | options))

    plain = Once(Oracle(draw.text))

    def oracle(**options: Any) -> Any:
        return Oracle(draw.text, **options) if options else plain

    for name in ASKED:
        found, truth = flat(QUESTIONS[name](draw, package)), flat(QUESTIONS[name](draw, oracle))
        if "multipliers" in name:
            found, truth = nearest(found), nearest(truth)
        rounding = 1e-7 * np.max(np.abs(truth[np.isfinite(truth)]), initial=0.0)
        if "frequencies" in name or "multipliers" in name:
            rounding = 0.0
        np.testing.assert_allclose(found, truth, rtol=1e-5, atol=rounding, err_msg=name)
