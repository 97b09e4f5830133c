# SPDX-License-Identifier: BSD-3-Clause
"""Into how many beams each beam of a deck is divided."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np

from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.elements import Class, Member, Role, member_table, role_table
from ..model.data import ModelData
from ..util.plain_text import in_short
from .stiffness_errors import ElasticError

Beams = int | Literal["auto"]

#: The coarser number of beams a sheet of "auto"; the finer one is twice that.
COARSE = 8
#: More beams a sheet than these are surely a mistake.
_MOST = 1000

#: Deformations, from 0, that are stiff or held together, spatial and planar.
_GROUPS = {False: ((0,), (1,), (2, 3), (4, 5)), True: ((0,), (1, 2))}


def beams_given(beams: object) -> Beams:
    """The number of beams a sheet that is asked for.

    Raises:
        TypeError: it is neither a whole number nor "auto".
        ValueError: it is not positive, or far too large.
    """
    if beams == "auto" and isinstance(beams, str):
        return "auto"
    if isinstance(beams, bool) or not isinstance(beams, (int, np.integer)):
        raise TypeError(f'beams must be a whole number or "auto", not {in_short(beams)}')
    if not 1 <= beams <= _MOST:
        raise ElasticError(f"beams must be from 1 to {_MOST}, not {in_short(int(beams))}")
    return int(beams)


def divisible(data: ModelData, stiff: BoolArray, rigid: BoolArray) -> BoolArray:
    """Which elements are flexible beams whose pieces stay together, (elements,).

    Each deformation must have a stiffness or be rigid all along, and a bending must be elastic:
    else the nodes between the pieces could move without any stiffness.

    Args:
        data: The model as given.
        stiff: (6, elements) which deformations have a stiffness of their own.
        rigid: (6, elements) which are rigid.
    """
    arrays = data.arrays
    found = member_table()[arrays.element_kind] == Member.BEAM
    planar = arrays.deformation_class[3] == Class.NONE
    for is_planar, groups in _GROUPS.items():
        fits = np.ones(found.shape, np.bool_)
        for group in groups:
            rows = list(group)
            fits &= stiff[rows].all(axis=0) | rigid[rows].all(axis=0)
        bends = np.zeros(found.shape, np.bool_)
        for group in groups:
            if len(group) == 2:
                rows = list(group)
                bends |= stiff[rows].all(axis=0) & ~rigid[rows].all(axis=0)
        found &= (planar != is_planar) | (fits & bends)
    return np.asarray(found & (data.frames.length > 0.0))


def divisions(data: ModelData, beams: Beams, which: BoolArray) -> tuple[IntArray, ...]:
    """(elements,) pieces of each element, of one mesh or of "auto" of two, the coarser first.

    A sheet that the deck divides into k beams counts as k of them.
    """
    if beams == 1:
        return (np.ones(which.shape, np.int32),)
    there = np.ones(which.shape, np.int32)
    for row in _uniform_rows(data):
        there[row] = len(row)
    wanted = COARSE if beams == "auto" else beams
    pieces = np.where(which, -(-wanted // there), 1).astype(np.int32)
    if beams != "auto":
        return (pieces,)
    if not which.any():
        return (pieces,)
    return pieces, np.where(which, 2 * pieces, 1).astype(np.int32)


def _uniform_rows(data: ModelData) -> Iterator[list[int]]:
    """Elements of each sheet that the deck divides; others begin where `ESTIFF` or `EM` change."""
    said = data.properties
    for chain in data.chains:
        row = [chain.elements[0]]
        for element in chain.elements[1:]:
            if said is not None and not all(
                np.array_equal(numbers[element], numbers[row[-1]], equal_nan=True)
                for numbers in (said.stiffness, said.mass)
            ):
                yield row
                row = []
            row.append(element)
        yield row


def rigid_of_pieces(
    rigid: BoolArray, owner: IntArray, is_first: BoolArray, is_last: BoolArray, kinds: IntArray
) -> BoolArray:
    """(6, pieces) which deformations of the pieces are rigid.

    A bending that is rigid at both ends is so all along; at one end alone it is that of the end
    piece.

    Args:
        rigid: (6, elements) of the deck's elements.
        owner: (pieces,) element of each piece.
        is_first: (pieces,) whether it is at p.
        is_last: (pieces,) whether it is at q.
        kinds: (elements,) element kinds.
    """
    made = rigid[:, owner]
    roles = role_table()[kinds][owner].T
    for p, q in ((2, 3), (4, 5), (1, 2)):
        pair = np.isin(roles[p], _AT_P) & np.isin(roles[q], _AT_Q)
        one = pair & (made[p] != made[q])
        made[p] &= ~one | is_first
        made[q] &= ~one | is_last
    return made


_AT_P = (Role.BENDING_XZ_P, Role.BENDING_XY_P, Role.PLANAR_BENDING_P)
_AT_Q = (Role.BENDING_XZ_Q, Role.BENDING_XY_Q, Role.PLANAR_BENDING_Q)


def bending_pairs(kinds: IntArray) -> tuple[tuple[int, int, BoolArray], ...]:
    """Deformations p and q, from 0, that bend about one axis, and (elements,) where they do."""
    roles = role_table()[kinds].T
    return tuple(
        (p, q, np.asarray(np.isin(roles[p], _AT_P) & np.isin(roles[q], _AT_Q)))
        for p, q in ((2, 3), (4, 5), (1, 2))
    )


def spread_misfit(own: FloatArray, pieces: IntArray, kinds: IntArray) -> FloatArray:
    """(6, pieces in all) what the pieces are made off where the elements are, (6, elements).

    A length is shared out; a twist too, where e2 is a length times an angle; a bending is that
    of the cubic with these slopes at its ends.
    """
    owner = np.repeat(np.arange(pieces.size), pieces)
    count = pieces[owner].astype(np.float64)
    place = np.arange(owner.size) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    made = own[:, owner].copy()
    made[0] /= count
    roles = role_table()[kinds].T
    twists = (roles[1] == Role.TORSION)[owner]
    made[1] = np.where(twists, made[1] / count**2, made[1])
    low, high = place / count, (place + 1) / count
    for p, q, there in bending_pairs(kinds):
        at_p, at_q = own[p][owner], -own[q][owner]
        chord = count * (_shape(high, at_p, at_q) - _shape(low, at_p, at_q))
        fits = there[owner]
        made[p] = np.where(fits, (_slope(low, at_p, at_q) - chord) / count, made[p])
        made[q] = np.where(fits, -(_slope(high, at_p, at_q) - chord) / count, made[q])
    return np.asfortranarray(made)


def _shape(x: FloatArray, p: FloatArray, q: FloatArray) -> FloatArray:
    """The cubic that is 0 at 0 and 1 with these slopes there."""
    return np.asarray(p * (x - 2 * x**2 + x**3) + q * (x**3 - x**2))


def _slope(x: FloatArray, p: FloatArray, q: FloatArray) -> FloatArray:
    return np.asarray(p * (1 - 4 * x + 3 * x**2) + q * (3 * x**2 - 2 * x))
