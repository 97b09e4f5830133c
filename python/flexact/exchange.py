"""What crosses the boundary: arrays of a model in, named results out."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

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
    origin: IntArray
    """(ne,) one-based place of each element's statement in the text."""
    name: IntArray
    """(2, ne) first and last place of each element's name, 0 without one."""
    planar: bool
    unused: int
    """Statements about dynamics and pictures that were read and not used."""
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
    column_scale: FloatArray
    tolerance: float
    """Scaled singular values up to here count as zero."""
    characteristic_length: float
    rank: int
    status: int
    """0 fine, 1 not converged, 2 not enough memory."""
    motions: FloatArray
    """(n, n - rank) orthonormal basis of the null space of D(c)."""
    stresses: FloatArray
    """(m, m - rank) orthonormal basis of the null space of its transpose."""


_SHAPES = {
    "node_number": ("nn",),
    "node_kind": ("nn",),
    "node_value": (4, "nn"),
    "coordinate_class": (3, "nn"),
    "element_number": ("ne",),
    "element_kind": ("ne",),
    "element_node": (4, "ne"),
    "element_vector": (3, "ne"),
    "deformation_class": (6, "ne"),
}


def model_arrays(**given: ArrayLike) -> ModelArrays:
    """Checked, converted and frozen arrays of a model.

    Args:
        **given: the nine arrays of `ModelArrays` by name, of any layout.

    Raises:
        ValueError: a shape does not fit, or a whole number does not fit 32 bits.
        TypeError: an array is not numeric.
    """
    sizes = {
        "nn": int(np.size(given["node_number"])),
        "ne": int(np.size(given["element_number"])),
    }
    for name, pattern in _SHAPES.items():
        shape = tuple(sizes[part] if isinstance(part, str) else part for part in pattern)
        if np.shape(given[name]) != shape:
            raise ValueError(f"{name} has shape {np.shape(given[name])}, but must have {shape}")
    return ModelArrays(
        _whole("node_number", given),
        _whole("node_kind", given),
        _real("node_value", given),
        _whole("coordinate_class", given),
        _whole("element_number", given),
        _whole("element_kind", given),
        _whole("element_node", given),
        _real("element_vector", given),
        _whole("deformation_class", given),
    )


def _whole(name: str, given: Mapping[str, ArrayLike]) -> IntArray:
    array = np.asarray(given[name])
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{name} must hold whole numbers, not {array.dtype}")
    if array.size and (array.max() > 2**31 - 1 or array.min() < -(2**31)):
        raise ValueError(f"{name} holds a number that does not fit 32 bits")
    made: IntArray = np.array(array, np.int32, order="F")
    made.flags.writeable = False
    return made


def _real(name: str, given: Mapping[str, ArrayLike]) -> FloatArray:
    array = np.asarray(given[name])
    if array.size and array.dtype.kind not in "iuf":
        raise TypeError(f"{name} must hold real numbers, not {array.dtype}")
    made: FloatArray = np.array(array, np.float64, order="F")
    made.flags.writeable = False
    return made
