# SPDX-License-Identifier: BSD-3-Clause
"""Stresses in members of known section: the largest normal stress, and that of von Mises.

Of a straight member the normal force, both bendings and the torsion of Saint-Venant act. With the
normal stress s, linear over the section, and the shear t, whose components are those of a
gradient with a constant Laplacian, both s^2 and |t|^2 have Laplacians that are nowhere negative:
s^2 + 3 t^2 is largest on the boundary, and only that is looked at. Shear of bending and
restrained warping are left out: of a slender member both are small. The stress at fillets and in
notches is larger by a factor of bending (`flexact.model.notches`), which counts for all of it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.elements import Dual, Member, Role, dual_table, member_table, role_table
from ..model.data import CrossSection, ModelData
from ..model.notches import deep_notch_factor, stress_factor
from ..util.records import Frozen
from .errors import ElasticError
from .mesh import stays_straight

#: The axis about which it bends (1: y, 2: z), and the end, of each bending.
_BENDINGS = {
    Role.BENDING_XZ_P: (1, 0),
    Role.BENDING_XZ_Q: (1, 1),
    Role.BENDING_XY_P: (2, 0),
    Role.BENDING_XY_Q: (2, 1),
    Role.PLANAR_BENDING_P: (2, 0),
    Role.PLANAR_BENDING_Q: (2, 1),
}


class Carried(NamedTuple):
    """What elements carry, each in its own axes."""

    normal: FloatArray
    """(elements,) [N], positive where it pulls."""
    torque: FloatArray
    """(elements,) [N m]; of a hinge the moment about its axis."""
    moments: FloatArray
    """(2, 2, elements) [N m], about y and about z, at p and at q."""


def carried_by(data: ModelData, stress: FloatArray, which: IntArray | None = None) -> Carried:
    """What elements carry with their stresses.

    Args:
        data: The model.
        stress: (6, elements) dual to the deformations.
        which: Indices of the elements; None for all.
    """
    kinds, length = data.arrays.element_kind, data.frames.length
    if which is not None:
        kinds, length = kinds[which], length[which]
    roles = role_table()[kinds].T
    levers = (dual_table()[kinds] == Dual.MOMENT_OVER_LENGTH).T
    value = np.where(levers, stress * length, stress)

    def of(*wanted: Role) -> FloatArray:
        return np.asarray(np.where(np.isin(roles, wanted), value, 0.0).sum(axis=0))

    moments = np.zeros((2, 2, kinds.size))
    for role, (axis, end) in _BENDINGS.items():
        moments[axis - 1, end] += of(role)
    return Carried(
        of(Role.ELONGATION, Role.OFFSET_X), of(Role.TORSION, Role.ROTATION, Role.ANGLE), moments
    )


#: Distances from a corner along the long side, in thicknesses: the shear rises to its full value
#: within two or three of them, and beyond, with a shear that stays, the largest is at an end.
_NEAR = np.concatenate([np.linspace(0.0, 1.0, 33), np.linspace(1.0, 3.0, 17)[1:]])
#: Places along half of the short side, from its middle to the corner.
_ACROSS = np.linspace(0.0, 1.0, 33)
#: Odd numbers of the series.
_ODD = np.arange(1.0, 80.0, 2.0)


class Edge(NamedTuple):
    """Places on a quarter of the boundary of rectangles, with their shear: those of (k,) ratios."""

    along: FloatArray
    """(k, places) from the middle of the long side, 0, to its end, 1; on the short side 1."""
    across: FloatArray
    """(k, places) from the middle of the short side, 0, to its end, 1; on the long side 1."""
    shear: FloatArray
    """(k, places) shear of a unit torque in a section of unit thickness."""


def edge_of(ratio: FloatArray) -> Edge:
    """The shear of Saint-Venant's torsion on the boundary of rectangles.

    Timoshenko and Goodier, Theory of Elasticity, 3rd edition, art. 109, eqs. (a) to (d), with the
    torsion constant of eq. (160), as in `flexact.model.sections.constants_of`.

    Between the places the stress of von Mises is larger by 0.02 % at most; a test compares it with
    the whole section.

    Args:
        ratio: (k,) breadth over thickness, 1 or more.
    """
    n, wide = _ODD[:, None, None], np.asarray(ratio, np.float64)[:, None]
    sign = np.where(_ODD % 4.0 == 1.0, 1.0, -1.0)[:, None, None]
    whole = n * math.pi * wide / 2.0
    torsion = wide / 3.0 - 64.0 / math.pi**5 * (np.tanh(whole) / n**5).sum(axis=0)
    # From the corner to the middle of the long side.
    far = np.minimum(_NEAR, wide / 2.0)
    far = np.concatenate([far, wide / 2.0], axis=1)
    # cosh u/cosh v of two that are large.
    here = n * math.pi * (wide / 2.0 - far)
    share = np.exp(here - whole) * (1.0 + np.exp(-2.0 * here)) / (1.0 + np.exp(-2.0 * whole))
    long = 1.0 - 8.0 / math.pi**2 * (share / n**2).sum(axis=0)
    # The series is slow in the corner, where nothing is.
    long = np.where(far > 0.0, long, 0.0)
    cosines = np.cos(n * math.pi / 2.0 * _ACROSS)
    short = 8.0 / math.pi**2 * (sign * np.tanh(whole) / n**2 * cosines).sum(axis=0)
    one = np.ones_like
    return Edge(
        np.concatenate([1.0 - 2.0 * far / wide, one(short)], axis=1),
        np.concatenate([one(long), np.broadcast_to(_ACROSS, short.shape)], axis=1),
        np.concatenate([long, short], axis=1) / torsion,
    )


class Peaks(NamedTuple):
    """The largest stresses [Pa] in elements; 0 where no section is known."""

    normal: FloatArray
    """(elements,) largest normal stress in size, without factors."""
    von_mises: FloatArray
    """(3, elements) largest stress of von Mises: at p, at q, and anywhere; with the factor of
    fillets at the ends."""


#: What to do where a section is not known.
SECTION = (
    "give BEAMPROPS with CROSSTYPE RECT or CIRC and CROSSDIM in the deck's picture block, or a "
    "section in Python"
)


class Necks(NamedTuple):
    """Hinges of known section, as notches have them, and what stands beside each."""

    hinge: IntArray
    """(k,) index of the element."""
    half: IntArray
    """(k,) of the half of the notch whose end is the neck, or of the hinge where it has none."""
    end: IntArray
    """(k,) which end of the half that is: 0 p, 1 q."""


@dataclass(frozen=True, eq=False)
class Sections(Frozen):
    """What the stresses of a model's elements hang on.

    Attributes:
        data: The model as given.
        is_known: (elements,) which have a known section: bars, beams, and the hinges of notches.
        is_round: (elements,) which of them are round.
        size: (2, elements) sizes along local y and z [m], 1 where not known.
        factor: (2, elements) at p and q: of a fillet there, or of a notch.
        edge: Of the shapes of the rectangles.
        shape: (elements,) which of these each is of.
        necks: The hinges among them.
    """

    data: ModelData
    is_known: BoolArray
    is_round: BoolArray
    size: FloatArray
    factor: FloatArray
    edge: Edge
    shape: IntArray
    necks: Necks

    @classmethod
    def of(cls, data: ModelData) -> Sections:
        """Of a model."""
        looks, member = data.appearance, member_table()[data.arrays.element_kind]
        size = looks.dimensions.T
        is_hinge = member == Member.HINGE
        is_round = looks.cross_section == CrossSection.CIRC
        is_known = np.isin(member, (Member.BAR, Member.BEAM)) & ~stays_straight(data)
        is_known = (is_known & is_round) | (
            (is_known | is_hinge) & (looks.cross_section == CrossSection.RECT)
        )
        is_known &= (size > 0.0).all(axis=0)
        size = np.where(is_known, size, 1.0)
        return cls(
            data,
            np.asarray(is_known),
            np.asarray(is_round),
            size,
            _factors(data, size.min(axis=0), is_hinge),
            *_edges(size),
            _necks(data, np.flatnonzero(is_known & is_hinge)),
        )

    def resized(self, size: FloatArray) -> Sections:
        """The same with other sizes (2, elements) [m]."""
        is_hinge = member_table()[self.data.arrays.element_kind] == Member.HINGE
        edge, shape = _edges(size)
        factor = _factors(self.data, size.min(axis=0), is_hinge)
        return replace(self, size=size, factor=factor, edge=edge, shape=shape)

    def require(self, element: int) -> None:
        """Raise where the section of an element, by its index, is not known.

        Raises:
            ElasticError: it is no member, or its section is not known.
        """
        if self.is_known[element]:
            return
        arrays = self.data.arrays
        number = int(arrays.element_number[element])
        if member_table()[arrays.element_kind[element]] not in (Member.BAR, Member.BEAM):
            raise ElasticError(f"element {number} is neither a bar nor a beam: it has no section")
        raise ElasticError(f"the section of element {number} is not known: {SECTION}")

    def peaks(self, carried: Carried, owner: IntArray, first: IntArray) -> Peaks:
        """The largest stresses in elements.

        Args:
            carried: What their pieces carry; between the ends of a piece all is linear.
            owner: (pieces,) index of the element that each is of.
            first: (elements,) index of the first piece of each.
        """
        normal, largest = self._at_ends(carried, owner)
        last = np.append(first[1:], owner.size) - 1
        at_p, at_q = largest[0, first] * self.factor[0], largest[1, last] * self.factor[1]
        inside = np.maximum.reduceat(largest.max(axis=0), first)
        normal = np.maximum.reduceat(normal.max(axis=0), first)
        made = np.array([at_p, at_q, np.maximum(inside, np.maximum(at_p, at_q))])
        if (k := self.necks.hinge).size:
            # In the neck is what the half beside it carries there.
            half = self.necks.half
            piece = np.where(self.necks.end == 0, first[half], last[half])
            ends = np.arange(k.size)
            of_neck = self._at_ends(_of_necks(carried, piece, self.necks), k)
            normal[k] = of_neck[0][self.necks.end, ends]
            made[:, k] = of_neck[1][self.necks.end, ends] * self.factor[0, k]
        return Peaks(normal, made)

    def _at_ends(self, carried: Carried, owner: IntArray) -> tuple[FloatArray, FloatArray]:
        """(2, pieces) the largest normal stress, and that of von Mises, at p and q of pieces."""
        y, z = self.size[:, owner]
        is_round, is_known = self.is_round[owner], self.is_known[owner]
        turned, thick, wide = y > z, np.minimum(y, z), np.maximum(y, z)
        my, mz = np.abs(carried.moments)
        # That across the thickness, and that in the plane of the sheet.
        flat = np.where(turned, my, mz) * 6.0 / (wide * thick**2)
        edgewise = np.where(turned, mz, my) * 6.0 / (thick * wide**2)
        area = np.where(is_round, math.pi / 4.0 * y * z, y * z)
        axial, torque = np.abs(carried.normal) / area, np.abs(carried.torque)
        rim = np.hypot(my, mz) * 32.0 / (math.pi * y**3)
        normal = axial + np.where(is_round, rim, flat + edgewise)
        largest = normal**2 + 3.0 * np.where(is_round, 16.0 * torque / (math.pi * y**3), 0.0) ** 2
        twisted = np.flatnonzero(~is_round & (torque > 0.0))
        if twisted.size:
            along, across, shear = (each[self.shape[owner[twisted]]] for each in self.edge)
            shear = shear * (torque / thick**3)[twisted, None]
            stress = (
                axial[twisted, None]
                + flat[:, twisted, None] * across
                + edgewise[:, twisted, None] * along
            )
            largest[:, twisted] = (stress**2 + 3.0 * shear**2).max(axis=2)
        return np.where(is_known, normal, 0.0), np.where(is_known, np.sqrt(largest), 0.0)


def _edges(size: FloatArray) -> tuple[Edge, IntArray]:
    """The boundaries of sections (2, elements), and (elements,) which each has."""
    ratio, shape = np.unique(size.max(axis=0) / size.min(axis=0), return_inverse=True)
    return edge_of(ratio), shape.astype(np.int32)


def _of_necks(carried: Carried, piece: IntArray, necks: Necks) -> Carried:
    """What halves carry beside necks; of a hinge alone its moment, which bends the thickness."""
    moments = carried.moments[:, :, piece].copy()
    alone = necks.half == necks.hinge
    torque = carried.torque[piece]
    # The thickness is along y, as of a half, so that it is bent about z.
    moments[1, :, alone] = torque[alone, None]
    return Carried(carried.normal[piece], np.where(alone, 0.0, torque), moments)


def _necks(data: ModelData, hinges: np.ndarray) -> Necks:
    """Each hinge with the half of its notch that turns with one of its two nodes."""
    nodes = data.arrays.element_node
    # The end of a half by the orientation node that turns with it.
    beside = {
        int(nodes[2 * end + 1, half]): (half, end)
        for half in np.flatnonzero(stays_straight(data)).tolist()
        for end in (0, 1)
    }
    rows = []
    for hinge in hinges.tolist():
        found = (beside[node] for node in nodes[:, hinge].tolist() if node > 0 and node in beside)
        rows.append((hinge, *next(found, (hinge, 0))))
    made = np.array(rows, np.int32).reshape(-1, 3).T
    return Necks(*made)


def _factors(data: ModelData, thickness: FloatArray, is_hinge: BoolArray) -> FloatArray:
    """(2, elements) at both ends: 1 but at those of parts with a fillet, and of necks."""
    made = np.ones((2, thickness.size))
    if data.properties is None:
        return made
    radius = data.properties.fillet[:, 0]
    given = radius > 0.0
    sheet, neck = given & ~is_hinge, given & is_hinge
    made[:, sheet] = stress_factor(thickness[sheet], radius[sheet])
    made[:, neck] = deep_notch_factor(thickness[neck], radius[neck])
    # Where two beams of one part meet nothing is wider.
    for chain in data.chains:
        for k, (element, against) in enumerate(zip(chain.elements, chain.reversed, strict=True)):
            if k > 0:
                made[int(against), element] = 1.0
            if k < len(chain.elements) - 1:
                made[int(not against), element] = 1.0
    return made
