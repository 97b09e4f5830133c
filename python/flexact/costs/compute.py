# SPDX-License-Identifier: BSD-3-Clause
"""What given misalignments do to a design, with all of the nonlinearity."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from ..advice.releases.releases import releases_of
from ..advice.step import tried
from ..analysis.change import Change
from ..analysis.deformation_words import deformation_word
from ..analysis.locate import deformations_of
from ..analysis.naming import deformation_in_words, plain
from ..analysis.places import part_words
from ..analysis.result import Result, result_of
from ..analysis.spaces import asked_for
from ..core.arrays import FloatArray
from ..core.elements import Class, Member, NodeKind, member_table
from ..deck.rendering import model_error
from ..elasticity import ElasticError, Estimate, State, StrokeError
from ..model.data import ModelData
from ..model.parts.parts import Parts
from ..util.errors import FlexactError
from ..util.records import cached_property
from . import along
from .along import Along
from .along import Asked as StrokeValues
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
    Tolerance,
    in_words,
    words_of_direction,
)
from .elastic_design import (
    Bench,
    Choice,
    Measures,
    drives_of,
    has_masses,
    kept_of,
    number,
    numbers,
    over_levels,
    require_stiffness,
)
from .request import Asked, ReleaseAsked
from .resolve import Places, directions_of, given_of, stroke_of
from .shape import Shape
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
    def pairs(self) -> ReleaseAsked:
        """As the elastic model takes it."""
        return {(each.element, each.deformation): each.notch for each in self.released}


def as_built(result: Result) -> Candidate:
    """Nothing is released."""
    return Candidate((), (), result.under_constrained, result.over_constrained)


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
    of_members = [each for each in sets if not _releases_a_link(result, each.change)]
    for proposal in (of_members or sets)[:LOOKED_AT]:
        alike = tuple(_label(_released(result, change)) for change in proposal.alternatives)
        after = proposal.after
        released = _released(result, proposal.change)
        made.append(Candidate(released, alike, after.under_constrained, after.over_constrained))
    return tuple(made)


def _releases_a_link(result: Result, change: Change) -> bool:
    index, kinds = result.given.element_index, result.given.arrays.element_kind
    members = member_table()[[kinds[index[element]] for element, *_ in change.deformations]]
    return bool((members == Member.LINK).any())


def given(result: Result, asked: ReleaseAsked) -> Candidate:
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


def effect_of(bench: Bench, measures: Measures, given: Given, parts: Parts) -> Effect:
    """Before and behind misalignments that act together.

    Where no equilibrium is found with all of them, they are taken in proportion as far as one is.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts, or nothing of it was
            reached.
    """
    behind, reached = _behind(bench, given)
    both = (bench.rest, behind)
    kept = over_levels(measures.worst, *both)
    carried = [numbers(over_levels(_largest, each)) for each in both]
    peak, where = _peaks(bench, both)
    hertz = None
    if measures.has_masses:
        hertz = _both([numbers(over_levels(measures.frequencies, each)) for each in both])
    return Effect(
        hertz if hertz is not None and hertz.value.size else None,
        _both([numbers(over_levels(measures.stiffness, each)) for each in both]),
        _first([numbers(over_levels(lambda s: np.array([s.energy]), each)) for each in both]),
        _both(carried),
        peak,
        part_words(parts.of_element(where)),
        number(Estimate(kept.value[0], kept.uncertainty[0])),
        all(each.is_stable for each in behind.alone),
        reached,
    )


def _behind(bench: Bench, given: Given) -> tuple[State, float]:
    """The state with the misalignments, or with the largest part of them that is found."""

    def with_part(part: float) -> State:
        off = [(each.clamp.node, each.direction, part * value, each.about) for each, value in given]
        return bench.elastic.imperfect(misaligned=off, beyond=True).assembled()

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


def _largest(state: State) -> FloatArray:
    """(3,) largest normal force [N], torque and bending moment [N m] of any element, in size."""
    made: FloatArray = np.abs(_of_elements(state)).max(axis=0)
    return made


def _of_elements(state: State) -> FloatArray:
    """(elements, 3) normal force, torque and largest bending moment."""
    rows = []
    for element in state.model.data.arrays.element_number.tolist():
        own = state.resultants(element)
        bending = max(np.abs(own.moment_y).max(), np.abs(own.moment_z).max())
        rows.append((own.normal_force, own.torque, bending))
    return np.array(rows)


def _peaks(bench: Bench, both: Sequence[State]) -> tuple[Numbers | None, int]:
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
    index = bench.data.element_index[known[int(np.argmax(found[1].value))]]
    best = [int(np.argmax(each.value)) for each in found]
    peak = Numbers(
        np.array([each.value[k] for each, k in zip(found, best, strict=True)]),
        np.array([each.uncertainty[k] for each, k in zip(found, best, strict=True)]),
    )
    return peak, index


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


def _both(rows: Sequence[Numbers]) -> Numbers:
    """(2, k) of two rows, as long as the shorter one."""
    count = min(row.value.size for row in rows)
    return Numbers(
        np.array([row.value[:count] for row in rows]),
        np.array([row.uncertainty[:count] for row in rows]),
    )


def _first(rows: Sequence[Numbers]) -> Numbers:
    """(2,) of two rows with one number."""
    both = _both(rows)
    return Numbers(both.value[:, 0], both.uncertainty[:, 0])


#: How many parasitic frequencies are shown.
_MOST = 2


def shapes_of(
    bench: Bench,
    frequencies: Numbers | None,
    is_drive: tuple[bool, ...],
    buckles: Tolerance | None,
) -> Iterator[Shape]:
    """The drive's and the first parasitic modes, and the shape in which it buckles first."""
    if frequencies is not None:
        chosen = [k for k, drives in enumerate(is_drive) if drives][:1]
        chosen += [k for k, drives in enumerate(is_drive) if not drives][:_MOST]
        for k in chosen:
            hertz = Number(*(float(side[k]) for side in frequencies))
            kind = "frequency of the drive" if is_drive[k] else "parasitic frequency"
            words = f"{kind}, {in_words(hertz, 'Hz')}"
            yield _shape(bench, "vibrating", words, hertz.value, bench.rest.modes[k])
    if buckles is not None:
        size, unit = buckles.critical, buckles.misalignment.unit
        sense = -1.0 if buckles.critical.value == -buckles.critical_negative.value else 1.0
        words = f"buckles with {buckles.misalignment.words} off by {in_words(size, unit)}"
        mode = bench.levels[-1].buckled(buckles.misalignment, sense)
        if mode is not None:
            yield _shape(bench, "buckled", words, sense * size.value, mode)


def _shape(bench: Bench, kind: str, words: str, value: float, mode: FloatArray) -> Shape:
    data, configuration = bench.rest.data, bench.rest.configuration
    return Shape(kind, words, value, data, configuration, _unit(data, mode))


def _unit(data: ModelData, mode: FloatArray) -> FloatArray:
    """(nodes, 3) with the largest displacement 1, or rotation where only rotations move."""
    places = data.arrays.node_kind <= NodeKind.POSITION
    size = np.linalg.norm(mode[places], axis=1).max(initial=0.0)
    size = size if size > 1e-9 * np.abs(mode).max(initial=0.0) else np.abs(mode).max(initial=0.0)
    return mode / size if size > 0.0 else mode.copy()


Progress = Callable[[float], None]
Report = Callable[[str, float], None]
#: Parts of the work of a design that its tolerances, curve, stroke and effect are.
_TOLERANCES, _CURVE, _STROKE = 0.4, 0.5, 0.9


class Wanted(NamedTuple):
    """What is to be found of each design."""

    measures: Measures
    parts: Parts
    misalignments: tuple[Misalignment, ...]
    shift: float
    stroke: along.Asked | None
    given: tuple[tuple[Misalignment, float], ...]
    """Misalignments that act together."""


def kept_beside(measures: Measures, before: Bench, after: Bench) -> Kept | None:
    """What a design keeps of the stiffness of the one as built."""
    one, two = before.rest, after.rest
    finest = measures.ratios(one.alone[-1], two.alone[-1])
    mu = numbers(over_levels(lambda a, b: measures.ratios(a, b).mu, one, two))
    return kept_of(finest, mu, measures.directions)


def frequencies_of(measures: Measures, bench: Bench) -> tuple[Numbers | None, tuple[bool, ...]]:
    """The lowest frequencies at rest, and which are the drive's."""
    if not measures.has_masses:
        return None, ()
    found = numbers(over_levels(measures.frequencies, bench.rest))
    if not found.value.size:
        return None, ()
    if bench.choice.drive == "locked":
        return found, (False,) * found.value.size
    return found, drives_of(measures, bench.rest, found.value.size)


def design_of(
    wanted: Wanted, built: Bench, bench: Bench, candidate: Candidate, progress: Progress
) -> tuple[Design, along.Along | None]:
    """A design but for its curve, and how far it was followed along the stroke.

    What has no answer is a remark.
    """
    measures, remarks = wanted.measures, list[str]()
    frequencies, is_drive = frequencies_of(measures, bench)
    tolerances: tuple[Tolerance, ...] = ()
    try:
        tolerances = tolerances_of(
            *(bench, wanted.misalignments, wanted.shift, measures.size),
            lambda done: progress(_TOLERANCES * done),
        )
    except ElasticError as error:
        remarks.append(f"No tolerances: {error}.")
    design = Design(
        candidate.released,
        candidate.alike,
        candidate.under_constrained,
        candidate.over_constrained,
        numbers(bench.rest.estimate(measures.compliance)),
        None if bench is built else kept_beside(measures, built, bench),
        frequencies,
        is_drive,
        tolerances,
        measures.size,
    )
    way = None
    if wanted.stroke is not None:
        way = along.follow(bench.elastic, wanted.stroke)
        drive = (wanted.stroke.node, wanted.stroke.coordinate)
        curve = along.curve_of(
            *(measures, bench.rest, way, drive, bench.choice.drive == "locked"),
            lambda done: progress(_CURVE + (_STROKE - _CURVE) * done),
        )
        design = replace(design, stroke=curve)
    if wanted.given:
        try:
            design = replace(design, effect=effect_of(bench, measures, wanted.given, wanted.parts))
        except ElasticError as error:
            remarks.append(f"Misaligned: {error}.")
    shapes = tuple(shapes_of(bench, frequencies, is_drive, design.buckles_at))
    return replace(design, shapes=shapes, remarks=tuple(remarks)), way


def with_curve(design: Design, bench: Bench, built: Design) -> Design:
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
    return replace(design, curve=curve_against(bench, mine, reach))


#: Values that agree to so many digits are equal.
_DIGITS = 6


def best(
    measures: Measures, built: Bench, candidates: Sequence[Candidate]
) -> tuple[Candidate, ...]:
    """The best at most: by the worst stiffness kept, then the lowest frequency kept.

    Of those that are equal in both that with the higher first parasitic frequency, then the
    likelier one. One beam an element is enough to tell: the stiffness of a straight sheet is exact
    with it.
    """
    keys = {}
    one = built.with_beams(1)
    for place, candidate in enumerate(candidates):
        bench = one.released(candidate.pairs)
        kept = kept_beside(measures, one, bench)
        worst = 1.0 if kept is None else kept.smallest.value
        found, drives = frequencies_of(measures, bench)
        hertz = () if found is None else tuple(found.value.tolist())
        parasitic = [f for f, is_drive in zip(hertz, drives, strict=False) if not is_drive]
        order = (worst, *hertz[:1], *parasitic[:1])
        keys[place] = (*(-float(f"{value:.{_DIGITS}g}") for value in order), place)
    return tuple(candidates[place] for place in sorted(keys, key=keys.__getitem__)[:MOST])


#: From so many beams a sheet on, tolerances are right to some percent (stiffness of thin sheets to
#: lateral buckling hangs on what happens between elements).
ENOUGH = 8
#: How far off one beam a sheet was found to be.
_OPTIMISTIC = 80


def stroke_in_words(
    places: Places, values: StrokeValues | None, asked: Asked, ways: Sequence[Along]
) -> Stroke | None:
    """The stroke as far as every design could be followed; None where none was asked for."""
    if values is None:
        return None
    owner = places.words(values.node)
    words = f"node {values.node} ({owner}) {words_of_direction(values.coordinate)}"
    whole = (float(values.values[0]), float(values.values[-1]))
    low = max((way.ends[0] for way in ways), default=whole[0])
    high = min((way.ends[1] for way in ways), default=whole[1])
    why = next((way.why for way in ways if way.why), "")
    reached = (max(low, whole[0]), min(high, whole[1])) if why else whole
    return Stroke(values.node, values.coordinate, words, values.rest, whole, reached, why)


def left_out(
    places: Places,
    measures: Measures,
    asked: Asked,
    result: Result,
    designs: Sequence[Design],
) -> tuple[str, ...]:
    """What the deck's data do not allow, and what was not looked at."""
    made = []
    if isinstance(asked.beams, int) and asked.beams < ENOUGH:
        made.append(
            f"with so few beams a sheet tolerances come out too large, with one up to "
            f'{_OPTIMISTIC} times: --beams auto (beams="auto") refines by itself and shows what is '
            "left open"
        )
    if not measures.has_masses:
        made.append(
            "no masses are given (EM, XM): there are no frequencies, and tolerances are those for "
            "a shift of the lowest stiffness of the driven point"
        )
    elif not measures.drives and asked.drive == "free":
        made.append(
            "no coordinate is declared (DYNX): no frequency is known to be the drive's, and all of "
            "them count as parasitic"
        )
    if result.over_constrained and asked.release is None and len(designs) == 1:
        made.append("no proven release was found; name one with --release (release=)")
    whole = result.with_internal_declared or result
    if whole.under_constrained:
        made.append(
            f"under-constrained by {whole.under_constrained} as declared; what is elastic may "
            "hold these motions all the same"
        )
    return tuple(made)


Made = TypeVar("Made", bound=CostValues)


def cost_of(
    data: ModelData,
    asked: Asked,
    name: str | None,
    progress: Report | None,
    kind: type[Made],
) -> Made:
    """What a design costs; see `flexact.cost`."""
    data.require_sound()
    require_stiffness(data)
    report = progress or (lambda _what, _done: None)
    report("analysing", 0.0)
    return _Making(data, asked, name, report).made(kind)


class _Making:
    """One cost in the making."""

    def __init__(self, data: ModelData, asked: Asked, name: str | None, report: Report) -> None:
        self.data, self.asked, self.report = data, asked, report
        self.result: Result = result_of(data, asked_for("auto", None), name)
        self.places = Places(data, self.result.parts)
        self.point = self.places.point(asked.at)
        self.clamps = self.places.clamps()
        self.stroke = stroke_of(self.places, asked)
        self.given = given_of(self.places, asked)

    def made(self, kind: type[Made]) -> Made:
        designs, ways = self._designs()
        return kind(
            self.data,
            self.result.name,
            designs,
            self.point,
            self.measures.directions,
            self.clamps,
            FREQUENCY if self.measures.has_masses else STIFFNESS,
            self.asked.shift,
            self.asked.held,
            self.asked.drive,
            self.asked.beams,
            stroke_in_words(self.places, self.stroke, self.asked, ways),
            self.given,
            left_out(self.places, self.measures, self.asked, self.result, designs),
        )

    @cached_property
    def measures(self) -> Measures:
        """What is measured, and where."""
        return Measures(
            self.point,
            directions_of(self.data, self.point),
            self.places.size,
            self.places.drives(),
            has_masses(self.data),
        )

    def _designs(self) -> tuple[tuple[Design, ...], tuple[along.Along, ...]]:
        built, candidates = self._candidates()
        wanted = Wanted(
            self.measures,
            self.result.parts,
            self.places.misalignments(),
            self.asked.shift,
            self.stroke,
            self.given,
        )
        designs: list[Design] = []
        ways = []
        for k, candidate in enumerate(candidates):
            bench = built if k == 0 else built.released(candidate.pairs)

            def part(done: float, before: int = k) -> None:
                label = "+".join(each.label for each in candidates[before].released)
                self.report(label or "as built", (before + done) / len(candidates))

            part(0.0)
            design, way = design_of(wanted, built, bench, candidate, part)
            designs.append(with_curve(design, bench, designs[0] if designs else design))
            ways += [] if way is None else [way]
        return tuple(designs), tuple(ways)

    def _candidates(self) -> tuple[Bench, tuple[Candidate, ...]]:
        asked = self.asked
        driven = self.places.drives()
        watched = self.data.node_index[driven[0][0] if driven else self.point.node]
        built = Bench(self.data, Choice(asked.held, asked.drive, asked.beams), {}, watched)
        first = as_built(self.result)
        if asked.release is not None:
            others = tuple(given(self.result, each) for each in asked.release)
            labels = [each.pairs for each in others]
            if any(pairs in labels[:k] for k, pairs in enumerate(labels)):
                raise model_error("repeated-release", "one release is asked for twice")
            return built, (first, *others)
        self.report("looking for releases", 0.0)
        return built, (first, *best(self.measures, built, proven(self.result, asked.bodies)))
