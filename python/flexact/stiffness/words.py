# SPDX-License-Identifier: BSD-3-Clause
"""A state in plain English."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import FloatArray
from .errors import ElasticError

if TYPE_CHECKING:
    from .state import State

#: How many eigenvalues are told.
_MOST = 6


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
    """Such as "9.92 (+- 0.01), 403"; the nearest to zero."""
    estimate = state.estimate(lambda at: getattr(at, name)) if _same(state, name) else None
    values: FloatArray = getattr(state, name)
    off = np.zeros_like(values) if estimate is None else estimate.uncertainty
    chosen = sorted(np.argsort(np.abs(values), kind="stable")[:_MOST].tolist())
    return ", ".join(
        f"{values[k]:.5g}" + (f" (+- {off[k]:.1g})" if off[k] > 0.0 else "") for k in chosen
    )


def _same(state: State, name: str) -> bool:
    sizes = {np.size(getattr(each, name)) for each in state.alone}
    return len(sizes) == 1
