# SPDX-License-Identifier: BSD-3-Clause
"""Elastic states, strokes and misalignment of models with stiffness and mass."""

from .elastic import Elastic, State, Warmed, elastic
from .errors import ElasticError, Estimate, StrokeError, StrokeWarning, UnknownError
from .limits import Limits
from .state_space import StateSpace
from .tables import PointTable, StrokeTable

__all__ = [
    "Elastic",
    "ElasticError",
    "Estimate",
    "Limits",
    "PointTable",
    "State",
    "StateSpace",
    "StrokeError",
    "StrokeTable",
    "StrokeWarning",
    "UnknownError",
    "Warmed",
    "elastic",
]
