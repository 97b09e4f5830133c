# SPDX-License-Identifier: BSD-3-Clause
"""What an elastic model is made of: its choices, meshes, policy and verdicts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..core.elements import Class
from ..model.data import ModelData
from ..model.variation import with_classes
from ..util.cached import cached_property
from ..util.records import Frozen
from .imperfections import Imperfection
from .mesh import Beams, divisible, divisions
from .points import Coordinate, Points
from .policy import NO_STIFFNESS, Policy, indexed, policy_of
from .reduced import Reducer
from .solution import Solution
from .solver import Held, Solver
from .stiffness_errors import ElasticError
from .stiffness_mesh import Mesh
from .verdicts import Verdicts


@dataclass(frozen=True, eq=False, repr=False)
class Setting(Frozen):
    """A model with its stiffness and mass, and the choices about it.

    Attributes:
        data: The model as given.
        held: "elastic": fixed deformations with a stiffness of their own are elastic, others
            rigid; "rigid": all fixed deformations are rigid.
        drive: "free" or "locked": whether declared coordinates may move.
        release: Stiffness of the notch of each deformation that is released, by number of
            element and deformation [N m/rad; N/m of an elongation]; 0: ideal.
        beams: How many beams a sheet is divided into; "auto": 8 and 16, extrapolated.
        off: What is not as designed in all states but the undeformed one.
        only: Which mesh alone is used; None for all.
    """

    data: ModelData
    held: str
    drive: str
    release: Mapping[tuple[int, int], float]
    beams: Beams
    off: tuple[Imperfection, ...] = ()
    only: int | None = None

    @cached_property
    def points(self) -> Points:
        """Its points and coordinates, as users name them."""
        return Points(self.data)

    @cached_property
    def policy(self) -> Policy:
        """What is rigid, what is elastic and what is released."""
        return policy_of(self.data, self.held, indexed(self.data, self.release))

    @cached_property
    def solvers(self) -> tuple[Solver, ...]:
        """One of each mesh, the coarser first."""
        which = divisible(self.data, self.policy.stiff, self.policy.rigid)
        made = divisions(self.data, self.beams, which)
        if self.only is not None:
            made = (made[self.only],)
        return tuple(Solver(Mesh.of(self.data, pieces), self.policy) for pieces in made)

    @cached_property
    def locked(self) -> Held:
        """Declared coordinates that are held."""
        if self.drive == "free":
            return frozenset()
        found = np.argwhere(self.data.arrays.coordinate_class.T == Class.INDEPENDENT)
        return frozenset(Coordinate(node, axis) for node, axis in found.tolist())

    @cached_property
    def reducer(self) -> Reducer:
        """Makes matrices in the declared coordinates and deformations."""
        return Reducer(self.data, self.policy)

    @cached_property
    def verdicts(self) -> Verdicts:
        """Judges configurations by the deck's classes; what is released counts as that."""
        released = {pair: Class.DEPENDENT for pair in self.release}
        data = with_classes(self.data, released, {}) if released else self.data
        _, c_t = self.solvers[-1].elastic
        return Verdicts(data, c_t[self.solvers[-1].mesh.first])

    @property
    def has_mass(self) -> bool:
        """Whether anything has a mass."""
        given = self.data.properties
        return given is not None and bool(
            np.nan_to_num(given.mass).any() or np.nan_to_num(given.node_mass).any()
        )

    def require_mass(self) -> None:
        """Raise where nothing has a mass.

        Raises:
            ElasticError: nothing has one.
        """
        if not self.has_mass:
            raise ElasticError(
                "nothing has a mass, so that there are no frequencies: give EM of elements or XM "
                "of nodes in the deck's dynamics block, or a material with a density"
            )

    def require_stiffness(self) -> None:
        """Raise where no element has a stiffness.

        Raises:
            ElasticError: none has one.
        """
        if not self.policy.has_stiffness:
            raise ElasticError(NO_STIFFNESS)

    def require_determined(self) -> None:
        """Raise where a self-stress would be needed that is not determined.

        Raises:
            ElasticError: it is over-constrained, and held rigid.
        """
        if self.held == "rigid" and self.verdicts.over_constrained:
            raise ElasticError(
                f"the mechanism is over-constrained by {self.verdicts.over_constrained} and what "
                "is fixed is held rigid: the stress that something off causes is then not "
                "determined; ask with held elastic"
            )

    def drive_of(self, drive: Coordinate | None) -> Coordinate:
        """The coordinate that drives: the one given, else the only declared one, if locked.

        Raises:
            ElasticError: there is none, or there are several.
        """
        if drive is not None:
            return drive
        if len(self.locked) == 1:
            return next(iter(self.locked))
        raise ElasticError(
            "no drive acts in this state: ask a state of along(), or lock the only declared "
            'coordinate with drive="locked"; reaction() gives the force of whatever is held'
        )

    def notes_of(self, at: Solution) -> tuple[str, ...]:
        """What is to be known about the numbers of a state."""
        made = []
        if self.held == "rigid" and at.is_stressed and self.verdicts.over_constrained:
            made.append(
                f"over-constrained by {self.verdicts.over_constrained} and held rigid: of all "
                "stresses in equilibrium with the loads those of least norm are taken"
            )
        if not at.is_confirmed:
            made.append("it is not confirmed that no frequency or multiplier is missing in between")
        return tuple(made)

    @property
    def words(self) -> str:
        """The choices, such as "held elastic, drive free, 8 beams a sheet"."""
        beams = {
            "auto": "8 and 16 beams a sheet or more, extrapolated",
            1: "the deck's own elements",
        }
        many = beams.get(self.beams, f"{self.beams} beams a sheet")
        released = ", ".join(
            f"{e}:{k}" + (f" with {stiffness:g} N m/rad" if stiffness else "")
            for (e, k), stiffness in self.release.items()
        )
        made = f"held {self.held}, drive {self.drive}, {many}"
        return f"{made}, released {released}" if released else made

    def __repr__(self) -> str:
        """The choices."""
        return f"<Elastic {self.data.name!r}: {self.words}>"
