# SPDX-License-Identifier: BSD-3-Clause
"""How far a stroke may go: until a part is stressed too much, or a support is too compliant.

The equilibria are followed each way from rest in growing steps; where something passes its limit
within a step, the place is found between its ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from ..analysis.places import part_words, parts_words, place_words
from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.elements import Member, NodeKind, member_table
from ..util.matrices import first_largest
from ..util.records import Frozen, cached_property
from ..util.roots import sign_change
from ..util.text import in_short
from ..util.units import Units
from . import equilibria
from .equilibria import number_given, value_at
from .errors import ElasticError, Estimate, StrokeError
from .mesh import stays_straight
from .points import Coordinate, Points, words_of_direction
from .solution import Held, Policy, Solution
from .stresses import SECTION, Sections

#: What the stress may be compared with, and what may end a stroke.
AGAINST = ("strength", "fatigue")
STRENGTH, SUPPORT, STABILITY, REACH = "strength", "support", "stability", "reach"


@dataclass(frozen=True)
class Limit:
    """A stroke at which something reaches its limit.

    Attributes:
        criterion: "strength": a share of it; "support": a part of the stiffness at rest;
            "stability": a stiffness is lost; "reach": it was not followed farther.
        stroke: From rest, signed [m, or the model's unit of length; rad].
        reason: What is reached, such as "half of the fatigue strength (240 MPa)".
        part: Name of the part where it is; empty where it is in none.
        place: Where in it, such as "in sheet 1 at its clamp"; empty likewise.
        direction: Of a support, such as "x" or "rz"; empty of others.
    """

    criterion: str
    stroke: float
    reason: str
    part: str = ""
    place: str = ""
    direction: str = ""

    @property
    def words(self) -> str:
        """Such as "half of the fatigue strength (240 MPa) in sheet 1 at its clamp"."""
        return f"{self.reason} {self.place}" if self.place else self.reason


@dataclass(frozen=True, eq=False, repr=False)
class Limits(Frozen):
    """How far a stroke may go each way, and what ends it.

    Attributes:
        words: The driven coordinate, such as "x of node 3".
        unit: Of strokes: "m" or "rad", or the model's own unit of length; stress and supports
            are in its units, too.
        rest: Where the coordinate rests.
        drive: "free" or "locked" in what is asked about stiffness.
        limits: Of every criterion the first stroke each way, from the most negative to the
            largest. Each way ends with one of "reach", or with that of the whole strength.
        strokes: (n,) of the path that was followed, from rest, ascending.
        stress: (n,) largest stress of von Mises on it; that of the part nearest to its strength.
        parts: (n,) names of these parts.
        usage: (n,) stress over the strength that it is compared with, of the same part.
        directions: Supported directions of the point, (d,).
        supports: (n, d) stiffness of the point in each, all else free.
        notes: What is to be known besides, in sentences.
    """

    words: str
    unit: str
    rest: float
    drive: str
    limits: tuple[Limit, ...]
    strokes: FloatArray
    stress: FloatArray
    parts: tuple[str, ...]
    usage: FloatArray
    directions: tuple[str, ...]
    supports: FloatArray
    notes: tuple[str, ...] = ()

    def _first(self, sense: float) -> Limit:
        there = (each for each in self.limits if math.copysign(1.0, each.stroke) == sense)
        return min(there, key=lambda each: abs(each.stroke))

    @cached_property
    def ends(self) -> tuple[Limit, Limit]:
        """What comes first below rest and above it."""
        return self._first(-1.0), self._first(1.0)

    @property
    def low(self) -> float:
        """How far it may go below rest: the first limit there, a number that is not positive."""
        return self.ends[0].stroke

    @property
    def high(self) -> float:
        """How far it may go above rest."""
        return self.ends[1].stroke

    @property
    def nearest(self) -> Limit:
        """The nearer one of the two ends."""
        low, high = self.ends
        # Of equal ones that above rest; rounding does not decide.
        return low if abs(low.stroke) < (1.0 - 1.0e-6) * abs(high.stroke) else high

    @property
    def reason(self) -> str:
        """What comes first, such as "half of the fatigue strength (240 MPa)"."""
        return self.nearest.reason

    @property
    def part(self) -> str:
        """Name of the part where that is; empty where it is in none."""
        return self.nearest.part

    def of(self, criterion: str) -> tuple[Limit, ...]:
        """The limits of a criterion, ascending."""
        return tuple(each for each in self.limits if each.criterion == criterion)

    def shown(self, units: Units) -> Limits:
        """The same with numbers in other units than SI."""
        symbol = self.unit
        turns = [name.startswith("r") for name in self.directions]
        scale = [units.factor("N m/rad" if turn else "N/m") for turn in turns]
        return replace(
            self,
            unit=units.symbol(symbol),
            rest=units.shown(self.rest, symbol),
            limits=tuple(
                replace(each, stroke=units.shown(each.stroke, symbol)) for each in self.limits
            ),
            strokes=units.shown(self.strokes, symbol),
            stress=units.shown(self.stress, "Pa"),
            supports=self.supports * scale,
        )

    def describe(self) -> str:
        """All strokes in words, the first one first."""
        lines = [
            f"{self.words} may go from {self.low:.4g} to {self.high:+.4g} {self.unit} from rest."
        ]
        for both in mirrored(self.limits):
            sizes = ", ".join(f"{each.stroke:+.4g}" for each in both)
            if len(both) == 2:
                sizes = f"+-{both[1].stroke:.4g}"
            lines.append(f"{sizes} {self.unit}: {both[-1].words}.")
        return "\n".join((*lines, *(f"Note: {note}." for note in self.notes)))

    def __repr__(self) -> str:
        """The two ends and what comes first."""
        return f"<Limits of {self.words}: {self.low:.4g} to {self.high:+.4g}, {self.reason}>"


#: Strokes that differ by less than this part mirror each other.
_MIRRORED = 5.0e-3


def mirrored(limits: Sequence[Limit]) -> list[tuple[Limit, ...]]:
    """Limits by size; two that are equal but for the sign together, the negative one first."""
    made: list[tuple[Limit, ...]] = []
    for each in sorted(limits, key=lambda one: (abs(one.stroke), one.stroke)):
        for k, (other, *more) in enumerate(made):
            is_like = (other.criterion, other.direction) == (each.criterion, each.direction)
            is_like &= other.reason == each.reason and not more
            if is_like and abs(other.stroke + each.stroke) <= _MIRRORED * abs(each.stroke):
                made[k] = (min(other, each, key=_stroke), max(other, each, key=_stroke))
                break
        else:
            made.append((each,))
    return made


def _stroke(each: Limit) -> float:
    return each.stroke


def share_given(value: object, what: str) -> float:
    """A part above 0, and 1 at most.

    Raises:
        ElasticError: it is none.
    """
    made = number_given(value, what)
    if not 0.0 < made <= 1.0:
        raise ElasticError(f"{what} is above 0 and at most 1, such as 0.5, not {in_short(value)}")
    return made


def of_it(share: float, what: str) -> str:
    """Such as "half of the strength", "the strength" or "60 % of the strength"."""
    if share == 1.0:
        return f"the {what}"
    return f"{'half' if share == 0.5 else f'{100.0 * share:.4g} %'} of the {what}"


def in_megapascals(stress: float) -> str:
    """Such as "240 MPa"."""
    return f"{stress / 1.0e6:.4g} MPa"


@dataclass(frozen=True, eq=False)
class Strengths(Frozen):
    """What the stress in the parts of a model is compared with.

    Attributes:
        which: (k,) indices of the elements that bend, twist or stretch.
        allowed: (k,) strength that counts [Pa]: that of fatigue or the other.
        is_fatigue: (k,) whether it is that of fatigue.
        breaking: (k,) [Pa] the strength itself; that of fatigue where no other is given.
        left_out: What has a stiffness, and no stress that is known; a sentence, or nothing.
    """

    which: IntArray
    allowed: FloatArray
    is_fatigue: BoolArray
    breaking: FloatArray
    left_out: str

    @classmethod
    def of(
        cls, points: Points, policy: Policy, sections: Sections, against: str | None
    ) -> Strengths:
        """Of the elastic parts of a model.

        Raises:
            ElasticError: a part has no section or no such strength; or nothing is elastic.
        """
        if against is not None and against not in AGAINST:
            raise ElasticError(
                f"against is {' or '.join(map(repr, AGAINST))}, not {in_short(against)}"
            )
        data = points.data
        member = member_table()[data.arrays.element_kind]
        elastic = (policy.stiff & ~policy.rigid).any(axis=0) & ~stays_straight(data)
        bears = np.isin(member, (Member.BAR, Member.BEAM)) | sections.is_known
        found = np.flatnonzero(bears & elastic)
        if not found.size:
            raise ElasticError(
                "nothing that bends, twists or stretches has a stiffness, so that no stress is "
                "known: give ESTIFF in the deck's dynamics block, or a material with a section"
            )
        unknown = found[~sections.is_known[found]].tolist()
        if unknown:
            raise ElasticError(f"the section of {_named(points, unknown)} is not known: {SECTION}")
        strength, fatigue = np.full((2, found.size), np.nan)
        if data.properties is not None:
            strength, fatigue = data.properties.strength[found].T
        is_fatigue = ~np.isnan(fatigue) & (against != "strength")
        allowed = np.where(is_fatigue, fatigue, strength if against != "fatigue" else np.nan)
        # Neither zero nor less is one.
        missing = found[~(allowed > 0.0)].tolist()
        if missing:
            what = "fatigue strength" if against == "fatigue" else "strength"
            raise ElasticError(_missing(points, missing, what))
        breaking = np.where(strength > 0.0, strength, fatigue)
        others = np.flatnonzero(~bears & elastic).tolist()
        left_out = f"the stress in {_named(points, others)} is not known" if others else ""
        return cls(found.astype(np.int32), allowed, is_fatigue, breaking, left_out)

    def usage(self, stress: FloatArray) -> FloatArray:
        """(k,) stress over what it is compared with, of that of all elements."""
        return np.asarray(stress[..., self.which] / self.allowed)


#: How many parts are named that have none.
_MOST_NAMED = 3


def _named(points: Points, elements: Sequence[int]) -> str:
    """The parts of elements, by their indices, such as "sheet 1, sheet 2 and 4 more"."""
    parts = dict.fromkeys(points.parts.of_element(e) for e in elements)
    return parts_words(tuple(parts), _MOST_NAMED)


def _missing(points: Points, missing: Sequence[int], what: str) -> str:
    names = _named(points, missing)
    has = "have" if len({points.parts.of_element(e) for e in missing}) > 1 else "has"
    number = int(points.data.arrays.element_number[missing[0]])
    form = "strength fatigue" if what.startswith("fatigue") else "strength [fatigue]"
    return (
        f"{names} {has} no {what}, so that nobody knows how far it may go: "
        f"write STRENGTH {number} {form} in the deck's dynamics block for each element, or make "
        f"it of a material with a {what}"
    )


def place_of_stress(points: Points, element: int, stress: FloatArray) -> str:
    """Where the stress of an element, by its index, is largest: "in sheet 1 at its clamp".

    Args:
        points: Of the model.
        element: Its index.
        stress: (3,) of von Mises, at p, at q and anywhere.
    """
    part, end = points.parts.of_element(element), first_largest(stress[:2])
    node = int(points.data.arrays.element_node[2 * end, element]) - 1
    place = f"in {part_words(part)}"
    if stress[end] < (1.0 - 1.0e-6) * stress[2] or node not in part.ends:
        return place
    return f"{place} at {place_words(points.parts, node, part)}"


#: The first step, of the model's size or a right angle; and the largest one, as a part of what is
#: left to the next strength, or of the whole reach.
_BEGIN, _STEPS, _REACH = 1.0e-3, 8.0, 16.0
#: How exactly a limit is met, and the place where a stiffness is lost, as parts of them.
_MET, _LOST = 1.0e-7, 1.0e-4
#: How near to where no equilibrium is found any more it is looked what happens before.
_BEFORE = 0.999
#: A compliance below this part of the largest is that of a support.
_SUPPORTED = 1.0e-9


class Path:
    """Equilibria along a stroke, by how far they are from rest; each is found once."""

    def __init__(
        self,
        starts: tuple[Solution, ...],
        points: Points,
        drive: Coordinate,
        is_locked: bool,
        strengths: Strengths,
    ) -> None:
        """From the states at rest, of each mesh."""
        self.points, self.drive, self.is_locked = points, drive, is_locked
        self.strengths = strengths
        self.is_turn = bool(points.kinds[drive.node] > NodeKind.POSITION)
        self._point = points.of(points.number(drive.node))
        self._coordinates = points.coordinates(self._point)
        self.names = tuple(map(points.name, self._coordinates))
        self.rest = value_at(starts[-1], drive)
        self._held: Held = starts[-1].held
        self._driven: dict[float, tuple[Solution, ...]] = {0.0: starts}
        self._asked: dict[float, tuple[Solution, ...]] = {}

    def at(self, stroke: float) -> tuple[Solution, ...]:
        """The equilibrium of each mesh, with the drive as it is asked for.

        Raises:
            StrokeError: there is none.
        """
        if stroke not in self._asked:
            self._asked[stroke] = tuple(map(self._as_asked, self._reached(stroke)))
        return self._asked[stroke]

    def _reached(self, stroke: float) -> tuple[Solution, ...]:
        if stroke not in self._driven:
            nearest = max(
                (s for s in self._driven if s * stroke >= 0.0 and abs(s) <= abs(stroke)), key=abs
            )
            value = [self.rest + stroke]
            self._driven[stroke] = tuple(
                equilibria.driven(at, self.points, self.drive, value, True)[0]
                for at in self._driven[nearest]
            )
        return self._driven[stroke]

    def _as_asked(self, at: Solution) -> Solution:
        if self.is_locked:
            return Solution(at.solver, at.raw, at.way, self._held | {self.drive})
        return equilibria.freed(at, self._held, self.drive) if at.held != self._held else at

    def stress(self, stroke: float) -> FloatArray:
        """(3, elements) largest stress of von Mises [Pa], at p, at q and anywhere."""
        return Estimate.of(*(each.peaks.von_mises for each in self.at(stroke))).value

    def usage(self, stroke: float) -> float:
        """The largest stress over what it is compared with."""
        return float(self.strengths.usage(self.stress(stroke)[2]).max())

    def breaking(self, stroke: float) -> float:
        """The same over the strength itself."""
        which, breaking = self.strengths.which, self.strengths.breaking
        return float((self.stress(stroke)[2, which] / breaking).max())

    def supports(self, stroke: float, coordinates: Sequence[int]) -> FloatArray:
        """(d,) stiffness in some of the directions of the driven point, by their places."""
        rows = []
        for at in self.at(stroke):
            found = at.compliance(self._point, self._coordinates)
            own = np.diagonal(found.matrix)
            # What is left of rounding is of what is rigid.
            rigid = np.abs(np.diagonal(found.finite)) < at.solver.least_compliance
            own = np.where(rigid & np.isfinite(own), 0.0, own)
            with np.errstate(divide="ignore"):
                rows.append(1.0 / own[list(coordinates)])
        return Estimate.of(*rows).value

    def lost(self, stroke: float) -> int:
        """How many stiffnesses are negative, or none that were some at rest; of the finer mesh."""
        here, rest = self.at(stroke)[-1].tangent, self.at(0.0)[-1].tangent
        return int(here.negative) + max(0, int(here.loose.shape[2]) - int(rest.loose.shape[2]))


def supported(at: Solution, points: Points, drive: Coordinate) -> list[int]:
    """Which directions of the driven point are supported, by their places: not what is held.

    Args:
        at: The undeformed state in which all that is fixed is rigid.
        points: Of the model.
        drive: The driven coordinate.
    """
    point = points.of(points.number(drive.node))
    found = points.coordinates(point)
    answer = at.compliance(point, found)
    own = np.abs(np.diagonal(answer.finite))
    moves = (own > _SUPPORTED * own.max(initial=0.0)) | (answer.loose != 0.0).any(axis=1)
    return [
        k for k, each in enumerate(found) if not (moves[k] or answer.is_held[k] or each == drive)
    ]


class Asked(NamedTuple):
    """What is asked of a stroke."""

    share: float
    """Of the strength."""
    support: float | None
    """Part of the stiffness at rest; None where none is asked for."""
    supported: tuple[int, ...]
    """Places of the supported directions among the coordinates of the point."""
    far: float
    """How far it is followed at most [m, rad]."""


class _Way:
    """The limits on one way from rest: strokes are sizes here."""

    def __init__(self, path: Path, asked: Asked, sense: float) -> None:
        self.path, self.asked, self.sense = path, asked, sense
        self.first = path.supports(0.0, asked.supported)
        self.steps = [0.0]
        self.found: dict[str, Limit] = {}
        self.end = math.inf

    def followed(self) -> Iterator[Limit]:
        """All limits on the way, as far as it goes."""
        here, step = 0.0, _BEGIN * self.asked.far
        self._look(0.0, 0.0)
        while self.end == math.inf:
            there = min(here + step, self.asked.far)
            try:
                self._look(here, there)
                here, step = there, self._step(there)
            except StrokeError as error:
                self._look_before(error, here)
                break
            if here == self.asked.far < self.end:
                self._keep(REACH, here, "it was not followed beyond")
                self.end = here
        # What is found behind the end in the same step does not matter any more.
        yield from (each for each in self.found.values() if abs(each.stroke) <= self.end)

    def _step(self, here: float) -> float:
        """As far again, but with some steps on the way to what comes next."""
        path, is_found = self.path, STRENGTH in self.found
        usage = (path.breaking if is_found else path.usage)(self.sense * here)
        left = here * (1.0 if is_found else self.asked.share) / max(usage, 1.0e-300)
        return min(here, max(left, here) / _STEPS, self.asked.far / _REACH)

    def _look_before(self, error: StrokeError, here: float) -> None:
        """What happens until no equilibrium is found, and that."""
        reached = max(abs(error.reached - self.path.rest), here)
        # At the very end there may be none.
        with suppress(StrokeError):
            self._look(here, here + _BEFORE * (reached - here))
        if self.end == math.inf:
            self.end = reached
            at = f"(it stops at {error.place})" if error.place else ""
            self._keep(REACH, reached, "no equilibrium is found beyond", at)

    def _look(self, here: float, there: float) -> None:
        """Keep what reaches its limit on a step."""
        path, asked, to = self.path, self.asked, self.sense * there
        # What has no answer there raises before anything is kept.
        usage, lost = path.usage(to), path.lost(to)
        least = 0.0 if asked.support is None else asked.support
        # What is rigid loses nothing.
        kept = np.where(np.isfinite(self.first), path.supports(to, asked.supported), np.inf)
        kept /= np.where(np.isfinite(self.first), self.first, 1.0)
        if STRENGTH not in self.found and usage >= asked.share:
            place = self._root(lambda s: asked.share - path.usage(s), here, there)
            self._keep(STRENGTH, place, *self._strength(place, asked.share))
        for k in np.flatnonzero(kept < least).tolist():
            name = path.names[asked.supported[k]]
            if f"{SUPPORT} {name}" not in self.found:
                place = self._root(partial(self._support, k, least), here, there)
                part = "half" if least == 0.5 else f"{100.0 * least:.4g} % of"
                reason = f"{words_of_direction(name)} {part} the stiffness"
                self._keep(SUPPORT, place, reason, direction=name)
        if STABILITY not in self.found and lost:
            low, high = here, there
            while high - low > _LOST * max(high, _BEGIN * asked.far):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if path.lost(self.sense * middle) else (middle, high)
            self._keep(STABILITY, low, "it buckles or snaps (a stiffness is lost)")
        if path.breaking(to) >= 1.0:
            place = self._root(lambda s: 1.0 - path.breaking(s), here, there)
            reason, where, part = self._strength(place, 1.0, breaking=True)
            limit = self.found.get(STRENGTH)
            if limit is None or reason != limit.reason:
                self._keep(REACH, place, reason, where, part)
            self.end = place if limit is None else max(place, abs(limit.stroke))
        if there <= self.end:
            self.steps.append(there)

    def _support(self, k: int, least: float, stroke: float) -> float:
        kept = self.path.supports(stroke, self.asked.supported)[k] / self.first[k]
        return float(kept - least)

    def _strength(self, place: float, share: float, breaking: bool = False) -> tuple[str, str, str]:
        """What is reached, where, and in which part."""
        path, strengths = self.path, self.path.strengths
        stress = path.stress(self.sense * place)
        allowed = strengths.breaking if breaking else strengths.allowed
        k = first_largest(stress[2, strengths.which] / allowed)
        element = int(strengths.which[k])
        where = place_of_stress(path.points, element, stress[:, element])
        is_fatigue = strengths.is_fatigue[k] and allowed[k] == strengths.allowed[k]
        what = "fatigue strength" if is_fatigue else "strength"
        part = path.points.parts.of_element(element).name
        return f"{of_it(share, what)} ({in_megapascals(share * allowed[k])})", where, part

    def _keep(
        self,
        criterion: str,
        size: float,
        reason: str,
        place: str = "",
        part: str = "",
        direction: str = "",
    ) -> None:
        key = f"{criterion} {direction}".strip()
        made = Limit(criterion, self.sense * size, reason, part, place, direction)
        self.found[key] = made

    def _root(self, function: Callable[[float], float], here: float, there: float) -> float:
        """Where a function of the stroke passes 0 in a step, at whose end it is below it."""

        def of(part: float) -> float:
            value = function(self.sense * (here + part * (there - here)))
            return 0.0 if abs(value) <= _MET else value

        first = of(0.0)
        if there == here or first <= 0.0:
            return here
        found = sign_change(of, 0.0, 1.0, first, min(of(1.0), -_MET))
        return here if found is None else here + found.place * (there - here)


def _notes(found: Sequence[Limit], strengths: Strengths) -> Iterator[str]:
    if strengths.left_out:
        yield strengths.left_out
    for sense in (-1.0, 1.0):
        sizes = [(sense * each.stroke, each.criterion) for each in found]
        lost = [size for size, criterion in sizes if criterion == STABILITY and size >= 0.0]
        if lost and max(sizes)[0] > lost[0]:
            yield "strokes beyond where it buckles are those of the path on which it does not"
            return


def limits_of(path: Path, asked: Asked) -> Limits:
    """How far a stroke may go, in SI units."""
    ways = [_Way(path, asked, sense) for sense in (-1.0, 1.0)]
    found = sorted((each for way in ways for each in way.followed()), key=_stroke)
    strokes = {way.sense * size for way in ways for size in way.steps}
    strokes |= {each.stroke for each in found if each.part or each.criterion == SUPPORT}
    values = np.array(sorted({value + 0.0 for value in strokes}))
    strengths = path.strengths
    rows, parts = [], []
    for value in values.tolist():
        usage = strengths.usage(path.stress(value)[2])
        k = first_largest(usage)
        parts.append(path.points.parts.of_element(int(strengths.which[k])).name)
        stress = usage[k] * strengths.allowed[k]
        rows.append((stress, usage[k], *path.supports(value, asked.supported)))
    table = np.array(rows)
    return Limits(
        path.points.words(path.drive),
        "rad" if path.is_turn else "m",
        path.rest,
        "locked" if path.is_locked else "free",
        tuple(found),
        values,
        table[:, 0],
        tuple(parts),
        table[:, 1],
        tuple(path.names[k] for k in asked.supported),
        table[:, 2:],
        tuple(_notes(found, strengths)),
    )
