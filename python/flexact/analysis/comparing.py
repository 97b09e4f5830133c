# SPDX-License-Identifier: BSD-3-Clause
"""What differs between two runs of a deck, in words: two results, or results kept as JSON."""

from .comparing_change import Change, Gravity, change_of
from .differences import Side, SideError, broken_side, side_of, stored_side

__all__ = [
    "Change",
    "Gravity",
    "Side",
    "SideError",
    "broken_side",
    "change_of",
    "side_of",
    "stored_side",
]
