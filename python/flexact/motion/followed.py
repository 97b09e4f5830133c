# SPDX-License-Identifier: BSD-3-Clause
"""How a path is to be followed, and what was."""

from __future__ import annotations

from dataclasses import dataclass

from ..util.records import Frozen
from .ending import Stop
from .station import Station


@dataclass(frozen=True)
class Wishes:
    """How a path is to be followed.

    Lengths are in sizes of the model, of the node that moves farthest; rotations in radians.

    Attributes:
        length: How far each way.
        first: The first step.
        largest: The largest step.
        least: The least step; where one of it fails the path ends.
        steps: How many steps each way at most.
        through: Whether to go straight on where other paths branch off.
    """

    length: float = 0.1
    first: float = 0.01
    largest: float = 0.02
    least: float = 1.0e-5
    steps: int = 2_000
    through: bool = False


@dataclass(frozen=True, eq=False)
class Followed(Frozen):
    """A path from the reference one way.

    Attributes:
        stations: The first is the reference.
        stop: Why it was not followed farther.
        branches: Where other paths branch off, also the one where it stops.
    """

    stations: tuple[Station, ...]
    stop: Stop
    branches: tuple[Station, ...] = ()

    @property
    def length(self) -> float:
        """How far it was followed [size]."""
        return self.stations[-1].arc

    @property
    def residual(self) -> float:
        """The largest held deformation on it [size]."""
        return max(each.residual for each in self.stations)
