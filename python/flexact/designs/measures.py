# SPDX-License-Identifier: BSD-3-Clause
"""What can be asked of a design, and what of that can be limited.

A design is measured by its states: at rest, or at the ends of a stroke, with its drive locked or
free. Of several ends the worst counts.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..analysis.places import listed
from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..costs.request import RequestError
from ..elasticity.elastic import Elastic, State, elastic
from ..elasticity.equilibria import at_rest, value_at
from ..elasticity.errors import ElasticError
from ..elasticity.points import Coordinate
from ..elasticity.stresses import Sections
from ..model.model import Model
from ..show.charts import typed
from ..util.records import Frozen, cached_property
from ..util.rotations import matrix_of, matrix_of_euler
from ..util.units import Units

#: Places before each end of a stroke at which a design must not have buckled, where that is asked.
_BETWEEN = 4
_COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
#: A stiffness that is larger than the softest one times this is rigid.
_RIGID = 1.0e14
#: Motions with singular values below this part of the largest are none.
_NONE = 1.0e-9


class How(NamedTuple):
    """Which states of a design are looked at."""

    beams: int | str
    drive: tuple[object, str] | None
    """The point and coordinate that drive; None: the only one that is declared."""
    ends: tuple[float, ...]
    """Ends of the stroke [m, rad]; none without a stroke."""
    from_rest: bool
    """Whether these count from rest."""
    is_at_end: bool
    """Whether what is to be better is asked there."""
    point: object
    """Where stiffness is asked; None: the driven point."""
    length: float
    """By which rotations compare with displacements [m]."""
    is_followed: bool = False
    """Whether the states before the ends are looked at, too."""


class Design:
    """A design with its states, each of which is computed when it is asked for; in SI."""

    def __init__(self, model: Model, how: How) -> None:
        """Of a model."""
        self.model, self.how = model, how
        self._states: dict[tuple[str, bool], tuple[State, ...]] = {}

    @cached_property
    def locked(self) -> Elastic:
        """The model with its drive locked."""
        made = elastic(self.model, drive="locked", beams=self.how.beams)
        return replace(made, is_si=True)

    @cached_property
    def drive(self) -> tuple[object, str]:
        """The point and coordinate that drive.

        Raises:
            RequestError: there is none, or there are several.
        """
        if self.how.drive is not None:
            return self.how.drive
        found = [
            (self.locked.points.number(q.node), self.locked.points.name(q))
            for q in self.locked.locked
        ]
        if len(found) != 1:
            many = f"several are: {listed([f'{n} {c}' for n, c in found])}" if found else "none is"
            raise RequestError(
                "a drive is the only declared coordinate, but "
                f"{many}; declare one, such as model.independent(point, 'rz'), or name it by "
                "drive=(point, 'rz')"
            )
        return found[0]

    def states(self, drive: str, at_end: bool) -> tuple[State, ...]:
        """At rest, or at the ends of the stroke, with the drive "locked" or "free"."""
        key = drive, at_end
        if key not in self._states:
            model = self.locked if drive == "locked" else replace(self.locked, drive="free")
            if drive == "free":
                # What is known of the model does not depend on the drive.
                for name in ("points", "policy", "solvers", "result"):
                    model.__dict__[name] = getattr(self.locked, name)
            if not at_end:
                self._states[key] = (model.undeformed(),)
            else:
                point, name = self.drive
                values = self.how.ends
                self._states[key] = model.along(point, name, values, from_rest=self.how.from_rest)
        return self._states[key]

    def asked(self, drive: str) -> tuple[State, ...]:
        """The states in which what is to be better is asked."""
        return self.states(drive, self.how.is_at_end)

    def require_stable(self) -> None:
        """Raise where it has buckled, at the ends of the stroke or before.

        Raises:
            ElasticError: it has.
        """
        if not self.how.ends:
            return
        states: Sequence[State] = self.states("locked", True)
        if self.how.is_followed:
            states = (*self.locked.driven(*self._between), *states)
        if not all(state.is_stable for state in states):
            raise ElasticError("it buckles before the end of the stroke")

    @property
    def _between(self) -> tuple[Coordinate, list[float]]:
        """The coordinate of the drive, and places on its way to the ends."""
        coordinate = self.locked.points.coordinate(*self.drive)
        rest = value_at(at_rest(self.locked.solvers[0], self.locked.locked), coordinate)
        ends = [end if self.how.from_rest else end - rest for end in self.how.ends]
        return coordinate, [rest + e * k / _BETWEEN for e in ends for k in range(1, _BETWEEN)]

    def lowest(self, drive: str) -> float:
        """The lowest frequency of any state [Hz]."""
        return min(float(state.frequencies[0]) for state in self.asked(drive))

    def largest_stress(self) -> float:
        """The largest normal stress at the ends of the stroke, in all that has a section [Pa]."""
        known = np.asarray(self.locked.solvers[-1].sections.is_known)
        return max(
            float(state.best(lambda at: at.peaks.normal[known].max()))
            for state in self.states("locked", True)
        )

    def largest_force(self) -> float:
        """The largest force or moment of the drive at the ends of the stroke [N, N m]."""
        return max(abs(state.force) for state in self.states("locked", True))

    def multiplier(self) -> float:
        """By how much the stress at the ends of the stroke may grow until it buckles."""
        found = [state.multipliers for state in self.states("locked", True)]
        return min(float(each[each > 0.0].min(initial=math.inf)) for each in found)

    @cached_property
    def point(self) -> object:
        """Where stiffness is asked: the one that was named, else the driven point."""
        return self.how.point if self.how.point is not None else self.drive[0]

    def along(self, name: str) -> float:
        """Stiffness of the point along or about an axis, all else free and the drive locked."""
        found = []
        for state in self.asked("locked"):
            points = state.model.points
            names = [points.name(q) for q in points.coordinates(points.of(self.point))]
            if name not in names:
                raise ElasticError(f"the point has no coordinate {name}: it has {', '.join(names)}")
            compliance = float(state.compliance(self.point)[names.index(name), names.index(name)])
            if not compliance > 0.0:
                raise ElasticError(f"{name} of the point is held, its stiffness has no end")
            found.append(1.0 / compliance)
        return min(found)

    def stiffness(self) -> tuple[float, float]:
        """Least stiffness across the freedom of the point, and largest along it [N/m].

        x.K x/x.x of twists x, scaled (w L, v), across and along the freedom T of the point with
        all flexures rigid; at the end of a stroke T has turned with the point.
        """
        found = [self._stiffness(state) for state in self.asked("free")]
        return min(worst for worst, _ in found), max(drive for _, drive in found)

    def _stiffness(self, state: State) -> tuple[float, float]:
        points, length = state.model.points, self.how.length
        point = points.of(self.point)
        names = [points.name(q) for q in points.coordinates(point)]
        size = np.array([length if name.startswith("r") else 1.0 for name in names])
        scaled = state.compliance(self.point) * np.outer(size, size)
        values, vectors = np.linalg.eigh(scaled)
        stiff = (vectors / np.maximum(values, values[-1] / _RIGID)) @ vectors.T
        freedom = self._freedom(state, names) * size
        _, singular, rows = np.linalg.svd(freedom)
        rank = int((singular > _NONE * singular.max(initial=1.0e-300)).sum())
        along, across = rows[:rank], rows[rank:]
        if not rank or not len(across):
            return float(np.linalg.eigvalsh(stiff)[0]) if not rank else math.inf, math.nan
        return (
            float(np.linalg.eigvalsh(across @ stiff @ across.T)[0]),
            float(np.linalg.eigvalsh(along @ stiff @ along.T)[-1]),
        )

    def _freedom(self, state: State, names: Sequence[str]) -> FloatArray:
        """(d, coordinates) how the point moves where declared coordinates do, turned with it."""
        position, orientation = state.model.points.of(self.point)
        turned = np.eye(3)
        if orientation >= 0 and state.model.data.planar:
            turned = matrix_of(np.array([0.0, 0.0, state.finest.raw.configuration[0, orientation]]))
        elif orientation >= 0:
            turned = matrix_of_euler(state.finest.raw.configuration[:, orientation])
        rows = []
        for freedom in self.locked.result.freedoms:
            motion = freedom.motion
            if motion is not None:
                turn = motion.rotation[orientation] if orientation >= 0 else np.zeros(3)
                both = np.concatenate([turned @ motion.displacement[position], turned @ turn])
                rows.append(both[[_COORDINATES.index(name) for name in names]])
        return np.array(rows).reshape(-1, len(names))


class Asked(NamedTuple):
    """What can be asked of a design."""

    unit: str
    of: Callable[[Design], float]
    needs: tuple[str, ...] = ()
    """Of "mass", "drive", "stroke", "section"."""
    is_positive: bool = True


#: By its name, the keys of `scores` without their underscores.
ASKED: dict[str, Asked] = {
    "first frequency": Asked("Hz", lambda d: d.lowest("free"), ("mass",)),
    "first parasitic frequency": Asked("Hz", lambda d: d.lowest("locked"), ("mass", "drive")),
    "worst stiffness": Asked("N/m", lambda d: d.stiffness()[0], ("point",)),
    "drive stiffness": Asked("N/m", lambda d: d.stiffness()[1], ("drive",)),
    "separation": Asked("", lambda d: d.stiffness()[0] / d.stiffness()[1], ("drive",)),
    **{
        f"stiffness {name}": Asked(
            "N m/rad" if name.startswith("r") else "N/m",
            lambda d, name=name: d.along(name),  # type: ignore[misc]
            ("point",),
        )
        for name in _COORDINATES
    },
    "stress": Asked("Pa", Design.largest_stress, ("stroke", "section")),
    "drive force": Asked("N", Design.largest_force, ("stroke", "force")),
    "drive moment": Asked("N m", Design.largest_force, ("stroke", "moment")),
    "buckling": Asked("", Design.multiplier, ("stroke",)),
    "room": Asked("m3", lambda d: float(np.prod(box_of(d.model))), ()),
    **{
        f"size {'xyz'[k]}": Asked("m", lambda d, k=k: float(box_of(d.model)[k]), ())  # type: ignore[misc]
        for k in range(3)
    },
}


def box_of(model: Model) -> FloatArray:
    """(3,) sides of the box around all points, and around the flexures with their sections [m]."""
    data = model.data
    places = data.arrays.node_value[:3, data.arrays.node_kind <= NodeKind.POSITION].T
    found = [places]
    sections = Sections.of(data)
    which = np.flatnonzero(sections.is_known)
    if which.size and not data.planar:
        frames, half = data.frames.frame[which], sections.size[:, which].T / 2.0
        across = np.abs(frames[:, :, 1]) * half[:, :1] + np.abs(frames[:, :, 2]) * half[:, 1:]
        for slot in (0, 2):
            ends = data.arrays.node_value[:3, data.arrays.element_node[slot, which] - 1].T
            found += [ends - across, ends + across]
    return np.asarray(np.ptp(np.vstack(found), axis=0))


@dataclass(frozen=True, eq=False)
class Bound(Frozen):
    """A limit.

    Attributes:
        name: What is limited, of `ASKED`.
        value: The limit, in SI.
        is_least: Whether it may be no less, instead of no more.
    """

    name: str
    value: float
    is_least: bool

    @property
    def key(self) -> str:
        """What it is called beside others."""
        return f"least {self.name}" if self.is_least else self.name

    def use(self, found: float) -> float:
        """How far it is used: at most 1 keeps it."""
        if not self.is_least:
            return found / self.value
        return self.value / found if found > 0.0 else 2.0 - found / self.value

    def found(self, use: float) -> float:
        """What was found where it is used so far."""
        return self.value / use if self.is_least else self.value * use

    def words(self, units: Units) -> str:
        """Such as "stress at most 300 MPa"."""
        least = "at least" if self.is_least else "at most"
        return f"{self.name} {least} {said(self.value, ASKED[self.name].unit, units)}"


def said(value: float, unit: str, units: Units, digits: int = 4) -> str:
    """A value of an SI unit in words, in the units of the model."""
    if unit == "rad":
        return f"{math.degrees(value):.{digits}g} deg"
    if units.power and unit not in ("Hz", ""):
        return units.said(value, unit, digits)
    if unit in ("", "m3", "N", "N m"):
        return f"{value:.{digits}g} {unit}".strip()
    return typed(value, unit, digits)
