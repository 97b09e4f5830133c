# SPDX-License-Identifier: BSD-3-Clause
"""A shape that vibrates or buckles, with pictures of it."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..elasticity import ElasticError, State
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..show.picture import shape_bytes
from ..show.writers import require_name, write
from ..util.errors import require_kind
from ..util.records import Frozen


@dataclass(frozen=True, eq=False)
class Shape(Frozen):
    """A shape that vibrates or buckles, to be drawn; of the model as it was refined.

    A notebook shows its picture.

    Attributes:
        kind: "vibrating" or "buckled".
        words: Such as "parasitic frequency, 184 Hz" or "buckles with clamp 11 along x off by
            0.13 mm".
        value: Frequency [Hz], the critical misalignment [m, rad], or the multiplier of a state.
        data: The refined model.
        configuration: Where its nodes are without the shape.
        displacement: (nodes of data, 3) displacements and rotations (spins); the largest
            displacement is 1.
    """

    kind: str
    words: str
    value: float
    data: ModelData
    configuration: Configuration
    displacement: FloatArray

    def picture(
        self, suffix: str = ".png", view: str | None = None, size: tuple[int, int] | None = None
    ) -> bytes:
        """A picture as the content of a file.

        Args:
            suffix: .png, .svg or .pdf; .gif, .mp4 or .webm, which move.
            view: iso, front, back, left, right, top, bottom, or azimuth and elevation in degrees.
            size: Width and height [px].

        Raises:
            FlexactError: There is no such kind of picture or view, or a package is missing.
        """
        drawn = self.data, self.configuration, self.displacement
        return shape_bytes(*drawn, self.words, suffix, view=view, size=size)

    def save(
        self,
        path: str | os.PathLike[str],
        view: str | None = None,
        size: tuple[int, int] | None = None,
    ) -> None:
        """Write a picture to a file, whole or not at all; see `picture`.

        Raises:
            FlexactError: As of `picture`, or the file cannot be written.
        """
        target = Path(path)
        require_name(target)
        write(target, self.picture(target.suffix, view, size))

    def _repr_png_(self) -> bytes:
        return self.picture()


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
    words = "unstable" if value < 0.0 else f"vibrates at {value:.4g} Hz"
    if buckled:
        words = f"buckles at {value:.4g} times its stresses"
    kind, drawn = "buckled" if buckled else "vibrating", unit_mode(state.data, field)
    return Shape(kind, f"{words} ({state.label})", value, state.data, state.configuration, drawn)


def unit_mode(data: ModelData, mode: FloatArray) -> FloatArray:
    """(nodes, 3) with the largest displacement 1, or rotation where only rotations move."""
    places = data.arrays.node_kind <= NodeKind.POSITION
    size = np.linalg.norm(mode[places], axis=1).max(initial=0.0)
    size = size if size > 1e-9 * np.abs(mode).max(initial=0.0) else np.abs(mode).max(initial=0.0)
    return mode / size if size > 0.0 else mode.copy()
