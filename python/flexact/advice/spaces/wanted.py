# SPDX-License-Identifier: BSD-3-Clause
"""What a body is meant to do, as the twist that it is; `written` says how it is written."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...analysis.result import Result
from ...analysis.screws import ScrewKind
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...deck.errors import model_error
from ...model.names import nearest
from ...util.plain_text import in_short
from ...util.records import Frozen
from .screw_space import ScrewSpace
from .wanted_motion import Written, numbers, unreadable

#: A motion as it is typed, with few digits, is one of the body where so little of it is not.
_AS_TYPED = 1.0e-3


@dataclass(frozen=True, eq=False)
class Wanted(Frozen):
    """A motion that a body is meant to have.

    Attributes:
        text: As it was written; of a declared degree of freedom its label.
        kind: Translation, rotation or screw.
        direction: (3,) unit vector.
        point: (3,) of the axis [m]; of a translation the middle of the body.
        pitch: [m/rad]; 0 of a rotation, infinite of a translation.
        twist: (6,) rotation [rad] and velocity of the middle [m], as the body can move; as it
            was asked for where the body cannot.
        is_free: Whether the body can move so when nothing is declared.
        is_declared: Whether it is a declared degree of freedom of the model.
    """

    text: str
    kind: ScrewKind
    direction: FloatArray
    point: FloatArray
    pitch: float
    twist: FloatArray
    is_free: bool
    is_declared: bool = False


def wanted_of(result: Result, space: ScrewSpace, written: Written) -> Wanted:
    """A wanted motion as a twist of the body of a freedom space.

    Raises:
        ModelError: there is no such point, or a planar model has no such motion.
    """
    kind, direction = written.kind, written.direction
    if kind is ScrewKind.TRANSLATION:
        if space.planar and direction[2] != 0.0:
            raise unreadable(written.text, "a planar model has no z")
        return _made(written, space, space.about, space.free(direction))
    if written.point is not None:
        point = _place(result, written)
        return _made(written, space, point, space.line(point, direction, written.pitch))
    twist = _nearest_line(space, direction, written.pitch)
    if twist is None:
        twist = space.line(space.about, direction, written.pitch)
    point = space.about + np.cross(twist[:3], twist[3:])
    return _made(written, space, point, twist)


def _made(written: Written, space: ScrewSpace, point: FloatArray, twist: FloatArray) -> Wanted:
    is_free = space.has(twist, _AS_TYPED)
    return Wanted(
        *(written.text, written.kind, written.direction, point, written.pitch),
        space.nearest(twist) if is_free else twist,
        is_free,
    )


def _nearest_line(space: ScrewSpace, direction: FloatArray, pitch: float) -> FloatArray | None:
    """The twist of a space about a line of this direction nearest to the middle; None without."""
    rows = space.scaled
    if not len(rows):
        return None
    shares, _, _, sizes = np.linalg.lstsq(rows[:, :3].T, space.length * direction, rcond=_AS_TYPED)
    off = rows[:, :3].T @ shares - space.length * direction
    if np.abs(off).max() > _AS_TYPED * space.length or not sizes.size:
        return None
    moment = rows[:, 3:].T @ shares
    free = [each[3:] for each in space.directions]
    # Of the moments that directions without a line add, the least with this pitch.
    for each in free:
        moment = moment - (moment @ each) * each
    along = np.array([each @ direction for each in free])
    size = float(along @ along)
    lacking = pitch - float(moment @ direction)
    if size > _AS_TYPED**2:
        moment = moment + lacking / size * sum(a * e for a, e in zip(along, free, strict=True))
    elif abs(lacking) > _AS_TYPED * space.length:
        return None
    return np.concatenate((direction, moment))


def _place(result: Result, written: Written) -> FloatArray:
    word = written.point or ""
    planar = result.given.planar
    if word.startswith("("):
        return numbers(written.text, word, (2, 3) if planar else (3,))
    parts, kinds = result.parts, result.given.arrays.node_kind
    named = {
        node: parts.name_of_point(node)
        for node in np.flatnonzero(kinds <= NodeKind.POSITION).tolist()
        if parts.name_of_point(node)
    }
    found = [node for node, name in named.items() if name == word]
    if len(found) == 1:
        made: FloatArray = result.given.arrays.node_value[:3, found[0]]
        return made
    if found:
        raise model_error("ambiguous-name", f"{len(found)} points are called {in_short(word)}")
    near = nearest(word, named.values())
    raise model_error(
        "no-such-point",
        f"there is no point called {in_short(word)}, in the wanted motion {in_short(written.text)}",
        f"did you mean {' or '.join(map(in_short, near))}?" if near else "write it as (x, y, z)",
    )
