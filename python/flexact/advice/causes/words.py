# SPDX-License-Identifier: BSD-3-Clause
"""Causes of motions and self-stresses, and the relations that make a geometry special, in words."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...analysis.mode_basis import coordinate_key, row_key
from ...analysis.mode_words import line_words
from ...analysis.naming import (
    Named,
    Piece,
    Pieces,
    angle_in_words,
    coordinate_in_words,
    deformation_in_words,
    in_words,
    length_in_words,
    named_element,
    named_node,
    plain,
    row_of,
)
from ...analysis.places import axis_words, end_words, listed, part_words, with_article
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import AXES, Class, coordinate_name
from ...model.parts.parts import Part, PartKind
from ...util.groups import grouped
from .cause import Cause, CauseKind, Causes, Relation

#: What is below this part of the largest, or of what is added up, is none.
_REST = 1.0e-7


def driven_against(result: Result, k: int) -> list[Pieces]:
    """The declared freedoms on which a self-stress of a result acts, by name.

    Deformations, then coordinates at which what the elements exert does not cancel out.

    Args:
        result: The result.
        k: Index of the self-stress.
    """
    arrays, raw = result.data.arrays, result.raw
    place, value = result.stress_basis.entries(k)
    element, deformation = raw.row_label[:, place] - 1
    weighted = np.abs(value / raw.row_scale[place])
    carries = weighted > _REST * weighted.max(initial=0.0)
    independent = arrays.deformation_class[deformation, element] == Class.INDEPENDENT
    rows = sorted(
        np.flatnonzero(carries & independent).tolist(),
        key=lambda i: row_key(result, int(place[i])),
    )
    numbers = arrays.element_number
    made = [
        deformation_in_words(result, int(numbers[element[i]]), int(deformation[i]) + 1)
        for i in rows
    ]
    classes = arrays.coordinate_class.T
    if not np.any(classes == Class.INDEPENDENT):
        return made
    sigma = np.zeros(6 * arrays.element_number.size)
    sigma[6 * element + deformation] = value
    whole = result.assembly
    terms = whole.value * sigma[whole.row_of]
    total = np.bincount(whole.column_of, terms, classes.size)
    added = np.bincount(whole.column_of, np.abs(terms), classes.size)
    acts = (np.abs(total) > _REST * added.max(initial=0.0)) & (classes == Class.INDEPENDENT).ravel()
    found = [divmod(index, 3) for index in np.flatnonzero(acts).tolist()]
    for node, axis in sorted(found, key=lambda each: coordinate_key(result, *each)):
        kind = int(arrays.node_kind[node])
        if axis in AXES[kind]:
            number, name = int(arrays.node_number[node]), coordinate_name(kind, axis)
            made.append(coordinate_in_words(result, number, name))
    return made


#: How many names stand in a row, and of declared freedoms.
_MOST_NAMES, MOST_NAMED = 6, 3
_FOLDS = {2: "half-turn", 3: "third of a turn", 4: "quarter-turn", 6: "sixth of a turn"}


#: Coordinates below this part of the mechanism's size are zero.
_ZERO = 1.0e-9
#: What joints lie on, and what lines have in common, by the relation.
_FIGURES = {
    "circle": "one circle",
    "two lines": "two straight lines",
    "conic": "one conic",
}
_COMMON = {
    "one line": "lie along one line",
    "parallel": "are parallel",
    "one plane": "lie in one plane",
    "concurrent": "meet in one point, {point}",
    "one transversal": "all meet one line, so that none of them stops the rotation about {line}",
    "across": "all lie across {axis}, so that none of them stops the translation along {axis}",
    "regulus": "lie on one hyperboloid, so that turns about them cancel out",
    "complex": "belong to one linear complex, so that none of them stops the screw "
    "motion about {line} of pitch {pitch}",
}
#: Relations of parts themselves, not of their lines of force.
_OF_PARTS = ("position", "along", "across axis")
_TRIED = "; other geometries with this symmetry were tried and have it too"


def relations_in_words(
    result: Result, relations: Sequence[Relation], in_short: bool = False
) -> Pieces:
    """Relations as one clause, such as "the fold lines of lower 0 and lower 180 are parallel".

    Args:
        result: The result.
        relations: What makes its geometry special.
        in_short: Whether only they are said, and not what follows, or what was tried.
    """
    made: list[Piece] = []
    for k, one in enumerate(relations):
        words = _relation(result, one, in_short)
        same = k > 0 and one.parts == relations[k - 1].parts and one.of is relations[k - 1].of
        made += [" and" if same else ", and "] * (k > 0) + list(words[-1:] if same else words)
    if in_short:
        return tuple(made)
    about = [one.couple for one in relations if one.couple.any()]
    if about and len(about) == len(relations) > 1:
        made.append(
            f"; by a couple {'each' if len(about) > 2 else 'either'} of these groups "
            f"holds the rotation about {axis_words(about[0])}"
        )
    elif all(one.of == "axis" for one in relations) and relations:
        made.append("; that is enough, wherever the joints are")
    return tuple(made)


def _head(part: Part) -> str:
    """What the name of a part of a limb begins with; empty where it is of none."""
    return part.name.rpartition(",")[0].strip()


def limb_names(result: Result, parts: Sequence[Part]) -> list[Named]:
    """What limbs are called: what the names of their parts begin with, where it is all of them."""
    able = (part for part in result.parts.all if _head(part) and part.kind is not PartKind.BODY)
    heads = grouped((_head(part), part) for part in able)
    numbers = result.given.arrays.element_number
    chosen = set(parts)
    made: dict[str, Named] = {}
    for part in parts:
        mine = heads.get(_head(part), ())
        is_whole = len(mine) > 1 and set(mine) <= chosen
        words = with_article(_head(part)) if is_whole else part_words(part)
        made.setdefault(words, Named("element", int(numbers[part.elements[0]]), words))
    return list(made.values())


def names_in_words(names: Sequence[Named]) -> Pieces:
    """Names in a row; of many the first, and how many more there are."""
    most = None if len(names) <= _MOST_NAMES else _MOST_NAMES - 1
    return row_of([(name,) for name in names], most)


def _relation(result: Result, one: Relation, in_short: bool) -> Pieces:
    of, kind = _lines_of(result, one), one.kind
    axis = axis_words(one.direction) if one.direction.any() else ""
    line = line_words(result, one.point, one.direction) if axis else ""
    tried = "" if in_short else _TRIED
    if kind in _FIGURES:
        return (f"the {len(one.nodes)} joints that are stressed lie on {_FIGURES[kind]}",)
    if kind == "rotation":
        turn = _FOLDS.get(one.fold, f"turn by {360 // one.fold} degrees")
        article = "an" if turn[0] in "aeiou" else "a"
        is_member = one.of == "member"
        what, onto = ("what is stressed", "itself") if is_member else (plain(of), "each other")
        return (f"{article} {turn} about {line} takes {what} onto {onto}{tried}",)
    if kind == "reflection":
        plane = f"the plane through {_point(result, one.point)} across {axis}"
        return (f"what is stressed is symmetric about {plane}{tried}",)
    if kind == "position":
        return (*of, " stand in a special position to each other")
    if kind in ("along", "across axis"):
        many = len(limb_names(result, one.parts)) > 1
        # The normal of a sheet that is along an axis is what is told.
        is_along = (kind == "along") is not (one.of == "sheet")
        way = "along" if is_along else "across"
        return (*of, f" lie{'' if many else 's'} {way} {axis}")
    if one.of == "sheet" and kind != "one plane":
        return _of_sheets(result, one, axis, line, in_short)
    point = _point(result, one.point)
    pitch = result.given.units.said(one.pitch, "m/rad")
    words = _COMMON[kind].format(point=point, axis=axis, line=line, pitch=pitch)
    # What lines of force do not stop is told, and not what turns about axes do not.
    is_short = in_short or (one.of == "axis" and kind != "regulus")
    return (*of, f" {words.partition(', so that')[0] if is_short else words}")


def _of_sheets(result: Result, one: Relation, axis: str, line: str, in_short: bool) -> Pieces:
    """Sheets whose planes contain one line, or that are parallel, and wires with them."""
    sheets = limb_names(result, [part for part in one.parts if part.kind is PartKind.SHEET])
    wires = limb_names(result, [part for part in one.parts if part.kind is not PartKind.SHEET])
    many, s = len(sheets) > 1, "s" if len(wires) == 1 else ""
    made: list[Piece] = [*names_in_words(sheets)]
    if one.kind == "across":
        made.append(" are parallel" if many else f" lies across {axis}")
        if wires:
            made += [" and ", *names_in_words(wires), f" lie{s} along {'them' if many else 'it'}"]
        what = f"the translation along {axis}"
    else:
        made = [f"the plane{'s' if many else ''} of ", *made, f" contain{'' if many else 's'}"]
        made += [" one line"] + ([" that ", *names_in_words(wires), f" meet{s}"] if wires else [])
        what = f"the rotation about {line}"
    return tuple(made) if in_short else (*made, f", so that none of them stops {what}")


def _lines_of(result: Result, one: Relation) -> Pieces:
    """The lines of a relation: of limbs of two sheets fold lines, of bars and wires they."""
    names = names_in_words(limb_names(result, one.parts))
    if one.of == "axis":
        many = len(limb_names(result, one.parts)) > 1
        return (f"the ax{'e' if many else 'i'}s of ", *names)
    if one.of != "force" or one.kind in _OF_PARTS:
        return names
    kinds = {part.kind for part in one.parts}
    if kinds <= {PartKind.WIRE, PartKind.BAR}:
        return names
    limbs = {_head(part) or part.name for part in one.parts}
    folded = kinds == {PartKind.SHEET} and len(one.parts) == 2 * len(limbs)
    return ("the fold lines of " if folded else "the lines of force of ", *names)


def _point(result: Result, place: FloatArray) -> str:
    small = _ZERO * result.characteristic_length
    units, count = result.given.units, 2 if result.given.planar else 3
    numbers = [0.0 if abs(value) < small else units.shown(value, "m") for value in place.tolist()]
    return f"({', '.join(f'{value:.4g}' for value in numbers[:count])}) {units.symbol('m')}"


_LIFTS = "lifts its singular value from zero to about"
_UNKNOWN: Pieces = ("whether another geometry would have it was not looked at",)
#: The misalignment for which a rate is told: the power of ten below this part of the size.
_SMALL, _ANGLE = 1.0e-2, 1.0e-3
#: Of more modes among which some are special it is told how many there are.
_MOST_TOGETHER = 20


def cause_of_motion_in_words(result: Result, k: int, causes: Causes) -> Pieces:
    """Why a motion of a result is there, as a sentence or two without their last stop."""
    generic = "generic: in any geometry of these parts nothing stops it"
    return _cause(result, causes.motions[k], "motions", generic)


def cause_of_stress_in_words(result: Result, k: int, causes: Causes) -> Pieces:
    """Why a self-stress of a result is there, likewise, and which declared freedoms it acts on."""
    generic = "generic: any geometry of these parts has it; better alignment does not help"
    cause = causes.self_stresses[k]
    words = _cause(result, cause, "self-stresses", generic)
    names = [] if cause.kind is CauseKind.UNKNOWN else driven_against(result, k)
    if not names:
        return words
    row, is_one = row_of(names, MOST_NAMED), len(names) == 1
    end = (
        ", which the constraints hold already" if is_one else ": these cannot be driven one by one"
    )
    return (*words, ". It acts on what is declared, ", *row, end)


def _cause(result: Result, cause: Cause, modes: str, generic: str) -> Pieces:
    if cause.kind is CauseKind.UNKNOWN:
        return _UNKNOWN
    if cause.kind is CauseKind.GENERIC and not cause.together:
        return (generic,)
    made: list[Piece] = [_of_several(cause, modes) if cause.together else "special: it"]
    made.append(" lives on this geometry")
    if cause.relations:
        made += [", where ", *relations_in_words(result, cause.relations)]
    if cause.is_first_order is not None:
        made += [". ", *_misalignment(result, cause)]
    return tuple(made)


def _of_several(cause: Cause, modes: str) -> str:
    """Which of several are special, where that depends on the misalignment."""
    many = len(cause.together)
    rest = many - cause.special
    some = "one is" if cause.special == 1 else f"{in_words(cause.special)} are"
    others = "the other is" if rest == 1 else f"the other {in_words(rest)} are"
    numbers = listed([str(k + 1) for k in cause.together])
    these = f"{modes} {numbers}" if many <= _MOST_TOGETHER else f"{many} {modes}"
    is_known = cause.is_first_order is not None
    which = "depends on the misalignment" if is_known else "was not looked at"
    return f"of {these} {some} special and {others} generic, and which {which}. What is special"


def _misalignment(result: Result, cause: Cause) -> Pieces:
    """What lifts the zero singular value of a special mode, and how fast."""
    lift = cause.lift
    if lift is None:
        return ("No small misalignment of one node or element lifts it to first order",)
    made: list[Piece] = []
    if lift.node is not None:
        length = _SMALL * result.characteristic_length
        step = float(10.0 ** math.floor(math.log10(length)))
        made += [
            *("Moving ", _point_named(result, lift.node), f" by {length_in_words(step)}"),
            f" {_LIFTS} {lift.by_move * step:.2g}",
            f" ({lift.by_move:.2g} per metre)",
        ]
    if lift.element is not None:
        made += [
            *(", turning " if made else "Turning ", named_element(result, lift.element)),
            f" by {angle_in_words(_ANGLE)}",
            f" {'to about' if lift.node is not None else _LIFTS} "
            f"{lift.by_turn * _ANGLE:.2g} ({lift.by_turn:.2g} per radian)",
        ]
    return tuple(made)


def _point_named(result: Result, node: int) -> Named:
    """A node; where one part ends at a body, this end."""
    parts = result.parts
    index = parts.data.node_index[node]
    others = [part for part in parts.at(index) if part.kind is not PartKind.BODY]
    if index not in parts.body_at or len(others) != 1 or parts.name_of_point(index):
        return named_node(result, node)
    return Named("node", node, end_words(parts, index))
