# SPDX-License-Identifier: BSD-3-Clause
"""What a design costs: the designs to compare, and what is computed of each."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from ..advice.releases.releases import releases_of
from ..advice.repairs import repairs_of
from ..advice.step import Step, tried
from ..analysis.change import Change
from ..analysis.decomposition import asked_for
from ..analysis.locate import deformations_of
from ..analysis.naming import deformation_in_words, plain
from ..analysis.places import deformation_word, part_words
from ..analysis.result import Result, result_of
from ..core.arrays import FloatArray
from ..core.elements import Class, Member, member_table, role_table
from ..deck.rendering import model_error
from ..elasticity import Elastic, ElasticError, State, StrokeError, elastic
from ..elasticity.limits import Strengths
from ..elasticity.solution import notch_unit
from ..model.data import ModelData
from ..model.model import Model
from ..model.parts.forms import AT_P, AT_Q
from ..model.parts.parts import Parts
from ..util.errors import FlexactError
from ..util.matrices import first_largest
from ..util.quantities import Quantity
from .designs import (
    FREQUENCY,
    STIFFNESS,
    CostValues,
    Design,
    Effect,
    Kept,
    Misalignment,
    Number,
    Numbers,
    Released,
    Stroke,
    StrokeCurve,
    Tolerance,
    in_words,
    stacked,
)
from .elastic_design import (
    ElasticDesign,
    Measures,
    curve_against,
    direction_words,
    drives_of,
    over_levels,
    safeties_of,
    tolerances_of,
)
from .request import ReleaseRequest, Request
from .resolve import Places, given_of, strength_of, stroke_of
from .shape import Shape, as_drawn, unit_mode

#: How many proven releases stand beside the design as built, and how many are measured for that.
MOST, LOOKED_AT = 5, 12


class Candidate(NamedTuple):
    """A design: what is released, and what the analysis says of it."""

    released: tuple[Released, ...]
    alike: tuple[str, ...]
    under_constrained: int
    over_constrained: int

    @property
    def pairs(self) -> dict[tuple[int, int], float]:
        """As the elastic model takes it."""
        return {(each.element, each.deformation): each.notch for each in self.released}


def proven(result: Result, bodies: bool) -> tuple[Candidate, ...]:
    """Minimal sets of releases that were each tried, the likeliest first; none without need.

    Args:
        result: The result.
        bodies: Whether beams inside of bodies may be released as well, as by a hinge between two
            halves of a body; else only where nothing else does it. Rigid links are in any case.
    """
    if not result.over_constrained:
        return ()
    made = []
    sets: list[Step] = [each for each in repairs_of(result) if _is_of_releases(each.change)]
    known = {frozenset(each.change.deformations) for each in sets}
    found = releases_of(result, with_bodies=bodies).sets
    sets += [each for each in found if frozenset(each.change.deformations) not in known]
    index, kinds = result.given.element_index, result.given.arrays.element_kind
    is_link = member_table()[kinds] == Member.LINK
    of_members = [
        each
        for each in sets
        if not any(is_link[index[element]] for element, *_ in each.change.deformations)
    ]
    for proposal in (of_members or sets)[:LOOKED_AT]:
        alike = tuple(_label(_released(result, change)) for change in proposal.alternatives)
        after = proposal.after
        released = _released(result, proposal.change)
        made.append(Candidate(released, alike, after.under_constrained, after.over_constrained))
    return tuple(made)


def _is_of_releases(change: Change) -> bool:
    """Whether a change does nothing but release deformations."""
    return change == Change(change.deformations) and all(
        to is Class.DEPENDENT for _, _, to in change.deformations
    )


def given(result: Result, asked: ReleaseRequest) -> Candidate:
    """A design that is asked for.

    Raises:
        ModelError: there is no such element or deformation.
        QuantityError: the stiffness of a notch is one of another kind.
    """
    numbers, units = result.given.arrays.element_number, result.given.units

    def stiffness(notch: Quantity, element: int, k: int) -> float:
        unit = notch_unit(result.given, element, k)
        return units.read(notch, unit) if isinstance(notch, str) else units.si(notch, unit)

    pairs = {
        (int(numbers[element]), k + 1): stiffness(notch, element, k)
        for key, notch in asked.items()
        for element, k in deformations_of(result.parts, *key)
    }
    released = tuple(_one(result, *pair, notch) for pair, notch in pairs.items())
    index, classes = result.given.element_index, result.given.arrays.deformation_class
    held = [pair for pair in pairs if classes[pair[1] - 1, index[pair[0]]] == Class.FIXED]
    change = Change(deformations=tuple((*pair, Class.DEPENDENT) for pair in held))
    try:
        after = tried(result, change)
    except FlexactError as error:
        label = _label(released)
        raise model_error("not-analysed", f"with {label} released: {error}") from error
    return Candidate(released, (), after.under_constrained, after.over_constrained)


def _released(result: Result, change: Change) -> tuple[Released, ...]:
    return tuple(_one(result, element, number, 0.0) for element, number, _ in change.deformations)


def _one(result: Result, element: int, number: int, notch: float) -> Released:
    data = result.given
    index = data.element_index[element]
    if element in result.data.element_index:
        words = plain(deformation_in_words(result, element, number))
    else:
        # Within a divided sheet that counts as one.
        kind = int(data.arrays.element_kind[index])
        words = f"element {element}: {deformation_word(kind, number)}"
    shown = data.units.shown(notch, notch_unit(data, index, number - 1))
    return Released(element, number, notch, words, shown if data.units.power else None)


def _label(released: tuple[Released, ...]) -> str:
    return "+".join(each.label for each in released)


def stressed(strengths: Strengths, state: State) -> tuple[Number, Number]:
    """The stress of von Mises of the part that is nearest to its strength, and its safety."""
    which, allowed = strengths.which, strengths.allowed
    found = over_levels(lambda one: one.finest.peaks.von_mises[2, which], state)
    k = first_largest(found.value / allowed)
    stress, off = found.at(k)
    if stress == 0.0:
        return Number(0.0), Number(math.inf)
    safety = float(allowed[k]) / stress
    return Number(stress, off), Number(safety, safety * abs(off / stress))


def numbers_of(rows: Iterable[Number]) -> Numbers:
    """(n,) of single numbers."""
    return Numbers(*(np.array(each) for each in zip(*rows, strict=True)))


Given = Sequence[tuple[Misalignment, float]]
#: How often the part of an error that can be reached is halved.
_HALVINGS = 12


def effect_of(
    mechanism: ElasticDesign,
    measures: Measures,
    given: Given,
    parts: Parts,
    strengths: Strengths | None = None,
) -> Effect:
    """Before and behind misalignments that act together.

    Where no equilibrium is found with all of them, they are taken in proportion as far as one is.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts, or nothing of it was
            reached.
    """
    behind, reached = _behind(mechanism, given)
    both = (mechanism.rest, behind)

    def found(quantity: Callable[[State], FloatArray]) -> Numbers:
        return stacked([over_levels(quantity, each) for each in both])

    peak, where = _peaks(mechanism, both)
    hertz = found(measures.frequencies) if measures.has_masses else None
    rows = [] if strengths is None else [stressed(strengths, each) for each in both]
    return Effect(
        hertz if hertz is not None and hertz.value.size else None,
        found(measures.stiffness),
        found(lambda state: np.array([state.energy])).column(0),
        # Largest normal force [N], torque and bending moment [N m] of any element.
        found(lambda state: np.asarray(np.abs(_of_elements(state)).max(axis=0))),
        peak,
        part_words(parts.of_element(where)),
        over_levels(measures.worst, *both).at(0),
        all(each.is_stable for each in behind.alone),
        reached,
        *(numbers_of(each) for each in zip(*rows, strict=True)),
    )


def _behind(mechanism: ElasticDesign, given: Given) -> tuple[State, float]:
    """The state with the misalignments, or with the largest part of them that is found."""
    part, why = 1.0, None
    for _ in range(_HALVINGS):
        off = [(each.clamp.node, each.direction, part * value, each.about) for each, value in given]
        try:
            return mechanism.elastic.imperfect(off, beyond=True).assembled(), part
        except StrokeError as error:
            why = why or error
            # A hair less than what was reached, or half where nothing was.
            reached = abs(error.reached / given[0][1]) if len(given) == 1 else error.reached
            part = reached * 0.999 if 0.0 < reached < part else part / 2.0
    raise ElasticError(f"no equilibrium was found with these misalignments: {why}")


def _of_elements(state: State) -> FloatArray:
    """(elements, 3) normal force, torque and largest bending moment."""
    rows = []
    for element in state.model.data.arrays.element_number.tolist():
        own = state.resultants(element)
        bending = max(np.abs(own.moment_y).max(), np.abs(own.moment_z).max())
        rows.append((own.normal_force, own.torque, bending))
    return np.array(rows)


def _peaks(mechanism: ElasticDesign, both: Sequence[State]) -> tuple[Numbers | None, int]:
    """(2,) largest stress before and behind, and the index of the element that has it behind.

    None of it where no section is known: then the element with the largest moment, or force.
    """
    model, at = mechanism.elastic, both[1].finest
    # Those whose section is known and that carry something.
    there = at.solver.sections.is_known & model.policy.stiff.any(axis=0)
    known = np.flatnonzero(there)
    if not known.size:
        sizes = np.abs(_of_elements(both[1]))
        moment = sizes[:, 1:].max(axis=1)
        return None, int(np.argmax(moment if moment.any() else sizes[:, 0]))
    found = [over_levels(lambda s: s.finest.peaks.normal[known], each) for each in both]
    most = [int(np.argmax(each.value)) for each in found]
    largest = [each.at(k) for each, k in zip(found, most, strict=True)]
    peak = Numbers(*(np.array(each) for each in zip(*largest, strict=True)))
    return peak, int(known[most[1]])


#: How many parasitic frequencies are shown.
_MOST = 2


def shapes_of(
    mechanism: ElasticDesign,
    frequencies: Numbers | None,
    is_drive: tuple[bool, ...],
    buckles: Tolerance | None,
) -> Iterator[Shape]:
    """The drive's and the first parasitic modes, and the shape in which it buckles first."""
    if frequencies is not None:
        chosen = [k for k, drives in enumerate(is_drive) if drives][:1]
        chosen += [k for k, drives in enumerate(is_drive) if not drives][:_MOST]
        for k in chosen:
            hertz = frequencies.at(k)
            kind = "frequency of the drive" if is_drive[k] else "parasitic frequency"
            words = f"{kind}, {in_words(hertz, 'Hz')}"
            yield _shape(mechanism, "vibrating", words, hertz.value, mechanism.rest.modes[k])
    if buckles is not None:
        size, unit = buckles.critical, buckles.misalignment.unit
        sense = -1.0 if buckles.critical.value == -buckles.critical_negative.value else 1.0
        words = f"buckles with {buckles.misalignment.words} off by {in_words(size, unit)}"
        mode = mechanism.levels[-1].buckled(buckles.misalignment, sense)
        if mode is not None:
            yield _shape(mechanism, "buckled", words, sense * size.value, mode)


def _shape(
    mechanism: ElasticDesign, kind: str, words: str, value: float, mode: FloatArray
) -> Shape:
    """The shape of a mode (nodes, 3) at rest."""
    rest = mechanism.rest
    drawn = unit_mode(rest.data, mode)
    return Shape(kind, words, value, as_drawn(rest), rest.configuration, drawn)


#: What was reached of a stroke: states with their values (n,), ascending; how far it went each
#: way, the ends that were asked for or the last value reached; and why not farther, or nothing.
Reached = tuple[tuple[State, ...], FloatArray, tuple[float, float], str]


def follow(elastic: Elastic, asked: Stroke, values: FloatArray) -> Reached:
    """The states along a stroke, each way from where it rests, as far as they are found."""
    found: dict[float, State] = {}
    ends, why = [asked.rest, asked.rest], []
    for end, sense in enumerate((-1.0, 1.0)):
        way = np.sort(sense * values[sense * values >= sense * asked.rest]) * sense
        if end == 1:
            way = way[way != asked.rest]
        states, reached, reason = _one_way(elastic, asked, way.tolist())
        found.update(zip(way.tolist(), states, strict=False))
        if way.size:
            ends[end] = reached
        why += [reason] if reason else []
    there = np.array(sorted(found))
    states = tuple(found[v] for v in there.tolist())
    return states, there, (ends[0], ends[1]), "; ".join(why)


def _one_way(
    elastic: Elastic, asked: Stroke, way: Sequence[float]
) -> tuple[tuple[State, ...], float, str]:
    """States from the one at rest outward, how far that is, and why not farther."""
    reached, why, rest = way[-1] if way else asked.rest, "", asked.rest
    while way:
        try:
            drive = elastic.points.coordinate(asked.node, asked.coordinate)
            return elastic.driven(drive, way), reached, why
        except StrokeError as error:
            why = why or str(error)
            reached = error.reached
            shorter = [v for v in way if abs(v - rest) <= abs(reached - rest)]
            # What was reached on the way to a place may be out of reach by a hair.
            way = shorter if len(shorter) < len(way) else way[:-1]
    return (), reached, why


def curve_of(
    measures: Measures,
    rest: State,
    reached: Reached,
    drive: tuple[int, str],
    is_locked: bool,
    progress: Callable[[float], None],
    strengths: Strengths | None = None,
) -> StrokeCurve | None:
    """A design along the states that were reached; None without any."""
    states, values, *_ = reached
    if not states:
        return None
    rows = []
    for k, state in enumerate(states):
        rows.append(_row(measures, rest, state, drive, is_locked))
        progress((k + 1) / len(states))
    stiffness, kept, own, force, *hertz = (stacked(each) for each in zip(*rows, strict=True))
    if is_locked:
        # How the force changes with the value, where the drive is held.
        slope = np.zeros_like(force.value)
        if values.size > 1:
            slope = np.gradient(force.value[:, 0], values)[:, None]
        own = Numbers(slope, np.zeros_like(slope))
    frequencies = parasitic = None
    if hertz and hertz[0].value.size:
        frequencies = hertz[0]
        others = []
        for k, state in enumerate(states):
            count = len(state.alone[-1].frequencies)
            is_drive = (False,) * count if is_locked else drives_of(measures, state, count)
            left = [j for j in range(frequencies.value.shape[1]) if not is_drive[j]]
            others.append(Numbers(frequencies.value[k, left], frequencies.uncertainty[k, left]))
        parasitic = stacked(others)
    parts = [] if strengths is None else [stressed(strengths, state) for state in states]
    # With masses it is known from the frequencies whether a stiffness is negative.
    is_stable = [
        state.finest.squares.negative == 0 if measures.has_masses else state.is_stable
        for state in states
    ]
    return StrokeCurve(
        values,
        stiffness,
        kept.column(0),
        own.column(0),
        force.column(0),
        frequencies,
        parasitic,
        tuple(is_stable),
        tuple(state.under_constrained for state in states),
        tuple(state.over_constrained for state in states),
        *(numbers_of(each) for each in zip(*parts, strict=True)),
    )


def _row(
    measures: Measures, rest: State, state: State, drive: tuple[int, str], is_locked: bool
) -> list[Numbers]:
    """Stiffness, what is kept of it in the worst direction, of the drive, force, frequencies."""

    def own(one: State) -> FloatArray:
        """(1,) stiffness of the driven coordinate itself; infinite where it is held."""
        if is_locked:
            return np.zeros(1)
        node, name = drive
        points = one.model.points
        names = [points.name(each) for each in points.coordinates(points.of(node))]
        value = one.compliance(node)[(names.index(name),) * 2]
        return np.array([1.0 / value if value != 0.0 else np.inf])

    made = [
        over_levels(measures.stiffness, state),
        over_levels(measures.worst, rest, state),
        over_levels(own, state),
        over_levels(lambda one: np.atleast_1d(one.force), state),
    ]
    if measures.has_masses:
        made.append(over_levels(measures.frequencies, state))
    return made


Report = Callable[[str, float], None]
#: Parts of the work of a design that its tolerances, curve, stroke and effect are.
_TOLERANCES, _CURVE, _STROKE = 0.4, 0.5, 0.9
#: Values that agree to so many digits are equal.
_DIGITS = 6
#: From so many beams a sheet on, tolerances are right to some percent (stiffness of thin sheets to
#: lateral buckling hangs on what happens between elements).
ENOUGH = 8
#: How far off one beam a sheet was found to be.
_OPTIMISTIC = 80

Made = TypeVar("Made", bound=CostValues)


def compute(
    data: ModelData,
    asked: Request,
    name: str | None,
    progress: Report | None,
    kind: type[Made],
) -> Made:
    """What a design costs; see `flexact.cost`."""
    data.require_sound()
    if not data.has_stiffness:
        raise model_error(
            "no-stiffness",
            "what it costs needs stiffness, and the model gives none",
            "state ESTIFF for each flexible element behind the END of the kinematics (of a beam "
            "EA, G It, E Iy, E Iz), or give sheets a material in Python",
        )
    report = progress or (lambda _what, _done: None)
    report("analysing", 0.0)
    return _Computation(data, asked, name, report).cost(kind)


class _Computation:
    """What a cost is computed of: the model, what is asked, and what is measured where."""

    def __init__(self, data: ModelData, asked: Request, name: str | None, report: Report) -> None:
        self.data, self.asked, self.report = data, asked, report
        self.result: Result = result_of(data, asked_for("auto", None), name)
        self.places = Places(data, self.result.parts)
        self.point = self.places.point(asked.at)
        self.clamps = self.places.clamps()
        self.stroke = stroke_of(self.places, asked)
        self.given = given_of(self.places, asked)
        drives = self.places.drives()
        model = elastic(Model.from_data(data), asked.held, asked.drive, (), asked.beams)
        model = replace(model, is_si=True)
        points = model.points
        directions = tuple(map(points.name, points.coordinates(points.of(self.point.node))))
        watched = data.node_index[drives[0][0] if drives else self.point.node]
        self.built = ElasticDesign(model, watched)
        self.strength = strength_of(self.places, asked, self.stroke)
        # What has none is told before anything is computed.
        self._strengths(self.built)
        self.measures = Measures(self.point, directions, data.size, drives, self.built.has_masses)

    def cost(self, kind: type[Made]) -> Made:
        """All of it, as a kind of cost."""
        asked = self.asked
        built, candidates = self.built, self._candidates()
        misalignments = self.places.misalignments()
        designs: list[Design] = []
        ways: list[Reached] = []
        for k, candidate in enumerate(candidates):
            mechanism = with_release(built, candidate.pairs) if k else built

            def part(done: float, before: int = k) -> None:
                label = _label(candidates[before].released)
                self.report(label or "as built", (before + done) / len(candidates))

            part(0.0)
            design, way = self._design(mechanism, candidate, misalignments, part)
            designs.append(with_curve(design, mechanism, designs[0] if designs else design))
            ways += [] if way is None else [way]
        return kind(
            self.data,
            self.result.name,
            tuple(designs),
            self.point,
            self.measures.directions,
            self.clamps,
            FREQUENCY if self.measures.has_masses else STIFFNESS,
            asked.shift,
            asked.held,
            asked.drive,
            asked.beams,
            self._stroke(ways),
            self.given,
            tuple(self._left_out(len(designs))),
            self.strength,
        )

    def _strengths(self, mechanism: ElasticDesign) -> Strengths | None:
        """With what the stress is compared; None where no strength is asked for.

        Raises:
            ModelError: a part has none, or its section is not known.
        """
        if self.strength is None:
            return None
        try:
            return mechanism.elastic.strengths(self.strength.against)
        except ElasticError as error:
            raise model_error("no-strength", str(error)) from None

    def _candidates(self) -> tuple[Candidate, ...]:
        """What is to be looked at: the design as built first."""
        asked = self.asked
        first = Candidate((), (), self.result.under_constrained, self.result.over_constrained)
        if asked.release is not None:
            others = tuple(given(self.result, each) for each in asked.release)
            labels = [each.pairs for each in others]
            if any(pairs in labels[:k] for k, pairs in enumerate(labels)):
                raise model_error("repeated-release", "one release is asked for twice")
            return first, *others
        self.report("looking for releases", 0.0)
        return first, *best(self.measures, self.built, proven(self.result, asked.bodies))

    def _design(
        self,
        mechanism: ElasticDesign,
        candidate: Candidate,
        misalignments: tuple[Misalignment, ...],
        progress: Callable[[float], None],
    ) -> tuple[Design, Reached | None]:
        """A design but for its curve, and how far it was followed along the stroke.

        What has no answer is a remark.
        """
        measures, remarks = self.measures, list[str]()
        strengths = self._strengths(mechanism)
        frequencies, is_drive = frequencies_of(measures, mechanism)
        tolerances: tuple[Tolerance, ...] = ()
        try:
            tolerances = tolerances_of(
                *(mechanism, misalignments, self.asked.shift, measures.size),
                lambda done: progress(_TOLERANCES * done),
            )
        except ElasticError as error:
            remarks.append(f"No tolerances: {error}.")
        curve = way = effect = limits = None
        if self.stroke is not None:
            asked, values = self.stroke
            way = follow(mechanism.elastic, asked, values)
            drive = (asked.node, asked.coordinate)
            curve = curve_of(
                *(measures, mechanism.rest, way, drive, mechanism.elastic.drive == "locked"),
                lambda done: progress(_CURVE + (_STROKE - _CURVE) * done),
                strengths,
            )
        if (wanted := self.strength) is not None:
            how = wanted.share, wanted.support, wanted.against, "locked"
            try:
                limits = mechanism.elastic.limits(wanted.node, wanted.coordinate, *how)
            except ElasticError as error:
                remarks.append(f"How far it may go: {error}.")
        if self.given:
            try:
                effect = effect_of(mechanism, measures, self.given, self.result.parts, strengths)
            except ElasticError as error:
                remarks.append(f"Misaligned: {error}.")
        design = Design(
            candidate.released,
            candidate.alike,
            candidate.under_constrained,
            candidate.over_constrained,
            over_levels(measures.compliance, mechanism.rest),
            None if mechanism is self.built else kept_beside(measures, self.built, mechanism),
            frequencies,
            is_drive,
            tolerances,
            measures.size,
            stroke=curve,
            effect=effect,
            remarks=tuple(remarks),
            limits=limits,
            safeties=safeties_of(mechanism, tolerances, strengths) if strengths else (),
        )
        shapes = shapes_of(mechanism, frequencies, is_drive, design.buckles_at)
        return replace(design, shapes=tuple(shapes)), way

    def _stroke(self, ways: Sequence[Reached]) -> Stroke | None:
        """The stroke as far as every design could be followed; None where none was asked for."""
        if self.stroke is None:
            return None
        stroke, _ = self.stroke
        why = next((why for *_, why in ways if why), "")
        if not why:
            return stroke
        low = max(stroke.asked[0], *(ends[0] for _, _, ends, _ in ways))
        high = min(stroke.asked[1], *(ends[1] for _, _, ends, _ in ways))
        return replace(stroke, reached=(low, high), why=why)

    def _left_out(self, designs: int) -> Iterator[str]:
        """What the deck's data do not allow, and what was not looked at."""
        asked, result = self.asked, self.result
        if isinstance(asked.beams, int) and asked.beams < ENOUGH:
            yield (
                "with so few beams a sheet tolerances come out too large, with one up to "
                f'{_OPTIMISTIC} times: --beams auto (beams="auto") refines by itself and shows '
                "what is left open"
            )
        if not self.measures.has_masses:
            yield (
                "no masses are given (EM, XM): there are no frequencies, and tolerances are those "
                "for a shift of the lowest stiffness of the driven point"
            )
        elif not self.measures.drives and asked.drive == "free":
            yield (
                "no coordinate is declared (DYNX): no frequency is known to be the drive's, and "
                "all of them count as parasitic"
            )
        if result.over_constrained and asked.release is None and designs == 1:
            yield "no proven release was found; name one with --release (release=)"
        whole = result.with_internal_declared or result
        if whole.under_constrained:
            yield (
                f"under-constrained by {whole.under_constrained} as declared; what is elastic may "
                "hold these motions all the same"
            )
        yield from self._stiff_waists()

    def _stiff_waists(self) -> Iterator[str]:
        """Bending that is released at one end of a beam alone, and stiff there all the same."""
        arrays, stiff = self.data.arrays, self.built.elastic.policy.stiff
        classes, roles = arrays.deformation_class, role_table()[arrays.element_kind].T
        ends = np.isin(roles, tuple(AT_P)), np.isin(roles, tuple(AT_Q))
        # Both ends of a bending stand behind each other.
        held, free = classes == Class.FIXED, (classes == Class.DEPENDENT) & stiff
        at_p, at_q = np.zeros_like(free), np.zeros_like(free)
        at_p[:-1] = ends[0][:-1] & free[:-1] & held[1:]
        at_q[1:] = ends[1][1:] & free[1:] & held[:-1]
        found = np.argwhere((at_p | at_q).T).tolist()
        if found:
            numbers = [(int(arrays.element_number[e]), k + 1) for e, k in found]
            every = "+".join(f"{element}:{number}" for element, number in numbers)
            yield (
                f"{_one(self.result, *numbers[0], 0.0).words} is released, and as stiff as ESTIFF "
                f"has it all the same: --release {every} (release=) shows what a waist does"
            )


def with_release(design: ElasticDesign, release: dict[tuple[int, int], float]) -> ElasticDesign:
    """The same with something released."""
    return replace(design, elastic=replace(design.elastic, release=release))


def frequencies_of(
    measures: Measures, mechanism: ElasticDesign
) -> tuple[Numbers | None, tuple[bool, ...]]:
    """The lowest frequencies at rest, and which are the drive's."""
    if not measures.has_masses:
        return None, ()
    found = over_levels(measures.frequencies, mechanism.rest)
    if not found.value.size:
        return None, ()
    if mechanism.elastic.drive == "locked":
        return found, (False,) * found.value.size
    return found, drives_of(measures, mechanism.rest, found.value.size)


def kept_beside(measures: Measures, before: ElasticDesign, after: ElasticDesign) -> Kept | None:
    """What a design keeps of the stiffness of the one as built; None where nothing can move."""
    one, two = before.rest, after.rest
    finest, loads, shares = measures.ratios(one.alone[-1], two.alone[-1])
    if not finest.size:
        return None
    mu = over_levels(lambda a, b: measures.ratios(a, b)[0], one, two)
    return Kept(mu, loads[:, 0], direction_words(shares[:, 0], measures.directions))


def best(
    measures: Measures, built: ElasticDesign, candidates: Sequence[Candidate]
) -> tuple[Candidate, ...]:
    """The best at most: by the worst stiffness kept, then the lowest frequency kept.

    Of those that are equal in both that with the higher first parasitic frequency, then the
    likelier one. One beam an element is enough to tell: the stiffness of a straight sheet is exact
    with it.
    """
    one = replace(built, elastic=replace(built.elastic, beams=1))

    def order(candidate: Candidate) -> list[float]:
        mechanism = with_release(one, candidate.pairs)
        kept = kept_beside(measures, one, mechanism)
        worst = 1.0 if kept is None else kept.smallest.value
        found, drives = frequencies_of(measures, mechanism)
        hertz = () if found is None else tuple(found.value.tolist())
        parasitic = [f for f, is_drive in zip(hertz, drives, strict=False) if not is_drive]
        found_of = (worst, *hertz[:1], *parasitic[:1])
        return [-float(f"{value:.{_DIGITS}g}") for value in found_of]

    return tuple(sorted(candidates, key=order)[:MOST])


def with_curve(design: Design, mechanism: ElasticDesign, built: Design) -> Design:
    """With the first frequency against the misalignment that matters most as built."""
    matters = built.tightest or built.buckles_at
    if matters is None:
        return design
    mine = next(
        (each for each in design.tolerances if each.misalignment == matters.misalignment), None
    )
    critical = matters.critical
    reach = critical.value if critical.is_finite else 4.0 * matters.tightest.value
    if mine is None or not np.isfinite(reach):
        return design
    return replace(design, curve=curve_against(mechanism, mine, reach))
