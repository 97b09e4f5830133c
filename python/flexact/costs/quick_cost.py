# SPDX-License-Identifier: BSD-3-Clause
"""At a glance what over-constraint costs: the first line of `flexact cost`, quickly."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import numpy as np

from ..analysis.places import part_words
from ..analysis.result import Result
from ..core.arrays import BoolArray, FloatArray
from ..elasticity import ElasticError, Estimate, elastic
from ..elasticity.reduced import peak_of, resultants_of
from ..elasticity.solution import Solution
from ..elasticity.tolerance import MISMATCH
from ..model.model import Model
from ..model.parts.parts import PartKind
from ..util.errors import FlexactError
from ..util.text import TIE, harmless
from .designs import FREQUENCY, STIFFNESS, Misalignment, Number, Tolerance, in_words, smallest
from .elastic_design import ElasticDesign, Level, tolerances_of
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
    data = result.given
    too_large = data.arrays.element_number.size > _MOST
    if not result.over_constrained or too_large or not data.has_stiffness:
        return ""
    try:
        return _QuickCost(result).sentence()
    except FlexactError:
        return ""


class _QuickCost:
    """What the sentence is made of: the errors of a result that cost something."""

    def __init__(self, result: Result) -> None:
        self.result, self.data, self.size = result, result.given, result.given.size
        self.places = Places(self.data, result.parts)
        self.errors = self.places.misalignments()

    def sentence(self) -> str:
        if not 0 < len(self.errors) <= _MOST_ERRORS:
            return ""
        drives = self.places.drives()
        node = drives[0][0] if drives else self.places.point(None).node
        model = elastic(Model.from_data(self.data))
        mechanism = ElasticDesign(model, self.data.node_index[node])
        one = replace(mechanism, elastic=replace(model, beams=1))
        order = self._in_order(one)
        if not order:
            return ""
        if len(self.errors) * mechanism.levels[-1].solution.solver.elements > _MOST_LOOKED_AT:
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
            np.abs(coarse.errors(stresses, coarse.square_at(SHIFT), lengths[able])).min(axis=1)
            * lengths[able]
        )
        # Of equal ones, which symmetry makes, the first of the model is enough.
        first = sorted(np.flatnonzero(np.isfinite(least)), key=lambda k: self.errors.index(some[k]))
        near = {f"{least[k]:.5g}": some[k] for k in reversed(first)}
        chosen = sorted(near.values(), key=self.errors.index)[:_MOST_NEAR]
        if len(chosen) > 1:
            # The one with which less is enough, with both divisions.
            found = (
                level.errors(np.asfortranarray(level.stresses(chosen)), level.square_at(SHIFT))
                for level in mechanism.levels
            )
            sizes = np.abs(Estimate.of(*found).value).min(axis=1) * self._lengths(chosen)
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
        parts = self.result.parts
        stiff = mechanism.elastic.policy.stiff.any(axis=0)
        which = [
            e
            for e in np.flatnonzero(stiff).tolist()
            if parts.of_element(e).kind is not PartKind.BODY
        ]
        states = [
            level.solution.under(size * level.stresses((each,))[:, :, 0])
            for level in mechanism.levels
        ]
        known = []
        for e in which:
            with suppress(ElasticError):
                peak_of(states[-1], e)
                known.append(e)
        if known:
            values, unit = _of(states, known, lambda at, e: (peak_of(at, e),)), "Pa"
        else:
            values, unit = _of(states, which, _moment_and_force), "N m"
            values, unit = (values[:, 0], unit) if values[:, :1].any() else (values[:, 1], "N")
        values = values.reshape(-1)
        if not values.any():
            return ""
        most = int(np.argmax(np.round(values / values.max(), 6)))
        what = part_words(parts.of_element((known or which)[most]))
        return f"{what} with {in_words(Number(float(f'{values[most]:.3g}')), unit)}"


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
