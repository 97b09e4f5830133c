# SPDX-License-Identifier: BSD-3-Clause
"""What is asked of a cost, brought into one form; everything that is wrong is told at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from ..util.plain_text import in_short
from ..util.quantities import NOTCH, measured
from .asking import (
    NONE,
    AskedError,
    MisalignmentAsked,
    ReleaseAsked,
    StrokeAsked,
    misalignment_of,
    release_of,
    shift_of,
    stroke_of,
)

HELD, DRIVE, AUTO = ("elastic", "rigid"), ("free", "locked"), "auto"
#: Places along a stroke by default, and at most.
POINTS, _MOST_POINTS = 21, 2001
#: Beams a sheet at most.
_MOST_BEAMS = 1000

Made = TypeVar("Made")


@dataclass(frozen=True)
class Asked:
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
    """

    at: object = None
    release: tuple[ReleaseAsked, ...] | None = None
    stroke: StrokeAsked | None = None
    misalign: tuple[MisalignmentAsked, ...] = ()
    shift: float = -0.05
    held: str = HELD[0]
    drive: str = DRIVE[0]
    beams: int | str = AUTO
    points: int = POINTS
    bodies: bool = False
    beyond: bool = False

    @classmethod
    def of(
        cls,
        *,
        at: object,
        release: object,
        stroke: object,
        misalign: object,
        shift: object,
        held: object,
        drive: object,
        beams: object,
        points: object,
        bodies: object = False,
        beyond: object = False,
    ) -> Asked:
        """From arguments as users give them.

        Raises:
            AskedError: some are not understood; all of them are told.
        """
        wrong: list[str] = []

        def tried(make: Callable[[], Made], default: Made) -> Made:
            try:
                return make()
            except (TypeError, ValueError) as error:
                wrong.append(str(error))
                return default

        made = cls(
            at,
            tried(lambda: None if release is None else _releases(release), None),
            tried(lambda: None if stroke is None else _stroke(stroke), None),
            tried(lambda: _misalignments(misalign), ()),
            tried(lambda: shift_of(shift), -0.05),  # type: ignore[arg-type]
            tried(lambda: _one_of("held", held, HELD), ""),
            tried(lambda: _one_of("drive", drive, DRIVE), ""),
            tried(lambda: _beams(beams), _AUTO),
            tried(lambda: _whole("the number of places along a stroke", points, _MOST_POINTS), 2),
            tried(lambda: _flag("bodies", bodies), False),
            tried(lambda: _flag("beyond", beyond), False),
        )
        if made.points < 2 and not wrong:
            wrong.append("a stroke has 2 places at least")
        if wrong:
            raise AskedError(*wrong)
        return made


#: Of its type a number or a word.
_AUTO: int | str = AUTO


def _one_of(what: str, given: object, allowed: Sequence[str]) -> str:
    if not isinstance(given, str) or given not in allowed:
        raise AskedError(f"{what} is {' or '.join(allowed)}, not {in_short(given)}")
    return given


def _flag(what: str, given: object) -> bool:
    if not isinstance(given, bool):
        raise AskedError(f"{what} is True or False, not {in_short(given)}")
    return given


def _beams(given: object) -> int | str:
    if given == AUTO:
        return AUTO
    if isinstance(given, str) and given.isdigit():
        given = int(given)
    if isinstance(given, str):
        raise AskedError(f"the number of beams is a whole number or auto, not {in_short(given)}")
    return _whole("the number of beams", given, _MOST_BEAMS)


def _whole(what: str, given: Any, most: int) -> int:
    if isinstance(given, bool) or not isinstance(given, int) or not 1 <= given <= most:
        raise AskedError(f"{what} is a whole number from 1 to {most}, not {in_short(given)}")
    return given


def _releases(given: object) -> tuple[ReleaseAsked, ...]:
    """Designs; what releases nothing is the one as built, which is there anyway."""
    if isinstance(given, (str, Mapping)):
        given = [given]
    if not isinstance(given, Iterable):
        raise TypeError(f"releases are a list of designs, not {in_short(given)}")
    given = list(given)
    made = [_release(each) for each in given]
    if any(made) and any(isinstance(each, str) and each.strip() == NONE for each in given):
        raise AskedError(
            f"{NONE!r} asks for the design as built alone, and the others ask for releases: "
            "choose; the design as built is shown in any case"
        )
    return tuple(each for each in made if each)


def _release(given: object) -> ReleaseAsked:
    if isinstance(given, str):
        return release_of(given)
    if isinstance(given, Mapping):
        return {_pair(key): _stiffness(value) for key, value in given.items()}
    if isinstance(given, Sequence) and len(given) in (2, 3) and isinstance(given[1], (int, str)):
        return {_pair(given): 0.0}
    if isinstance(given, Iterable):
        return {_pair(each): 0.0 for each in given}
    raise TypeError(_RELEASE.format(in_short(given)))


_RELEASE = (
    "a release is (element, deformation), a list of them, a dict with the stiffness of each "
    'notch, or a text such as "1:5" or "sheet 1:in-plane bending", not {}'
)


def _pair(given: object) -> tuple[Any, ...]:
    """An element and a deformation, by numbers or names; and maybe the end at which it is."""
    wrong = TypeError(_RELEASE.format(in_short(given)))
    if not isinstance(given, Sequence) or isinstance(given, str) or len(given) not in (2, 3):
        raise wrong
    element, which, *_ = given
    if isinstance(element, (bool, float)) or element is None or isinstance(which, bool):
        raise wrong
    if not isinstance(which, (int, str)):
        raise wrong
    return tuple(given)


def _stiffness(given: Any) -> float:
    value = 0.0 if given is None else measured(given, NOTCH)
    if not 0.0 <= value < float("inf"):
        raise AskedError(
            f"the stiffness of a notch is a finite number from 0, not {in_short(given)}"
        )
    return value


def _stroke(given: object) -> StrokeAsked:
    if isinstance(given, StrokeAsked):
        return given
    if isinstance(given, str):
        return stroke_of(given)
    if isinstance(given, Sequence) and len(given) == 4:
        point, name, start, stop = given
        name = _named(name)
        return StrokeAsked(point, name, _measured(start, name), _measured(stop, name))
    raise TypeError(
        'a stroke is (point, coordinate, from, to), or a text such as "1:z=25mm..35mm", not '
        f"{in_short(given)}"
    )


def _named(name: object) -> str:
    return _one_of("a coordinate", name, ("x", "y", "z", "rx", "ry", "rz"))


def _measured(given: object, coordinate: str) -> float:
    return measured(given, "rad" if coordinate.startswith("r") else "m")


def _misalignments(given: object) -> tuple[MisalignmentAsked, ...]:
    if isinstance(given, str):
        given = [given]
    if not isinstance(given, Iterable):
        raise TypeError(f"misalignments are a list, not {in_short(given)}")
    return tuple(map(_misalignment, given))


def _misalignment(given: object) -> MisalignmentAsked:
    if isinstance(given, MisalignmentAsked):
        return given
    if isinstance(given, str):
        return misalignment_of(given)
    if isinstance(given, Sequence) and len(given) in (3, 4):
        clamp, name, value, *about = given
        name = _named(name)
        return MisalignmentAsked(clamp, name, _measured(value, name), *about)
    raise TypeError(
        'a misalignment is (clamp, coordinate, value), or a text such as "11:x=50um", not '
        f"{in_short(given)}"
    )
