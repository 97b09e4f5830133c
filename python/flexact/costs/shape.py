# SPDX-License-Identifier: BSD-3-Clause
"""A shape that vibrates or buckles, with pictures of it."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind, role_table
from ..elasticity import ElasticError, State
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..model.parts.forms import AT_P
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
    return Shape(
        kind, f"{words} ({state.label})", value, as_drawn(state), state.configuration, drawn
    )


def as_drawn(state: State) -> ModelData:
    """The refined model of a state, with waists at the ends of its beams alone.

    A bending that is released at one end of a beam is so in each piece, which is as stiff as the
    others where it has a stiffness.
    """
    data, mesh = state.data, state.finest.solver.mesh
    classes = data.arrays.deformation_class.copy(order="F")
    roles = role_table()[data.arrays.element_kind]
    last = np.append(mesh.first[1:], classes.shape[1]) - 1
    for role in AT_P:
        # Both ends of a bending stand behind each other.
        piece, k = np.nonzero(roles == role)
        held = classes[k, piece] == Class.FIXED, classes[k + 1, piece] == Class.FIXED
        at_end = np.where(held[0], np.isin(piece, last), np.isin(piece, mesh.first))
        inner = (held[0] != held[1]) & ~at_end
        for number in (k[inner], k[inner] + 1):
            classes[number, piece[inner]] = Class.FIXED
    return replace(data, arrays=data.arrays._replace(deformation_class=classes))


def unit_mode(data: ModelData, mode: FloatArray) -> FloatArray:
    """(nodes, 3) with the largest displacement 1, or rotation where only rotations move."""
    places = data.arrays.node_kind <= NodeKind.POSITION
    size = np.linalg.norm(mode[places], axis=1).max(initial=0.0)
    size = size if size > 1e-9 * np.abs(mode).max(initial=0.0) else np.abs(mode).max(initial=0.0)
    return mode / size if size > 0.0 else mode.copy()
