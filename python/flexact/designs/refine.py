# SPDX-License-Identifier: BSD-3-Clause
"""Refining a design: its lengths, thicknesses and places within limits, `flexact.refine`.

How many constraints a design has stays as it was: one that is constrained otherwise counts as one
without a state, and the best is analysed at the end, with its proof.
"""

from __future__ import annotations

import inspect
import math
import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..analysis.places import listed
from ..api import Analysis, analyse
from ..core.elements import Class, Member, member_table
from ..core.progress import Progress
from ..costs.request import RequestError, stroke_given
from ..deck.rendering import ModelError
from ..elasticity.elastic import State
from ..elasticity.errors import ElasticError
from ..elasticity.mesh import stays_straight
from ..elasticity.points import Points
from ..model.model import Model
from ..model.names import nearest
from ..model.reading import read
from ..util.errors import FlexactError
from ..util.loading import load
from ..util.quantities import Quantity, QuantityError, quantity
from ..util.text import in_short
from ..util.units import METRES, Units
from .layouts import Layout
from .measures import ASKED, Bound, Design, How, said
from .optimum import Measured, Outcome, Parameter, SearchError, method_of, search
from .refined import Refined
from .reshape import reshaped
from .scores import rank_given
from .varied import Variation, first_words

REST, END = "rest", "end of stroke"
#: Beams into which a sheet is divided while it is searched.
BEAMS = 4
_LIMIT = re.compile(r"(?s)\s*(?P<key>[A-Za-z][\w ]*?)\s*(?P<sign><=|>=|<|>)\s*(?P<value>.+?)\s*")


#: What makes a model of values, by the names of parameters.
Build = Callable[..., Model]
#: What is to be better: of `ASKED`, with blanks or underscores, or a function of the state.
Goal = str | Callable[[State], float]


def refine(
    of: Model | Analysis | Layout | str | os.PathLike[str] | Build,
    vary: Iterable[str] | Mapping[str, object] | None = None,
    *,
    maximise: Goal | None = None,
    minimise: Goal | None = None,
    at: str = REST,
    stroke: Quantity | Sequence[Any] | None = None,
    drive: tuple[object, str] | None = None,
    stress: Quantity | None = None,
    force: Quantity | None = None,
    moment: Quantity | None = None,
    buckling: float | bool | None = None,
    size: Quantity | Sequence[Quantity | None] | None = None,
    limits: Iterable[str] = (),
    point: object = None,
    length: Quantity | None = None,
    over_constrained: bool | int = True,
    start: Mapping[str, float] | None = None,
    starts: int | None = None,
    evaluations: int | None = None,
    beams: int = BEAMS,
    method: str = "auto",
    seed: int = 0,
    progress: Progress | None = None,
) -> Refined:
    """Make a design better: vary its sizes and places within limits.

        flexact.refine(
            model, vary=["thickness of sheet *: 0.2..1 mm", "y of stage: 20..150 mm"],
            maximise="first parasitic frequency", at="end of stroke", stroke=0.5,
            stress="300 MPa", moment=2.5,
        )

    or, of a function that makes a model,

        flexact.refine(build, vary={"H": (0.02, 0.15), "t": (0.2e-3, 1e-3)}, ...)

    A layout of `flexact.design` needs nothing else: `flexact.refine(layout)` varies its sizes and
    places within the limits of its problem, so that it stays exactly constrained, for the score by
    which layouts are ordered, or another one of them; the new layout is `layout` of what is given.

    Ctrl-C ends the search, and gives the best so far. The same seed looks at the same designs.

    Args:
        of: A model, a layout, an analysis, the path of a deck, or a function that makes a model of
            the parameters, `build(H=..., t=...)`.
        vary: What is varied, and between which bounds: of a model texts (`designs.varied`), of a
            function two numbers by name, as it takes them; of a layout nothing, or as of a model.
        maximise: What is to be large: "first frequency", "first parasitic frequency" (the drive
            locked), "worst stiffness", "drive stiffness", "stiffness x" to "stiffness rz", ... of
            `flexact.designs.refine.ASKED`, also with underscores; or a function of the state
            with the drive locked (`flexact.State`). Of several ends of a stroke the worst.
        minimise: What is to be small, likewise.
        at: "rest", or "end of stroke", where that is measured.
        stroke: How far the drive goes from rest [m, rad], or to two ends, as a number or text such
            as "3 mm"; or with its point as for `flexact.cost`, "stage:rz=0..0.5rad", or
            ("stage", "rz", 0, 0.5).
        drive: Point and coordinate; by default the only declared one.
        stress: The largest normal stress at the ends of the stroke [Pa], as `State.peak_stress`.
        force: Of the drive there, at most [N]; of a drive that turns its moment [N m].
        moment: Likewise, of a drive that turns alone.
        buckling: By how much the stress there may grow at least until it buckles; with it the
            states on the way are looked at. True: by nothing. A design that has buckled at an end
            has no state in any case.
        size: Of the box around points and flexures, at most: its longest side, or three sides, None
            where one is free [m].
        limits: Further ones, such as "first frequency >= 5 Hz" or "drive stiffness <= 1 N/mm".
        point: Where stiffness is asked; by default the driven point.
        length: By which rotations compare with displacements in "worst stiffness" and "drive
            stiffness" [m]; by default half of the size of the model at the beginning.
        over_constrained: Whether a design may be, or by how much at most. Its numbers hold
            without misalignment alone, which is told.
        start: Where a function's parameters begin; by default in the middle of their logarithms. A
            model begins as it is.
        starts: From how many places it is searched: three; of a layout without `vary` one.
        evaluations: How many designs are looked at, at most, in all: 400; likewise 200.
        beams: Into how many beams a sheet is divided while searching; the best is measured with
            8 and 16 as well.
        method: "auto": COBYQA, or COBYLA of a scipy before 1.14; "differential evolution",
            "Nelder-Mead".
        seed: Of the places from which it is searched.
        progress: Called with what is best so far, and how much is done, from 0 to 1.

    Raises:
        RequestError: something that is asked for is not understood; all of it is told.
        SearchError: no design has a state.
        DeckError, ModelError: the model is wrong.
        ElasticError: it has no stiffness, mass, drive, or section where that is needed; or it is
            under-constrained, or over-constrained beyond what is permitted.
    """
    if vary is None:
        further: dict[str, object] = {"stroke": stroke, "drive": drive, "stress": stress}
        further |= {"force": force, "moment": moment, "buckling": buckling, "size": size}
        further |= {"limits": tuple(limits) or None, "point": point, "length": length}
        further |= {"over_constrained": None if over_constrained is True else over_constrained}
        further |= {"start": start}
        further |= {"at": None if at == REST else at}
        needs = [name for name, value in further.items() if value is not None]
        return _of_layout(
            of, needs, maximise, minimise, starts, evaluations, method, seed, progress
        )
    starts = 3 if starts is None else starts
    evaluations = 400 if evaluations is None else evaluations
    wrong: list[str] = []

    def tried(make: Callable[..., Any], *given: Any) -> Any:
        try:
            return make(*given)
        except (RequestError, QuantityError, SearchError) as error:
            wrong.extend(getattr(error, "messages", (str(error),)))
        return None

    source = tried(_source, of, vary, start)
    first = None if source is None else source[1](source[2])
    units = METRES if first is None else first.data.units
    goal, maximised = tried(_goal, maximise, minimise) or (None, True)
    at = at.replace("_", " ") if isinstance(at, str) else at
    if at not in (REST, END):
        wrong.append(f"at is {REST!r} or {END!r}, not {in_short(at)}")
    counts = {"starts": starts, "evaluations": evaluations, "seed": seed, "beams": beams}
    for what, count in counts.items():
        least = 0 if what == "seed" else 1
        if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < least:
            wrong.append(f"{what} is a whole number from {least}, not {in_short(count)}")
    permits = isinstance(over_constrained, (bool, int, np.integer)) and over_constrained >= 0
    if not permits:
        wrong.append("over_constrained is True, False, or by how much it may be so at most")
    if progress is not None and not callable(progress):
        wrong.append(f"progress is something to call, not {in_short(progress)}")
    tried(method_of, method)
    bounds: list[Bound] = []
    asked = None if first is None else tried(_stroke, stroke, drive, first, units)
    # "force" is the moment of a drive that turns, as everywhere.
    is_turn = asked is not None and bool(asked[1]) and asked[3] == "rad"
    acts = "drive moment" if is_turn else "drive force"
    for name, value in (("stress", stress), (acts, force), ("drive moment", moment)):
        if value is not None:
            bounds.append(tried(_bound, name, value, units))
    if buckling is not None and buckling is not False:
        least_growth = 1.0 if buckling is True else buckling
        bounds.append(tried(_bound, "buckling", least_growth, units, True))
    bounds += [] if size is None else tried(_sizes, size, units) or []
    if not isinstance(limits, Iterable):
        wrong.append(f"limits are texts such as 'first frequency >= 5 Hz', not {in_short(limits)}")
        limits = ()
    more = [limits] if isinstance(limits, str) else limits
    bounds += [tried(_limit, each, units) for each in more]
    bounds = [each for each in bounds if each is not None]
    keys = [each.key for each in bounds]
    if twice := [key for key in dict.fromkeys(keys) if keys.count(key) > 1]:
        wrong.append(f"{listed(twice)} is limited twice")
    names = [each.name for each in bounds]
    names += [goal] if isinstance(goal, str) else []
    if asked is not None and not asked[1]:
        without = [name for name in dict.fromkeys(names) if "stroke" in ASKED[name].needs]
        if without or at == END:
            wrong.append(
                f"{listed([*without, *['the end of the stroke'] * (at == END)])} "
                "is asked for, and there is no stroke: give one, such as stroke=0.5 or "
                'stroke="stage:y=+-3mm"'
            )
    size_of = tried(_read_length, length, first, units)
    point = None if first is None else tried(_lasting, first, point)
    if wrong or source is None or first is None or asked is None or goal is None:
        raise RequestError(*dict.fromkeys(wrong))
    if evaluations < len(source[0]) + 2:
        few = len(source[0])
        raise RequestError(
            f"{few} parameters take {few + 2} evaluations at least, not {evaluations}"
        )
    is_followed = "buckling" in names
    return refined(
        *(source[0], source[1], goal, maximised, tuple(bounds)),
        How(int(beams), asked[0], asked[1], asked[2], at == END, point, size_of, is_followed),
        most=10**6 if over_constrained is True else int(over_constrained),
        starts=int(starts),
        evaluations=int(evaluations),
        method=method,
        seed=int(seed),
        progress=progress,
    )


def _of_layout(
    of: object,
    needs: Sequence[str],
    maximise: Goal | None,
    minimise: Goal | None,
    starts: int | None,
    evaluations: int | None,
    method: str,
    seed: int,
    progress: Progress | None,
) -> Refined:
    """A layout, by what keeps it exactly constrained; `needs` are what goes with `vary` alone.

    Raises:
        RequestError: it is no layout, or something else is asked for that is for others.
    """
    if not isinstance(of, Layout):
        raise RequestError('say what is varied, such as vary=["thickness of sheet *: 0.2..1 mm"]')
    wrong = [f"{listed(list(needs))} is for what has vary"] if needs else []
    rank = None
    if maximise is not None or minimise is not None:
        goal = minimise if maximise is None else maximise
        if (maximise is None) == (minimise is None) or not isinstance(goal, str):
            wrong.append("of a layout one score is maximised or minimised, by its name")
        else:
            rank = rank_given(f"{'higher' if maximise is not None else 'lower'}:{goal}")
    for what, count in {"starts": starts, "evaluations": evaluations, "seed": seed}.items():
        if count is not None and (isinstance(count, bool) or not isinstance(count, int)):
            wrong.append(f"{what} is a whole number, not {in_short(count)}")
        elif count is not None and count < (what != "seed"):
            wrong.append(f"{what} is a whole number from {int(what != 'seed')}, not {count}")
    if wrong:
        raise RequestError(*wrong)
    how = {"starts": starts, "evaluations": evaluations}
    made = reshaped(
        of,
        rank=rank,
        method=method,
        seed=seed,
        progress=progress,
        **{name: value for name, value in how.items() if value is not None},
    )
    assert made.refined is not None
    return replace(made.refined, layout=made)


def _read_length(length: Quantity | None, first: Model | None, units: Units) -> float:
    """The length by which rotations compare with displacements [m].

    Raises:
        RequestError: it is none.
    """
    if length is None:
        return 1.0 if first is None else first.data.size / 2.0
    try:
        value = units.read(length, "m")
    except QuantityError as error:
        raise RequestError(f"the length: {error}") from None
    except (TypeError, ValueError, OverflowError):
        value = math.nan
    if isinstance(length, bool) or not (math.isfinite(value) and value > 0.0):
        raise RequestError(f"the length is a finite number above 0, not {in_short(length)}")
    return value


#: Parameters, what makes a model of their values, and the values at the beginning.
_Source = tuple[tuple[Parameter, ...], Callable[[Mapping[str, float]], Model], dict[str, float]]


def _source(of: object, vary: Any, start: Mapping[str, float] | None) -> _Source:
    """What is varied, of a model or a function.

    Raises:
        RequestError: it is not understood.
        DeckError, ModelError: the model is wrong.
    """
    if isinstance(of, (str, os.PathLike)):
        of = read(of)
    # Of an analysis, or a layout.
    of = held if isinstance(held := getattr(of, "model", None), Model) else of
    if isinstance(of, Model):
        if start is not None:
            raise RequestError("a model begins as it was drawn: start is for a function")
        variation = Variation(of, vary)
        return variation.parameters, variation.model, _begun(variation.parameters)
    if not callable(of):
        raise RequestError(
            "a model, the path of a deck, or a function that makes a model can be refined, not "
            f"{type(of).__name__}"
        )
    build = of
    if not isinstance(vary, Mapping):
        raise RequestError(
            "the parameters of a function are given by name with two bounds, such as "
            'vary={"t": (0.2e-3, 1e-3)}'
        )
    if start is not None and not isinstance(start, Mapping):
        raise RequestError(f"start has a number by name, it is not {in_short(start)}")
    begin = {} if start is None else start
    wrong, parameters = [], []
    for name, given in vary.items():
        pair = list(given) if isinstance(given, (tuple, list, np.ndarray)) else []
        numbers = [float(each) for each in pair if _is_number(each)]
        if not isinstance(name, str) or len(pair) != 2 or len(numbers) != 2:
            wrong.append(f"{in_short(name)} has two numbers as bounds, not {in_short(given)}")
            continue
        low, high = numbers
        if not low < high:
            how = "the same" if low == high else "the wrong way round"
            wrong.append(f"the bounds of {in_short(name)} are {how}")
        elif name in begin and not (_is_number(begin[name]) and low <= begin[name] <= high):
            told = f"{low:g} and {high:g}, not {in_short(begin[name])}"
            wrong.append(f"the start of {in_short(name)} is between its bounds {told}")
        else:
            parameters.append(Parameter(name, low, high, "", begin.get(name)))
    if not vary:
        wrong.append('nothing is varied: say what, such as vary={"t": (0.2e-3, 1e-3)}')
    for name in begin:
        if name not in vary:
            wrong.append(f"start has {in_short(name)}, which is not varied")
    try:
        inspect.signature(build).bind(**{str(name): None for name in vary})
    except TypeError as error:
        wrong.append(f"the function does not take these parameters: {error}")
    except ValueError:
        pass
    if wrong:
        raise RequestError(*wrong)

    def model_of(values: Mapping[str, float]) -> Model:
        try:
            made = build(**values)
        except (ValueError, ArithmeticError) as error:
            if isinstance(error, FlexactError):
                raise
            raise SearchError(f"the function that makes the model: {error}") from error
        if not isinstance(made, Model):
            raise RequestError(f"the function makes no flexact.Model, but {type(made).__name__}")
        made.check()
        return made

    return tuple(parameters), model_of, _begun(parameters)


def _is_number(given: object) -> bool:
    is_one = isinstance(given, (int, float, np.number)) and not isinstance(given, bool)
    return is_one and math.isfinite(given)  # type: ignore[arg-type]


def _begun(parameters: Iterable[Parameter]) -> dict[str, float]:
    """The values at the beginning, within the bounds."""
    return {p.name: p.value(0.5 if p.start is None else p.share(p.start)) for p in parameters}


def _key(given: str) -> str:
    """The name in `ASKED` that is meant.

    Raises:
        RequestError: there is none.
    """
    key = " ".join(given.lower().replace("_", " ").split())
    if key in ASKED:
        return key
    near = nearest(key, ASKED)
    hint = (
        f"did you mean {' or '.join(map(in_short, near))}?"
        if near
        else f"there are {', '.join(ASKED)}"
    )
    raise RequestError(f"there is no {in_short(given)} to ask for: {hint}")


def _goal(maximise: Goal | None, minimise: Goal | None) -> tuple[Goal, bool]:
    """What is to be better, and whether large.

    Raises:
        RequestError: it is none, or two.
    """
    if (maximise is None) == (minimise is None):
        both = "both are given" if maximise is not None else "neither is given"
        raise RequestError(
            f'one of maximise="first parasitic frequency" and minimise=... is wanted: {both}'
        )
    goal = minimise if maximise is None else maximise
    if isinstance(goal, str):
        return _key(goal), maximise is not None
    if not callable(goal):
        raise RequestError(
            f"what is to be better is a name or a function of the state, not {in_short(goal)}"
        )
    return goal, maximise is not None


def _bound(name: str, given: Any, units: Units, is_least: bool = False) -> Bound:
    """A limit that is above 0.

    Raises:
        RequestError, QuantityError: it is none.
    """
    unit = ASKED[name].unit
    try:
        value = float(given) if unit in ("", "m3") else units.read(given, unit)
    except QuantityError as error:
        raise RequestError(f"the limit of {name}: {error}") from None
    except (TypeError, ValueError, OverflowError):
        value = math.nan
    if isinstance(given, bool) or not (math.isfinite(value) and value > 0.0):
        raise RequestError(f"the limit of {name} is a finite number above 0, not {in_short(given)}")
    return Bound(name, value, is_least)


def _limit(text: object, units: Units) -> Bound:
    """A limit such as "first frequency >= 5 Hz".

    Raises:
        RequestError, QuantityError: it is none.
    """
    found = _LIMIT.fullmatch(text) if isinstance(text, str) else None
    if found is None:
        raise RequestError(
            f"a limit is written such as 'first frequency >= 5 Hz', not {in_short(text)}"
        )
    key, value = _key(found["key"]), found["value"]
    unit = ASKED[key].unit
    try:
        given = float(value) if unit in ("", "m3") else quantity(value, units.symbol(unit))
    except QuantityError as error:
        raise RequestError(f"the limit of {key}: {error}") from None
    except ValueError:
        raise RequestError(f"the limit of {key} is a number, not {in_short(value)}") from None
    # In SI it is, whatever the units.
    return _bound(key, given, METRES, found["sign"].startswith(">"))


def _sizes(size: Any, units: Units) -> list[Bound]:
    """Limits of the sides of the box around it.

    Raises:
        RequestError: they are none.
    """
    given = list(size) if isinstance(size, (tuple, list, np.ndarray)) else [size] * 3
    if len(given) != 3:
        raise RequestError("size is the longest side, or three sides, None where one is free")
    return [
        _bound(f"size {'xyz'[k]}", each, units) for k, each in enumerate(given) if each is not None
    ]


def _stroke(
    stroke: Any, drive: tuple[object, str] | None, first: Model, units: Units
) -> tuple[tuple[object, str] | None, tuple[float, ...], bool, str]:
    """The drive, the ends of its stroke in SI, whether these count from rest, and their unit.

    Raises:
        RequestError, QuantityError: it is not understood, not there, fixed, or nothing.
    """
    if drive is None and stroke is None:
        return None, (), True, ""
    given = stroke if isinstance(stroke, (tuple, list, np.ndarray)) else [stroke]
    is_named = (isinstance(stroke, str) and ":" in stroke) or len(given) == 4
    is_offset = True
    if is_named:
        if drive is not None:
            raise RequestError("the drive is named by the stroke already: leave out drive")
        point, name, *given, is_offset = stroke_given(stroke, units)
        drive = point, name
    elif len(given) not in (1, 2):
        raise RequestError("a stroke has one end or two")
    if drive is not None and not (isinstance(drive, (tuple, list)) and len(drive) == 2):
        raise RequestError(
            f"a drive is a point and a coordinate, such as ('stage', 'rz'), not {in_short(drive)}"
        )
    points = Points(first.data)
    if drive is not None:
        drive = _lasting(first, drive[0]), drive[1]
    named = Design(first, How(1, drive, (), True, False, None, 1.0)).drive
    try:
        coordinate = points.coordinate(*named)
    except (ModelError, ElasticError, TypeError) as error:
        raise RequestError(first_words(error)) from None
    if first.data.arrays.coordinate_class[coordinate.axis, coordinate.node] == Class.FIXED:
        raise RequestError(f"{points.words(coordinate)} is fixed and cannot drive")
    if stroke is None:
        return drive, (), True, points.unit(coordinate)
    unit = points.unit(coordinate)
    ends = []
    for end in given:
        try:
            # What names its point is in SI already.
            value = float(end) if is_named else units.read(end, unit)
        except QuantityError as error:
            raise RequestError(f"the stroke: {error}") from None
        except (TypeError, ValueError, OverflowError):
            value = math.nan
        if isinstance(end, bool) or not math.isfinite(value):
            raise RequestError(
                f"a stroke is a finite number [{units.symbol(unit)}], not {in_short(end)}"
            )
        ends.append(value)
    # Angles begin at nothing.
    is_offset = is_offset or unit == "rad"
    place = first.data.arrays.node_value[coordinate.axis, coordinate.node]
    rest = 0.0 if is_offset else float(place)
    away = tuple(dict.fromkeys(end for end in ends if end != rest))
    if not away:
        raise RequestError("the stroke is nothing: it ends where it begins")
    return drive, away, is_offset, unit


def _lasting(first: Model, point: object) -> object:
    """A point that stays the same while places change: by its name, or else its number.

    Raises:
        RequestError: there is no such point.
    """
    if point is None or isinstance(point, str):
        return point
    points = Points(first.data)
    try:
        return points.number(points.node(point))
    except (ModelError, ElasticError, TypeError) as error:
        raise RequestError(first_words(error)) from None


def _require(design: Design, names: Iterable[str], is_at_end: bool, most: int) -> tuple[int, int]:
    """By how much it is over- and under-constrained, where it has what is asked of it.

    Raises:
        RequestError, ElasticError: it has not; or it is constrained in another way than is
            permitted.
    """
    model = design.locked
    model.require_stiffness()
    result = model.result
    if result.under_constrained:
        raise ElasticError(
            f"it is under-constrained by {result.under_constrained}: what moves freely has no "
            "stiffness; hold it, or declare what moves, such as model.independent(point, 'rz')"
        )
    if result.over_constrained > most:
        raise ElasticError(
            f"it is over-constrained by {result.over_constrained}, so that its numbers depend on "
            "how well it is assembled: release something (flexact.analyse(model).advice() tells "
            "what), or refine it as it is with over_constrained=True"
        )
    names = list(names)
    if flat := [each for each in names if model.data.planar and each in ("room", "size z")]:
        raise RequestError(f"a planar model has no {listed(flat)}")
    needs = {need for name in names for need in ASKED[name].needs}
    if "mass" in needs:
        model.require_mass()
    if needs & {"force", "moment", "stroke"} or is_at_end:
        unit = model.points.unit(model.points.coordinate(*design.drive))
        if unit == "rad" and "force" in needs:
            raise RequestError(
                "the drive turns: it has a moment, which moment= limits, and no force"
            )
        if unit == "m" and "moment" in needs:
            raise RequestError("the drive is a displacement: it has a force, which force= limits")
    elif "drive" in needs and not model.locked:
        raise RequestError(
            "a drive is a declared coordinate, and none is: model.independent(point, 'rz')"
        )
    if "point" in needs:
        try:
            model.points.of(design.point)
        except (ModelError, TypeError) as error:
            raise RequestError(first_words(error)) from None
    if "section" in needs:
        sections = model.solvers[0].sections
        is_member = np.isin(
            member_table()[model.data.arrays.element_kind], (Member.BAR, Member.BEAM)
        )
        bears = (model.policy.stiff & ~model.policy.rigid).any(axis=0) & is_member
        for element in np.flatnonzero(bears & ~stays_straight(model.data) & ~sections.is_known):
            sections.require(int(element))
    return result.over_constrained, result.under_constrained


def refined(
    parameters: Sequence[Parameter],
    model_of: Callable[[Mapping[str, float]], Model],
    goal: str | Callable[[State], float],
    maximised: bool,
    bounds: tuple[Bound, ...],
    how: How,
    *,
    most: int = 0,
    also: Callable[[Mapping[str, float]], Mapping[str, float]] | None = None,
    starts: int = 3,
    evaluations: int = 400,
    method: str = "auto",
    seed: int = 0,
    progress: Progress | None = None,
) -> Refined:
    """As `refine`, of parameters and a function that makes the model of their values.

    Args:
        parameters: What is varied.
        model_of: Makes the model; a `FlexactError` says that there is none.
        goal: Of `ASKED`, or a function of the state.
        maximised: Whether that is to be large.
        bounds: What is limited.
        how: Which states are looked at.
        most: By how much it may be over-constrained.
        also: Further limits by name, of the values alone: how far each is used, at most 1.
        starts: See `refine`, as the others.
        evaluations: See `refine`.
        method: See `refine`.
        seed: See `refine`.
        progress: See `refine`.

    Raises:
        RequestError, SearchError, ElasticError: see `refine`.
    """
    beginning = _begun(parameters)
    begun = Design(model_of(beginning), how)
    names = [*(each.name for each in bounds), *([goal] if isinstance(goal, str) else [])]
    over = _require(begun, names, how.is_at_end or bool(how.ends), most)
    known = ASKED.get(goal) if isinstance(goal, str) else None

    def of(design: Design) -> float:
        if known is not None:
            return known.of(design)
        assert callable(goal)
        found = [
            float(goal(replace(s, model=replace(s.model, is_si=False))))
            for s in design.asked("locked")
        ]
        return min(found) if maximised else max(found)

    def measure(values: dict[str, float]) -> Measured:
        further = {} if also is None else dict(also(values))
        design = Design(model_of(values), how)
        result = design.locked.result
        if (result.over_constrained, result.under_constrained) != over:
            raise ElasticError("it is constrained otherwise than at the beginning")
        design.require_stable()
        use = {b.key: b.use(ASKED[b.name].of(design)) for b in bounds}
        return of(design), {**use, **further}

    unit_ = "" if known is None else known.unit
    units = begun.model.data.units
    with load("threadpoolctl").threadpool_limits(1):
        outcome: Outcome = search(
            parameters,
            measure,
            maximise=maximised,
            is_positive=known is not None and known.is_positive,
            starts=starts,
            evaluations=evaluations,
            method=method,
            seed=seed,
            progress=progress,
            said=lambda value: said(value, unit_, units),
        )
        best = outcome.best
        assert best is not None
        model = model_of(best.values)
        name = (
            goal
            if isinstance(goal, str)
            else getattr(goal, "__name__", "objective").replace("_", " ")
        )
        name = "objective" if name == "<lambda>" else name
        finer = {}
        try:
            design = Design(model, how._replace(beams="auto"))
            finer = {name: of(design), **{b.name: ASKED[b.name].of(design) for b in bounds}}
            finer = {each: value for each, value in finer.items() if math.isfinite(value)}
        except (FlexactError, KeyboardInterrupt):
            finer = {}
    return Refined(
        model=model,
        values=best.values,
        parameters=tuple(parameters),
        objective=name,
        maximised=maximised,
        unit=unit_,
        value=best.objective,
        before=next((e.objective for e in outcome.evaluations if e.values == beginning), math.nan),
        bounds=bounds,
        use=best.use,
        is_feasible=best.is_feasible,
        analysis=analyse(model),
        finer=finer,
        evaluations=outcome.evaluations,
        method=outcome.method,
        starts=outcome.starts,
        seed=seed,
        is_interrupted=outcome.is_interrupted,
        at="at the end of the stroke" if how.is_at_end else "at rest",
        units=units,
    )
