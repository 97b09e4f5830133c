# SPDX-License-Identifier: BSD-3-Clause
"""What may be off, and what a release keeps: questions about the undeformed state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..util.cached import cached_property
from ..util.plain_text import in_short
from . import drives as paths
from .compliance import kept
from .errors import Estimate
from .imperfections import Imperfection, misalignment, number_given
from .policy import Release, numbered, releases_given
from .setting import Setting
from .solver import Solver
from .stiffness_errors import ElasticError
from .tolerance import Linear, Pair, finite

Mine = TypeVar("Mine", bound="Tolerated")


@dataclass(frozen=True, eq=False, repr=False)
class Tolerated(Setting):
    """An elastic model that is asked what may be off."""

    def critical_misalignment(self, node: object, coordinate: str, about: object = None) -> Pair:
        """At which misalignments of a clamp the mechanism buckles, the others as designed.

        Linear buckling: the stress is proportional to the error about the undeformed state.

        Returns:
            The negative and the positive one [m, rad]; infinite where there is none.

        Raises:
            UnknownError: there is no such coordinate.
            ElasticError: it is not fixed; or it is over-constrained, and held rigid.
        """
        return self._tolerated(node, coordinate, about, lambda each: each.critical)

    def misalignment_for(
        self, shift: float, node: object, coordinate: str, about: object = None
    ) -> Pair:
        """At which misalignments of a clamp the first frequency has shifted.

        The stress is proportional to the error about the undeformed state. The first frequency is
        that with `drive` as it is: with a free drive mostly that of the guided motion, with a
        locked one the first parasitic one.

        Args:
            shift: Relative: -0.05 is a fall of 5 %.
            node: Of the clamp.
            coordinate: Along or about what it is off.
            about: For a turn, as in `misaligned`.

        Returns:
            The negative and the positive one [m, rad]; infinite where there is none.

        Raises:
            UnknownError: there is no such coordinate.
            ElasticError: it is not fixed; nothing has a mass; the first frequency is 0; the shift
                is none; or it is over-constrained, and held rigid.
        """
        part = number_given(shift, "a shift")
        if not part > -1.0 or part == 0.0:
            raise ElasticError(
                f"a shift is above -1 and not 0 (-0.05: -5 %), not {in_short(shift)}"
            )
        self.require_mass()
        return self._tolerated(node, coordinate, about, lambda each: each.shifted(part))

    def _tolerated(
        self,
        node: object,
        coordinate: str,
        about: object,
        of: Callable[[Linear], Pair],
    ) -> Pair:
        off = misalignment(self.points, node, coordinate, 1.0, about, beyond=True)
        self.require_stiffness()
        self.require_determined()
        what = self.points.coordinate(node, coordinate), about
        found = [of(self._linear(solver, off, what)) for solver in self.solvers]
        return found[0] if len(found) == 1 else finite(Estimate.of(*found).value)

    def _linear(self, solver: Solver, off: Imperfection, what: tuple[object, object]) -> Linear:
        """The stresses of an imperfection, kept for the next question about it."""
        coordinate, about = what
        key = solver, coordinate, None if about is None else tuple(off.centre.tolist())
        kept_ones = self._linears
        if key not in kept_ones:
            kept_ones[key] = Linear(solver, self.locked, off)
        return kept_ones[key]

    @cached_property
    def _linears(self) -> dict[object, Linear]:
        return {}

    def kept(self, node: object, release: Release) -> FloatArray:
        """What a release keeps of the stiffness of a point: mu of C_before v = mu C_after v.

        Args:
            node: Of the point.
            release: Deformations that are released besides those that are, as in
                `flexact.elastic`.

        Returns:
            All mu, ascending, from 0 (a motion has no stiffness any more) to 1 (nothing lost), of
            the undeformed state; without directions that are held.

        Raises:
            UnknownError: there is no such node, element or deformation.
            ElasticError: nothing has a stiffness.
        """
        both = {**self.release, **numbered(self.data, releases_given(self.points, release))}
        self.require_stiffness()
        other = replace(self, release=both)
        point = self.points.of(node)
        coordinates = self.points.coordinates(point)
        found = []
        for mine, its in zip(self.solvers, other.solvers, strict=True):
            before, after = (
                paths.at_rest(each, self.locked).compliance(point, coordinates)
                for each in (mine, its)
            )
            found.append(kept(before, after))
        if len(found) == 1 or found[0].shape != found[1].shape:
            return found[-1]
        return np.array(np.clip(Estimate.of(*found).value, 0.0, 1.0))

    def estimate(self: Mine, quantity: Callable[[Mine], ArrayLike]) -> Estimate:
        """A quantity of this model with its uncertainty, from 8 and 16 beams a sheet.

        Args:
            quantity: What is wanted, such as `lambda m: m.critical_misalignment(11, "x")`.
        """
        if len(self.solvers) == 1:
            return Estimate.fixed(quantity(self))
        return Estimate.of(*map(quantity, self.alone))

    @cached_property
    def alone(self: Mine) -> tuple[Mine, ...]:
        """This model with each of its meshes alone."""
        made = tuple(replace(self, only=k) for k in range(len(self.solvers)))
        for each, solver in zip(made, self.solvers, strict=True):
            # What was computed is not computed again.
            each.__dict__.update(solvers=(solver,), _linears=self._linears)
        return made
