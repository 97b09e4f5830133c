# SPDX-License-Identifier: BSD-3-Clause
"""What has changed from one result to the next, in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from ...analysis.result import Result
from .messages import Told, told_of

_ARROW = "\N{RIGHTWARDS ARROW}"
#: Counts that need no word of their own where the verdict says them.
_IN_VERDICT = ("motions", "self-stresses")


def changed_between(before: Result, after: Result) -> str:
    """What has changed from one result to another: "over-constrained by 1 → exactly constrained".

    Where the verdict stays, what else has changed: counts, margin, motions and self-stresses.
    """
    return changed_words(told_of(before), told_of(after))


def changed_words(before: Told, after: Told) -> str:
    """The same of what was told of them."""
    if before.verdict != after.verdict:
        start = f"{before.verdict} {_ARROW} {after.verdict}"
        rest = [*_counts(before, after), *_certainty(before, after)]
    else:
        start = f"still {after.verdict}"
        motions, stresses = after.counts["motions"], after.counts["self-stresses"]
        rest = [
            *_counts(before, after),
            *_certainty(before, after),
            *_margin(before, after),
            *_modes(("motion", "s"), before.motions, after.motions, motions),
            *_modes(("self-stress", "es"), before.stresses, after.stresses, stresses),
        ]
        if not rest:
            return f"{start}; nothing has changed that the analysis sees"
    return "; ".join([start, *rest])


def _counts(before: Told, after: Told) -> Iterator[str]:
    for name, now in after.counts.items():
        was = before.counts[name]
        if was != now and name not in _IN_VERDICT:
            yield f"{name} {was} {_ARROW} {now}"


def _certainty(before: Told, after: Told) -> Iterator[str]:
    if before.is_doubtful != after.is_doubtful:
        yield "the rank is now doubtful" if after.is_doubtful else "the rank is no longer doubtful"


def _margin(before: Told, after: Told) -> Iterator[str]:
    if before.margin != after.margin:
        yield f"{before.margin} {_ARROW} {after.margin.removeprefix('margin ')}"


def _modes(
    word: tuple[str, str], before: Sequence[str], after: Sequence[str], count: int
) -> Iterator[str]:
    """How many motions or self-stresses are others than they were."""
    what, ending = word
    new = sum((Counter(after) - Counter(before)).values())
    if not new or len(before) != len(after):
        return
    if count == 1:
        yield f"the {what} is another"
        return
    many = f"{what}{ending}"
    of = f"{count} {many}" if count == len(after) else f"the first {len(after)} {many}"
    yield f"{new} of {of} {'is another' if new == 1 else 'are others'}"
