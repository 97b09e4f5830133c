# SPDX-License-Identifier: BSD-3-Clause
"""Parts, points and deformations of a mechanism as sentences name them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import NodeKind, Role, role_table
from ..model.data import ModelData
from ..model.parts.condensing import Condensed
from ..model.parts.forms import AT_P, AT_Q, LOCAL_AXIS, Form
from ..model.parts.parts import Joint, Part, PartKind, Parts
from .limits import ALONG
from .mode_basis import without_sense

#: Names that say themselves what they are.
_ARTICLES = ("the ", "a ", "an ")
#: How many parts a sentence names where several meet.
_MOST_NAMED = 2
#: What assemblies call points.
_OF_ASSEMBLY = re.compile(r"(?:^| )(ground|stage|body|platform) \d+$")


def part_words(part: Part) -> str:
    """Such as "sheet 1" or "the stage"."""
    return with_article(part.name)


def with_article(name: str) -> str:
    """A name in a sentence: names without a number take an article, as "the stage"."""
    plain = name[:1].islower() and len(name) > 1
    if not plain or any(c.isdigit() for c in name) or name.startswith(_ARTICLES):
        return name
    return f"the {name}"


def listed(words: Sequence[str]) -> str:
    """Such as "a, b and c"."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} and {words[-1]}"


def parts_words(parts: Sequence[Part], most: int = _MOST_NAMED) -> str:
    """Such as "sheet 1, sheet 2 and 3 more"."""
    if len(parts) > most + 1:
        return listed([*map(part_words, parts[:most]), f"{len(parts) - most} more"])
    return listed([part_words(part) for part in parts])


def others_words(parts: Sequence[Part]) -> str:
    """The same of parts that meet another; of many how many there are."""
    return parts_words(parts) if len(parts) <= _MOST_NAMED else f"{len(parts)} other parts"


def node_words(parts: Parts, node: int) -> str:
    """What a node, by its index, stands for: a point, or the body that it turns with."""
    body = parts.body_at.get(node)
    if parts.data.arrays.node_kind[node] <= NodeKind.POSITION:
        if body is not None and stands_for(parts, node, body):
            return part_words(parts.of_body(body))
        return place_words(parts, node)
    if body is not None:
        return part_words(parts.of_body(body))
    place = parts.place_of(node)
    turning = parts.turning(node)
    if place is not None:
        return _end_that_turns(parts, place, node) or place_words(parts, place)
    if len(turning) > 1 and not parts.is_held(node):
        return f"the joint of {parts_words(turning)}"
    side = "ground" if parts.is_held(node) else "other side"
    return f"the {side} of {parts_words(turning)}"


def _end_that_turns(parts: Parts, place: int, node: int) -> str:
    """Ends that turn for themselves, beside a body, a support or others at their place.

    Empty where all that is there turns with this orientation.
    """
    if not _turns_alone(parts, place, node):
        return ""
    hinges = [part for part in parts.turning(node) if part.kind is PartKind.HINGE]
    own = [part for part in parts.turning(node) if part.kind is not PartKind.HINGE]
    what = f"the {'end' if len(own) == 1 else 'joint'} of {parts_words(own)}"
    if hinges:
        return f"{what} at {parts_words(hinges)}"
    if len(own) == 1:
        return f"{what} at {place_words(parts, place, own[0])}"
    if place in parts.body_at:
        return f"{what} at {place_words(parts, place)}"
    return f"{what} at {point_words(parts, place)} {parts.data.units.symbol('m')}"


def _turns_alone(parts: Parts, place: int, node: int) -> bool:
    """Whether an orientation is not that of its place: others are there, or a pin holds it."""
    is_pinned = parts.is_held(place) and not parts.is_held(node)
    return parts.is_shared(node) or (is_pinned and not parts.name_of_point(place))


def joint_node(parts: Parts, joint: Joint) -> int:
    """The node by which a joint is named: its place, or what turns where others do not."""
    place, node = joint.position, joint.orientation
    if node is not None and (place is None or _turns_alone(parts, place, node)):
        return node
    assert place is not None
    return place


def joint_words(parts: Parts, joint: Joint) -> str:
    """A joint that moves: "the joint of sheet 1 and bar 2", "the end of the wire at the notch"."""
    return node_words(parts, joint_node(parts, joint))


def stands_for(parts: Parts, position: int, body: int) -> bool:
    """Whether what a point on a named body does is told of the body, though it has a name.

    An assembly has named it, as "stage 1", and it is the first point of the body; or as its
    ground, which moves if the body carries it. Supports have their own words.
    """
    found = _OF_ASSEMBLY.search(parts.name_of_point(position))
    if found is None or parts.is_held(position) or not parts.of_body(body).is_named:
        return False
    return found[1] == "ground" or parts.first_points[body] == position


def end_words(parts: Parts, position: int) -> str:
    """A point on a body by its name, by the part that ends there, or by its place."""
    body = parts.body_at.get(position)
    if body is None or parts.name_of_point(position):
        return node_words(parts, position)
    owner = part_words(parts.of_body(body))
    others = [part for part in parts.at(position) if part.kind is not PartKind.BODY]
    if len(others) == 1:
        return f"the end of {part_words(others[0])} at {owner}"
    return f"{owner} at {point_words(parts, position)} {parts.data.units.symbol('m')}"


def place_words(parts: Parts, position: int, within: Part | None = None) -> str:
    """A point by its name, or by what is there.

    Args:
        parts: Those of the model.
        position: Index of the position node.
        within: The part of which the sentence speaks; what is there is seen from it.
    """
    name = parts.name_of_point(position)
    if name and not (within is None and _is_of_a_part(parts, position, name)):
        return with_article(_seen_from(name, within))
    words = _without_name(parts, position, within)
    if within is None:
        return words
    others = [end for end in within.ends if end != position]
    same = any(
        not parts.name_of_point(end) and _without_name(parts, end, within) == words
        for end in others
    )
    return f"{words} at {point_words(parts, position)}" if same else words


def _is_of_a_part(parts: Parts, position: int, name: str) -> bool:
    """Whether a point on a body is called by the part that ends there: "sheet 1, stage"."""
    head, comma, _ = name.rpartition(",")
    here = parts.at(position)
    return bool(
        comma
        and any(part.kind is PartKind.BODY for part in here)
        and any(part.name.startswith(head) for part in here)
    )


def _seen_from(name: str, part: Part | None) -> str:
    """The name of a point without that of the part of which is spoken: "sheet 1, ground"."""
    head, comma, rest = name.rpartition(",")
    if part is None or not comma or not rest.strip():
        return name
    return rest.strip() if part.name.startswith(head) else name


def _without_name(parts: Parts, position: int, within: Part | None) -> str:
    here = parts.at(position)
    others = tuple(part for part in here if part is not within)
    if parts.is_held(position):
        kind = "clamp" if _is_clamped(parts, position) else "support"
        return f"its {kind}" if within is not None else f"the {kind} of {parts_words(here)}"
    bodies = [part for part in others if part.kind is PartKind.BODY]
    if bodies:
        return part_words(bodies[0])
    if not others or (within is None and len(here) == 1 and position in here[0].ends):
        return "its free end" if within is not None else f"the free end of {parts_words(here)}"
    is_fold = len(here) == 2 and all(part.kind is PartKind.SHEET for part in here)
    kind = "fold" if is_fold else "joint"
    # What both names begin with, up to a comma: "upper 90" of its leaves.
    heads = {part.name.rpartition(",")[0].strip() for part in here}
    shared = heads.pop() if len(heads) == 1 else ""
    if is_fold and shared:
        return "the fold" if within is not None else f"the fold of {shared}"
    if within is not None:
        return f"its {kind} with {others_words(others)}"
    return f"the {kind} of {parts_words(here)}"


def _is_clamped(parts: Parts, position: int) -> bool:
    slots = parts.data.arrays.element_node - 1
    turned = {
        int(slots[k + 1, element])
        for element in parts.elements_at(position)
        for k in (0, 2)
        if slots[k, element] == position
    } - {-1}
    return any(parts.is_held(node) for node in turned)


def point_words(parts: Parts, position: int) -> str:
    """Its coordinates in the units of the model, in the plane two."""
    count, units = 2 if parts.data.planar else 3, parts.data.units
    place = parts.data.arrays.node_value[:count, position]
    return f"({', '.join(f'{value + 0.0:.4g}' for value in units.shown(place, 'm').tolist())})"


def axis_words(axis: FloatArray) -> str:
    """A direction without sense: "x", or its components."""
    return direction_words(without_sense(axis))


def direction_words(direction: FloatArray) -> str:
    """A direction with its sense: "x", "-x", or its components."""
    unit = direction / np.linalg.norm(direction)
    largest = int(np.argmax(np.abs(unit)))
    if np.all(np.abs(np.delete(unit, largest)) < ALONG):
        return ("-" if unit[largest] < 0.0 else "") + "xyz"[largest]
    rounded = np.round(unit, 3) + 0.0
    return f"({', '.join(f'{value:.3g}' for value in rounded)})"


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
