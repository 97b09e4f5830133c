# SPDX-License-Identifier: BSD-3-Clause
"""The frozen result of an analysis: all that is known, nothing that is made from it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ..core.elements import Class, Role, role_table
from ..core.progress import Progress
from ..deck.rendering import ModelError, model_error
from ..model.data import ModelData
from ..model.deformations import AT_P, AT_Q
from ..model.parts.condensing import condensed
from ..model.parts.parts import PartKind, declared
from ..model.variation import with_classes
from ..util.loading import load
from ..util.records import cached_property
from ..util.text import in_short
from .carriers import Joint
from .certainty import Assessment, assess
from .decomposition import Asked
from .freedoms import Freedom, freedoms_of
from .locate import elements_of, node_of
from .margin import least, margins
from .modes import Modes, Motion, SelfStress
from .rank_evidence import Evidence, Pair
from .spaces import Spaces, decompose
from .verdict import MARGINAL_COLOUR, Alternative, Certainty, Margin, Nearly, Verdict

if TYPE_CHECKING:
    from .exact import ExactBases


def turning_folds(result: Result) -> tuple[tuple[int, int], ...]:
    """Of each fold that turns while nothing else moves the bending of a leaf there.

    Indices of elements in `result.data`, and numbers of their deformations, from 1: what
    `Model.folded_sheet` declares. None of a model with divided sheets that are not declared.
    """
    if not result.under_constrained or not result.is_told_by_parts:
        return ()
    if result.with_internal_declared is not None:
        return ()
    folds = {joint.orientation: joint for joint in result.carriers.joints if joint.is_fold}
    moving: dict[Joint, None] = {}
    count = 0
    for motion, is_between in zip(result.motions, result.are_between_ends, strict=True):
        mine = [folds[node] for node in motion.nodes if node in folds] if is_between else []
        moving.update(dict.fromkeys(mine))
        count += bool(mine)
    found = [_bending(result, joint) for joint in moving]
    made = tuple(place for place in found if place is not None)
    return made if len(made) == len(found) == count else ()


def _bending(result: Result, joint: Joint) -> tuple[int, int] | None:
    """The bending that the first leaf releases at a fold; None where it is none of two sheets."""
    if not joint.is_fold or any(part.kind is not PartKind.SHEET for part in joint.parts):
        return None
    data = result.data.arrays
    leaf = min(joint.parts, key=lambda part: part.number)
    index = int(np.searchsorted(result.condensed.elements, min(leaf.elements)))
    at = AT_P if leaf.ends[0] == joint.position else AT_Q
    roles = map(Role, role_table()[data.element_kind[index]].tolist())
    for number, role in enumerate(roles, start=1):
        if role in at and data.deformation_class[number - 1, index] == Class.DEPENDENT:
            return index, number
    return None


#: How many degrees of freedom a message names.
_MOST_LABELS = 12


@dataclass(frozen=True, eq=False, repr=False)
class Result(Spaces):
    """The result of an analysis, in the reference configuration."""

    @property
    def motions(self) -> Modes[Motion]:
        """Motions that nothing determines: a basis of the null space V of eq. (16).

        Where there are several, they are chosen so that as few bodies as can be move in each
        (`flexact.analysis.mode_basis`); in each the largest displacement or rotation is 1. Where
        there are so many that they would not fit, only the first are here.
        """
        return Modes(Motion, self)

    @property
    def self_stresses(self) -> Modes[SelfStress]:
        """Stresses without load: a basis of the null space U of eq. (16); see `motions`.

        As few parts as can be are stressed in each; the largest force or moment is 1.
        """
        return Modes(SelfStress, self)

    def exact(self) -> ExactBases:
        """Motions and self-stresses as fractions, where D(c) has up to 1000 rows and columns.

        They are those of the numbers of the proof. Parts of some 300 columns take seconds.

        Raises:
            AnalysisError: this build has no FLINT, or D(c) or the fractions are too large.
        """
        # Fractions take some milliseconds to load.
        made: ExactBases = load("flexact.analysis.exact").exact_bases(self)
        return made

    @cached_property
    def freedoms(self) -> tuple[Freedom, ...]:
        """The declared degrees of freedom, each with its motion; `flexact.analysis.freedoms`."""
        return freedoms_of(self)

    def freedom(self, label: str) -> Freedom:
        """The declared degree of freedom of a label, such as "stage z".

        Args:
            label: As the freedoms have it, or any name or number of the point or element behind
                which stands which part of it: "tip x", "5 x", "stage:z", "sheet 1 e3".

        Raises:
            ModelError: there is none, or there are several.
        """
        found = [each for each in self.freedoms if each.label == label]
        if not found:
            found = list(self._freedoms_at(label))
        if len(found) != 1:
            there = ", ".join(each.label for each in (found or self.freedoms)[:_MOST_LABELS])
            many = "several degrees of freedom are" if found else "there is no degree of freedom"
            raise model_error(
                "ambiguous-freedom" if found else "no-such-freedom",
                f"{many} {in_short(label)}",
                f"there are {there}" if there else "none is declared",
            )
        return found[0]

    def _freedoms_at(self, text: str) -> Iterator[Freedom]:
        """Those of a point or element that is named otherwise than in their labels."""
        words = re.fullmatch(r"(.+?)\s*[\s:]\s*([a-z]+\d*)", text.strip(), re.DOTALL)
        if words is None:
            return
        target = int(words[1]) if words[1].isdecimal() else words[1]
        for each in self.freedoms:
            if each.part == words[2] and _is_of(self, each, target):
                yield each

    @cached_property
    def with_internal_declared(self) -> Result | None:
        """The result with each divided sheet or wire as one beam; None where there is none.

        Where divided sheets and wires are not declared so, their internal motions are among
        the `motions`, and a bend by as little as rounding keeps them from passing on moments.
        """
        whole = declared(self.given)
        if whole is self.given:
            return None
        return result_of(whole, self.asked, self.name)

    @cached_property
    def folds(self) -> tuple[tuple[int, int], ...]:
        """What declares the folds that turn about themselves (`flexact.analysis.result`).

        None where that would change more than that they are declared.
        """
        return () if self.with_folds_declared is None else turning_folds(self)

    @cached_property
    def with_folds_declared(self) -> Result | None:
        """The result with these folds declared; None where there is none."""
        folds, numbers = turning_folds(self), self.given.arrays.element_number
        if not folds:
            return None
        places = (self.condensed.in_given(*place) for place in folds)
        classes = {(int(numbers[at]), own): Class.INDEPENDENT for at, own in places}
        made = replace(with_classes(self.given, classes, {}), source=self.given.source)
        then: Result = result_of(made, self.asked, self.name)
        over, under = self.over_constrained, self.under_constrained - len(folds)
        return then if (then.under_constrained, then.over_constrained) == (under, over) else None

    @cached_property
    def evidence(self) -> Evidence:
        """What small changes and rounding may make of the singular values."""
        return Evidence(self)

    @cached_property
    def assessment(self) -> Assessment:
        """What is to be thought of the decision on the rank (`flexact.analysis.certainty`)."""
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
        """For each zero what may lift it (`flexact.analysis.rank_evidence`)."""
        return self.evidence.zero_pairs

    @cached_property
    def margins(self) -> tuple[Margin, ...]:
        """Of each zero, and of the smallest other singular values (`flexact.analysis.margin`)."""
        return margins(self, self.evidence)

    @cached_property
    def margin(self) -> Margin:
        """The smallest misalignment that would change the verdict: a length and an angle."""
        return least(self.margins)

    @property
    def is_marginal(self) -> bool:
        """Whether the margin is smaller than the accuracy; False where none was given."""
        return self.accuracy is not None and any(self.accuracy.exceeds(self.margin))

    @property
    def colour(self) -> str:
        """Of the verdict, as #rrggbb; amber where exactly constrained is only marginal."""
        if self.verdict is Verdict.EXACT and self.is_marginal:
            return MARGINAL_COLOUR
        return self.verdict.colour


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


def _is_of(result: Result, freedom: Freedom, target: object) -> bool:
    """Whether a degree of freedom is one of what is meant."""
    owner, parts = freedom.place[1], result.parts
    try:
        if not freedom.is_coordinate:
            return int(result.condensed.elements[owner]) in elements_of(parts, target)
        node = int(result.condensed.nodes[owner])
        body = parts.body_at.get(node)
        if body is not None and parts.of_body(body).name == target:
            return True
        return node_of(parts, target) in (node, parts.place_of(node))
    except (ModelError, TypeError):
        return False
