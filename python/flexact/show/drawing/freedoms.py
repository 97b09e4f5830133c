# SPDX-License-Identifier: BSD-3-Clause
"""Declared degrees of freedom as they are drawn, with a sense that geometry gives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...analysis.freedoms import Freedom
from ...analysis.order import coordinate_key, ranked
from ...analysis.velocities import Velocities
from ...util.partial import attempted
from .drawing_pose import Moving
from .natural import natural_shape


def way_of(freedom: Freedom) -> Moving | None:
    """The motion of a declared degree of freedom as it is drawn; None where it cannot move.

    It has its natural shape (`natural_shape`), where that can be found. A coordinate grows. The
    sign of a deformation depends on which end is p; its motion is drawn with the sense in which
    its largest part is positive, of equal ones the first by name and place.

    Raises:
        AnalysisError: The motion cannot be found.
    """
    if freedom.motion is None:
        return None
    plain = freedom.motion
    motion = attempted("Its shape", lambda: natural_shape(freedom.analysis, plain), plain, None)
    if freedom.is_coordinate:
        return motion
    outcome, length = freedom.analysis, freedom.analysis.characteristic_length
    data, moved, turned = (
        motion.analysed.data,
        motion.analysed.displacement,
        motion.analysed.rotation,
    )
    both = moved + length * turned
    node, axis = (each.tolist() for each in np.nonzero(both))
    (first,) = ranked(both[node, axis], 1, lambda i: coordinate_key(outcome, node[i], axis[i]))
    sense = np.sign(both[node[first], axis[first]])
    return replace(motion, analysed=Velocities(data, sense * moved, sense * turned))
