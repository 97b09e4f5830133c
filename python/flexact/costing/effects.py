# SPDX-License-Identifier: BSD-3-Clause
"""What given misalignments do to a design, with all of the nonlinearity."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..model.appearance import CrossSection
from ..model.parts.parts import Parts
from ..stiffness import ElasticError, State, StrokeError
from ..stiffness.estimate import Estimate
from ..text.places import part_words
from .bench import Bench, levels
from .designs import Effect
from .measuring import Measures, number, numbers, over_levels
from .values import Misalignment, Numbers

Given = Sequence[tuple[Misalignment, float]]
#: How often the part that is reached is looked for.
_HALVINGS = 6


def effect_of(bench: Bench, measures: Measures, given: Given, parts: Parts) -> Effect:
    """Before and behind the misalignments, that act together.

    Where no equilibrium is found with all of them, they are taken in proportion as far as one is.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts.
    """
    behind, reached = _behind(bench, given)
    both = (bench.rest, behind)
    carried = [_carried(each) for each in both]
    peaks = None if any(each.peak is None for each in carried) else carried
    kept = over_levels(lambda a, b: measures.ratios(a, b).mu[:1], *both)
    return Effect(
        _pair([over_levels(measures.frequencies, each) for each in both])
        if measures.has_masses
        else None,
        _pair([over_levels(measures.stiffness, each) for each in both]),
        _pair([over_levels(lambda s: np.array([s.energy]), each) for each in both], 0),
        _pair([each.largest for each in carried]),
        None if peaks is None else _pair([each.peak for each in carried], 0),
        _where(carried[1], parts),
        number(Estimate(kept.value[0], kept.uncertainty[0])),
        all(each.is_stable for each in levels(behind)),
        reached,
    )
