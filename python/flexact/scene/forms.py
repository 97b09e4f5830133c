"""What a member is to the eye: sheet, wire, bar, beam or rigid solid."""

from __future__ import annotations

from enum import IntEnum

import numpy as np

from ..elements import Class, kind_of
from ..exchange import IntArray, ModelArrays

#: Keywords of the elements that have two ends, by what they are.
TRUSSES = ("TRUSS", "PLTRUSS")
BEAMS = ("BEAM", "PLBEAM")
LINKS = ("RBEAM", "PINBODY", "PLRBEAM")


class Form(IntEnum):
    """What a member is to the eye."""

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


def is_one_of(kind: IntArray, keywords: tuple[str, ...]) -> np.ndarray:
    """(elements,) whether elements are of these keywords."""
    return np.isin(kind, [kind_of(keyword).number for keyword in keywords])


def all_held(arrays: ModelArrays) -> np.ndarray:
    """(elements,) whether every deformation of an element is held."""
    classes = arrays.deformation_class
    made: np.ndarray = np.all((classes == Class.NONE) | (classes == Class.FIXED), axis=0)
    return made


def bending_held(arrays: ModelArrays) -> np.ndarray:
    """(2, elements) how many of the two bendings of a spatial beam are held, in xz and in xy."""
    held = arrays.deformation_class[2:6] == Class.FIXED
    return np.stack((held[:2].sum(axis=0), held[2:].sum(axis=0)))


def forms_of(arrays: ModelArrays) -> tuple[np.ndarray, np.ndarray]:
    """The forms (elements,) and the local axis, 1 or 2, along which a sheet is wide, else 0.

    A sheet is wide in the plane in which its bending is held: local z where deformations 3 and
    4 are held, local y where 5 and 6 are. Elements that are no members have form 0.
    """
    kind = arrays.element_kind
    held = arrays.deformation_class == Class.FIXED
    in_xz, in_xy = bending_held(arrays)
    spatial, planar = (kind == kind_of(word).number for word in BEAMS)
    form = np.zeros(kind.size, np.int64)
    form[spatial] = Form.WIRE
    form[spatial & (in_xz != in_xy)] = Form.SHEET
    form[spatial & (in_xz == 2) & (in_xy == 2)] = Form.BEAM
    form[planar] = Form.SHEET
    form[planar & held[1] & held[2]] = Form.BEAM
    form[(spatial | planar) & all_held(arrays)] = Form.RIGID
    form[is_one_of(kind, TRUSSES)] = Form.BAR
    form[is_one_of(kind, LINKS)] = Form.RIGID
    wide = np.where(in_xz > in_xy, 2, 1)
    wide[planar] = 2
    return form, np.where(form == Form.SHEET, wide, 0)
