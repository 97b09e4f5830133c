# SPDX-License-Identifier: BSD-3-Clause
"""From one equilibrium to the next: along loads, imperfections and strokes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core import elastic
from ..core.elastic import ElasticState, RawEquilibrium, Waypoint
from .imperfections import Imperfection
from .points import Coordinate, Points
from .solution import Solution
from .solver import Held, Solver
from .stiffness_drives import freed, order_of, value_at, with_drive
from .stiffness_errors import StrokeError
from .stiffness_mesh import Mesh

DONE = "done"
#: Why there may be no equilibrium, by how the core ended.
_WHY = {
    "": "it snaps or buckles there, or comes to the end of its reach; smaller steps change nothing",
    "inconsistent": "what is rigid cannot follow any farther",
    "unheld": "a load acts along a motion that nothing resists",
}


def built(solver: Solver, off: Sequence[Imperfection]) -> Waypoint:
    """Where the supports are and what is off of the pieces, without loads."""
    own = solver.mesh.own
    target = solver.at_rest.configuration.copy(order="F")
    mine = target[:, : solver.mesh.nodes]
    misfit = np.zeros((6, own.arrays.element_number.size))
    for each in off:
        mine = each.moved_to(mine, own)
        misfit += each.value * each.misfit
    target[:, : solver.mesh.nodes] = mine
    return solver.nothing._replace(target=target, misfit=solver.mesh.misfit(misfit))


def at_rest(solver: Solver, held: Held) -> Solution:
    """The undeformed state."""
    return Solution(solver, solver.at_rest, solver.nothing, held)


def assembled(solver: Solver, off: Sequence[Imperfection], held: Held) -> Solution:
    """The state without loads, with what is off.

    Raises:
        StrokeError: it was not reached.
    """
    if not off:
        return at_rest(solver, held)
    way = built(solver, off)
    found = _go(solver, held, solver.at_rest, solver.nothing, way)
    if found.status != DONE:
        size = off[0].value if len(off) == 1 else 1.0
        what = off[0].words if len(off) == 1 else "part of what is off"
        raise _stopped(solver.mesh, found, 0.0, size, what)
    return Solution(solver, found.state, way, held)


def loaded(start: Solution, factor: float) -> Solution:
    """Equilibrium under the deck's loads times a factor, ramped from none.

    Raises:
        StrokeError: it was not reached.
    """
    solver = start.solver
    force, gravity = solver.loads(factor)
    way = start.way._replace(force=force, gravity=gravity)
    found = _go(solver, start.held, start.raw, start.way, way)
    if found.status != DONE:
        raise _stopped(solver.mesh, found, 0.0, factor, "the loads, as a factor")
    return Solution(solver, found.state, way, start.held)


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
        there = values[k]
        way = start.way._replace(target=with_drive(solver, start.way.target, drive, there))
        before = here.way._replace(target=with_drive(solver, here.way.target, drive, last))
        raw = _go(solver, held, here.raw, before, way)
        if raw.status != DONE:
            raise _stopped(solver.mesh, raw, last, there, points.words(drive))
        here, last = Solution(solver, raw.state, way, held), there
        found[k] = here if locked else freed(here, start.held, drive)
    return tuple(found[k] for k in range(len(values)))


def _go(
    solver: Solver, held: Held, start: ElasticState, begin: Waypoint, end: Waypoint
) -> RawEquilibrium:
    return elastic.equilibrium(solver.model(held), solver.arrays, start, begin, end)


def _stopped(mesh: Mesh, found: RawEquilibrium, begin: float, end: float, what: str) -> StrokeError:
    """The error of a path that ended early."""
    reached = begin + found.reached * (end - begin)
    place = _place(mesh, found.place)
    where = f", where it stopped at {place}" if place else ""
    return StrokeError(
        f"no equilibrium was found beyond {reached:.6g} on the way from {begin:.6g} to "
        f"{end:.6g} of {what}{where}: {_WHY.get(found.status, _WHY[''])}",
        reached,
        place,
    )


def _place(mesh: Mesh, place: int) -> str:
    """What the core means: a coordinate 3 node + axis, or -1 - (6 element + deformation)."""
    if place >= 0:
        node, axis = divmod(place, 3)
        if node < mesh.nodes:
            points = Points(mesh.own)
            return points.words(Coordinate(node, axis))
        touched = (mesh.data.arrays.element_node == node + 1).any(axis=0)
        element = mesh.owner[int(np.argmax(touched))]
        return f"the middle of element {int(mesh.own.arrays.element_number[element])}"
    piece, k = divmod(-1 - place, 6)
    element = mesh.owner[piece]
    return f"deformation {k + 1} of element {int(mesh.own.arrays.element_number[element])}"
