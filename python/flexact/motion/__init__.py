# SPDX-License-Identifier: BSD-3-Clause
"""Configurations in which the held deformations stay zero: where a motion leads."""

from .constraints import MOST_COORDINATES, Held, Place, is_followed
from .ending import Ending, Stop
from .follow import follow, follow_both_ways
from .followed import Followed, Wishes
from .station import Station
from .stations import Least, least_error

__all__ = [
    "MOST_COORDINATES",
    "Ending",
    "Followed",
    "Held",
    "Least",
    "Place",
    "Station",
    "Stop",
    "Wishes",
    "follow",
    "follow_both_ways",
    "is_followed",
    "least_error",
]
