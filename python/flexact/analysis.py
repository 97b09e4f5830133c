"""The analysis of a model: is it exactly, under- or over-constrained, and how."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _boundary, memory, remedies
from .configuration import Labels, assembled, column_labels, jacobian, row_labels
from .diagnostics import Diagnostic, FlexactError, Severity
from .exchange import Basis, FloatArray, IntArray, RawAnalysis, RawAssembly
from .frozen import Frozen
from .model import Model
from .model_data import ModelData
from .modes import Modes, Motion, SelfStress
from .progress import Progress, told
from .reading import read
from .verdict import Certainty, ClassCounts, Counts, Gap, Margin, Nearly, Verdict

if TYPE_CHECKING:
    import meshio

    from .certainty import Assessment
    from .freedoms import Freedom
    from .pairs import Pair

#: A smallest non-zero singular value below this part of the largest is worth a warning.
_NEARLY_ZERO = 1.0e-5


#: What the core says by its status.
_FAILURES = {
    1: "the decomposition of D(c) did not converge",
    5: "this build of Flexact has no SuiteSparse, which the method 'sparse' needs: install it "
    "(apt-get install libsuitesparse-dev), then build Flexact again",
}


class Asked(NamedTuple):
    """How an analysis was asked to be done."""

    method: str = "auto"
    """One of `flexact._boundary.METHODS`."""
    tolerance: float | None = None
    """None: it follows from the data and the arithmetic."""


_PLAIN = Asked()


class AnalysisError(FlexactError):
    """A sound model that could not be analysed: too large, or no convergence."""


@dataclass(frozen=True, eq=False, repr=False)
class Analysis(Frozen):
    """The result of an analysis, in the reference configuration.

    Attributes:
        name: What the deck or model is called.
        data: The model at the time of the analysis.
        raw: The results as the core gives them.
        asked: The method and the tolerance that were asked for.
    """

    name: str
    data: ModelData
    raw: RawAnalysis
    asked: Asked = _PLAIN

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

    @cached_property
    def singular_values(self) -> FloatArray:
        """Singular values of D(c) in the model's units, descending, eq. (16).

        All min(m, n) of them; after the method sparse the smallest, which are computed when
        they are first asked for; see `singular_values_given`.
        """
        if self.method != "sparse":
            return self.raw.singular_values
        values = _boundary.analyse_model(
            self.data.arrays,
            self.rows,
            self.columns,
            "sparse",
            memory=memory.allowance(),
            only_plain_values=True,
        ).scaled_values
        values.flags.writeable = False
        return values

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
    def _values_left_out(self) -> int:
        """How many of the largest singular values are not given."""
        return min(self.rows, self.columns) - self.scaled_singular_values.size

    @property
    def method(self) -> str:
        """How D(c) was decomposed: svd, jacobi, qr or sparse."""
        return self.raw.method

    @property
    def parts(self) -> int:
        """Number of connected parts of D(c), which are decomposed one by one."""
        return self.raw.parts

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
        values, pairs = self.scaled_singular_values, self.raw.pair_value
        rank = max(self.rank - self._values_left_out, 0)
        # Where only zeros are given, the core may know the value above them all the same.
        above = values[rank - 1] if rank > 0 else next(iter(pairs), None) if self.rank else None
        return Gap(
            None if above is None else float(above),
            float(values[rank]) if rank < values.size else None,
        )

    @cached_property
    def assessment(self) -> Assessment:
        """What is to be thought of the decision on the rank (`flexact.certainty`)."""
        from .certainty import assess

        return assess(self)

    @property
    def certainty(self) -> Certainty:
        """`CERTAIN`, or `NEARLY` where rounding or the method leaves a doubt."""
        return self.assessment.certainty

    @property
    def nearly(self) -> Nearly | None:
        """The counts that hold if every singular value in doubt is zero; None without doubt."""
        return self.assessment.nearly

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences that say why the decision is not certain."""
        return tuple(doubt.sentence for doubt in self.assessment.doubts)

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        """What moves the smallest singular values that are not zero, ascending."""
        from .pairs import of_nonzeros

        return of_nonzeros(self)

    @cached_property
    def zero_pairs(self) -> tuple[tuple[Pair, ...], ...]:
        """For each zero what may lift it (`flexact.pairs`)."""
        from .pairs import of_zeros

        return of_zeros(self)

    @cached_property
    def margins(self) -> tuple[Margin, ...]:
        """Of each zero, and of the smallest other singular values (`flexact.margin`)."""
        from .margin import margins

        return margins(self)

    @property
    def margin(self) -> Margin:
        """The smallest misalignment that would change the verdict: a length and an angle."""
        from .margin import margin

        return margin(self)

    @cached_property
    def condition_number(self) -> float | None:
        """Largest over smallest singular value of D(c), in the model's units.

        None where D(c) is rank-deficient or empty, the quotient is not finite, or the largest
        is not given.
        """
        values = self.singular_values
        full = self.rank == min(self.rows, self.columns) == values.size > 0
        if not full or not values[-1] > 0.0:
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

    @property
    def motions(self) -> Modes[Motion]:
        """Motions that nothing determines: an orthonormal basis, from V of eq. (16).

        Where there are several, single ones depend on the choice of the basis. Where there
        are so many that they would not fit, only the first are here; where thousands belong
        to one part of D(c), they need not be orthogonal.
        """
        return Modes(Motion, self)

    @property
    def self_stresses(self) -> Modes[SelfStress]:
        """Stresses without load: an orthonormal basis, from U of eq. (16); see `motions`."""
        return Modes(SelfStress, self)

    @cached_property
    def freedoms(self) -> tuple[Freedom, ...]:
        """The declared degrees of freedom, with the motion of each (`flexact.freedoms`)."""
        from .freedoms import freedoms_of

        return freedoms_of(self)

    @cached_property
    def assembly(self) -> RawAssembly:
        """The whole Jacobian in the reference configuration, as the core numbers it."""
        model = self.model
        return assembled(model, model.reference())

    @cached_property
    def motion_space(self) -> Basis:
        """Orthonormal basis of the motions, weighted as `flexact.remedies` does."""
        return remedies.motion_space(self)

    @cached_property
    def stress_space(self) -> Basis:
        """Orthonormal basis of the self-stresses, weighted as `flexact.remedies` does."""
        return remedies.stress_space(self)

    @cached_property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """Warnings and notes about the model and about the decision on its rank."""
        return (*self.data.problems.kept, *self._warnings_of_the_decision())

    def _warnings_of_the_decision(self) -> Iterator[Diagnostic]:
        doubts = self.assessment.doubts
        for doubt in doubts:
            yield Diagnostic(Severity.WARNING, doubt.code, doubt.sentence, help=doubt.help)
        small, largest = self.gap.smallest_nonzero, max(self.scaled_singular_values, default=0.0)
        if small is not None and small < _NEARLY_ZERO * largest and not doubts:
            yield Diagnostic(
                Severity.WARNING,
                "close-decision",
                f"the smallest singular value that counts as non-zero is {small / largest:.1e} "
                "of the largest: a small misalignment would change the verdict",
                help="look at the margin, and at the geometry",
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
        """One line of JSON, of `to_dict`; numbers read back to the last bit."""
        from .json_result import text_of

        return text_of(self)

    def to_meshio(self) -> meshio.Mesh:
        """The mechanism with its motions and self-stresses as a mesh (`flexact.mesh`)."""
        from .mesh import to_meshio

        return to_meshio(self)

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        motion: int | None = None,
        freedom: int | None = None,
        stress: int | None = None,
        quantity: str | None = None,
        view: str | None = None,
    ) -> None:
        """Write the result to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: a picture (.png, .svg, or .gif, which moves;
                `flexact.picture`), a page (.html; `flexact.report`), a cycle for ParaView (.pvd),
                or a mesh (.vtu, .vtp, .vtk, .xdmf, ...; `flexact.mesh`).
            motion: Number of the motion that is shown, from 1; of pictures and meshes.
            freedom: Number of the declared degree of freedom that is shown, likewise.
            stress: Number of the self-stress that is shown, of pictures.
            quantity: `N`, `T`, `My` or `Mz` of the self-stress, of pictures.
            view: From where, of pictures; see `flexact.picture.draw`.

        Raises:
            FlexactError: Something chosen is not there, there is no such kind of file, a
                package is missing, or the file cannot be written.
        """
        from .saving import save

        choice = {
            "motion": motion,
            "freedom": freedom,
            "stress": stress,
            "quantity": quantity,
            "view": view,
        }
        save(self, Path(path), choice)

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
    model: Model | str | bytes | os.PathLike[str] | os.PathLike[bytes],
    *,
    method: str = "auto",
    tolerance: float | None = None,
    name: str | None = None,
    progress: Progress | None = None,
) -> Analysis:
    """Decide whether a mechanism is exactly, under- or over-constrained.

    Partition of eq. (7), Jacobian D(c) of eq. (11), its singular value decomposition
    eq. (16), and Table 1 of the paper.

    Args:
        model: A model, or the path of a deck.
        method: How D(c) is decomposed: `auto` chooses by size and structure; `svd`;
            `jacobi`, small singular values to high relative accuracy; `qr`, an estimate;
            `sparse`, for large models.
        tolerance: Singular values of the scaled D(c) up to this one count as zero; by
            default it follows from the data and the arithmetic.
        name: What the result is called; by default the model's name or the path.
        progress: Called with what is being done and how much of that is done, from 0 to 1,
            some times a second.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        AnalysisError: the model is too large for the memory, the decomposition did not
            converge, or this build lacks what the method needs.
        TypeError: what is given is neither a model nor a path, or the tolerance no number,
            or the method or the name no text.
        ValueError: there is no such method, or the tolerance is negative or not finite.
    """
    if not isinstance(model, (Model, str, bytes, os.PathLike)):
        kind = type(model).__name__
        raise TypeError(f"a model or the path of a deck can be analysed, not {kind}")
    if not isinstance(name, (str, type(None))):
        raise TypeError(f"the name of a result must be text, not {type(name).__name__}")
    asked = Asked(_checked_method(method), _checked_tolerance(tolerance))
    if not isinstance(model, Model):
        model = read(model)
    data = model.data
    data.require_sound()
    raw = _decompose(data, asked, progress)
    return Analysis(data.name if name is None else name, data, raw, asked)


def _checked_method(method: str) -> str:
    if not isinstance(method, str):
        raise TypeError(f"a method is given by its name, not by {type(method).__name__}")
    if method not in _boundary.METHODS:
        choices = ", ".join(_boundary.METHODS)
        raise ValueError(f"there is no method {method!r}; choose from {choices}")
    return method


def _checked_tolerance(tolerance: float | None) -> float | None:
    if tolerance is None:
        return None
    if isinstance(tolerance, (str, bytes, bytearray, bool)):
        raise TypeError(f"the tolerance must be a number, not {type(tolerance).__name__}")
    try:
        value = float(tolerance)
    except TypeError:
        kind = type(tolerance).__name__
        raise TypeError(f"the tolerance must be a number, not {kind}") from None
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError(f"the tolerance must be finite and not negative, not {value}")
    return value


def _decompose(data: ModelData, asked: Asked, progress: Progress | None) -> RawAnalysis:
    rows, columns = data.count.rows, data.count.columns
    room = memory.allowance()

    def work(stage: IntArray | None) -> RawAnalysis:
        return _boundary.analyse_model(data.arrays, rows, columns, *asked, stage, room)

    try:
        raw = work(None) if progress is None else told(work, progress)
    except MemoryError:
        raise AnalysisError(_too_large(rows, columns, None)) from None
    if raw.status == 2:
        raise AnalysisError(_too_large(rows, columns, raw.bytes_needed))
    if raw.status:
        raise AnalysisError(_FAILURES.get(raw.status, f"the core failed (status {raw.status})"))
    return raw


def _too_large(rows: int, columns: int, needed: float | None) -> str:
    size = "" if needed is None else f"about {needed / 1e9:.3g} GB of memory, "
    return (
        f"D(c) has {rows} rows and {columns} columns; its decomposition needs {size}"
        f"more {'' if size else 'memory '}than there is"
    )
