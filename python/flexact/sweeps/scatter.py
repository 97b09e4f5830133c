# SPDX-License-Identifier: BSD-3-Clause
"""From standard deviations of clamps and thicknesses to many samples: by all processors."""

from __future__ import annotations

import hashlib
import math
import os
import re
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..analysis.places import listed, part_words
from ..core.arrays import FloatArray
from ..core.elements import Class, Member, member_table
from ..core.progress import Progress
from ..costs.designs import Misalignment
from ..costs.request import POINTS, SHIFT, Request
from ..costs.resolve import Places, stroke_of
from ..elasticity.elastic import Elastic
from ..elasticity.equilibria import Imperfection, at_rest, misalignment
from ..elasticity.errors import ElasticError, Estimate, require_within
from ..elasticity.limits import Strengths, of_it, share_given
from ..elasticity.mesh import COARSE, stays_straight
from ..elasticity.points import Coordinate, words_of_direction
from ..elasticity.scattered import Measured, Scattered, Thicknesses
from ..elasticity.solution import loose_motion
from ..elasticity.tolerance import MISMATCH, unit_errors
from ..model.data import ModelData
from ..model.parts.parts import Part
from ..util.errors import FlexactError
from ..util.loading import VERSION, load
from ..util.quantities import Quantity, QuantityError, as_typed, quantity, without_units
from ..util.text import in_short
from ..util.units import METRES, Units
from .indices import first_order, normal, points, totals
from .journal import Journal, JournalError
from .running import require_workers, results_of
from .scatter_result import LOWER, Answer, Checked, Input, Kept, Scatter, article, said
from .tolerances import Share

#: Samples by default, and those that are checked by the nonlinear path.
SAMPLES, CHECKED = 1000, 100
#: A thickness is at least so many standard deviations: no sample has none.
_THICK = 6.0
#: Fewer pairs of an input say nothing of its total index.
_FEW = 16
#: Number of the form of the journal.
_FORM = 1
#: What is smaller than this part of what is off is rounding.
_ROUNDING = 1.0e-9
#: What varies by less than this part of its size is the same in all samples.
_CONSTANT = 1.0e-6

_STRENGTH = "strength"


class Spread(NamedTuple):
    """Standard deviations in SI; 0 of what does not scatter."""

    position: float
    angle: float
    thickness: float


def spread_of(text: str) -> dict[str, Quantity]:
    """The arguments that a text such as "20um,0.1mrad,thickness=5um" stands for.

    What has no name is the positions' where it is a length, and the angles' otherwise; of two
    numbers without a unit the positions' comes first.

    Raises:
        QuantityError: it is not written so.
    """
    made: dict[str, Quantity] = {}
    for part in text.split(","):
        name, sign, value = part.partition("=")
        name = name.strip()
        if not sign:
            value = part
            name = next((n for n in ("position", "angle") if n not in made and _is(value, n)), "")
        if name not in Spread._fields or name in made:
            raise QuantityError(
                "scatter is written as standard deviations of positions and angles of clamps, and "
                f"of thicknesses, such as 20um,0.1mrad,thickness=5um; not {in_short(text)}"
            )
        made[name] = as_typed(value, "rad" if name == "angle" else "m")
    return made


def _is(text: str, name: str) -> bool:
    """Whether a text is a length, or an angle where that is meant."""
    try:
        quantity(text, "rad" if name == "angle" else "m")
    except QuantityError:
        return False
    return True


class Tasks(NamedTuple):
    """What is to be done of many, by its number."""

    errors: FloatArray
    """(samples, k) [m, rad]."""
    others: FloatArray
    """(pairs, k) other values of each error."""
    checked: int

    @property
    def whole(self) -> int:
        """Samples, pairs of each input, and those that are checked."""
        return len(self.errors) + self.others.size + self.checked

    def errors_of(self, task: int) -> tuple[FloatArray, bool]:
        """(k,) what is off, and whether the nonlinear path is taken."""
        samples = len(self.errors)
        if task < samples:
            return self.errors[task], False
        if (task := task - samples) < self.others.size:
            k, row = divmod(task, len(self.others))
            made = self.errors[row].copy()
            made[k] = self.others[row, k]
            return made, False
        return self.errors[task - self.others.size], True


@dataclass(frozen=True)
class Worker:
    """Does tasks, in whatever process; checks with each mesh of the model."""

    scattered: Scattered
    checks: tuple[Scattered, ...]
    tasks: Tasks

    def __call__(self, task: int) -> list[float] | str:
        """The numbers of a task, or why there are none."""
        errors, is_followed = self.tasks.errors_of(task)
        try:
            if not is_followed:
                return list(numbers_of(self.scattered.near(errors)))
            rows = [numbers_of(each.followed(errors)) for each in self.checks]
        except FlexactError as error:
            return str(error)
        return [float(each) for each in Estimate.of(*rows).value]


def numbers_of(made: Measured) -> tuple[float, ...]:
    """In a row, as `_answers` knows them."""
    return (*made[:-1], *made.errors)


def scatter_of(
    elastic: Elastic,
    position: Quantity | None = None,
    angle: Quantity | None = None,
    thickness: Quantity | None = None,
    *,
    samples: int = SAMPLES,
    seed: int = 0,
    limits: Mapping[str, Quantity] | None = None,
    stroke: str | Sequence[object] | None = None,
    at: object = None,
    against: str | None = None,
    beyond: bool = False,
    workers: int | None = None,
    resume: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
    name: str | None = None,
) -> Scatter:
    """See `Elastic.scatter`."""
    require_workers(workers)
    _require_whole("samples", samples, 2)
    _require_whole("the seed", seed, 0)
    elastic.require_stiffness()
    elastic.require_determined()
    notes = ["what is off already is left out"] if elastic.off else []
    beams = elastic.beams if isinstance(elastic.beams, int) else COARSE
    model = replace(elastic, beams=beams, only=None, off=(), is_si=True)
    rest = at_rest(model.solvers[0], model.locked)
    if rest.tangent.loose.shape[2]:
        raise ElasticError(
            f"a motion has no stiffness, so that nothing says where it rests: "
            f"{loose_motion(rest, 0)}; give it a stiffness, or lock the drive"
        )
    data, places = model.data, Places(model.data, model.points.parts)
    spread = _spread(elastic.units, data, (position, angle, thickness), beyond)
    clamps = _clamps(model, places, spread, notes)
    walls, parts = _walls(model, spread.thickness, notes)
    inputs = (
        *(_of_clamp(each, spread) for each, _ in clamps),
        *(_of_part(each, spread) for each in parts),
    )
    if not inputs:
        raise ElasticError(
            "nothing scatters: give a standard deviation, such as 20um for positions and 0.1mrad "
            "for angles of clamps, or thickness=5um"
        )
    drive, values, words = _stroke(model, places, stroke, elastic.units, beyond)
    driven = model.points.number(drive.node) if drive is not None and values else None
    point = places.point(driven if at is None else at)
    off = tuple(each for _, each in clamps)
    scattered = Scattered(
        *(model, off, tuple(part.elements for part in parts), walls),
        tuple(model.points.coordinates(model.points.of(point.node))),
        *(drive, values, _strengths(model, against, limits or {}, notes)),
    )
    whole = replace(elastic, only=None, off=(), is_si=True)
    checks = tuple(replace(scattered, elastic=each) for each in whole.alone)
    with load("threadpoolctl").threadpool_limits(1):
        nothing = np.zeros(len(inputs))
        every = [np.array(numbers_of(each.near(nothing))) for each in (scattered, *checks)]
        designed = Estimate.of(*every[1:]).value
        answers, there = _answers(scattered, designed)
        kept = _limits(scattered, answers, limits, elastic.units)
        normals = normal(points(samples, 2 * len(inputs), seed))
        errors, others = np.split(normals * np.tile([each.sd for each in inputs], 2), 2, axis=1)
        pairs = min(samples, max(_FEW, samples // len(inputs)))
        tasks = Tasks(errors, others[:pairs], min(CHECKED, samples))
        head = _head(data, (spread, whole.words, scattered.drive, values, point, against))
        head |= {"samples": samples, "seed": int(seed)}
        rows, why = _run(
            *(Worker(scattered, checks, tasks), len(designed), head, resume, workers, progress)
        )
    # Finer meshes shift the design as they shift its samples, those without a stiffness excepted.
    near = rows[: len(rows) - tasks.checked]
    finer = np.where(np.isnan(designed), 0.0, designed - every[0])
    finer[_ELEMENT] = 0.0
    near += np.where(near == 0.0, 0.0, finer)
    # What is rounding beside what is off is nothing.
    largest = max(spread.position, spread.thickness, spread.angle * data.size) * _ROUNDING
    for place in range(_BEHIND, rows.shape[1]):
        is_turn = model.points.unit(scattered.coordinates[place - _BEHIND]) == "rad"
        least = largest / data.size if is_turn else largest
        rows[np.abs(rows[:, place]) < least, place] = 0.0
    found = rows[:samples, there]
    has_answer = ~np.isnan(found).any(axis=1)
    if has_answer.sum() < 2:
        raise ElasticError(f"no sample has an answer: {why}")
    varies = found[has_answer].std(axis=0) > _CONSTANT * np.abs(found[has_answer]).max(axis=0)
    variance = np.where(varies, found[has_answer].var(axis=0, ddof=1), 0.0)
    first = first_order(normals[has_answer, : len(inputs)], found[has_answer])
    first[~varies] = np.nan
    behind = rows[samples : samples + tasks.others.size][:, there]
    total = totals(found[:pairs], behind.reshape(len(inputs), pairs, -1), variance)
    part_of = model.points.parts.of_element
    stressed = np.where(np.isnan(rows[:samples, 0]), -1, rows[:samples, _ELEMENT])
    keeps = _keeps(kept, answers, found)
    return Scatter(
        name=(data.name if name is None else name) or "",
        data=data,
        units=elastic.units,
        inputs=inputs,
        answers=answers,
        errors=errors,
        values=found,
        parts=tuple(part_of(int(e)).name if e >= 0 else "" for e in stressed.tolist()),
        designed=designed[there],
        first=first,
        total=total,
        kept=tuple(
            each._replace(share=Share.counted(int(row.sum()), samples))
            for each, row in zip(kept, keeps, strict=True)
        ),
        all_kept=Share.counted(int(keeps.all(axis=0).sum()), samples),
        checked=_checked(
            *(rows[samples + tasks.others.size :][:, there], found, variance, kept, answers)
        ),
        stroke=words,
        mesh=f"one mesh of {_beams_in_words(beams)}"
        + (", shifted as the design is by finer ones" if len(checks) > 1 else ""),
        mesh_checked=(
            "8 and 16 beams a sheet, extrapolated" if len(checks) > 1 else _beams_in_words(beams)
        ),
        point=point.words,
        seed=int(seed),
        notes=tuple(notes),
    )


def _beams_in_words(beams: int) -> str:
    return "the deck's own elements" if beams == 1 else f"{beams} beams a sheet"


def _require_whole(what: str, value: Any, least: int) -> None:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{what} must be a whole number, not {type(value).__name__}")
    if value < least:
        raise ElasticError(f"{what} must be {least} or more, not {value}")


def _spread(
    units: Units, data: ModelData, given: tuple[Quantity | None, ...], beyond: bool
) -> Spread:
    """Standard deviations in SI.

    Raises:
        ElasticError: one is negative, not finite, or larger than the model.
    """
    made = []
    for name, value in zip(Spread._fields, given, strict=True):
        what = f"the standard deviation of the {name}"
        symbol = units.symbol("rad" if name == "angle" else "m")
        sd = 0.0 if value is None else without_units(value, symbol)
        if isinstance(sd, bool) or not isinstance(sd, (int, float, np.number)):
            raise ElasticError(f"{what} is a number [{symbol}], not {in_short(value)}")
        if not (math.isfinite(sd) and sd >= 0.0):
            raise ElasticError(f"{what} must be finite and not negative, not {in_short(value)}")
        if not beyond:
            require_within(float(sd), data.size, name == "angle", what, data.units)
        made.append(float(sd))
    return Spread(*made)


def _clamps(
    model: Elastic, places: Places, spread: Spread, notes: list[str]
) -> list[tuple[Misalignment, Imperfection]]:
    """What scatters of clamps, each with a unit of it; not what rigid parts cannot follow."""
    sizes = {"m": spread.position, "rad": spread.angle}
    found = [
        (each, misalignment(model.points, each.clamp.node, each.direction, 1.0, None, True, METRES))
        for each in places.misalignments()
        if sizes[each.unit]
    ]
    if not found:
        return []
    stiff = (
        unit_errors(at_rest(model.solvers[0], model.locked), [off for _, off in found])[1].mismatch
        > MISMATCH
    )
    if stiff.any():
        named = [each.words for (each, _), left in zip(found, stiff, strict=True) if left]
        notes.append(f"rigid parts cannot follow {listed(named)}, which does not scatter")
    return [both for both, left in zip(found, stiff, strict=True) if not left]


def _of_clamp(each: Misalignment, spread: Spread) -> Input:
    what, sd = ("turn", spread.angle) if each.unit == "rad" else ("place", spread.position)
    words, short = (
        f"{what} of {clamp} {words_of_direction(each.direction)}"
        for clamp in (each.clamp.words, each.clamp.label)
    )
    return Input(f"{each.clamp.node}:{each.direction}", f"the {words}", short, each.unit, sd)


def _of_part(each: Part, spread: Spread) -> Input:
    words = f"thickness of {part_words(each)}"
    return Input(f"{each.name}: thickness", f"the {words}", words, "m", spread.thickness)


def _walls(model: Elastic, sd: float, notes: list[str]) -> tuple[Thicknesses, list[Part]]:
    """The parts whose thickness scatters.

    Raises:
        ElasticError: no section is known, or a thickness is too small for the scatter.
    """
    data, sections = model.data, model.solvers[0].sections
    is_member = np.isin(member_table()[data.arrays.element_kind], (Member.BAR, Member.BEAM))
    elastic = (model.policy.stiff & ~model.policy.rigid).any(axis=0)
    walls = Thicknesses(data, np.asarray(sections.is_known & is_member & elastic))
    if not sd:
        return walls, []
    every = {
        element: model.points.parts.of_element(element)
        for element in np.flatnonzero(elastic).tolist()
    }
    parts = dict.fromkeys(part for e, part in every.items() if walls.is_known[e])
    others = dict.fromkeys(part for e, part in every.items() if not walls.is_known[e])
    if not parts:
        raise ElasticError(
            "no thickness is known that could scatter: give sheets, wires, bars or beams BEAMPROPS "
            "with CROSSTYPE RECT or CIRC and CROSSDIM in the deck's picture block, or a section in "
            "Python"
        )
    for part in parts:
        least = min(float(walls.thickness[e]) for e in part.elements if walls.is_known[e])
        if least < _THICK * sd:
            thin, large = (said(size, "m", data.units) for size in (least, sd))
            raise ElasticError(
                f"{part_words(part)} is {thin} thick, less than {_THICK:g} standard deviations of "
                f"{large}: normal samples of it would be without any thickness"
            )
    if left := [part_words(part) for part in others]:
        notes.append(
            f"the thickness of {listed(left)} does not scatter: no section of a bar or beam is "
            "known there"
        )
    return walls, list(parts)


def _stroke(
    model: Elastic, places: Places, given: str | Sequence[object] | None, units: Units, beyond: bool
) -> tuple[Coordinate | None, tuple[float, ...], str]:
    """What is driven, where to, the farthest last, and both in words.

    Raises:
        RequestError, ModelError: it is not understood, or not there.
    """
    if given is None:
        # Alone and locked its force is known at rest.
        return (next(iter(model.locked)) if len(model.locked) == 1 else None), (), ""
    asked = Request.of(
        at=None,
        release=None,
        stroke=given,
        misalign=(),
        shift=SHIFT,
        held=model.held,
        drive=model.drive,
        beams=1,
        points=POINTS,
        bodies=False,
        beyond=beyond,
        units=units,
    )
    found = stroke_of(places, asked)
    assert found is not None and asked.stroke is not None
    stroke, (_, _, start, stop, is_offset) = found[0], asked.stroke
    drive = model.points.coordinate(stroke.node, stroke.coordinate)
    ends = {value + (stroke.rest if is_offset else 0.0) for value in (start, stop)}
    values = tuple(
        sorted(ends - {stroke.rest}, key=lambda value: (abs(value - stroke.rest), value))
    )
    unit = model.points.unit(drive)
    by = [value - stroke.rest for value in values]
    told = [f"{'+' if each > 0.0 else ''}{said(each, unit, units)}" for each in by]
    if len(by) == 2 and abs(sum(by)) <= _ROUNDING * abs(by[1]):
        told = [f"+-{said(abs(by[1]), unit, units)}"]
    return drive, values, f"at rest and driven by {listed(told)}, {stroke.words}"


def _strengths(
    model: Elastic, against: str | None, limits: Mapping[str, Quantity], notes: list[str]
) -> Strengths | None:
    """What the stress is compared with; None where that is not known, and not asked for.

    Raises:
        ElasticError: a limit is asked for, and a section or a strength is not known.
    """
    sections = model.solvers[0].sections
    is_member = np.isin(member_table()[model.data.arrays.element_kind], (Member.BAR, Member.BEAM))
    bears = (model.policy.stiff & ~model.policy.rigid).any(axis=0) & ~stays_straight(model.data)
    unknown = np.flatnonzero(bears & is_member & ~sections.is_known).tolist()
    if unknown and "stress" in limits:
        sections.require(unknown[0])
    try:
        return model.strengths(against)
    except ElasticError:
        if against is not None or _STRENGTH in limits:
            raise
    if unknown:
        parts = dict.fromkeys(model.points.parts.of_element(e) for e in unknown)
        named = listed([part_words(part) for part in parts])
        notes.append(f"the stress in {named} is left out: no section is known there")
    return None


#: The numbers of a sample in their order, each with its unit; behind them stand the errors.
_NUMBERS = (
    *(("stress", "largest stress", "Pa"), (_STRENGTH, "part of the strength", "")),
    *(("element", "", ""), ("frequency", "first frequency", "Hz")),
    *(("parasitic", "first parasitic frequency", "Hz"), ("force", "drive force", "N")),
)
_ELEMENT, _BEHIND = Measured._fields.index("element"), len(_NUMBERS)


def _answers(scattered: Scattered, designed: FloatArray) -> tuple[tuple[Answer, ...], list[int]]:
    """The quantities that are known, and where each stands in the numbers of a sample.

    Raises:
        ElasticError: none is.
    """
    model, drive, points = scattered.elastic, scattered.drive, scattered.elastic.points
    declared = model.data.arrays.coordinate_class == Class.INDEPENDENT
    # Where no drive is free all frequencies are parasitic.
    left_out = (
        ("element",) if declared.any() and model.drive == "free" else ("element", "parasitic")
    )
    made = {}
    for place, (name, words, unit) in enumerate(_NUMBERS):
        if name == "force" and drive is not None and points.unit(drive) == "rad":
            words, unit = "drive moment", "N m"
        if math.isfinite(designed[place]) and name not in left_out:
            made[Answer(name, words, unit)] = place
    for k, each in enumerate(scattered.coordinates):
        if each != drive and not scattered.designed[0].is_held(each):
            name = points.name(each)
            words = f"error {words_of_direction(name)}"
            made[Answer(name, words, points.unit(each))] = _BEHIND + k
    if not made:
        raise ElasticError(
            "nothing is known that could be told: no section, no mass, no drive, and the point is "
            "held; give another point (at), masses, or sections (CROSSDIM)"
        )
    return tuple(made), list(made.values())


#: Why a quantity is not known.
_WITHOUT = {
    "parasitic": "no declared coordinate is free, so that all frequencies are: limit frequency",
    "force": "nothing is driven, or locked alone: give a stroke",
}


def _limits(
    scattered: Scattered,
    answers: Sequence[Answer],
    given: Mapping[str, Quantity] | None,
    units: Units,
) -> tuple[Kept, ...]:
    """The limits; without any half of the strength, where that is known.

    Raises:
        ElasticError: there is no such quantity, or the limit is no positive one.
    """
    known = {each.name: each for each in answers}
    if given is None:
        given = {_STRENGTH: 0.5} if _STRENGTH in known else {}
    made = []
    for name, value in given.items():
        if name not in known:
            if name in LOWER:
                scattered.elastic.require_mass()
            if name == "stress":
                raise ElasticError("no stress is known: no part has a known section (CROSSDIM)")
            why = _WITHOUT.get(name, f"there are {', '.join(known)}")
            raise ElasticError(f"there is no {in_short(name)} to limit: {why}")
        words, unit = known[name].words, known[name].unit
        if name == _STRENGTH:
            number = share_given(_part(value), "a limit of the strength")
        else:
            number = without_units(value, units.symbol(unit))
            if isinstance(number, bool) or not isinstance(number, (int, float, np.number)):
                raise ElasticError(f"a limit of the {words} is a number, not {in_short(value)}")
            if not (math.isfinite(number) and number > 0.0):
                raise ElasticError(f"a limit of the {words} is positive, not {in_short(value)}")
        told = said(float(number), unit, units)
        is_least = name in LOWER
        if name == _STRENGTH:
            assert scattered.strengths is not None
            is_fatigue = bool(scattered.strengths.is_fatigue.all())
            what = "fatigue strength" if is_fatigue else "strength"
            words = f"stay below {of_it(float(number), what)}"
        elif is_least:
            words = f"have a {words} of {told} or more"
        else:
            words = f"have {article(words)} {words} of {told} or less"
        made.append(Kept(name, float(number), is_least, words, Share.counted(0, 0)))
    return tuple(made)


def _part(value: Quantity) -> float | str:
    """A part such as 0.5, "0.5" or "50%"."""
    if not isinstance(value, str):
        return value
    found = re.fullmatch(r"\s*(\d+\.?\d*|\.\d+)\s*(%?)\s*", value)
    return value if found is None else float(found[1]) / (100.0 if found[2] else 1.0)


def _keeps(kept: Sequence[Kept], answers: Sequence[Answer], values: FloatArray) -> np.ndarray:
    """(limits, samples) which samples keep each limit; those without an answer none."""
    column = {each.name: q for q, each in enumerate(answers)}
    made = np.zeros((len(kept), len(values)), np.bool_)
    for row, each in zip(made, kept, strict=True):
        found = values[:, column[each.name]]
        row[:] = found >= each.value if each.is_least else np.abs(found) <= each.value
    return made


def _checked(
    followed: FloatArray,
    values: FloatArray,
    variance: FloatArray,
    kept: Sequence[Kept],
    answers: Sequence[Answer],
) -> Checked:
    """What the whole path (checked, q) says of the first samples."""
    here = values[: len(followed)]
    there = ~np.isnan(followed - here).any(axis=1)
    off, none = (followed - here)[there], np.full(variance.shape, np.nan)
    shift, rest = (off.mean(axis=0), off.std(axis=0)) if there.any() else (none, none)
    with np.errstate(invalid="ignore", divide="ignore"):
        rest = np.where(variance > 0.0, rest / np.sqrt(variance), np.nan)
    count = [int(_keeps(kept, answers, each[there]).all(axis=0).sum()) for each in (followed, here)]
    return Checked(len(followed), int((~there).sum()), shift, rest, *count)


def _head(data: ModelData, asked: tuple[object, ...]) -> dict[str, Any]:
    """What a journal remembers of its run."""
    said, looks = data.properties, data.appearance
    tables = [] if said is None else [getattr(said, each.name) for each in fields(said)]
    whole = hashlib.sha256(repr(asked).encode())
    for each in (*data.arrays, looks.cross_section, looks.dimensions, *tables):
        whole.update(np.ascontiguousarray(each).tobytes())
    return {"journal": _FORM, "flexact": VERSION, "of": whole.hexdigest()}


def _journal(path: Path, head: dict[str, Any]) -> Journal:
    """A new journal, or that of the run that was interrupted.

    Raises:
        JournalError: it is of another run.
    """
    found = Journal.resume(path)
    if found is not None and found.head != head:
        found.close()
        raise JournalError(
            f"{path} is of another run: of another model, scatter, stroke, seed or number of "
            "samples, or another version of flexact. Delete it to start anew"
        )
    return Journal.begin(path, head) if found is None else found


def _run(
    worker: Worker,
    width: int,
    head: dict[str, Any],
    resume: str | os.PathLike[str] | None,
    workers: int | None,
    progress: Progress | None,
) -> tuple[FloatArray, str]:
    """(tasks, width) numbers of all tasks, NaN where there are none, and why one has none.

    Raises:
        JournalError: the journal is of another run, or cannot be used.
    """
    rows, why = np.full((worker.tasks.whole, width), np.nan), ""
    is_left = np.ones(len(rows), np.bool_)
    journal = None if resume is None else _journal(Path(resume), head)
    try:
        for place, record in () if journal is None else journal.entries():
            task, row = record.get("task"), record.get("row")
            # Whatever else stands there was written by others.
            is_task = place and type(task) is int and 0 <= task < len(rows)
            if is_task and isinstance(row, list) and len(row) == width:
                rows[task], is_left[task] = row, False
        left = np.flatnonzero(is_left).tolist()
        with closing(results_of(worker, left, workers=workers)) as results:
            for number, done in enumerate(results, len(rows) - len(left) + 1):
                task, row = left[done.index], done.failure or done.result
                if isinstance(row, str):
                    why, row = why or row, [math.nan] * width
                rows[task] = row
                if journal is not None:
                    journal.add({"task": task, "row": row})
                    journal.keep()
                if progress is not None:
                    progress(f"sample {number} of {len(rows)}", number / len(rows))
        if journal is not None:
            journal.remove()
    finally:
        if journal is not None:
            journal.close()
    return rows, why
