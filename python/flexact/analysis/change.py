# SPDX-License-Identifier: BSD-3-Clause
"""A change of a mechanism: what is held or declared otherwise, moved, added or left out."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..core.elements import Class
from ..model.data import ModelData
from ..model.names import part_name
from ..model.variation import with_classes, with_positions, with_vectors
from ..util.loading import load
from ..util.records import Frozen

if TYPE_CHECKING:
    from ..model.handles import Node
    from ..model.model import Model

#: What wires and sheets that are added are called.
_NEW_WIRE, _NEW_SHEET = "new wire", "new sheet"


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


class AddedSheet(NamedTuple):
    """A sheet from a body to the ground; but for the width as of a wire."""

    position: int
    orientation: int
    end: tuple[float, float, float]
    ground: tuple[float, float, float]
    width: tuple[float, float, float]
    """Direction from edge to edge."""
    body: str = ""


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
        sheets: Sheets that are added likewise.
        vectors: Number of an element and the vector, y vector or axis, that it gets (x, y, z).
        left_out: Numbers of elements that are left out, with those of their ends that no other
            element uses.
    """

    deformations: tuple[tuple[int, int, Class], ...] = ()
    coordinates: tuple[tuple[int, str, Class], ...] = ()
    places: tuple[tuple[int, tuple[float, float, float]], ...] = ()
    wires: tuple[AddedWire, ...] = ()
    sheets: tuple[AddedSheet, ...] = ()
    vectors: tuple[tuple[int, tuple[float, float, float]], ...] = ()
    left_out: tuple[int, ...] = ()

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
        model: Model = load("flexact.model.model").Model.from_data(data)
        for number in self.left_out:
            model.delete(number, ends=True)
        flexures: list[AddedWire | AddedSheet] = [*self.wires, *self.sheets]
        for added in flexures:
            end, ground = _ends(model, data, added)
            if isinstance(added, AddedSheet):
                model.sheet(end, ground, added.width, name=_free_name(model, _NEW_SHEET))
            else:
                model.wire(end, ground, name=_free_name(model, _NEW_WIRE))
            model.fix(ground)
        return model


def _ends(model: Model, data: ModelData, added: AddedWire | AddedSheet) -> tuple[Node, Node]:
    """Both ends of a wire or sheet, with a link where the body has no node at its own."""
    count = 2 if data.planar else 3
    own = data.arrays.node_value[:count, data.node_index[added.position]]
    end = model.handle(added.position, added.orientation)
    if not np.array_equal(own, added.end[:count]):
        place = model.node(added.end[:count])
        model.body([end, place], name=added.body)
        end = place
    return end, model.node(added.ground[:count])


def _free_name(model: Model, word: str) -> str:
    taken = {part_name(name) for name in model.element_names}
    names = (word if k == 1 else f"{word} {k}" for k in itertools.count(1))
    return next(name for name in names if name not in taken)
