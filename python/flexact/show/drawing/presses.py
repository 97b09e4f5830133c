# SPDX-License-Identifier: BSD-3-Clause
"""What parts press on bodies in a self-stress, as arrows on the surfaces of the bodies.

Forces and moments are those of `analysis/part_stresses.py` at the end of each part. All arrows of
a self-stress share one scale, on which a moment counts as the force that has it about the
characteristic length.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...analysis.result import SelfStress
from ...analysis.screws import Wrench
from ...core.arrays import FloatArray
from ...model.parts.parts import Part, PartKind
from ...util.rotations import unit
from ...util.units import Units
from .bodies import Solid
from .drawing import Drawing

#: Length of the longest arrow, a part of the drawing's size; shorter parts of it than this are
#: left out, and all of them of drawings of more members.
_LONGEST, _LEAST, _MOST_MEMBERS = 0.13, 0.06, 200
#: Two arrows are along one line if this is the cosine of their angle; then a gap is between them.
_SAME_LINE, _GAP = 0.95, 0.2
#: Cosine between a force and the way into the body, along the part, from which on it presses.
_PRESSES = 0.5
#: Where the second head of a moment is, along its arrow.
SECOND = 0.84


class Press(NamedTuple):
    """A force or a moment by which a part presses on a body."""

    body: Part
    part: Part
    node: int
    """Position node at which the part ends."""
    vector: FloatArray
    """(3,) force [N], or moment about that node [N m]."""
    is_moment: bool
    start: FloatArray
    """(3,) of the arrow, on the surface of the body or outside [m]."""
    end: FloatArray
    """(3,) likewise."""


def way_out(drawing: Drawing, node: int, direction: FloatArray) -> float:
    """How far it is from a position node along a unit vector to the surface of its body [m].

    Half the thickness of a link where the body is drawn as its links; 0 of a node that no body
    carries.
    """
    solid = _solid_at(drawing, node)
    members = drawing.members
    if solid is None:
        mine = np.any(members.nodes[:, [0, 2]] == node, axis=1) & members.stiff
        return float(members.section[mine].max(initial=0.0)) / 2
    rise = solid.hull.normal @ direction
    depth = (solid.corners @ solid.hull.normal.T).max(axis=0)
    depth = depth - solid.hull.normal @ drawing.reference.position[node]
    return max(float((depth / np.where(rise > 1.0e-9, rise, np.nan))[rise > 1.0e-9].min()), 0.0)


def _solid_at(drawing: Drawing, node: int) -> Solid | None:
    nodes = drawing.members.nodes
    return next((s for s in drawing.solids if np.any(nodes[s.rows][:, [0, 2]] == node)), None)


def presses_of(drawing: Drawing, stress: SelfStress) -> tuple[Press, ...]:
    """The arrows of a self-stress, part by part; none where a model has very many members."""
    if len(drawing.members) > _MOST_MEMBERS:
        return ()
    # Who presses on which body, from where, and the direction into the body along the part.
    there: list[tuple[Part, Part, Wrench, FloatArray]] = []
    for one in stress.parts:
        for k, load in enumerate(one.ends):
            if isinstance(load.on, Part) and load.on.kind is PartKind.BODY and load.on != one.part:
                into = one.direction if k else -one.direction
                there.append((load.on, one.part, load.wrench, into))
    # Bodies that share a point press on each other there.
    for body, loads in stress.on_bodies:
        for part, wrench in loads:
            if isinstance(body, Part) and part is not None and part.kind is PartKind.BODY:
                shared = sorted(set(_nodes_of(drawing, body)) & set(_nodes_of(drawing, part)))
                place = drawing.reference.position[shared].mean(axis=0) if shared else wrench.about
                there.append((body, part, wrench.at(place), np.zeros(3)))
    sizes = [
        max(each.length * np.linalg.norm(each.force), np.linalg.norm(each.moment))
        for _, _, each, _ in there
    ]
    largest = float(max(sizes, default=0.0))
    scale = _LONGEST * drawing.size / largest if largest > 0.0 else 0.0
    return tuple(press for each in there for press in _at_end(drawing, *each, scale))


def _nodes_of(drawing: Drawing, body: Part) -> list[int]:
    """Position nodes of a body."""
    rows = np.isin(drawing.members.index, body.elements)
    return sorted(set(drawing.members.nodes[rows][:, [0, 2]].ravel().tolist()))


def _at_end(
    drawing: Drawing, body: Part, part: Part, wrench: Wrench, inwards: FloatArray, scale: float
) -> list[Press]:
    """The arrows of one wrench; `scale` is the length for a moment of one [1/N]."""
    made: list[Press] = []
    # Hinges have no position node of their own.
    nodes = _nodes_of(drawing, body)
    if not nodes:
        return made
    far = np.linalg.norm(drawing.reference.position[nodes] - wrench.about, axis=1)
    node = nodes[int(far.argmin())]
    for is_moment, vector in ((False, wrench.force), (True, wrench.moment)):
        length = scale * (1.0 if is_moment else wrench.length) * float(np.linalg.norm(vector))
        if length < _LEAST * _LONGEST * drawing.size:
            continue
        way = unit(vector)
        # A force that presses ends on the surface, all others begin there.
        if not is_moment and float(way @ inwards) > _PRESSES:
            start = wrench.about - way * (way_out(drawing, node, -way) + length)
        else:
            start = wrench.about + way * way_out(drawing, node, way)
        for other in made:
            along = unit(other.end - other.start) @ way
            if along > _SAME_LINE and (other.start - wrench.about) @ way > 0.0:
                start = other.end + _GAP * length * way
        made.append(Press(body, part, node, vector, is_moment, start, start + length * way))
    return made


def presses_in_words(length: float, units: Units) -> str:
    """What the arrows are, a sentence; `length` is the characteristic one [m]."""
    return (
        "Arrows: forces (one head) and moments (two heads) by which parts press on bodies; "
        f"1 N is drawn as long as {units.said(length, 'N m', 2)}."
    )
