# SPDX-License-Identifier: BSD-3-Clause
"""From one equilibrium to the next: along loads, imperfections and strokes."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence

import numpy as np

from ..core import elastic
from ..core.arrays import FloatArray
from ..core.elastic import Waypoint
from ..core.elements import NodeKind
from ..util.text import in_short
from .errors import ElasticError, StrokeError, StrokeWarning
from .imperfections import Imperfection, dual_to_parameters
from .mesh import Mesh
from .points import Coordinate, Points
from .solution import Held, Solution, Solver


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


def warn_where_far(values: Sequence[float], rest: float, what: str) -> None:
    """Warn of a stroke that is surely meant from where it rests."""
    if is_far(values, rest):
        warnings.warn(
            f"{what} rests at {rest:.6g}, and the stroke from {values[0]:.6g} to {values[-1]:.6g} "
            f"begins {abs(values[0] - rest):.6g} from there: is from_rest=True meant?",
            StrokeWarning,
            stacklevel=3,
        )


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
        return _reached(start, way, 0.0, off[0].value, off[0].words)
    return _reached(start, way, 0.0, 1.0, "part of what is off")


def loaded(start: Solution, factor: float) -> Solution:
    """Equilibrium under the deck's loads times a factor, ramped from none.

    Raises:
        StrokeError: it was not reached.
    """
    force, gravity = start.solver.loads(factor)
    way = start.way._replace(force=force, gravity=gravity)
    return _reached(start, way, 0.0, factor, "the loads, as a factor")


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
        before, way = (
            each.way._replace(target=with_drive(solver, each.way.target, drive, value))
            for each, value in ((here, last), (start, values[k]))
        )
        held_here = Solution(solver, here.raw, before, held)
        here = _reached(held_here, way, last, values[k], points.words(drive))
        last = values[k]
        found[k] = here if locked else freed(here, start.held, drive)
    return tuple(found[k] for k in range(len(values)))


def _reached(start: Solution, way: Waypoint, begin: float, end: float, what: str) -> Solution:
    """The equilibrium at the end of a way, on which something goes from one value to another.

    Raises:
        StrokeError: it was not reached.
    """
    solver = start.solver
    model = solver.model(start.held)
    found = elastic.equilibrium(model, solver.arrays, start.raw, start.way, way)
    if found.status == "done":
        return Solution(solver, found.state, way, start.held)
    reached = begin + found.reached * (end - begin)
    place = _place(solver.mesh, found.place)
    where = f", where it stopped at {place}" if place else ""
    raise StrokeError(
        f"no equilibrium was found beyond {reached:.6g} on the way from {begin:.6g} to "
        f"{end:.6g} of {what}{where}: {_WHY.get(found.status, _SNAPS)}",
        reached,
        place,
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
