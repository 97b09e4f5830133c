# SPDX-License-Identifier: BSD-3-Clause
"""A change of a mechanism: what is held, declared or released otherwise, and what is moved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.frozen import Frozen
from ..core.elements import Class
from ..model.data import ModelData
from ..model.model import Model
from ..model.variation import with_classes, with_positions, with_vectors


@dataclass(frozen=True)
class Change(Frozen):
    """What is done to a mechanism; each part of it may be empty.

    Numbers are those of the model as given, which a deck names too.

    Attributes:
        deformations: Number of the element, number of the deformation from 1, and the class
            that it gets.
        coordinates: Number of the node, the coordinate's name out of x, y, z, rx, ry, rz, and
            the class that it gets.
        places: Number of a position node and where it is put, (x, y, z) [m].
        vectors: Number of an element and the vector, y vector or axis, that it gets (x, y, z).
    """

    deformations: tuple[tuple[int, int, Class], ...] = ()
    coordinates: tuple[tuple[int, str, Class], ...] = ()
    places: tuple[tuple[int, tuple[float, float, float]], ...] = ()
    vectors: tuple[tuple[int, tuple[float, float, float]], ...] = ()

    def apply(self, data: ModelData) -> Model:
        """The changed model; of a deck its comments stay.

        Raises:
            KeyError: there is no such element, deformation, node or coordinate.
        """
        if self.places:
            positions = data.arrays.node_value[:3].T.copy()
            for number, place in self.places:
                positions[data.node_index[number]] = np.asarray(place)
            data = with_positions(data, positions)
        if self.vectors:
            data = with_vectors(data, dict(self.vectors))
        if self.deformations or self.coordinates:
            data = with_classes(
                data,
                {(element, number): given for element, number, given in self.deformations},
                {(node, name): given for node, name, given in self.coordinates},
            )
        return Model.from_data(data)
