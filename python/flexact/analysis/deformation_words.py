# SPDX-License-Identifier: BSD-3-Clause
"""What the deformations of parts are called, by their roles: words that a designer uses."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from ..core.elements import Role, role_table
from ..model.data import ModelData
from ..model.deformations import AT_P, AT_Q, LOCAL_AXIS
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
#: Words that need no place and no axis.
_PLAIN: dict[int, str] = {
    Role.ELONGATION: "elongation",
    Role.TORSION: "twist",
    Role.ROTATION: "rotation about its axis",
    Role.ANGLE: "rotation",
}


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
    axis = axis_words(outcome.data.frames.frame[element][:, LOCAL_AXIS.get(role, 0)])
    bending = bending_of(outcome, element, deformation)
    if bending is not None:
        place = place_words(outcome.parts, bending.position, part_of(outcome, element))
        return f"{bending.word or f'bending about {axis}'} at {place}"
    way = "tilt about" if role in (Role.TILT_Y, Role.TILT_Z) else "displacement along"
    return f"{way} {axis}"


class Bending(NamedTuple):
    """A bending of a member at one of its ends."""

    word: str | None
    """What it is called; None of a member that is wide in neither direction."""
    position: int
    """Index of the position node at that end, in the model as given."""


def bending_of(outcome: Told, element: int, deformation: int) -> Bending | None:
    """The bending that a deformation is; None where it is none. See `deformation_words`."""
    role = role_of(outcome, element, deformation)
    if role not in AT_P and role not in AT_Q:
        return None
    node = int(outcome.data.arrays.element_node[2 if role in AT_Q else 0, element]) - 1
    position = int(outcome.condensed.nodes[node])
    if role not in LOCAL_AXIS:
        return Bending("bending", position)
    given = int(outcome.condensed.elements[element])
    if outcome.parts.form[given] != Form.SHEET:
        return Bending(None, position)
    # A bending about one local axis is in the plane of the other.
    is_in_plane = outcome.parts.wide[given] == 3 - LOCAL_AXIS[role]
    return Bending("in-plane bending" if is_in_plane else "out-of-plane bending", position)


def role_of(outcome: Told, element: int, deformation: int) -> int:
    """`Role` of a deformation, from 1, of an element by its index in `outcome.data`."""
    kind = outcome.data.arrays.element_kind[element]
    return int(role_table()[kind, deformation - 1])


def part_of(outcome: Told, element: int) -> Part:
    """The part that an element, by its index in `outcome.data`, belongs to."""
    return outcome.parts.of_element(int(outcome.condensed.elements[element]))


def deformation_word(kind: int, deformation: int) -> str:
    """What deformation 1, 2, ... of an element kind (row of the table, from 1) is in its frame."""
    return _IN_LOCAL_FRAME[int(role_table()[kind, deformation - 1])]
