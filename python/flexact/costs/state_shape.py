# SPDX-License-Identifier: BSD-3-Clause
"""The shape in which an elastic state vibrates or buckles."""

from __future__ import annotations

import numpy as np

from ..core.elements import NodeKind
from ..elasticity import ElasticError, State
from ..util.errors import require_kind
from .shape import Shape


def shape(state: State, mode: int = 1, *, buckled: bool = False) -> Shape:
    """The shape in which a state vibrates, or in which it would buckle.

    Args:
        state: A state of an elastic model.
        mode: Which one, from 1: of frequencies the lowest, of multipliers the nearest to zero.
        buckled: Whether it is a shape in which it buckles.

    Returns:
        The shape of the finer mesh, which a notebook shows and `save` writes as a picture.

    Raises:
        ElasticError: There is no such mode, nothing has a mass, or nothing is stressed.
    """
    require_kind(state, State, "a shape is that of a state")
    values = state.multipliers if buckled else state.frequencies
    modes = state.buckling_modes if buckled else state.modes
    order = np.argsort(np.abs(values), kind="stable") if buckled else np.arange(values.size)
    count = min(len(modes), values.size)
    what = "multiplier" if buckled else "frequency"
    if not (isinstance(mode, int) and 1 <= mode <= count):
        raise ElasticError(f"there is no {what} {mode}: this state gives {count}")
    value = float(values[order[mode - 1]])
    field = modes[order[mode - 1]]
    placed = state.data.arrays.node_kind <= NodeKind.POSITION
    far = float(np.linalg.norm(field[placed], axis=1).max(initial=0.0))
    size = far or float(np.abs(field).max(initial=0.0)) or 1.0
    words = f"{_told(value, buckled)} ({state.label})"
    kind = "buckled" if buckled else "vibrating"
    return Shape(kind, words, value, state.data, state.configuration, field / size)


def _told(value: float, buckled: bool) -> str:
    if buckled:
        return f"buckles at {value:.4g} times its stresses"
    if value < 0.0:
        return "unstable"
    return f"vibrates at {value:.4g} Hz"
