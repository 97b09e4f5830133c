# SPDX-License-Identifier: BSD-3-Clause
"""Configurations of a path, and how it is between two of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from ..util.records import Frozen
from .chart import Chart, Near
from .constraints import Held

#: How many of the smallest singular values are kept.
_KEPT = 6


@dataclass(frozen=True, eq=False)
class Station(Frozen):
    """A configuration of a path.

    Attributes:
        configuration: In metres, where the model stands.
        within: The same as `Held` has it, in its unit.
        arc: How far it is along the path, in sizes: of the node that moves farthest,
            displacements by the size, rotations in radians.
        residual: The largest held deformation, lengths by the size, angles in radians.
        tangent: (n,) along the path, displacements by the size, rotations in radians; norm 1.
        values: The smallest singular values of the scaled matrix, theory.md (2), ascending,
            at most six.
        rank: How many of all of them are not zero.
        signed: The smallest of these, with a sign that changes where it passes zero.
    """

    configuration: Configuration
    within: Configuration
    arc: float
    residual: float
    tangent: FloatArray
    values: FloatArray
    rank: int
    signed: float

    @property
    def directions(self) -> int:
        """In how many independent directions it goes on from here, to first order."""
        return self.tangent.size - self.rank


def station_at(
    held: Held,
    where: Configuration,
    rank: int,
    tangent: FloatArray,
    arc: float,
    residual: float,
    sign: float,
    values: FloatArray,
) -> Station:
    """A station of a given rank and sign, with all singular values, descending."""
    smallest = sign * float(values[rank - 1]) if rank else 0.0
    kept = values[::-1][:_KEPT].copy()
    return Station(held.outside(where), where, arc, residual, tangent, kept, rank, smallest)


class Between:
    """The path between two stations, by the share of the way."""

    def __init__(self, held: Held, one: Station, other: Station) -> None:
        """Use the chart of the end with the higher rank: there the path is regular."""
        self.held, self.one, self.other = held, one, other
        self.is_backward = one.rank < other.rank
        self.base, self.far = (other, one) if self.is_backward else (one, other)
        self.chart = Chart(held, self.base.within, self.base.rank)
        along = self.base.tangent
        way = float(along @ held.difference(self.base.within, self.far.within))
        self._ahead = way * along

    def near(self, share: float) -> Near | None:
        """The place at a share of the way, also a little outside of it."""
        return self.chart.near(self._ahead * (1.0 - share if self.is_backward else share))

    def direction(self, near: Near) -> FloatArray:
        """(n,) the tangent at a place, of norm 1."""
        jacobian = self.held.at(near.place.configuration).jacobian
        right = np.linalg.svd(jacobian)[2]
        null = right[self.base.rank :].T
        along = null @ (null.T @ self.base.tangent)
        return np.asarray(along / np.linalg.norm(along))

    def change_to(self, share: float, near: Near) -> FloatArray:
        """(n,) the change of the coordinates that leads to a place, from the chart's middle."""
        return self._ahead * (1.0 - share if self.is_backward else share) + near.across


def arc_between(held: Held, here: Station, where: Configuration, along: FloatArray) -> float:
    """How far the node goes that moves farthest: on arcs of circles over the chords."""
    chord = np.linalg.norm(held.at_nodes(held.difference(here.within, where)), axis=1)
    before, behind = held.at_nodes(here.tangent), held.at_nodes(along)
    sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(behind, axis=1)
    cosine = np.sum(before * behind, axis=1) / np.where(sizes > 0.0, sizes, 1.0)
    half = 0.5 * np.arccos(np.clip(np.where(sizes > 0.0, cosine, 1.0), 0.0, 1.0))
    return float(np.max(chord / np.sinc(half / np.pi)))
