# SPDX-License-Identifier: BSD-3-Clause
"""Sheets that stop three unwanted motions of a body and nothing that is wanted.

A sheet holds all forces along lines in its plane (Blanding, *Exact Constraint*, 1999): it may be
put where all of these do no work on what is wanted, and three independent ones do on the rest.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...core.arrays import FloatArray
from ..proposal import Proposal
from .aims import Aim
from .families import SAME, Family, FamilyKind
from .flexures import LINK
from .freedom import Freed
from .placing import sheet_at
from .screw_space import ScrewSpace
from .subjects import Attachment, Site
from .trials import proposed

#: How many sheets are proposed, and tried until so many are found.
_MOST_PROPOSALS, _MOST_TRIED = 2, 6
#: A sheet holds so many motions.
_HELD = 3


class Plane(NamedTuple):
    """A plane in which a sheet may be put."""

    attachment: Attachment
    """Where it ends on the body."""
    normal: FloatArray
    """(3,) unit vector."""
    condition: float
    """How weakly it holds the weakest of three motions, from 1."""
    cost: float
    """By what it is chosen."""


def sheets_for(freed: Freed, site: Site, aim: Aim, besides: Change) -> Iterator[Proposal]:
    """Sheets that were tried, the best first; none in the plane, where a sheet holds as a wire."""
    if aim.freedom.planar or len(aim.unwanted) < _HELD:
        return
    planes = sorted(_planes(site, aim), key=lambda one: (round(one.cost, 6), one.attachment.key))
    chosen: list[Plane] = []
    for plane in planes:
        if all(not _is_same(plane, other, site) for other in chosen):
            chosen.append(plane)
    tried = (_proposal(freed, site, aim, besides, plane) for plane in chosen[:_MOST_TRIED])
    yield from islice(filter(None, tried), _MOST_PROPOSALS)


def _is_same(one: Plane, other: Plane, site: Site) -> bool:
    apart = abs(float((one.attachment.place - other.attachment.place) @ one.normal))
    is_parallel = abs(float(one.normal @ other.normal)) > 1.0 - SAME
    return is_parallel and apart <= SAME * site.result.characteristic_length


def _planes(site: Site, aim: Aim) -> Iterator[Plane]:
    space = aim.may_hold
    for at in (*site.own, *site.carried([space])):
        for normal in _normals(site, space, at.place):
            held = _held(space, at.place, normal)
            if held.sine_to(space) > SAME:
                continue
            works = np.roll(held.scaled, 3, axis=1) @ aim.unwanted.T
            weakest = float(np.linalg.svd(works, compute_uv=False)[-1])
            if weakest > 1.0e-2:
                cost = (1.0 if at.is_there else LINK) / weakest
                yield Plane(at, normal, 1.0 / weakest, cost)


def _held(space: ScrewSpace, point: FloatArray, normal: FloatArray) -> ScrewSpace:
    """All forces along lines in a plane."""
    first, second = _across(normal)
    lines = [space.line(point, first), space.line(point, second), space.free(normal)]
    factors = np.repeat((space.length, 1.0), 3)
    rows = np.linalg.qr((np.array(lines) * factors).T)[0].T
    return ScrewSpace(rows / factors, space.about, space.length, True)


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
            yield from _through(family, site, place)
        elif family.kind is FamilyKind.EVERY:
            yield from site.directions


def _through(family: Family, site: Site, place: FloatArray) -> Iterator[FloatArray]:
    """Normals of planes through a line and a point, or if it is on it all that are known."""
    across = np.cross(family.direction, place - family.point)
    size = float(np.linalg.norm(across))
    if size > SAME * site.result.characteristic_length:
        yield across / size
        return
    for each in site.directions:
        if abs(float(each @ family.direction)) <= SAME:
            yield each


def _proposal(freed: Freed, site: Site, aim: Aim, besides: Change, plane: Plane) -> Proposal | None:
    along = _along(site, plane)
    sheet = sheet_at(site, plane.attachment, along, np.cross(plane.normal, along))
    change = replace(besides, sheets=(sheet,))
    return proposed(freed, site.subject, aim, change, _HELD, plane.condition)


def _along(site: Site, plane: Plane) -> FloatArray:
    """Along a flexure in the plane if there is one, else outward from the middle of the body."""
    flat = np.abs(site.directions @ plane.normal) <= SAME
    if flat.any():
        known: FloatArray = site.directions[int(np.argmax(flat))]
        return known
    arm = plane.attachment.place - site.middle
    arm = arm - (arm @ plane.normal) * plane.normal
    size = float(np.linalg.norm(arm))
    made: FloatArray = arm / size if size > site.near else _across(plane.normal)[0]
    return made
