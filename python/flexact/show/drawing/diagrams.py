# SPDX-License-Identifier: BSD-3-Clause
"""Diagrams of bending moments: beside the members as they are seen, on the stretched side.

A diagram stands on the outline of its member: on the side of the section that the moment
stretches, as far out as the member reaches in the picture, and a little off it. So neither a wide
sheet nor a thick beam hides it. Where the plane of bending would be seen edge-on, the diagram is
turned about the member, by as little as makes it as wide as is needed to see it.
`page/diagram.js` does the same whenever the eye moves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...analysis.part_stresses import QUANTITIES, shared_resultants
from ...analysis.result import SelfStress
from ...core.arrays import FloatArray
from ...model.parts.chains import signs_of
from ...model.parts.forms import Form
from ...util.records import Frozen
from ...util.rotations import unit
from .drawing import Drawing
from .members import Members

FORCE, TWIST, IN_PLANE, OUT_OF_PLANE = QUANTITIES
#: Those that bend, each with the row of the directions across a member to which it bends.
BENDING = {IN_PLANE: 0, OUT_OF_PLANE: 1}
UNITS = {FORCE: "N", TWIST: "N m", IN_PLANE: "N m", OUT_OF_PLANE: "N m"}

#: What they are called besides; My and Mz are those of the local axes that sheets have in decks
#: of the paper.
_OTHER_NAMES = {
    **{"n": FORCE, "normal": FORCE},
    **{"t": TWIST, "twist": TWIST, "torsion": TWIST},
    **{"my": IN_PLANE, "in plane": IN_PLANE},
    **{"mz": OUT_OF_PLANE, "out of plane": OUT_OF_PLANE, "bending moment": OUT_OF_PLANE},
}
_SIDES = {
    FORCE: "blue: compression; red: tension",
    TWIST: "blue and red: opposite senses",
    IN_PLANE: "red: stretches the {} towards z (y or x if it lies so)",
    OUT_OF_PLANE: "red: stretches the {} towards z (y or x if it lies so)",
}


def quantity_named(name: str) -> str | None:
    """The quantity of this name, however it is written; None where there is none."""
    plain = " ".join(name.lower().replace("-", " ").replace("_", " ").split())
    known = {each.replace("-", " "): each for each in QUANTITIES} | _OTHER_NAMES
    return known.get(plain)


def names_in(drawing: Drawing) -> dict[str, str]:
    """What each quantity is called there: the words of sheets where there are any."""
    if drawing.planar:
        bending = ("bending moment out of the plane", "bending moment")
    elif np.any(drawing.members.form == Form.SHEET):
        return {each: each for each in QUANTITIES}
    else:
        bending = ("upward bending moment", "sideways bending moment")
    return dict(zip(QUANTITIES, (FORCE, TWIST, *bending), strict=True))


def meanings_in(drawing: Drawing) -> dict[str, str]:
    """What each quantity is, for a legend or a caption."""
    names = names_in(drawing)
    return names | {FORCE: f"{names[FORCE]}, tension positive"}


def sides_in(drawing: Drawing) -> dict[str, str]:
    """What the colours of each quantity mean."""
    edge, face = "edge", "face"
    if drawing.planar or not np.any(drawing.members.form == Form.SHEET):
        edge = face = "side"
    return {each: _SIDES[each].format(edge if each == IN_PLANE else face) for each in QUANTITIES}


#: A quantity below this part of the largest one, moments over the length, is rounding.
_NOISE = 1.0e-10


@dataclass(frozen=True, eq=False)
class Resultants(Frozen):
    """Stress resultants of a self-stress; only their ratios have a meaning.

    Attributes:
        members: (k, 4, 2) the `QUANTITIES` [N, N m] at both ends of the drawing's members, linear
            between.
        hinges: (h, 4) their sizes in the hinges.
        flexible: (k,) which members are sheets, wires or bars.
        shown: (k,) which members are drawn themselves, and not a body in their place.
        length: The characteristic length [m] by which moments compare with forces.
    """

    members: FloatArray
    hinges: FloatArray
    flexible: np.ndarray
    shown: np.ndarray
    length: float

    def __getitem__(self, quantity: str) -> FloatArray:
        """(k, 2) one of `QUANTITIES` at both ends of the members."""
        return np.asarray(self.members[:, QUANTITIES.index(quantity)])

    @property
    def _weight(self) -> FloatArray:
        """(4,) what makes the quantities comparable with forces."""
        return np.array([1.0, *[1.0 / self.length] * 3])

    def along(self, quantity: str, member: np.ndarray, at: FloatArray) -> FloatArray:
        """(rows, s) a quantity at stations (s,) of some members (rows,)."""
        ends = self[quantity][member]
        made: FloatArray = ends[:, :1] * (1 - at) + ends[:, 1:] * at
        made[:, at == 1.0] = ends[:, 1:]
        return made

    def largest(self, quantity: str) -> float:
        """Largest magnitude of a quantity, of members that are shown and of hinges."""
        column, weight = QUANTITIES.index(quantity), self._weight
        sizes = np.abs(self.members[self.shown]).max(axis=(0, 2), initial=0.0)
        sizes = np.maximum(sizes, np.abs(self.hinges).max(axis=0, initial=0.0))
        # Rounding errors are no stress.
        noise = sizes[column] * weight[column] <= _NOISE * (sizes * weight).max()
        return 0.0 if noise else float(sizes[column])

    @property
    def dominant(self) -> str:
        """The quantity that is largest on the whole, moments over the characteristic length.

        By the root of the sum of squares, and of sheets, wires and bars as long as they carry
        anything: the stress in rigid bodies is what theirs asks for.
        """
        squares = np.sum(self.members[self.flexible] ** 2, axis=(0, 2))
        if not squares.any():
            squares = np.sum(self.members[self.shown] ** 2, axis=(0, 2))
            squares += np.sum(self.hinges**2, axis=0)
        sizes = np.sqrt(squares) * self._weight
        # Of practically equal ones the first.
        return QUANTITIES[int(np.argmax(sizes >= sizes.max() * (1 - 1.0e-9)))]


def resultants(drawing: Drawing, stress: SelfStress) -> Resultants:
    """The stress resultants of a self-stress along the members of a drawing."""
    value = stress.forces + stress.moments
    members, hinges = (
        shared_resultants(drawing.data, index, value[index])
        for index in (drawing.members.index, drawing.hinges.index)
    )
    return Resultants(
        members,
        hinges[..., 0],
        np.isin(drawing.members.form, (Form.SHEET, Form.WIRE, Form.BAR)),
        ~drawing.in_solid,
        stress.analysis.characteristic_length,
    )


#: Height of the largest moment, and the gap between a member and its diagram: parts of the
#: drawing's size.
HEIGHT, GAP = 0.1, 0.012
#: The part of its height that a diagram shows at least, and how much of a member must be seen
#: across the line of sight for that.
SHOWN, _END_ON = 0.45, 0.05
#: Values below this part of the largest are not drawn.
_LEAST = 1.0e-6
#: Pieces of a diagram, and of a member for its colours.
PIECES = 36


def diagrams_of(
    drawing: Drawing, values: Resultants, quantity: str, towards: FloatArray
) -> tuple[np.ndarray, FloatArray, FloatArray, FloatArray, np.ndarray]:
    """The diagrams of a bending moment in the reference configuration.

    From the same end of each member, whichever is called p.

    Args:
        drawing: The drawing.
        values: Of a self-stress along its members.
        quantity: One of `BENDING`; of another there are none.
        towards: (3,) unit vector to the eye.

    Returns:
        (k,) which of the drawing's members, one whose moment changes its sign twice; (k, s)
        moments at stations [N m]; (k, s, 3) where they are zero, and (k, s, 3) where they are
        as they are [m]; (k, 2) which ends are those of a sheet or a wire, and not within it.
    """
    largest = values.largest(quantity)
    rows, sign = np.zeros(0, np.int64), np.zeros(0)
    if quantity in BENDING and largest > 0.0:
        signed = np.stack((values[quantity], -values[quantity]), axis=1)
        there = (signed.max(axis=2) > _LEAST * largest) & drawing.seen[:, None]
        rows, which = np.nonzero(there)
        sign = np.array((1.0, -1.0))[which]
    members = drawing.members
    ends = drawing.reference.position[members.nodes[rows][:, [0, 2]]]
    value, last = values[quantity][rows], ~members.joined[rows]
    turned = signs_of(ends[:, 1] - ends[:, 0]) < 0.0
    for each in (ends, value, last):
        each[turned] = each[turned, ::-1]
    share, cut = _interval(sign[:, None] * value)
    at = share[:, :1] + (share[:, 1:] - share[:, :1]) * np.linspace(0.0, 1.0, PIECES + 1)
    along = (1 - at) * value[:, :1] + at * value[:, 1:]
    centre = (1 - at)[..., None] * ends[:, :1] + at[..., None] * ends[:, 1:]
    foot, way = stance(members, rows, sign, BENDING.get(quantity, 0), towards)
    base = centre + (foot + GAP * drawing.size * way)[:, None]
    height = HEIGHT * drawing.size / (largest or 1.0)
    top = base + (height * np.abs(along))[..., None] * way[:, None]
    return rows, along, base, top, last & ~cut


def stance(
    members: Members, rows: np.ndarray, sign: FloatArray, bending: int, towards: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Where the diagrams of some members stand, and which way they go.

    Args:
        members: The members.
        rows: (k,) which of them.
        sign: (k,) of the moments.
        bending: Row of the directions across a member, as of `BENDING`.
        towards: (3,) unit vector to the eye.

    Returns:
        (k, 3) from the axes [m], and (k, 3) unit vectors.
    """
    frame = members.frame[rows]
    ex = frame[..., 0]
    stretched = sign[:, None] * np.einsum(
        "kxd,kd->kx", frame[..., 1:], members.across[rows, bending]
    )
    sideways = np.cross(ex, towards)
    end_on = np.linalg.norm(sideways, axis=1) < _END_ON
    sideways = np.where(end_on[:, None], stretched, unit(sideways))
    seen = np.sum(stretched * sideways, axis=1)
    side = np.where(seen < -1.0e-9, -1.0, 1.0)
    outward = side[:, None] * sideways
    depth = stretched - seen[:, None] * sideways
    away = np.where(np.abs(seen) < SHOWN, SHOWN, np.abs(seen))
    way = away[:, None] * outward + np.sqrt(1.0 - np.minimum(away, 1.0) ** 2)[:, None] * unit(depth)
    # To the points of sections that are farthest along the direction.
    across, half = frame[..., 1:], members.section[rows] / 2
    part = np.einsum("kx,kxd->kd", outward, across)
    tie = np.einsum("kx,kxd->kd", stretched, across)
    corner = np.where(np.abs(part) > 1.0e-9, np.sign(part), np.sign(np.round(tie, 9))) * half
    size = np.linalg.norm(half * part, axis=1, keepdims=True)
    ellipse = half**2 * part / np.where(size > 0.0, size, 1.0)
    chosen = np.where(members.round[rows][:, None], ellipse, corner)
    return np.einsum("kxd,kd->kx", across, chosen), unit(way)


def _interval(value: FloatArray) -> tuple[FloatArray, np.ndarray]:
    """(k, 2) shares between which linear values (k, 2) are positive, and which ends those cut."""
    first, last = value.T
    slope = np.where(last == first, 1.0, last - first)
    zero = np.clip(-first / slope, 0.0, 1.0)
    cut = value < 0.0
    return np.where(cut, zero[:, None], (0.0, 1.0)), cut
