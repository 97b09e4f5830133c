# SPDX-License-Identifier: BSD-3-Clause
"""How SPACAR numbers coordinates and deformations, Euler parameters included."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import IntArray
from ..core.elements import AXES, Class, NodeKind
from ..model.data import ModelData
from ..model.prescribed import prescribed_in
from ..util.cached import cached_property

#: Classes in the order in which coordinates are numbered, and likewise deformations: fixed (o),
#: calculable (c), input (mm) and dynamic (m).
COORDINATE_ORDER = "ocim"
DEFORMATION_ORDER = "oimc"

#: Components of a node of each kind.
_COMPONENTS = {NodeKind.PLANAR_POSITION: 2, NodeKind.POSITION: 3, NodeKind.ANGLE: 1}
_EULER = 4
#: Letters of the classes, by `Class`, with the inputs behind them.
_LETTERS = np.array([" ", "o", "c", "m", "i"])
_INPUT = 4


class Numbered(NamedTuple):
    """Coordinates or deformations, node by node or element by element, as the log lists them.

    Attributes:
        owner: (k,) index of the node in the model, or of the element in the log's list.
        part: (k,) component or deformation, from 0.
        letter: (k,) o, c, m, or i for an input.
        number: (k,) SPACAR's number of each, from 1: class by class.
        ends: The last number of each class, in the order of its numbers: the counts NXO,
            NXC, NXMM, NXM, or NEO, NEMM, NEM, NEC, each of which includes those before.
    """

    owner: IntArray
    part: IntArray
    letter: np.ndarray[tuple[int], np.dtype[np.str_]]
    number: IntArray
    ends: tuple[int, int, int, int]

    @property
    def inputs_first(self) -> IntArray:
        """Indices of the inputs, and behind them of the dynamic ones, by their numbers."""
        found = [np.flatnonzero(self.letter == letter) for letter in "im"]
        return np.concatenate(found).astype(np.int32)


def _numbered(owner: IntArray, part: IntArray, classes: IntArray, order: str) -> Numbered:
    letter = _LETTERS[classes]
    rank = np.array([order.index(each) for each in letter.tolist()], np.int32)
    place = np.argsort(rank, kind="stable")
    number = np.empty(rank.size, np.int32)
    number[place] = np.arange(1, rank.size + 1)
    ends = np.cumsum(np.bincount(rank, minlength=len(order))).tolist()
    return Numbered(owner, part, letter, number, tuple(ends))


class SpacarNumbering:
    """Nodes and elements in ascending order of their numbers, and what they are numbered as.

    An orientation in space has four Euler parameters. The first is always calculable: a further
    element, of one fixed deformation, keeps their norm.

    Attributes:
        data: The model.
        elements: (elements,) indices of the elements, in the order of the log.
        euler_nodes: (euler elements,) indices of the orientations, each with its element
            behind the others.
    """

    def __init__(self, data: ModelData) -> None:
        """Number what a model has."""
        self.data = data
        arrays = data.arrays
        self.elements = np.argsort(arrays.element_number, kind="stable").astype(np.int32)
        self.euler_nodes = np.flatnonzero(arrays.node_kind == NodeKind.ORIENTATION)
        self._prescribed = prescribed_in(data)

    @cached_property
    def coordinates(self) -> Numbered:
        """Coordinates of the nodes in ascending order of node numbers, as the model has them."""
        arrays = self.data.arrays
        size = np.full(max(NodeKind) + 1, _EULER)
        size[list(_COMPONENTS)] = list(_COMPONENTS.values())
        counts = size[arrays.node_kind]
        owner = np.repeat(np.arange(counts.size), counts)
        part = np.arange(owner.size) - np.repeat(np.cumsum(counts) - counts, counts)
        kind = arrays.node_kind[owner]
        axis = part - (kind == NodeKind.ORIENTATION)
        axis[kind == NodeKind.ANGLE] = AXES[NodeKind.ANGLE][0]
        classes = arrays.coordinate_class[axis, owner].copy()
        classes[self._prescribed.coordinates[axis, owner]] = _INPUT
        # lambda0
        classes[axis < 0] = Class.DEPENDENT
        return _numbered(owner.astype(np.int32), part.astype(np.int32), classes, COORDINATE_ORDER)

    @cached_property
    def deformations(self) -> Numbered:
        """Deformations of the elements in the order of the log, those of Euler elements last."""
        classes = self.data.arrays.deformation_class[:, self.elements].copy()
        classes[self._prescribed.deformations[:, self.elements]] = _INPUT
        owner, part = np.nonzero(classes.T)
        euler = np.arange(self.euler_nodes.size)
        return _numbered(
            np.concatenate([owner, self.elements.size + euler]).astype(np.int32),
            np.concatenate([part, np.zeros_like(euler)]).astype(np.int32),
            np.concatenate([classes.T[owner, part], np.full(euler.size, Class.FIXED)]),
            DEFORMATION_ORDER,
        )

    @property
    def freedoms(self) -> int:
        """How many coordinates and deformations are independent, inputs included: NDOF."""
        (_, calculable, _, coordinates) = self.coordinates.ends
        (fixed, _, rows, _) = self.deformations.ends
        return coordinates - calculable + rows - fixed
