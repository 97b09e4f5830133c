# SPDX-License-Identifier: BSD-3-Clause
"""D(c) decomposed, and the decision on its rank, under the paper's names; what is asked of both."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..core import calls
from ..core.arrays import Basis, FloatArray, IntArray
from ..core.elements import Dual, NodeKind, dual_table
from ..core.progress import Progress, reported
from ..core.raw import RawAnalysis, RawAssembly
from ..model.data import Labels, ModelData, column_labels, row_labels
from ..model.parts.condensing import Condensed
from ..model.parts.parts import Carriers, Parts
from ..util import machine as memory
from ..util.quantities import Quantity, QuantityError, larger_in_words, measured
from ..util.records import Frozen, cached_property, read_only
from ..util.text import in_short
from ..util.units import METRES, Units
from .limits import LARGEST_ROUNDING, ROUNDING
from .sparse_basis import orthonormal
from .verdict import AnalysisError, ClassCounts, Counts, Gap, Margin, Proof, Verdict, completed

#: A length [m], or a length [m] and an angle [rad]; a text says its unit, such as "20um,1mrad".
AccuracyGiven = Quantity | Iterable[Quantity | None]

_NO_NUMBERS = (bytes, bytearray, memoryview)


class Accuracy(NamedTuple):
    """How far nodes and elements of the machine may lie from where the model has them."""

    length: float
    """Of nodes [m]."""
    angle: float | None = None
    """Of elements [rad]; None where nothing is known of it."""

    def __str__(self) -> str:
        """As the command takes it, such as "2e-05,0.0001"."""
        return ",".join(repr(part) for part in self if part is not None)

    def exceeds(self, margin: Margin) -> tuple[bool, bool]:
        """Whether it is larger than the length, and than the angle, of a margin."""
        length = margin.length is not None and margin.length < self.length
        if margin.angle is None or self.angle is None:
            return length, False
        return length, margin.angle < self.angle

    def require_within(self, size: float, units: Units) -> None:
        """Raise where it is larger than the model: a slip of the unit.

        Args:
            size: Of the model [m].
            units: In which it is said.

        Raises:
            AnalysisError: it is.
        """
        if self.length > size:
            most = f"the whole model, {units.said(size, 'm', 3)}"
            told = f"{units.shown(self.length, 'm'):g} {units.symbol('m')}"
            raise AnalysisError(larger_in_words("the accuracy", told, most, "20um"))

    @classmethod
    def of(cls, given: AccuracyGiven, units: Units = METRES) -> Accuracy:
        """An accuracy as it may be given, a number in the units.

        Raises:
            TypeError: it is neither a number nor two.
            ValueError: one is not positive, or not finite.
        """
        if isinstance(given, Accuracy):
            return given
        parts: list[Any] = [given]
        if isinstance(given, str):
            parts = given.split(",")
        elif isinstance(given, Iterable) and not isinstance(given, _NO_NUMBERS):
            parts = list(given)
            parts = parts[:1] if parts[1:] == [None] else parts
        if not 1 <= len(parts) <= 2:
            raise TypeError(
                "the accuracy is a length [m], or a length and an angle [rad], "
                f"not {len(parts)} numbers"
            )
        sizes = [
            _number(part, "the accuracy", "a number or two", unit)
            for part, unit in zip(parts, (units.symbol("m"), "rad"), strict=False)
        ]
        for size in sizes:
            if not (math.isfinite(size) and size > 0.0):
                raise ValueError(f"the accuracy must be finite and positive, not {size}")
        return cls(*sizes)


def _number(given: Any, what: str, many: str, unit: str = "m") -> float:
    """A number that `what` is to be; `many` says how many may be given."""
    try:
        if isinstance(given, (*_NO_NUMBERS, bool)):
            raise TypeError
        return measured(given, unit)
    except QuantityError as error:
        raise TypeError(f"{what} must be {many}: {error}") from None
    except TypeError:
        raise TypeError(f"{what} must be {many}, not {type(given).__name__}") from None
    except (ValueError, OverflowError):
        raise ValueError(f"{what} must be {many}, not {in_short(given)}") from None


class Asked(NamedTuple):
    """How an analysis was asked to be done."""

    method: str = "auto"
    """One of `flexact.core.calls.METHODS`."""
    tolerance: float | None = None
    """None: it follows from the data and the arithmetic."""
    prove: bool | None = None
    """Whether the rank is to be proven in exact arithmetic; None: where it costs little."""
    accuracy: Accuracy | None = None
    """To what the parts are made and put together; None: nothing is known of it."""
    columns: tuple[float, float] | None = None
    """The least and the most of D(c) that the method is for; else it is "auto". None: any."""


_PLAIN = Asked()


def asked_for(
    method: str,
    tolerance: float | None,
    prove: bool | None = None,
    accuracy: AccuracyGiven | None = None,
    units: Units = METRES,
    columns: tuple[float, float] | None = None,
) -> Asked:
    """What an analysis is asked for, if there is such a thing; numbers are in the units.

    Raises:
        TypeError: the method is no text, the tolerance no number, `prove` no truth value, or
            the accuracy neither a number nor two.
        ValueError: there is no such method, the tolerance is negative or not finite, or the
            accuracy is not positive or not finite.
    """
    if not isinstance(prove, (bool, type(None))):
        raise TypeError(f"prove must be True, False or None, not {type(prove).__name__}")
    if isinstance(tolerance, str):
        raise TypeError("the tolerance must be a number, not str")
    if tolerance is not None:
        tolerance = _number(tolerance, "the tolerance", "a number")
        if not (math.isfinite(tolerance) and tolerance >= 0.0):
            raise ValueError(f"the tolerance must be finite and not negative, not {tolerance}")
    known = None if accuracy is None else Accuracy.of(accuracy, units)
    if not isinstance(method, str):
        raise TypeError(f"a method is given by its name, not by {type(method).__name__}")
    if method not in calls.METHODS:
        choices = ", ".join(calls.METHODS)
        raise ValueError(f"there is no method {method!r}; choose from {choices}")
    return Asked(method, tolerance, prove, known, columns)


#: Nodes or elements, and modes, beyond which bodies and parts are not told one by one.
_MOST_TOLD, _MOST_MODES = 2_000, 400


@dataclass(frozen=True, eq=False, repr=False)
class Decomposition(Frozen):
    """The decomposition of D(c), and the decision on its rank.

    Attributes:
        name: What the deck or model is called.
        condensed: The model at the time of the analysis, and as it was analysed.
        raw: The results as the core gives them.
        asked: The method and the tolerance that were asked for.
    """

    name: str
    condensed: Condensed
    raw: RawAnalysis
    asked: Asked = _PLAIN

    @property
    def data(self) -> ModelData:
        """The model as it was analysed: a divided sheet or wire that is declared is one beam."""
        return self.condensed.data

    @property
    def given(self) -> ModelData:
        """The model as it was given, with the nodes inside its sheets and wires."""
        return self.condensed.given

    @cached_property
    def parts(self) -> Parts:
        """Sheets, wires, bodies, hinges and bars of the model as it was given."""
        return Parts(self.given)

    @cached_property
    def carriers(self) -> Carriers:
        """What moves in the model as given: bodies, joints, and what is inside of parts."""
        return Carriers(self.parts)

    @property
    def is_told_by_parts(self) -> bool:
        """Whether bodies and parts are looked at one by one: in models that are not large."""
        arrays = self.given.arrays
        most = max(arrays.node_number.size, arrays.element_number.size)
        modes = self.under_constrained + self.over_constrained
        return most <= _MOST_TOLD and modes <= _MOST_MODES

    @property
    def rank(self) -> int:
        """Rank of D(c), decided on a scaled matrix so that units do not matter."""
        return self.raw.rank

    @property
    def rows(self) -> int:
        """Rows m of D(c): fixed and independent deformations, eq. (11)."""
        return self.raw.row_scale.size

    @property
    def columns(self) -> int:
        """Columns n of D(c): dependent coordinates, eq. (11)."""
        return self.raw.column_scale.size

    @property
    def under_constrained(self) -> int:
        """Number of kinematically indeterminate motions, n - rank (Table 1)."""
        return self.columns - self.rank

    @property
    def over_constrained(self) -> int:
        """Number of statically indeterminate stresses, m - rank (Table 1)."""
        return self.rows - self.rank

    @property
    def verdict(self) -> Verdict:
        """Table 1 of the paper in words."""
        if self.under_constrained:
            return Verdict.BOTH if self.over_constrained else Verdict.UNDER
        return Verdict.OVER if self.over_constrained else Verdict.EXACT

    @cached_property
    def singular_values(self) -> FloatArray:
        """Singular values of D(c) in the model's units, descending, eq. (16).

        All min(m, n) of them, computed when they are first asked for; after the method sparse
        the smallest, or none where lengths that are far from one hide them in these units. See
        `singular_values_given`.

        Raises:
            AnalysisError: there is no longer the memory for them.
        """
        room = memory.allowance(memory.dense_needed(self.rows, self.columns))

        def work() -> RawAnalysis:
            return calls.analyse_model(
                self.data.packed, self.method, memory=room, only_plain_values=True
            )

        forgiven = ("convergence",) if self.method == "sparse" else ()
        return read_only(completed(self.data, work, forgiven).scaled_values)

    @property
    def scaled_singular_values(self) -> FloatArray:
        """Likewise those of the scaled D(c), on which the rank is decided."""
        return self.raw.scaled_values

    @property
    def singular_values_given(self) -> str:
        """Which singular values there are: "all" or the "smallest"."""
        given = min(self.singular_values.size, self.scaled_singular_values.size)
        return "all" if given == min(self.rows, self.columns) else "smallest"

    @property
    def method(self) -> str:
        """How D(c) was decomposed: svd, jacobi or sparse."""
        return self.raw.method

    @property
    def proof(self) -> Proof | None:
        """The rank in exact arithmetic; None where it was not computed."""
        raw = self.raw
        if raw.proven_rank < 0:
            return None
        of = "decimals" if raw.as_typed else "doubles"
        return Proof(of, raw.proven_rank, raw.primes, raw.failure)

    @property
    def components(self) -> int:
        """Number of connected components of D(c), which are decomposed one by one."""
        return self.raw.components

    @property
    def tolerance(self) -> float:
        """Scaled singular values up to this one count as zero."""
        return self.raw.tolerance

    @property
    def bound(self) -> float:
        """Below this no more scaled singular values lie than the method sparse has pinned.

        Its factorisation shows it, rounding included (theory.md (31)); by the other methods it
        is the noise.
        """
        return self.raw.bound

    @property
    def accuracy(self) -> Accuracy | None:
        """To what the parts are made and put together, as it was given; None without."""
        return self.asked.accuracy

    @property
    def characteristic_length(self) -> float:
        """The length [m] by which rotations and moments compare with the rest.

        One where the mechanism has no extent.
        """
        return self.raw.characteristic_length

    @cached_property
    def gap(self) -> Gap:
        """Smallest non-zero and largest zero of the scaled singular values."""
        values, pairs = self.scaled_singular_values, self.raw.pair_value
        left_out = min(self.rows, self.columns) - values.size
        rank = max(self.rank - left_out, 0)
        # Where only zeros are given, the core may know the value above them all the same.
        above = values[rank - 1] if rank > 0 else next(iter(pairs), None) if self.rank else None
        return Gap(
            None if above is None else float(above),
            float(values[rank]) if rank < values.size else None,
        )

    @cached_property
    def rounding(self) -> float:
        """What part of a motion or a self-stress may be rounding, theory.md (42).

        A null vector is off by the noise over the gap, at most.
        """
        above = self.gap.smallest_nonzero
        if not above:
            return ROUNDING
        return max(ROUNDING, min(LARGEST_ROUNDING, 10.0 * self.raw.noise / above))

    @cached_property
    def condition_number(self) -> float | None:
        """Largest over smallest singular value of D(c), in the model's units.

        None where D(c) is rank-deficient or empty, the quotient is not finite, the largest is
        not given, or the smallest is below rounding.
        """
        values, small = self.singular_values, self.gap.smallest_nonzero
        if small is not None and small <= self.raw.noise:
            return None
        full = self.rank == min(self.rows, self.columns) == values.size > 0
        if not full or not values[-1] > 0.0:
            return None
        quotient = float(values[0]) / float(values[-1])
        return quotient if math.isfinite(quotient) else None

    @cached_property
    def counts(self) -> Counts:
        """Coordinates and deformations by class, eqs. (13) to (15), of the model as given.

        D(c) has fewer rows and columns where what is inside of divided sheets is declared.
        """
        coordinates, deformations = self.given.count.counts.tolist()
        return Counts(ClassCounts(*coordinates), ClassCounts(*deformations))

    @property
    def degrees_of_freedom(self) -> int:
        """Number of independent coordinates and deformations, eq. (6), of the model as given."""
        return self.counts.coordinates.independent + self.counts.deformations.independent

    @cached_property
    def row_labels(self) -> tuple[tuple[int, int], ...]:
        """Element number and deformation (from 1) of each row of D(c)."""
        return row_labels(self.data.arrays, self.raw.row_label - 1)

    @cached_property
    def column_labels(self) -> Labels:
        """Node number and coordinate name of each column of D(c)."""
        return column_labels(self.data.arrays, self.raw.column_label - 1)

    @cached_property
    def motion_space(self) -> Basis:
        """Orthonormal basis of the motions, rotations in lengths."""
        return orthonormal(self.raw.motions, column_weights(self))

    @cached_property
    def stress_space(self) -> Basis:
        """Orthonormal basis of the self-stresses, moments in forces."""
        return orthonormal(self.raw.stresses, row_weights(self))

    @cached_property
    def assembly(self) -> RawAssembly:
        """The whole Jacobian in the reference configuration, as the core numbers it."""
        arrays = self.data.arrays
        return calls.assemble(
            self.data.packed, arrays.node_value, np.zeros(arrays.element_number.size)
        )


#: Rows or columns of D(c): all of them, or those of an array.
Places = IntArray | slice
_ALL = slice(None)


def column_weights(analysis: Decomposition, columns: Places = _ALL) -> FloatArray:
    """(columns,) 1 for a displacement, the characteristic length for a rotation."""
    kinds = analysis.data.arrays.node_kind[analysis.raw.column_label[0, columns] - 1]
    return np.where(kinds <= NodeKind.POSITION, 1.0, analysis.characteristic_length)


def row_duals(analysis: Decomposition, rows: Places = _ALL) -> IntArray:
    """(rows,) `Dual` of rows of D(c)."""
    element, deformation = analysis.raw.row_label[:, rows] - 1
    return np.asarray(dual_table()[analysis.data.arrays.element_kind[element], deformation])


def row_factors(analysis: Decomposition, rows: Places = _ALL) -> FloatArray:
    """(rows,) what makes a force or a moment of a stress resultant: 1, or l0 [m]."""
    over_length = row_duals(analysis, rows) == Dual.MOMENT_OVER_LENGTH
    return np.where(
        over_length, analysis.data.frames.length[analysis.raw.row_label[0, rows] - 1], 1.0
    )


def row_weights(analysis: Decomposition, rows: Places = _ALL) -> FloatArray:
    """(rows,) what makes a stress resultant comparable with a force.

    A moment is divided by the characteristic length.
    """
    moment = row_duals(analysis, rows) != Dual.FORCE
    return row_factors(analysis, rows) / np.where(moment, analysis.characteristic_length, 1.0)


def decompose(data: ModelData, asked: Asked, progress: Progress | None = None) -> RawAnalysis:
    """Decompose D(c) of a model.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        AnalysisError: it is too large for the memory, or there was no convergence.
    """
    data.require_sound()
    # Below a bound of what it may need, nobody has to look how much there is.
    room = memory.allowance(memory.dense_needed(data.count.rows, data.count.columns))
    least, most = asked.columns or (0.0, math.inf)
    method = asked.method if least <= data.count.columns <= most else "auto"

    def work(stage: IntArray | None) -> RawAnalysis:
        return calls.analyse_model(
            *(data.packed, method, asked.tolerance, stage, room),
            prove=asked.prove,
            as_stored=data.has_long_numbers,
        )

    return completed(data, lambda: work(None) if progress is None else reported(work, progress))
