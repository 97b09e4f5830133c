# SPDX-License-Identifier: BSD-3-Clause
"""What each flexure holds, and how well, in words."""

from __future__ import annotations

from collections.abc import Sequence

from ..analysis.result import Result
from ..analysis.sentences import plain
from .holding import Hold, worst_first
from .spaces.words import wrenches_in_words

#: What the number is.
MEANING = "the sine of the smallest angle to what all others hold: 1 on its own, 0 over-constrained"
#: So many are named in a caption.
_MOST = 6


def number_of(hold: Hold) -> str:
    """How well it holds, in two digits; never 0 or 1 where it is not."""
    return f"{hold.sine:.2f}" if hold.sine >= 0.005 else f"{hold.sine:.0e}"


def hold_in_words(result: Result, hold: Hold) -> str:
    """What a flexure holds, a sentence."""
    held = "; ".join(map(plain, wrenches_in_words(result, hold.space)))
    few = hold.space.dimension
    count = f"{few} independent force{'s' * (few > 1)} or moments: " if few > 1 else ""
    verb = "hold" if len(hold.parts) > 1 else "holds"
    name = f"{hold.name[:1].upper()}{hold.name[1:]}"
    return f"{name} {verb} {count}{held}. How well: {number_of(hold)}, {MEANING}."


def holds_in_words(holds: Sequence[Hold]) -> str:
    """How well each flexure holds, the worst first, a sentence."""
    worst = list(worst_first(tuple(holds)))
    told = "; ".join(f"{hold.name}: {number_of(hold)}" for hold in worst[:_MOST])
    more = f"; and {len(worst) - _MOST} more" if len(worst) > _MOST else ""
    return f"What each flexure holds, and how well ({MEANING}): {told}{more}."
