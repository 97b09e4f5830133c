# SPDX-License-Identifier: BSD-3-Clause
"""What a design costs: the designs to compare, and what is computed of each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from ..advice.releases.releases import releases_of
from ..advice.step import tried
from ..analysis.change import Change
from ..analysis.decomposition import asked_for
from ..analysis.locate import deformations_of
from ..analysis.naming import deformation_in_words, plain
from ..analysis.places import deformation_word, part_words
from ..analysis.result import Result, result_of
from ..core.arrays import FloatArray
from ..core.elements import Class, Member, member_table
from ..deck.rendering import model_error
from ..elasticity import ElasticError, Estimate, State, StrokeError
from ..model.data import ModelData
from ..model.parts.parts import Parts
from ..util.errors import FlexactError
from . import stroke as strokes
from .designs import (
    FREQUENCY,
    STIFFNESS,
    CostValues,
    Design,
    Effect,
    Kept,
    Misalignment,
    Numbers,
    Released,
    Stroke,
    Tolerance,
    in_words,
    stacked,
    words_of_direction,
)
from .elastic_design import (
    Choice,
    ElasticDesign,
    Measures,
    drives_of,
    has_masses,
    kept_of,
    number,
    numbers,
    over_levels,
    require_stiffness,
)
from .request import ReleaseRequest, Request
from .resolve import Places, directions_of, given_of, stroke_of
from .shape import Shape, unit_mode
from .stroke import Reached
from .tolerances import curve_against, tolerances_of

#: How many proven releases stand beside the design as built, and how many are measured for that.
MOST, LOOKED_AT = 5, 12


class Candidate(NamedTuple):
    """A design: what is released, and what the analysis says of it."""

    released: tuple[Released, ...]
    alike: tuple[str, ...]
    under_constrained: int
    over_constrained: int

    @property
    def pairs(self) -> ReleaseRequest:
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
    sets = releases_of(result, with_bodies=bodies).sets
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


def given(result: Result, asked: ReleaseRequest) -> Candidate:
    """A design that is asked for.

    Raises:
        ModelError: there is no such element or deformation.
    """
    numbers = result.given.arrays.element_number
    pairs = {
        (int(numbers[element]), k + 1): notch
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
    return Released(element, number, notch, words)


def _label(released: tuple[Released, ...]) -> str:
    return "+".join(each.label for each in released)


Given = Sequence[tuple[Misalignment, float]]
#: How often the part of an error that can be reached is halved.
_HALVINGS = 12


def effect_of(mechanism: ElasticDesign, measures: Measures, given: Given, parts: Parts) -> Effect:
    """Before and behind misalignments that act together.

    Where no equilibrium is found with all of them, they are taken in proportion as far as one is.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts, or nothing of it was
            reached.
    """
    behind, reached = _behind(mechanism, given)
    both = (mechanism.rest, behind)

    def found(quantity: Callable[[State], FloatArray]) -> Numbers:
        return stacked([numbers(over_levels(quantity, each)) for each in both])

    kept = over_levels(measures.worst, *both)
    peak, where = _peaks(mechanism, both)
    hertz = found(measures.frequencies) if measures.has_masses else None
    return Effect(
        hertz if hertz is not None and hertz.value.size else None,
        found(measures.stiffness),
        found(lambda state: np.array([state.energy])).column(0),
        # Largest normal force [N], torque and bending moment [N m] of any element.
        found(lambda state: np.asarray(np.abs(_of_elements(state)).max(axis=0))),
        peak,
        part_words(parts.of_element(where)),
        number(Estimate(kept.value[0], kept.uncertainty[0])),
        all(each.is_stable for each in behind.alone),
        reached,
    )


def _behind(mechanism: ElasticDesign, given: Given) -> tuple[State, float]:
    """The state with the misalignments, or with the largest part of them that is found."""

    def with_part(part: float) -> State:
        off = [(each.clamp.node, each.direction, part * value, each.about) for each, value in given]
        return mechanism.elastic.imperfect(misaligned=off, beyond=True).assembled()

    part, why = 1.0, None
    for _ in range(_HALVINGS):
        try:
            return with_part(part), part
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
    known = _known(both[1])
    if not known:
        sizes = np.abs(_of_elements(both[1]))
        moment = sizes[:, 1:].max(axis=1)
        column = moment if moment.any() else sizes[:, 0]
        return None, int(np.argmax(column))
    found = [
        numbers(over_levels(lambda s: np.array([s.peak_stress(e) for e in known]), each))
        for each in both
    ]
    most = [int(np.argmax(each.value)) for each in found]
    peak = Numbers(
        np.array([each.value[k] for each, k in zip(found, most, strict=True)]),
        np.array([each.uncertainty[k] for each, k in zip(found, most, strict=True)]),
    )
    return peak, mechanism.data.element_index[known[most[1]]]


def _known(state: State) -> list[int]:
    """Numbers of the elements whose section is known and that carry something."""
    made = []
    finest = state.alone[-1]
    for element in state.model.data.arrays.element_number.tolist():
        try:
            finest.peak_stress(element)
        except ElasticError:
            continue
        if finest.model.policy.stiff[:, finest.model.data.element_index[element]].any():
            made.append(element)
    return made


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
    return Shape(kind, words, value, rest.data, rest.configuration, unit_mode(rest.data, mode))


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
    require_stiffness(data)
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
        self.measures = Measures(
            self.point,
            directions_of(data, self.point),
            self.places.size,
            self.places.drives(),
            has_masses(data),
        )

    def cost(self, kind: type[Made]) -> Made:
        """All of it, as a kind of cost."""
        asked = self.asked
        built, candidates = self._candidates()
        misalignments = self.places.misalignments()
        designs: list[Design] = []
        ways: list[Reached] = []
        for k, candidate in enumerate(candidates):
            mechanism = built if k == 0 else built.released(candidate.pairs)

            def part(done: float, before: int = k) -> None:
                label = _label(candidates[before].released)
                self.report(label or "as built", (before + done) / len(candidates))

            part(0.0)
            design, way = self._design(built, mechanism, candidate, misalignments, part)
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
        )

    def _candidates(self) -> tuple[ElasticDesign, tuple[Candidate, ...]]:
        """The design as built, and what is to be looked at: as built first."""
        asked = self.asked
        driven = self.measures.drives
        watched = self.data.node_index[driven[0][0] if driven else self.point.node]
        choice = Choice(asked.held, asked.drive, asked.beams)
        built = ElasticDesign(self.data, choice, {}, watched)
        first = Candidate((), (), self.result.under_constrained, self.result.over_constrained)
        if asked.release is not None:
            others = tuple(given(self.result, each) for each in asked.release)
            labels = [each.pairs for each in others]
            if any(pairs in labels[:k] for k, pairs in enumerate(labels)):
                raise model_error("repeated-release", "one release is asked for twice")
            return built, (first, *others)
        self.report("looking for releases", 0.0)
        return built, (first, *best(self.measures, built, proven(self.result, asked.bodies)))

    def _design(
        self,
        built: ElasticDesign,
        mechanism: ElasticDesign,
        candidate: Candidate,
        misalignments: tuple[Misalignment, ...],
        progress: Callable[[float], None],
    ) -> tuple[Design, Reached | None]:
        """A design but for its curve, and how far it was followed along the stroke.

        What has no answer is a remark.
        """
        measures, remarks = self.measures, list[str]()
        frequencies, is_drive = frequencies_of(measures, mechanism)
        tolerances: tuple[Tolerance, ...] = ()
        try:
            tolerances = tolerances_of(
                *(mechanism, misalignments, self.asked.shift, measures.size),
                lambda done: progress(_TOLERANCES * done),
            )
        except ElasticError as error:
            remarks.append(f"No tolerances: {error}.")
        curve = way = effect = None
        if self.stroke is not None:
            way = strokes.follow(mechanism.elastic, self.stroke)
            drive = (self.stroke.node, self.stroke.coordinate)
            curve = strokes.curve_of(
                *(measures, mechanism.rest, way, drive, mechanism.choice.drive == "locked"),
                lambda done: progress(_CURVE + (_STROKE - _CURVE) * done),
            )
        if self.given:
            try:
                effect = effect_of(mechanism, measures, self.given, self.result.parts)
            except ElasticError as error:
                remarks.append(f"Misaligned: {error}.")
        design = Design(
            candidate.released,
            candidate.alike,
            candidate.under_constrained,
            candidate.over_constrained,
            numbers(mechanism.rest.estimate(measures.compliance)),
            None if mechanism is built else kept_beside(measures, built, mechanism),
            frequencies,
            is_drive,
            tolerances,
            measures.size,
            stroke=curve,
            effect=effect,
            remarks=tuple(remarks),
        )
        shapes = shapes_of(mechanism, frequencies, is_drive, design.buckles_at)
        return replace(design, shapes=tuple(shapes)), way

    def _stroke(self, ways: Sequence[Reached]) -> Stroke | None:
        """The stroke as far as every design could be followed; None where none was asked for."""
        asked = self.stroke
        if asked is None:
            return None
        owner = self.places.words(asked.node)
        words = f"node {asked.node} ({owner}) {words_of_direction(asked.coordinate)}"
        whole = (float(asked.values[0]), float(asked.values[-1]))
        low = max((way.ends[0] for way in ways), default=whole[0])
        high = min((way.ends[1] for way in ways), default=whole[1])
        why = next((way.why for way in ways if way.why), "")
        reached = (max(low, whole[0]), min(high, whole[1])) if why else whole
        return Stroke(asked.node, asked.coordinate, words, asked.rest, whole, reached, why)

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


def frequencies_of(
    measures: Measures, mechanism: ElasticDesign
) -> tuple[Numbers | None, tuple[bool, ...]]:
    """The lowest frequencies at rest, and which are the drive's."""
    if not measures.has_masses:
        return None, ()
    found = numbers(over_levels(measures.frequencies, mechanism.rest))
    if not found.value.size:
        return None, ()
    if mechanism.choice.drive == "locked":
        return found, (False,) * found.value.size
    return found, drives_of(measures, mechanism.rest, found.value.size)


def kept_beside(measures: Measures, before: ElasticDesign, after: ElasticDesign) -> Kept | None:
    """What a design keeps of the stiffness of the one as built."""
    one, two = before.rest, after.rest
    finest = measures.ratios(one.alone[-1], two.alone[-1])
    mu = numbers(over_levels(lambda a, b: measures.ratios(a, b).mu, one, two))
    return kept_of(finest, mu, measures.directions)


def best(
    measures: Measures, built: ElasticDesign, candidates: Sequence[Candidate]
) -> tuple[Candidate, ...]:
    """The best at most: by the worst stiffness kept, then the lowest frequency kept.

    Of those that are equal in both that with the higher first parasitic frequency, then the
    likelier one. One beam an element is enough to tell: the stiffness of a straight sheet is exact
    with it.
    """
    keys = {}
    one = built.with_beams(1)
    for place, candidate in enumerate(candidates):
        mechanism = one.released(candidate.pairs)
        kept = kept_beside(measures, one, mechanism)
        worst = 1.0 if kept is None else kept.smallest.value
        found, drives = frequencies_of(measures, mechanism)
        hertz = () if found is None else tuple(found.value.tolist())
        parasitic = [f for f, is_drive in zip(hertz, drives, strict=False) if not is_drive]
        order = (worst, *hertz[:1], *parasitic[:1])
        keys[place] = (*(-float(f"{value:.{_DIGITS}g}") for value in order), place)
    return tuple(candidates[place] for place in sorted(keys, key=keys.__getitem__)[:MOST])


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
