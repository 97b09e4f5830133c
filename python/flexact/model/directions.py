# SPDX-License-Identifier: BSD-3-Clause
"""Directions across elements that depend on geometry alone.

Neither the sign of a local y vector, nor which end is called p, changes them. A sheet has those of
its width and its normal; every other element an upward one, z made perpendicular to its axis (x
where the axis is steep), and one across both. Each is turned so that its z component is positive,
or y or x where those before are small.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray, ModelArrays
from .forms import Form, forms_of

#: Beside the largest component of a direction one below this part is small; and an axis is steep
#: from this part of one on. No angle that designers choose has such a tangent or cosine, so that
#: rounding decides nothing.
_SMALL, _STEEP = 0.2137, 0.8817
#: The order in which components are looked at: z, y, x.
_ORDER = [2, 1, 0]
_UP, _ELSE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def directions_across(arrays: ModelArrays, frame: FloatArray) -> FloatArray:
    """(elements, 2, 3) unit vectors across each element: width and normal, or upward and sideways.

    Args:
        arrays: The model.
        frame: (elements, 3, 3) reference frames, columns ex, ey, ez.
    """
    form, wide = forms_of(arrays)
    axis = frame[..., 0]
    steep = np.abs(axis[:, 2]) > _STEEP
    global_one = np.where(steep[:, None], _ELSE, _UP)
    first = global_one - np.sum(global_one * axis, axis=1, keepdims=True) * axis
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    made = np.stack((first, np.cross(axis, first)), axis=1)
    sheet = np.flatnonzero(form == Form.SHEET)
    width = wide[sheet]
    made[sheet, 0] = frame[sheet, :, width]
    made[sheet, 1] = frame[sheet, :, 3 - width]
    return made * signs_of(made)[..., None]


def signs_of(direction: FloatArray) -> FloatArray:
    """(...,) 1 or -1 that turns directions (..., 3) as the module says."""
    ordered = direction[..., _ORDER]
    size = np.abs(ordered)
    large = size > _SMALL * size.max(axis=-1, keepdims=True)
    first = np.argmax(large, axis=-1)[..., None]
    deciding = np.take_along_axis(ordered, first, axis=-1)[..., 0]
    return np.where(deciding < 0.0, -1.0, 1.0)
