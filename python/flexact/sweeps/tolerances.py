# SPDX-License-Identifier: BSD-3-Clause
"""What random misalignments of its points make of a mechanism."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..analysis.locate import position_of
from ..analysis.naming import length_in_words
from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray, IntArray, floats
from ..core.elements import NodeKind
from ..core.progress import Progress
from ..model.data import ModelData
from ..model.model import Model
from ..model.parts.parts import Parts
from ..model.variation import axes_used
from ..util.errors import require_kind
from ..util.quantities import Quantity, without_units
from ..util.records import Frozen
from ..util.text import in_short
from ..util.units import Units
from .plots import finished, histograms, smallest_values
from .sweep import sweep
from .table import Table, per_cent, share_in_words
from .table import in_short as table_in_short

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
    moved = np.random.default_rng(seed).standard_normal((samples, *positions.shape))[:, point] * sd
    for nodes, shares in _inner(data, positions):
        ends = moved[:, [nodes[0], nodes[-1]]]
        moved[:, nodes[1:-1]] = (
            ends[:, :1] * (1.0 - shares)[None, :, None] + ends[:, 1:] * shares[None, :, None]
        )
    moved *= axes_used(data)
    return np.asarray(positions + moved)


def points_of(data: ModelData) -> IntArray:
    """(nodes,) the first node that stands at the same place; of orientations themselves."""
    arrays = data.arrays
    first: dict[tuple[float, ...], int] = {}
    made = np.arange(arrays.node_kind.size)
    for node in np.flatnonzero(arrays.node_kind <= NodeKind.POSITION).tolist():
        made[node] = first.setdefault(tuple((arrays.node_value[:3, node] + 0.0).tolist()), node)
    return made.astype(np.int32)


def _inner(data: ModelData, positions: FloatArray) -> list[tuple[list[int], FloatArray]]:
    """Of each divided sheet or wire its nodes, and the share of its length up to each inner one."""
    made = []
    for chain in data.chains:
        nodes = list(chain.positions)
        steps = [float(np.linalg.norm(positions[b] - positions[a])) for a, b in pairwise(nodes)]
        made.append((nodes, np.cumsum(steps)[:-1] / sum(steps)))
    return made


def spread_given(model: Model, sd: Any) -> FloatArray:
    """(nodes, 3) standard deviations [m], as they were given.

    Raises:
        ModelError: there is no point of some name or number.
        TypeError: they are no numbers.
        ValueError: one is negative or not finite, or the shape is another.
    """
    nodes = model.node_numbers.size
    made, unit = np.zeros((nodes, 3)), model.data.units.symbol("m")
    if isinstance(sd, Mapping):
        point = points_of(model.data)
        for name, value in sd.items():
            given = floats(without_units(value, unit), "the standard deviation of a point")
            if given.shape not in ((), (3,)):
                raise ValueError(
                    "the standard deviation of a point is a length, or one of each of x, y and z, "
                    f"not {in_short(value)}"
                )
            made[point == point[position_of(Parts(model.data), name)]] = given
    else:
        given = floats(without_units(sd, unit), "the standard deviation")
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


#: Of a normal distribution: 95 % lie within so many standard deviations.
_Z = 1.959963984540054
#: What describe() tells of what is spread.
_QUANTILES = (0.01, 0.05, 0.5, 0.95)


class Share(NamedTuple):
    """A part of the samples, with what it may be of all machines: 95 % confidence, by Wilson.

    E.B. Wilson, Probable inference, the law of succession, and statistical inference, Journal of
    the American Statistical Association 22 (1927) 209-212.
    """

    number: int
    of: int
    value: float
    low: float
    high: float

    @classmethod
    def counted(cls, count: int, of: int) -> Share:
        """The share of so many; anything is possible without samples."""
        if not of:
            return cls(0, 0, math.nan, 0.0, 1.0)
        p, z = count / of, _Z * _Z / of
        middle = (p + z / 2) / (1 + z)
        half = math.sqrt(p * (1 - p) * z + z * z / 4) / (1 + z)
        low = 0.0 if count == 0 else max(0.0, middle - half)
        return cls(count, of, p, low, 1.0 if count == of else min(1.0, middle + half))

    def __str__(self) -> str:
        """In words."""
        between = f"{per_cent(self.low)} to {per_cent(self.high)} %"
        return f"{share_in_words(self.number, self.of)} of the samples, 95 % confidence {between}"


@dataclass(frozen=True, eq=False, repr=False)
class Tolerances(Frozen):
    """A mechanism with misaligned points, many times; see `flexact.tolerances`.

    Attributes:
        table: The samples, a row each.
        nominal: The same columns of the mechanism as it is, one row.
        sd: (nodes, 3) the standard deviations [m].
        seed: From which the samples are made again.
        below: The margin [m] that was asked about, if any.
    """

    table: Table
    nominal: Table
    sd: FloatArray
    seed: int
    below: float | None

    def quantiles(self, of: str = "margin", at: Iterable[float] = _QUANTILES) -> FloatArray:
        """The values of a column that these parts of the samples do not exceed.

        Args:
            of: A column of numbers, or "smallest", the smallest singular value of the scaled
                D(c), zero or not.
            at: Parts, from 0 to 1. Each answer is one of the samples, so that an infinite margin
                is no harm; NaN without samples.

        Raises:
            KeyError: there is no such column.
            ValueError: a part is not from 0 to 1.
        """
        values = self._values(of)
        parts = np.array(list(at), np.float64)
        if not values.size:
            return np.full(parts.shape, np.nan)
        return np.asarray(np.quantile(values, parts, method="inverted_cdf"))

    def share_below(self, margin: float) -> Share:
        """How many samples have a smaller margin [m]; samples with an error are left out."""
        return Share.counted(int((self._values("margin") < margin).sum()), self._sound)

    @property
    def shares(self) -> dict[Verdict, Share]:
        """How many samples have each verdict; samples with an error are left out."""
        every = {each: int((self.table.verdict == each.value).sum()) for each in Verdict}
        return {each: Share.counted(count, self._sound) for each, count in every.items()}

    @property
    def _sound(self) -> int:
        return len(self.table) - int(self.table.has_error.sum())

    def _values(self, of: str) -> FloatArray:
        every: FloatArray = smallest_values(self.table) if of == "smallest" else self.table[of]
        return every[~(self.table.has_error | np.isnan(every))]

    def describe(self) -> str:
        """What misalignment makes of the mechanism, in plain English."""
        row = self.nominal[0]
        lines = [
            f"{len(self.table)} samples, each coordinate of each point off by {_spread(self.sd)} "
            f"(standard deviation, normal); seed {self.seed}.",
            f"As designed: {row['verdict'] or row['error']}, margin {_length(row['margin'])}.",
        ]
        for verdict, share in self.shares.items():
            if share.number:
                lines.append(f"{verdict.value.capitalize()}: {share}.")
        if doubtful := int(self.table.is_doubtful.sum()):
            lines.append(f"Doubtful, of these: {share_in_words(doubtful, len(self.table))}.")
        if wrong := int(self.table.has_error.sum()):
            first = next(iter(self.table.error[self.table.has_error]))
            lines.append(f"With an error: {share_in_words(wrong, len(self.table))}, first: {first}")
        head = ", ".join(f"{100 * part:g} %" for part in _QUANTILES)
        lengths = ", ".join(map(_length, self.quantiles("margin").tolist()))
        values = ", ".join(f"{each:.3g}" for each in self.quantiles("smallest").tolist())
        lines.append(f"Margin that {head} do not exceed: {lengths}.")
        lines.append(f"Smallest singular value (scaled), likewise: {values}.")
        if self.below is not None:
            below = length_in_words(self.below)
            lines.append(f"Margin below {below}: {self.share_below(self.below)}.")
        return "\n".join(lines)

    def plot(self, *, path: str | os.PathLike[str] | None = None) -> Figure:
        """Histograms of the smallest singular value and of the margin, verdicts in colour.

        Args:
            path: A file to write, too: .png, .svg or .pdf.

        Raises:
            FlexactError: matplotlib is missing, or the file cannot be written.
        """
        figure = histograms(self.table, self.nominal, self.below)
        return finished(figure, path, table_in_short(self.table), self.table.describe())

    def __repr__(self) -> str:
        """How many samples, and the verdicts."""
        told = ", ".join(f"{s.number} {v.value}" for v, s in self.shares.items() if s.number)
        return f"<Tolerances: {len(self.table)} samples: {told}>"


def _length(length: float) -> str:
    if length == 0.0:
        return "none, in exact alignment only"
    return length_in_words(length) if math.isfinite(length) else "without limit"


def _spread(sd: FloatArray) -> str:
    moving = sd[sd > 0.0]
    if not moving.size:
        return "nothing"
    low, high = float(moving.min()), float(moving.max())
    told = length_in_words(high)
    return told if low == high else f"{length_in_words(low)} to {told}, where any"


def tolerances(
    model: Model,
    *,
    sd: Spread,
    samples: int = 1000,
    seed: int = 0,
    below: Quantity | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Tolerances:
    """Misalign all points of a mechanism at random, many times, and see what becomes of it.

    Each coordinate of each point, of the ground, too, is off by a normally distributed length,
    independent of all others. Position nodes at one place are one point. Nodes inside divided
    sheets and wires are none: they follow the ends. Nothing but points moves: directions, such as
    the width of a sheet, stay, and points of one rigid body are misaligned one by one.

    Args:
        model: The mechanism as designed.
        sd: The standard deviation of each coordinate [m], or a text such as "20um": one length for
            all points, or a mapping of points (names, numbers of position nodes, handles) to a
            length or to three, for x, y and z, where other points stay; or an array, (nodes,) or
            (nodes, 3).
        samples: How many times.
        seed: The same seed makes the same samples.
        below: A margin [m], or a text such as "50um"; `describe` says how many samples
            have a smaller one.
        workers: So many threads at most.
        progress: As for `sweep`.

    Raises:
        DeckError, ModelError: the model is wrong, or there is no such point.
        TypeError: something is of another kind than it must be.
        ValueError: the standard deviation is negative or not finite or of another shape, there
            are no samples, or the margin is not positive.
    """
    require_kind(model, Model, "tolerances are those of a Model")
    model.check()
    spread = spread_given(model, sd)
    _require_whole("samples", samples, 1)
    _require_whole("the seed", seed, 0)
    limit = None if below is None else _limit(below, model.data.units)
    positions = model.data.units.shown(misaligned(model, spread, int(samples), int(seed)), "m")
    table = sweep(model, positions=positions, workers=workers, progress=progress)
    nominal = sweep(model, positions=model.positions[None], workers=1)
    return Tolerances(table, nominal, spread, int(seed), limit)


def _require_whole(what: str, value: Any, least: int) -> None:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{what} must be a whole number, not {type(value).__name__}")
    if value < least:
        raise ValueError(f"{what} must be {least} or more, not {value}")


def _limit(below: Any, units: Units) -> float:
    below = without_units(below, units.symbol("m"))
    if isinstance(below, bool) or not isinstance(below, (int, float, np.number)):
        raise TypeError(f"the margin must be a length [m], not {type(below).__name__}")
    if not (math.isfinite(below) and below > 0.0):
        raise ValueError(f"the margin must be finite and positive, not {below}")
    return float(below)
