# SPDX-License-Identifier: BSD-3-Clause
"""Which of the proven releases are the best: by what they keep."""

from __future__ import annotations

from collections.abc import Sequence

from .designing import frequencies_of, kept_beside
from .elastic_design import Bench
from .measuring import Measures
from .proven import MOST, Candidate

#: Values that agree to so many digits are equal.
_DIGITS = 6


def best(
    measures: Measures, built: Bench, candidates: Sequence[Candidate]
) -> tuple[Candidate, ...]:
    """The best at most: by the worst stiffness kept, then the lowest frequency kept.

    Of those that are equal in both that with the higher first parasitic frequency, then the
    likelier one. One beam an element is enough to tell: the stiffness of a straight sheet is exact
    with it.
    """
    keys = {}
    one = built.with_beams(1)
    for place, candidate in enumerate(candidates):
        bench = one.released(candidate.pairs)
        kept = kept_beside(measures, one, bench)
        worst = 1.0 if kept is None else kept.smallest.value
        found, drives = frequencies_of(measures, bench)
        hertz = () if found is None else tuple(found.value.tolist())
        parasitic = [f for f, is_drive in zip(hertz, drives, strict=False) if not is_drive]
        order = (worst, *hertz[:1], *parasitic[:1])
        keys[place] = (*(-float(f"{value:.{_DIGITS}g}") for value in order), place)
    return tuple(candidates[place] for place in sorted(keys, key=keys.__getitem__)[:MOST])
