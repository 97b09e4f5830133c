# SPDX-License-Identifier: BSD-3-Clause
"""A limb turned as a whole so that it stops what is free, as a value."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...analysis.screws import Screw
from ...core.arrays import FloatArray
from ...model.parts.parts import Part
from ..proposal import Proposal


@dataclass(frozen=True, eq=False)
class Mend(Proposal):
    """A limb turned as a whole, tried.

    What the analysis says is of the mechanism with each divided sheet or wire as one beam.
    `condition` is by how much the smallest singular value that is not zero is smaller than
    before.

    Attributes:
        parts: The limb's parts, by name.
        end: Index of the position node where it holds a body or point, in the model as given.
        repeats: Parts of other limbs whose constraints it repeats.
        direction: (3,) unit vector of the line about which it is turned.
        point: (3,) of that line [m].
        angle: [rad], right-handed about `direction`.
        is_in_place: Whether the line goes through where the limb is fastened to the body.
        stops: How the body or point moved in a motion that nothing stopped, and cannot any more;
            None where that is not so of any of them.
    """

    parts: tuple[Part, ...] = ()
    end: int = -1
    repeats: tuple[Part, ...] = ()
    direction: FloatArray = field(default_factory=lambda: np.zeros(3))
    point: FloatArray = field(default_factory=lambda: np.zeros(3))
    angle: float = 0.0
    is_in_place: bool = False
    stops: Screw | None = None
