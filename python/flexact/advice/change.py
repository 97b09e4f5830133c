# SPDX-License-Identifier: BSD-3-Clause
"""A change of a mechanism: what is held, declared or released otherwise, moved, or added."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..base.frozen import Frozen
from ..core.elements import Class
from ..model.data import ModelData
from ..model.model import Model
from ..model.names import part_name
from ..model.variation import with_classes, with_positions, with_vectors

#: What a wire that is added is called.
_NEW_WIRE = "new wire"


class AddedWire(NamedTuple):
    """A wire from a body to the ground."""

    position: int
    """Number of a position node of the body."""
    orientation: int
    """Number of an orientation node of the body."""
    end: tuple[float, float, float]
    """Where it ends on the body [m]; elsewhere than at `position` a rigid link carries it."""
    ground: tuple[float, float, float]
    """Where it is clamped [m]."""
    body: str = ""
    """What the link is called where the body is a single point; empty where it has a name."""


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
        wires: Wires that are added, from a body to the ground.
        vectors: Number of an element and the vector, y vector or axis, that it gets (x, y, z).
    """

    deformations: tuple[tuple[int, int, Class], ...] = ()
    coordinates: tuple[tuple[int, str, Class], ...] = ()
    places: tuple[tuple[int, tuple[float, float, float]], ...] = ()
    wires: tuple[AddedWire, ...] = ()
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
        model = Model.from_data(data)
        for wire in self.wires:
            _add(model, data, wire)
        return model


def _add(model: Model, data: ModelData, wire: AddedWire) -> None:
    """Add a wire, with a link where the body has no node at its end."""
    count = 2 if data.planar else 3
    own = data.arrays.node_value[:count, data.node_index[wire.position]]
    end = model.handle(wire.position, wire.orientation)
    if not np.array_equal(own, wire.end[:count]):
        place = model.node(wire.end[:count])
        model.body([end, place], name=wire.body)
        end = place
    ground = model.node(wire.ground[:count])
    taken = {part_name(name) for name in model.element_names}
    names = (_NEW_WIRE if k == 1 else f"{_NEW_WIRE} {k}" for k in itertools.count(1))
    model.wire(end, ground, name=next(name for name in names if name not in taken))
    model.fix(ground)
