# SPDX-License-Identifier: BSD-3-Clause
"""What a body is meant to do, as it is written.

    BODY: translation DIRECTION
    BODY: rotation DIRECTION
    BODY: rotation about POINT along DIRECTION
    BODY: screw DIRECTION pitch NUMBER
    BODY: screw about POINT along DIRECTION pitch NUMBER

A DIRECTION is x, y or z, or three numbers such as (1, 0, 1); a POINT three numbers [m], such as
(0, 0, 0.04), or the name of a point; a pitch is in metres a radian, positive for a right-hand
thread. "along" and "about" may stand before any direction, and "BODY:" may be left out where the
body is given otherwise. A rotation or a screw without a point is about that line along DIRECTION
which the body can turn about, of several the one nearest to its middle. In the plane points have
two numbers and a rotation needs no direction.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

import numpy as np

from ...analysis.screws import ScrewKind
from ...core.arrays import FloatArray
from ...deck.errors import ModelError, model_error
from ...model.names import nearest
from ...util.plain_text import in_short

_KINDS = ("translation", "rotation", "screw")
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_EXAMPLE = 'such as "stage: translation z" or "stage: rotation about (0, 0, 0.04) along x"'
_PITCH = re.compile(r"^(?P<rest>.*?)\s*,?\s*\bpitch\s+(?P<pitch>\S+)$", re.DOTALL)
_POINT_FIRST = re.compile(r"^about\s+(?P<point>.+?)\s+along\s+(?P<direction>.+)$", re.DOTALL)
_POINT_LAST = re.compile(r"^(?P<direction>.+?)\s+through\s+(?P<point>.+)$", re.DOTALL)


class Written(NamedTuple):
    """A wanted motion as far as it can be read without the mechanism."""

    text: str
    body: str | None
    kind: ScrewKind
    direction: FloatArray
    point: str | None
    pitch: float


def read(text: str, *, planar: bool = False) -> Written:
    """Read what is wanted.

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
        near = nearest(word, _KINDS)
        what = f"{in_short(word)} is no motion" if word else "there is no motion in it"
        raise unreadable(text, what, f"did you mean {near[0]}? " if near else "")
    kind = ScrewKind(word.lower())
    if planar and kind is ScrewKind.SCREW:
        raise unreadable(text, "in a planar model there are no screws")
    rest, pitch = _with_pitch(text, kind, rest.strip())
    direction, point = _parted(text, kind, rest, planar)
    axis = _direction(text, direction, planar=planar)
    if planar and kind is not ScrewKind.TRANSLATION and np.abs(axis[:2]).max() > 0.0:
        raise unreadable(text, "in a planar model a body turns about z alone")
    return Written(text, body, kind, axis, point, pitch)


def _with_pitch(text: str, kind: ScrewKind, rest: str) -> tuple[str, float]:
    found = _PITCH.match(rest)
    if kind is ScrewKind.TRANSLATION and found is None:
        return rest, math.inf
    if kind is not ScrewKind.SCREW:
        if found is not None:
            raise unreadable(text, f"a {kind} has no pitch", "write screw, or leave it out; ")
        return rest, 0.0
    if found is None:
        raise unreadable(text, "a screw needs a pitch", 'end with "pitch 0.001", in m/rad; ')
    pitch = _number(text, found["pitch"])
    if pitch == 0.0:
        raise unreadable(text, "a screw of pitch 0 is a rotation", "write rotation; ")
    return found["rest"], pitch


def _parted(text: str, kind: ScrewKind, rest: str, planar: bool) -> tuple[str, str | None]:
    """Direction and point, as they are written."""
    if kind is ScrewKind.TRANSLATION:
        return rest, None
    for pattern in (_POINT_FIRST, _POINT_LAST):
        found = pattern.match(rest)
        if found is not None:
            return found["direction"], found["point"].strip()
    if planar:
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


def numbers(text: str, word: str, counts: tuple[int, ...]) -> FloatArray:
    """Three numbers in brackets; of two the third is zero.

    Raises:
        ModelError: they are none, or there are more or fewer.
    """
    if not word.endswith(")"):
        raise unreadable(text, f"the bracket of {in_short(word)} is not closed")
    values = [_number(text, each) for each in re.split(r"[,\s]+", word[1:-1].strip()) if each]
    if len(values) not in counts:
        wanted = " or ".join("two" if count == 2 else "three" for count in counts)
        raise unreadable(text, f"{in_short(word)} has {len(values)} numbers, not {wanted}")
    return np.array((*values, 0.0)[:3])


def _number(text: str, word: str) -> float:
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
