# SPDX-License-Identifier: BSD-3-Clause
"""The frozen result of an analysis, its motions and its self-stresses: all that is known."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from operator import eq
from typing import TYPE_CHECKING, Generic, TypeVar, overload

import numpy as np

from ..core.arrays import Basis, FloatArray
from ..core.elements import Class, Dual, NodeKind, Role, coordinate_name, role_table
from ..core.progress import Progress
from ..deck.rendering import ModelError, model_error
from ..model.data import ModelData
from ..model.parts.condensing import condensed
from ..model.parts.forms import AT_P, AT_Q
from ..model.parts.parts import Joint, PartKind, declared
from ..model.variation import with_classes
from ..util.loading import load
from ..util.records import Frozen, cached_property, read_only
from ..util.text import in_short
from .body_motions import Moves, Velocities
from .certainty import Assessment, assess, least, margins
from .decomposition import (
    Accuracy,
    Asked,
    Decomposition,
    column_weights,
    decompose,
    row_duals,
    row_factors,
    row_weights,
)
from .freedoms import Freedom, freedoms_of
from .limits import USUAL_ACCURACY, USUAL_PART
from .locate import elements_of, node_of
from .mode_basis import (
    column_key,
    is_large,
    motion_basis,
    moves_within,
    ranked,
    row_key,
    scaled_motions,
    scaled_stresses,
    stress_basis,
)
from .part_stresses import Presses
from .rank_evidence import Evidence, Pair
from .verdict import MARGINAL_COLOUR, Alternative, Certainty, Margin, Verdict

if TYPE_CHECKING:
    from .exact import ExactBases
    from .holding import BodyHolding, Holding


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
class Result(Decomposition):
    """The result of an analysis, in the reference configuration."""

    def in_notebook(self, what: object) -> str | None:
        """HTML of a motion, a self-stress or a row of them; None: a result makes no pictures."""
        return None

    @cached_property
    def motion_basis(self) -> Basis:
        """The motions as they are told, [m] and [rad]: sparse over bodies, not orthogonal.

        The largest entry of each is 1, rotations compared by the characteristic length. Of
        large spaces they are those of the core, scaled (`flexact.analysis.mode_basis`).
        """
        if self.raw.motions.vectors < self.under_constrained or is_large(self.raw.motions):
            return scaled_motions(self)
        return motion_basis(self, self.motion_space)

    @cached_property
    def stress_basis(self) -> Basis:
        """The self-stresses as they are told: sparse over parts, the largest force or moment 1."""
        if self.raw.stresses.vectors < self.over_constrained or is_large(self.raw.stresses):
            return scaled_stresses(self)
        return stress_basis(self, self.stress_space)

    @cached_property
    def internal_motions(self) -> int:
        """How many motions move nothing but what is inside of sheets and wires.

        It is the dimension of the space of these. Of a space so large that it is told as the
        core gives it, it is how many of the core's vectors are so.
        """
        if not self.motion_basis.vectors:
            return 0
        # Insides of different parts have no element in common: what is inside of each moves alone.
        inner = self.carriers.inner
        return int(np.count_nonzero(moves_within(self, self.motion_basis, inner)))

    @cached_property
    def are_between_ends(self) -> tuple[bool, ...]:
        """Of each motion whether it moves nothing but what is between the ends of flexures.

        That is insides of sheets and wires, and folds. Those that do are a basis of all such
        motions, but of spaces so large that they are told as the core gives them.
        """
        if not self.motion_basis.vectors:
            return ()
        nodes = self.carriers.between_ends
        return tuple(moves_within(self, self.motion_basis, nodes).tolist())

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
            AnalysisError: D(c) or the fractions are too large.
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
        words = re.fullmatch(r"(.+?)\s*[\s:]\s*([a-z]+\d*)", label.strip(), re.DOTALL)
        if not found and words is not None:
            target = int(words[1]) if words[1].isdecimal() else words[1]
            found = [
                each
                for each in self.freedoms
                if each.part == words[2] and _is_of(self, each, target)
            ]
        if len(found) != 1:
            there = ", ".join(each.label for each in (found or self.freedoms)[:_MOST_LABELS])
            many = "several degrees of freedom are" if found else "there is no degree of freedom"
            raise model_error(
                "ambiguous-freedom" if found else "no-such-freedom",
                f"{many} {in_short(label)}",
                f"there are {there}" if there else "none is declared",
            )
        return found[0]

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
    def holding(self) -> Holding:
        """How often each body is held, and what no body feels (`flexact.analysis.holding`)."""
        whole = self.with_internal_declared or self
        holding_of = load("flexact.analysis.holding").holding_of
        made: Holding = holding_of(whole, whole.freedoms, whole.motions)
        return made

    @property
    def bodies(self) -> tuple[BodyHolding, ...]:
        """Of each body how often each of its motions is held, and which are declared or free.

        Of a mechanism without bodies the points that flexures carry; none of a large model. A
        divided sheet or wire counts as one beam.
        """
        return self.holding.bodies

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
        """`CERTAIN`, or `DOUBTFUL` where rounding or the method leaves a doubt."""
        return self.assessment.certainty

    @property
    def alternatives(self) -> tuple[Alternative, ...]:
        """Counts that may be meant instead, likeliest first, at most three; none without doubt."""
        return self.assessment.alternatives

    @property
    def nearly(self) -> Alternative | None:
        """The counts of the first of the `alternatives`; None without doubt."""
        if self.certainty is Certainty.CERTAIN:
            return None
        own = Alternative(self.under_constrained, self.over_constrained, 0.0, 0.0)
        return next(iter(self.alternatives), own)

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
        """Of each zero, and of the smallest other singular values; theory.md (29)."""
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
    def usual_accuracy(self) -> Accuracy:
        """The accuracy that was given, or that to which parts are usually made.

        20 um where the model has stiffness, and so is in metres; else a part of its size.
        """
        if self.accuracy is not None:
            return self.accuracy
        length = self.characteristic_length
        if self.given.has_stiffness:
            return Accuracy(USUAL_ACCURACY, USUAL_ACCURACY / length)
        return Accuracy(USUAL_PART * length, USUAL_PART)

    @property
    def has_small_margin(self) -> bool:
        """Whether the margin is smaller than the accuracy, or than parts are usually made to."""
        return any(self.usual_accuracy.exceeds(self.margin))

    @property
    def colour(self) -> str:
        """Of the verdict, as #rrggbb; amber where exactly constrained has a small margin."""
        if self.verdict is Verdict.EXACT and self.has_small_margin:
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


#: How many modes of a row stand in its `repr`.
_TOLD = 12


@dataclass(frozen=True, repr=False)
class Motion(Moves, Frozen):
    """A kinematically indeterminate motion: velocities that nothing determines.

    Attributes:
        index: Which one of the analysis, from 0.
        analysis: The analysis it belongs to.
    """

    index: int
    analysis: Result

    @property
    def vector(self) -> FloatArray:
        """(n,) the dependent coordinates [m, rad]; the largest is one."""
        return read_only(self.analysis.motion_basis.vector(self.index))

    @cached_property
    def analysed(self) -> Velocities:
        """The velocities of the nodes of the model as it was analysed."""
        kinds = self.analysis.data.arrays.node_kind
        place, value = self.analysis.motion_basis.entries(self.index)
        node, axis = self.analysis.raw.column_label[:, place] - 1
        both = np.zeros((2, kinds.size, 3))
        both[(kinds[node] > NodeKind.POSITION).astype(int), node, axis] = value
        return Velocities(self.analysis.data, *both)

    def largest(self, k: int = 6) -> list[tuple[int, str, float]]:
        """Node number, coordinate and value [m, rad] of the k largest parts.

        Rotations are compared with displacements by the characteristic length.
        """
        analysis = self.analysis
        place, value = analysis.motion_basis.entries(self.index)
        weighted = value * column_weights(analysis, place)
        order = ranked(weighted, k, lambda i: column_key(analysis, int(place[i])))
        node, axis = analysis.raw.column_label[:, place[order]] - 1
        numbers = analysis.data.arrays.node_number[node].tolist()
        names = map(coordinate_name, analysis.data.arrays.node_kind[node].tolist(), axis.tolist())
        return list(zip(numbers, names, value[order].tolist(), strict=True))

    def __repr__(self) -> str:
        """What moves."""
        if not self.analysis.is_told_by_parts:
            parts = [f"node {n} {c} {v:.4g}" for n, c, v in self.largest(4)]
        elif self.is_internal:
            parts = [f"inside {', '.join(part.name for part in self.internal_to)}"]
        else:
            parts = [str(each) for each in self.bodies[:4]]
        return f"<Motion {self.index + 1}: {'; '.join(parts)}>"

    def _repr_html_(self) -> str | None:
        return self.analysis.in_notebook(self)


@dataclass(frozen=True, repr=False)
class SelfStress(Presses, Frozen):
    """A statically indeterminate stress: stress resultants that need no load.

    Attributes:
        index: Which one of the analysis, from 0.
        analysis: The analysis it belongs to.
    """

    index: int
    analysis: Result

    @property
    def vector(self) -> FloatArray:
        """(m,) stress resultants dual to the deformations; the largest force or moment is one."""
        return read_only(self.analysis.stress_basis.vector(self.index))

    @property
    def forces(self) -> FloatArray:
        """(elements, 6) by deformation, where its stress resultant is a force [N]; else zero."""
        return self._at_elements[1]

    @property
    def moments(self) -> FloatArray:
        """(elements, 6) by deformation, where it is a moment [N m]; else zero.

        Of a beam's torsion and bending the moment is sigma l0.
        """
        return self._at_elements[0]

    @cached_property
    def _at_elements(self) -> tuple[FloatArray, FloatArray]:
        moments, forces = self.analysis.condensed.stress(*self.analysed)
        return read_only(moments), read_only(forces)

    @cached_property
    def analysed(self) -> tuple[FloatArray, FloatArray]:
        """Moments and forces, (elements, 6) each, of the elements of the model as analysed."""
        place, value = self.analysis.stress_basis.entries(self.index)
        element, deformation = self.analysis.raw.row_label[:, place] - 1
        is_force = (row_duals(self.analysis, place) == Dual.FORCE).astype(int)
        both = np.zeros((2, self.analysis.data.arrays.element_number.size, 6))
        both[is_force, element, deformation] = value * row_factors(self.analysis, place)
        return both[0], both[1]

    def largest(self, k: int = 6) -> list[tuple[int, int, float]]:
        """Element number, deformation and force [N] or moment [N m] of the k largest parts.

        Moments are compared with forces by the characteristic length.
        """
        analysis = self.analysis
        place, value = analysis.stress_basis.entries(self.index)
        weighted = value * row_weights(analysis, place)
        order = ranked(weighted, k, lambda i: row_key(analysis, int(place[i])))
        element, deformation = analysis.raw.row_label[:, place[order]]
        numbers = analysis.data.arrays.element_number[element - 1].tolist()
        values = value[order] * row_factors(analysis, place[order])
        return list(zip(numbers, deformation.tolist(), values.tolist(), strict=True))

    def __repr__(self) -> str:
        """What is stressed."""
        if not self.analysis.is_told_by_parts:
            parts = [f"element {e}, {d}: {v:.4g}" for e, d, v in self.largest(4)]
        else:
            parts = [str(each) for each in self.parts[:4]]
        return f"<SelfStress {self.index + 1}: {'; '.join(parts)}>"

    def _repr_html_(self) -> str | None:
        return self.analysis.in_notebook(self)


Mode = TypeVar("Mode", Motion, SelfStress)


@dataclass(frozen=True, eq=False, repr=False)
class Modes(Frozen, Sequence[Mode], Generic[Mode]):
    """Motions or self-stresses in a row, like a tuple; each is made when it is asked for.

    Attributes:
        kind: What they are.
        analysis: The analysis that they belong to.
    """

    kind: type[Mode]
    analysis: Result

    def __len__(self) -> int:
        """How many are given: all, or, where there are very many, the first."""
        raw = self.analysis.raw
        return (raw.motions if self.kind is Motion else raw.stresses).vectors

    @overload
    def __getitem__(self, index: int) -> Mode: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Mode, ...]: ...
    def __getitem__(self, index: int | slice) -> Mode | tuple[Mode, ...]:
        """One of them, or a tuple of several."""
        try:
            chosen = range(len(self))[index]
        except IndexError:
            many, what = len(self), "motion" if self.kind is Motion else "self-stress"
            what += "" if many == 1 else "s" if self.kind is Motion else "es"
            raise IndexError(
                f"there {'is' if many == 1 else 'are'} {many or 'no'} {what}: none has the index "
                f"{index}{'; they count from 0' if many else ''}"
            ) from None
        if isinstance(chosen, range):
            return tuple(self.kind(k, self.analysis) for k in chosen)
        return self.kind(chosen, self.analysis)

    def __eq__(self, other: object) -> bool:
        """Whether the same ones stand in another row or tuple."""
        if not isinstance(other, (Modes, tuple)):
            return NotImplemented
        return len(self) == len(other) and all(map(eq, self, other))

    def __hash__(self) -> int:
        """As of any object that does not change."""
        return hash((self.kind, self.analysis))

    def __repr__(self) -> str:
        """The first ones."""
        told = [repr(mode) for mode in self[:_TOLD]]
        return f"({', '.join(told)}{', ...' if len(self) > _TOLD else ''})"

    def _repr_html_(self) -> str | None:
        return self.analysis.in_notebook(self)
