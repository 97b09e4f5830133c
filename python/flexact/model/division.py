# SPDX-License-Identifier: BSD-3-Clause
"""Flexures that are divided into beams: the classes of the beams that make one flexure of them.

The first beam releases what the flexure releases; every other beam has the same deformations
independent, so that D(c) is that of one beam: what is released in a row of beams, and held in
all of them but one, lets the two ends of the row move as the ends of one beam would.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..core.elements import Class, Role
from ..core.raw import ElementKind
from .draft import Draft
from .words import AT_Q

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
