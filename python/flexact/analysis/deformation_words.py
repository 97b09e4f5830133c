# SPDX-License-Identifier: BSD-3-Clause
"""What the deformations of parts are called, by their roles: words that a designer uses."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from ..core.elements import Role, role_table
from ..model.data import ModelData
from ..model.parts.condensing import Condensed
from ..model.parts.forms import Form
from ..model.parts.parts import Part, Parts
from .places import axis_words, place_words

#: What roles are in the local frame of an element, as decks number them.
_IN_LOCAL_FRAME: dict[int, str] = {
    Role.ELONGATION: "elongation",
    Role.TORSION: "torsion",
    Role.BENDING_XZ_P: "bending at p in the local xz plane",
    Role.BENDING_XZ_Q: "bending at q in the local xz plane",
    Role.BENDING_XY_P: "bending at p in the local xy plane",
    Role.BENDING_XY_Q: "bending at q in the local xy plane",
    Role.PLANAR_BENDING_P: "bending at p",
    Role.PLANAR_BENDING_Q: "bending at q",
    Role.OFFSET_X: "along its axis",
    Role.OFFSET_Y: "along its local y",
    Role.OFFSET_Z: "along its local z",
    Role.ROTATION: "rotation about the axis",
    Role.TILT_Y: "first tilt of the axis",
    Role.TILT_Z: "second tilt of the axis",
    Role.ANGLE: "rotation",
}
#: Local axis about which a bending turns, the local plane in which it is, and the end.
_BENDINGS: dict[int, tuple[int, int, int]] = {
    Role.BENDING_XZ_P: (1, 2, 0),
    Role.BENDING_XZ_Q: (1, 2, 1),
    Role.BENDING_XY_P: (2, 1, 0),
    Role.BENDING_XY_Q: (2, 1, 1),
}
_PLANAR_BENDINGS: dict[int, int] = {Role.PLANAR_BENDING_P: 0, Role.PLANAR_BENDING_Q: 1}
#: Words that need no place and no axis.
_PLAIN: dict[int, str] = {
    Role.ELONGATION: "elongation",
    Role.TORSION: "twist",
    Role.ROTATION: "rotation about its axis",
    Role.ANGLE: "rotation",
}
#: Local axis of what is along or about it.
_OFFSETS: dict[int, int] = {Role.OFFSET_X: 0, Role.OFFSET_Y: 1, Role.OFFSET_Z: 2}
_TILTS: dict[int, int] = {Role.TILT_Y: 1, Role.TILT_Z: 2}


class Told(Protocol):
    """A model of which is spoken: that of a result, or one without an analysis."""

    @property
    def data(self) -> ModelData:
        """The model as it is analysed."""

    @property
    def condensed(self) -> Condensed:
        """The model as given, and as it is analysed."""

    @property
    def parts(self) -> Parts:
        """The parts of the model as given."""


def deformation_words(outcome: Told, element: int, deformation: int) -> str:
    """Such as "in-plane bending at its clamp".

    In-plane is the bending that a sheet holds; other members bend about an axis.

    Args:
        outcome: The result.
        element: Index of the element in `outcome.data`.
        deformation: From 1.
    """
    role = role_of(outcome, element, deformation)
    if role in _PLAIN:
        return _PLAIN[role]
    frame = outcome.data.frames.frame[element]
    bending = bending_of(outcome, element, deformation)
    if bending is not None:
        place = place_words(outcome.parts, bending.position, part_of(outcome, element))
        word = bending.word or f"bending about {axis_words(frame[:, _BENDINGS[role][0]])}"
        return f"{word} at {place}"
    if role in _TILTS:
        return f"tilt about {axis_words(frame[:, _TILTS[role]])}"
    return f"displacement along {axis_words(frame[:, _OFFSETS[role]])}"


class Bending(NamedTuple):
    """A bending of a member at one of its ends."""

    word: str | None
    """What it is called; None of a member that is wide in neither direction."""
    position: int
    """Index of the position node at that end, in the model as given."""


def bending_of(outcome: Told, element: int, deformation: int) -> Bending | None:
    """The bending that a deformation is; None where it is none. See `deformation_words`."""
    role = role_of(outcome, element, deformation)
    given = int(outcome.condensed.elements[element])
    if role in _PLANAR_BENDINGS:
        return Bending("bending", _end(outcome, element, _PLANAR_BENDINGS[role]))
    if role not in _BENDINGS:
        return None
    _, plane, end = _BENDINGS[role]
    position = _end(outcome, element, end)
    if outcome.parts.form[given] != Form.SHEET:
        return Bending(None, position)
    is_in_plane = outcome.parts.wide[given] == plane
    return Bending("in-plane bending" if is_in_plane else "out-of-plane bending", position)


def role_of(outcome: Told, element: int, deformation: int) -> int:
    """`Role` of a deformation, from 1, of an element by its index in `outcome.data`."""
    kind = outcome.data.arrays.element_kind[element]
    return int(role_table()[kind, deformation - 1])


def part_of(outcome: Told, element: int) -> Part:
    """The part that an element, by its index in `outcome.data`, belongs to."""
    return outcome.parts.of_element(int(outcome.condensed.elements[element]))


def _end(outcome: Told, element: int, end: int) -> int:
    """The position node at an end of an element, 0 at p and 1 at q."""
    node = int(outcome.data.arrays.element_node[2 * end, element]) - 1
    return int(outcome.condensed.nodes[node])


def deformation_word(kind: int, deformation: int) -> str:
    """What deformation 1, 2, ... of an element kind (row of the table, from 1) is in its frame."""
    return _IN_LOCAL_FRAME[int(role_table()[kind, deformation - 1])]
