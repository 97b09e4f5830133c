# SPDX-License-Identifier: BSD-3-Clause
"""What a body is meant to do, as it is written.

    BODY: translation DIRECTION
    BODY: rotation DIRECTION
    BODY: rotation about POINT along DIRECTION
    BODY: screw DIRECTION pitch PITCH
    BODY: screw about POINT along DIRECTION pitch PITCH

A DIRECTION is x, y or z, or three numbers such as (1, 0, 1); a POINT three numbers [m], each of
which may say its unit, such as (0, 0, 40 mm), or the name of a point; a PITCH is in metres a
radian, or says its unit, such as 2 mm/turn, and is positive for a right-hand thread. "along" and
"about" may stand before any direction, and "BODY:" may be left out where the body is given
otherwise. A rotation or a screw without a point is, of a body that there is, about that line along
DIRECTION which the body can turn about, of several the one nearest to its middle; of a body that
is yet to be designed it is about the line through the centre. In the plane points have two numbers
and a rotation needs no direction.

Short forms stand for several motions; a place that is left out is the middle, or the centre:

    BODY: x, y, rz                          translations and rotations by their coordinates
    BODY: planar DIRECTION                  translations across it, and the rotation about it
    BODY: spherical at POINT                three rotations about lines through a point
    BODY: universal at POINT along DIRECTION and DIRECTION    two of these
    BODY: cylindrical about POINT along DIRECTION    rotation about a line and translation along it
    BODY: all but MOTION [and MOTION ...]   see below
    BODY: everything                        all six
    BODY: nothing                           none: the body is held

"all but" takes translations, each with "at POINT" where it is not that of the middle, and
rotations. All but the translation along d at P is every motion in which the point P of the body
does not move along d: what one wire along d through P leaves. All but the rotation about d is
every motion that does not turn about d; its place does not matter, since all translations are left.
Motions that are typed in one text are apart by semicolons.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.freedoms import Freedom
from ...analysis.limits import ROUNDING
from ...analysis.result import Result
from ...analysis.screws import ScrewKind, screw_of
from ...core.arrays import FloatArray
from ...core.elements import POSITION_NAMES, ROTATION_NAMES, Class, NodeKind
from ...deck.rendering import ModelError, model_error
from ...model.names import nearest
from ...util.quantities import QuantityError, quantity
from ...util.records import Frozen
from ...util.text import in_short
from ...util.units import METRES, Units
from .screws import SAME, ScrewSpace, canonical, complement
from .subjects import Freed, Subject

#: Wanted motions that differ by less are one.
_APART = 1.0e-3


@dataclass(frozen=True, eq=False)
class Aim(Frozen):
    """What wires are to do with a body.

    Attributes:
        freedom: What the body can do.
        wanted: (w, 6) orthonormal rows, rotations times the length: what it is to go on doing.
        unwanted: (u, 6) orthonormal rows: the rest.
    """

    freedom: ScrewSpace
    wanted: FloatArray
    unwanted: FloatArray

    @classmethod
    def of(cls, freedom: ScrewSpace, twists: Sequence[FloatArray]) -> Aim:
        """Of a freedom space and the wanted twists in it, (6,) each."""
        rows = freedom.scaled
        if not len(twists) or not len(rows):
            return cls(freedom, rows[:0], rows)
        shares = np.array([rows @ (twist * freedom.factors) for twist in twists])
        sizes = np.linalg.norm(shares, axis=1, keepdims=True)
        shares = shares / np.where(sizes > 0.0, sizes, 1.0)
        _, values, right = np.linalg.svd(shares)
        rank = int(np.sum(values > _APART))
        return cls(freedom, right[:rank] @ rows, right[rank:] @ rows)

    @property
    def may_hold(self) -> ScrewSpace:
        """The wrenches that do no work on what is wanted."""
        return self.freedom.of_scaled(self.wanted).reciprocal

    @property
    def stoppable(self) -> int:
        """How many of the unwanted motions wires can stop: as forces along lines span."""
        span = self.may_hold.span_of_lines
        works = np.roll(span, 3, axis=1) @ self.unwanted.T
        return int(np.sum(np.linalg.svd(works, compute_uv=False) > SAME)) if works.size else 0

    def stopped_by(self, line: FloatArray) -> Aim:
        """What is left to be done with a wire along a line, (6,) scaled."""
        works = self.unwanted @ np.roll(line, 3)
        left = complement(works[None] / np.linalg.norm(works)) @ self.unwanted
        return Aim(self.freedom, self.wanted, left)


_KINDS = ("translation", "rotation", "screw")
_FORMS = ("planar", "spherical", "universal", "cylindrical", "all but", "everything", "nothing")
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_EXAMPLE = 'such as "stage: translation z" or "stage: rotation about (0, 0, 0.04) along x"'
_PITCH = re.compile(r"^(?P<rest>.*?)\s*,?\s*\bpitch\s+(?P<pitch>\S.*)$", re.DOTALL)
_POINT_FIRST = re.compile(
    r"^(?:about|at|through)\s+(?P<point>.+?)\s+along\s+(?P<direction>.+)$", re.DOTALL
)
_POINT_LAST = re.compile(r"^(?P<direction>.+?)\s+(?:through|at)\s+(?P<point>.+)$", re.DOTALL)
_PER_TURN = re.compile(r"\s*/\s*(?:turn|rev(?:olution)?)$")
_DIRECTION = re.compile(r"\([^()]*\)|(?<![\w.])[+-]?[xyzXYZ]\b")


class Written(NamedTuple):
    """A wanted motion as far as it can be read without the mechanism.

    Its kind is `ScrewKind.NONE` where nothing is wanted. A point "" is the middle of the body.
    """

    text: str
    body: str | None
    kind: ScrewKind
    direction: FloatArray
    point: str | None
    pitch: float


def read_all(text: str, *, planar: bool = False, units: Units = METRES) -> tuple[Written, ...]:
    """Read all that one text wants, short forms as the motions that they stand for.

    A body that is named holds for what stands behind it.

    Args:
        text: As this module says.
        planar: Whether it is of a planar model.
        units: Of lengths that say no unit.

    Raises:
        TypeError: it is no text.
        ModelError: it is nothing of what this module says.
    """
    if not isinstance(text, str):
        raise TypeError(f"a wanted motion is a text, not {type(text).__name__}")
    made: list[Written] = []
    body: str | None = None
    for piece in text.split(";"):
        head, colon, motion = piece.rpartition(":")
        body = head.strip() if colon else body
        if body == "":
            raise unreadable(text, "there is no body before the colon")
        if not motion.strip() and ";" in text:
            raise unreadable(text, "there is no motion between two semicolons")
        for each in _motions(motion.strip(), planar, units):
            made.append(each._replace(body=body))
    return tuple(made)


def _motions(motion: str, planar: bool, units: Units) -> Iterator[Written]:
    """The motions that a short form stands for; of any other text its one."""
    words = [word for word in re.split(r"[,\s]+", motion.lower()) if word]
    if words and all(word in POSITION_NAMES + ROTATION_NAMES for word in words):
        for word in words:
            kind = ScrewKind.ROTATION if word in ROTATION_NAMES else ScrewKind.TRANSLATION
            yield read(f"{kind} {word[-1]}", planar=planar, units=units)
        return
    form, _, rest = motion.partition(" ")
    form, rest = form.lower(), rest.strip()
    if form in ("all", "everything") and not rest:
        yield from _all_but(motion, "", planar, units)
    elif form == "all" and rest.lower().startswith("but "):
        yield from _all_but(motion, rest[4:], planar, units)
    elif form in ("everything", "nothing") and rest:
        raise unreadable(motion, f"nothing stands behind {form}")
    elif form == "nothing":
        yield Written(motion, None, ScrewKind.NONE, np.zeros(3), None, 0.0)
    elif form == "planar":
        given = re.sub(r"^(?:across|normal\s+to)\s+", "", rest)
        normal = _direction(motion, given or "z" if planar else given, planar=False)
        yield from _told(planar, motion, ScrewKind.TRANSLATION, _across(normal[None]), None)
        yield from _told(planar, motion, ScrewKind.ROTATION, normal[None], None)
    elif form == "spherical":
        place = re.sub(r"^(?:at|about|through)\s+", "", rest)
        yield from _told(planar, motion, ScrewKind.ROTATION, np.eye(3), place)
    elif form == "cylindrical":
        given, point = _parted(motion, ScrewKind.ROTATION, rest, False)
        axis = _direction(motion, given, planar=False)[None]
        yield from _told(planar, motion, ScrewKind.ROTATION, axis, point)
        yield from _told(planar, motion, ScrewKind.TRANSLATION, axis, None)
    elif form == "universal":
        given, point = _parted(motion, ScrewKind.ROTATION, rest, False)
        axes = [_direction(motion, each, planar=False) for each in _DIRECTION.findall(given)]
        if len(axes) != 2:
            raise unreadable(motion, "two directions are wanted", 'write "universal x and y"; ')
        yield from _told(planar, motion, ScrewKind.ROTATION, np.array(axes), point or "")
    else:
        yield read(motion, planar=planar, units=units)


def _all_but(motion: str, given: str, planar: bool, units: Units) -> Iterator[Written]:
    """The translations of a point across some directions, and the rotations across others."""
    left: list[Written] = []
    for each in re.split(r"\s+and\s+", given) if given else ():
        is_nested = each.lower().startswith("all")
        one = [read(each)] if is_nested else _motions(each.strip(), planar, units)
        left.extend(one)
    if any(each.kind is ScrewKind.SCREW for each in left):
        hint = "type the motions that are wanted, apart by semicolons; "
        raise unreadable(motion, "of a screw there is no one opposite", hint)
    stopped = [each for each in left if each.kind is ScrewKind.TRANSLATION]
    if len({each.point or "" for each in stopped}) > 1:
        raise unreadable(motion, "the translations are of two points", "give them one; ")
    point = stopped[0].point if stopped else None
    for kind in (ScrewKind.TRANSLATION, ScrewKind.ROTATION):
        taken = [each.direction for each in left if each.kind is kind]
        if planar:
            # What there is not in the plane is taken as well.
            taken += list(np.eye(3)[2:] if kind is ScrewKind.TRANSLATION else np.eye(3)[:2])
        rows = _across(np.array(taken).reshape(-1, 3))
        yield from _told(planar, motion, kind, rows, point or "")


def _across(directions: FloatArray) -> FloatArray:
    """(k, 3) unit vectors at right angles to some directions, as near to x, y and z as can be."""
    if not len(directions):
        return np.eye(3)
    _, sizes, right = np.linalg.svd(directions)
    rows = canonical(right[int(np.sum(sizes > ROUNDING)) :])
    return np.asarray(np.where(np.abs(rows) > ROUNDING, rows, 0.0))


def _told(
    planar: bool, text: str, kind: ScrewKind, directions: FloatArray, point: str | None
) -> Iterator[Written]:
    """Motions of one kind, each with a text of its own."""
    for axis in directions:
        along = next((name for name, unit in _AXES.items() if np.array_equal(axis, unit)), "")
        along = along or f"({', '.join(f'{part:.6g}' for part in axis)})"
        if planar and (axis[2] != 0.0) is (kind is ScrewKind.TRANSLATION):
            raise unreadable(text, f"in a planar model there is no {kind} along {along}")
        is_free = kind is ScrewKind.TRANSLATION
        said = f"{kind} about {point} along {along}" if point and not is_free else f"{kind} {along}"
        yield Written(said, None, kind, axis, point, math.inf if is_free else 0.0)


def read(text: str, *, planar: bool = False, units: Units = METRES) -> Written:
    """Read one motion, no short form.

    Raises:
        TypeError: it is no text.
        ModelError: it is nothing of what this module says.
    """
    if not isinstance(text, str):
        raise TypeError(f"a wanted motion is a text, not {type(text).__name__}")
    head, colon, motion = text.rpartition(":")
    body = head.strip() if colon else None
    if body == "":
        raise unreadable(text, "there is no body before the colon")
    word, _, rest = motion.strip().partition(" ")
    if word.lower() not in _KINDS:
        near = nearest(word, (*_KINDS, *_FORMS))
        what = f"{in_short(word)} is no motion" if word else "there is no motion in it"
        raise unreadable(text, what, f"did you mean {near[0]}? " if near else "")
    kind = ScrewKind(word.lower())
    if planar and kind is ScrewKind.SCREW:
        raise unreadable(text, "in a planar model there are no screws")
    rest, pitch = _with_pitch(text, kind, rest.strip(), units)
    direction, point = _parted(text, kind, rest, planar)
    axis = _direction(text, direction, planar=planar)
    if planar and kind is not ScrewKind.TRANSLATION and np.abs(axis[:2]).max() > 0.0:
        raise unreadable(text, "in a planar model a body turns about z alone")
    return Written(text, body, kind, axis, point, pitch)


def _with_pitch(text: str, kind: ScrewKind, rest: str, units: Units) -> tuple[str, float]:
    found = _PITCH.match(rest)
    if kind is ScrewKind.TRANSLATION and found is None:
        return rest, math.inf
    if kind is not ScrewKind.SCREW:
        if found is not None:
            raise unreadable(text, f"a {kind} has no pitch", "write screw, or leave it out; ")
        return rest, 0.0
    if found is None:
        raise unreadable(text, "a screw needs a pitch", 'end with "pitch 0.001", in m/rad; ')
    try:
        pitch = pitch_of(found["pitch"], units)
    except QuantityError as error:
        raise unreadable(text, f"its pitch: {error}") from None
    if pitch == 0.0:
        raise unreadable(text, "a screw of pitch 0 is a rotation", "write rotation; ")
    return found["rest"], pitch


def pitch_of(text: str, units: Units = METRES) -> float:
    """A pitch [m/rad] such as "0.001", "10 mm", "10 mm/rad" or "5 mm/turn".

    Raises:
        QuantityError: it is none.
    """
    length, turns = _PER_TURN.subn("", text.strip())
    length = re.sub(r"\s*/\s*rad$", "", length)
    return quantity(length, units.symbol("m")) / (2.0 * math.pi if turns else 1.0)


def _parted(text: str, kind: ScrewKind, rest: str, planar: bool) -> tuple[str, str | None]:
    """Direction and point, as they are written; a translation is "at" a point of the body."""
    for pattern in (_POINT_FIRST, _POINT_LAST):
        found = pattern.match(rest)
        if found is not None:
            return found["direction"], found["point"].strip()
    if planar and kind is not ScrewKind.TRANSLATION:
        point = rest.removeprefix("about ").removeprefix("along ").strip()
        axis = point.lower().lstrip("+-")
        return (point, None) if axis in ("x", "y") else ("z", None if axis in ("", "z") else point)
    return rest, None


def _direction(text: str, given: str, *, planar: bool) -> FloatArray:
    word = re.sub(r"^(along|about)\s+", "", given.strip())
    sign = -1.0 if word.startswith("-") else 1.0
    axis = _AXES.get(word.lstrip("+-").lower())
    if axis is not None and len(word) <= 2:
        made = sign * np.array(axis)
    elif word.startswith("("):
        made = numbers(text, word, (2, 3) if planar else (3,))
    else:
        what = f"{in_short(word)} is no direction" if word else "there is no direction"
        raise unreadable(text, what, "write x, y, z or three numbers, such as (1, 0, 1); ")
    size = float(np.linalg.norm(made))
    if size == 0.0:
        raise unreadable(text, "a direction is not zero")
    if planar and made[2] != 0.0 and np.abs(made[:2]).max() > 0.0:
        raise unreadable(text, "a planar model has no z")
    return made / size


def numbers(
    text: str, word: str, counts: tuple[int, ...], units: Units | None = None
) -> FloatArray:
    """Three numbers in brackets; of two the third is zero.

    Args:
        text: What they stand in.
        word: They, with their brackets.
        counts: How many there may be.
        units: Of lengths, each of which may say its own; None of plain numbers.

    Raises:
        ModelError: they are none, or there are more or fewer.
    """
    if not word.endswith(")"):
        raise unreadable(text, f"the bracket of {in_short(word)} is not closed")
    inside = word[1:-1].strip()
    parts = [each for each in re.split(r"\s*,\s*" if "," in inside else r"\s+", inside) if each]
    # Blanks may stand between numbers beside commas too.
    if units is None:
        parts = " ".join(parts).split()
    values = [_number(text, each, units) for each in parts]
    if len(values) not in counts:
        wanted = " or ".join("two" if count == 2 else "three" for count in counts)
        raise unreadable(text, f"{in_short(word)} has {len(values)} numbers, not {wanted}")
    return np.array((*values, 0.0)[:3])


def _number(text: str, word: str, units: Units | None) -> float:
    if units is not None:
        try:
            return quantity(word, units.symbol("m"))
        except QuantityError as error:
            raise unreadable(text, str(error)) from None
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise unreadable(text, f"{in_short(word)} is no number")
    return value


def unreadable(text: str, why: str, hint: str = "") -> ModelError:
    """The error for a wanted motion that is none, with how to write one."""
    return model_error(
        "bad-wanted",
        f"cannot read the wanted motion {in_short(text)}: {why}",
        f"{hint}write BODY: MOTION, {_EXAMPLE}" if not hint else f"{hint}{_EXAMPLE}",
    )


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
        point = place_of(result, written) if written.point else space.about
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


def place_of(result: Result, written: Written) -> FloatArray:
    """(3,) the point of a motion that was given one, by numbers or by its name [m].

    Raises:
        ModelError: there is no such point, or there are several.
    """
    word = written.point or ""
    planar = result.given.planar
    if word.startswith("("):
        return numbers(written.text, word, (2, 3) if planar else (3,), METRES)
    parts, kinds = result.parts, result.given.arrays.node_kind
    named = {
        node: parts.name_of_point(node)
        for node in np.flatnonzero(kinds <= NodeKind.POSITION).tolist()
        if parts.name_of_point(node)
    }
    found = [node for node, name in named.items() if name == word]
    if len(found) == 1:
        return np.asarray(result.given.arrays.node_value[:3, found[0]])
    if found:
        raise model_error("ambiguous-name", f"{len(found)} points are called {in_short(word)}")
    near = nearest(word, named.values())
    raise model_error(
        "no-such-point",
        f"there is no point called {in_short(word)}, in the wanted motion {in_short(written.text)}",
        f"did you mean {' or '.join(map(in_short, near))}?" if near else "write it as (x, y, z)",
    )


#: A body whose part in a motion is less stands still.
_STILL = 1.0e-6
#: How many declared degrees of freedom are looked at.
_MOST = 64


def declared_of(result: Result, subject: Subject, space: ScrewSpace) -> tuple[Wanted, ...]:
    """What the declared degrees of freedom make of a body, those that do not move it left out.

    That of a coordinate of the body itself is the translation along it, or the rotation about
    it, if the body can do that; every other one is the motion in which the others stand still.
    """
    left = Freed(result, is_freed=False)
    undeclared = left.space(subject) if left.is_known else None
    made = (
        _own(result, subject, space, freedom) or _moved(subject, space, freedom, undeclared)
        for freedom in result.freedoms[:_MOST]
    )
    return tuple(filter(None, made))


def not_wanted(result: Result, subject: Subject, aim: Aim) -> Change:
    """Takes the declarations back that move the body otherwise than is wanted."""
    coordinates, deformations = [], []
    for freedom in result.freedoms[:_MOST]:
        moved = _moved(subject, aim.freedom, freedom)
        if moved is None:
            continue
        # Whether it has a part in what is unwanted.
        row = moved.twist * aim.freedom.factors
        if np.linalg.norm(aim.unwanted @ row) <= 1.0e-3 * np.linalg.norm(row):
            continue
        kind, number = freedom.owner
        if kind == "node":
            coordinates.append((number, freedom.part, Class.DEPENDENT))
        else:
            part, element = freedom.place
            place, own = result.condensed.in_given(element, part + 1)
            given = int(result.given.arrays.element_number[place])
            deformations.append((given, own, Class.DEPENDENT))
    return Change(tuple(deformations), tuple(coordinates))


def _own(result: Result, subject: Subject, space: ScrewSpace, freedom: Freedom) -> Wanted | None:
    kind, number = freedom.owner
    node = result.given.node_index.get(number) if kind == "node" else None
    if node is None or node not in (*subject.positions, *subject.orientations):
        return None
    turns = freedom.part.startswith("r")
    direction = np.eye(3)["xyz".index(freedom.part[-1])]
    way = ScrewKind.ROTATION if turns else ScrewKind.TRANSLATION
    pitch = 0.0 if turns else math.inf
    written = Written(freedom.label, None, way, direction, None, pitch)
    made = wanted_of(result, space, written)
    return replace(made, is_declared=True) if made.is_free else None


def _moved(
    subject: Subject, space: ScrewSpace, freedom: Freedom, undeclared: ScrewSpace | None = None
) -> Wanted | None:
    """What a freedom makes of a body beside what it does undeclared; None where that is nothing."""
    motion = freedom.motion
    if motion is None:
        return None
    velocity = motion.displacement[list(subject.positions)].mean(axis=0)
    rotation = motion.rotation[list(subject.orientations)].mean(axis=0)
    most = np.abs(motion.displacement).max() + space.length * np.abs(motion.rotation).max()
    if undeclared is not None:
        both = np.concatenate((rotation, velocity))
        rotation, velocity = np.split(both - undeclared.nearest(both), 2)
    screw = screw_of(
        *(rotation, velocity, space.about, space.length), rest=_STILL * most, rounding=_STILL
    )
    if not screw:
        return None
    twist = space.nearest(np.concatenate((rotation, velocity)))
    return Wanted(
        *(freedom.label, screw.kind, screw.direction, screw.point, screw.pitch),
        *(twist, True, True),
    )
