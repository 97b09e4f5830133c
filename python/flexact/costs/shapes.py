# SPDX-License-Identifier: BSD-3-Clause
"""Shapes that vibrate and buckle, to be drawn."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..model.data import ModelData
from .elastic_design import Bench
from .quantities import in_words
from .shape import Shape
from .values import Number, Numbers, Tolerance

#: How many parasitic frequencies are shown.
_MOST = 2


def shapes_of(
    bench: Bench,
    frequencies: Numbers | None,
    is_drive: tuple[bool, ...],
    buckles: Tolerance | None,
) -> Iterator[Shape]:
    """The drive's and the first parasitic modes, and the shape in which it buckles first."""
    if frequencies is not None:
        chosen = [k for k, drives in enumerate(is_drive) if drives][:1]
        chosen += [k for k, drives in enumerate(is_drive) if not drives][:_MOST]
        for k in chosen:
            hertz = Number(*(float(side[k]) for side in frequencies))
            kind = "frequency of the drive" if is_drive[k] else "parasitic frequency"
            words = f"{kind}, {in_words(hertz, 'Hz')}"
            yield _shape(bench, "vibrating", words, hertz.value, bench.rest.modes[k])
    if buckles is not None:
        size, unit = buckles.critical, buckles.misalignment.unit
        sense = -1.0 if buckles.critical.value == -buckles.critical_negative.value else 1.0
        words = f"buckles with {buckles.misalignment.words} off by {in_words(size, unit)}"
        mode = bench.levels[-1].buckled(buckles.misalignment, sense)
        if mode is not None:
            yield _shape(bench, "buckled", words, sense * size.value, mode)


def _shape(bench: Bench, kind: str, words: str, value: float, mode: FloatArray) -> Shape:
    data, configuration = bench.rest.data, bench.rest.configuration
    return Shape(kind, words, value, data, configuration, _unit(data, mode))


def _unit(data: ModelData, mode: FloatArray) -> FloatArray:
    """(nodes, 3) with the largest displacement 1, or rotation where only rotations move."""
    places = data.arrays.node_kind <= NodeKind.POSITION
    size = np.linalg.norm(mode[places], axis=1).max(initial=0.0)
    size = size if size > 1e-9 * np.abs(mode).max(initial=0.0) else np.abs(mode).max(initial=0.0)
    return mode / size if size > 0.0 else mode.copy()
