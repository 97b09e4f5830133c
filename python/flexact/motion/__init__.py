# SPDX-License-Identifier: BSD-3-Clause
"""Configurations in which the held deformations stay zero: where a motion leads."""

from .constraints import MOST_COORDINATES, Held, Place, is_followed
from .follow import Ending, Followed, Stop, Wishes, follow
from .stations import Station, least_error

__all__ = [
    "MOST_COORDINATES",
    "Ending",
    "Followed",
    "Held",
    "Place",
    "Station",
    "Stop",
    "Wishes",
    "follow",
    "is_followed",
    "least_error",
]
