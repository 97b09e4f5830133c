# SPDX-License-Identifier: BSD-3-Clause
"""A state on one mesh or two: numbers of the meshes, and what is extrapolated from them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..util.cached import cached_property
from ..util.records import Frozen
from .errors import Estimate
from .points import Coordinate
from .solution import Solution

if TYPE_CHECKING:
    from .elastic import Elastic

Mine = TypeVar("Mine", bound="OnMeshes")


@dataclass(frozen=True, eq=False, repr=False)
class OnMeshes(Frozen):
    """A state: where everything is and what is stressed, and how it answers to small changes.

    Whatever is asked is computed once. With beams="auto" there are two meshes, and numbers are
    extrapolated from both (`estimate` has the uncertainty); eigenvalues are matched by their
    order.

    Attributes:
        model: The elastic model.
        label: What the state is, such as "undeformed".
        drive: The coordinate that was driven here, if one was.
        meshes: The state of each mesh, the coarser first.
    """

    model: Elastic
    label: str
    drive: Coordinate | None
    meshes: tuple[Solution, ...]

    @property
    def finest(self) -> Solution:
        """The state of the finer mesh, for pictures and further computations."""
        return self.meshes[-1]

    def estimate(self: Mine, quantity: Callable[[Mine], ArrayLike]) -> Estimate:
        """A quantity of this state with its uncertainty, from 8 and 16 beams a sheet.

        Args:
            quantity: What is wanted of a state, such as `lambda s: s.frequencies[0]`.
        """
        if len(self.alone) == 1:
            return Estimate.fixed(quantity(self.alone[0]))
        return Estimate.of(*map(quantity, self.alone))

    @cached_property
    def alone(self: Mine) -> tuple[Mine, ...]:
        """This state with each of its meshes alone."""
        if len(self.meshes) == 1:
            return (self,)
        return tuple(replace(self, meshes=(at,)) for at in self.meshes)

    def best(self, of: Callable[[Solution], ArrayLike]) -> FloatArray:
        """Numbers of the state of a mesh, extrapolated from those of both."""
        values = [np.asarray(of(each), np.float64) for each in self.meshes]
        made = values[0] if len(values) == 1 else Estimate.of(*values).value
        # A zero has no sign.
        return np.array(made) + 0.0

    def eigenvalues(
        self,
        of: Callable[[Solution], FloatArray],
        match: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]],
    ) -> FloatArray:
        """Eigenvalues likewise, of which `match` finds for each its like; ascending."""
        values = [of(each) for each in self.meshes]
        made = values[0] if len(values) == 1 else Estimate.of(*match(*values)).value
        return np.sort(made) + 0.0
