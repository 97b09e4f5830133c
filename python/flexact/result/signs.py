# SPDX-License-Identifier: BSD-3-Clause
"""The overall sign of a motion, which nothing but agreement determines.

Its largest part is positive. Of parts that are as large but for rounding the first one decides: by
what it is, then by where it is. So neither the numbers of nodes and elements nor the order of rows
and columns change it.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..model.data import ModelData

#: Parts that differ by less than this part of the largest are as large.
_EQUAL = 1.0e-6
#: Places that differ by less than this part of the mechanism's size are one.
_SAME = 1.0e-9


def sign_of_motion(data: ModelData, node: np.ndarray, axis: np.ndarray, value: FloatArray) -> float:
    """1 or -1, by the largest displacement or, where it turns more, the largest rotation.

    Args:
        data: The model.
        node: (k,) indices of nodes.
        axis: (k,) 0, 1 or 2.
        value: (k,) their velocities, rotations times the characteristic length [m].
    """
    (row,) = _largest(value)
    owner, place = _standing(data, node[row])
    row = row[owner]
    turning = data.arrays.node_kind[node[row]] > NodeKind.POSITION
    return _of_first(value[row], 3 * turning + axis[row], data.arrays.node_value[:3, place].T)


def _standing(data: ModelData, node: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) each: which of some nodes, and a position where it stands.

    An orientation may stand at several; one that only hinges name has no position but itself.
    """
    slots = data.arrays.element_node.astype(np.int64) - 1
    turned, place = (np.concatenate(each) for each in (slots[[1, 3]], slots[[0, 2]]))
    there = (turned >= 0) & (place >= 0)
    turned, place = np.concatenate((turned[there], node)), np.concatenate((place[there], node))
    owner, pair = np.nonzero(node[:, None] == turned)
    return owner, place[pair]


def _largest(found: FloatArray) -> tuple[np.ndarray, ...]:
    size = np.abs(found)
    return np.nonzero((size >= (1.0 - _EQUAL) * size.max(initial=0.0)) & (size > 0.0))


def _of_first(value: FloatArray, what: np.ndarray, keys: FloatArray) -> float:
    """The sign of the value that comes first: by what it is, then by the columns of keys."""
    if not value.size:
        return 1.0
    left = np.flatnonzero(what == what.min())
    for key in keys.T:
        nearest = float(key[left].min())
        left = left[key[left] <= nearest + _SAME * float(np.ptp(keys, axis=0).max())]
    return -1.0 if value[left[0]] < 0.0 else 1.0
