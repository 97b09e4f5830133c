# SPDX-License-Identifier: BSD-3-Clause
"""What is asked of a cost, brought into one form; everything that is wrong is told at once."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..elasticity.limits import AGAINST, share_given
from ..model.deformations import is_word
from ..util.errors import FlexactError
from ..util.quantities import NOTCH, Quantity, QuantityError, as_typed, measured, quantity
from ..util.text import in_short
from ..util.units import METRES, Units

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


class RequestError(FlexactError, ValueError):
    """What was asked for is not understood; its text says what is wanted.

    Attributes:
        messages: What is wrong, one by one.
    """

    def __init__(self, *messages: str) -> None:
        """Keep what is wrong."""
        super().__init__("; ".join(messages))
        self.messages = messages

    def __reduce__(self) -> tuple[type[RequestError], tuple[str, ...]]:
        """What makes it anew, as a worker of a sweep does."""
        return type(self), self.messages


def _target(text: str) -> int | str:
    """A point or element as it is written: its number, or its name."""
    text = text.strip()
    return int(text) if re.fullmatch(r"\d{1,9}", text) else text


#: A stroke: of which point, along what, from where to where, and whether these count from where
#: the point is in the deck.
StrokeRequest = tuple[object, str, float, float, bool]
#: A misalignment: of which clamp, along what, by how much, and about which point.
MisalignmentRequest = tuple[object, str, float, object]
#: Deformations that are released, with the stiffness of each one's notch, in the units of the
#: model or a text; 0: ideal. Each is (element, deformation) by numbers or names, or with the end
#: as the third.
ReleaseRequest = dict[tuple[Any, ...], Quantity]


def shift_of(text: str | float) -> float:
    """A shift of a frequency, such as "-5%" or -0.05.

    Raises:
        RequestError: it is none, 0, or a fall by all or more.
    """
    wanted = "a shift is wanted, such as -5% (or -0.05): more than -100%, at most 100%, not 0"
    if isinstance(text, str):
        found = _NUMBER.fullmatch(text)
        if found is None or found[2] not in ("", "%"):
            raise RequestError(f"{wanted}; {in_short(text.strip())} is none")
        value = float(found[1]) / (100.0 if found[2] else 1.0)
    else:
        value = float(text)
    if not (-1.0 < value <= 1.0) or value == 0.0:
        raise RequestError(f"{wanted}; {in_short(text)} is none")
    return value


def release_of(text: str) -> ReleaseRequest:
    """What is released together: "1:5", "1:5=3.5" with a notch, "1:5+2:5"; "none": nothing.

    Names and words do as well as numbers, "sheet 1:in-plane bending", at one end "...@stage".

    Raises:
        RequestError: it is not written so.
    """
    if text.strip() == NONE:
        return {}
    made: ReleaseRequest = {}
    # Between plus signs, but not those of exponents, such as in 1e+3.
    for part in re.split(r"(?<![eE])\+", text):
        found = _RELEASE.fullmatch(part)
        which = "" if found is None else found["which"]
        if found is None or not (which.isdigit() or is_word(which)):
            raise RequestError(
                "a release is written ELEMENT:DEFORMATION, such as 1:5 or 'sheet 1:in-plane "
                "bending'; with the stiffness of its notch 1:5=3.5 [N m/rad]; several together "
                f"1:5+2:5; not {in_short(text)}"
            )
        one = _target(found["part"]), int(which) if which.isdigit() else which
        at = () if found["at"] is None else (_target(found["at"]),)
        try:
            notch = 0.0 if found["notch"] is None else as_typed(found["notch"], NOTCH)
            is_right = (quantity(notch, NOTCH) if isinstance(notch, str) else notch) >= 0.0
        except QuantityError:
            is_right = False
        if not is_right:
            raise RequestError(
                "the stiffness of a notch is a number from 0, such as 3.5Nm/rad (of an elongation "
                f"5N/mm), not {in_short(found['notch'].strip())}"
            )
        made[(*one, *at)] = notch
    return made


def stroke_of(text: str, units: Units = METRES) -> StrokeRequest:
    """A stroke: "1:z=25mm..35mm", or from the deck's place "1:z+=-5mm..5mm", "1:z=+-5mm".

    Raises:
        RequestError: it is not written so.
    """
    found = _COORDINATE.fullmatch(text)
    start, dots, stop = found["value"].partition("..") if found else ("", "", "")
    if not dots and start.strip().startswith("+-"):
        # As far both ways from where it rests.
        dots, stop = "+-", start.strip()[2:]
        start = f"-{stop.strip()}"
    if found is None or not dots:
        raise RequestError(
            "a stroke is written POINT:COORDINATE=FROM..TO, such as 1:z=25mm..35mm, or counted "
            f"from the place in the deck 1:z+=-5mm..5mm or 1:z=+-5mm; not {in_short(text)}"
        )
    name, unit = _coordinate(found["name"])
    first, last = (quantity(each, units.symbol(unit)) for each in (start, stop))
    if first == last:
        raise RequestError(f"the stroke {in_short(text)} ends where it begins")
    return _target(found["point"]), name, first, last, bool(found["by"]) or dots == "+-"


def misalignment_of(text: str, units: Units = METRES) -> MisalignmentRequest:
    """A misalignment: "11:x=50um", or turned about a point "11:rx=1mrad@13".

    Raises:
        RequestError: it is not written so.
    """
    found = _COORDINATE.fullmatch(text)
    if found is None or found["by"]:
        raise RequestError(
            "a misalignment is written CLAMP:COORDINATE=VALUE, such as 11:x=50um, and turned "
            f"about a point 11:rx=1mrad@13; not {in_short(text)}"
        )
    value, _, about = found["value"].partition("@")
    name, unit = _coordinate(found["name"])
    if about and unit == "m":
        raise RequestError(f"only a turn is about a point: leave out @{about} of {in_short(text)}")
    size = quantity(value, units.symbol(unit))
    return _target(found["point"]), name, size, _target(about) if about else None


def _coordinate(name: str) -> tuple[str, str]:
    if name not in _NAMES:
        raise RequestError(f"a coordinate is one of {', '.join(_NAMES)}, not {in_short(name)}")
    return name, "rad" if name.startswith("r") else "m"


HELD, DRIVE, AUTO = ("elastic", "rigid"), ("free", "locked"), "auto"
#: The shift of the first frequency by default.
SHIFT = -0.05
#: Of the strength by default.
SHARE = 0.5
#: Places along a stroke by default, and at most.
POINTS, _MOST_POINTS = 21, 2001
#: Beams a sheet at most.
_MOST_BEAMS = 1000


@dataclass(frozen=True)
class Request:
    """What is asked of a cost; see `flexact.cost`.

    Attributes:
        at: The point, as it was given; None for the default.
        release: Sets that are released together; None for the proven ones.
        stroke: None where none is asked for.
        misalign: Misalignments that are given together.
        shift: Relative.
        held: "elastic" or "rigid".
        drive: "free" or "locked".
        beams: "auto", or how many.
        points: How many places along the stroke.
        bodies: Whether what is inside of bodies is among the proven releases.
        beyond: Whether strokes and misalignments may be larger than the model.
        strength: Whether it is asked how far the drive may go.
        share: Of the strength.
        support: Part of the stiffness at rest that a support is to keep; None for none.
        against: "strength" or "fatigue"; None: of fatigue where it is given.
    """

    at: object
    release: tuple[ReleaseRequest, ...] | None
    stroke: StrokeRequest | None
    misalign: tuple[MisalignmentRequest, ...]
    shift: float
    held: str
    drive: str
    beams: int | str
    points: int
    bodies: bool
    beyond: bool
    strength: bool = False
    share: float = SHARE
    support: float | None = None
    against: str | None = None

    @classmethod
    def of(
        cls,
        *,
        at: object,
        release: Iterable[object] | None,
        stroke: str | Sequence[object] | None,
        misalign: Iterable[object],
        shift: float | str,
        held: str,
        drive: str,
        beams: int | str,
        points: int,
        bodies: bool,
        beyond: bool,
        strength: bool = False,
        share: float | str | None = None,
        support: float | str | None = None,
        against: str | None = None,
        units: Units = METRES,
    ) -> Request:
        """From arguments as users give them; numbers without a unit are in these.

        Raises:
            RequestError: some are not understood; all of them are told.
        """
        wrong: list[str] = []

        def tried(make: Callable[..., Any], *given: object) -> Any:
            try:
                return make(*given)
            except (TypeError, ValueError) as error:
                wrong.append(str(error))
                return None

        made = cls(
            at,
            None if release is None else tried(_releases, release),
            None if stroke is None else tried(stroke_given, stroke, units),
            tried(_misalignments, misalign, units),
            tried(shift_of, shift),
            tried(_one_of, "held", held, HELD),
            tried(_one_of, "drive", drive, DRIVE),
            tried(_beams, beams),
            tried(_whole, "the number of places along a stroke", points, _MOST_POINTS),
            tried(_flag, "bodies", bodies),
            tried(_flag, "beyond", beyond),
            tried(_flag, "strength", strength),
            SHARE if share is None else tried(_part, "a share of the strength", share),
            None if support is None else tried(_part, "a part of a stiffness", support),
            None if against is None else tried(_one_of, "against", against, AGAINST),
        )
        if not wrong and made.points < 2:
            wrong.append("a stroke has 2 places at least")
        alone = {"share": share, "support": support, "against": against}
        if named := [name for name, value in alone.items() if value is not None and not strength]:
            wrong.append(f"{', '.join(named)}: of a strength; ask for it with --strength, too")
        if wrong:
            raise RequestError(*wrong)
        return made


def _one_of(what: str, given: object, allowed: Sequence[str]) -> str:
    if not isinstance(given, str) or given not in allowed:
        raise RequestError(f"{what} is {' or '.join(allowed)}, not {in_short(given)}")
    return given


def _part(what: str, given: object) -> float:
    """A part above 0 and at most 1, such as 0.5 or "50%"."""
    if isinstance(given, str) and (found := _NUMBER.fullmatch(given)) and found[2] in ("", "%"):
        given = float(found[1]) / (100.0 if found[2] else 1.0)
    return share_given(given, what)


def _flag(what: str, given: object) -> bool:
    if not isinstance(given, bool):
        raise RequestError(f"{what} is True or False, not {in_short(given)}")
    return given


def _beams(given: object) -> int | str:
    if given == AUTO:
        return AUTO
    if isinstance(given, str) and given.isdigit():
        given = int(given)
    if isinstance(given, str):
        raise RequestError(f"the number of beams is a whole number or auto, not {in_short(given)}")
    return _whole("the number of beams", given, _MOST_BEAMS)


def _whole(what: str, given: Any, most: int) -> int:
    if isinstance(given, bool) or not isinstance(given, int) or not 1 <= given <= most:
        raise RequestError(f"{what} is a whole number from 1 to {most}, not {in_short(given)}")
    return given


def _releases(given: object) -> tuple[ReleaseRequest, ...]:
    """Designs; what releases nothing is the one as built, which is there anyway."""
    if isinstance(given, (str, Mapping)):
        given = [given]
    if not isinstance(given, Iterable):
        raise TypeError(f"releases are a list of designs, not {in_short(given)}")
    given = list(given)
    made = [_release(each) for each in given]
    if any(made) and any(isinstance(each, str) and each.strip() == NONE for each in given):
        raise RequestError(
            f"{NONE!r} asks for the design as built alone, and the others ask for releases: "
            "choose; the design as built is shown in any case"
        )
    return tuple(each for each in made if each)


def _release(given: object) -> ReleaseRequest:
    if isinstance(given, str):
        return release_of(given)
    if isinstance(given, Mapping):
        return {_pair(key): _stiffness(value) for key, value in given.items()}
    if isinstance(given, Sequence) and len(given) in (2, 3) and isinstance(given[1], (int, str)):
        return {_pair(given): 0.0}
    if isinstance(given, Iterable):
        return {_pair(each): 0.0 for each in given}
    raise TypeError(_REQUEST_RELEASE.format(in_short(given)))


_REQUEST_RELEASE = (
    "a release is (element, deformation), a list of them, a dict with the stiffness of each "
    'notch, or a text such as "1:5" or "sheet 1:in-plane bending", not {}'
)


def _pair(given: object) -> tuple[Any, ...]:
    """An element and a deformation, by numbers or names; and maybe the end at which it is."""
    if isinstance(given, Sequence) and not isinstance(given, str) and len(given) in (2, 3):
        element, which, *_ = given
        is_element = element is not None and not isinstance(element, (bool, float))
        if is_element and isinstance(which, (int, str)) and not isinstance(which, bool):
            return tuple(given)
    raise TypeError(_REQUEST_RELEASE.format(in_short(given)))


def _stiffness(given: Any) -> Quantity:
    value = 0.0 if given is None else measured(given, NOTCH)
    if not 0.0 <= value < float("inf"):
        raise RequestError(
            f"the stiffness of a notch is a finite number from 0, not {in_short(given)}"
        )
    return given if isinstance(given, str) else value


def stroke_given(given: object, units: Units) -> StrokeRequest:
    """A stroke as Python takes it: a text, or (point, coordinate, from, to).

    Raises:
        RequestError, QuantityError: the text is not written so.
        TypeError: it is neither.
    """
    if isinstance(given, str):
        return stroke_of(given, units)
    if isinstance(given, Sequence) and len(given) == 4:
        point, name, start, stop = given
        name, unit = _coordinate_given(name)
        return point, name, units.read(start, unit), units.read(stop, unit), False
    raise TypeError(
        'a stroke is (point, coordinate, from, to), or a text such as "1:z=25mm..35mm", not '
        f"{in_short(given)}"
    )


def _coordinate_given(name: object) -> tuple[str, str]:
    """A coordinate as it is given in Python, with its unit."""
    name = _one_of("a coordinate", name, _NAMES)
    return name, "rad" if name.startswith("r") else "m"


def _misalignments(given: object, units: Units) -> tuple[MisalignmentRequest, ...]:
    if isinstance(given, str):
        given = [given]
    if not isinstance(given, Iterable):
        raise TypeError(f"misalignments are a list, not {in_short(given)}")
    return tuple(_misalignment(each, units) for each in given)


def _misalignment(given: object, units: Units) -> MisalignmentRequest:
    if isinstance(given, str):
        return misalignment_of(given, units)
    if isinstance(given, Sequence) and len(given) in (3, 4):
        clamp, name, value, about = (*given, None)[:4]
        name, unit = _coordinate_given(name)
        return clamp, name, units.read(value, unit), about
    raise TypeError(
        'a misalignment is (clamp, coordinate, value), or a text such as "11:x=50um", not '
        f"{in_short(given)}"
    )
