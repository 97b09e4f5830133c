"""What the deformations of each element are called."""

from __future__ import annotations

from .elements import element_kinds

_BODY = ("along its axis", "along its local y", "along its local z")
_WORDS = {
    "TRUSS": ("elongation",),
    "BEAM": (
        "elongation",
        "torsion",
        "bending at p in the local xz plane",
        "bending at q in the local xz plane",
        "bending at p in the local xy plane",
        "bending at q in the local xy plane",
    ),
    "RBEAM": _BODY,
    "PINBODY": _BODY,
    "HINGE": ("rotation about the axis", "first tilt of the axis", "second tilt of the axis"),
    "PLTRUSS": ("elongation",),
    "PLBEAM": ("elongation", "bending at p", "bending at q"),
    "PLRBEAM": _BODY[:2],
    "PLHINGE": ("rotation",),
}


def deformation_word(kind: int, deformation: int) -> str:
    """What deformation 1, 2, ... of an element kind (row of the table, from 1) is."""
    words = _WORDS.get(element_kinds()[kind - 1].keyword, ())
    return words[deformation - 1] if deformation <= len(words) else "deformation"
