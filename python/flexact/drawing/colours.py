# SPDX-License-Identifier: BSD-3-Clause
"""Colours of pictures: of kinds of members, of symbols, and of values about zero."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from ..model.parts.forms import Form

#: (7, 3) from the most negative value over zero to the most positive: blue, grey, red, even in
#: lightness to both sides and told apart by colour-blind people (Moreland, Diverging Color Maps
#: for Scientific Visualization, 2009: "cool to warm").
STOPS = (
    np.array(
        [
            (59, 76, 192),
            (111, 146, 243),
            (170, 199, 253),
            (221, 221, 221),
            (247, 184, 156),
            (231, 116, 91),
            (180, 4, 38),
        ]
    )
    / 255.0
)
STOPS.flags.writeable = False

_FORM_COLOURS = {
    Form.SHEET: (0.49, 0.64, 0.80),
    Form.WIRE: (0.80, 0.58, 0.30),
    Form.BAR: (0.44, 0.55, 0.62),
    Form.BEAM: (0.62, 0.66, 0.72),
    Form.RIGID: (0.66, 0.68, 0.71),
}
HINGE = (0.62, 0.44, 0.64)
SUPPORT = (0.38, 0.40, 0.43)
GHOST = (0.72, 0.74, 0.77)
#: Displacements of a motion, and declared degrees of freedom.
ARROW = (0.85, 0.37, 0.01)
FREEDOM = (0.11, 0.55, 0.38)
#: Freedom and constraint spaces, red and blue as in the literature on them; wires to add.
FREEDOM_SPACE = (0.83, 0.16, 0.22)
CONSTRAINT_SPACE = (0.07, 0.36, 0.78)
NEW_WIRE = (0.45, 0.27, 0.02)


def of_forms(form: np.ndarray) -> FloatArray:
    """(k, 3) red, green and blue of (k,) forms."""
    table = np.zeros((max(Form) + 1, 3))
    for each, colour in _FORM_COLOURS.items():
        table[each] = colour
    made: FloatArray = table[form]
    return made


def diverging(values: FloatArray) -> FloatArray:
    """(..., 3) red, green and blue of values from -1 to 1; those beyond are as the ends."""
    place = np.linspace(-1.0, 1.0, len(STOPS))
    return np.stack([np.interp(values, place, STOPS[:, k]) for k in range(3)], axis=-1)
