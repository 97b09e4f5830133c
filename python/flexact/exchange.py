"""What crosses the boundary: arrays of a model in, named results out."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

IntArray = NDArray[np.int32]
FloatArray = NDArray[np.float64]
ByteArray = NDArray[np.int8]
BoolArray = NDArray[np.bool_]


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


class RawDiagnostics(NamedTuple):
    """Problems as the core reports them; at most 100 are kept."""

    counts: IntArray
    """(4,) errors, warnings, notes, kept."""
    number: IntArray
    """(8, 100) severity, line, columns, other line, columns; byte columns."""
    text: ByteArray
    """(240, 4, 100) code, message, label, help, blank padded."""


class RawLook(NamedTuple):
    """How elements are drawn, as a deck says."""

    choice: IntArray
    """(2, ne) cross-section, a `CrossSection`; 1 where drawn."""
    value: FloatArray
    """(9, ne) sizes along local y and z [m], colour, colour of edges, opacity; NaN not given."""


class RawDeck(NamedTuple):
    """What reading a deck gives."""

    arrays: ModelArrays
    name: IntArray
    """(2, ne) first and last place of each element's name, 0 without one."""
    planar: bool
    problems: RawDiagnostics
    look: RawLook | None
    """None where the deck has nothing of it."""


class RawCount(NamedTuple):
    """Sizes that follow from the classes alone."""

    counts: IntArray
    """(2, 4) coordinates and deformations: total, fixed, dependent, independent."""
    rows: int
    columns: int
    entries: int
    """Upper bound of the stored entries of the whole Jacobian."""


class RawAssembly(NamedTuple):
    """Deformations and the whole Jacobian in one configuration."""

    deformation: FloatArray
    """(6, ne) values of the deformation functions, eqs. (2) to (4)."""
    row_of: IntArray
    column_of: IntArray
    value: FloatArray
    """Entries at row = element * 6 + deformation, column = node * 3 + axis."""


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
        part = slice(int(self.start[k]), int(self.start[k + 1]))
        made = np.zeros(self.size)
        made[self.place[part]] = self.value[part]
        return made

    def toarray(self) -> FloatArray:
        """(size, k) all vectors with their zeros."""
        made = np.zeros((self.size, self.vectors))
        made[self.place, self.of_entries()] = self.value
        return made

    def of_entries(self) -> IntArray:
        """(entries,) the vector that each entry belongs to."""
        return np.repeat(np.arange(self.vectors, dtype=np.int32), np.diff(self.start))

    @classmethod
    def of_dense(cls, columns: FloatArray) -> Basis:
        """From the columns of a matrix (size, k)."""
        vector, index = np.nonzero(columns.T)
        start = np.searchsorted(vector, np.arange(columns.shape[1] + 1)).astype(np.int32)
        return cls(columns.shape[0], start, index.astype(np.int32), columns.T[vector, index])


class RawAnalysis(NamedTuple):
    """Results of the decomposition of D(c), m rows, n columns."""

    row_label: IntArray
    """(2, m) one-based element index and deformation."""
    column_label: IntArray
    """(2, n) one-based node index and axis."""
    length: FloatArray
    """(ne,) reference lengths l0 [m]."""
    singular_values: FloatArray
    """(kept,) of D(c) itself, descending; kept = min(m, n), or less: the smallest ones."""
    scaled_values: FloatArray
    """(kept,) of the scaled matrix on which the rank is decided."""
    row_scale: FloatArray
    """(m,) factor of each row of D(c) in the scaled matrix."""
    column_scale: FloatArray
    """(n,) factor of each column."""
    pair_value: FloatArray
    """(p,) smallest non-zero values of the scaled matrix, ascending, p at most 6."""
    pair_motion: FloatArray
    """(n, p) their right singular vectors, of unit norm in the scaled matrix."""
    pair_stress: FloatArray
    """(m, p) their left singular vectors, likewise."""
    tolerance: float
    """Scaled singular values up to here count as zero."""
    characteristic_length: float
    noise: float
    """What computing, and rounding in the last bits, may make of a zero in `scaled_values`."""
    rank: int
    method: str
    """What was used: svd, jacobi, qr or sparse."""
    confirmed: bool
    """Whether the rank follows from a decomposition with error bounds, or from two routes."""
    parts: int
    """Connected parts of D(c), which are decomposed one by one."""
    largest_part: tuple[int, int]
    """Rows and columns of the largest of them."""
    status: int
    """0 fine, 1 not converged, 2 not enough memory, 5 built without SuiteSparse."""
    bytes_needed: float
    """What the decomposition needs of memory, where the core knows."""
    reach_of_digits: float
    """No more than that, in the scaled matrix, can digits explain that were not typed."""
    motions: Basis
    """n - rank vectors, an orthonormal basis of the null space of D(c); see `analysis`.

    Where there are very many, vectors of different parts are orthogonal, but those of one
    part need not be; and where even so their entries would not fit, only the first are there.
    """
    stresses: Basis
    """m - rank vectors: the same for its transpose."""


class RawSensitivities(NamedTuple):
    """What small changes of the geometry make of the singular values of p pairs of vectors."""

    lift_of_bits: FloatArray
    """(p,) what rounding in the last bits can make of each."""
    lift_of_digits: FloatArray
    """(p,) what half a unit of the last digits typed can make of it."""
    by_move: FloatArray
    """(p,) its largest change by the move of one node [1/m]."""
    by_turn: FloatArray
    """(p,) its largest change by the turn of one element [1/rad]."""
    node: IntArray
    """(p,) index of that node, -1 without one."""
    element: IntArray
    """(p,) index of that element, -1 without one."""


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


def room_for(nodes: int, elements: int) -> ModelArrays:
    """Arrays of a model that are still to be filled."""
    return ModelArrays._make(
        np.empty(_shape(name, nodes, elements), dtype, order="F")
        for name, (_, _, dtype) in _LAYOUT.items()
    )


def first_of(arrays: ModelArrays, nodes: int, elements: int) -> ModelArrays:
    """Views of the first nodes and elements."""
    return ModelArrays._make(
        array[..., : _shape(name, nodes, elements)[-1]] for name, array in arrays._asdict().items()
    )


def model_arrays(**given: ArrayLike) -> ModelArrays:
    """Checked and converted arrays of a model.

    Args:
        **given: the nine arrays of `ModelArrays` by name, of any layout.

    Raises:
        ValueError: a shape does not fit, or a whole number does not fit 32 bits.
        TypeError: an array is not numeric.
    """
    nodes, elements = np.size(given["node_number"]), np.size(given["element_number"])
    for name in _LAYOUT:
        shape = _shape(name, nodes, elements)
        if np.shape(given[name]) != shape:
            raise ValueError(f"{name} has shape {np.shape(given[name])}, but must have {shape}")
    return ModelArrays(**{name: _converted(name, given[name]) for name in _LAYOUT})


def _shape(name: str, nodes: int, elements: int) -> tuple[int, ...]:
    leading, last, _ = _LAYOUT[name]
    size = nodes if last == "nn" else elements
    return (size,) if leading is None else (leading, size)


def _converted(name: str, given: ArrayLike) -> NDArray[Any]:
    """A copy in Fortran order and of the core's type, where that loses nothing."""
    array, dtype = np.asarray(given), _LAYOUT[name][2]
    kinds, words = ("iu", "whole") if dtype is np.int32 else ("iuf", "real")
    if array.size and array.dtype.kind not in kinds:
        raise TypeError(f"{name} must hold {words} numbers, not {array.dtype}")
    if dtype is np.int32 and array.size and (array.max() >= 2**31 or array.min() < -(2**31)):
        raise ValueError(f"{name} holds a number that does not fit 32 bits")
    return np.array(array, dtype, order="F")
