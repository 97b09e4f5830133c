# SPDX-License-Identifier: BSD-3-Clause
"""From one equilibrium to the next: along what is not as designed, loads and strokes.

Not as designed are clamps moved or turned, elements of other lengths, and warmth.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..core import elastic
from ..core.arrays import FloatArray
from ..core.elastic import Waypoint
from ..core.elements import Class, Dual, NodeKind, dual_table
from ..model.data import ModelData
from ..util.quantities import without_units
from ..util.records import Frozen
from ..util.rotations import matrix_of, turned
from ..util.text import in_short
from ..util.units import Units
from .errors import ElasticError, StrokeError, require_within
from .mesh import Mesh
from .points import Coordinate, Points
from .solution import Held, Solution, Solver


class Angle(float):
    """An angle [rad]: a number, and a vector of one where positions are gone through alike."""

    def __getitem__(self, index: int) -> float:
        """The number."""
        return (float(self),)[index]

    def __iter__(self) -> Iterator[float]:
        """The number, once."""
        yield float(self)

    def __len__(self) -> int:
        """One."""
        return 1


def dual_to_parameters(euler: FloatArray, moment: FloatArray) -> FloatArray:
    """(3,) what does work on twice the changes of lambda1..3, of a moment (3,) on the spin.

    The spin is 2 (l0 dl - dl0 l - dl x l) with dl0 = -(l . dl)/l0.
    """
    unit = euler / np.linalg.norm(euler)
    scalar, vector = unit[0], unit[1:]
    return np.asarray(
        scalar * moment + (vector @ moment) / scalar * vector - np.cross(vector, moment)
    )


@dataclass(frozen=True, eq=False)
class Imperfection(Frozen):
    """What moves the supports of a model or changes its elements, by a value.

    Attributes:
        words: What it is, such as "x of clamp 11".
        value: How much: m, rad, K, or the unit of a deformation.
        unit: Its SI unit.
        axis: Along or about which of the global axes supports move; -1 where they do not.
        is_turn: Whether they turn.
        centre: (3,) about which they do.
        moved: (3, nodes) which of the held coordinates follow, as the deck numbers nodes.
        misfit: (6, elements) by how much the deck's elements are off for each unit.
        spread: (3, nodes) by how much positions of the supports move besides for each unit, as
            of ground that expands.
    """

    words: str
    value: float
    unit: str
    axis: int
    is_turn: bool
    centre: FloatArray
    moved: FloatArray
    misfit: FloatArray
    spread: FloatArray

    def label(self, units: Units) -> str:
        """Such as "off: x of clamp 11 by 5e-05"."""
        return f"off: {self.words} by {units.shown(self.value, self.unit):g}"

    def shift(self, data: ModelData) -> FloatArray:
        """(3, nodes) velocity of the supports for each unit."""
        if self.axis < 0:
            return np.asfortranarray(self.spread)
        made = np.zeros(self.moved.shape, order="F")
        direction = np.eye(3)[self.axis]
        turns = data.arrays.node_kind > NodeKind.POSITION
        if not self.is_turn:
            made[:, ~turns] = direction[:, None]
        else:
            arm = data.arrays.node_value[:3, ~turns] - self.centre[:, None]
            made[:, ~turns] = np.cross(direction, arm.T).T
            made[:, turns] = direction[:, None]
        return np.asfortranarray(made * self.moved)

    def moved_to(self, value: FloatArray, data: ModelData) -> FloatArray:
        """(4, nodes) where the supports are at `value` (4, nodes) after it."""
        made = value.copy(order="F")
        made[:3] += self.value * self.spread
        if self.axis < 0:
            return made
        direction = np.eye(3)[self.axis]
        for node in np.flatnonzero(self.moved.any(axis=0)).tolist():
            kind, there = data.arrays.node_kind[node], self.moved[:, node] > 0.0
            if kind == NodeKind.ANGLE:
                made[0, node] += self.value
            elif kind == NodeKind.ORIENTATION:
                # Of single Euler parameters those that are held count.
                made[:, node] = turned(value[:, node][None], self.value * direction[None])[0]
            else:
                old = value[:3, node]
                new = old + self.value * direction
                if self.is_turn:
                    new = self.centre + matrix_of(self.value * direction) @ (old - self.centre)
                made[:3, node][there] = new[there]
        return made


def number_given(value: object, what: str) -> float:
    """A finite number.

    Raises:
        ElasticError: it is none.
    """
    if (
        isinstance(value, bool)
        or not isinstance(value, (int, float, np.number))
        or not math.isfinite(value)
    ):
        raise ElasticError(f"{what} must be a finite number, not {in_short(value)}")
    return float(value)


def _none(data: ModelData, words: str, value: float, unit: str) -> Imperfection:
    nodes, elements = data.arrays.node_number.size, data.arrays.element_number.size
    none = np.zeros((3, nodes))
    return Imperfection(
        words, value, unit, -1, False, np.zeros(3), none, np.zeros((6, elements)), none.copy()
    )


def misalignment(
    points: Points,
    node: object,
    name: object,
    value: object,
    about: object = None,
    beyond: bool = False,
    units: Units | None = None,
) -> Imperfection:
    """A clamp that is moved along, or turned about, a global axis.

    Raises:
        UnknownError: there is no such node or coordinate.
        ElasticError: the coordinate is not held, or the value is no finite number; or it is
            larger than the model, and not `beyond`.
    """
    coordinate = points.coordinate(node, name)
    data = points.data
    is_turn = data.arrays.node_kind[coordinate.node] > NodeKind.POSITION
    unit = "rad" if is_turn else "m"
    taken = (units or data.units).symbol(unit)
    size = number_given(without_units(value, taken), "a misalignment")
    # The clamp has the number that was given for it.
    words = f"{points.name(coordinate)} of clamp {points.number(points.node(node))}"
    if not beyond:
        require_within(size, data.size, bool(is_turn), f"the misalignment {words}", data.units)
    point = points.of(node)
    fixed = (data.arrays.coordinate_class == Class.FIXED).astype(np.float64)
    nodes = [point.position]
    if is_turn:
        # Orientations that turn with the clamp: of a position all that are held there.
        index = points.node(node)
        nodes = [index]
        if points.kinds[index] <= NodeKind.POSITION:
            every = points.turned_at(index)
            nodes = [each for each in every if fixed[:, each].any()] or every[:1]
        if point.position >= 0:
            nodes.append(point.position)
    moved = np.zeros_like(fixed)
    moved[:, nodes] = fixed[:, nodes]
    centre = np.zeros(3)
    if is_turn:
        if about is not None:
            centre = points.place(about)
        elif point.position >= 0:
            centre = points.place(points.number(point.position))
    elif about is not None:
        raise ElasticError("only a turn is about a point: leave out `about` of a displacement")
    made = replace(
        _none(data, words, size, unit),
        axis=coordinate.axis,
        is_turn=bool(is_turn),
        centre=centre,
        moved=moved,
    )
    held = moved[coordinate.axis, [n for n in nodes if n != point.position or not is_turn]]
    if not held.any() and not (about is not None and made.shift(data).any()):
        raise ElasticError(
            f"{points.words(coordinate)} is not held: a misalignment is that of a coordinate that "
            f"the deck fixes (FIX); drive a declared one with along()"
        )
    return made


def misfit(
    points: Points,
    element: object,
    k: object,
    value: object,
    beyond: bool = False,
    units: Units | None = None,
) -> Imperfection:
    """An element made too long, twisted or bent, in the deck's units.

    Raises:
        UnknownError: there is no such element or deformation.
        ElasticError: the value is no finite number; or it is larger than the model, and not
            `beyond`.
    """
    index, number = points.deformation(element, k)
    data = points.data
    off = np.zeros((6, data.arrays.element_number.size))
    off[number, index] = 1.0
    words = f"deformation {number + 1} of element {int(data.arrays.element_number[index])}"
    is_angle = dual_table()[data.arrays.element_kind[index], number] == Dual.MOMENT
    unit = "rad" if is_angle else "m"
    taken = (units or data.units).symbol(unit)
    size = number_given(without_units(value, taken), "a misfit")
    if not beyond:
        require_within(size, data.size, bool(is_angle), f"the misfit, {words},", data.units)
    return replace(_none(data, words, size, unit), misfit=off)


def order_of(values: Sequence[float], start: float) -> list[int | None]:
    """In which order values are driven to; None: back at the start.

    Values that ascend or descend are driven to from the start outward, first those beyond it
    one way and then those the other way; others in their order, one after another.
    """
    steps = np.diff(values)
    if values and not ((steps >= 0.0).all() or (steps <= 0.0).all()):
        return list(range(len(values)))
    far = np.argsort(np.abs(np.asarray(values) - start), kind="stable").tolist()
    below = [k for k in far if values[k] < start]
    above = [k for k in far if values[k] >= start]
    return [*above, None, *below]


def value_at(at: Solution, drive: Coordinate) -> float:
    """The value of a coordinate: a position [m], or an angle [rad]."""
    node, axis = drive
    here = at.raw.configuration[:, node]
    kind = at.solver.mesh.own.arrays.node_kind[node]
    if kind == NodeKind.ANGLE:
        return float(here[0])
    if kind == NodeKind.ORIENTATION:
        sine = float(here[1 + axis]) / float(np.linalg.norm(here))
        return 2.0 * math.asin(min(1.0, max(-1.0, sine)))
    return float(here[axis])


def force_of(at: Solution, drive: Coordinate) -> float:
    """Force of a drive on the mechanism [N], or moment [N m] about the axis of its spin."""
    node, axis = drive
    reaction = at.raw.reaction[:, node]
    if at.solver.mesh.own.arrays.node_kind[node] != NodeKind.ORIENTATION:
        return float(reaction[axis])
    if at.is_whole(node):
        reaction = dual_to_parameters(at.raw.configuration[:, node], reaction)
    return float(reaction[axis]) * math.cos(value_at(at, drive) / 2.0)


def reaction_of(at: Solution, held: Coordinate) -> float:
    """Force [N] or moment [N m] of what holds a coordinate; about an axis of a whole clamp."""
    node, axis = held
    return float(at.raw.reaction[axis, node]) if at.is_whole(node) else force_of(at, held)


def freed(at: Solution, held: Held, drive: Coordinate) -> Solution:
    """The state with the drive free: its force or moment stays constant."""
    raw = at.raw
    if at.is_whole(drive.node):
        reaction = raw.reaction.copy(order="F")
        here = raw.configuration[:, drive.node]
        reaction[:, drive.node] = dual_to_parameters(here, reaction[:, drive.node])
        raw = raw._replace(reaction=reaction)
    return Solution(at.solver, raw, at.way, held)


def strokes_given(values: object, is_turn: bool, rest: float) -> list[float]:
    """The values of a stroke, or the only one, added to `rest`; `is_turn`: of an Euler parameter.

    Raises:
        ElasticError: one is no finite number, or an angle of more than half a turn.
    """
    try:
        made = np.atleast_1d(np.asarray(values, np.float64))
    except (TypeError, ValueError):
        raise ElasticError(f"a stroke has values, not {in_short(values)}") from None
    if made.ndim != 1 or not np.isfinite(made).all():
        raise ElasticError(f"a stroke has finite values in a row, not {in_short(values)}")
    made = made + rest
    if is_turn and (np.abs(made) >= math.pi).any():
        raise ElasticError("an angle of a stroke must be within half a turn, below pi")
    return [float(value) for value in made]


def is_far(values: Sequence[float], rest: float) -> bool:
    """Whether a stroke is surely meant from where it rests: about zero, and far from there."""
    if not values:
        return False
    low, high, most = min(values), max(values), max(map(abs, values))
    away = max(low - rest, rest - high)
    return away > most and (low <= 0.0 <= high or away > 3.0 * most)


def with_drive(solver: Solver, target: FloatArray, drive: Coordinate, value: float) -> FloatArray:
    """The targets (4, nodes) with that of a driven coordinate at a value."""
    node, axis = drive
    made = target.copy(order="F")
    kind = solver.mesh.own.arrays.node_kind[node]
    if kind == NodeKind.ANGLE:
        made[0, node] = value
    elif kind == NodeKind.ORIENTATION:
        made[1 + axis, node] = math.sin(value / 2.0)
        # Where all of them are held, lambda0 follows.
        rest = math.sqrt(max(0.0, 1.0 - float(np.sum(made[1:, node] ** 2))))
        made[0, node] = math.copysign(rest, made[0, node])
    else:
        made[axis, node] = value
    return made


#: Why there may be no equilibrium, by how the core ended.
_WHY = {
    "inconsistent": "what is rigid cannot follow any farther",
    "unheld": "a load acts along a motion that nothing resists",
}
_SNAPS = "it snaps or buckles there, or comes to the end of its reach; smaller steps change nothing"


def at_rest(solver: Solver, held: Held) -> Solution:
    """The undeformed state."""
    return Solution(solver, solver.at_rest, solver.nothing, held)


def assembled(solver: Solver, off: Sequence[Imperfection], held: Held) -> Solution:
    """The state without loads, with what is off.

    Raises:
        StrokeError: it was not reached.
    """
    start = at_rest(solver, held)
    if not off:
        return start
    # Where the supports are and what is off of the pieces, without loads.
    own, many = solver.mesh.own, solver.mesh.nodes
    target = solver.at_rest.configuration.copy(order="F")
    misfit = np.zeros((6, own.arrays.element_number.size))
    for each in off:
        target[:, :many] = each.moved_to(target[:, :many], own)
        misfit += each.value * each.misfit
    way = solver.nothing._replace(target=target, misfit=solver.mesh.misfit(misfit))
    if len(off) == 1:
        return reached(start, way, 0.0, off[0].value, off[0].words, off[0].unit)
    return reached(start, way, 0.0, 1.0, "part of what is off", "")


def loaded(start: Solution, factor: float) -> Solution:
    """Equilibrium under the deck's loads times a factor, ramped from none.

    Raises:
        StrokeError: it was not reached.
    """
    force, gravity = start.solver.loads(factor)
    way = start.way._replace(force=force, gravity=gravity)
    return reached(start, way, 0.0, factor, "the loads, as a factor", "")


def driven(
    start: Solution, points: Points, drive: Coordinate, values: Sequence[float], locked: bool
) -> tuple[Solution, ...]:
    """Equilibria at values of a driven coordinate, in the order of `order_of`.

    Raises:
        StrokeError: one was not reached.
    """
    solver, held = start.solver, start.held | {drive}
    begin = value_at(start, drive)
    found: dict[int, Solution] = {}
    here, last = start, begin
    for k in order_of(values, begin):
        if k is None:
            here, last = start, begin
            continue
        before = here.way._replace(target=with_drive(solver, here.way.target, drive, last))
        way = start.way._replace(target=with_drive(solver, start.way.target, drive, values[k]))
        held_here = Solution(solver, here.raw, before, held)
        what, unit = points.words(drive), points.unit(drive)
        here = reached(held_here, way, last, values[k], what, unit)
        last = values[k]
        found[k] = here if locked else freed(here, start.held, drive)
    return tuple(found[k] for k in range(len(values)))


def reached(
    start: Solution, way: Waypoint, begin: float, end: float, what: str, unit: str
) -> Solution:
    """The equilibrium at the end of a way, on which something goes from one value to another.

    Raises:
        StrokeError: it was not reached.
    """
    solver = start.solver
    found = elastic.equilibrium(solver.model(start.held), solver.arrays, start.raw, start.way, way)
    if found.status == "done":
        return Solution(solver, found.state, way, start.held)
    reached = begin + found.reached * (end - begin)
    place = _place(solver.mesh, found.place)
    low, here, high = (solver.mesh.own.units.shown(x, unit) for x in (begin, reached, end))
    where = f", where it stopped at {place}" if place else ""
    raise StrokeError(
        f"no equilibrium was found beyond {here:.6g} on the way from {low:.6g} to "
        f"{high:.6g} of {what}{where}: {_WHY.get(found.status, _SNAPS)}",
        reached,
        place,
        unit,
    )


def _place(mesh: Mesh, place: int) -> str:
    """What the core means: a coordinate 3 node + axis, or -1 - (6 element + deformation)."""
    if place >= 0:
        node, axis = divmod(place, 3)
        if node < mesh.nodes:
            return Points(mesh.own).words(Coordinate(node, axis))
        touched = (mesh.data.arrays.element_node == node + 1).any(axis=0)
        element = mesh.owner[int(np.argmax(touched))]
        return f"the middle of element {int(mesh.own.arrays.element_number[element])}"
    piece, k = divmod(-1 - place, 6)
    element = mesh.owner[piece]
    return f"deformation {k + 1} of element {int(mesh.own.arrays.element_number[element])}"
