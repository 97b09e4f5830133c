# SPDX-License-Identifier: BSD-3-Clause
"""Deformations: which of a part are meant, and giving them classes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ..core.elements import Class, Role, element_kinds
from ..core.raw import ElementKind
from ..deck.rendering import model_error
from ..util.text import in_short
from .draft import Draft
from .handles import Assembly, Body, Element, FoldedSheet, Node, Part
from .names import is_coordinate
from .selection import end_positions, existing, indices_of, part, planes_of, whole, words_for
from .words import AT_Q, is_word, numbers_of

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


def declare_inner(draft: Draft, indices: Iterable[int], released: Iterable[int]) -> None:
    """Make the released deformations of all beams but the first independent."""
    for index in list(indices)[1:]:
        for number in released:
            draft.set_deformation(index, number, Class.INDEPENDENT)


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
    first, last, inner = indices[0], indices[-1], indices[1:]
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
            _give_bending(now, first, inner, (p, q), {number - 1: value})
        else:
            now[first][number - 1] = value
            if value == Class.FIXED:
                for i in inner:
                    now[i][number - 1] = value
    new = [
        (i, k, Class(made))
        for i in indices
        for k, (before, made) in enumerate(zip(classes[i], now[i], strict=True), 1)
        if before != made
    ]
    return places, new


def _give_bending(
    now: dict[int, list[int]],
    first: int,
    inner: Sequence[int],
    pair: tuple[int, int],
    given: dict[int, Class],
) -> None:
    """Give one or both ends of a bending that the flexure released a class."""
    p, q = pair
    last = inner[-1]
    at_q = Class.DEPENDENT if now[last][q] == Class.DEPENDENT else now[first][q]
    at_p, at_q = given.get(p, now[first][p]), given.get(q, at_q)
    now[first][p], now[first][q], now[last][q] = at_p, at_q, int(Class.INDEPENDENT)
    if at_p == at_q == Class.FIXED:
        for i in inner:
            now[i][p] = now[i][q] = int(Class.FIXED)
    elif at_q == Class.DEPENDENT and at_p != Class.DEPENDENT:
        now[first][q], now[last][q] = int(Class.INDEPENDENT), int(Class.DEPENDENT)


_BY_NUMBER = "a deformation is given by its number"


class Deformations(NamedTuple):
    """Deformations of a part, by their numbers from 1, as if it were one element."""

    part: Part | Element
    indices: list[int]
    numbers: list[int]


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
            numbers += numbers_of(kind, item, None, "", f"a {kind.keyword}")
        else:
            numbers.append(_checked(kind.deformations, item, f"a {kind.keyword}"))
    return tuple(numbers)


def _checked(last: int, number: object, what: str) -> int:
    made = whole(number, _BY_NUMBER)
    if not 1 <= made <= last:
        raise model_error(
            "component-out-of-range",
            f"{what} has no deformation {in_short(number)}",
            f"it has 1 to {last}",
        )
    return made


def find_deformations(
    draft: Draft, target: object, which: Sequence[str | int], at: object
) -> Deformations:
    """The deformations of a part that are meant, all where none is named.

    Raises:
        ModelError: there is no such part, it has no such deformation, or no such end.
    """
    made = part(draft, target)
    indices = indices_of(draft, made)
    what = words_for(draft, made, indices)
    if isinstance(made, Body) and len(indices) > 1:
        names = " or ".join(draft.element_words(i) for i in indices[:3])
        raise model_error(
            "several-links",
            f"the body {what} has {len(indices)} rigid links",
            f"say which of them: {names}",
        )
    kind = element_kinds()[draft.kinds[indices[0]] - 1]
    last = draft.deformations_of(indices[0])
    end = _end(draft, what, indices, at)
    numbers: list[int] = []
    if not which:
        numbers += numbers_of(kind, "bending", None, end, what) if end else range(1, last + 1)
    for item in which:
        if isinstance(item, str):
            numbers += numbers_of(kind, item, planes_of(draft, made, indices), end, what)
        elif end:
            raise model_error(
                "no-end",
                f"deformation {in_short(item)} of {what} has its end in its number",
                "leave out at, or say the deformation in words",
            )
        else:
            numbers.append(_checked(last, item, what))
    return Deformations(made, indices, numbers)


def _end(draft: Draft, what: str, indices: list[int], at: object) -> str:
    """Which end of a part is meant: "p", "q", or empty for both."""
    if at is None or (isinstance(at, str) and at in ("p", "q")):
        return at or ""
    ends = end_positions(draft, indices)
    body = _body(draft, at)
    if body is not None:
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


def _body(draft: Draft, at: object) -> Body | None:
    """The body that is meant where an end is said by what it is fastened to."""
    if isinstance(at, str) and at not in draft.points_by_name and at in draft.parts_by_name:
        at = part(draft, at)
    return at if isinstance(at, Body) else None


def give_deformations(
    draft: Draft, target: object, which: Sequence[str | int], value: Class, at: object = None
) -> None:
    """Give deformations of a part a class; of a divided one as if it were one beam."""
    found = find_deformations(draft, target, which, at)
    kind = element_kinds()[draft.kinds[found.indices[0]] - 1]
    stated, new = classes_of_division(draft.classes, kind, found.indices, found.numbers, value)
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
