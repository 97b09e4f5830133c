# SPDX-License-Identifier: BSD-3-Clause
"""Random misalignments of the points of a model."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..analysis.locate import position_of
from ..core.arrays import FloatArray, IntArray, floats
from ..core.elements import NodeKind
from ..model.data import ModelData
from ..model.model import Model
from ..model.parts.parts import Parts
from ..model.variation import axes_used
from ..util.plain_text import in_short
from ..util.quantities import Quantity, without_units

#: A length [m] for all points; lengths by points: names, numbers of nodes, or handles; or an
#: array of them, (nodes,) or (nodes, 3).
Spread = Quantity | Mapping[Any, ArrayLike] | ArrayLike


def misaligned(model: Model, sd: FloatArray, samples: int, seed: int) -> FloatArray:
    """(samples, nodes, 3) positions with independent normal errors of each coordinate.

    Nodes at one place are one point, and move together. Nodes inside divided sheets and wires
    are none: they move with the ends, in proportion to where they are between them.

    Args:
        model: A sound model.
        sd: (nodes, 3) standard deviations [m].
        samples: How many.
        seed: The same seed gives the same positions.
    """
    data = model.data
    positions = model.positions
    point = points_of(data)
    errors = np.random.default_rng(seed).standard_normal((samples, *positions.shape))
    moved = errors[:, point] * sd
    for nodes, shares in _inner(data, positions):
        ends = moved[:, [nodes[0], nodes[-1]]]
        moved[:, nodes[1:-1]] = (
            ends[:, :1] * (1.0 - shares)[None, :, None] + ends[:, 1:] * shares[None, :, None]
        )
    moved *= axes_used(data)
    made: FloatArray = positions + moved
    return made


def points_of(data: ModelData) -> IntArray:
    """(nodes,) the first node that stands at the same place; of orientations themselves."""
    arrays = data.arrays
    first: dict[tuple[float, ...], int] = {}
    made = np.arange(arrays.node_kind.size)
    for node in np.flatnonzero(arrays.node_kind <= NodeKind.POSITION).tolist():
        place = tuple((arrays.node_value[:3, node] + 0.0).tolist())
        made[node] = first.setdefault(place, node)
    return made.astype(np.int32)


def inner_nodes(data: ModelData) -> set[int]:
    """Nodes inside divided sheets and wires."""
    return {node for chain in data.chains for node in chain.positions[1:-1]}


def _inner(data: ModelData, positions: FloatArray) -> list[tuple[list[int], FloatArray]]:
    """Of each divided sheet or wire its nodes, and the share of its length up to each inner one."""
    made = []
    for chain in data.chains:
        nodes = list(chain.positions)
        steps = [float(np.linalg.norm(positions[b] - positions[a])) for a, b in pairwise(nodes)]
        shares = np.cumsum(steps)[:-1] / sum(steps)
        made.append((nodes, shares))
    return made


def spread_given(model: Model, sd: Any) -> FloatArray:
    """(nodes, 3) standard deviations [m], as they were given.

    Raises:
        ModelError: there is no point of some name or number.
        TypeError: they are no numbers.
        ValueError: one is negative or not finite, or the shape is another.
    """
    nodes = model.node_numbers.size
    made = np.zeros((nodes, 3))
    if isinstance(sd, Mapping):
        point = points_of(model.data)
        for name, value in sd.items():
            made[point == point[_node(model, name)]] = _one(value)
    else:
        given = floats(without_units(sd, "m"), "the standard deviation")
        if given.shape not in ((), (nodes,), (nodes, 3)):
            raise ValueError(
                f"the standard deviation is one length, or has the shape ({nodes} nodes,) or "
                f"({nodes} nodes, 3), not {given.shape}"
            )
        made[:] = given[:, None] if given.ndim == 1 else given
        # Of nodes at one place the first says how far they move.
        made = made[points_of(model.data)]
    if not (np.isfinite(made).all() and (made >= 0.0).all()):
        raise ValueError("standard deviations must be finite and not negative")
    return made


def _one(value: Any) -> FloatArray:
    given = floats(without_units(value, "m"), "the standard deviation of a point")
    if given.shape not in ((), (3,)):
        raise ValueError(
            f"the standard deviation of a point is a length, or one of each of x, y and z, "
            f"not {in_short(value)}"
        )
    return given


def _node(model: Model, name: Any) -> int:
    return position_of(Parts(model.data), name)
