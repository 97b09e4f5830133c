# SPDX-License-Identifier: BSD-3-Clause
"""What makes a geometry special, in words."""

from __future__ import annotations

from collections.abc import Sequence

from ...analysis.motions import line_words
from ...analysis.places import axis_words, part_words, with_article
from ...analysis.result import Result
from ...analysis.sentences import Named, Piece, Pieces, plain
from ...core.arrays import FloatArray
from ...model.parts.parts import Part, PartKind
from .cause import LineKind, Relation, RelationKind

#: How many names stand in a row; of more all but one are the first, and how many more there are.
_MOST_NAMES = 6
_FOLDS = {2: "half-turn", 3: "third of a turn", 4: "quarter-turn", 6: "sixth of a turn"}


#: Coordinates below this part of the mechanism's size are zero.
_ZERO = 1.0e-9
#: Relations of parts themselves, not of their lines of force.
_OF_PARTS = (RelationKind.POSITION, RelationKind.ALONG, RelationKind.ACROSS_AXIS)
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
    elif all(one.of is LineKind.AXIS for one in relations) and relations:
        made.append("; that is enough, wherever the joints are")
    return tuple(made)


def limbs_in_words(result: Result, parts: Sequence[Part]) -> Pieces:
    """Limbs, sheets and bars in a row, as "lower 0 and lower 180"."""
    return row_of(limb_names(result, parts))


def limb_names(result: Result, parts: Sequence[Part]) -> list[Named]:
    """What limbs are called: what the names of their parts begin with, where it is all of them."""
    heads: dict[str, list[Part]] = {}
    for part in result.parts.all:
        head = part.name.rpartition(",")[0].strip()
        if head and part.kind is not PartKind.BODY:
            heads.setdefault(head, []).append(part)
    numbers = result.given.arrays.element_number
    chosen = set(parts)
    made: dict[str, Named] = {}
    for part in parts:
        head = part.name.rpartition(",")[0].strip()
        is_whole = len(heads.get(head, ())) > 1 and set(heads[head]) <= chosen
        words = with_article(head) if is_whole else part_words(part)
        made.setdefault(words, Named("element", int(numbers[part.elements[0]]), words))
    return list(made.values())


def row_of(names: Sequence[Named]) -> Pieces:
    """Names in a row; of many the first, and how many more there are."""
    rest = len(names) - _MOST_NAMES
    shown: list[Piece] = list(names if rest <= 0 else names[: _MOST_NAMES - 1])
    if rest > 0:
        shown.append(f"{rest + 1} more")
    made: list[Piece] = []
    for place, name in enumerate(shown):
        made += [" and " if place == len(shown) - 1 else ", "] * (place > 0)
        made.append(name)
    return tuple(made)


def _relation(result: Result, one: Relation, in_short: bool) -> Pieces:
    of = _lines_of(result, one)
    axis = axis_words(one.direction) if one.direction.any() else ""
    line = _line(result, one.point, one.direction) if axis else ""
    kind = one.kind
    if kind in (RelationKind.CIRCLE, RelationKind.TWO_LINES, RelationKind.CONIC):
        figure = {
            RelationKind.CIRCLE: "one circle",
            RelationKind.TWO_LINES: "two straight lines",
        }.get(kind, "one conic")
        return (f"the {len(one.nodes)} joints that are stressed lie on {figure}",)
    tried = "" if in_short else _TRIED
    if kind is RelationKind.ROTATION:
        turn = _FOLDS.get(one.fold, f"turn by {360 // one.fold} degrees")
        article = "an" if turn[0] in "aeiou" else "a"
        what = "what is stressed" if one.of is LineKind.MEMBER else plain(of)
        takes = f"{article} {turn} about {line} takes {what} onto "
        return (f"{takes}{'itself' if one.of is LineKind.MEMBER else 'each other'}{tried}",)
    if kind is RelationKind.REFLECTION:
        return (f"what is stressed is symmetric about {_plane(result, one)}{tried}",)
    if kind is RelationKind.POSITION:
        return (*of, " stand in a special position to each other")
    if kind in (RelationKind.ALONG, RelationKind.ACROSS_AXIS):
        many = len(limb_names(result, one.parts)) > 1
        # The normal of a sheet that is along an axis is what is told.
        is_along = (kind is RelationKind.ALONG) is not (one.of is LineKind.SHEET)
        way = "along" if is_along else "across"
        return (*of, f" lie{'' if many else 's'} {way} {axis}")
    if one.of is LineKind.SHEET and kind is not RelationKind.ONE_PLANE:
        return _of_sheets(result, one, axis, line, in_short)
    words = _common(result, one, axis, line)
    # What lines of force do not stop is told, and not what turns about axes do not.
    is_short = in_short or (one.of is LineKind.AXIS and kind is not RelationKind.REGULUS)
    return (*of, f" {words.partition(', so that')[0] if is_short else words}")


def _of_sheets(result: Result, one: Relation, axis: str, line: str, in_short: bool) -> Pieces:
    """Sheets whose planes contain one line, or that are parallel, and wires with them."""
    sheets = limb_names(result, [part for part in one.parts if part.kind is PartKind.SHEET])
    wires = limb_names(result, [part for part in one.parts if part.kind is not PartKind.SHEET])
    many, s = len(sheets) > 1, "s" if len(wires) == 1 else ""
    made: list[Piece] = [*row_of(sheets)]
    if one.kind is RelationKind.ACROSS:
        made.append(" are parallel" if many else f" lies across {axis}")
        if wires:
            made += [" and ", *row_of(wires), f" lie{s} along {'them' if many else 'it'}"]
        what = f"the translation along {axis}"
    else:
        made = [f"the plane{'s' if many else ''} of ", *made, f" contain{'' if many else 's'}"]
        made += [" one line"] + ([" that ", *row_of(wires), f" meet{s}"] if wires else [])
        what = f"the rotation about {line}"
    return tuple(made) if in_short else (*made, f", so that none of them stops {what}")


def _common(result: Result, one: Relation, axis: str, line: str) -> str:
    """What lines have in common."""
    point = _point(result, one.point)
    turn = f"the rotation about {line}"
    move = f"the translation along {axis}"
    words = {
        RelationKind.ONE_LINE: "lie along one line",
        RelationKind.PARALLEL: "are parallel",
        RelationKind.ONE_PLANE: "lie in one plane",
        RelationKind.CONCURRENT: f"meet in one point, {point} m",
        RelationKind.ONE_TRANSVERSAL: f"all meet one line, so that none of them stops {turn}",
        RelationKind.ACROSS: f"all lie across {axis}, so that none of them stops {move}",
        RelationKind.REGULUS: "lie on one hyperboloid, so that turns about them cancel out",
        RelationKind.COMPLEX: "belong to one linear complex, so that none of them stops the screw "
        f"motion about {line} of pitch {one.pitch:.4g} m/rad",
    }
    return words[one.kind]


def _lines_of(result: Result, one: Relation) -> Pieces:
    """The lines of a relation: of limbs of two sheets fold lines, of bars and wires they."""
    names = row_of(limb_names(result, one.parts))
    if one.of is LineKind.AXIS:
        many = len(limb_names(result, one.parts)) > 1
        return (f"the ax{'e' if many else 'i'}s of ", *names)
    if one.of is not LineKind.FORCE or one.kind in _OF_PARTS:
        return names
    kinds = {part.kind for part in one.parts}
    if kinds <= {PartKind.WIRE, PartKind.BAR}:
        return names
    folded = kinds == {PartKind.SHEET} and len(one.parts) == 2 * _limbs(one)
    return ("the fold lines of " if folded else "the lines of force of ", *names)


def _limbs(one: Relation) -> int:
    """How many heads of names there are among the parts."""
    return len({part.name.rpartition(",")[0].strip() or part.name for part in one.parts})


def _line(result: Result, point: FloatArray, direction: FloatArray) -> str:
    return line_words(result, point, direction)


def _plane(result: Result, one: Relation) -> str:
    point = _point(result, one.point)
    return f"the plane through {point} m across {axis_words(one.direction)}"


def _point(result: Result, place: FloatArray) -> str:
    small = _ZERO * result.characteristic_length
    numbers = [0.0 if abs(value) < small else value for value in place.tolist()]
    return f"({', '.join(f'{value:.4g}' for value in numbers[: 2 if result.given.planar else 3])})"
