# SPDX-License-Identifier: BSD-3-Clause
"""Directions across elements that depend on geometry alone.

Neither the sign of a local y vector, nor which end is called p, changes them. A sheet has those of
its width and its normal; every other element an upward one, z made perpendicular to its axis (x
where the axis is steep), and one across both. Each is turned so that its z component is positive,
or y or x where those before are small. Those of all beams of a divided sheet or wire are turned
together.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...core.arrays import FloatArray, ModelArrays
from .chains import Chain
from .forms import Form, forms_of

#: Beside the largest component of a direction one below this part is small; and an axis is steep
#: from this part of one on. No angle that designers choose has such a tangent or cosine, so that
#: rounding decides nothing.
_SMALL, _STEEP = 0.2137, 0.8817
#: The order in which components are looked at: z, y, x.
_ORDER = [2, 1, 0]
_UP, _ELSE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def directions_across(
    arrays: ModelArrays, frame: FloatArray, chains: Sequence[Chain]
) -> FloatArray:
    """(elements, 2, 3) unit vectors across each element: width and normal, or upward and sideways.

    Args:
        arrays: The model.
        frame: (elements, 3, 3) reference frames, columns ex, ey, ez.
        chains: Its divided sheets and wires.
    """
    form, wide = forms_of(arrays)
    axis = frame[..., 0].copy()
    for chain in chains:
        ends = arrays.node_value[:3, [chain.positions[0], chain.positions[-1]]].T
        axis[list(chain.elements)] = _unit(ends[1] - ends[0])
    steep = np.abs(axis[:, 2]) > _STEEP
    axis, first = frame[..., 0], np.where(steep[:, None], _ELSE, _UP)
    first = _unit(first - np.sum(first * axis, axis=1, keepdims=True) * axis)
    made = np.stack((first, np.cross(axis, first)), axis=1)
    sheet = np.flatnonzero(form == Form.SHEET)
    width = wide[sheet]
    made[sheet, 0] = frame[sheet, :, width]
    made[sheet, 1] = frame[sheet, :, 3 - width]
    sign = signs_of(made)
    for chain in chains:
        row = list(chain.elements)
        onward = np.where(np.sum(made[row[1:]] * made[row[:-1]], axis=-1) < 0.0, -1.0, 1.0)
        sign[row] = np.concatenate((np.ones((1, 2)), np.cumprod(onward, axis=0)))
        sign[row] *= signs_of(np.sum(made[row] * sign[row][..., None], axis=0))
    return made * sign[..., None]


def _unit(vector: FloatArray) -> FloatArray:
    made: FloatArray = vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    return made


def signs_of(direction: FloatArray) -> FloatArray:
    """(...,) 1 or -1 that turns directions (..., 3) as the module says."""
    ordered = direction[..., _ORDER]
    size = np.abs(ordered)
    large = size > _SMALL * size.max(axis=-1, keepdims=True)
    first = np.argmax(large, axis=-1)[..., None]
    deciding = np.take_along_axis(ordered, first, axis=-1)[..., 0]
    return np.where(deciding < 0.0, -1.0, 1.0)
