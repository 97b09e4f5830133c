# SPDX-License-Identifier: BSD-3-Clause
"""Colours of pictures: of kinds of members, of symbols, and of values about zero.

Kinds, symbols, and the ends of the scale of values are told apart by people with protanopia,
deuteranopia and tritanopia as well (`tests/python/test_colours.py` measures by how much).
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.forms import Form

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

OF_FORMS = {
    Form.SHEET: (0.53, 0.70, 0.88),
    Form.WIRE: (0.80, 0.69, 0.20),
    Form.BAR: (0.25, 0.46, 0.46),
    Form.BEAM: (0.62, 0.66, 0.72),
    Form.RIGID: (0.65, 0.66, 0.67),
}
HINGE = (0.54, 0.45, 0.65)
SUPPORT = (0.38, 0.40, 0.43)
GHOST = (0.72, 0.74, 0.77)
GHOST_FACE = (0.8936, 0.9012, 0.9126)
#: Displacements of a motion, and declared degrees of freedom.
ARROW = (0.80, 0.37, 0.06)
FREEDOM = (0.0, 0.62, 0.40)
#: What is pointed at.
MARK = (1.0, 0.92, 0.0)
#: Freedom and constraint spaces, red and blue as in the literature on them; wires to add.
FREEDOM_SPACE = (0.90, 0.15, 0.24)
CONSTRAINT_SPACE = (0.06, 0.28, 0.84)
NEW_WIRE = (0.32, 0.16, 0.0)


def of_forms(form: np.ndarray) -> FloatArray:
    """(k, 3) red, green and blue of (k,) forms."""
    table = np.zeros((max(Form) + 1, 3))
    for each, colour in OF_FORMS.items():
        table[each] = colour
    made: FloatArray = table[form]
    return made


def diverging(values: FloatArray) -> FloatArray:
    """(..., 3) red, green and blue of values from -1 to 1; those beyond are as the ends."""
    place = np.linspace(-1.0, 1.0, len(STOPS))
    return np.stack([np.interp(values, place, STOPS[:, k]) for k in range(3)], axis=-1)
