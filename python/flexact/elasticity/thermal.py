# SPDX-License-Identifier: BSD-3-Clause
"""Warmth: parts that expand, the ground that may too, and where a point goes then.

A field of temperature T = by + g . (x - about) that is linear in the place bends what it warms
without stress: a free body of one material is displaced by
alpha (by x + (g . x) x - g |x|^2 / 2) and turned by alpha g x x, with x from `about`, which has the
strains alpha T and no others (Boley and Weiner, Theory of Thermal Stresses, 1960). What each
element is off are its deformations where its ends are displaced and turned so.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core import calls
from ..core.arrays import BoolArray, FloatArray
from ..core.elements import Class, NodeKind, Role, role_table
from ..model.data import LARGEST_EXPANSION, ModelData
from ..show.charts import typed
from ..util.matrices import first_largest
from ..util.quantities import without_units
from ..util.records import Frozen
from ..util.rotations import matrix_of, turned
from ..util.text import in_short
from ..util.units import Units
from .equilibria import Imperfection, number_given
from .errors import ElasticError, Estimate
from .points import Points
from .tables import NAMES, carried, cross_matrix, listed, offset_given, plain, words_of

if TYPE_CHECKING:
    from .elastic import Warmed

#: Displacements below this part of what warmth makes of the model's size are rounding.
_ROUNDED = 1.0e-9
#: What a body's place may move for it to be the thermal centre, as a part of its point's drift.
_STILL = 1.0e-6
#: A thermal centre farther than so many sizes of the model is none.
_FAR = 1.0e3
#: Motions and places below this part of what warmth makes of the model's size are not told.
_TOLD = 1.0e-4
#: How many bodies and parts are told of.
_MOST = 6


@dataclass(frozen=True, eq=False)
class Warmth(Frozen):
    """A change of temperature and what expands by it; SI.

    Attributes:
        by: At `about` [K].
        gradient: (3,) of the temperature [K/m].
        about: (3,) where the temperature has changed by `by` [m].
        expansion: (elements,) coefficient of each element that is warmed [1/K], else 0.
        ground: How much warmer the ground is [K], and its coefficient [1/K].
        origin: (3,) the place of the ground that stays where it expands [m].
        is_ground: (elements,) which are of bodies that are clamped at several places: those
            are the ground's own.
        cold: Names of the parts that are warmed and have no coefficient.
    """

    by: float
    gradient: FloatArray
    about: FloatArray
    expansion: FloatArray
    ground: tuple[float, float]
    origin: FloatArray
    is_ground: BoolArray
    cold: tuple[str, ...]

    def free(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(..., 3) displacements and turns at places of a free body, for a unit of alpha."""
        arm = places - self.about
        along = (arm @ self.gradient)[..., None]
        square = np.sum(arm * arm, axis=-1, keepdims=True)
        moved = (self.by + along) * arm - self.gradient * square / 2.0
        return moved, np.cross(self.gradient, arm)

    def misfit(self, data: ModelData) -> FloatArray:
        """(6, elements) what the deck's elements are off: their deformations in a free body."""
        arrays, count = data.arrays, data.arrays.element_number.size
        slots, place = arrays.element_node - 1, np.arange(arrays.node_number.size)
        for p, orientation in ((2, 3), (0, 1)):
            there = (slots[p] >= 0) & (slots[orientation] >= 0)
            place[slots[orientation, there]] = slots[p, there]
        moved, turns = self.free(arrays.node_value[:3, place].T)
        grown = arrays.node_value[:3, place].T - self.origin
        kinds, made = arrays.node_kind, np.zeros((6, count))

        def deformed(which: BoolArray, move: FloatArray, turn: FloatArray) -> None:
            value = arrays.node_value.copy(order="F")
            value[:3] += np.where(kinds <= NodeKind.POSITION, move.T, 0.0)
            value[0] += np.where(kinds == NodeKind.ANGLE, turn[:, 2], 0.0)
            is_whole = kinds == NodeKind.ORIENTATION
            value[:, is_whole] = turned(value[:, is_whole].T, turn[is_whole]).T
            made[:, which] = calls.assemble(data.packed, value, np.zeros(count)).deformation[
                :, which
            ]

        # All of one coefficient at once, so that what is rigid fits together.
        for alpha in np.unique(self.expansion[self.expansion != 0.0]).tolist():
            deformed(self.expansion == alpha, alpha * moved, alpha * turns)
        if self.is_ground.any() and all(self.ground):
            # The ground's own bodies stay as large as the ground.
            deformed(self.is_ground, float(np.prod(self.ground)) * grown, np.zeros_like(grown))
        # What has no place, as a hinge, has no size.
        return np.where((slots[0] >= 0) & (slots[2] >= 0), made, 0.0)

    def imperfection(self, data: ModelData) -> Imperfection:
        """What of the model is off by it."""
        arrays = data.arrays
        arm = arrays.node_value[:3] - self.origin[:, None]
        fixed = arrays.coordinate_class == Class.FIXED
        there = fixed & (arrays.node_kind <= NodeKind.POSITION)
        spread = np.where(there, float(np.prod(self.ground)) * arm, 0.0)
        # It is reached in one way, from none to all of it.
        value = self.by or 1.0
        words = "the temperature [K]" if self.by else "part of the warmth"
        none = np.zeros_like(spread)
        misfit = self.misfit(data) / value
        return Imperfection(words, value, "K", -1, False, np.zeros(3), none, misfit, spread / value)

    def words(self, units: Units) -> str:
        """Such as "10 K warmer, the ground as it was"."""

        def place(vector: FloatArray) -> str:
            return f"{listed(units.shown(vector, 'm'))} {units.symbol('m')}"

        made = _warmer(self.by) if self.by or not self.gradient.any() else ""
        if self.gradient.any():
            slope = listed(units.shown(self.gradient, "K/m"))
            made += f"{' and ' if made else ''}a gradient of {slope} {units.symbol('K/m')}"
            made += f" about {place(self.about)}"
        kelvin, alpha = self.ground
        if not kelvin:
            return f"{made}, the ground as it was"
        return f"{made}, the ground {_warmer(kelvin)} with {alpha:g} /K about {place(self.origin)}"

    def strain(self, size: float) -> float:
        """The largest strain by it in a model of a size [m]."""
        own = abs(self.by) + float(np.linalg.norm(self.gradient)) * size
        ground = abs(float(np.prod(self.ground)))
        return max(float(np.abs(self.expansion).max(initial=0.0)) * own, ground)


def _warmer(kelvin: float) -> str:
    return f"{abs(kelvin):g} K {'warmer' if kelvin >= 0.0 else 'colder'}"


#: What to do where a coefficient is missing.
_WANTED = (
    "give EXPANSION in the deck's dynamics block, a material with an expansion, or one for all "
    "that has none, --expansion 12e-6, in Python expansion=12e-6 or {name of a part: 12e-6}"
)


def warmth_of(
    points: Points,
    by: object,
    parts: object = None,
    gradient: object = None,
    ground: object = None,
    expansion: object = None,
    about: object = None,
) -> Warmth:
    """A change of temperature as users give it; see `Elastic.warmed`.

    Raises:
        UnknownError, ModelError: there is no such part.
        ElasticError: nothing has a coefficient, a part that is named has none, or a value is no
            finite number.
    """
    data, units = points.data, points.data.units
    arrays, count = data.arrays, data.arrays.element_number.size

    def kelvin(value: object) -> float:
        return number_given(without_units(value, "K"), "a change of temperature [K]")

    def coefficient(value: object) -> float:
        made = number_given(without_units(value, "1/K"), "a coefficient of expansion [1/K]")
        if abs(made) > LARGEST_EXPANSION:
            raise ElasticError(
                f"no material has a coefficient of expansion of {made:g} /K: for {made:g} um/m/K "
                f"write {made:g}e-6, or '{made:g} ppm/K'"
            )
        return made

    alpha = np.full(count, np.nan)
    if data.properties is not None:
        alpha = np.array(data.properties.expansion[:, 0])
    if isinstance(expansion, Mapping):
        for part, value in expansion.items():
            alpha[list(points.elements(part))] = coefficient(value)
    elif expansion is not None:
        alpha[np.isnan(alpha)] = coefficient(expansion)

    # Positions of clamps; a body that has several of them is the ground's own.
    held = (arrays.coordinate_class == Class.FIXED)[: 2 if data.planar else 3].all(axis=0)
    places = arrays.node_value[:3].T
    is_place = arrays.node_kind <= NodeKind.POSITION
    clamped = np.flatnonzero(held & is_place)
    is_ground = np.zeros(count, np.bool_)
    for body in points.parts.bodies:
        is_ground[list(body.elements)] = np.isin(body.positions, clamped).sum() > 1
    origin = places[clamped].mean(axis=0) if clamped.size else np.zeros(3)
    ours = 0.0, 0.0
    if ground is not None:
        given = tuple(ground) if isinstance(ground, (list, tuple)) else ()
        if len(given) not in (2, 3):
            raise ElasticError(
                "the ground is given by how much warmer it is [K] and its coefficient [1/K], and "
                f"maybe the place that stays, such as ground=(10, 12e-6), not {in_short(ground)}"
            )
        ours = kelvin(given[0]), coefficient(given[1])
        origin = points.place(given[2]) if len(given) == 3 else origin

    slope = np.zeros(3)
    if gradient is not None:
        numbers = np.zeros(0)
        with suppress(TypeError, ValueError):
            numbers = np.array(without_units(gradient, units.symbol("K/m")), np.float64)
        if numbers.shape not in ((2,), (3,)) or not np.isfinite(numbers).all():
            raise ElasticError(
                "a gradient of temperature has three finite numbers, along x, y and z, not "
                f"{in_short(gradient)}"
            )
        slope[: numbers.size] = numbers
        if data.planar and slope[2]:
            raise ElasticError("the gradient of a planar model is one in its plane")
    middle = (places[is_place].min(axis=0) + places[is_place].max(axis=0)) / 2.0
    centre = middle if about is None else points.place(about)

    which = ~is_ground
    if parts is not None:
        many = isinstance(parts, (list, tuple, set, frozenset, range, np.ndarray))
        chosen = [e for each in (parts if many else (parts,)) for e in points.elements(each)]  # type: ignore[attr-defined]
        which &= np.isin(np.arange(count), chosen)
    # Of what has a size the coefficient counts.
    none = np.zeros(count, np.bool_)
    trial = Warmth(1.0, np.zeros(3), centre, np.ones(count), (0.0, 0.0), origin, none, ())
    sized = which & (np.abs(trial.misfit(data)).max(axis=0) > _ROUNDED * data.size)
    lacks = sized & np.isnan(alpha)
    cold = tuple(
        dict.fromkeys(points.parts.of_element(e).name for e in np.flatnonzero(lacks).tolist())
    )
    if lacks.any() and parts is not None:
        raise ElasticError(f"{cold[0]} has no coefficient of expansion: {_WANTED}")
    if (lacks == sized).all() and not any(ours):
        raise ElasticError(f"nothing that is warmed has a coefficient of expansion: {_WANTED}")
    own = np.where(which, np.nan_to_num(alpha), 0.0)
    return Warmth(kelvin(by), slope, centre, own, ours, origin, is_ground, cold)


@dataclass(frozen=True, eq=False)
class Drift(Frozen):
    """Where a point of a body goes when it is warm, in the units of the model.

    Attributes:
        point: What the point is called.
        place: (3,) where it was.
        directions: (n,) its coordinates.
        values: (n,) how it moves and turns along and about them [m, rad].
        centre: (3,) the place of its body that stays, or that of the axis that does which is
            nearest to the point; None where all of it moves.
    """

    point: str
    place: FloatArray
    directions: tuple[str, ...]
    values: FloatArray
    centre: FloatArray | None


def drift_of(state: Warmed, given: object, at: object = None) -> Drift:
    """How a point moves; see `Warmed.drift`."""
    points, units = state.model.points, state.model.data.units
    point = points.of(given)
    offset = offset_given(points, point, at)
    names = [points.name(each) for each in points.coordinates(point)]
    pairs = zip(state.meshes, state.before.meshes, strict=True)
    every = [carried(s, point, offset, since=t.raw.configuration)[0] for s, t in pairs]
    motion = Estimate.of(*every).value
    place = np.zeros(3)
    if point.position >= 0:
        place = points.data.arrays.node_value[:3, point.position] + offset
    centre = thermal_centre(state, point.position, place, motion)
    which = np.array([NAMES.index(name) for name in names])
    keys = np.where(which < 3, "m", "rad").tolist()
    return Drift(
        f"a place carried by {words_of(points, point)}"
        if at is not None
        else words_of(points, point),
        units.shown(place, "m"),
        tuple(names),
        np.array([units.shown(motion[k], key) for k, key in zip(which, keys, strict=True)]),
        None if centre is None else units.shown(centre, "m"),
    )


def thermal_centre(
    state: Warmed, node: int, place: FloatArray, motion: FloatArray
) -> FloatArray | None:
    """(3,) the place of the body of a node that stays [m], of the motion (6,) of one place of it.

    Newton's iteration, of one step where the temperature is uniform; None where there is none, and
    where parts of the body expand unlike each other.
    """
    warmth, data = state.warmth, state.model.data
    body = state.model.points.parts.body_at.get(node)
    own = np.zeros(1)
    if body is not None:
        elements = list(state.model.points.parts.bodies[body].elements)
        own = warmth.expansion[elements]
        if warmth.is_ground[elements].all():
            return warmth.origin
    alpha, turn = float(own[0]), matrix_of(motion[3:])
    if np.ptp(own):
        return None
    free, own_turn = (alpha * each for each in warmth.free(place))

    def rest(there: FloatArray) -> FloatArray:
        arm = there - place
        more = alpha * warmth.free(there)[0] - free - np.cross(own_turn, arm)
        return np.asarray(motion[:3] + turn @ (arm + more) - arm)

    size, strain = data.size, warmth.strain(data.size)
    most = float(np.linalg.norm(motion[:3]))
    here = place
    for _ in range(20):
        left = rest(here)
        if np.linalg.norm(left) <= max(_ROUNDED * strain * size, _STILL * most):
            return here
        slope = alpha * (warmth.by + float((here - warmth.about) @ warmth.gradient))
        spin = alpha * warmth.free(here)[1] - own_turn
        matrix = turn @ ((1.0 + slope) * np.eye(3) + cross_matrix(spin)) - np.eye(3)
        if np.abs(matrix).max() <= _ROUNDED * strain:
            return None
        here = here - np.linalg.lstsq(matrix, left, rcond=_STILL)[0]
        if np.linalg.norm(here - place) > _FAR * size:
            return None
    return None


def drifts_of(state: Warmed) -> tuple[Drift, ...]:
    """Those of the bodies that move, or of all free points where there is none."""
    points, warmth = state.model.points, state.warmth
    parts = points.parts
    nodes = [
        first
        for body, first in zip(parts.bodies, parts.first_points, strict=True)
        if not warmth.is_ground[list(body.elements)].any()
    ]
    if not nodes:
        arrays = points.data.arrays
        is_free = (arrays.coordinate_class == Class.DEPENDENT).any(axis=0)
        nodes = np.flatnonzero(is_free & (arrays.node_kind <= NodeKind.POSITION)).tolist()
    return tuple(drift_of(state, points.number(node)) for node in nodes)


def found_in(state: Warmed) -> dict[str, Any]:
    """What warmth does, as the JSON has it; numbers are in the units of the model.

    Forces and stresses are those of all that is off, frequencies before and behind.
    """
    model, warmth, units = state.model, state.warmth, state.model.data.units
    arrays, parts = model.data.arrays, model.points.parts
    stretches = role_table()[arrays.element_kind][:, 0] == Role.ELONGATION
    force = np.where(stretches, state.best(lambda at: at.stress[0]), 0.0)
    worst = first_largest(np.abs(force))
    peaks: list[tuple[float, str]] = []
    known = state.finest.solver.sections.is_known
    for part in parts.all:
        if which := [e for e in part.elements if known[e]]:
            every = [at.peaks.von_mises[2, which].max() for at in state.meshes]
            peaks.append((float(Estimate.of(*every)), part.name))
    stress = None
    if peaks:
        value, name = peaks[first_largest(np.array([value for value, _ in peaks]))]
        stress = {"part": name, "value": units.shown(value, "Pa")}
    hertz = None
    if model.has_mass:
        hertz = [float(each.frequencies[0]) for each in (state.before, state)]
    return {
        "by": warmth.by,
        "gradient": units.shown(warmth.gradient, "K/m").tolist(),
        "about": units.shown(warmth.about, "m").tolist(),
        "ground": {
            "by": warmth.ground[0],
            "expansion": warmth.ground[1],
            "about": units.shown(warmth.origin, "m").tolist(),
        },
        "without_expansion": list(warmth.cold),
        "drifts": [
            {
                "point": each.point,
                "place": each.place.tolist(),
                "directions": list(each.directions),
                "drift": each.values.tolist(),
                "per_kelvin": (each.values / warmth.by).tolist() if warmth.by else None,
                "centre": plain(each.centre),
            }
            for each in drifts_of(state)
        ],
        "normal_force": {
            "part": parts.of_element(worst).name,
            "value": float(force[worst]),
        },
        "stress": stress,
        "frequencies": hertz,
        "over_constrained": model.result.over_constrained,
    }


def described(state: Warmed) -> str:
    """The same in words."""
    found, data, warmth = found_in(state), state.model.data, state.warmth
    units, strain = data.units, state.warmth.strain(data.size)
    words = warmth.words(units)
    lines = [f"{words[:1].upper()}{words[1:]}; {state.model.words}."]
    for each in found["drifts"][:_MOST]:
        moves: dict[str, list[str]] = {"m": [], "rad": []}
        for name, value in zip(each["directions"], each["drift"], strict=True):
            unit, way = ("rad", f"about {name[1:]}") if name[0] == "r" else ("m", f"along {name}")
            size = units.si(value, unit)
            if abs(size) > _TOLD * strain * (data.size if unit == "m" else 1.0):
                number = typed(size / (warmth.by or 1.0), unit)
                moves[unit].append(f"{number}{'/K' if warmth.by else ''} {way}")
        both = [
            f"{verb} {' and '.join(moves[unit])}"
            for verb, unit in (("moves by", "m"), ("turns by", "rad"))
            if moves[unit]
        ]
        line = f"{each['point']} {' and '.join(both) or 'stays where it is'}"
        if each["centre"] is not None:
            least = _TOLD * units.shown(data.size, "m")
            centre = listed(np.array(each["centre"]), least)
            line += f"; its thermal centre is at {centre} {units.symbol('m')}"
        elif both:
            line += "; no place of it stays: it has no thermal centre"
        lines.append(f"{line}.")
    if len(found["drifts"]) > _MOST:
        lines.append(f"{len(found['drifts']) - _MOST} more bodies or points: ask drift(point).")
    lines.append(
        f"Over-constrained by {found['over_constrained']}: parts that grow unlike each other "
        "press on each other."
        if found["over_constrained"]
        else "Not over-constrained: there is no thermal self-stress; what stress there is comes "
        "from the flexures that the drift bends."
    )
    force, given, look = found["normal_force"], data.properties, data.appearance
    stiff = np.zeros(1) if given is None else np.nan_to_num(given.stiffness[:, 0])
    rounded, area = _ROUNDED * strain * float(stiff.max()), look.dimensions.prod(axis=1)
    modulus = float((stiff / np.where(area > 0.0, area, math.inf)).max())
    size = abs(force["value"])
    if units.si(size, "N") > rounded:
        word = "pull" if force["value"] > 0.0 else "pressure"
        lines.append(
            f"Largest normal force: {size:.4g} {units.symbol('N')} of {word} in {force['part']}."
        )
    else:
        lines.append("No normal force anywhere.")
    if found["stress"] and units.si(found["stress"]["value"], "Pa") > _ROUNDED * strain * modulus:
        stress = f"{found['stress']['value']:.4g} {units.symbol('Pa')}"
        lines.append(f"Largest stress: {stress} in {found['stress']['part']}.")
    if found["frequencies"]:
        one, two = found["frequencies"]
        change = 100.0 * (two / one - 1.0) if one > 0.0 else math.nan
        digits = 3 if abs(change) >= 99.5 else 2
        told_as = f" ({change:+.{digits}g} %)" if abs(change) > _TOLD else ""
        told_as = f"{two:.5g} Hz then{told_as}" if two >= 0.0 else "and then it has buckled"
        lines.append(f"First frequency: {one:.5g} Hz before, {told_as}.")
    if state.loose:
        lines.append("There is a motion without stiffness: how far it drifts along that is open.")
    if cold := found["without_expansion"]:
        more = f" and {len(cold) - _MOST} more" if len(cold) > _MOST else ""
        lines.append(
            f"Taken as 0, for want of a coefficient of expansion: {', '.join(cold[:_MOST])}{more}."
        )
    return "\n".join((*lines, *(f"Note: {note}." for note in state.notes)))
