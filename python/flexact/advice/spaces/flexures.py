# SPDX-License-Identifier: BSD-3-Clause
"""Lines along which a wire stops one unwanted motion of a body and nothing that is wanted.

A wire holds its end against motion along it. With W the wanted twists, U the rest of what the
body can do, and g the force along a line, the wire stops nothing wanted where g does no work on
W, and one motion of U where it does some on U. At a point p that means: the line is perpendicular
to the velocities of p in W, and not to all those in U. Its condition is the size of g over the
part of it that does work on U, moments in forces: the larger, the weaker it holds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...analysis.screws import sense_of
from ...core.arrays import FloatArray
from ...util.records import Frozen
from .aims import Aim
from .families import SAME
from .subjects import Attachment, Site

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
