# SPDX-License-Identifier: BSD-3-Clause
"""Wires that stop what is unwanted of a body and nothing that is wanted.

A wire holds its end against motion along it. With W the wanted twists, U the rest of what the
body can do, and g the force along a line, the wire stops nothing wanted where g does no work on
W, and one motion of U where it does some on U. At a point p that means: the line is perpendicular
to the velocities of p in W, and not to all those in U. Its condition is the size of g over the
part of it that does work on U, moments in forces: the larger, the weaker it holds. What is left of
U is stopped by further wires, one after another.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from ...base.errors import FlexactError
from ...base.frozen import Frozen
from ...core.arrays import FloatArray
from ...result.outcome import Asked
from ...result.result import Result, result_of
from ...result.screws import sense_of
from ..change import AddedWire, Change
from ..proposal import After, Proposal, Purpose
from .attachments import Attachment, Site
from .freedom import Freed
from .screw_space import ScrewSpace, complement
from .screw_system import SAME
from .subjects import Subject

#: How many wires, or sets of wires, are proposed.
_MOST_PROPOSALS = 4
#: How many are tried until so many are found.
_MOST_TRIED = 12
#: A line that is weaker than this, by its condition, is none.
_WEAKEST = 100.0
#: Of the characteristic length, places of new nodes have so many digits.
_DIGITS = 12
#: Wanted motions that differ by less are one.
_APART = 1.0e-3
#: Forces along lines with a larger cosine are much the same.
_ALIKE = 0.95
#: Lines that cost more than so many times the best are not proposed.
_WORTH = 2.5
#: What a link costs, and a direction in which no flexure runs yet, as factors of the condition.
_LINK, _NEW_DIRECTION = 1.5, 1.2


@dataclass(frozen=True, eq=False)
class Aim(Frozen):
    """What wires are to do with a body.

    Attributes:
        freedom: What the body can do.
        wanted: (w, 6) orthonormal rows, rotations times the length: what it is to go on doing.
        unwanted: (u, 6) orthonormal rows: the rest.
    """

    freedom: ScrewSpace
    wanted: FloatArray
    unwanted: FloatArray

    @classmethod
    def of(cls, freedom: ScrewSpace, twists: Sequence[FloatArray]) -> Aim:
        """Of a freedom space and the wanted twists in it, (6,) each."""
        rows = freedom.scaled
        factors = np.repeat((freedom.length, 1.0), 3)
        if not len(twists) or not len(rows):
            return cls(freedom, rows[:0], rows)
        shares = np.array([rows @ (twist * factors) for twist in twists])
        sizes = np.linalg.norm(shares, axis=1, keepdims=True)
        shares = shares / np.where(sizes > 0.0, sizes, 1.0)
        _, values, right = np.linalg.svd(shares)
        rank = int(np.sum(values > _APART))
        return cls(freedom, right[:rank] @ rows, right[rank:] @ rows)

    @property
    def may_hold(self) -> ScrewSpace:
        """The wrenches that do no work on what is wanted."""
        return self._space(self.wanted).reciprocal

    @property
    def stoppable(self) -> int:
        """How many of the unwanted motions wires can stop: as forces along lines span."""
        span = self.may_hold.span_of_lines
        works = np.roll(span, 3, axis=1) @ self.unwanted.T
        return int(np.sum(np.linalg.svd(works, compute_uv=False) > SAME)) if works.size else 0

    def stopped_by(self, line: FloatArray) -> Aim:
        """What is left to be done with a wire along a line, (6,) scaled."""
        works = self.unwanted @ np.roll(line, 3)
        left = complement(works[None] / np.linalg.norm(works)) @ self.unwanted
        return Aim(self.freedom, self.wanted, left)

    def _space(self, rows: FloatArray) -> ScrewSpace:
        one = self.freedom
        factors = np.repeat((one.length, 1.0), 3)
        return ScrewSpace(rows / factors, one.about, one.length, one.of_wrenches, one.planar)


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
    carried = site.carried([aim.may_hold])
    found = [*own, *(line for each in carried for line in _through(site, aim, each))]
    if not found:
        # Of a body that is small, or all on one line, links reach out.
        found = [line for each in site.reached for line in _through(site, aim, each)]
    # Lines through one point keep their order, that of the names of the flexures along which
    # they run.
    found.sort(key=lambda line: (round(line.cost, 6), line.attachment.key))
    made: list[Line] = []
    for line in found:
        if all(abs(line.force @ other.force) < _ALIKE for other in made):
            made.append(line)
    return made


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
        cost = size / work * (1.0 if at.is_there else _LINK)
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
    made: FloatArray = rows[:, 3:] + np.cross(rows[:, :3] / length, arm)
    return made


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


def wire_along(
    result: Result, subject: Subject, point: FloatArray, direction: FloatArray
) -> AddedWire:
    """A wire that ends on a body at a point [m] and runs along a direction to the ground."""
    site = Site(result, subject)
    near = min(site.own, key=lambda each: float(np.linalg.norm(each.place - point)))
    is_there = bool(np.linalg.norm(near.place - point) <= 1.0e-9 * result.characteristic_length)
    place = near.place if is_there else point
    return _wire(site, near._replace(place=place, is_there=is_there), direction)


def _wire(site: Site, at: Attachment, direction: FloatArray) -> AddedWire:
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


def wires_for(
    freed: Freed, subject: Subject, aim: Aim, besides: Change | None = None
) -> tuple[Proposal, ...]:
    """Wires that were tried: single ones, and where more are needed sets of them.

    Each stops so many motions of the mechanism as it has wires; the body goes on doing what is
    wanted, and there is no further self-stress.

    Args:
        freed: The mechanism.
        subject: The body.
        aim: What is wanted of it.
        besides: What is changed as well: declarations of what is not wanted are taken back.
    """
    besides = besides or Change()
    if not len(aim.unwanted):
        return ()
    site = Site(freed.result, subject)
    lines = lines_for(site, aim)[:_MOST_TRIED]
    lines = [line for line in lines if line.cost <= _WORTH * lines[0].cost]
    single = (_tried(freed, site, aim, (line,), besides) for line in lines)
    made = list(islice(filter(None, single), _MOST_PROPOSALS))
    if len(aim.unwanted) > 1:
        sets = (chosen for line in lines if len(chosen := _set_from(site, aim, line)) > 1)
        whole = (_tried(freed, site, aim, chosen, besides) for chosen in sets)
        made += islice(filter(None, whole), 1)
    return tuple(made)


def _set_from(site: Site, aim: Aim, first: Line) -> tuple[Line, ...]:
    """Wires one after another, each the best for what those before it have left."""
    chosen, left = [first], aim.stopped_by(first.force)
    while len(left.unwanted):
        further = lines_for(site, left)
        if not further:
            break
        chosen.append(further[0])
        left = left.stopped_by(further[0].force)
    return tuple(chosen)


def _tried(
    freed: Freed, site: Site, aim: Aim, lines: Sequence[Line], besides: Change
) -> Proposal | None:
    """The proposal of some wires; None where they do not do what they should."""
    result = freed.result
    wires = tuple(_wire(site, line.attachment, line.direction) for line in lines)
    change = replace(besides, wires=wires)
    try:
        data = change.apply(result.given).data
        after: Result = result_of(data, Asked(result.asked.method, result.asked.tolerance))
        then = Freed(after)
        space = then.space(_same(site.subject, result, after))
    except FlexactError:
        return None
    fewer = freed.outcome.under_constrained - then.outcome.under_constrained
    factors = np.repeat((aim.freedom.length, 1.0), 3)
    kept = all(space.has(row / factors) for row in aim.wanted)
    more = after.over_constrained > result.over_constrained
    if fewer != len(lines) or space.dimension != aim.freedom.dimension - len(lines):
        return None
    if more or not kept:
        return None
    works = np.array([aim.unwanted @ np.roll(line.force, 3) for line in lines])
    values = np.linalg.svd(works, compute_uv=False)
    condition = float(values[0] / values[-1]) if len(lines) > 1 else lines[0].condition
    told = After(
        after.verdict, after.under_constrained, after.over_constrained, after.gap.smallest_nonzero
    )
    return Proposal(Purpose.ADD_WIRE, change, max(condition, 1.0), told)


def _same(subject: Subject, before: Result, after: Result) -> Subject:
    """A body by the numbers of its nodes in the changed mechanism."""
    numbers, index = before.given.arrays.node_number, after.given.node_index
    positions, orientations = (
        tuple(index[int(numbers[node])] for node in nodes)
        for nodes in (subject.positions, subject.orientations)
    )
    return Subject(subject.body, positions, orientations)
