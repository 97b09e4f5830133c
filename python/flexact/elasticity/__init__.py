# SPDX-License-Identifier: BSD-3-Clause
"""Elastic states, strokes and misalignment of models with stiffness and mass."""

from .elastic import Elastic, State, elastic
from .errors import ElasticError, Estimate, StrokeError, StrokeWarning, UnknownError
from .state_space import StateSpace

__all__ = [
    "Elastic",
    "ElasticError",
    "Estimate",
    "State",
    "StateSpace",
    "StrokeError",
    "StrokeWarning",
    "UnknownError",
    "elastic",
]
