"""What crosses the boundary: arrays of a model in, named results out."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

IntArray = NDArray[np.int32]
FloatArray = NDArray[np.float64]
ByteArray = NDArray[np.int8]


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


class RawDeck(NamedTuple):
    """What reading a deck gives."""

    arrays: ModelArrays
    name: IntArray
    """(2, ne) first and last place of each element's name, 0 without one."""
    planar: bool
    problems: RawDiagnostics


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


class RawAnalysis(NamedTuple):
    """Results of the singular value decomposition of D(c), m rows, n columns."""

    row_label: IntArray
    """(2, m) one-based element index and deformation."""
    column_label: IntArray
    """(2, n) one-based node index and axis."""
    length: FloatArray
    """(ne,) reference lengths l0 [m]."""
    singular_values: FloatArray
    """(min(m, n),) of D(c) itself, descending."""
    scaled_values: FloatArray
    """(min(m, n),) of the scaled matrix on which the rank is decided."""
    row_scale: FloatArray
    """(m,) factor of each row of D(c) in the scaled matrix."""
    column_scale: FloatArray
    """(n,) factor of each column."""
    tolerance: float
    """Scaled singular values up to here count as zero."""
    characteristic_length: float
    noise: float
    """What computing, and rounding in the last bits, may make of a zero in `scaled_values`."""
    rank: int
    status: int
    """0 fine, 1 not converged, 2 not enough memory."""
    motions: FloatArray
    """(n, n - rank) orthonormal basis of the null space of D(c)."""
    stresses: FloatArray
    """(m, m - rank) orthonormal basis of the null space of its transpose."""


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
