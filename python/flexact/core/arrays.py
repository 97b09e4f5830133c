# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of a model as the core takes them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..util.text import in_short

IntArray = NDArray[np.int32]
FloatArray = NDArray[np.float64]
ByteArray = NDArray[np.int8]
BoolArray = NDArray[np.bool_]
#: Whole numbers of any size, such as indices.
IndexArray = NDArray[np.integer]
AnyArray = NDArray[Any]

#: What numpy makes numbers of all the same.
_NO_NUMBER = (str, bytes, type(None))


def floats(given: ArrayLike, what: str) -> FloatArray:
    """Numbers that somebody gives, in an array of any shape.

    Raises:
        TypeError: They are no numbers.
        ValueError: One is too large, or the lists in it differ in length.
    """
    try:
        array = np.asarray(given)
        parts = array.flat if array.dtype.kind == "O" else ()
        if array.dtype.kind not in "biufO" or any(isinstance(part, _NO_NUMBER) for part in parts):
            raise TypeError
        return np.asarray(array, np.float64)
    except TypeError:
        raise TypeError(f"{what} must be numbers, not {in_short(given)}") from None
    except (ValueError, OverflowError):
        raise ValueError(f"{what} must be numbers of one shape, none of them too large") from None


class ModelArrays(NamedTuple):
    """A model as the core sees it; shapes with nodes = nn and elements = ne."""

    node_number: IntArray
    """(nn,) number of the node."""
    node_kind: IntArray
    """(nn,) 1 planar position, 2 position, 3 angle, 4 orientation."""
    node_value: FloatArray
    """(4, nn) position [m]; Euler parameters; or angle [rad] in the first."""
    coordinate_class: IntArray
    """(3, nn) by axis: 0 none, 1 fixed, 2 dependent, 3 independent."""
    element_number: IntArray
    """(ne,) number of the element."""
    element_kind: IntArray
    """(ne,) row of the element table."""
    element_node: IntArray
    """(4, ne) one-based node indices by slot p, op, q, oq; 0 unused."""
    element_vector: FloatArray
    """(3, ne) y vector of a beam or axis of a hinge; zeros: not given."""
    deformation_class: IntArray
    """(6, ne): 0 none, 1 fixed, 2 released, 3 independent."""

    def of(self, nodes: NDArray[np.integer], elements: NDArray[np.integer]) -> ModelArrays:
        """The model of some nodes and elements alone, in Fortran order.

        Args:
            nodes: (k,) their indices; all that the elements have are among them.
            elements: (m,) likewise.
        """
        place = np.zeros(self.node_number.size + 1, np.int32)
        place[nodes + 1] = np.arange(1, nodes.size + 1, dtype=np.int32)
        whole = self._replace(element_node=place[self.element_node])
        chosen = {"nn": nodes, "ne": elements}
        return ModelArrays._make(
            np.asfortranarray(getattr(whole, name)[..., chosen[last]])
            for name, (_, last, _) in _LAYOUT.items()
        )


#: Leading size (None: one dimension), last size and type of every array of a model.
_LAYOUT: dict[str, tuple[int | None, str, type[np.int32] | type[np.float64]]] = {
    "node_number": (None, "nn", np.int32),
    "node_kind": (None, "nn", np.int32),
    "node_value": (4, "nn", np.float64),
    "coordinate_class": (3, "nn", np.int32),
    "element_number": (None, "ne", np.int32),
    "element_kind": (None, "ne", np.int32),
    "element_node": (4, "ne", np.int32),
    "element_vector": (3, "ne", np.float64),
    "deformation_class": (6, "ne", np.int32),
}


class PackedModel(NamedTuple):
    """The four arrays in which a model crosses the boundary, in Fortran order."""

    nodes: IntArray
    """(5, nn) number, kind, class of each axis."""
    places: FloatArray
    """(4, nn) value."""
    elements: IntArray
    """(12, ne) number, kind, node in each slot, class of each deformation."""
    vectors: FloatArray
    """(3, ne) vector."""


def room_for(nodes: int, elements: int) -> PackedModel:
    """A packed model that is still to be filled."""
    return PackedModel(
        np.empty((5, nodes), np.int32, order="F"),
        np.empty((4, nodes), order="F"),
        np.empty((12, elements), np.int32, order="F"),
        np.empty((3, elements), order="F"),
    )


def packed(arrays: ModelArrays) -> PackedModel:
    """The arrays of a model as they cross the boundary."""
    room = room_for(arrays.node_number.size, arrays.element_number.size)
    room.nodes[0], room.nodes[1] = arrays.node_number, arrays.node_kind
    room.nodes[2:] = arrays.coordinate_class
    room.elements[0], room.elements[1] = arrays.element_number, arrays.element_kind
    room.elements[2:6], room.elements[6:] = arrays.element_node, arrays.deformation_class
    return room._replace(places=arrays.node_value, vectors=arrays.element_vector)


def unpacked(room: PackedModel, nodes: int, elements: int) -> ModelArrays:
    """The arrays of the first nodes and elements of a packed model."""
    joints, parts = room.nodes[:, :nodes], room.elements[:, :elements]
    views = ModelArrays(
        node_number=joints[0],
        node_kind=joints[1],
        node_value=room.places[:, :nodes],
        coordinate_class=joints[2:],
        element_number=parts[0],
        element_kind=parts[1],
        element_node=parts[2:6],
        element_vector=room.vectors[:, :elements],
        deformation_class=parts[6:],
    )
    return ModelArrays._make(np.array(view, order="F") for view in views)


def model_arrays(**given: ArrayLike) -> ModelArrays:
    """Checked and converted arrays of a model.

    Args:
        **given: the nine arrays of `ModelArrays` by name, of any layout.

    Raises:
        ValueError: a shape does not fit, or a whole number does not fit 32 bits.
        TypeError: an array is not numeric.
    """
    nodes, elements = np.size(given["node_number"]), np.size(given["element_number"])
    for name, (leading, last, _) in _LAYOUT.items():
        size = nodes if last == "nn" else elements
        shape = (size,) if leading is None else (leading, size)
        if np.shape(given[name]) != shape:
            raise ValueError(f"{name} has shape {np.shape(given[name])}, but must have {shape}")
    return ModelArrays(**{name: _converted(name, given[name]) for name in _LAYOUT})


def _converted(name: str, given: ArrayLike) -> NDArray[Any]:
    """A copy in Fortran order and of the core's type, where that loses nothing."""
    array, dtype = np.asarray(given), _LAYOUT[name][2]
    kinds, words = ("iu", "whole") if dtype is np.int32 else ("iuf", "real")
    if array.size and array.dtype.kind not in kinds:
        raise TypeError(f"{name} must hold {words} numbers, not {array.dtype}")
    if dtype is np.int32 and array.size and (array.max() >= 2**31 or array.min() < -(2**31)):
        raise ValueError(f"{name} holds a number that does not fit 32 bits")
    return np.array(array, dtype, order="F")


class Basis(NamedTuple):
    """Vectors side by side, of which only the entries that are not zero are stored."""

    size: int
    """Length of each vector."""
    start: IntArray
    """(k + 1,) where the entries of each of the k vectors begin, and where the last one ends."""
    place: IntArray
    """(entries,) place in the vector, from 0, ascending within a vector."""
    value: FloatArray
    """(entries,)."""

    @property
    def vectors(self) -> int:
        """Number of vectors."""
        return self.start.size - 1

    def vector(self, k: int) -> FloatArray:
        """(size,) vector k with its zeros."""
        made = np.zeros(self.size)
        place, value = self.entries(k)
        made[place] = value
        return made

    def entries(self, k: int) -> tuple[IntArray, FloatArray]:
        """Places and values of what is stored of vector k."""
        part = slice(int(self.start[k]), int(self.start[k + 1]))
        return self.place[part], self.value[part]

    def toarray(self) -> FloatArray:
        """(size, k) all vectors with their zeros."""
        made = np.zeros((self.size, self.vectors))
        made[self.place, self.of_entries()] = self.value
        return made

    def only(self, vectors: IntArray) -> Basis:
        """Some of the vectors."""
        counts = np.diff(self.start)[vectors]
        start = np.concatenate(([0], np.cumsum(counts)))
        entries = np.repeat(self.start[vectors] - start[:-1], counts) + np.arange(start[-1])
        return Basis(self.size, start.astype(np.int32), self.place[entries], self.value[entries])

    def of_entries(self) -> IntArray:
        """(entries,) the vector that each entry belongs to."""
        return np.repeat(np.arange(self.vectors, dtype=np.int32), np.diff(self.start))

    @classmethod
    def of_dense(cls, columns: FloatArray) -> Basis:
        """From the columns of a matrix (size, k)."""
        vector, index = np.nonzero(columns.T)
        start = np.searchsorted(vector, np.arange(columns.shape[1] + 1)).astype(np.int32)
        return cls(columns.shape[0], start, index.astype(np.int32), columns.T[vector, index])
