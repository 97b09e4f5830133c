# SPDX-License-Identifier: BSD-3-Clause
"""What a member is: sheet, wire, bar, beam or rigid solid."""

from __future__ import annotations

from enum import IntEnum

import numpy as np

from ...core.arrays import IntArray, ModelArrays
from ...core.elements import Class, Member, Role, member_table, role_table

#: Roles of the bendings in the local planes xz and xy, and of planar beams: at p and at q.
XZ = (Role.BENDING_XZ_P, Role.BENDING_XZ_Q)
XY = (Role.BENDING_XY_P, Role.BENDING_XY_Q)
PLANAR = (Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q)
#: Roles of what happens at p, and at q; what is not among them has no end.
AT_P = frozenset((Role.BENDING_XZ_P, Role.BENDING_XY_P, Role.PLANAR_BENDING_P))
AT_Q = frozenset((Role.BENDING_XZ_Q, Role.BENDING_XY_Q, Role.PLANAR_BENDING_Q))
#: Local axis about or along which a deformation is, by role; x, or none of its own, of others.
LOCAL_AXIS: dict[int, int] = {
    **dict.fromkeys((*XZ, Role.OFFSET_Y, Role.TILT_Y), 1),
    **dict.fromkeys((*XY, Role.OFFSET_Z, Role.TILT_Z), 2),
}


class Form(IntEnum):
    """What a member is."""

    SHEET = 1
    """Stiff in one of its two bending planes; in the plane a beam that bends."""
    WIRE = 2
    """Compliant in both bending planes."""
    BAR = 3
    """A truss."""
    BEAM = 4
    """Stiff in both bending planes, and compliant in torsion or elongation."""
    RIGID = 5
    """All deformations held, or a rigid link."""


def is_member(kind: IntArray, *members: Member) -> np.ndarray:
    """(elements,) whether elements of these kinds are one of some members."""
    return np.isin(member_table(), members)[kind]


def _held_of(arrays: ModelArrays, roles: tuple[Role, ...]) -> np.ndarray:
    """(elements,) how many of the deformations of some roles are held."""
    held = arrays.deformation_class.T == Class.FIXED
    return np.asarray(np.sum(held & np.isin(role_table(), roles)[arrays.element_kind], axis=1))


def all_held(arrays: ModelArrays) -> np.ndarray:
    """(elements,) whether every deformation of an element is held."""
    classes = arrays.deformation_class
    return np.asarray(np.all((classes == Class.NONE) | (classes == Class.FIXED), axis=0))


def bending_held(arrays: ModelArrays) -> np.ndarray:
    """(2, elements) how many of the two bendings of a spatial beam are held, in xz and in xy."""
    return np.stack([_held_of(arrays, roles) for roles in (XZ, XY)])


def forms_of(arrays: ModelArrays) -> tuple[np.ndarray, np.ndarray]:
    """The forms (elements,) and the local axis, 1 or 2, along which a sheet is wide, else 0.

    A sheet is wide in the plane in which its bending is held: local z where deformations 3 and
    4 are held, local y where 5 and 6 are. Elements that are no members have form 0.
    """
    kind = arrays.element_kind
    in_xz, in_xy = bending_held(arrays)
    planar = np.any(np.isin(role_table(), PLANAR), axis=1)[kind]
    spatial = is_member(kind, Member.BEAM) & ~planar
    form = np.zeros(kind.size, np.int64)
    form[spatial] = Form.WIRE
    form[spatial & (in_xz != in_xy)] = Form.SHEET
    form[spatial & (in_xz == 2) & (in_xy == 2)] = Form.BEAM
    form[planar] = Form.SHEET
    form[planar & (_held_of(arrays, PLANAR) == 2)] = Form.BEAM
    form[(spatial | planar) & all_held(arrays)] = Form.RIGID
    form[is_member(kind, Member.BAR)] = Form.BAR
    form[is_member(kind, Member.LINK)] = Form.RIGID
    wide = np.where(in_xz > in_xy, 2, 1)
    wide[planar] = 2
    return form, np.where(form == Form.SHEET, wide, 0)
