# SPDX-License-Identifier: BSD-3-Clause
"""Elastic states, strokes and misalignment of models with stiffness and mass."""

from .elastic import Elastic, State, Warmed, elastic
from .errors import ElasticError, Estimate, StrokeError, StrokeWarning, UnknownError
from .tables import PointTable, StrokeTable

__all__ = [
    "Elastic",
    "ElasticError",
    "Estimate",
    "PointTable",
    "State",
    "StrokeError",
    "StrokeTable",
    "StrokeWarning",
    "UnknownError",
    "Warmed",
    "elastic",
]
