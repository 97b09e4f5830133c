# SPDX-License-Identifier: BSD-3-Clause
"""Elastic models: `flexact.elastic`, and the states of what it gives."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..analysis.decomposition import asked_for
from ..analysis.result import Result, result_of
from ..core.arrays import FloatArray
from ..core.elastic import RawMatrices
from ..core.elements import Class, Dual, NodeKind
from ..core.progress import Progress
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..model.model import Model
from ..model.reading import read
from ..model.variation import with_classes
from ..util.loading import feature
from ..util.quantities import Quantity, without_units
from ..util.records import Frozen, cached_property
from ..util.rotations import vector_of_euler
from ..util.text import in_short
from ..util.units import METRES, Units
from . import equilibria
from .equilibria import (
    Angle,
    Imperfection,
    at_rest,
    force_of,
    is_far,
    misalignment,
    number_given,
    reaction_of,
    strokes_given,
    value_at,
)
from .errors import (
    ElasticError,
    Estimate,
    StrokeError,
    StrokeWarning,
    matched_by_order,
    matched_by_sign,
    require_within,
)
from .limits import Asked, Limits, Path, Strengths, limits_of, share_given, supported
from .mesh import COARSE, Beams, Mesh, beams_given, divisible, divisions
from .points import Coordinate, Points
from .reduced import Reducer, Resultants, resultants_of, verdict_of
from .solution import (
    DRIVES,
    HELD,
    NO_STIFFNESS,
    Compliance,
    Held,
    LooseMotion,
    Policy,
    Release,
    Solution,
    Solver,
    choice,
    kept,
    loose_motion,
    notch_unit,
    policy_of,
    releases_given,
)
from .state_space import StateSpace, state_space_of
from .tables import (
    PointTable,
    StrokeTable,
    seen_of,
    stroke_table_of,
    table_of,
)
from .thermal import Drift, Warmth, described, drift_of, found_in, warmth_of
from .tolerance import Linear, Pair

Match = Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]


@dataclass(frozen=True, eq=False, repr=False)
class Elastic(Frozen):
    """A model with its stiffness and mass, ready for states; made by `flexact.elastic`.

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
        is_si: Whether numbers are in SI, whatever the units of the model are; texts are in these.
    """

    data: ModelData
    held: str
    drive: str
    release: Mapping[tuple[int, int], float]
    beams: Beams
    off: tuple[Imperfection, ...] = ()
    only: int | None = None
    is_si: bool = False

    @property
    def units(self) -> Units:
        """In which numbers are given, and come back."""
        return METRES if self.is_si else self.data.units

    @cached_property
    def points(self) -> Points:
        """Its points and coordinates, as users name them."""
        return Points(self.data)

    @cached_property
    def policy(self) -> Policy:
        """What is rigid, what is elastic and what is released."""
        return policy_of(self.data, self.held, self.release)

    @cached_property
    def solvers(self) -> tuple[Solver, ...]:
        """One of each mesh, the coarser first."""
        which = divisible(self.data, self.policy.stiff, self.policy.rigid)
        made = divisions(self.data, self.beams, which)
        if self.only is not None:
            made = (made[self.only],)
        return tuple(Solver(Mesh(self.data, pieces), self.policy) for pieces in made)

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
    def result(self) -> Result:
        """The analysis of the deck's classes at rest; what is released counts as that."""
        released = {pair: Class.DEPENDENT for pair in self.release}
        data = with_classes(self.data, released, {}) if released else self.data
        return result_of(data, asked_for("auto", None), None, None, Result)

    @property
    def has_mass(self) -> bool:
        """Whether anything has a mass."""
        return self.data.has_mass

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
        over = self.result.over_constrained if self.held == "rigid" else 0
        if over:
            raise ElasticError(
                f"the mechanism is over-constrained by {over} and what "
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

    @property
    def words(self) -> str:
        """The choices, such as "held elastic, drive free, 8 beams a sheet"."""
        beams = {
            "auto": "8 and 16 beams a sheet or more, extrapolated",
            1: "the deck's own elements",
        }
        many = beams.get(self.beams, f"{self.beams} beams a sheet")
        index, own = self.data.element_index, self.data.units

        def notch(e: int, k: int, stiffness: float) -> str:
            said = own.said(stiffness, notch_unit(self.data, index[e], k - 1), 6)
            return f"{e}:{k} with {said}" if stiffness else f"{e}:{k}"

        released = ", ".join(notch(*pair, stiffness) for pair, stiffness in self.release.items())
        made = f"held {self.held}, drive {self.drive}, {many}"
        return f"{made}, released {released}" if released else made

    # -- what may be off -----------------------------------------------------------------------

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
        off = misalignment(self.points, node, coordinate, 1.0, about, True, METRES)
        self.require_stiffness()
        self.require_determined()
        centre = None if about is None else tuple(off.centre.tolist())
        what = self.points.coordinate(node, coordinate), centre
        found = []
        for solver in self.solvers:
            key = (solver, *what)
            if key not in self._linears:
                self._linears[key] = Linear(at_rest(solver, self.locked), off)
            found.append(of(self._linears[key]))
        low, high = self.units.shown(Estimate.of(*found).value, off.unit).tolist()
        return low, high

    @cached_property
    def _linears(self) -> dict[object, Linear]:
        """The stresses of imperfections by mesh, coordinate and centre, for the next question."""
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
        both = {**self.release, **releases_given(self.points, release, self.units)}
        self.require_stiffness()
        other = replace(self, release=both)
        point = self.points.of(node)
        coordinates = self.points.coordinates(point)
        before, after = (
            [at_rest(s, self.locked).compliance(point, coordinates) for s in each.solvers]
            for each in (self, other)
        )
        found = [kept(*both) for both in zip(before, after, strict=True)]
        if len(found) == 1 or found[0].shape != found[1].shape:
            return found[-1]
        return np.array(np.clip(Estimate.of(*found).value, 0.0, 1.0))

    def estimate(self, quantity: Callable[[Elastic], ArrayLike]) -> Estimate:
        """A quantity of this model with its uncertainty, from 8 and 16 beams a sheet.

        Args:
            quantity: What is wanted, such as `lambda m: m.critical_misalignment(11, "x")`.
        """
        return Estimate.of(*map(quantity, self.alone))

    @cached_property
    def alone(self) -> tuple[Elastic, ...]:
        """This model with each of its meshes alone."""
        if len(self.solvers) == 1:
            return (self,)
        made = tuple(replace(self, only=k) for k in range(len(self.solvers)))
        for each, solver in zip(made, self.solvers, strict=True):
            # What was computed is not computed again.
            each.__dict__.update(solvers=(solver,), _linears=self._linears)
        return made

    # -- states --------------------------------------------------------------------------------

    def undeformed(self) -> State:
        """As the deck gives it, without loads or anything off."""
        made = tuple(at_rest(each, self.locked) for each in self.solvers)
        return State(self, "undeformed", None, made)

    def assembled(self) -> State:
        """Without loads, with all that is off.

        Raises:
            StrokeError: no equilibrium was found.
            ElasticError: it is over-constrained, and held rigid.
        """
        units = self.data.units
        label = " and ".join(each.label(units) for each in self.off) or "undeformed"
        return State(self, label, None, self._assembled())

    def equilibrium(self, load: float = 1.0) -> State:
        """Under the deck's loads, XF, DELXF and GRAVITY, times a factor; ramped.

        Raises:
            StrokeError: no equilibrium was found.
            ElasticError: the factor is no finite number.
        """
        factor = number_given(load, "the load")
        with self._in_units():
            made = tuple(equilibria.loaded(at, factor) for at in self._assembled())
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
        self._require_free(drive)
        given = list(values) if isinstance(values, (range, Iterator)) else values
        kind = self.points.kinds[drive.node]
        unit = self.points.unit(drive)
        given = without_units(given, self.units.symbol(unit))
        rest = value_at(at_rest(self.solvers[0], self.locked), drive)
        there = strokes_given(given, bool(kind == NodeKind.ORIENTATION), rest if from_rest else 0.0)
        what = self.points.words(drive)
        # An angle may be of any number of turns.
        for value in () if beyond or kind > NodeKind.POSITION else there:
            require_within(
                value - rest, self.data.size, False, f"a stroke of {what}", self.data.units
            )
        if not from_rest and is_far(there, rest):
            at, low, high, away = (
                self.data.units.shown(x, unit)
                for x in (rest, there[0], there[-1], abs(there[0] - rest))
            )
            warnings.warn(
                f"{what} rests at {at:.6g}, and the stroke from {low:.6g} to {high:.6g} begins "
                f"{away:.6g} from there: is from_rest=True meant?",
                StrokeWarning,
                stacklevel=2,
            )
        return self.driven(drive, there)

    def driven(self, drive: Coordinate, values: Sequence[float]) -> tuple[State, ...]:
        """The same at absolute values of a coordinate in SI, whatever they are.

        Raises:
            ElasticError: an angle is not within half a turn.
            StrokeError: a value was not reached.
        """
        is_turn = self.points.kinds[drive.node] == NodeKind.ORIENTATION
        there = strokes_given(list(values), bool(is_turn), 0.0)
        with self._in_units():
            ways = [
                equilibria.driven(at, self.points, drive, there, self.drive == "locked")
                for at in self._assembled()
            ]
        words, unit = self.points.words(drive), self.points.unit(drive)
        return tuple(
            State(
                self, f"driven to {words} = {self.data.units.shown(value, unit):g}", drive, states
            )
            for value, states in zip(there, zip(*ways, strict=True), strict=True)
        )

    def stroke_table(
        self,
        node: object,
        coordinate: str,
        values: Iterable[Quantity],
        *,
        of: object = None,
        frame: object = "global",
        at: object = None,
        from_rest: bool = False,
        beyond: bool = False,
    ) -> StrokeTable:
        """Force, motions and stiffness of a point along the stroke of a drive, without loads.

        Args:
            node: As of `along`, as `coordinate`, `values`, `from_rest` and `beyond` are.
            coordinate: What is driven.
            values: Where it is driven to.
            of: The point that is looked at, as of `State.table`; by default the driven one.
            frame: As of `State.table`; it does not turn with the point.
            at: Likewise.
            from_rest: Whether the values count from rest.
            beyond: Whether it may be driven farther than the model is large.

        Raises:
            UnknownError, ElasticError, StrokeError: As of `along` and `State.table`.
        """
        # What is wrong with the frame or the place is said before anything is computed.
        seen = seen_of(self.points, node if of is None else of, frame, at)
        states = self.along(node, coordinate, values, from_rest=from_rest, beyond=beyond)
        if not states:
            raise ElasticError("a table along a stroke has one value at least")
        return stroke_table_of(states, self.points.coordinate(node, coordinate), coordinate, seen)

    def limits(
        self,
        point: object,
        coordinate: str,
        share: float = 0.5,
        support: float | None = None,
        against: str | None = None,
        drive: str | None = None,
    ) -> Limits:
        """How far a stroke may go each way from rest, and what ends it.

        The stress of von Mises (`State.von_mises`) is compared with the strength of each part that
        bends, twists or stretches. Supported are those directions of the point in which it does
        not move with all that is fixed rigid. It is followed until the strength itself is
        reached, or as far as the model is large, a right angle of a turn, or no equilibrium is
        found; without the deck's loads. Numbers are in the model's units.

        Args:
            point: Of the coordinate: a number, a name, also of a body, or (x, y, z).
            coordinate: "x", "y", "z", "rx", "ry" or "rz".
            share: Of the strength, above 0 and at most 1.
            support: Part of the stiffness at rest to which that of a supported direction may fall;
                None where that does not matter.
            against: "strength", or "fatigue"; by default of each part the strength of fatigue
                where it is given.
            drive: "free": the force of the drive stays constant; "locked": it is held where it
                is; by default as the model has it.

        Raises:
            UnknownError: there is no such coordinate.
            ElasticError: it is fixed; a part has no strength, or no known section; a choice is
                none; or it is over-constrained, and held rigid.
            StrokeError: what is off was not reached.
        """
        driven = self.points.coordinate(point, coordinate)
        self._require_free(driven)
        share = share_given(share, "a share of a strength")
        if support is not None:
            support = share_given(support, "a part of a stiffness")
        how = self if drive is None else replace(self, drive=choice(drive, DRIVES, "drive"))
        self.require_stiffness()
        is_locked = how.drive == "locked"
        strengths = self.strengths(against)
        with self._in_units():
            starts = how._assembled()
        path = Path(starts, self.points, driven, is_locked, strengths)
        rigid = replace(how, held="rigid", beams=1, off=()).solvers[0]
        held = how.locked | {driven} if is_locked else how.locked
        there = supported(at_rest(rigid, held), self.points, driven)
        far = math.pi / 2.0 if path.is_turn else self.data.size
        return limits_of(path, Asked(share, support, tuple(there), far)).shown(self.units)

    def scatter(
        self,
        position: Quantity | None = None,
        angle: Quantity | None = None,
        thickness: Quantity | None = None,
        *,
        samples: int = 1000,
        seed: int = 0,
        limits: Mapping[str, Quantity] | None = None,
        stroke: str | Sequence[object] | None = None,
        at: object = None,
        against: str | None = None,
        beyond: bool = False,
        workers: int | None = None,
        resume: str | os.PathLike[str] | None = None,
        progress: Progress | None = None,
        name: str | None = None,
    ) -> Any:
        """What the workshop's scatter does to stress, frequencies, errors and force.

        Each clamp is off along and about each direction in which it holds, and each sheet, wire,
        beam and bar is thicker or thinner, all normal and independent. Each sample is sought in one
        way from the state as designed, on one mesh (8 beams a sheet, or as many as the model has),
        and shifted by what finer meshes, if the model has them, make of the design; frequencies are
        linear about it. The first 100 samples are computed on the whole path from
        rest, on all meshes of the model, as well, and the difference is told. Without the deck's
        loads.

        Args:
            position: Standard deviation of the three positions of each clamp [m, or the model's
                unit of length], or a text such as "20um".
            angle: Of its three turns [rad], about its own point.
            thickness: Of the thickness of each part, of a wire its diameter.
            samples: How many. Again as many, and 16 for each input at least, go into the
                total indices.
            seed: The same seed makes the same samples, whatever the number of workers.
            limits: What a good sample keeps, by quantity: "stress", "force", and errors "x" to
                "rz" at most in size, "frequency" and "parasitic" at least, "strength" a part of it,
                such as {"strength": 0.5, "frequency": 9}. By default half of the strength, where it
                is given.
            stroke: As for `flexact.cost`: both ends count beside the state at rest; force and
                errors are those at the farther end.
            at: The point whose errors are told; by default the driven one, as for `flexact.cost`.
            against: As for `limits`.
            beyond: Whether scatter and stroke may be larger than the model.
            workers: So many processes at most; by default one a processor.
            resume: A file that keeps what is done until all is, so that a run that was killed
                goes on where it was.
            progress: Called with what is being done, and how much of it is done, from 0 to 1.
            name: What the result is called; by default the model's name.

        Returns:
            A `flexact.Scatter`.

        Raises:
            UnknownError, ModelError: a point or coordinate is not there.
            ElasticError: nothing has a stiffness, a section or strength that is needed is not
                known, or something else is wrong with what is asked for.
            RequestError: the stroke is not understood.
            StrokeError: the stroke was not reached as designed.
            JournalError: what is to be resumed is of another run.
        """
        return feature("scatter")(
            *(self, position, angle, thickness),
            samples=samples,
            seed=seed,
            limits=limits,
            stroke=stroke,
            at=at,
            against=against,
            beyond=beyond,
            workers=workers,
            resume=resume,
            progress=progress,
            name=name,
        )

    def strengths(self, against: str | None = None) -> Strengths:
        """What the stress in the elastic parts is compared with, in SI units.

        Raises:
            ElasticError: a part has no strength, or no known section; or nothing is elastic.
        """
        return Strengths.of(self.points, self.policy, self.solvers[-1].sections, against)

    def _require_free(self, drive: Coordinate) -> None:
        if self.data.arrays.coordinate_class[drive.axis, drive.node] == Class.FIXED:
            raise ElasticError(
                f"{self.points.words(drive)} is fixed: a clamp is moved with misaligned()"
            )

    @contextmanager
    def _in_units(self) -> Iterator[None]:
        """Say how far a stroke went in the units of its numbers."""
        try:
            yield
        except StrokeError as error:
            raise error.shown(self.units) from None

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
        return self._imperfect(
            misalignment(self.points, node, coordinate, value, about, beyond, self.units)
        )

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
        return self._imperfect(
            equilibria.misfit(self.points, element, deformation, value, beyond, self.units)
        )

    def warmed(
        self,
        by: float,
        parts: object = None,
        gradient: object = None,
        ground: object = None,
        *,
        expansion: object = None,
        about: object = None,
    ) -> Warmed:
        """Bodies and flexures that have changed their temperature, and so their size and shape.

        What has no coefficient of expansion keeps its size, which `describe` says. The ground
        does, too, and with it bodies that are clamped at several places. Moduli stay.

        Args:
            by: By how much they are warmer [K].
            parts: Names or handles of those that are, or numbers of elements; by default all.
            gradient: (3,) of the temperature along x, y, z [K/m]: it bends what it warms.
            ground: How much warmer the ground is [K], and its own coefficient [1/K]; and maybe the
                place about which it expands, by default the mean of all clamps. A ground of
                another place about which it expands goes with all it carries.
            expansion: The coefficient [1/K] of what has none of its own, or coefficients by part,
                which count before those of the model.
            about: Where the temperature has changed by `by`, where it has a gradient; by default
                the middle of the box about the model.

        Raises:
            UnknownError, ModelError: there is no such part.
            ElasticError: nothing has a coefficient, a part that is named has none, a value is no
                finite number; or it is over-constrained, and held rigid.
            StrokeError: no equilibrium was found: rigid parts expand unlike each other.
        """
        warmth = warmth_of(self.points, by, parts, gradient, ground, expansion, about)
        model = replace(self, off=(*self.off, warmth.imperfection(self.data)))
        before = State(self, "before it is warm", None, self._assembled())
        return Warmed(
            model, warmth.words(self.data.units), None, model._assembled(), warmth, before
        )

    def imperfect(
        self,
        misaligned: Iterable[tuple[object, ...]] = (),
        misfit: Iterable[tuple[object, object, object]] = (),
        warmed: float | Mapping[str, Any] | None = None,
        beyond: bool = False,
    ) -> Elastic:
        """The same model with things off in all of its states: for strokes and loads then.

        Args:
            misaligned: Arguments of `misaligned`, of each clamp.
            misfit: Arguments of `misfit`, of each element.
            warmed: By how much it is warmer [K], or arguments of `warmed` by name.
            beyond: Whether something may be larger than the model.

        Raises:
            UnknownError: something is not there.
            ElasticError: something is wrong with a value.
        """
        how = {"beyond": beyond, "units": self.units}
        off = [equilibria.misalignment(self.points, *each, **how) for each in misaligned]  # type: ignore[arg-type]
        off += [equilibria.misfit(self.points, *each, **how) for each in misfit]  # type: ignore[arg-type]
        if warmed is not None:
            given = warmed if isinstance(warmed, Mapping) else {"by": warmed}
            off.append(warmth_of(self.points, **given).imperfection(self.data))
        return replace(self, off=(*self.off, *off))

    def _imperfect(self, off: Imperfection) -> State:
        return replace(self, off=(*self.off, off)).assembled()

    def _assembled(self) -> tuple[Solution, ...]:
        if self.off:
            self.require_determined()
        with self._in_units():
            return tuple(equilibria.assembled(each, self.off, self.locked) for each in self.solvers)

    def state_space(
        self,
        inputs: object,
        outputs: object,
        damping: ArrayLike = 0.01,
        modes: int | None = None,
    ) -> StateSpace:
        """The linear system from forces or base motion to displacements, at rest; see `State`."""
        at_rest = self.assembled() if self.off else self.undeformed()
        return at_rest.state_space(inputs, outputs, damping, modes)

    def __repr__(self) -> str:
        """The choices."""
        return f"<Elastic {self.data.name!r}: {self.words}>"


@dataclass(frozen=True, eq=False, repr=False)
class State(Frozen):
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

    def estimate(self, quantity: Callable[[State], ArrayLike]) -> Estimate:
        """A quantity of this state with its uncertainty, from 8 and 16 beams a sheet.

        Args:
            quantity: What is wanted of a state, such as `lambda s: s.frequencies[0]`.
        """
        return Estimate.of(*map(quantity, self.alone))

    @cached_property
    def alone(self) -> tuple[State, ...]:
        """This state with each of its meshes alone."""
        if len(self.meshes) == 1:
            return (self,)
        return tuple(replace(self, meshes=(at,)) for at in self.meshes)

    def best(self, of: Callable[[Solution], ArrayLike]) -> FloatArray:
        """Numbers of the state of a mesh, extrapolated from those of both."""
        # A zero has no sign.
        return np.array(Estimate.of(*map(of, self.meshes)).value) + 0.0

    def _shown(self, of: Callable[[Solution], ArrayLike], unit: str) -> FloatArray:
        """Numbers of an SI unit in those of the model, as `best`."""
        return self.model.units.shown(self.best(of), unit)

    # -- where it is, and what it carries ------------------------------------------------------

    @property
    def data(self) -> ModelData:
        """The model of the finer mesh, to which `modes` and `configuration` belong."""
        return self.finest.solver.mesh.data

    @cached_property
    def configuration(self) -> Configuration:
        """Where the nodes of the finer mesh are; those of the deck come first."""
        return Configuration(self.data.arrays.node_kind, self.finest.raw.configuration.T)

    def position(self, node: object) -> FloatArray | Angle:
        """Where a node is.

        Returns:
            (3,) position [m], planar (2,); of an orientation its rotation vector (3,) [rad],
            planar its angle, a number (which also is a vector of one).

        Raises:
            UnknownError: there is no such node.
        """
        index = self.model.points.node(node)
        kind = self.model.points.kinds[index]
        if kind == NodeKind.ANGLE:
            return Angle(self.best(lambda at: at.raw.configuration[0, index]))
        if kind == NodeKind.ORIENTATION:
            return self.best(lambda at: vector_of_euler(at.raw.configuration[:, index]))
        axes = 2 if kind == NodeKind.PLANAR_POSITION else 3
        return self._shown(lambda at: at.raw.configuration[:axes, index], "m")

    def deformation(self, element: object, k: object) -> float:
        """A deformation of the deck's element between its own ends, in the deck's units.

        Raises:
            UnknownError: there is no such element or deformation.
        """
        e, number = self.model.points.deformation(element, k)
        is_angle = self.model.points.dual(e, number) == Dual.MOMENT
        return float(self._shown(lambda at: at.deformation[number, e], "rad" if is_angle else "m"))

    def stress(self, element: object, k: object) -> float:
        """The stress dual to a deformation of the deck's element: a force [N].

        Of torsion and bending it is the moment at that end over the element's length; of a
        hinge the moment [N m].

        Raises:
            UnknownError: there is no such element or deformation.
        """
        e, number = self.model.points.deformation(element, k)
        is_moment = self.model.points.dual(e, number) == Dual.MOMENT
        return float(self._shown(lambda at: at.stress[number, e], "N m" if is_moment else "N"))

    def resultants(self, element: object) -> Resultants:
        """Normal force, torque, moments at both ends and shear of the deck's element.

        Raises:
            UnknownError: there is no such element.
        """
        e = self.model.points.element(element)
        made = resultants_of(self.model.data, e, self.best(lambda at: at.stress[:, e]))
        shown = self.model.units.shown
        return replace(
            made,
            torque=shown(made.torque, "N m"),
            moment_y=shown(made.moment_y, "N m"),
            moment_z=shown(made.moment_z, "N m"),
        )

    def peak_stress(self, element: object) -> float:
        """The largest normal stress [Pa] anywhere in an element, or part, of known section.

        Args:
            element: Its number or handle, or the name of a part.

        Raises:
            ModelError: no part, or several, have this name.
            UnknownError: there is no such element.
            ElasticError: its section is not known.
        """
        which = self._of_known_section(element)
        return float(self._shown(lambda at: at.peaks.normal[which].max(), "Pa"))

    def von_mises(self, part: object) -> float:
        """The largest stress of von Mises anywhere in an element, or part, of known section.

        In the model's unit, Pa or MPa. Of normal force, both bendings and torsion; times the
        factor of a fillet at the ends of the part (`FILLET`). Not of shear of bending and
        restrained warping.

        Args:
            part: The number or handle of an element, or the name of a part.

        Raises:
            ModelError: no part, or several, have this name.
            UnknownError: there is no such element.
            ElasticError: its section is not known.
        """
        which = self._of_known_section(part)
        return float(self._shown(lambda at: at.peaks.von_mises[2, which].max(), "Pa"))

    def _of_known_section(self, given: object) -> list[int]:
        which = list(self.model.points.elements(given))
        for element in which:
            self.finest.solver.sections.require(element)
        return which

    @property
    def energy(self) -> float:
        """Elastic energy [J]."""
        return float(self._shown(lambda at: at.energy, "J"))

    @property
    def force(self) -> float:
        """Force of the drive on the mechanism [N], or moment about the driven axis [N m]; signed.

        The axis is that of the spin that changes the angle and nothing else: x, y or z while the
        node turns about that alone. With a free drive compliance, stiffness and frequencies are
        those at this constant force or moment.
        0 where the drive is free and no stroke was asked for.

        Raises:
            ElasticError: several coordinates are locked, or none is declared that could be.
        """
        if self.drive is None and self.model.drive == "free":
            return 0.0
        drive = self.model.drive_of(self.drive)
        unit = "N m" if self.model.points.unit(drive) == "rad" else "N"
        return float(self._shown(lambda at: force_of(at, drive), unit))

    def reaction(self, node: object, coordinate: str) -> float:
        """Force or moment of what holds a coordinate, on the mechanism [N, N m].

        Raises:
            UnknownError: there is no such coordinate.
        """
        where = self.model.points.coordinate(node, coordinate)
        unit = "N m" if self.model.points.unit(where) == "rad" else "N"
        return float(self._shown(lambda at: reaction_of(at, where), unit))

    @property
    def stroke(self) -> float:
        """Where the drive is [m, rad]."""
        drive = self.model.drive_of(self.drive)
        return float(self._shown(lambda at: value_at(at, drive), self.model.points.unit(drive)))

    # -- the deck's own elements and classes ---------------------------------------------------

    @cached_property
    def _reduced(self) -> tuple[RawMatrices, ...]:
        return tuple(self.model.reducer.of(at) for at in self.meshes)

    def _matrix(self, which: int) -> FloatArray:
        made = np.array(Estimate.of(*(each[which] for each in self._reduced)).value)
        # Of what is an angle, a length instead: work and kinetic energy stay.
        size = self.model.reducer.lengths(self.model.units)
        made *= np.outer(size, size)
        return made if which == 0 else self.model.units.shown(made, "N/m")

    @property
    def mass_matrix(self) -> FloatArray:
        """(q, q) in the declared coordinates and deformations, DYNX and DYNE in deck order.

        Like the two others of the deck's own elements with the deck's own classes, where their
        ends are; an Euler parameter counts half the angle.
        """
        return self._matrix(0)

    @property
    def stiffness_matrix(self) -> FloatArray:
        """(q, q) likewise, of the elastic deformations."""
        return self._matrix(1)

    @property
    def geometric_matrix(self) -> FloatArray:
        """(q, q) likewise, of all stresses, those of rigid deformations too."""
        return self._matrix(2)

    @cached_property
    def _verdict(self) -> tuple[int, int, float]:
        mesh = self.finest.solver.mesh
        here = mesh.own_nodes(self.finest.raw.configuration)
        return verdict_of(self.model.result, here, self.finest.solver.elastic[1][mesh.first])

    @property
    def under_constrained(self) -> int:
        """Number of motions here that nothing determines, by the deck's classes."""
        return self._verdict[0]

    @property
    def over_constrained(self) -> int:
        """Number of self-stresses here, by the deck's classes."""
        return self._verdict[1]

    @property
    def smallest_singular_value(self) -> float:
        """The smallest singular value of D(c) itself here, in the deck's units."""
        return self._verdict[2]

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known about the numbers of this state."""
        made, over = [], self.model.result.over_constrained
        if self.model.held == "rigid" and self.finest.is_stressed and over:
            made.append(
                f"over-constrained by {over} and held rigid: of all stresses in equilibrium with "
                "the loads those of least norm are taken"
            )
        if not self.finest.is_confirmed:
            made.append("it is not confirmed that no frequency or multiplier is missing in between")
        return tuple(made)

    # -- how it answers to small changes -------------------------------------------------------

    def compliance(self, node: object) -> FloatArray:
        """Displacements and small turns of a point under unit forces and moments there.

        Args:
            node: Position or orientation node of the point, or its name.

        Returns:
            (6, 6) in the order x y z rx ry rz [m/N, rad/N = 1/N, rad/(N m)]; without an
            orientation (3, 3) x y z, planar (3, 3) x y rz, or (2, 2) x y. What is held or locked
            has 0; what moves without any stiffness is infinite.

        Raises:
            UnknownError: there is no such node.
            ElasticError: nothing has a stiffness.
        """
        return self._of_point(node, self.best(lambda at: self._compliance(at, node).matrix), 1)

    def stiffness(self, node: object) -> FloatArray:
        """The inverse of `compliance`: forces and moments for a unit motion, all else free.

        What is held, or rigid, is infinite; what has no stiffness is 0.

        Raises:
            UnknownError: there is no such node.
            ElasticError: nothing has a stiffness.
        """
        return self._of_point(node, self.best(lambda at: self._compliance(at, node).stiffness), -1)

    def _of_point(self, node: object, matrix: FloatArray, sense: int) -> FloatArray:
        """A compliance (sense 1) or stiffness (-1) of a point in the units of the model."""
        units, points = self.model.units, self.model.points
        if not units.power:
            return matrix
        every = points.coordinates(points.of(node))
        # Of a length per force, and of an angle per moment, which is a force times a length.
        here = np.array([units.factor("m") if points.unit(q) == "m" else 1.0 for q in every])
        made = np.outer(here, here) / units.factor("m")
        return matrix * (made if sense > 0 else 1.0 / made)

    def table(self, point: object, frame: object = "global", at: object = None) -> PointTable:
        """Stiffness and compliance of a point in a frame, principal stiffnesses, centres.

        Args:
            point: A node, a name, also of a body, or a handle.
            frame: "global"; the name of a part, for its axes at rest; or (3, 3) a rotation whose
                columns are its axes.
            at: A place (x, y, z) at rest that is carried with the point; by default the point's.

        Raises:
            UnknownError: there is no such node.
            ModelError: there is no such point or part.
            ElasticError: nothing has a stiffness, the frame is none, or nothing turns with the
                point that could carry another place.
        """
        return table_of(self, point, frame, at)

    def _compliance(self, at: Solution, node: object) -> Compliance:
        at.require_stiffness()
        point = self.model.points.of(node)
        return at.compliance(point, self.model.points.coordinates(point))

    @cached_property
    def frequencies(self) -> FloatArray:
        """Natural frequencies [Hz], ascending: the ten lowest, or all that there are.

        Negative where the square is: an unstable motion. 0 of a motion without stiffness.

        Raises:
            ElasticError: nothing has a mass, or nothing a stiffness.
        """
        self.model.require_mass()
        for at in self.meshes:
            at.require_stiffness()
        values = [at.frequencies for at in self.meshes]
        return np.sort(_estimated(values, matched_by_order).value) + 0.0

    @cached_property
    def modes(self) -> FloatArray:
        """(modes, nodes, 3) displacements and turns of the finer mesh, see `data`."""
        self.model.require_mass()
        return np.moveaxis(self.finest.squares.modes, (0, 1, 2), (2, 1, 0))

    @cached_property
    def multipliers(self) -> FloatArray:
        """By how much the stresses of this state would grow until it buckles, ascending.

        Of both signs, those nearest to zero, ten or more where there are so many: det(K + m G) = 0
        with G of the stresses here. Empty without stress.

        Raises:
            ElasticError: nothing has a stiffness.
        """
        for at in self.meshes:
            at.require_stiffness()
        values = [at.buckling.values for at in self.meshes]
        return np.sort(_estimated(values, matched_by_sign).value) + 0.0

    @cached_property
    def buckling_modes(self) -> FloatArray:
        """(modes, nodes, 3) of the finer mesh, of its own multipliers."""
        return np.moveaxis(self.finest.buckling.modes, (0, 1, 2), (2, 1, 0))

    @property
    def is_stable(self) -> bool:
        """Whether no motion has a negative stiffness; without one, see `loose`."""
        return self.finest.tangent.negative == 0

    @cached_property
    def loose(self) -> tuple[LooseMotion, ...]:
        """Motions without any stiffness."""
        return tuple(
            loose_motion(self.finest, k) for k in range(self.finest.tangent.loose.shape[2])
        )

    def state_space(
        self,
        inputs: object,
        outputs: object,
        damping: ArrayLike = 0.01,
        modes: int | None = None,
    ) -> StateSpace:
        """The linear system about this state, of the finer mesh: A, B, C, D, poles and response.

        Args:
            inputs: One, or a list: a force or moment on (point, coordinate); the motion of what
                is fixed or locked, (clamp, coordinate, "motion"), of all clamps as one
                ("ground", coordinate, "motion"); a pair of opposite forces ((p, "y"), (q, "y")).
                Or texts: "stage:y", "stage:y-base:y", "base:y motion".
            outputs: One, or a list: (point, coordinate); a difference ((p, "y"), (q, "y")); with
                "velocity" behind, its rate. Or texts: "stage:y", "stage:y-base:y",
                "stage:y velocity".
            damping: Modal ratio, one or one a mode; of base motion it acts on the relative one.
            modes: How many, the slowest; what others do statically is in D. None: all.

        Raises:
            UnknownError: a point or coordinate is not there.
            ElasticError: nothing has a mass or a stiffness; something is not understood, a force
                is on what is held, or what is moved is not held; or the mesh is too large.
        """
        self.model.require_mass()
        self.finest.require_stiffness()
        # Of two meshes the finer one.
        beams = 2 * COARSE if self.model.beams == "auto" else self.model.beams
        label = f"{self.label}; {replace(self.model, beams=beams).words}"
        given = inputs, outputs, damping, modes
        return state_space_of(self.finest, self.model.points, *given, label, self.model.units)

    def describe(self) -> str:
        """What it is, its verdict, whether it is stable, frequencies and multipliers, in words."""
        lines = [f"{self.label[:1].upper()}{self.label[1:]}; {self.model.words}."]
        over, under = self.over_constrained, self.under_constrained
        lines.append(
            f"Over-constrained by {over}, under-constrained by {under}, by the deck's classes."
        )
        if self.drive is not None:
            lines.append(f"Force of the drive: {self.force:.6g}.")
        lines.append(f"Elastic energy: {self.energy:.6g} {self.model.units.symbol('J')}.")
        if not self.is_stable:
            lines.append("Buckled: this state is unstable.")
        elif self.loose:
            several = "s" * (len(self.loose) > 1)
            motions = "; ".join(map(str, self.loose[:_MOST_TOLD]))
            lines.append(f"{len(self.loose)} motion{several} without stiffness: {motions}.")
        else:
            lines.append("Stable.")
        if self.model.has_mass:
            every = [each.frequencies for each in self.alone]
            lines.append(f"Frequencies: {_listed(_estimated(every, matched_by_order))} Hz.")
        else:
            lines.append("Nothing has a mass (EM, XM): there are no frequencies.")
        if self.finest.is_stressed:
            try:
                every = [each.multipliers for each in self.alone]
                told = _listed(_estimated(every, matched_by_sign)) or "none"
            except ElasticError as error:
                told = str(error)
            lines.append(f"Multipliers: {told}.")
        return "\n".join((*lines, *(f"Note: {note}." for note in self.notes)))

    def __repr__(self) -> str:
        """What it is a state of."""
        return f"<State: {self.label}, {self.model.words}>"


@dataclass(frozen=True, eq=False, repr=False)
class Warmed(State):
    """A state in which something is warm; made by `Elastic.warmed`.

    Attributes:
        warmth: The change of temperature, and what expands by it; SI.
        before: The state before.
    """

    warmth: Warmth
    before: State

    @cached_property
    def alone(self) -> tuple[State, ...]:
        """This state with each of its meshes alone."""
        if len(self.meshes) == 1:
            return (self,)
        pairs = zip(self.meshes, self.before.alone, strict=True)
        return tuple(replace(self, meshes=(at,), before=before) for at, before in pairs)

    def drift(self, point: object, at: object = None) -> Drift:
        """How a point moves and turns by the warmth, and the place of its body that stays.

        Args:
            point: A node, a name, also of a body, or a handle.
            at: A place (x, y, z) at rest that is carried with it; by default the point's own.

        Raises:
            UnknownError, ModelError: there is no such point.
            ElasticError: nothing turns with the point that could carry another place.
        """
        return drift_of(self, point, at)

    def describe(self) -> str:
        """Drift of each body, thermal centres, forces, stress, frequency, and what was left out."""
        return described(self)

    def to_dict(self) -> dict[str, Any]:
        """The same as the JSON has it, the `warmed` of `docs/table.schema.json`."""
        return found_in(self)


def _estimated(values: Sequence[FloatArray], match: Match) -> Estimate:
    """Eigenvalues of one mesh, or of two, of which `match` finds for each its like."""
    return Estimate.of(*(match(*values) if len(values) > 1 else values))


#: How many eigenvalues are told.
_MOST_TOLD = 6
#: An uncertainty below this part of the value is not told.
_SHOWN = 1.0e-6


def _listed(found: Estimate) -> str:
    """Such as "9.92 (+- 0.01), 403"; the nearest to zero, ascending."""
    least = _SHOWN * np.abs(found.value)
    nearest = np.argsort(np.abs(found.value), kind="stable")[:_MOST_TOLD]
    chosen = sorted(nearest.tolist(), key=lambda k: float(found.value[k]))
    return ", ".join(
        f"{found.value[k]:.5g}"
        + (f" (+- {found.uncertainty[k]:.1g})" if found.uncertainty[k] > least[k] else "")
        for k in chosen
    )


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
    released = releases_given(Points(data), release)
    held, drive = choice(held, HELD, "held"), choice(drive, DRIVES, "drive")
    return Elastic(data, held, drive, released, beams_given(beams))
