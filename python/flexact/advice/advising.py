# SPDX-License-Identifier: BSD-3-Clause
"""Advice as users meet it: what is wrong and why, and steps that mend it; uses `text` and below."""

from .advice import Advice, advice_of
from .steps import Step

__all__ = ["Advice", "Step", "advice_of"]
