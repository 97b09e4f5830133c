# SPDX-License-Identifier: BSD-3-Clause
"""What is asked for, as people write it: "1:5+2:5=3.5", "1:z=25mm..35mm", "11:x=50um@13", "-5%"."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from ..model.words import is_word
from ..util.errors import FlexactError
from ..util.plain_text import in_short
from ..util.quantities import NOTCH, QuantityError, quantity

_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*")
_COORDINATE = re.compile(r"(?s)(?P<point>.+):\s*(?P<name>\w+)\s*(?P<by>\+?)=(?P<value>.+)")
_RELEASE = re.compile(
    r"\s*(?P<part>[^=]+?)\s*:\s*(?P<which>\d{1,9}|[A-Za-z][A-Za-z -]*?)\s*"
    r"(?:@\s*(?P<at>[^=]+?)\s*)?(?:=(?P<notch>.*))?",
    re.DOTALL,
)
_NAMES = ("x", "y", "z", "rx", "ry", "rz")
#: That only the design as built is looked at.
NONE = "none"


class AskedError(FlexactError, ValueError):
    """What was asked for is not understood; its text says what is wanted.

    Attributes:
        messages: What is wrong, one by one.
    """

    def __init__(self, *messages: str) -> None:
        """Keep what is wrong."""
        super().__init__("; ".join(messages))
        self.messages = messages

    def __reduce__(self) -> tuple[type[AskedError], tuple[str, ...]]:
        """What makes it anew, as a worker of a sweep does."""
        return type(self), self.messages


class PointText(NamedTuple):
    """A point by its number, or by its name."""

    text: str

    @property
    def target(self) -> int | str:
        """As a number where it is one."""
        text = self.text.strip()
        return int(text) if re.fullmatch(r"\d{1,9}", text) else text


class StrokeAsked(NamedTuple):
    """A stroke: of which point, along what, from where to where."""

    point: object
    coordinate: str
    start: float
    stop: float
    is_offset: bool = False
    """Whether the values count from where the point is in the deck."""


class MisalignmentAsked(NamedTuple):
    """A misalignment: of which clamp, along what, by how much, and about which point."""

    clamp: object
    coordinate: str
    value: float
    about: object = None


#: Deformations that are released, with the stiffness of each one's notch; 0: ideal. Each is
#: (element, deformation) by numbers or names, or with the end as the third.
ReleaseAsked = dict[tuple[Any, ...], float]


def shift_of(text: str | float) -> float:
    """A shift of a frequency, such as "-5%" or -0.05.

    Raises:
        AskedError: it is none, 0, or a fall by all or more.
    """
    wanted = "a shift is wanted, such as -5% (or -0.05): more than -100%, at most 100%, not 0"
    if isinstance(text, str):
        found = _NUMBER.fullmatch(text)
        if found is None or found[2] not in ("", "%"):
            raise AskedError(f"{wanted}; {in_short(text.strip())} is none")
        value = float(found[1]) / (100.0 if found[2] else 1.0)
    else:
        value = float(text)
    if not (-1.0 < value <= 1.0) or value == 0.0:
        raise AskedError(f"{wanted}; {in_short(text)} is none")
    return value


def release_of(text: str) -> ReleaseAsked:
    """What is released together: "1:5", "1:5=3.5" with a notch, "1:5+2:5"; "none": nothing.

    Names and words do as well as numbers, "sheet 1:in-plane bending", at one end "...@stage".

    Raises:
        AskedError: it is not written so.
    """
    if text.strip() == NONE:
        return {}
    made: ReleaseAsked = {}
    for part in _parts(text):
        found = _RELEASE.fullmatch(part)
        which = "" if found is None else found["which"]
        if found is None or not (which.isdigit() or is_word(which)):
            raise AskedError(
                "a release is written ELEMENT:DEFORMATION, such as 1:5 or 'sheet 1:in-plane "
                "bending'; with the stiffness of its notch 1:5=3.5 [N m/rad]; several together "
                f"1:5+2:5; not {in_short(text)}"
            )
        part_of = PointText(found["part"]).target
        one = part_of, int(which) if which.isdigit() else which
        at = () if found["at"] is None else (PointText(found["at"]).target,)
        made[(*one, *at)] = _notch(found["notch"])
    return made


def _parts(text: str) -> list[str]:
    """Between plus signs, but not those of exponents, such as in 1e+3."""
    return re.split(r"(?<![eE])\+", text)


def _notch(text: str | None) -> float:
    if text is None:
        return 0.0
    try:
        value = quantity(text, NOTCH)
    except QuantityError:
        value = -1.0
    if not value >= 0.0:
        raise AskedError(
            "the stiffness of a notch is a number from 0 in N m/rad (of an elongation in N/m), "
            f"not {in_short(text.strip())}"
        )
    return value


def stroke_of(text: str) -> StrokeAsked:
    """A stroke: "1:z=25mm..35mm", or from the deck's place "1:z+=-5mm..5mm", "1:z=+-5mm".

    Raises:
        AskedError: it is not written so.
    """
    found = _COORDINATE.fullmatch(text)
    start, dots, stop = found["value"].partition("..") if found else ("", "", "")
    if not dots and start.strip().startswith("+-"):
        # As far both ways from where it rests.
        dots, stop = "+-", start.strip()[2:]
        start = f"-{stop.strip()}"
    if found is None or not dots:
        raise AskedError(
            "a stroke is written POINT:COORDINATE=FROM..TO, such as 1:z=25mm..35mm, or counted "
            f"from the place in the deck 1:z+=-5mm..5mm or 1:z=+-5mm; not {in_short(text)}"
        )
    name, unit = _coordinate(found["name"])
    first, last = _quantity(start, unit), _quantity(stop, unit)
    if first == last:
        raise AskedError(f"the stroke {in_short(text)} ends where it begins")
    point = PointText(found["point"]).target
    return StrokeAsked(point, name, first, last, bool(found["by"]) or dots == "+-")


def misalignment_of(text: str) -> MisalignmentAsked:
    """A misalignment: "11:x=50um", or turned about a point "11:rx=1mrad@13".

    Raises:
        AskedError: it is not written so.
    """
    found = _COORDINATE.fullmatch(text)
    if found is None or found["by"]:
        raise AskedError(
            "a misalignment is written CLAMP:COORDINATE=VALUE, such as 11:x=50um, and turned "
            f"about a point 11:rx=1mrad@13; not {in_short(text)}"
        )
    value, _, about = found["value"].partition("@")
    name, unit = _coordinate(found["name"])
    if about and unit == "m":
        raise AskedError(f"only a turn is about a point: leave out @{about} of {in_short(text)}")
    return MisalignmentAsked(
        PointText(found["point"]).target,
        name,
        _quantity(value, unit),
        PointText(about).target if about else None,
    )


def _quantity(text: str, unit: str) -> float:
    try:
        return quantity(text, unit)
    except QuantityError as error:
        raise AskedError(str(error)) from None


def _coordinate(name: str) -> tuple[str, str]:
    if name not in _NAMES:
        raise AskedError(f"a coordinate is one of {', '.join(_NAMES)}, not {in_short(name)}")
    return name, "rad" if name.startswith("r") else "m"
