# SPDX-License-Identifier: BSD-3-Clause
"""Deformations by number and word: which of a part are meant, and giving them classes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..core.elements import Class, Role, element_kinds
from ..core.raw import ElementKind
from ..deck.rendering import model_error
from ..util.text import in_short
from .arguments import existing, indices_of, part, whole
from .draft import Draft
from .handles import (
    Assembly,
    Body,
    CutNotch,
    Element,
    FoldedSheet,
    Node,
    Part,
    ReinforcedSheet,
    Sheet,
)
from .names import is_coordinate, nearest
from .parts.forms import AT_P, AT_Q, PLANAR, XY, XZ
from .transform import NO_VECTOR

#: What each word means, as `_plain` spells it.
_ROLES: dict[str, tuple[Role, ...]] = {
    "elongation": (Role.ELONGATION,),
    "twist": (Role.TORSION,),
    "torsion": (Role.TORSION,),
    "bending": (*XZ, *XY, *PLANAR),
    "bending about y": XZ,
    "bending about z": (*XY, *PLANAR),
    "rotation": (Role.ROTATION, Role.ANGLE),
    "tilt": (Role.TILT_Y, Role.TILT_Z),
}
_IN_PLANES = ("in-plane bending", "out-of-plane bending")
WORDS = (*_ROLES, *_IN_PLANES)

#: Of a flexure, the bendings in its plane and out of it.
Planes = tuple[tuple[Role, ...], tuple[Role, ...]]
#: Of a sheet whose width is along local z, as the builder makes it.
WIDE_Z: Planes = (XZ, XY)
WIDE_Y: Planes = (XY, XZ)
#: Of a sheet in a planar model, which sees it from its side.
_SIDE_VIEW: Planes = ((), PLANAR)


def word_of(role: Role, planes: Planes | None = None) -> str:
    """The word that means a deformation, and of all these the fewest besides.

    Args:
        role: What it is to its element.
        planes: Which bending of a sheet is in its plane, and which out of it.
    """
    for word, of_it in zip(_IN_PLANES, planes or (), strict=False):
        if role in of_it:
            return word
    if role in PLANAR:
        return "bending"
    return min((word for word in _ROLES if role in _ROLES[word]), key=lambda w: len(_ROLES[w]))


def is_word(given: str) -> bool:
    """Whether a text is the word of a deformation."""
    return _plain(given) in map(_plain, WORDS)


def _numbers_of(
    kind: ElementKind, word: str, planes: Planes | None, end: str, what: str
) -> list[int]:
    """Numbers of the deformations of an element that a word means.

    Args:
        kind: The element.
        word: One of `WORDS`.
        planes: Which bending is in the plane; None where that is not known.
        end: "p", "q" or empty for both.
        what: The part, for messages.

    Raises:
        ModelError: it is no such word, or the element has no such deformation.
    """
    roles = _roles(word, planes, what)
    if end and roles:
        roles = tuple(role for role in roles if role in (AT_P if end == "p" else AT_Q))
        if not roles:
            raise model_error(
                "no-end", f"the {word} of {what} is not at one of its ends", "leave out at"
            )
    found = [kind.role.index(role) + 1 for role in roles if role in kind.role]
    if not found:
        has = [each for each, of_it in _ROLES.items() if set(of_it) & set(kind.role)]
        has = [each for each in has if each != "torsion"]
        if planes is not None:
            has += [each for each, of_it in zip(_IN_PLANES, planes, strict=True) if of_it]
        raise model_error(
            "component-out-of-range", f"{what} has no {word}", f"it has {', '.join(has)}"
        )
    return found


def _roles(word: str, planes: Planes | None, what: str) -> tuple[Role, ...]:
    plain = _plain(word)
    if plain in _ROLES:
        return _ROLES[plain]
    plain_planes = [*map(_plain, _IN_PLANES)]
    if plain not in plain_planes:
        near = nearest(word, WORDS) or WORDS
        raise model_error(
            "component-out-of-range",
            f"there is no deformation {in_short(word)}",
            f"say {' or '.join(map(in_short, near))}, or its number",
        )
    if planes is None:
        raise model_error(
            "no-plane",
            f"{what} has no plane of its own, so that no bending is in it",
            'say "bending about y" or "bending about z", its local axes',
        )
    return planes[plain_planes.index(plain)]


def _plain(word: str) -> str:
    return " ".join(word.lower().replace("-", " ").split())


#: (index of an element, number of a deformation), and with its class.
Place = tuple[int, int]
Given = tuple[int, int, Class]
#: The bending at the other end, in the same plane.
_OTHER_END = {
    Role.BENDING_XZ_P: Role.BENDING_XZ_Q,
    Role.BENDING_XY_P: Role.BENDING_XY_Q,
    Role.PLANAR_BENDING_P: Role.PLANAR_BENDING_Q,
}
_P_OF = {q: p for p, q in _OTHER_END.items()}


def _planes_of(draft: Draft, made: Part | Element, indices: list[int]) -> Planes | None:
    """Which bending of a part is in its plane; None where it has no plane.

    The width is where more bending is held, else where the section is wider, else where the
    builder puts it.
    """
    if draft.planar:
        return _SIDE_VIEW
    first, last = draft.classes[indices[0]], draft.classes[indices[-1]]
    held_xz = (first[2] == Class.FIXED) + (last[3] == Class.FIXED)
    held_xy = (first[4] == Class.FIXED) + (last[5] == Class.FIXED)
    if held_xz != held_xy:
        return WIDE_Z if held_xz > held_xy else WIDE_Y
    shape = draft.said.get(indices[0], {}).get("shape")
    if shape is not None and shape.y != shape.z:
        return WIDE_Z if shape.z > shape.y else WIDE_Y
    # A round wire has no vector as a rule, a sheet of the builder has one.
    own = draft.vectors[indices[0]] != NO_VECTOR
    return WIDE_Z if own or isinstance(made, Sheet) else None


def classes_of_division(
    classes: Sequence[Sequence[int]],
    kind: ElementKind,
    indices: Sequence[int],
    numbers: Iterable[int],
    value: Class,
) -> tuple[list[Place], list[Given]]:
    """What gives deformations of a flexure a class, and the places under which it is noted.

    Bending that is held acts at p on the first beam, at q on the last. Bending that the flexure
    releases is released in one beam: the first, or the last where it is left at q alone.

    Args:
        classes: (elements, deformations) classes as they are.
        kind: The kind of the beams.
        indices: Indices of the beams, from p to q.
        numbers: The deformations, from 1, as of one beam.
        value: The class that they get.
    """
    if len(indices) == 1:
        places = [(indices[0], number) for number in numbers]
        return places, [(*place, value) for place in places]
    first, last = indices[0], indices[-1]
    now = {i: list(classes[i]) for i in indices}
    places = []
    for number in numbers:
        role = Role(kind.role[number - 1])
        divided = now[indices[1]][number - 1] == Class.INDEPENDENT
        places.append((last if role in AT_Q and not divided else first, number))
        if not divided:
            now[places[-1][0]][number - 1] = value
        elif role in _OTHER_END or role in _P_OF:
            p = kind.role.index(_P_OF.get(role, role))
            q = kind.role.index(_OTHER_END[Role(kind.role[p])])
            _give_bending([now[i] for i in indices], p, q, {number - 1: value})
        else:
            now[first][number - 1] = value
            if value == Class.FIXED:
                for i in indices[1:]:
                    now[i][number - 1] = value
    new = [
        (i, k, Class(made))
        for i in indices
        for k, (before, made) in enumerate(zip(classes[i], now[i], strict=True), 1)
        if before != made
    ]
    return places, new


def _give_bending(beams: list[list[int]], p: int, q: int, given: dict[int, Class]) -> None:
    """Give one end, p or q, of a bending that the flexure released a class."""
    first, last = beams[0], beams[-1]
    at_q = Class.DEPENDENT if last[q] == Class.DEPENDENT else first[q]
    at_p, at_q = given.get(p, first[p]), given.get(q, at_q)
    first[p], first[q], last[q] = at_p, at_q, int(Class.INDEPENDENT)
    if at_p == at_q == Class.FIXED:
        for beam in beams[1:]:
            beam[p] = beam[q] = int(Class.FIXED)
    elif at_q == Class.DEPENDENT and at_p != Class.DEPENDENT:
        first[q], last[q] = int(Class.INDEPENDENT), int(Class.DEPENDENT)


def deformations(kind: ElementKind, given: Iterable[int | str]) -> tuple[int, ...]:
    """Numbers of deformations that an element of this kind has.

    Raises:
        ModelError: one of them is none.
    """
    try:
        items = (given,) if isinstance(given, str) else tuple(given)
    except TypeError:
        raise model_error(
            "bad-number", f"deformations are given as several numbers, not by {in_short(given)}"
        ) from None
    numbers = []
    for item in items:
        if isinstance(item, str):
            if not is_word(item):
                raise model_error(
                    "bad-number", f"deformations are given by number or word, not {in_short(item)}"
                )
            numbers += _numbers_of(kind, item, None, "", f"a {kind.keyword}")
        else:
            numbers.append(_checked(kind.deformations, item, f"a {kind.keyword}"))
    return tuple(numbers)


def _checked(last: int, number: object, what: str) -> int:
    made = whole(number, "a deformation is given by its number")
    if not 1 <= made <= last:
        raise model_error(
            "component-out-of-range",
            f"{what} has no deformation {in_short(number)}",
            f"it has 1 to {last}",
        )
    return made


def find_deformations(
    draft: Draft, target: object, which: Sequence[str | int], at: object
) -> tuple[list[int], list[int]]:
    """The deformations of a part that are meant, all where none is named.

    Returns:
        Indices of the elements of the part; numbers of the deformations, from 1, as if it were
        one element.

    Raises:
        ModelError: there is no such part, it has no such deformation, or no such end.
    """
    made = part(draft, target)
    indices = indices_of(draft, made)
    what = in_short(made.name) if made.name else draft.element_words(indices[0])
    if isinstance(made, Body) and len(indices) > 1:
        names = " or ".join(draft.element_words(i) for i in indices[:3])
        raise model_error(
            "several-links",
            f"the body {what} has {len(indices)} rigid links",
            f"say which of them: {names}",
        )
    if isinstance(made, ReinforcedSheet):
        # Its leaves are a divided sheet; the middle has nothing to change.
        indices.pop(len(indices) // 2)
    if isinstance(made, CutNotch):
        indices = indices[1:2]
    kind = element_kinds()[draft.kinds[indices[0]] - 1]
    last = draft.deformations_of(indices[0])
    end = _end(draft, what, indices, at)
    numbers: list[int] = []
    if not which:
        numbers += _numbers_of(kind, "bending", None, end, what) if end else range(1, last + 1)
    for item in which:
        if isinstance(item, str):
            numbers += _numbers_of(kind, item, _planes_of(draft, made, indices), end, what)
        elif end:
            raise model_error(
                "no-end",
                f"deformation {in_short(item)} of {what} has its end in its number",
                "leave out at, or say the deformation in words",
            )
        else:
            numbers.append(_checked(last, item, what))
    return indices, numbers


def _end(draft: Draft, what: str, indices: list[int], at: object) -> str:
    """Which end of a part is meant: "p", "q", or empty for both."""
    if at is None or (isinstance(at, str) and at in ("p", "q")):
        return at or ""
    ends = draft.slots[indices[0]][0], draft.slots[indices[-1]][2]
    body = at
    if isinstance(at, str) and at not in draft.points_by_name and at in draft.parts_by_name:
        body = part(draft, at)
    if isinstance(body, Body):
        met = [number in {node.position for node in body.nodes} for number in ends]
        if met[0] != met[1]:
            return "p" if met[0] else "q"
    point = existing(draft, at)
    if point.position in ends:
        return "pq"[ends.index(point.position)]
    values = [draft.node_value.get(end) for end in ends]
    if draft.node_value[point.position] in values:
        return "pq"[values.index(draft.node_value[point.position])]
    raise model_error(
        "no-end", f"{what} does not end at {point.words}", "give one of its two ends, or p or q"
    )


def give_deformations(
    draft: Draft, target: object, which: Sequence[str | int], value: Class, at: object = None
) -> None:
    """Give deformations of a part a class; of a divided one as if it were one beam."""
    indices, numbers = find_deformations(draft, target, which, at)
    kind = element_kinds()[draft.kinds[indices[0]] - 1]
    stated, new = classes_of_division(draft.classes, kind, indices, numbers, value)
    if value == Class.FIXED:
        for place in stated:
            draft.stated.pop(place, None)
    else:
        draft.state_deformations(stated, value)
    for index, number, made in new:
        draft.set_deformation(index, number, made)


def means_part(draft: Draft, target: object, which: Sequence[str | int]) -> bool:
    """Whether a target is a part; a bare number is one where deformations are numbered.

    Raises:
        ModelError: it can be a point and a part.
    """
    if isinstance(target, Body):
        return bool(which) and not all(map(is_coordinate, which))
    if isinstance(target, (Element, Part, FoldedSheet, Assembly)):
        return True
    if isinstance(target, str):
        if which:
            return not all(map(is_coordinate, which))
        a_part, a_point = target in draft.parts_by_name, target in draft.points_by_name
        if a_part and a_point:
            raise model_error(
                "ambiguous-name",
                f"{in_short(target)} is the name of a part and of a point",
                "name coordinates of the point or deformations of the part",
            )
        return a_part
    if isinstance(target, (Node, Iterable)):
        return False
    if not which:
        raise model_error(
            "ambiguous-number",
            "a number alone can be a node or an element",
            "name coordinates of a node or number deformations of an element",
        )
    return not all(isinstance(item, str) and not is_word(item) for item in which)
