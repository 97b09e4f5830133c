# SPDX-License-Identifier: BSD-3-Clause
"""What a freedom takes, in words and as JSON, and which freedoms near it are possible."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..advice.json import of_space
from ..advice.spaces.screws import Family, FamilyKind, ScrewSpace
from ..advice.spaces.words import Geometry, space_in_words
from ..analysis.naming import Line, Pieces, filled, line_of, plain
from ..analysis.places import axis_words, listed
from ..core.arrays import FloatArray
from ..util.loading import VERSION
from ..util.records import Frozen, cached_property
from ..util.text import number_in_words
from ..util.units import METRES, Units
from .possible import Possible, layers_of, orthonormal, possible
from .problem import Box, Problem

Entries = dict[str, Any]

#: How many wires a waisted sheet stands for.
_WAISTED = 2
#: How families of lines are told as places where wires are.
_EVERY_LINE = "all lines "


@dataclass(frozen=True, eq=False)
class Explanation(Frozen):
    """What a freedom takes, to be told, saved and handed on.

    Attributes:
        found: What it takes.
        title: Of pictures and pages.
        body: Whose freedom it is.
        wanted: The wanted motions as they were written; else they are told by what they are.
        typed: (n, 6) their twists in that order, for layers and smaller freedoms of them.
        boxes: Of the body, which are drawn lightly.
        units: Of lengths.
    """

    found: Possible
    title: str = "What the freedom takes"
    body: str = "the stage"
    wanted: tuple[str, ...] = ()
    typed: FloatArray = field(default_factory=lambda: np.zeros((0, 6)))
    boxes: tuple[Box, ...] = ()
    units: Units = METRES

    @cached_property
    def lines(self) -> tuple[Line, ...]:
        """In words."""
        return tuple(_lines(Geometry(self.units, self.found.freedom.length), self))

    def __str__(self) -> str:
        """The lines as text."""
        return "\n".join(map(filled, self.lines))

    def to_json(self) -> str:
        """One object in one line."""
        return json.dumps(explained_json(self.found, self.typed), allow_nan=False)


def explain(problem: Problem) -> Explanation:
    """What the wanted freedom of a problem takes."""
    wanted = tuple(motion.text for motion in problem.wanted)
    typed = np.array([motion.twist for motion in problem.wanted]).reshape(-1, 6)
    body = "the stage" if problem.base is None else problem.body
    return Explanation(
        *(possible(problem.freedom), problem.title, body, wanted, typed),
        *(problem.stage.boxes, problem.units),
    )


def _lines(geometry: Geometry, made: Explanation) -> Iterator[Line]:
    found, body, typed = made.found, made.body, made.typed
    count = found.dimension
    if not count:
        yield line_of(f"Wanted of {body}: nothing; it is held in all six ways.")
    else:
        motions = f"{number_in_words(count)} independent motion{'s' * (count > 1)}"
        written = list(dict.fromkeys(made.wanted))
        families = space_in_words(geometry, found.freedom)
        items: tuple[Pieces, ...] = tuple((each,) for each in written) or families
        yield Line((f"Wanted of {body}: {motions}: ",), items)
        if {plain(each) for each in families} != {plain(each) for each in items}:
            yield Line(("That is: ",), families)
    yield from _nearness(geometry, found)
    needed = found.needed
    if not needed:
        yield line_of("It takes no constraint: every motion is wanted.")
        return
    many = f"{number_in_words(needed)} constraint{'s' * (needed > 1)}"
    yield Line((f"It takes {many}: ",), space_in_words(geometry, found.constraint))
    yield from _in_parallel(geometry, found) if found.parallel else _otherwise(geometry, found)
    yield from _layers(geometry, found, typed)
    if not found.parallel:
        for _, statement in nearby(found, typed, units=geometry.units):
            yield line_of(statement)


def _nearness(geometry: Geometry, found: Possible) -> Iterator[Line]:
    """That a freedom was taken for a special one, or is near one."""
    if found.off:
        yield line_of(
            f"What was given is off this by {found.off:.1g}, a part of {_size(geometry)} or an "
            "angle in rad; it was taken for this, which is special."
        )
    if found.nearly is not None:
        off = found.freedom.sine_to(found.nearly)
        yield Line(
            (
                f"It is off a special freedom by no more than {off:.1g}, a part of "
                f"{_size(geometry)} or an angle in rad; if that was meant, write it with more "
                "digits: ",
            ),
            space_in_words(geometry, found.nearly),
        )


def _size(geometry: Geometry) -> str:
    return geometry.units.said(geometry.length, "m")


def _counted(count: int, thing: str) -> str:
    """Such as "two wires", "a wire", "no wire"."""
    if count == 1:
        return f"a {thing}"
    plural = thing if thing.endswith("ows") else f"{thing}s"
    return f"{number_in_words(count)} {plural}"


def _with_wires(first: str, wires: int) -> str:
    return f"{first} and {_counted(wires, 'wire')}" if wires else first


def _in_parallel(geometry: Geometry, found: Possible) -> Iterator[Line]:
    """What flexures in parallel leave the freedom and nothing else."""
    needed = found.needed
    along = places_of_wires(geometry, found.constraint)
    yield line_of(f"Wires alone: {number_in_words(needed)}, {along}.")
    yield line_of(
        f"Folded sheets: {number_in_words(needed)}, with the line of each fold such a line."
    )
    if found.with_sheet is not None:
        where, rest = _of_sheet(geometry, found), found.with_sheet[1]
        words = f"A sheet {where}" + f", and {_counted(rest, 'wire')}" * (rest > 0)
        if rest >= _WAISTED:
            others = " and" if rest == _WAISTED else ","
            words += f"; or such a sheet{others} a waisted sheet"
            words = _with_wires(words, rest - _WAISTED)
        yield line_of(f"{words}.")
        if found.dimension == 1:
            yield line_of("Two whole sheets: over-constrained by one.")
    else:
        yield line_of("No whole sheet: in any place it would stop something that is wanted.")
    if found.waisted is not None:
        sheets, wires = found.waisted
        words = _counted(sheets, "waisted sheet")
        yield line_of(f"{_begun(_with_wires(words, wires))}.")
    if found.notch is not None:
        words = "a notch, or a cross hinge, with its axis on the line"
        words = words if found.dimension else "a notch or a cross hinge,"
        yield line_of(f"{_begun(_with_wires(words, found.notch[1]))}.")
    if found.rod is not None:
        words = "a rod with two parallel notches, their axes in such a plane"
        yield line_of(f"{_begun(_with_wires(words + ',' * (found.rod[1] > 0), found.rod[1]))}.")


def _of_sheet(geometry: Geometry, found: Possible) -> str:
    """Where a whole sheet may be."""
    where = found.sheet
    if where is None or where.kind is FamilyKind.EVERY:
        return "in any plane"
    if where.kind is FamilyKind.LINE:
        return f"in any plane that contains {geometry.line(where.point, where.direction)}"
    if where.kind is FamilyKind.DIRECTION:
        return f"in any plane perpendicular to {axis_words(where.direction)}"
    return f"in {geometry.plane(where)}"


def _otherwise(geometry: Geometry, found: Possible) -> Iterator[Line]:
    """What wires alone leave besides, and what holds it nevertheless."""
    wires, couples, pitched = found.limbs
    if wires:
        head = f"Wires alone leave more: {_wires(wires)} {places_of_wires(geometry, found.forces)}"
        more = " leaves besides: " if wires == 1 else ", all that are independent, leave besides: "
        yield Line((head + more,), space_in_words(geometry, found.extra))
    else:
        yield line_of(
            "No wire can hold it: a force along any line would do work on what is wanted."
        )
    lacking = [_counted(couples, "couple")] * (couples > 0)
    if pitched:
        own = "its own line" if pitched == 1 else "their own lines"
        lacking.append(f"{_counted(pitched, 'force')} with a moment about {own}")
    rest = f"Besides {_wires(wires)} it" if wires else "It"
    yield line_of(f"{rest} takes {listed(lacking)}, which no wire gives.")
    if couples:
        each = "a couple" if couples == 1 else "each couple"
        yield line_of(
            f"For {each}: a bellows, or a limb: a body on a hinge, and beside the hinge two "
            "parallel wires across it, to the stage."
        )
    if pitched:
        each = "the force with a moment" if pitched == 1 else "each force with a moment"
        yield line_of(f"For {each}: a limb: a body on a hinge, and two skew wires to the stage.")


def _layers(geometry: Geometry, found: Possible, typed: ArrayLike) -> Iterator[Line]:
    """The layers that come first to mind."""
    if found.least_layers == 1:
        return
    first = next(layers_of(found.freedom, typed), ())
    items = tuple((_layer(geometry, each),) for each in first)
    head = f"{_begun(number_in_words(found.least_layers))} layers, from the ground, each on wires: "
    yield Line((head,), items)


def _layer(geometry: Geometry, space: ScrewSpace) -> str:
    return f"{motions_in_words(geometry, space)}, on {_wires(6 - space.dimension)}"


def _begun(words: str) -> str:
    return words[:1].upper() + words[1:]


def motions_in_words(geometry: Geometry, space: ScrewSpace) -> str:
    """A freedom in few words, such as "x, y and rotation about z"."""
    if space.dimension == 6:
        return "every motion"
    families, made = space.families, []
    kinds = {family.kind for family in families}
    for family in (each for each in families if each.is_of_directions):
        made += _translations(family)
    for family in families:
        if family.is_of_directions:
            continue
        is_plain = family.kind is FamilyKind.PARALLELS and len(kinds) == 2
        about = axis_words(family.direction) if is_plain else geometry.of(family)
        if family.kind is FamilyKind.SCREW:
            pitch = geometry.units.said(family.pitch, "m/rad")
            made.append(f"a screw about {about}, pitch {pitch}")
        else:
            made.append(f"rotation about {about}")
    return listed(made)


def _wires(count: int) -> str:
    return f"{number_in_words(count)} wire{'s' * (count != 1)}"


def _translations(family: Family) -> list[str]:
    if family.kind is FamilyKind.EVERY_DIRECTION:
        return ["x", "y", "z"]
    if family.kind is FamilyKind.DIRECTION:
        return [f"translation along {axis_words(family.direction)}"]
    normal = axis_words(family.normal)
    if normal in ("x", "y", "z"):
        return [axis for axis in "xyz" if axis != normal]
    return [f"translation along every direction perpendicular to {normal}"]


def places_of_wires(geometry: Geometry, space: ScrewSpace) -> str:
    """Where wires that hold a space are, such as "along z" or "through (0, 0, 0) m"."""
    words = [geometry.of(family) for family in space.lines]
    if words == ["every line"]:
        return "along any lines that are independent"
    if not all(each.startswith(_EVERY_LINE) for each in words):
        return f"along {' or '.join(words)}"
    where = [each.removeprefix(_EVERY_LINE) for each in words]
    return " or ".join(f"on lines {each}" if each.startswith("that") else each for each in where)


# Freedoms near it ----------------------------------------------------------------------


def nearby(
    found: Possible, typed: ArrayLike = (), *, units: Units = METRES
) -> tuple[tuple[ScrewSpace, str], ...]:
    """Freedoms near one that wires cannot leave, each of which they can, and why.

    The one that wires alone leave, which is larger; then smaller ones, without one of the wanted
    motions, or without more of them where that is not enough.

    Args:
        found: What the freedom takes.
        typed: (6,) the wanted motions, in their order; else its own directions and screws.
        units: Of lengths.
    """
    geometry, made = Geometry(units, found.freedom.length), []
    if found.extra_dimension and found.forces.dimension:
        words = motions_in_words(geometry, found.alone)
        wires = f"{_wires(found.forces.dimension)} {places_of_wires(geometry, found.forces)}"
        made.append((found.alone, f"More freedom is possible: {words}, with {wires}."))
    for smaller in _smaller(found.freedom, typed):
        words = motions_in_words(geometry, smaller)
        wires = f"{_wires(6 - smaller.dimension)} {places_of_wires(geometry, smaller.reciprocal)}"
        made.append((smaller, f"Less freedom is possible: {words}, with {wires}."))
    return tuple(made)


def _smaller(freedom: ScrewSpace, typed: ArrayLike) -> list[ScrewSpace]:
    """The spaces of all wanted motions but some, that wires can leave: as few as will do."""
    rows, count = np.array(typed).reshape(-1, 6) * freedom.factors, freedom.dimension
    if len(rows) != count or len(orthonormal(rows)) != count:
        rows = freedom.scaled
    # What is taken for special is a little off what was typed.
    rows = rows @ freedom.scaled.T @ freedom.scaled
    for left in range(count - 1, 0, -1):
        kept = (
            freedom.of_scaled(orthonormal(rows[list(k)])) for k in combinations(range(count), left)
        )
        able = [space for space in kept if Possible(space).parallel]
        if able:
            return able
    return []


# JSON -----------------------------------------------------------------------------------

#: Raised where a name of the JSON is taken away, renamed, or means something else.
FORMAT = 1


def kinds_json(found: Possible) -> Entries:
    """The least number of each kind of flexure, of layers and limbs; null where none does it."""
    lines, couples, pitched = found.limbs
    return {
        "wires": found.wires,
        "folded_sheets": found.wires,
        "sheet": _pair(found.with_sheet),
        "waisted_sheets": _pair(found.waisted if found.parallel else None),
        "notch": _pair(found.notch),
        "rod": _pair(found.rod),
        "bellows": _pair(found.bellows),
        "layers": found.least_layers,
        "limbs": {"wires": lines, "couples": couples, "wrenches": pitched},
        "extra": found.extra_dimension,
    }


def _pair(pair: tuple[int, int] | None) -> list[int] | None:
    return None if pair is None else list(pair)


def explained_json(found: Possible, typed: ArrayLike = ()) -> Entries:
    """What a freedom takes: the head of what `flexact design --json` prints."""
    return {
        "format": FORMAT,
        "flexact": VERSION,
        "wanted": {
            **of_space(found.freedom),
            "principal_screws": [
                {
                    "direction": screw.direction.tolist(),
                    "point": None if screw.is_of_directions else screw.point.tolist(),
                    "pitch": None if screw.is_of_directions else screw.pitch,
                }
                for screw in found.freedom.principal
            ],
            "off": found.off,
        },
        "constraint": of_space(found.constraint),
        "parallel": found.parallel,
        "needed": found.needed,
        "kinds": kinds_json(found),
        "signature_freedom": list(found.signature_freedom),
        "signature_constraint": list(found.signature_constraint),
        "extra": of_space(found.extra),
        "nearby": [] if found.parallel else nearby_json(found, typed),
    }


def nearby_json(found: Possible, typed: ArrayLike = ()) -> list[Entries]:
    """The freedoms near one that wires can leave."""
    return [
        {"statement": statement, "dimension": space.dimension, "freedom": of_space(space)}
        for space, statement in nearby(found, typed)
    ]
