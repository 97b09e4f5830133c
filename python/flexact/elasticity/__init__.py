# SPDX-License-Identifier: BSD-3-Clause
"""Elastic states, strokes and misalignment; uses `core`, `model`, `deck` and `result`."""

from .elastic import Elastic, elastic
from .errors import Estimate
from .state import State
from .stiffness_errors import ElasticError, StrokeError, StrokeWarning, UnknownError

__all__ = [
    "Elastic",
    "ElasticError",
    "Estimate",
    "State",
    "StrokeError",
    "StrokeWarning",
    "UnknownError",
    "elastic",
]
