# SPDX-License-Identifier: BSD-3-Clause
"""Where wires and sheets that are added to a body end, as changes of the model have it."""

from __future__ import annotations

import math

import numpy as np

from ...analysis.change import AddedSheet, AddedWire
from ...analysis.result import Result
from ...core.arrays import FloatArray
from .spaces_subjects import Subject
from .subjects import Attachment, Site

#: Of the characteristic length, places of new nodes have so many digits.
_DIGITS = 12
#: A point as near as this to one of the body, likewise, is that.
_THERE = 1.0e-9


def wire_along(
    result: Result, subject: Subject, point: FloatArray, direction: FloatArray
) -> AddedWire:
    """A wire that ends on a body at a point [m] and runs along a direction to the ground."""
    site = Site(result, subject)
    near = min(site.own, key=lambda each: float(np.linalg.norm(each.place - point)))
    is_there = bool(np.linalg.norm(near.place - point) <= _THERE * result.characteristic_length)
    place = near.place if is_there else point
    return wire_at(site, near._replace(place=place, is_there=is_there), direction)


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


def sheet_at(site: Site, at: Attachment, direction: FloatArray, width: FloatArray) -> AddedSheet:
    """A sheet from a point of a body along a direction to the ground."""
    wire = wire_at(site, at, direction)
    return AddedSheet(*wire[:4], _three(site, width), wire.body)


def _three(site: Site, place: FloatArray) -> tuple[float, float, float]:
    """A place in decimals: a plane that is typed as z = 0.02 is not left by rounding."""
    digits = _DIGITS - math.floor(math.log10(site.result.characteristic_length))
    return _as_given(np.array([round(value, digits) for value in place.tolist()]))


def _as_given(place: FloatArray) -> tuple[float, float, float]:
    x, y, z = (place + 0.0).tolist()
    return x, y, z
