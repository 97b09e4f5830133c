# SPDX-License-Identifier: BSD-3-Clause
"""Stress resultants at both ends of elements, with signs that depend on geometry alone.

The normal force is positive in tension. The in-plane moment of a sheet is the bending that the
sheet holds, positive where it stretches the edge at the side of its width direction; the
out-of-plane moment likewise the face at the side of its normal. Those directions, and the two of
elements that are no sheets, are those of `flexact.model.parts.directions`. The twist moment is
positive about the outward normal of a cut. A hinge has no direction from the one part to the
other: it has the sizes of its forces and moments.

The moments of a beam are linear between its ends. A rigid link carries a force alone to its far
end q, so its moments fall to zero there.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Member, Role, role_table
from ..model.data import ModelData
from ..model.parts.forms import is_member

#: The quantities along an element, in their order: N, N m, N m, N m.
QUANTITIES = ("normal force", "twist moment", "in-plane moment", "out-of-plane moment")

#: What a deformation's force or moment is in the local frame: force along ex, moment about ex,
#: ey, ez; end (0 at p, 1 at q), and factor. Planar bending is defined with the other sign.
_AT_ENDS: dict[int, tuple[tuple[int, int, float], ...]] = {
    Role.ELONGATION: ((0, 0, 1.0), (0, 1, 1.0)),
    Role.TORSION: ((1, 0, 1.0), (1, 1, 1.0)),
    Role.BENDING_XZ_P: ((2, 0, 1.0),),
    Role.BENDING_XZ_Q: ((2, 1, 1.0),),
    Role.BENDING_XY_P: ((3, 0, 1.0),),
    Role.BENDING_XY_Q: ((3, 1, 1.0),),
    Role.PLANAR_BENDING_P: ((3, 0, -1.0),),
    Role.PLANAR_BENDING_Q: ((3, 1, -1.0),),
    Role.OFFSET_X: ((0, 0, 1.0), (0, 1, 1.0)),
    Role.OFFSET_Y: ((3, 0, 1.0),),
    Role.OFFSET_Z: ((2, 0, -1.0),),
}
#: Forces at q across a link, which bend it by their arm to p.
_WITH_ARM = (Role.OFFSET_Y, Role.OFFSET_Z)
#: Likewise of a joint, the same at both ends.
_OF_JOINTS: dict[int, int] = {
    Role.OFFSET_X: 0,
    Role.ROTATION: 1,
    Role.TILT_Y: 2,
    Role.TILT_Z: 3,
    Role.ANGLE: 3,
}
#: Cosines as near to zero or one as this are that but for rounding.
_ROUNDING = 1.0e-12


def local_resultants(data: ModelData, element: np.ndarray, value: FloatArray) -> FloatArray:
    """(k, 4, 2) force along ex [N], moments about ex, ey and ez [N m], at both ends.

    Args:
        data: The model.
        element: (k,) indices of elements.
        value: (k, 6) forces and moments dual to their deformations [N, N m].

    What q's side of a cut exerts on p's side.
    """
    kind = data.arrays.element_kind[element]
    joint = is_member(kind, Member.HINGE)
    length = data.frames.length[element]
    made = np.zeros((len(element), 4, 2))
    for deformation, role in enumerate(role_table()[kind].T):
        for each in np.unique(role[role > 0]).tolist():
            chosen = (role == each) & ~joint
            for row, end, factor in _AT_ENDS.get(each, ()):
                arm = length[chosen] if each in _WITH_ARM else 1.0
                made[chosen, row, end] += arm * factor * value[chosen, deformation]
            if each in _OF_JOINTS:
                chosen = (role == each) & joint
                made[chosen, _OF_JOINTS[each]] += value[chosen, deformation, None]
    return made


def shared_resultants(data: ModelData, element: np.ndarray, value: FloatArray) -> FloatArray:
    """(k, 4, 2) the `QUANTITIES` at both ends of elements; arguments as of `local_resultants`."""
    made = local_resultants(data, element, value)
    frame, across = data.frames.frame[element], data.across[element]
    # A moment that stretches the side of a direction is about that direction x ex.
    about = np.cross(across, frame[:, None, :, 0])
    turn = about @ frame[..., 1:]
    for exact in (-1.0, 0.0, 1.0):
        turn[np.abs(turn - exact) < _ROUNDING] = exact
    made[:, 2:] = turn @ made[:, 2:]
    joint = is_member(data.arrays.element_kind[element], Member.HINGE)
    made[joint] = np.abs(made[joint])
    return made
