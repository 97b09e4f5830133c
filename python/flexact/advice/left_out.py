# SPDX-License-Identifier: BSD-3-Clause
"""What was not looked at, because a mechanism is large or has many motions or self-stresses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..analysis.naming import counted
from ..motion.extent import Reason
from .causes.cause import CauseKind
from .releases.releases import Declarations, Releases

if TYPE_CHECKING:
    from .advice import Advice


def left_out(advice: Advice) -> Iterator[str]:
    """What was not looked at, each in words that stand behind "Left out: "."""
    result = advice.analysis
    for what, count, given in (
        ("motion", result.under_constrained, len(advice.motions)),
        ("self-stress", result.over_constrained, len(advice.self_stresses)),
    ):
        if given < count:
            many = what + ("es" if what.endswith("s") else "s")
            yield f"of {count} {many} all but {given}"
    yield from _of_sets(advice.releases, "releases", "self-stresses")
    yield from _of_sets(advice.declarations, "declarations", "motions")
    causes = advice.causes
    if any(one.kind is CauseKind.UNKNOWN for one in (*causes.motions, *causes.self_stresses)):
        yield "whether another geometry would have them, too"
    yield from advice.failed
    unfollowed = sum(one.reason is Reason.TOO_LARGE for one in advice.extents.motions)
    if unfollowed:
        yield f"how far {counted(unfollowed, 'motion', ' goes', 's go')}: too large to be followed"


def _of_sets(sets: Releases | Declarations, what: str, of: str) -> Iterator[str]:
    if not sets.size:
        return
    if sets.left_out.is_too_large:
        yield f"sets of {what}, for so many {of}"
    elif sets.count is None:
        yield f"how many sets of {what} there are: too many to be counted"
    elif sets.doubtful != 0:
        more = "some sets" if sets.doubtful is None else counted(sets.doubtful, "set", "", "s")
        yield f"from the count {more} of {what} more, which rounding leaves in doubt"
