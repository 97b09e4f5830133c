# SPDX-License-Identifier: BSD-3-Clause
"""The frozen result of an analysis: all that is known, nothing that is made from it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from ..base.loading import load
from ..core.basis import Basis
from ..core.progress import Progress
from ..model.data import ModelData
from ..model.parts.condensing import condensed
from .certainty import Assessment, assess
from .decompose import decompose
from .freedoms import Freedom, freedoms_of
from .margin import least, margins
from .modes import Modes, Motion, SelfStress, column_weights, row_weights
from .outcome import Asked, Outcome
from .rank_evidence import Evidence
from .sensitivity import Pair
from .sparse_basis import orthonormal
from .verdict import Alternative, Certainty, Margin, Nearly

if TYPE_CHECKING:
    from .exact import ExactBases


@dataclass(frozen=True, eq=False, repr=False)
class Result(Outcome):
    """The result of an analysis, in the reference configuration."""

    @property
    def motions(self) -> Modes[Motion]:
        """Motions that nothing determines: an orthonormal basis, from V of eq. (16).

        Where there are several, single ones depend on the choice of the basis. Where there
        are so many that they would not fit, only the first are here; where thousands belong
        to one component of D(c), they need not be orthogonal.
        """
        return Modes(Motion, self)

    @property
    def self_stresses(self) -> Modes[SelfStress]:
        """Stresses without load: an orthonormal basis, from U of eq. (16); see `motions`."""
        return Modes(SelfStress, self)

    def exact(self) -> ExactBases:
        """Motions and self-stresses as fractions, where D(c) has up to 1000 rows and columns.

        They are those of the numbers of the proof. Parts of some 300 columns take seconds.

        Raises:
            AnalysisError: this build has no FLINT, or D(c) or the fractions are too large.
        """
        # Fractions take some milliseconds to load.
        made: ExactBases = load("flexact.result.exact").exact_bases(self)
        return made

    @cached_property
    def freedoms(self) -> tuple[Freedom, ...]:
        """The declared degrees of freedom, with the motion of each (`flexact.result.freedoms`)."""
        return freedoms_of(self)

    @cached_property
    def evidence(self) -> Evidence:
        """What small changes and rounding may make of the singular values."""
        return Evidence(self)

    @cached_property
    def assessment(self) -> Assessment:
        """What is to be thought of the decision on the rank (`flexact.result.certainty`)."""
        return assess(self, self.evidence)

    @property
    def certainty(self) -> Certainty:
        """`CERTAIN`, or `NEARLY` where rounding or the method leaves a doubt."""
        return self.assessment.certainty

    @property
    def alternatives(self) -> tuple[Alternative, ...]:
        """Counts that may be meant instead, likeliest first, at most three; none without doubt."""
        return self.assessment.alternatives

    @property
    def nearly(self) -> Nearly | None:
        """The counts of the first of the `alternatives`; None without doubt."""
        if self.certainty is Certainty.CERTAIN:
            return None
        first = next(iter(self.alternatives), None)
        if first is None:
            return Nearly(self.under_constrained, self.over_constrained)
        return Nearly(first.under_constrained, first.over_constrained)

    @property
    def pairs(self) -> tuple[Pair, ...]:
        """What moves the smallest singular values that are not zero, ascending."""
        return self.evidence.pairs

    @property
    def zero_pairs(self) -> tuple[tuple[Pair, ...], ...]:
        """For each zero what may lift it (`flexact.result.sensitivity`)."""
        return self.evidence.zero_pairs

    @cached_property
    def margins(self) -> tuple[Margin, ...]:
        """Of each zero, and of the smallest other singular values (`flexact.result.margin`)."""
        return margins(self, self.evidence)

    @property
    def margin(self) -> Margin:
        """The smallest misalignment that would change the verdict: a length and an angle."""
        return least(self.margins)

    @cached_property
    def motion_space(self) -> Basis:
        """Orthonormal basis of the motions, rotations in lengths."""
        return orthonormal(self.raw.motions, column_weights(self))

    @cached_property
    def stress_space(self) -> Basis:
        """Orthonormal basis of the self-stresses, moments in forces."""
        return orthonormal(self.raw.stresses, row_weights(self))


Found = TypeVar("Found", bound=Result)


def result_of(
    data: ModelData,
    asked: Asked,
    name: str | None = None,
    progress: Progress | None = None,
    kind: type[Found] = Result,  # type: ignore[assignment]
) -> Found:
    """Analyse a model: partition, eq. (7), D(c), eq. (11), its decomposition, eq. (16).

    Args:
        data: The model.
        asked: The method and the tolerance.
        name: What the result is called; by default the model's name.
        progress: Called with what is being done and how much of that is done, from 0 to 1,
            some times a second.
        kind: What the result is to be.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        AnalysisError: see `decompose`.
    """
    data.require_sound()
    one = condensed(data)
    raw = decompose(one.data, asked, progress)
    return kind(data.name if name is None else name, one, raw, asked)
