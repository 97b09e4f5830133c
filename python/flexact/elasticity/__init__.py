# SPDX-License-Identifier: BSD-3-Clause
"""Elastic states, strokes and misalignment; uses `core`, `model`, `deck` and `result`."""

from .elastic import Elastic, elastic
from .errors import ElasticError, Estimate, StrokeError, StrokeWarning, UnknownError
from .state import State

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
