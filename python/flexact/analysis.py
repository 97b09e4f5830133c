"""The analysis of a model: is it exactly, under- or over-constrained, and how."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _boundary, memory
from .configuration import Labels, column_labels, jacobian, row_labels
from .diagnostics import Diagnostic, FlexactError, Severity
from .exchange import FloatArray, RawAnalysis
from .frozen import Frozen
from .model import Model
from .model_data import ModelData
from .modes import Motion, SelfStress
from .reading import read
from .verdict import ClassCounts, Counts, Gap, Verdict

if TYPE_CHECKING:
    import meshio

#: A smallest non-zero singular value below this part of the largest is worth a warning.
_NEARLY_ZERO = 1.0e-5


class AnalysisError(FlexactError):
    """A sound model that could not be analysed: too large, or no convergence."""


@dataclass(frozen=True, eq=False, repr=False)
class Analysis(Frozen):
    """The result of an analysis, in the reference configuration.

    Attributes:
        name: What the deck or model is called.
        data: The model at the time of the analysis.
        raw: The results as the core gives them.
    """

    name: str
    data: ModelData
    raw: RawAnalysis

    @property
    def model(self) -> Model:
        """The model as it was when it was analysed: a new one each time, free to be changed."""
        return Model.from_data(self.data)

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

    @property
    def singular_values(self) -> FloatArray:
        """(min(m, n),) singular values of D(c) in the model's units, descending, eq. (16)."""
        return self.raw.singular_values

    @property
    def scaled_singular_values(self) -> FloatArray:
        """(min(m, n),) singular values of the scaled D(c), on which the rank is decided."""
        return self.raw.scaled_values

    @property
    def tolerance(self) -> float:
        """Scaled singular values up to this one count as zero."""
        return self.raw.tolerance

    @property
    def characteristic_length(self) -> float:
        """The length [m] by which rotations and moments compare with the rest.

        One where the mechanism has no extent.
        """
        return self.raw.characteristic_length

    @cached_property
    def gap(self) -> Gap:
        """Smallest non-zero and largest zero of the scaled singular values."""
        values, rank = self.scaled_singular_values, self.rank
        return Gap(
            float(values[rank - 1]) if rank > 0 else None,
            float(values[rank]) if rank < values.size else None,
        )

    @cached_property
    def condition_number(self) -> float | None:
        """Largest over smallest singular value of D(c), in the model's units.

        None where D(c) is rank-deficient or empty, or the quotient is not finite.
        """
        values = self.singular_values
        if values.size == 0 or self.rank < values.size or not values[-1] > 0.0:
            return None
        quotient = float(values[0]) / float(values[-1])
        return quotient if math.isfinite(quotient) else None

    @cached_property
    def counts(self) -> Counts:
        """Coordinates and deformations by class, eqs. (13) to (15)."""
        coordinates, deformations = self.data.count.counts.tolist()
        return Counts(ClassCounts(*coordinates), ClassCounts(*deformations))

    @property
    def degrees_of_freedom(self) -> int:
        """Number of independent coordinates and deformations, eq. (6)."""
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
    def motions(self) -> tuple[Motion, ...]:
        """Motions that nothing determines: an orthonormal basis, from V of eq. (16).

        Where there are several, single ones depend on the choice of the basis.
        """
        return tuple(Motion(k, self) for k in range(self.under_constrained))

    @cached_property
    def self_stresses(self) -> tuple[SelfStress, ...]:
        """Stresses without load: an orthonormal basis, from U of eq. (16).

        Where there are several, single ones depend on the choice of the basis.
        """
        return tuple(SelfStress(k, self) for k in range(self.over_constrained))

    @cached_property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """Warnings and notes about the model and about the decision on its rank."""
        return (*self.data.problems.kept, *self._warnings_of_the_decision())

    def _warnings_of_the_decision(self) -> Iterator[Diagnostic]:
        (small, zero), values = self.gap, self.scaled_singular_values
        if small is not None and small < _NEARLY_ZERO * values[0]:
            yield Diagnostic(
                Severity.WARNING,
                "close-decision",
                f"the smallest singular value that counts as non-zero is {small / values[0]:.1e} "
                "of the largest: the rank may hang on digits of the coordinates that were left out",
                help="give the coordinates with more digits, or look at the geometry",
            )
        if zero is not None and zero > self.raw.noise:
            yield Diagnostic(
                Severity.WARNING,
                "rounded-coordinates",
                f"singular values up to {zero:.1e} count as zero because the coordinates are "
                "given with so many digits only",
                help="give the coordinates with all their digits",
            )

    def dense_jacobian(self) -> FloatArray:
        """D(c) itself, (m, n), in the model's units, eq. (11)."""
        whole = jacobian(self.model)
        row_of = {label: i for i, label in enumerate(whole.row_labels)}
        column_of = {label: i for i, label in enumerate(whole.column_labels)}
        rows = [row_of[label] for label in self.row_labels]
        columns = [column_of[label] for label in self.column_labels]
        part: FloatArray = whole.toarray()[rows][:, columns]
        return part

    def to_dict(self) -> dict[str, Any]:
        """The result as the JSON has it; components that are practically zero are left out."""
        from .json_result import dictionary_of

        return dictionary_of(self)

    def to_json(self) -> str:
        """One line of JSON; numbers read back to the last bit."""
        import json

        return json.dumps(self.to_dict(), allow_nan=False)

    def to_meshio(self) -> meshio.Mesh:
        """The mechanism with its motions and self-stresses as a mesh (`flexact.mesh`)."""
        from .mesh import to_meshio

        return to_meshio(self)

    def describe(self) -> str:
        """The result in plain English: verdict, counts, decision, motions and self-stresses."""
        from .words import MOST_MODES, describe

        return describe(self, most=MOST_MODES)

    def __repr__(self) -> str:
        """Verdict and size in a line."""
        name = f" {self.name!r}" if self.name else ""
        motions = f"{self.under_constrained} motion{'s' * (self.under_constrained != 1)}"
        stresses = f"{self.over_constrained} self-stress{'es' * (self.over_constrained != 1)}"
        return (
            f"<Analysis{name}: {self.verdict.value}, {motions}, {stresses}, "
            f"D(c) {self.rows} x {self.columns} of rank {self.rank}>"
        )

    def _repr_html_(self) -> str:
        from .notebook import html_of

        return html_of(self)


def analyse(
    model: Model | str | bytes | os.PathLike[str] | os.PathLike[bytes], *, name: str | None = None
) -> Analysis:
    """Decide whether a mechanism is exactly, under- or over-constrained.

    Partition of eq. (7), Jacobian D(c) of eq. (11), its singular value decomposition
    eq. (16), and Table 1 of the paper.

    Args:
        model: A model, or the path of a deck.
        name: What the result is called; by default the model's name or the path.

    Raises:
        DeckError: the deck is wrong.
        ModelError: the model is wrong.
        AnalysisError: the model is too large for the memory, or the decomposition
            did not converge.
        TypeError: what is given is neither a model nor a path, or the name is no text.
    """
    if not isinstance(model, (Model, str, bytes, os.PathLike)):
        kind = type(model).__name__
        raise TypeError(f"a model or the path of a deck can be analysed, not {kind}")
    if not isinstance(name, (str, type(None))):
        raise TypeError(f"the name of a result must be text, not {type(name).__name__}")
    if not isinstance(model, Model):
        model = read(model)
    data = model.data
    data.require_sound()
    count = data.count
    if not memory.is_enough(count.rows, count.columns):
        raise AnalysisError(_too_large(count.rows, count.columns))
    try:
        raw = _boundary.analyse_model(data.arrays, count.rows, count.columns)
    except MemoryError:
        raise AnalysisError(_too_large(count.rows, count.columns)) from None
    if raw.status == 1:
        raise AnalysisError("the singular value decomposition of D(c) did not converge")
    if raw.status == 2:
        raise AnalysisError(_too_large(count.rows, count.columns))
    if raw.status:
        raise AnalysisError(f"the core refused the model (status {raw.status})")
    return Analysis(data.name if name is None else name, data, raw)


def _too_large(rows: int, columns: int) -> str:
    return (
        f"D(c) has {rows} rows and {columns} columns; its decomposition needs about "
        f"{memory.needed(rows, columns) / 1e9:.3g} GB of memory, more than there is"
    )
