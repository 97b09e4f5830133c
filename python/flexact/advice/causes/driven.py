# SPDX-License-Identifier: BSD-3-Clause
"""Declared freedoms on which a self-stress acts: what they would move is held already.

Prescribed velocities are possible where they do no work on any self-stress, so that of those on
which one acts not each can be driven by itself.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...analysis.order import coordinate_key, row_key
from ...analysis.result import Result
from ...core.elements import AXES, Class, coordinate_name

#: What is below this part of the largest, or of what is added up, is none.
_REST = 1.0e-7


class Driven(NamedTuple):
    """Declared freedoms on which a self-stress acts, in the numbers of the model as analysed."""

    deformations: tuple[tuple[int, int], ...]
    """Number of the element and of the deformation, from 1."""
    coordinates: tuple[tuple[int, str], ...]
    """Number of the node and name of the coordinate."""


def driven_against(result: Result, k: int) -> Driven:
    """The declared freedoms on which a self-stress of a result acts.

    Args:
        result: The result.
        k: Index of the self-stress.
    """
    arrays = result.data.arrays
    place, value = result.stress_basis.entries(k)
    element, deformation = result.raw.row_label[:, place] - 1
    weighted = np.abs(value / result.raw.row_scale[place])
    carries = weighted > _REST * weighted.max(initial=0.0)
    independent = arrays.deformation_class[deformation, element] == Class.INDEPENDENT
    rows = np.flatnonzero(carries & independent).tolist()
    rows.sort(key=lambda i: row_key(result, int(place[i])))
    numbers = arrays.element_number
    deformations = tuple((int(numbers[element[i]]), int(deformation[i]) + 1) for i in rows)
    return Driven(deformations, _coordinates(result, k))


def _coordinates(result: Result, k: int) -> tuple[tuple[int, str], ...]:
    """Independent coordinates at which what the elements exert does not cancel out."""
    arrays = result.data.arrays
    classes = arrays.coordinate_class.T
    if not np.any(classes == Class.INDEPENDENT):
        return ()
    place, value = result.stress_basis.entries(k)
    element, deformation = result.raw.row_label[:, place] - 1
    sigma = np.zeros(6 * arrays.element_number.size)
    sigma[6 * element + deformation] = value
    whole = result.assembly
    terms = whole.value * sigma[whole.row_of]
    total = np.bincount(whole.column_of, terms, classes.size)
    added = np.bincount(whole.column_of, np.abs(terms), classes.size)
    acts = (np.abs(total) > _REST * added.max(initial=0.0)) & (classes == Class.INDEPENDENT).ravel()
    made = []
    found = [divmod(index, 3) for index in np.flatnonzero(acts).tolist()]
    for node, axis in sorted(found, key=lambda each: coordinate_key(result, *each)):
        kind = int(arrays.node_kind[node])
        if axis in AXES[kind]:
            made.append((int(arrays.node_number[node]), coordinate_name(kind, axis)))
    return tuple(made)
