# SPDX-License-Identifier: BSD-3-Clause
"""What the deformations of elements are called, by their roles."""

from __future__ import annotations

from ..core.elements import Role, role_table

_WORDS: dict[int, str] = {
    Role.ELONGATION: "elongation",
    Role.TORSION: "torsion",
    Role.BENDING_XZ_P: "bending at p in the local xz plane",
    Role.BENDING_XZ_Q: "bending at q in the local xz plane",
    Role.BENDING_XY_P: "bending at p in the local xy plane",
    Role.BENDING_XY_Q: "bending at q in the local xy plane",
    Role.PLANAR_BENDING_P: "bending at p",
    Role.PLANAR_BENDING_Q: "bending at q",
    Role.OFFSET_X: "along its axis",
    Role.OFFSET_Y: "along its local y",
    Role.OFFSET_Z: "along its local z",
    Role.ROTATION: "rotation about the axis",
    Role.TILT_Y: "first tilt of the axis",
    Role.TILT_Z: "second tilt of the axis",
    Role.ANGLE: "rotation",
}


def deformation_word(kind: int, deformation: int) -> str:
    """What deformation 1, 2, ... of an element kind (row of the table, from 1) is."""
    return _WORDS[int(role_table()[kind, deformation - 1])]
