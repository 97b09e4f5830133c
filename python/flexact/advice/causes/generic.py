# SPDX-License-Identifier: BSD-3-Clause
"""The generic rank: the largest rank of D(c) over geometries of the same topology.

Almost every geometry has it, so that nodes and axes at random places show it; a trial can only
be too low, by bad luck.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...analysis.decomposition import Asked
from ...analysis.result import Result
from ...analysis.spaces import decompose
from ...core.arrays import FloatArray
from ...core.elements import NodeKind, Vector, element_kinds, length_table
from ...model.data import ModelData
from ...model.parts.bodies import groups_of
from ...util.cached import cached_property
from ...util.errors import FlexactError
from ...util.records import Frozen

#: How far nodes are moved beside the members that meet there, and vectors beside their length.
_MOVED, _TURNED = 0.4, 0.7
#: Of larger models one geometry is tried.
_MOST_FOR_MORE = 2_000
_SEED = 20_111_105


class Geometry(Frozen):
    """A model whose node places and element vectors can be changed, all of them explicit.

    Attributes:
        data: The model.
        vectors: (elements, 3) y vector or axis of each element, of unit length; that of the
            frame where none is given; zero where a kind has none.
        owner: (nodes,) the first of the nodes that are, and stay, at one place: those of an
            element that has no length.
        free: (nodes, 3) which coordinates there are: of position nodes, in the plane x and y.
    """

    def __init__(self, data: ModelData) -> None:
        """Read the places and vectors of a sound model."""
        self.data = data
        arrays, frames = data.arrays, data.frames
        kinds = np.array([0, *(kind.vector for kind in element_kinds())])[arrays.element_kind]
        given = arrays.element_vector.T
        size = np.linalg.norm(given, axis=1, keepdims=True)
        own = np.where(size > 0.0, given / np.where(size > 0.0, size, 1.0), frames.frame[:, :, 1])
        self.vectors: FloatArray = np.where(np.not_equal(kinds, Vector.NONE)[:, None], own, 0.0)
        self.free = np.zeros((arrays.node_kind.size, 3), bool)
        self.free[arrays.node_kind == NodeKind.POSITION] = True
        self.free[arrays.node_kind == NodeKind.PLANAR_POSITION, :2] = True
        p, q = arrays.element_node[[0, 2]] - 1
        short = (p >= 0) & (q >= 0) & (length_table()[arrays.element_kind] == 0)
        apart = np.linalg.norm(arrays.node_value[:3, q] - arrays.node_value[:3, p], axis=0)
        short &= apart <= 1.0e-9 * max(float(frames.length.max(initial=0.0)), 1.0e-300)
        self.owner = groups_of(arrays.node_kind.size, zip(p[short], q[short], strict=True))

    @cached_property
    def places(self) -> FloatArray:
        """(nodes, 3) [m]; zero of orientations."""
        made: FloatArray = np.where(self.free, self.data.arrays.node_value[:3].T, 0.0)
        return made

    @cached_property
    def sizes(self) -> FloatArray:
        """(nodes,) the geometric mean of the lengths that meet at each node [m]."""
        arrays, length = self.data.arrays, self.data.frames.length
        nodes = arrays.element_node[[0, 2]] - 1
        used = (nodes >= 0) & (length > 0.0)
        logs = np.broadcast_to(np.log(np.where(length > 0.0, length, 1.0)), nodes.shape)[used]
        total = np.bincount(nodes[used], logs, arrays.node_kind.size)
        count = np.bincount(nodes[used], minlength=arrays.node_kind.size)
        mean = float(logs.mean()) if logs.size else 0.0
        made: FloatArray = np.exp(np.where(count > 0, total / np.maximum(count, 1), mean))
        return made

    def moved(self, places: FloatArray, vectors: FloatArray) -> ModelData:
        """The model with its nodes and vectors elsewhere, (nodes, 3) and (elements, 3)."""
        arrays = self.data.arrays
        value = arrays.node_value.copy(order="F")
        value[:3] = np.where(self.free, places[self.owner], value[:3].T).T
        made = arrays._replace(
            node_value=value, element_vector=np.asfortranarray(np.array(vectors).T)
        )
        return replace(self.data, arrays=made, source=None, found=None)

    def random(self, trial: int) -> tuple[FloatArray, FloatArray]:
        """Places and vectors of a trial: first near those that are, then anywhere."""
        rng = np.random.default_rng((_SEED, trial))
        count = self.places.shape[0]
        vectors = self.vectors + _TURNED * rng.uniform(-1.0, 1.0, self.vectors.shape)
        vectors[~np.any(self.vectors, axis=1)] = 0.0
        if trial % 2 == 0:
            step = _MOVED * self.sizes[:, None] * rng.uniform(-1.0, 1.0, (count, 3))
            return self.places + step, vectors
        extent = float(np.exp(np.log(self.sizes).mean())) if count else 1.0
        return extent * count ** (1.0 / 3.0) * rng.uniform(-1.0, 1.0, (count, 3)), vectors


def rank_at(geometry: Geometry, places: FloatArray, vectors: FloatArray) -> int | None:
    """The rank of D(c) at a geometry; None where it cannot be analysed."""
    try:
        raw = decompose(geometry.moved(places, vectors), Asked("auto", None, False))
    except (FlexactError, MemoryError):
        return None
    return raw.rank


def generic_rank(result: Result) -> tuple[int | None, int]:
    """The largest rank that was found, and how many geometries were tried.

    None where none of them could be analysed.
    """
    full = min(result.rows, result.columns)
    if result.rank == full:
        return full, 0
    geometry = Geometry(result.data)
    arrays = result.data.arrays
    large = max(arrays.node_number.size, arrays.element_number.size) > _MOST_FOR_MORE
    best: int | None = None
    trials = 1 if large else 3
    for trial in range(trials):
        found = rank_at(geometry, *geometry.random(trial))
        if found is not None:
            best = max(found, result.rank, best or 0)
        if best == full:
            return best, trial + 1
    return best, trials
