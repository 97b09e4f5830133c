# SPDX-License-Identifier: BSD-3-Clause
"""Better sizes and places for a layout: `flexact design --refine`, `flexact.refine(layout)`.

Varied are the thickness of sheets, the diameter of wires and the breadths of sheets where the
limits of a problem leave a range; how long flexures are at least; and where each is, by what keeps
it within W (`moves`), so that the layout stays exactly constrained. Flexures that are images of
each other are moved together, by one of them. What is to be better is the score by which layouts
are ordered. Regions, lengths and clearances are limits of the search; the best is analysed at the
end. Of layouts with bodies between the sizes alone are varied.

All of it is in the frame of the problem, so that a problem that is turned or scaled gives the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from ..api import analyse
from ..core.arrays import FloatArray
from ..core.progress import Progress
from ..costs.request import RequestError
from ..util.loading import load
from ..util.records import Frozen
from ..util.text import table, wrapped
from ..util.units import METRES
from .candidates import Candidates, Place
from .choice import Chosen
from .design import Designs, place_of
from .frame import Scaled, scaled
from .geometry import between_strips, meets_box
from .held import held_by
from .images import materials, moved
from .layouts import Flexure, Layout, counted, flexure_of, model_of, plural, verified
from .moves import STRAIGHT, WIDE, Mover, NoPlaceError, beyond, lengths_of
from .optimum import Measured, Outcome, Parameter, search
from .problem import Box
from .refined import Refined
from .scores import (
    COLUMNS,
    DEAR,
    SCORES,
    cell,
    cheap_scores,
    dear_scores,
    ranked,
    shown_unit,
    unit_of_stroke,
)
from .search import Arrangement, Found, Part, key_of, turns_that_keep

#: How many designs of a layout are looked at, and from how many places.
EVALUATIONS, STARTS = 200, 1
#: How far a limit is used that is kept, at most, so that one at its edge leaves room for rounding.
_KEPT, _WITHIN = 0.9999, 0.99
#: What is beyond a limit by less is so by rounding.
_ROUNDING = 1.0e-9
#: Lines are dependent where errors are amplified by more.
_DEPENDENT = 1.0e3
#: Into how many steps the way of a degree is divided to find where it ends, and how often halved.
_STEPS, _HALVED = 12, 5
#: How far a degree is followed if it alone leads out of the regions at once.
_LITTLE, _LEAST_REACH = 1.0e-3, 0.1
#: A degree of which one way is shorter than this part of the other has the other alone; else it has
#: this part at least.
_AT_BOUND, _FROM_BOUND = 0.05, 0.25
#: A range of less than this part is none.
_NO_RANGE = 1.0e-6
#: A freedom that is off the wanted one by more is another one.
_SAME_FREEDOM = 1.0e-9
#: Two materials that are nearer than this are one.
_SAME_MATERIAL = 2.0e-5
#: Scores that places and sizes do not change.
_FIXED = ("parts", "kinds", "symmetry")
#: How many of the best are analysed until one is confirmed; how many layouts are refined.
_TRIED, _FIRST = 5, 3
#: Layouts whose scores differ by less than this part became the same.
_SAME = 1.0e-3


@dataclass(frozen=True, eq=False)
class _Orbit(Frozen):
    """Flexures that are images of each other.

    Attributes:
        first: The number of that which is moved.
        images: Number and turn of each of them, the first one too.
        mover: How that one is moved.
    """

    first: int
    images: tuple[tuple[int, FloatArray], ...]
    mover: Mover


@dataclass(frozen=True, eq=False)
class _Drawn(Frozen):
    """A layout in the frame, after moves.

    Attributes:
        flexures: Of each flexure the only candidate.
        thickness: Of sheets [m].
        diameter: Of wires [m].
    """

    flexures: tuple[Candidates, ...]
    thickness: float
    diameter: float


class Shape:
    """What of a layout may be varied, and what it is with values of that.

    Attributes:
        layout: At the beginning.
        parameters: What is varied.
    """

    def __init__(self, layout: Layout) -> None:
        """Find what may be varied.

        Raises:
            RequestError: nothing may.
        """
        self.layout, self.problem = layout, layout.problem
        self.frame: Scaled = scaled(self.problem)
        self.held = held_by(self.problem)
        self.place = place_of(self.problem, self.frame)
        limits = self.problem.limits
        flat = [f.thickness for f in layout.flexures if f.thickness]
        thin = [f.diameter for f in layout.flexures if f.diameter]
        self.thickness = flat[0] if flat else limits.thickness[0]
        self.diameter = thin[0] if thin else limits.diameter[0]
        here = self._place(self.thickness, self.diameter)
        rest = tuple(self._rest(flexure, here) for flexure in layout.flexures)
        self.order, _ = turns_that_keep(self.frame.freedom, self.arranged(rest))
        self.orbits = tuple(self._orbits(rest, here))
        self.forms = [each.kind for each in rest]
        self._away = {(i, j): self._apart(rest, i, j) for i, j in combinations(range(len(rest)), 2)}
        self._out = self._outside(rest, here)
        self.parameters: tuple[Parameter, ...] = ()
        self.parameters = tuple(self._parameters(here, rest))
        if not self.parameters:
            raise RequestError(
                "nothing of the layout can be varied: the limits leave no range of sizes, and no "
                "flexure can be moved"
            )

    # What is varied -------------------------------------------------------------------------

    def _place(self, thickness: float, diameter: float) -> Place:
        """The regions, with sizes of flexures [m]."""
        size = self.problem.size
        sizes = replace(self.place.sizes, thickness=thickness / size, diameter=diameter / size)
        return replace(self.place, sizes=sizes)

    def _rest(self, flexure: Flexure, here: Place) -> Candidates:
        """A flexure in the frame, as it is."""
        size = self.problem.size

        def plain(places: FloatArray) -> FloatArray:
            return np.asarray((places - self.frame.centre) / size @ self.frame.turn.T)

        ends, via = plain(flexure.ends), plain(flexure.via)
        normal, axes = flexure.normal @ self.frame.turn.T, flexure.axes @ self.frame.turn.T
        none = np.zeros((1, 0, 3))
        bare = Candidates(
            *(flexure.form, ends[None], np.zeros((1, 1, 3, 3)), 0.0),
            *(np.zeros((1, 1, 6)), np.ones((1, 1, 1)), np.array([flexure.width / size])),
            *(normal[None], via[None] if len(via) else none, axes[None] if len(axes) else none),
        )
        return Mover(bare, None).at(np.zeros(0), flexure.width / size, 0.0, here)

    def _orbits(self, rest: Sequence[Candidates], here: Place) -> Iterator[_Orbit]:
        """Flexures that are images of each other under all turns that keep the layout."""
        flexures = self.layout.flexures
        freedom = self.frame.freedom
        _, groups = turns_that_keep(freedom, self.arranged(rest))
        turns = _closed([turn for group in groups for turn in group.turns[1:]])
        own = [materials(each, 9)[0] for each in rest]
        sides = [tuple(name.rstrip(" 0123456789") for name in f.between) for f in flexures]
        images: list[list[int]] = []
        kept = []
        for turn in turns:
            made = [materials(moved(each, turn), 9)[0] for each in rest]
            to = [
                next(
                    (
                        j
                        for j, other in enumerate(own)
                        if sides[i] == sides[j]
                        and rest[i].kind == rest[j].kind
                        and np.abs(one - other).max(initial=0.0) < _SAME_MATERIAL
                    ),
                    -1,
                )
                for i, one in enumerate(made)
            ]
            if sorted(to) == list(range(len(rest))):
                images.append(to)
                kept.append(turn)
        seen: set[int] = set()
        for i in range(len(rest)):
            if i in seen:
                continue
            made_of = {}
            for first in {i, *(to[i] for to in images)}:
                still = [turn for turn, to in zip(kept, images, strict=True) if to[first] == first]
                is_free = flexures[i].between == ("stage", "ground")
                least = self._shortest(rest[i].kind, rest)
                made_of[first] = Mover(rest[first], here if is_free else None, still, least)
            # That which is as its regions say; its images may be deeper in theirs.
            first = min(made_of, key=lambda each: (made_of[each].off, each))
            there = {first: np.eye(3)}
            for turn, to in zip(kept, images, strict=True):
                there.setdefault(to[first], turn)
            seen |= set(there)
            yield _Orbit(first, tuple(there.items()), made_of[first])

    def _shortest(self, form: str, rest: Sequence[Candidates]) -> float:
        """The length of the shortest flexure of a form between stage and ground."""
        pairs = zip(rest, self.layout.flexures, strict=True)
        return min(
            (
                float(lengths_of(each)[0])
                for each, was in pairs
                if each.kind == form and was.between == ("stage", "ground")
            ),
            default=0.0,
        )

    def _parameters(self, here: Place, rest: Sequence[Candidates]) -> Iterator[Parameter]:
        """What is varied, between bounds: sizes, least lengths, then places."""
        limits, size = self.problem.limits, self.problem.size
        flexures = self.layout.flexures
        for name, pair, value in (
            ("thickness", limits.thickness, self.thickness),
            ("diameter", limits.diameter, self.diameter),
        ):
            if any(getattr(each, name) for each in flexures) and _is_range(*pair):
                yield Parameter(name, *pair, "m", value)
        for orbit in self.orbits:
            name = self._words(orbit)
            if orbit.mover.form in WIDE and _is_range(*limits.width):
                yield Parameter(f"width of {name}", *limits.width, "m", orbit.mover.width * size)
        for form in dict.fromkeys(o.mover.form for o in self.orbits if o.mover.place is not None):
            if form in STRAIGHT:
                own = [o.mover for o in self.orbits if o.mover.form == form and o.mover.place]
                shortest = self._shortest(form, rest)
                longest = max(self._longest(each, here) for each in own)
                if _is_range(shortest, longest):
                    name = f"least length of {plural(form)}"
                    yield Parameter(name, shortest * size, longest * size, "m", shortest * size)
        for orbit in self.orbits:
            mover = orbit.mover
            for k, degree in enumerate(mover.degrees):
                below, above = (self._reach(orbit, k, sense, here) for sense in (-1.0, 1.0))
                if below + above < _LITTLE:
                    # From a corner of a region two shifts may lead on where one does not.
                    below = above = _LEAST_REACH
                # A method begins at a bound or away from it: what is near it would be moved there.
                far = max(below, above)
                below, above = (
                    0.0 if way < _AT_BOUND * far else max(way, _FROM_BOUND * far)
                    for way in (below, above)
                )
                scale = size if degree.unit == "m" else 1.0
                name = f"{degree.words} of {self._words(orbit)}"
                yield Parameter(name, -below * scale, above * scale, degree.unit, 0.0)

    def _words(self, orbit: _Orbit) -> str:
        name = self.layout.flexures[orbit.first].name
        return name if len(orbit.images) == 1 else f"{name} and its images"

    def _longest(self, mover: Mover, here: Place) -> float:
        """How long a flexure may be made in the regions, in parts of the size."""
        most = self.place.sizes.length[1]
        try:
            made = mover.at(np.zeros(len(mover.degrees)), mover.width, most, here)
        except NoPlaceError:
            return 0.0
        return min(float(lengths_of(made)[0]), most)

    def _reach(self, orbit: _Orbit, k: int, sense: float, here: Place) -> float:
        """How far a flexure and its images may be moved in a degree and stay in the regions."""
        mover = orbit.mover

        def fits(far: float) -> bool:
            moves = np.zeros(len(mover.degrees))
            moves[k] = sense * far
            try:
                made = mover.at(moves, mover.width, 0.0, here)
                out = max(
                    beyond(moved(made, turn), here) - self._out[j] for j, turn in orbit.images
                )
            except NoPlaceError:
                return False
            low, high = self.place.sizes.length
            lengths = lengths_of(made)
            is_short = bool(lengths.min() < low * (1.0 - _ROUNDING))
            return out <= _ROUNDING and not is_short and lengths.max() <= high * (1.0 + _ROUNDING)

        most = mover.degrees[k].far
        # Finer where little is free.
        steps = most * (np.arange(1, _STEPS + 1) / _STEPS) ** 2
        known, no = 0.0, 0.0
        for far in steps.tolist():
            if not fits(far):
                no = far
                break
            known = far
        else:
            return known
        for _ in range(_HALVED):
            middle = (known + no) / 2.0
            known, no = (middle, no) if fits(middle) else (known, middle)
        return known

    # With values ----------------------------------------------------------------------------

    def drawn(self, values: dict[str, float]) -> _Drawn:
        """All flexures with some values of the parameters.

        Raises:
            NoPlaceError: one cannot be where it would be.
        """
        size = self.problem.size
        thickness = values.get("thickness", self.thickness)
        diameter = values.get("diameter", self.diameter)
        place = self._place(thickness, diameter)
        made: dict[int, Candidates] = {}
        for orbit in self.orbits:
            mover, name = orbit.mover, self._words(orbit)
            moves = np.array(
                [
                    values.get(f"{degree.words} of {name}", 0.0)
                    / (size if degree.unit == "m" else 1.0)
                    for degree in mover.degrees
                ]
            )
            width = values.get(f"width of {name}", mover.width * size) / size
            least = values.get(f"least length of {plural(mover.form)}", 0.0) / size
            one = mover.at(moves, width, least, place)
            for number, turn in orbit.images:
                is_same = number == orbit.first
                made[number] = one if is_same else moved(one, turn)
        flexures = tuple(made[k] for k in range(len(made)))
        return _Drawn(flexures, thickness, diameter)

    def flexures(self, drawn: _Drawn) -> tuple[Flexure, ...]:
        """The same with true lengths, called as they were."""
        made = []
        for was, each in zip(self.layout.flexures, drawn.flexures, strict=True):
            sizes = drawn.thickness, drawn.diameter
            flexure = flexure_of(self.problem, self.frame, was.between, each, 0, *sizes)
            made.append(replace(flexure, name=was.name))
        return tuple(made)

    def arranged(self, flexures: Sequence[Candidates]) -> Arrangement:
        """The same as what is looked at for images."""
        parts: dict[tuple[str, str], list[tuple[Candidates, int]]] = {}
        for was, each in zip(self.layout.flexures, flexures, strict=True):
            parts.setdefault(was.between, []).append((each, 0))
        return Arrangement(
            self.layout.kind,
            tuple(
                Part(between, Found((), Chosen(tuple(members), 0.0, 0.0)))
                for between, members in parts.items()
            ),
            self.layout.bodies,
        )

    # Limits ---------------------------------------------------------------------------------

    def use(self, drawn: _Drawn) -> dict[str, float]:
        """How far regions, lengths and clearances are used.

        Raises:
            NoPlaceError: a flexure goes through one box of the ground to another one.
        """
        place = self._place(drawn.thickness, drawn.diameter)
        sizes = place.sizes
        outside = self._outside(drawn.flexures, place)
        out = max((one - was for one, was in zip(outside, self._out, strict=True)), default=0.0)
        ratio = 0.0
        for flexure, was in zip(drawn.flexures, self.layout.flexures, strict=True):
            if was.between == ("stage", "ground"):
                lengths = lengths_of(flexure)
                ratio = max(ratio, float(lengths.max()) / sizes.length[1])
                ratio = max(ratio, sizes.length[0] / float(lengths.min()))
        near = 0.0
        for (i, j), was_apart in self._away.items():
            apart = self._apart(drawn.flexures, i, j)
            near = max(near, _closeness(apart, was_apart, sizes.clearance))
        for box in place.keep_out:
            for each in drawn.flexures:
                apart = _to_box(each, box)
                near = max(near, _closeness(apart, np.inf, sizes.clearance))
        return {
            "regions": 1.0 + out if out > _ROUNDING else _WITHIN,
            "length": _kept(ratio),
            "clearance": _kept(near),
        }

    def _outside(self, flexures: Sequence[Candidates], place: Place) -> list[float]:
        """Of each how far it is outside of its regions; what was so by rounding may be so."""
        made = []
        for each, was in zip(flexures, self.layout.flexures, strict=True):
            is_free = was.between == ("stage", "ground")
            made.append(max(beyond(each, place), 0.0) if is_free else 0.0)
        return made

    def _apart(self, flexures: Sequence[Candidates], i: int, j: int) -> float:
        """How far the surfaces of two flexures are from each other; negative where they meet."""
        one, other = flexures[i], flexures[j]
        (centres, reach), (others, far) = one.balls, other.balls
        # What is far is not looked at closely.
        off = np.linalg.norm(centres[0, :, None] - others[0, None], axis=2)
        least = float((off - reach[0, :, None] - far[0, None]).min()) - one.radius - other.radius
        if least > 2.0 * self.place.sizes.clearance:
            return least
        apart = min(float(between_strips(strip, other.strips[0]).min()) for strip in one.strips[0])
        return apart - one.radius - other.radius


def _closeness(apart: float, was: float, clearance: float) -> float:
    """How far a clearance is used: at most 1 where it is kept, or as it was before."""
    asked = min(clearance, was)
    if asked <= 0.0:
        return 2.0 - apart + asked if apart < asked else 0.0
    # What meets has no ratio: a straight line goes on from half of the clearance.
    return asked / apart if apart > asked / 2.0 else 2.0 + 2.0 * (asked / 2.0 - apart) / asked


def _kept(ratio: float) -> float:
    """The use of a limit, of which what is at its edge keeps it."""
    return min(ratio, _KEPT) if ratio <= 1.0 + _ROUNDING else ratio


def _to_box(flexure: Candidates, box: Box) -> float:
    """How far the surface of a flexure is from a box, negative where they meet."""
    strips = flexure.strips[0]
    if meets_box(strips, box.low, box.high).any():
        return -flexure.radius
    middle, half = (box.low + box.high) / 2.0, (box.high - box.low) / 2.0
    faces = []
    for axis in range(3):
        along, beside = (half * np.eye(3)[(axis + k) % 3] for k in (1, 2))
        for sense in (1.0, -1.0):
            at = middle + sense * half * np.eye(3)[axis]
            faces.append((at - along, at + along, beside))
    return (
        min(float(between_strips(strip, np.array(faces)).min()) for strip in strips)
        - flexure.radius
    )


def _is_range(low: float, high: float) -> bool:
    return high > low * (1.0 + _NO_RANGE)


def _closed(turns: Sequence[FloatArray]) -> list[FloatArray]:
    """All products of turns and mirrors but the identity."""
    made = [np.eye(3)]
    for one in made:
        for turn in turns:
            product = one @ turn
            if not any(np.abs(product - other).max() < 1.0e-9 for other in made):
                made.append(product)
    return made[1:]


# The search -------------------------------------------------------------------------------


def reshaped(
    layout: Layout,
    *,
    rank: tuple[str, bool] | None = None,
    starts: int = STARTS,
    evaluations: int = EVALUATIONS,
    method: str = "auto",
    seed: int = 0,
    progress: Progress | None = None,
) -> Layout:
    """A layout with better sizes and places; it has the same flexures, number and words.

    Where nothing better is found it is as it was. How it was found is its `refined`.

    Args:
        layout: Of `flexact.design`.
        rank: The key of the score that is to be better, and whether less is; by default that of
            the problem.
        starts: From how many places it is searched.
        evaluations: How many designs are looked at, at most.
        method: Of `flexact.designs.optimum.METHODS`.
        seed: Of the places; the same gives the same.
        progress: Called with what is best so far, and how much is done, from 0 to 1.

    Raises:
        RequestError: nothing can be varied, or places and sizes do not change the score.
        SearchError: scipy is missing, or there is no such method.
        KeyboardInterrupt: Ctrl-C came before anything was found.
    """
    problem = layout.problem
    key, less = problem.rank if rank is None else rank
    if key in _FIXED:
        raise RequestError(f"sizes and places do not change {SCORES[key].words}")
    if key not in layout.scores and key not in DEAR:
        raise RequestError(f"the layout has no {SCORES[key].words}, which is to be better")
    shape = Shape(layout)
    few = len(shape.parameters) + 2
    if evaluations < few:
        raise RequestError(
            f"{few - 2} parameters take {few} evaluations at least, not {evaluations}"
        )

    def scored(drawn: _Drawn) -> tuple[Layout, dict[str, float]]:
        flexures = shape.flexures(drawn)
        model = model_of(problem, flexures, layout.bodies, shape.held)
        scores = cheap_scores(model, problem, flexures, shape.order)
        made = replace(layout, flexures=flexures, model=model, scores=scores)
        return made, scores | (dear_scores(made, [key])[0] if key in DEAR else {})

    def measure(values: dict[str, float]) -> Measured:
        drawn = shape.drawn(values)
        use = shape.use(drawn)
        _, scores = scored(drawn)
        if key not in scores:
            raise NoPlaceError(f"there is no {SCORES[key].words}")
        errors = scores.get("turns_with_errors", 1.0)
        return scores[key], {**use, "dependence of lines": errors / _DEPENDENT}

    with load("threadpoolctl").threadpool_limits(1):
        outcome = search(
            shape.parameters,
            measure,
            maximise=not less,
            is_positive=True,
            starts=starts,
            evaluations=evaluations,
            method=method,
            seed=seed,
            progress=progress,
            said=lambda value: in_words(key, layout, value),
        )
        return _finished(shape, outcome, scored, (key, less), seed)


def _finished(
    shape: Shape,
    outcome: Outcome,
    made_of: Callable[[_Drawn], tuple[Layout, dict[str, float]]],
    rank: tuple[str, bool],
    seed: int,
) -> Layout:
    """The best that was found, analysed with its proof; without a better one as it was."""
    layout, (key, less) = shape.layout, rank
    problem, units = layout.problem, METRES
    sense = 1.0 if less else -1.0
    start = outcome.evaluations[0]
    before = layout.scores.get(key, start.objective)
    better = [
        e for e in outcome.evaluations if e.is_feasible and sense * (e.objective - before) < 0
    ]
    best, made = start, layout
    for each in sorted(better, key=lambda each: sense * each.objective)[:_TRIED]:
        drawn = shape.drawn(each.values)
        found, _ = made_of(drawn)
        says = verified(problem, found.model, problem.body)
        is_alike = (says.over_constrained, says.internal) == (
            layout.over_constrained,
            layout.internal,
        )
        if says.freedom_error <= _SAME_FREEDOM and not says.under_constrained and is_alike:
            arrangement = shape.arranged(drawn.flexures)
            order, _ = turns_that_keep(shape.frame.freedom, arrangement)
            best, made = (
                each,
                replace(
                    found,
                    is_proven=says.analysis.proof is not None,
                    freedom_error=says.freedom_error,
                    symmetry=order,
                    alike=key_of(shape.frame, arrangement)[1],
                    scores=found.scores | {"symmetry": order},
                ),
            )
            break
    score = SCORES[key]
    told = Refined(
        model=made.model,
        values=best.values,
        parameters=shape.parameters,
        objective=score.words,
        maximised=not less,
        unit=unit_of_stroke(problem) if key == "stroke" else score.unit,
        value=made.scores.get(key, best.objective),
        before=before,
        bounds=(),
        use=best.use,
        is_feasible=True,
        analysis=analyse(made.model),
        finer={},
        evaluations=outcome.evaluations,
        method=outcome.method,
        starts=outcome.starts,
        seed=seed,
        is_interrupted=outcome.is_interrupted,
        at="at rest",
        units=units,
    )
    return replace(made, before=layout, refined=told)


def refined_designs(
    designs: Designs,
    numbers: Sequence[int] = (),
    *,
    starts: int = STARTS,
    evaluations: int = EVALUATIONS,
    method: str = "auto",
    seed: int = 0,
    progress: Progress | None = None,
) -> Designs:
    """The same layouts, some of them refined, in their new order and numbered anew.

    One that became the same as another one is left out, unless it was asked for. Where Ctrl-C ends
    the search of one, those after it stay as they are.

    Args:
        designs: The layouts.
        numbers: Which of them; by default the first three.
        starts: See `reshaped`, as the others.
        evaluations: Of each layout.
        method: See `reshaped`.
        seed: See `reshaped`.
        progress: Called with words and how much of all is done.

    Raises:
        RequestError: there is no such layout; or as `reshaped`, where none of them can be refined.
        SearchError: see `reshaped`.
        KeyboardInterrupt: see `reshaped`.
    """
    many = len(designs.layouts)
    which = list(dict.fromkeys(numbers)) or list(range(1, min(_FIRST, many) + 1))
    if wrong := [number for number in which if not 1 <= number <= many]:
        raise RequestError(f"there is no layout {wrong[0]}: there are {many}")
    layouts = {layout.number: layout for layout in designs.layouts}
    not_so: list[str] = []
    for k, number in enumerate(which):

        def show(words: str, done: float, k: int = k, number: int = number) -> None:
            assert progress is not None
            progress(f"layout {number}, {words}", (k + done) / len(which))

        try:
            layouts[number] = reshaped(
                layouts[number],
                starts=starts,
                evaluations=evaluations,
                method=method,
                seed=seed,
                progress=None if progress is None else show,
            )
        except RequestError as error:
            not_so.append(f"layout {number}: {error}")
            continue
        except KeyboardInterrupt:
            if not any(layout.refined for layout in layouts.values()):
                raise
            break
        told = layouts[number].refined
        if told is not None and told.is_interrupted:
            break
    if len(not_so) == len(which) and which:
        raise RequestError(not_so[0].partition(": ")[2])
    kept: list[Layout] = []
    for layout in ranked(layouts.values(), designs.problem.rank):
        is_one = layout.refined and not numbers
        if not (is_one and any(_became(layout, other) for other in kept)):
            kept.append(layout)
    return replace(
        designs,
        layouts=tuple(replace(layout, number=k) for k, layout in enumerate(kept, 1)),
    )


def _became(layout: Layout, other: Layout) -> bool:
    """Whether a refined layout is as good as the same as another one."""
    if counted(layout.flexures) != counted(other.flexures):
        return False
    return all(
        abs(value - other.scores.get(key, math.nan)) <= _SAME * abs(value)
        for key, value in layout.scores.items()
    )


# Words --------------------------------------------------------------------------------------


def in_words(key: str, layout: Layout, value: float) -> str:
    """A value of a score as a table has it."""
    return cell(key, replace(layout, scores={key: value}))


def became(layout: Layout) -> str:
    """What refining made of a layout, such as "worst stiffness 1.63 became 2.11 N/um; ..."."""
    told, before = layout.refined, layout.before
    if told is None or before is None:
        return ""
    if layout.flexures is before.flexures:
        return f"nothing better was found; {_looked(told)}"
    said = []
    for key in _told(layout):
        was, now = (cell(key, one, unit=False) for one in (before, layout))
        change = f"{was} became {now}" if was != now else f"{now} as before"
        unit = shown_unit(key, layout.problem)[0]
        said.append(f"{SCORES[key].words} {change} {unit}".rstrip())
    return f"{'; '.join(said)}; {_looked(told)}"


def _told(layout: Layout) -> list[str]:
    """The scores of which it is told what became of them: that which was to be better first."""
    assert layout.refined is not None and layout.before is not None
    key = layout.refined.objective.replace(" ", "_")
    every = [each for each in dict.fromkeys((key, *COLUMNS)) if each not in _FIXED]
    return [each for each in every if each in layout.scores and each in layout.before.scores]


def _looked(told: Refined) -> str:
    """How many designs were looked at."""
    said = f"{len(told.evaluations)} designs looked at"
    if told.failing:
        said += f", {told.failing} of them without a state"
    return f"{said}, interrupted" if told.is_interrupted else said


def refined_in_words(designs: Designs, width: int) -> Iterator[str]:
    """A table of the layouts that were refined beside what they were, and how it was done."""
    some = [layout for layout in designs.layouts if layout.refined and layout.before]
    keys = [key for key in SCORES if any(key in _told(layout) for layout in some)]
    rows = [["refined", *(SCORES[key].head for key in keys)], ["", *("" for _ in keys)]]
    rows[1][1:] = [SCORES[key].under for key in keys]
    for layout in some:
        before = layout.before
        assert before is not None
        cells = []
        for key in keys:
            was, now = (
                cell(key, one, unit=not SCORES[key].under.startswith("N/um"))
                for one in (before, layout)
            )
            unit = shown_unit(key, designs.problem)[0]
            cells.append(now if was == now else f"{was.removesuffix(f' {unit}')} to {now}")
        was_there = "" if before.number == layout.number else f", was {before.number}"
        rows.append([f"layout {layout.number}{was_there}", *cells])
    yield table(rows, width, second=True)
    told = [f"layout {each.number}, {_looked(each.refined)}" for each in some if each.refined]
    yield wrapped(f"Refined: {'; '.join(told)}. That none is better is not proven.", width)
