# SPDX-License-Identifier: BSD-3-Clause
"""A little of the attack on advice, tests/attack/run_steps.py: nothing that it says is false."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).resolve().parents[1]))

from attack.advised import offences
from attack.mechanisms import mechanism

SEED = 2028


@pytest.mark.parametrize("number", range(24))
def test_no_advice_is_false(number: int) -> None:
    """Steps and statements give the counts that they say, hardware likewise; causes are enough."""
    model = mechanism(SEED, number)
    assert list(offences(model.to_deck() if number // 8 % 2 else model)) == []
