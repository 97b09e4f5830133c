# SPDX-License-Identifier: BSD-3-Clause
"""What the quantities of a self-stress are called in a drawing, and what their signs mean."""

from __future__ import annotations

import numpy as np

from ...analysis.resultants import QUANTITIES
from ...model.parts.forms import Form
from .drawing import Drawing

FORCE, TWIST, IN_PLANE, OUT_OF_PLANE = QUANTITIES
#: Those that bend, each with the row of the directions across a member to which it bends.
BENDING = {IN_PLANE: 0, OUT_OF_PLANE: 1}
UNITS = {FORCE: "N", TWIST: "N m", IN_PLANE: "N m", OUT_OF_PLANE: "N m"}

#: What they are called besides; My and Mz are those of the local axes that sheets have in decks
#: of the paper.
_OTHER_NAMES = {
    **{"n": FORCE, "normal": FORCE},
    **{"t": TWIST, "twist": TWIST, "torsion": TWIST},
    **{"my": IN_PLANE, "in plane": IN_PLANE},
    **{"mz": OUT_OF_PLANE, "out of plane": OUT_OF_PLANE, "bending moment": OUT_OF_PLANE},
}
_SIDES = {
    FORCE: "blue: compression; red: tension",
    TWIST: "blue and red: opposite senses",
    IN_PLANE: "red: stretches the {} towards z (y or x if it lies so)",
    OUT_OF_PLANE: "red: stretches the {} towards z (y or x if it lies so)",
}


def quantity_named(name: str) -> str | None:
    """The quantity of this name, however it is written; None where there is none."""
    plain = " ".join(name.lower().replace("-", " ").replace("_", " ").split())
    known = {each.replace("-", " "): each for each in QUANTITIES} | _OTHER_NAMES
    return known.get(plain)


def names_in(drawing: Drawing) -> dict[str, str]:
    """What each quantity is called there: the words of sheets where there are any."""
    if drawing.planar:
        bending = ("bending moment out of the plane", "bending moment")
    elif np.any(drawing.members.form == Form.SHEET):
        return {each: each for each in QUANTITIES}
    else:
        bending = ("upward bending moment", "sideways bending moment")
    return dict(zip(QUANTITIES, (FORCE, TWIST, *bending), strict=True))


def meanings_in(drawing: Drawing) -> dict[str, str]:
    """What each quantity is, for a legend or a caption."""
    names = names_in(drawing)
    return names | {FORCE: f"{names[FORCE]}, tension positive"}


def sides_in(drawing: Drawing) -> dict[str, str]:
    """What the colours of each quantity mean."""
    edge, face = "edge", "face"
    if drawing.planar or not np.any(drawing.members.form == Form.SHEET):
        edge = face = "side"
    return {each: _SIDES[each].format(edge if each == IN_PLANE else face) for each in QUANTITIES}
