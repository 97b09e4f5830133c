# SPDX-License-Identifier: BSD-3-Clause
"""From where a drawing is seen: orthographic views, with z up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.forms import Form
from ...model.parts.parts import bodies_of
from ...util.errors import BatchError, require_kind
from ...util.quantities import quantity
from ...util.records import Frozen, cached_property, kept
from .bodies import MOST_MEMBERS
from .drawing import Drawing

#: Azimuth and elevation [degrees] of the views that have a name.
NAMED = {
    "front": (-90.0, 0.0),
    "back": (90.0, 0.0),
    "left": (180.0, 0.0),
    "right": (0.0, 0.0),
    "top": (-90.0, 90.0),
    "bottom": (-90.0, -90.0),
}
#: The view that chooses its azimuth.
ISO = "iso"
_ISO_AZIMUTHS = (-62.0, -38.0, -74.0, -24.0, -122.0, -148.0)
_ISO_ELEVATION = 25.0
#: What is flat is seen from at least so far above its plane [degrees]. Flat is whose least extent
#: is at most this part of the next one, and that one more than this part of the largest.
_ABOVE, _FLATNESS, _LINE = 35.0, 0.3, 0.1
#: Another azimuth than the first must show so much more.
_BETTER = 0.04
#: A sheet that is turned to the eye by this cosine is seen well enough.
_ENOUGH = 0.4
#: The picture is divided into squares of this part of the drawing's size.
_SQUARE = 0.015
#: Points along a member, and so many members.
_SAMPLES, _MOST_SAMPLED = 24, 300


@dataclass(frozen=True, eq=False)
class View(Frozen):
    """An orthographic view.

    Attributes:
        azimuth: Of the eye about z, from the x axis [degrees].
        elevation: Of the eye above the xy plane [degrees].
    """

    azimuth: float
    elevation: float

    @cached_property
    def axes(self) -> FloatArray:
        """(3, 3) rows: right, up, and towards the eye."""
        a, e = np.radians((self.azimuth, self.elevation))
        right = (-np.sin(a), np.cos(a), 0.0)
        up = (-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e))
        towards = (np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e))
        return np.array((right, up, towards))

    def project(self, points: FloatArray) -> FloatArray:
        """Points (..., 3) to the right, up, and towards the eye."""
        return np.asarray(points @ self.axes.T)


#: The plane x right, y up.
FLAT = View(-90.0, 90.0)


def view_of(text: str | None, drawing: Drawing) -> View:
    """The view that a name, or ``AZ,EL`` in degrees, stands for; planar drawings have but one.

    Raises:
        BatchError: There is no such view.
    """
    asked = check_view(ISO if text is None else text)
    if drawing.planar:
        return FLAT
    return kept(drawing, View, lambda: _best_view(drawing)) if asked is None else asked


def _best_view(drawing: Drawing) -> View:
    # From above and the side from which members hide each other least and sheets are seen.
    normal = flat_normal(drawing)
    lies = normal is not None and abs(normal[2]) > np.cos(np.radians(_ABOVE))
    views = [View(azimuth, _ABOVE if lies else _ISO_ELEVATION) for azimuth in _ISO_AZIMUTHS]
    best = views[0]
    if not len(drawing.members):
        return best
    points, most = _sample(drawing), 0.0
    for view in views:
        seen = _seen(points, view, drawing.size) * _facing(drawing, view)
        if normal is not None:
            seen *= min(abs(float(normal @ view.axes[2])) / np.sin(np.radians(_ABOVE)), 1.0)
        if view is best or seen > most * (1.0 + _BETTER):
            best, most = view, seen
    return best


def flat_normal(drawing: Drawing) -> FloatArray | None:
    """(3,) unit normal of a flat mechanism; None of others.

    Flat is where all points, or all points of bodies, lie near a plane and not near a line.
    """
    place = drawing.reference.position
    bodies = bodies_of(drawing.data.arrays) if len(drawing.members) <= MOST_MEMBERS else ()
    carried = np.unique([node for body in bodies for node in body.positions])
    for nodes in (np.unique(drawing.members.nodes[:, [0, 2]]), carried.astype(int)):
        if nodes.size < 3:
            continue
        apart = place[nodes] - place[nodes].mean(axis=0)
        axes = np.linalg.svd(apart, full_matrices=False)[2]
        extents = np.ptp(apart @ axes.T, axis=0)
        if extents[2] <= _FLATNESS * extents[1] and extents[1] > _LINE * extents[0]:
            return np.asarray(axes[2])
    return None


def check_view(text: str) -> View | None:
    """The view, if there is such a one; None where it takes a drawing; errors as of `view_of`."""
    require_kind(text, str, "a view is given by its name or by two angles in a text")
    if text == ISO:
        return None
    if text in NAMED:
        return View(*NAMED[text])
    try:
        azimuth, elevation = (quantity(part, "deg") for part in text.split(","))
    except ValueError:
        azimuth = elevation = np.nan
    if not (abs(azimuth) <= 360.0 and abs(elevation) <= 90.0):
        names = ", ".join((ISO, *NAMED))
        raise BatchError(
            f"there is no view {text!r}: it is one of {names}, or the azimuth and the elevation "
            "of the eye in degrees, such as -60,25"
        )
    return View(azimuth, elevation)


def _facing(drawing: Drawing, view: View) -> float:
    """How much sheets are turned to the eye on the mean; 1 where that is enough of all."""
    members = drawing.members
    thin = np.argmin(members.section, axis=1)
    normal = np.take_along_axis(members.frame, (1 + thin)[:, None, None], axis=2)[..., 0]
    facing = np.minimum(np.abs(normal @ view.axes[2]) / _ENOUGH, 1.0)[members.form == Form.SHEET]
    return float(facing.mean()) if facing.size else 1.0


def _sample(drawing: Drawing) -> FloatArray:
    """(k, n, 3) points over the surfaces of members, of very many members of some."""
    members = drawing.members
    kept = slice(None, None, max(1, len(members) // _MOST_SAMPLED))
    start = drawing.reference.position[members.nodes[kept, 0]]
    end = drawing.reference.position[members.nodes[kept, 2]]
    share = np.linspace(0.0, 1.0, _SAMPLES)
    axis = start[:, None] + share[None, :, None] * (end - start)[:, None]
    half = members.section[kept, None, None, :] * np.linspace(-0.5, 0.5, 7)[:, None]
    frame = members.frame[kept, None, None]
    wide = [axis[:, :, None] + half[..., k, None] * frame[..., 1 + k] for k in (0, 1)]
    return np.concatenate(wide, axis=2).reshape(len(start), -1, 3)


def _seen(points: FloatArray, view: View, size: float) -> float:
    """The part of a member that is not hidden by others, on the mean."""
    flat = view.project(points)
    many = len(points)
    member = np.broadcast_to(np.arange(many)[:, None], flat.shape[:2]).ravel()
    cell = np.floor(flat[..., :2].reshape(-1, 2) / (_SQUARE * size)).astype(np.int64)
    cell -= cell.min(axis=0)
    wide, tall = (cell.max(axis=0) + 1).tolist()
    square, depth = cell[:, 0] * tall + cell[:, 1], flat[..., 2].ravel()
    nearest = np.full(wide * tall, -np.inf)
    np.maximum.at(nearest, square, depth)
    # Of several that are as near the first is seen, which is what is put down last.
    seen = np.flatnonzero(depth == nearest[square])[::-1]
    owner = np.full(nearest.size, -1)
    owner[square[seen]] = member[seen]
    there = np.zeros((nearest.size, many), bool)
    there[square, member] = True
    visible = np.bincount(owner[owner >= 0], minlength=many)
    return float(np.mean(visible / np.maximum(there.sum(axis=0), 1)))
