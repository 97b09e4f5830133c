# SPDX-License-Identifier: BSD-3-Clause
"""What a release costs of stiffness, where that is known."""

from __future__ import annotations

from collections.abc import Callable

from ...core.arrays import FloatArray, IntArray
from ...result.result import Result
from .reach import Reach


def cost_of(result: Result, reach: Reach) -> Callable[[IntArray], FloatArray] | None:
    """The cost of sets of rows; None where the stiffness of what is stressed is not known."""
    return None
