# SPDX-License-Identifier: BSD-3-Clause
"""At a glance what over-constraint costs: the first line of `flexact cost`, quickly."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..analysis.places import part_words
from ..analysis.result import Result
from ..core.arrays import BoolArray, FloatArray
from ..elasticity import Estimate, elastic
from ..elasticity.reduced import resultants_of
from ..elasticity.solution import Solution
from ..elasticity.tolerance import MISMATCH
from ..model.model import Model
from ..model.parts.parts import PartKind
from ..util.errors import FlexactError
from ..util.matrices import first_largest
from ..util.records import cached_property
from ..util.text import TIE, harmless
from .designs import FREQUENCY, STIFFNESS, Misalignment, Number, Tolerance, in_words, smallest
from .elastic_design import ElasticDesign, Level, curve_against, tolerances_of
from .request import SHIFT
from .resolve import Places
from .words import costs, costs_nothing, off

#: Of more elements, or errors, it would no longer be a glance.
_MOST, _MOST_ERRORS = 1000, 600
#: Nor would errors times beams be that, of which each is looked at: 0.3 s.
_MOST_LOOKED_AT = 16_000
#: How many errors that are about as tight are looked at with both divisions.
_MOST_NEAR = 6
#: The error that is told where that is too much [m, rad].
_SMALL = 1.0e-6


def quick_cost(result: Result) -> str:
    """A sentence on the clamp and direction that matter most; empty where nothing is known.

    Only of over-constrained models with stiffness (ESTIFF) that are not very large. It is the
    first line of `flexact cost`, with the stress at that error and where it buckles; of a model
    that would take longer the stress that a small error causes, to first order.
    """
    if not _is_quick(result):
        return ""
    try:
        return _QuickCost(result).sentence()
    except FlexactError:
        return ""


class QuickCurve(NamedTuple):
    """What the error that matters most does in the directions in which it can be off."""

    words: str
    """Such as "clamp 11 along x"."""
    unit: str
    """Of its size: m or rad."""
    values: FloatArray
    """(n,) sizes, ascending through 0."""
    has_masses: bool
    """Whether what is measured is the first frequency [Hz], else the lowest stiffness."""
    measure: FloatArray
    """(n,) of it; 0 where it buckles."""
    elements: tuple[int, ...]
    """Numbers of the flexures whose section is known."""
    peaks: FloatArray
    """(elements,) largest normal stress [Pa], of an error of size 1, in proportion to it."""
    strengths: FloatArray
    """(elements,) their strength [Pa], of fatigue where it is given; NaN where none is."""

    def data(self) -> dict[str, Any]:
        """As pages take it: of no masses the measure is in parts of that without an error."""
        rest = 1.0 if self.has_masses else float(self.measure[self.values == 0.0][0])
        return {
            "words": harmless(self.words),
            "unit": self.unit,
            "values": self.values.tolist(),
            "name": FREQUENCY if self.has_masses else STIFFNESS,
            "hertz": self.has_masses,
            "measure": (self.measure / rest).tolist(),
            "elements": list(self.elements),
            "peaks": self.peaks.tolist(),
            # Against which the stress is seen, where all of them have one.
            **({} if np.isnan(self.strengths).any() else {"strengths": self.strengths.tolist()}),
        }


def quick_curve(result: Result) -> dict[str, Any] | None:
    """What the error that `quick_cost` tells does, as pages take it; None where it tells none."""
    if not _is_quick(result):
        return None
    try:
        curve = _QuickCost(result).curve()
    except FlexactError:
        return None
    return None if curve is None else curve.data()


def _is_quick(result: Result) -> bool:
    data = result.given
    is_small = data.arrays.element_number.size <= _MOST
    return bool(result.over_constrained) and is_small and data.has_stiffness


class _QuickCost:
    """What the sentence is made of: the errors of a result that cost something."""

    def __init__(self, result: Result) -> None:
        self.result, self.data, self.size = result, result.given, result.given.size
        self.places = Places(self.data, result.parts)
        self.errors = self.places.misalignments()

    @cached_property
    def designs(self) -> tuple[ElasticDesign, ElasticDesign]:
        """The design, and that with one beam a sheet."""
        drives = self.places.drives()
        node = drives[0][0] if drives else self.places.point(None).node
        model = replace(elastic(Model.from_data(self.data)), is_si=True)
        mechanism = ElasticDesign(model, self.data.node_index[node])
        return mechanism, replace(mechanism, elastic=replace(model, beams=1))

    @cached_property
    def order(self) -> list[Misalignment]:
        """The errors that cost something, that which matters most first."""
        is_glance = 0 < len(self.errors) <= _MOST_ERRORS
        return self._in_order(self.designs[1]) if is_glance else []

    @property
    def is_too_much(self) -> bool:
        """Whether to look at each error takes too long."""
        elements = self.designs[0].levels[-1].solution.solver.elements
        return len(self.errors) * elements > _MOST_LOOKED_AT

    def curve(self) -> QuickCurve | None:
        if not self.order or self.is_too_much:
            return None
        mechanism = self.designs[0]
        found = self._tightest(mechanism, self.order)
        if found is None:
            return None
        critical, size = found.critical, found.tightest.value
        made = curve_against(mechanism, found, critical.value if critical.is_finite else 4.0 * size)
        states = self._states(mechanism, found.misalignment, size)
        known = self._known(mechanism, states[-1])
        if not known:
            return None
        peaks, numbers = _of(states, known, _peak) / size, self.data.arrays.element_number
        given = self.data.properties
        strengths = np.full(len(known), np.nan)
        if given is not None:
            strength, fatigue = given.strength[known].T
            strengths = np.where(np.isnan(fatigue), strength, fatigue)
        return QuickCurve(
            *(found.misalignment.words, found.misalignment.unit, made.values),
            *(mechanism.has_masses, made.measure.value),
            *(tuple(numbers[known].tolist()), peaks.reshape(-1)),
            strengths,
        )

    def sentence(self) -> str:
        if not (order := self.order):
            return ""
        mechanism, one = self.designs
        if self.is_too_much:
            words = off(order[0], Number(_SMALL))
            loads = self._loads(one, order[0], _SMALL)
            return f"It costs: {words} loads {loads}, to first order. {self._more()}"
        name = FREQUENCY if mechanism.has_masses else STIFFNESS
        found = self._tightest(mechanism, order)
        if found is None:
            return f"{costs_nothing(name, SHIFT, self.size)}. {self._more()}"
        return f"{costs(found, name, SHIFT, True)}{self._behind(mechanism, found)}. {self._more()}"

    def _more(self) -> str:
        if self.data.source is None or not self.result.name:
            return "flexact.cost(model) has all clamps and directions."
        deck = shlex.quote(harmless(self.result.name)).replace(" ", TIE)
        return f"flexact{TIE}cost{TIE}{deck} has all clamps and directions."

    def _in_order(self, one: ElasticDesign) -> list[Misalignment]:
        """Errors that store energy, that which stores most for its length first.

        Energy is linear, and exact with the deck's own elements.
        """
        shift, answer = Level(one, one.rest.finest).response(self.errors)
        if answer.loose.shape[2]:
            return []
        energy = 0.5 * np.einsum("cnk,cnk->k", shift, answer.reaction)
        energy = np.where(answer.mismatch > MISMATCH, 0.0, energy)
        share = energy / self._lengths(self.errors) ** 2 / max(energy.max(), 1e-300)
        order = np.argsort(-np.round(share, 6), kind="stable").tolist()
        return [self.errors[k] for k in order if energy[k] > 0.0]

    def _lengths(self, errors: tuple[Misalignment, ...] | list[Misalignment]) -> FloatArray:
        return np.array([self.size if each.unit == "rad" else 1.0 for each in errors])

    def _tightest(self, mechanism: ElasticDesign, order: list[Misalignment]) -> Tolerance | None:
        """The tolerance that `flexact cost` would find tightest; None where it finds none.

        With the coarser division all but those that are about as tight are ruled out.
        """
        coarse = mechanism.levels[0]
        stresses, lengths = coarse.stresses(order), self._lengths(order)
        able: BoolArray = np.asarray(np.isfinite(stresses).all(axis=(0, 1)))
        stresses = np.asfortranarray(stresses[:, :, able])
        some = [each for each, fits in zip(order, able, strict=True) if fits]
        least = (
            np.abs(coarse.errors(stresses, coarse.square_at(SHIFT), lengths=lengths[able])).min(
                axis=1
            )
            * lengths[able]
        )
        # Of equal ones, which symmetry makes, the first of the model is enough.
        first = sorted(np.flatnonzero(np.isfinite(least)), key=lambda k: self.errors.index(some[k]))
        near = {f"{least[k]:.5g}": some[k] for k in reversed(first)}
        chosen = sorted(near.values(), key=self.errors.index)[:_MOST_NEAR]
        if len(chosen) > 1:
            # The one with which less is enough, with both divisions.
            each_level = (
                level.errors(np.asfortranarray(level.stresses(chosen)), level.square_at(SHIFT))
                for level in mechanism.levels
            )
            sizes = np.abs(Estimate.of(*each_level).value).min(axis=1) * self._lengths(chosen)
            chosen = [chosen[int(np.argmin([float(f"{size:.5g}") for size in sizes]))]]
        made = tolerances_of(mechanism, chosen, SHIFT, self.size, lambda _done: None)
        return smallest(made, self.size, lambda each: each.tightest)

    def _behind(self, mechanism: ElasticDesign, found: Tolerance) -> str:
        """What is stressed most at the tolerance, and where the same error makes it buckle."""
        loads = self._loads(mechanism, found.misalignment, found.tightest.value)
        told = f" and loads {loads}" if loads else ""
        if not found.critical.is_finite:
            return told
        return f"{told}; at {in_words(found.critical, found.misalignment.unit)} it buckles"

    def _loads(self, mechanism: ElasticDesign, each: Misalignment, size: float) -> str:
        """Such as "sheet 1 with 12 MPa": the flexure that an error stresses most, linearly."""
        parts, which = self.result.parts, self._flexures(mechanism)
        states = self._states(mechanism, each, size)
        known = self._known(mechanism, states[-1])
        if known:
            values, unit = _of(states, known, _peak), "Pa"
        else:
            values, unit = _of(states, which, _moment_and_force), "N m"
            values, unit = (values[:, 0], unit) if values[:, :1].any() else (values[:, 1], "N")
        values = values.reshape(-1)
        if not values.any():
            return ""
        most = first_largest(values)
        what = part_words(parts.of_element((known or which)[most]))
        return f"{what} with {in_words(Number(float(f'{values[most]:.3g}')), unit)}"

    def _flexures(self, mechanism: ElasticDesign) -> list[int]:
        """Indices of elements that are no bodies and have a stiffness."""
        stiff, parts = mechanism.elastic.policy.stiff.any(axis=0), self.result.parts
        every = np.flatnonzero(stiff).tolist()
        return [e for e in every if parts.of_element(e).kind is not PartKind.BODY]

    def _states(self, mechanism: ElasticDesign, each: Misalignment, size: float) -> list[Solution]:
        """Under an error of a size, of each number of beams."""
        return [
            level.solution.under(size * level.stresses((each,))[:, :, 0])
            for level in mechanism.levels
        ]

    def _known(self, mechanism: ElasticDesign, at: Solution) -> list[int]:
        """Those flexures whose section is known."""
        is_known = at.solver.sections.is_known
        return [e for e in self._flexures(mechanism) if is_known[e]]


def _peak(at: Solution, element: int) -> tuple[float]:
    return (float(at.peaks.normal[element]),)


def _of(
    states: list[Solution], which: list[int], of: Callable[[Solution, int], tuple[float, ...]]
) -> FloatArray:
    """(elements, k) numbers of elements, extrapolated."""
    made = [np.array([of(at, e) for e in which]) for at in states]
    return np.asarray(np.abs(Estimate.of(*made).value))


def _moment_and_force(at: Solution, element: int) -> tuple[float, float]:
    """The largest moment [N m], and the normal force [N], of an element."""
    carried = resultants_of(at.solver.mesh.own, element, at.stress[:, element])
    moments = (abs(carried.torque), *np.abs(carried.moment_y), *np.abs(carried.moment_z))
    return max(moments), abs(carried.normal_force)
