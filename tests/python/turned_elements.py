# SPDX-License-Identifier: BSD-3-Clause
"""Models whose elements are told otherwise: vectors turned round, and ends exchanged."""

from dataclasses import replace

import numpy as np

from flexact.core.elements import Member, member_table
from flexact.model.data import ModelData
from flexact.model.model import Model

#: Deformations of a beam whose ends are exchanged, and of a planar one.
_EXCHANGED, _EXCHANGED_IN_PLANE = [0, 1, 3, 2, 5, 4], [0, 2, 1, 3, 4, 5]


def plain(data: ModelData) -> ModelData:
    """The model as if it had been made in Python."""
    return replace(data, source=None, found=None)


def turned(data: ModelData, seed: int) -> Model:
    """Vectors of beams turned round and ends exchanged, as it comes."""
    rng, a = np.random.default_rng(seed), data.arrays
    vector, node, classes = (
        each.copy() for each in (a.element_vector, a.element_node, a.deformation_class)
    )
    member = member_table()[a.element_kind]
    for i in range(a.element_number.size):
        if member[i] == Member.BEAM and rng.random() < 0.5:
            vector[:, i] = -vector[:, i]
        if rng.random() < 0.5:
            if member[i] == Member.BEAM:
                node[:, i] = node[[2, 3, 0, 1], i]
                order = _EXCHANGED if classes[3, i] else _EXCHANGED_IN_PLANE
                classes[:, i] = classes[order, i]
            elif member[i] == Member.BAR:
                node[:, i] = node[[2, 1, 0, 3], i]
    arrays = a._replace(element_vector=vector, element_node=node, deformation_class=classes)
    return Model.from_data(replace(plain(data), arrays=arrays))
