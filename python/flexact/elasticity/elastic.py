# SPDX-License-Identifier: BSD-3-Clause
"""Elastic models: `flexact.elastic`, and the states of what it gives."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind
from ..model.data import ModelData
from ..model.model import Model
from ..model.reading import read
from ..model.variation import with_classes
from ..util.quantities import Quantity, without_units
from ..util.records import Frozen, cached_property
from ..util.text import in_short
from . import drives as paths
from .drives import strokes_given, value_at, warn_where_far
from .errors import ElasticError, Estimate, require_within
from .imperfections import Imperfection, misalignment, misfit, number_given, warmth
from .mesh import Beams, Mesh, beams_given, divisible, divisions
from .points import Coordinate, Points
from .reduced import Reducer
from .solution import (
    DRIVES,
    HELD,
    NO_STIFFNESS,
    Held,
    Policy,
    Release,
    Solution,
    Solver,
    choice,
    indexed,
    kept,
    numbered,
    policy_of,
    releases_given,
)
from .state import State
from .tolerance import Linear, Pair, finite
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


_misfit = misfit


@dataclass(frozen=True, eq=False, repr=False)
class Elastic(Tolerated):
    """A model with its stiffness and mass, ready for states; made by `flexact.elastic`."""

    def undeformed(self) -> State:
        """As the deck gives it, without loads or anything off."""
        made = tuple(paths.at_rest(each, self.locked) for each in self.solvers)
        return State(self, "undeformed", None, made)

    def assembled(self) -> State:
        """Without loads, with all that is off.

        Raises:
            StrokeError: no equilibrium was found.
            ElasticError: it is over-constrained, and held rigid.
        """
        label = " and ".join(each.label for each in self.off) or "undeformed"
        return State(self, label, None, self._assembled())

    def equilibrium(self, load: float = 1.0) -> State:
        """Under the deck's loads, XF, DELXF and GRAVITY, times a factor; ramped.

        Raises:
            StrokeError: no equilibrium was found.
            ElasticError: the factor is no finite number.
        """
        factor = number_given(load, "the load")
        made = tuple(paths.loaded(at, factor) for at in self._assembled())
        under = (
            f"under {factor:g} times the loads" if self.data.loads else "without loads in the deck"
        )
        return State(self, f"equilibrium {under}", None, made)

    def along(
        self,
        node: object,
        coordinate: str,
        values: Iterable[Quantity],
        *,
        from_rest: bool = False,
        beyond: bool = False,
    ) -> tuple[State, ...]:
        """Equilibria along the stroke of a drive, without the deck's loads.

        Values that ascend or descend are driven to from the start outward, both ways; others
        one after another as given, so that a snap-through shows its hysteresis.
        With drive "free" the driven coordinate may move in what is asked about a state, and the
        force of the drive, or its moment about the driven axis, stays constant; "locked" holds it.

        Args:
            node: Of the coordinate, or its point: a number, a name, also of a body, or (x, y, z).
            coordinate: "x", "y", "z", "rx", "ry" or "rz". An angle is twice the arcsine of its
                Euler parameter.
            values: Where it is driven to: absolute [m, rad], or texts such as "3 mm".
            from_rest: Whether the values count from where the coordinate is in the model. A stroke
                of absolute ones that is far from there is warned of (`StrokeWarning`).
            beyond: Whether it may be driven farther than the model is large.

        Raises:
            UnknownError: there is no such coordinate.
            ElasticError: it is fixed, or a value is not finite; or it is farther from where it
                rests than the model is large, and not `beyond`.
            StrokeError: a value was not reached; `reached` is the last one that was.
        """
        drive = self.points.coordinate(node, coordinate)
        if self.points.has_class(drive, Class.FIXED):
            raise ElasticError(
                f"{self.points.words(drive)} is fixed: a clamp is moved with misaligned()"
            )
        given = list(values) if isinstance(values, (range, Iterator)) else values
        kind = self.points.kinds[drive.node]
        given = without_units(given, "rad" if kind > NodeKind.POSITION else "m")
        rest = value_at(paths.at_rest(self.solvers[0], self.locked), drive)
        is_turn = bool(kind == NodeKind.ORIENTATION)
        there = strokes_given(given, is_turn, rest if from_rest else 0.0)
        what = self.points.words(drive)
        # An angle may be of any number of turns.
        for value in () if beyond or kind > NodeKind.POSITION else there:
            require_within(value - rest, self.data.size, False, f"a stroke of {what}")
        if not from_rest:
            warn_where_far(there, rest, what)
        return self.driven(drive, there)

    def driven(self, drive: Coordinate, values: Sequence[float]) -> tuple[State, ...]:
        """The same at absolute values of a coordinate, whatever they are.

        Raises:
            ElasticError: an angle is not within half a turn.
            StrokeError: a value was not reached.
        """
        is_turn = self.points.kinds[drive.node] == NodeKind.ORIENTATION
        there = strokes_given(list(values), bool(is_turn), 0.0)
        ways = [
            paths.driven(at, self.points, drive, there, self.drive == "locked")
            for at in self._assembled()
        ]
        words = self.points.words(drive)
        return tuple(
            State(self, f"driven to {words} = {value:g}", drive, states)
            for value, states in zip(there, zip(*ways, strict=True), strict=True)
        )

    def misaligned(
        self,
        node: object,
        coordinate: str,
        value: Quantity,
        about: object = None,
        beyond: bool = False,
    ) -> State:
        """A clamp that is moved, or turned about an axis through a point.

        Args:
            node: Position or orientation node of the clamp.
            coordinate: "x", "y", "z" [m]; "rx", "ry", "rz" [rad], about a global axis.
            value: By how much [m, rad], or a text such as "50um".
            about: For a turn: a node, or (x, y, z) [m]; by default the clamp's own position.
            beyond: Whether it may be larger than the model, an angle than half a turn.

        Raises:
            UnknownError: there is no such coordinate.
            ElasticError: it is not fixed; or it is over-constrained, and held rigid; or it is
                larger than the model, and not `beyond`.
            StrokeError: no equilibrium was found.
        """
        off = misalignment(self.points, node, coordinate, value, about, beyond)
        return self._imperfect(off)

    def misfit(
        self, element: object, deformation: int, value: float, beyond: bool = False
    ) -> State:
        """An element that is made too long, twisted or bent.

        Args:
            element: Its number, or the name of its part.
            deformation: Which, from 1.
            value: By how much, in the deck's units: torsion and bending are the element's length
                times an angle.
            beyond: Whether it may be larger than the model.

        Raises:
            UnknownError: there is no such element or deformation.
            ElasticError: it is over-constrained, and held rigid.
            StrokeError: no equilibrium was found.
        """
        return self._imperfect(misfit(self.points, element, deformation, value, beyond))

    def warmed(self, kelvin: float, expansion: float, elements: object = None) -> State:
        """Elements that are warmer than the ground, and so longer.

        Args:
            kelvin: By how much [K].
            expansion: Of their material [1/K].
            elements: Numbers of the elements, or names of parts; all by default.

        Raises:
            UnknownError: there is no such element.
            ElasticError: it is over-constrained, and held rigid.
            StrokeError: no equilibrium was found.
        """
        return self._imperfect(warmth(self.points, kelvin, expansion, elements))

    def imperfect(
        self,
        misaligned: Iterable[tuple[object, ...]] = (),
        misfit: Iterable[tuple[object, object, object]] = (),
        warmed: tuple[object, ...] | None = None,
        beyond: bool = False,
    ) -> Elastic:
        """The same model with things off in all of its states: for strokes and loads then.

        Args:
            misaligned: Arguments of `misaligned`, of each clamp.
            misfit: Arguments of `misfit`, of each element.
            warmed: Arguments of `warmed`.
            beyond: Whether something may be larger than the model.

        Raises:
            UnknownError: something is not there.
            ElasticError: something is wrong with a value.
        """
        moved = partial(misalignment, self.points, beyond=beyond)
        off = [moved(*each) for each in misaligned]
        off += [_misfit(self.points, *each, beyond=beyond) for each in misfit]
        if warmed is not None:
            off.append(warmth(self.points, *warmed))
        return replace(self, off=(*self.off, *off))

    def _imperfect(self, off: Imperfection) -> State:
        return replace(self, off=(*self.off, off)).assembled()

    def _assembled(self) -> tuple[Solution, ...]:
        if self.off:
            self.require_determined()
        return tuple(paths.assembled(each, self.off, self.locked) for each in self.solvers)


def elastic(
    model: Model | str | bytes | os.PathLike[str] | os.PathLike[bytes],
    held: str = "elastic",
    drive: str = "free",
    release: Release = (),
    beams: int | str = "auto",
) -> Elastic:
    """A model with its stiffness and mass: states, frequencies, buckling and misalignment.

    Args:
        model: A model, or the path of a deck.
        held: "elastic": fixed deformations that have a stiffness (ESTIFF) are elastic, others are
            rigid; "rigid": all fixed deformations are.
        drive: Whether declared coordinates (DYNX, INPUTX) may move, "free" or "locked".
        release: Deformations that are released stress-free, pairs of element and deformation, by
            numbers or in words such as ("sheet 1", "in-plane bending") or, at one end, ("sheet 1",
            "bending", "stage"); or a mapping of them to the stiffness of a notch [N m/rad; N/m of
            an elongation].
        beams: Beams into which each flexible sheet or wire is divided, a divided one of the deck
            counting as what it is; 1: the deck's own elements; "auto": 8 and 16, extrapolated.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        UnknownError: what is to be released is not there.
        ElasticError: a choice is none.
        TypeError: something is of another kind than it must be.
    """
    if not isinstance(model, (Model, str, bytes, os.PathLike)):
        kind = type(model).__name__
        raise TypeError(f"a model or the path of a deck can be analysed, not {kind}")
    data = (model if isinstance(model, Model) else read(model)).data
    data.require_sound()
    released = numbered(data, releases_given(Points(data), release))
    return Elastic(
        data,
        choice(held, HELD, "held"),
        choice(drive, DRIVES, "drive"),
        released,
        beams_given(beams),
    )
