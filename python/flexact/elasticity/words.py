# SPDX-License-Identifier: BSD-3-Clause
"""A state in plain English."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .errors import Estimate, matched_by_order, matched_by_sign
from .stiffness_errors import ElasticError

if TYPE_CHECKING:
    from .state import State

#: How many eigenvalues are told.
_MOST = 6
#: An uncertainty below this part of the value is not told.
_SHOWN = 1.0e-6


def describe(state: State) -> str:
    """What a state is, its verdict, whether it is stable, frequencies and multipliers."""
    lines = [f"{state.label[:1].upper()}{state.label[1:]}; {state.model.words}."]
    over, under = state.over_constrained, state.under_constrained
    lines.append(
        f"Over-constrained by {over}, under-constrained by {under}, by the deck's classes."
    )
    if state.drive is not None:
        lines.append(f"Force of the drive: {state.force:.6g}.")
    lines.append(f"Elastic energy: {state.energy:.6g} J.")
    lines.append(_stability(state))
    if state.model.has_mass:
        lines.append(f"Frequencies: {_listed(state, 'frequencies')} Hz.")
    else:
        lines.append("Nothing has a mass (EM, XM): there are no frequencies.")
    if state.finest.is_stressed:
        try:
            lines.append(f"Multipliers: {_listed(state, 'multipliers') or 'none'}.")
        except ElasticError as error:
            lines.append(f"Multipliers: {error}.")
    lines += [f"Note: {note}." for note in state.notes]
    return "\n".join(lines)


def _stability(state: State) -> str:
    if not state.is_stable:
        return "Buckled: this state is unstable."
    if state.loose:
        several = "s" * (len(state.loose) > 1)
        motions = "; ".join(map(str, state.loose[:_MOST]))
        return f"{len(state.loose)} motion{several} without stiffness: {motions}."
    return "Stable."


def _listed(state: State, name: str) -> str:
    """Such as "9.92 (+- 0.01), 403"; the nearest to zero, ascending."""
    every = [getattr(each, name) for each in state.alone]
    match = matched_by_sign if name == "multipliers" else matched_by_order
    found = Estimate.of(*match(*every)) if len(every) > 1 else Estimate.fixed(every[0])
    least = _SHOWN * np.abs(found.value)
    nearest = np.argsort(np.abs(found.value), kind="stable")[:_MOST]
    chosen = sorted(nearest.tolist(), key=lambda k: float(found.value[k]))
    return ", ".join(
        f"{found.value[k]:.5g}"
        + (f" (+- {found.uncertainty[k]:.1g})" if found.uncertainty[k] > least[k] else "")
        for k in chosen
    )
