# SPDX-License-Identifier: BSD-3-Clause
"""Lines along which a wire stops one unwanted motion of a body and nothing that is wanted.

A wire holds its end against motion along it. With W the wanted twists, U the rest of what the
body can do, and g the force along a line, the wire stops nothing wanted where g does no work on
W, and one motion of U where it does some on U. At a point p that means: the line is perpendicular
to the velocities of p in W, and not to all those in U. Its condition is the size of g over the
part of it that does work on U, moments in forces: the larger, the weaker it holds.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from ...analysis.change import AddedSheet, AddedWire, Change
from ...analysis.naming import Named, Pieces, row_of
from ...analysis.places import axis_words, direction_words, node_words, others_words, place_words
from ...analysis.result import Result
from ...analysis.screws import sense_of
from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind
from ...util.errors import FlexactError
from ...util.groups import distinct
from ...util.records import Frozen
from ..step import Purpose, Step, after, analysed
from .screws import SAME, Family, FamilyKind, ScrewSpace
from .subjects import Attachment, Freed, Site, Subject
from .wanted_motion import Aim
from .words import Geometry


@dataclass(frozen=True, eq=False, repr=False)
class Added(Step):
    """Wires or a sheet that are added."""

    def words(self) -> Pieces:
        """Where they end on the body, and along what they run."""
        return ("add ", *added_in_words(self.analysis, self.change))


def added_in_words(result: Result, change: Change) -> Pieces:
    """The wires or the sheet of a change: where they end on the body, along what they run."""
    geometry = Geometry.of_mechanism(result)
    added: list[AddedWire | AddedSheet] = [*change.wires, *change.sheets]
    return row_of([wire_in_words(result, geometry, each) for each in added])


def wire_in_words(result: Result, geometry: Geometry, wire: AddedWire | AddedSheet) -> Pieces:
    """Such as "a wire from the stage, where sheet 1 ends, along y"."""
    parts = result.parts
    node = parts.data.node_index[wire.position]
    end, ground = np.array(wire.end), np.array(wire.ground)
    along, word = f" along {direction_words(ground - end)}", "wire"
    if isinstance(wire, AddedSheet):
        along, word = f"{along}, wide along {axis_words(np.array(wire.width))}", "sheet"
    turned = parts.data.node_index[wire.orientation]
    owner = node_words(parts, turned) if turned in parts.body_at else ""
    there = node_words(parts, turned) if parts.is_shared(turned) else place_words(parts, node)
    if not np.array_equal(parts.data.arrays.node_value[:3, node], end):
        link = Named("node", wire.position, owner or there)
        return (f"a {word} from {geometry.point(end)}, on a link to ", link, f",{along}")
    here = [part for part in parts.at(node) if part.kind is not PartKind.BODY]
    if there != owner:
        where = ""
    elif here:
        where = f", where {others_words(here)} end{'s' * (len(here) == 1)},"
    else:
        where = f" at {geometry.point(end)}"
    return (f"a {word} from ", Named("node", wire.position, there), where + along)


#: A line that is weaker than this, by its condition, is none.
_WEAKEST = 100.0
#: Forces along lines with a larger cosine are much the same.
_ALIKE = 0.95
#: What a link costs, and a direction in which no flexure runs yet, as factors of the condition.
LINK, _NEW_DIRECTION = 1.5, 1.2


@dataclass(frozen=True, eq=False)
class Line(Frozen):
    """A line along which a wire may be put.

    Attributes:
        attachment: Where it ends on the body.
        direction: (3,) unit vector.
        force: (6,) the force along it, scaled as the rows of a space, of size one.
        condition: How weakly it holds, from 1.
        cost: By what it is chosen: the condition, more for a link or a direction that is new.
    """

    attachment: Attachment
    direction: FloatArray
    force: FloatArray
    condition: float
    cost: float


def lines_for(site: Site, aim: Aim) -> list[Line]:
    """Lines that stop one unwanted motion and nothing wanted, the best first."""
    own = [line for each in site.own for line in _through(site, aim, each)]
    carried = site.carried(aim.may_hold)
    found = [*own, *(line for each in carried for line in _through(site, aim, each))]
    if not found:
        # Of a body that is small, or all on one line, links reach out.
        found = [line for each in site.reached for line in _through(site, aim, each)]
    # Lines through one point keep their order, that of the names of the flexures along which
    # they run.
    found.sort(key=lambda line: (round(line.cost, 6), line.attachment.key))
    return distinct(found, lambda line, other: bool(abs(line.force @ other.force) >= _ALIKE))


def _through(site: Site, aim: Aim, at: Attachment) -> Iterator[Line]:
    """Lines through a point: the one that holds best, and those along and across flexures."""
    length = aim.freedom.length
    arm = at.place - aim.freedom.about
    wanted, unwanted = _velocities(aim.wanted, arm, length), _velocities(aim.unwanted, arm, length)
    able = _able(wanted, arm / length, aim.freedom.planar)
    if not len(able) or not len(unwanted):
        return
    # A unit force at p is a wrench of size^2 = 1 + |arm x f|^2 / length^2.
    moment = np.cross(arm / length, able)
    sizes = np.linalg.cholesky(np.eye(len(able)) + moment @ moment.T)
    back = np.linalg.inv(sizes)
    _, values, right = np.linalg.svd(unwanted @ able.T @ back.T)
    best = [each @ back @ able for each in _strongest(values, right, able, back, site, arm)]
    free = np.eye(3) - able.T @ able
    known = [each for each in site.directions if np.linalg.norm(free @ each) <= SAME]
    for direction in (*known, *best):
        unit = direction / np.linalg.norm(direction)
        unit = sense_of(unit) * unit
        force = np.concatenate((unit, np.cross(arm / length, unit)))
        size = float(np.linalg.norm(force))
        work = float(np.linalg.norm(unwanted @ unit))
        if work * _WEAKEST < size:
            continue
        is_known = any(abs(unit @ each) > 1.0 - SAME for each in known)
        cost = size / work * (1.0 if at.is_there else LINK)
        yield Line(
            *(at, unit, force / size, size / work), cost * (1.0 if is_known else _NEW_DIRECTION)
        )


def _strongest(
    values: FloatArray,
    vectors: FloatArray,
    able: FloatArray,
    back: FloatArray,
    site: Site,
    arm: FloatArray,
) -> Iterator[FloatArray]:
    """Of each set of equal singular values one vector, that does not depend on the basis.

    Of several it is the one nearest to the first direction of a flexure, to the arm or to an axis.
    """
    there = values[values > SAME]
    first = 0
    while first < there.size:
        same = np.flatnonzero(np.abs(there - there[first]) <= SAME * there[0])
        group = vectors[same]
        if same.size == 1:
            yield group[0]
        else:
            for reference in (*site.directions, arm, *np.eye(3)):
                shares = group @ (back @ able @ reference)
                size = float(np.linalg.norm(shares))
                if size > 0.1 * float(np.linalg.norm(reference)) > 0.0:
                    yield shares @ group / size
                    break
        first = int(same[-1]) + 1


def _velocities(rows: FloatArray, arm: FloatArray, length: float) -> FloatArray:
    """(k, 3) velocity of a point in each twist [m], by its place from the middle."""
    return np.asarray(rows[:, 3:] + np.cross(rows[:, :3] / length, arm))


def _able(wanted: FloatArray, arm: FloatArray, planar: bool) -> FloatArray:
    """(n, 3) orthonormal directions perpendicular to the wanted velocities of a point."""
    used = np.array([0, 1] if planar else [0, 1, 2])
    _, values, right = (
        np.linalg.svd(wanted[:, used]) if len(wanted) else (0, np.zeros(0), np.eye(used.size))
    )
    rank = int(np.sum(values > SAME * (1.0 + float(np.linalg.norm(arm)))))
    made = np.zeros((used.size - rank, 3))
    made[:, used] = right[rank:]
    return made


#: Of the characteristic length, places of new nodes have so many digits.
_DIGITS = 12


def wire_at(site: Site, at: Attachment, direction: FloatArray) -> AddedWire:
    """A wire from a point of a body along a direction to the ground."""
    numbers = site.result.given.arrays.node_number
    name = "" if site.subject.is_body else site.subject.name
    return AddedWire(
        int(numbers[at.position]),
        int(numbers[at.orientation]),
        _three(site, at.place) if not at.is_there else _as_given(at.place),
        _three(site, site.ground(at.place, direction)),
        name,
    )


def _three(site: Site, place: FloatArray) -> tuple[float, float, float]:
    """A place in decimals: a plane that is typed as z = 0.02 is not left by rounding."""
    digits = _DIGITS - math.floor(math.log10(site.result.characteristic_length))
    return _as_given(np.array([round(value, digits) for value in place.tolist()]))


def _as_given(place: FloatArray) -> tuple[float, float, float]:
    x, y, z = (place + 0.0).tolist()
    return x, y, z


def proposed(
    freed: Freed, subject: Subject, aim: Aim, change: Change, count: int, condition: float
) -> Added | None:
    """The step of a change; None where it does not do what it should.

    The mechanism with nothing declared must have `count` motions fewer, all of the body; the body
    must go on doing what is wanted; and there must be no further self-stress. What only lengthens
    a sheet or wire, so that the point between is inside of it, is none.
    """
    result = freed.result
    try:
        made = analysed(result, change)
        # The body by the numbers of its nodes in the changed mechanism.
        numbers, index = result.given.arrays.node_number, made.given.node_index
        positions, orientations = (
            tuple(index[int(numbers[node])] for node in nodes)
            for nodes in (subject.positions, subject.orientations)
        )
        then, same = Freed(made), Subject(subject.body, positions, orientations)
        if not then.has(same):
            return None
        space = then.space(same)
    except FlexactError:
        return None
    fewer = freed.outcome.under_constrained - then.outcome.under_constrained
    if fewer != count or space.dimension != aim.freedom.dimension - count:
        return None
    if not all(space.has(row / aim.freedom.factors) for row in aim.wanted):
        return None
    if made.over_constrained > result.over_constrained:
        return None
    purpose = Purpose.ADD_SHEET if change.sheets else Purpose.ADD_WIRE
    return Added(result, purpose, change, max(condition, 1.0), after(made))


#: How many wires, or sets of wires, are proposed.
_MOST_PROPOSALS = 4
#: How many are tried until so many are found.
_MOST_TRIED = 12
#: Lines that cost more than so many times the best are not proposed.
_WORTH = 2.5


def wires_for(freed: Freed, site: Site, aim: Aim, besides: Change) -> tuple[Added, ...]:
    """Wires that were tried: single ones, and where more are needed sets of them.

    Each stops so many motions of the mechanism as it has wires; the body goes on doing what is
    wanted, and there is no further self-stress.

    Args:
        freed: The mechanism.
        site: The body.
        aim: What is wanted of it.
        besides: What is changed as well: declarations of what is not wanted are taken back.
    """
    if not len(aim.unwanted):
        return ()
    lines = lines_for(site, aim)[:_MOST_TRIED]
    lines = [line for line in lines if line.cost <= _WORTH * lines[0].cost]
    single = (_wires(freed, site, aim, (line,), besides) for line in lines)
    made = list(islice(filter(None, single), _MOST_PROPOSALS))
    if len(aim.unwanted) > 1:
        made += _sets(freed, site, aim, lines, besides)
    return tuple(made)


def _sets(
    freed: Freed, site: Site, aim: Aim, lines: Sequence[Line], besides: Change
) -> Iterator[Added]:
    """One set of wires that stops all that wires can stop; without one the largest there is."""
    most, smaller = aim.stoppable, list[tuple[Line, ...]]()
    for line in lines:
        # One after another, each the best for what those before it have left.
        chosen: tuple[Line, ...] = (line,)
        left = aim.stopped_by(line.force)
        while len(left.unwanted) and (further := lines_for(site, left)):
            chosen, left = (*chosen, further[0]), left.stopped_by(further[0].force)
        found = _wires(freed, site, aim, chosen, besides) if len(chosen) == most > 1 else None
        if found is not None:
            yield found
            return
        smaller.append(chosen)
    smaller.sort(key=len, reverse=True)
    rest = (_wires(freed, site, aim, each, besides) for each in smaller if len(each) > 1)
    yield from islice(filter(None, rest), 1)


def _wires(
    freed: Freed, site: Site, aim: Aim, lines: Sequence[Line], besides: Change
) -> Added | None:
    """The step of some wires; None where they do not do what they should."""
    wires = tuple(wire_at(site, line.attachment, line.direction) for line in lines)
    works = np.array([aim.unwanted @ np.roll(line.force, 3) for line in lines])
    values = np.linalg.svd(works, compute_uv=False)
    condition = float(values[0] / values[-1]) if len(lines) > 1 else lines[0].condition
    change = replace(besides, wires=wires)
    return proposed(freed, site.subject, aim, change, len(lines), condition)


#: How many sheets are proposed, and tried until so many are found.
_SHEETS_MOST_PROPOSALS, _SHEETS_MOST_TRIED = 2, 6
#: A sheet holds so many motions.
_HELD = 3


#: A plane in which a sheet may be put: where it ends on the body, (3,) unit normal, how weakly it
#: holds the weakest of three motions, from 1, and by what it is chosen.
Plane = tuple[Attachment, FloatArray, float, float]


def sheets_for(freed: Freed, site: Site, aim: Aim, besides: Change) -> Iterator[Added]:
    """Sheets that were tried, the best first; none in the plane, where a sheet holds as a wire."""
    if aim.freedom.planar or len(aim.unwanted) < _HELD:
        return
    near = SAME * site.result.characteristic_length

    def is_same(one: Plane, other: Plane) -> bool:
        (at, normal), (there, across) = one[:2], other[:2]
        apart = abs(float((at.place - there.place) @ normal))
        return abs(float(normal @ across)) > 1.0 - SAME and apart <= near

    every = sorted(_planes(site, aim), key=lambda one: (round(one[3], 6), one[0].key))
    chosen = distinct(every, is_same)
    tried = (_sheet(freed, site, aim, besides, plane) for plane in chosen[:_SHEETS_MOST_TRIED])
    yield from islice(filter(None, tried), _SHEETS_MOST_PROPOSALS)


def _planes(site: Site, aim: Aim) -> Iterator[Plane]:
    space = aim.may_hold
    for at in (*site.own, *site.carried(space)):
        for normal in _normals(site, space, at.place):
            held = _held(space, at.place, normal)
            if held.sine_to(space) > SAME:
                continue
            works = np.roll(held.scaled, 3, axis=1) @ aim.unwanted.T
            weakest = float(np.linalg.svd(works, compute_uv=False)[-1])
            if weakest > 1.0e-2:
                cost = (1.0 if at.is_there else LINK) / weakest
                yield at, normal, 1.0 / weakest, cost


def _held(space: ScrewSpace, point: FloatArray, normal: FloatArray) -> ScrewSpace:
    """All forces along lines in a plane."""
    first, second = _across(normal)
    lines = [space.line(point, first), space.line(point, second), space.free(normal)]
    rows = np.linalg.qr((np.array(lines) * space.factors).T)[0].T
    return space.of_scaled(rows, True)


def _across(normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors perpendicular to a third and to each other."""
    axis = np.eye(3)[int(np.argmin(np.abs(normal)))]
    first = np.cross(normal, axis) / np.linalg.norm(np.cross(normal, axis))
    return first, np.cross(normal, first)


def _normals(site: Site, space: ScrewSpace, place: FloatArray) -> Iterator[FloatArray]:
    """Normals of planes through a point in which all lines are in the space."""
    for family in space.lines:
        if family.kind is FamilyKind.PLANE:
            yield family.normal
        elif family.kind is FamilyKind.ACROSS:
            yield family.direction
        elif family.kind is FamilyKind.MEETING:
            yield from _through_sheet(family, site, place)
        elif family.kind is FamilyKind.EVERY:
            yield from site.directions


def _through_sheet(family: Family, site: Site, place: FloatArray) -> Iterator[FloatArray]:
    """Normals of planes through a line and a point, or if it is on it all that are known."""
    across = np.cross(family.direction, place - family.point)
    size = float(np.linalg.norm(across))
    if size > SAME * site.result.characteristic_length:
        yield across / size
        return
    for each in site.directions:
        if abs(float(each @ family.direction)) <= SAME:
            yield each


def _sheet(freed: Freed, site: Site, aim: Aim, besides: Change, plane: Plane) -> Added | None:
    at, normal, condition, _ = plane
    # Along a flexure in the plane if there is one, else outward from the middle of the body.
    flat = np.abs(site.directions @ normal) <= SAME
    arm = at.place - site.middle
    arm = arm - (arm @ normal) * normal
    size = float(np.linalg.norm(arm))
    along = arm / size if size > site.near else _across(normal)[0]
    if flat.any():
        along = site.directions[int(np.argmax(flat))]
    wire = wire_at(site, at, along)
    width = _three(site, np.cross(normal, along))
    change = replace(besides, sheets=(AddedSheet(*wire[:4], width, wire.body),))
    return proposed(freed, site.subject, aim, change, _HELD, condition)
