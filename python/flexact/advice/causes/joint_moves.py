# SPDX-License-Identifier: BSD-3-Clause
"""Joints of frameworks moved out of a special position: where no limb can be turned."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...analysis.change import Change
from ...analysis.order import without_sense
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind
from ...util.errors import FlexactError
from ..proposal import Proposal, Purpose, tried
from .gradients import Gradients
from .lifts import node_key

#: How far a joint is moved beside the members that meet there, and how many are tried.
_STEP, _MOST_JOINTS = 0.2, 12
#: Values that differ by less than this part are one.
_EQUAL = 1.0e-5


@dataclass(frozen=True, eq=False)
class JointMove(Proposal):
    """A joint of bars that is moved, tried.

    Attributes:
        node: Number of its position node in the model as given; 0 where there is none.
        step: (3,) by which it is moved [m].
    """

    node: int = 0
    step: FloatArray = field(default_factory=lambda: np.zeros(3))


def joint_move(whole: Result, gradients: Gradients) -> tuple[JointMove, ...]:
    """The one move of one joint that lifts the most, with its equals as alternatives; or none.

    Only of mechanisms of bars, and where fewer motions and self-stresses are left.

    Args:
        whole: A result with special motions and self-stresses, told by parts.
        gradients: Its derivatives.
    """
    if any(part.kind is not PartKind.BAR for part in whole.parts.all):
        return ()
    blocks = gradients.at_nodes()
    flat = blocks.reshape(blocks.shape[0], 3, -1)
    left, values, _ = np.linalg.svd(flat, full_matrices=False)
    held = [whole.parts.is_held(int(given)) for given in whole.condensed.nodes]
    sizes = np.where(held, 0.0, values[:, 0] * gradients.geometry.sizes)
    if not sizes.max(initial=0.0) * 1.0e7 > 1.0:
        return ()
    able = np.flatnonzero(sizes >= (1.0 - _EQUAL) * sizes.max()).tolist()
    able.sort(key=lambda node: node_key(whole, node))
    found = []
    for node in able[:_MOST_JOINTS]:
        direction = without_sense(left[node, :, 0])
        step = _STEP * float(gradients.geometry.sizes[node]) * direction
        for sense in (1.0, -1.0):
            made = _tried(whole, node, sense * step)
            if made is not None:
                found.append(made)
    if not found:
        return ()
    best = max(one.after.smallest or 0.0 for one in found)
    first, *others = [
        one for one in found if abs((one.after.smallest or 0.0) - best) <= _EQUAL * best
    ]
    alternatives = tuple(one.change for one in others)
    return (
        JointMove(
            *(Purpose.MEND, first.change, first.condition, first.after, alternatives),
            node=first.node,
            step=first.step,
        ),
    )


def _tried(whole: Result, node: int, step: FloatArray) -> JointMove | None:
    given = int(whole.condensed.nodes[node])
    arrays = whole.given.arrays
    number = int(arrays.node_number[given])
    x, y, z = (arrays.node_value[:3, given] + step).tolist()
    change = Change(places=((number, (x, y, z)),))
    try:
        after = tried(whole, change)
    except FlexactError:
        return None
    under = whole.under_constrained - after.under_constrained
    over = whole.over_constrained - after.over_constrained
    if under <= 0 or over <= 0 or not after.smallest:
        return None
    before = whole.gap.smallest_nonzero or 1.0
    condition = max(1.0, before / after.smallest)
    return JointMove(Purpose.MEND, change, condition, after, node=number, step=np.array(step))
