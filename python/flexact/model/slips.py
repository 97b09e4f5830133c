# SPDX-License-Identifier: BSD-3-Clause
"""Sizes, moduli and densities that are hardly meant: mostly those of another unit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from ..core.elements import Member, NodeKind, member_table
from ..deck.diagnostics import Diagnostic, Severity
from .attributes import CrossSection
from .names import part_name
from .parts.forms import Form, forms_of

if TYPE_CHECKING:
    from .data import ModelData

#: No sheet or wire is longer [m]; moduli [Pa] and densities [kg/m3] of solids are within these.
_LONGEST, _MODULI, _DENSITIES = 5.0, (1.0e8, 1.0e12), (100.0, 3.0e4)
#: What a number in another unit is to be multiplied with, and that unit.
_MODULUS_UNITS = ((1e9, "GPa"), (1e6, "MPa (N/mm2)"), (1e-6, "N/m2 times mm2"))
_DENSITY_UNITS = ((1e3, "g/cm3"), (1e9, "kg/mm3"), (1e12, "t/mm3"), (1e-3, "g/m3"))


def slips_in(data: ModelData) -> Iterator[Diagnostic]:
    """Warnings about a sound model, one of each kind."""
    # Most models are small, and nothing of their size is made for them.
    if float(np.ptp(data.arrays.node_value[:3], axis=1).max(initial=0.0)) > _LONGEST:
        yield from _long(data, _lengths(data))
    if data.properties is None or data.given_appearance is None:
        return
    area, thickness = _sections(data)
    stiff = np.nan_to_num(data.properties.stiffness[:, 0])
    mass = np.nan_to_num(data.properties.mass[:, 0])
    # Of a rigid link the mass is that of all of it.
    per_length = member_table()[data.arrays.element_kind] == Member.BEAM
    known = np.where(area > 0.0, area, math.inf)
    yield from _outside(
        *(data, stiff / known, _MODULI, "unlikely-modulus", "an E of {} Pa", _MODULUS_UNITS),
        "E is in Pa, and EA of ESTIFF in N",
    )
    yield from _outside(
        *(data, np.where(per_length, mass, 0.0) / known, _DENSITIES),
        *("unlikely-density", "a density of {} kg/m3", _DENSITY_UNITS),
        "densities are in kg/m3, and EM of a beam in kg/m",
    )
    yield from _thick(data, _lengths(data), np.where(stiff > 0.0, thickness, 0.0))


def _lengths(data: ModelData) -> FloatArray:
    """(elements,) distances between the ends [m], 0 where an element has no two."""
    arrays = data.arrays
    p, q = arrays.element_node[0] - 1, arrays.element_node[2] - 1
    there = (p >= 0) & (q >= 0)
    places = np.where(arrays.node_kind <= NodeKind.POSITION, arrays.node_value[:3], 0.0)
    with np.errstate(over="ignore"):
        made = np.linalg.norm(places[:, q] - places[:, p], axis=0)
    return np.where(there, made, 0.0)


def _sections(data: ModelData) -> tuple[FloatArray, FloatArray]:
    """(elements,) area [m2] and smaller size [m] of solid sections, 0 where none is known."""
    looks = data.appearance
    b, h = looks.dimensions.T
    round_ = looks.cross_section == CrossSection.CIRC
    solid = round_ | (looks.cross_section == CrossSection.RECT)
    area = np.where(round_, math.pi / 4.0, 1.0) * b * h
    return np.where(solid, area, 0.0), np.where(solid, np.minimum(b, h), 0.0)


def _long(data: ModelData, length: FloatArray) -> Iterator[Diagnostic]:
    """A sheet or wire that is longer than any; of a divided one all of it counts."""
    whole = length.copy()
    for chain in data.chains:
        whole[list(chain.elements)] = length[list(chain.elements)].sum()
    form, _ = forms_of(data.arrays)
    found = np.isin(form, (Form.SHEET, Form.WIRE)) & (whole > _LONGEST)
    if found.any():
        most = float(whole[found].max())
        yield _warning(
            *("long-sheet", f"{_named(data, found)} {_is(found)} {most:.4g} m long"),
            f"give all positions in metres: {most:.4g} mm are {most / 1e3:.4g} m",
        )


def _outside(
    data: ModelData,
    value: FloatArray,
    between: tuple[float, float],
    code: str,
    words: str,
    units: tuple[tuple[float, str], ...],
    plain: str,
) -> Iterator[Diagnostic]:
    """Values, 0 where none is known, that are not between two."""
    low, high = between
    found = (value > 0.0) & ~((value >= low) & (value <= high))
    if not found.any():
        return
    one = float(value[found][0])
    meant = next((unit for factor, unit in units if low <= one * factor <= high), "")
    yield _warning(
        *(code, f"{_named(data, found)} {'have' if found.sum() > 1 else 'has'} "),
        f"{one:.4g} is a usual number in {meant}: {plain}" if meant else plain,
        words.format(f"{one:.4g}"),
    )


def _thick(data: ModelData, length: FloatArray, thickness: FloatArray) -> Iterator[Diagnostic]:
    found = (length > 0.0) & (thickness > length)
    if found.any():
        size = float(thickness[found][0])
        yield _warning(
            *("thick-section", f"{_named(data, found)} {_is(found)} thicker than long"),
            f"its section is {size:.4g} m thick: sections are in metres",
        )


def _warning(code: str, message: str, help_: str, more: str = "") -> Diagnostic:
    return Diagnostic(Severity.WARNING, code, message + more, help=help_)


def _is(found: BoolArray) -> str:
    return "are" if found.sum() > 1 else "is"


def _named(data: ModelData, found: BoolArray) -> str:
    """Such as "element 1 (sheet 1) and 5 more"."""
    first = int(np.flatnonzero(found)[0])
    name = part_name(data.element_names[first]).strip()
    number = int(data.arrays.element_number[first])
    more = int(found.sum()) - 1
    return f"element {number}{f' ({name})' if name else ''}{f' and {more} more' if more else ''}"
