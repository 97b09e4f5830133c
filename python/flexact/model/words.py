# SPDX-License-Identifier: BSD-3-Clause
"""Words of deformations, as designers say them, and the deformations that they mean."""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from ..core.elements import Role
from ..core.raw import ElementKind
from ..deck.rendering import ModelError, model_error
from ..util.text import in_short
from .names import nearest

_XZ = (Role.BENDING_XZ_P, Role.BENDING_XZ_Q)
_XY = (Role.BENDING_XY_P, Role.BENDING_XY_Q)
_PLANAR = (Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q)
#: Roles of what happens at p, and at q; what is not among them has no end.
AT_P = frozenset((Role.BENDING_XZ_P, Role.BENDING_XY_P, Role.PLANAR_BENDING_P))
AT_Q = frozenset((Role.BENDING_XZ_Q, Role.BENDING_XY_Q, Role.PLANAR_BENDING_Q))

IN_PLANE, OUT_OF_PLANE = "in-plane bending", "out-of-plane bending"
_ROLES: dict[str, tuple[Role, ...]] = {
    "elongation": (Role.ELONGATION,),
    "twist": (Role.TORSION,),
    "torsion": (Role.TORSION,),
    "bending": (*_XZ, *_XY, *_PLANAR),
    "bending about y": _XZ,
    "bending about z": (*_XY, *_PLANAR),
    "rotation": (Role.ROTATION, Role.ANGLE),
    "tilt": (Role.TILT_Y, Role.TILT_Z),
}
WORDS = (*_ROLES, IN_PLANE, OUT_OF_PLANE)


class Planes(NamedTuple):
    """Which bending of a part is which: roles in the plane of a sheet, and out of it."""

    within: tuple[Role, ...]
    out: tuple[Role, ...]


#: Of a sheet whose width is along local z, as the builder makes it.
WIDE_Z = Planes(_XZ, _XY)
WIDE_Y = Planes(_XY, _XZ)
#: Of a sheet in a planar model, which sees it from its side.
SIDE_VIEW = Planes((), _PLANAR)


def is_word(given: str) -> bool:
    """Whether a text is the word of a deformation."""
    return _plain(given) in map(_plain, WORDS)


def numbers_of(
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
    if end:
        wanted = AT_P if end == "p" else AT_Q
        at_end = [role for role in roles if role in wanted]
        if roles and not at_end:
            raise model_error(
                "no-end", f"the {word} of {what} is not at one of its ends", "leave out at"
            )
        roles = tuple(at_end)
    found = [kind.role.index(role) + 1 for role in roles if role in kind.role]
    if not found:
        raise model_error(
            "component-out-of-range",
            f"{what} has no {word}",
            f"it has {', '.join(words_of(kind, planes))}",
        )
    return found


def words_of(kind: ElementKind, planes: Planes | None) -> list[str]:
    """The words that mean something of an element."""
    named = [
        word for word, roles in _ROLES.items() if set(roles) & set(kind.role) and word != "torsion"
    ]
    if planes is not None:
        named += [IN_PLANE] * bool(planes.within) + [OUT_OF_PLANE]
    return named


def _roles(word: str, planes: Planes | None, what: str) -> Collection[Role]:
    plain = _plain(word)
    for known, roles in _ROLES.items():
        if plain == known:
            return roles
    if plain not in (_plain(IN_PLANE), _plain(OUT_OF_PLANE)):
        raise _no_such_word(word)
    if planes is None:
        raise model_error(
            "no-plane",
            f"{what} has no plane of its own, so that no bending is in it",
            'say "bending about y" or "bending about z", its local axes',
        )
    return planes.within if plain == _plain(IN_PLANE) else planes.out


def _plain(word: str) -> str:
    return " ".join(word.lower().replace("-", " ").split())


def _no_such_word(word: str) -> ModelError:
    near = nearest(word, WORDS) or WORDS
    return model_error(
        "component-out-of-range",
        f"there is no deformation {in_short(word)}",
        f"say {' or '.join(map(in_short, near))}, or its number",
    )
