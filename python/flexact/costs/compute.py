# SPDX-License-Identifier: BSD-3-Clause
"""What given misalignments do to a design, with all of the nonlinearity."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..analysis.places import part_words
from ..core.arrays import FloatArray
from ..elasticity import ElasticError, Estimate, State, StrokeError
from ..model.parts.parts import Parts
from .designs import Effect
from .elastic_design import Bench
from .measuring import Measures, number, numbers, over_levels
from .values import Misalignment, Numbers

Given = Sequence[tuple[Misalignment, float]]
#: How often the part of an error that can be reached is halved.
_HALVINGS = 12


def effect_of(bench: Bench, measures: Measures, given: Given, parts: Parts) -> Effect:
    """Before and behind misalignments that act together.

    Where no equilibrium is found with all of them, they are taken in proportion as far as one is.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts, or nothing of it was
            reached.
    """
    behind, reached = _behind(bench, given)
    both = (bench.rest, behind)
    kept = over_levels(measures.worst, *both)
    carried = [numbers(over_levels(_largest, each)) for each in both]
    peak, where = _peaks(bench, both)
    hertz = None
    if measures.has_masses:
        hertz = _both([numbers(over_levels(measures.frequencies, each)) for each in both])
    return Effect(
        hertz if hertz is not None and hertz.value.size else None,
        _both([numbers(over_levels(measures.stiffness, each)) for each in both]),
        _first([numbers(over_levels(lambda s: np.array([s.energy]), each)) for each in both]),
        _both(carried),
        peak,
        part_words(parts.of_element(where)),
        number(Estimate(kept.value[0], kept.uncertainty[0])),
        all(each.is_stable for each in behind.alone),
        reached,
    )


def _behind(bench: Bench, given: Given) -> tuple[State, float]:
    """The state with the misalignments, or with the largest part of them that is found."""

    def with_part(part: float) -> State:
        off = [(each.clamp.node, each.direction, part * value, each.about) for each, value in given]
        return bench.elastic.imperfect(misaligned=off, beyond=True).assembled()

    part, why = 1.0, None
    for _ in range(_HALVINGS):
        try:
            return with_part(part), part
        except StrokeError as error:
            why = why or error
            # A hair less than what was reached, or half where nothing was.
            reached = abs(error.reached / given[0][1]) if len(given) == 1 else error.reached
            part = reached * 0.999 if 0.0 < reached < part else part / 2.0
    raise ElasticError(f"no equilibrium was found with these misalignments: {why}")


def _largest(state: State) -> FloatArray:
    """(3,) largest normal force [N], torque and bending moment [N m] of any element, in size."""
    made: FloatArray = np.abs(_of_elements(state)).max(axis=0)
    return made


def _of_elements(state: State) -> FloatArray:
    """(elements, 3) normal force, torque and largest bending moment."""
    rows = []
    for element in state.model.data.arrays.element_number.tolist():
        own = state.resultants(element)
        bending = max(np.abs(own.moment_y).max(), np.abs(own.moment_z).max())
        rows.append((own.normal_force, own.torque, bending))
    return np.array(rows)


def _peaks(bench: Bench, both: Sequence[State]) -> tuple[Numbers | None, int]:
    """(2,) largest stress before and behind, and the index of the element that has it behind.

    None of it where no section is known: then the element with the largest moment, or force.
    """
    known = _known(both[1])
    if not known:
        sizes = np.abs(_of_elements(both[1]))
        moment = sizes[:, 1:].max(axis=1)
        column = moment if moment.any() else sizes[:, 0]
        return None, int(np.argmax(column))
    found = [
        numbers(over_levels(lambda s: np.array([s.peak_stress(e) for e in known]), each))
        for each in both
    ]
    index = bench.data.element_index[known[int(np.argmax(found[1].value))]]
    best = [int(np.argmax(each.value)) for each in found]
    peak = Numbers(
        np.array([each.value[k] for each, k in zip(found, best, strict=True)]),
        np.array([each.uncertainty[k] for each, k in zip(found, best, strict=True)]),
    )
    return peak, index


def _known(state: State) -> list[int]:
    """Numbers of the elements whose section is known and that carry something."""
    made = []
    finest = state.alone[-1]
    for element in state.model.data.arrays.element_number.tolist():
        try:
            finest.peak_stress(element)
        except ElasticError:
            continue
        if finest.model.policy.stiff[:, finest.model.data.element_index[element]].any():
            made.append(element)
    return made


def _both(rows: Sequence[Numbers]) -> Numbers:
    """(2, k) of two rows, as long as the shorter one."""
    count = min(row.value.size for row in rows)
    return Numbers(
        np.array([row.value[:count] for row in rows]),
        np.array([row.uncertainty[:count] for row in rows]),
    )


def _first(rows: Sequence[Numbers]) -> Numbers:
    """(2,) of two rows with one number."""
    both = _both(rows)
    return Numbers(both.value[:, 0], both.uncertainty[:, 0])
