# SPDX-License-Identifier: BSD-3-Clause
"""Values of tables: each check gives the value as it is used, or raises ValueError in words."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from ...core.elements import element_kinds
from ...deck.diagnostics import Diagnostic, Place, Problems, Severity, Source
from ...deck.rendering import ProblemsError
from ...util.records import cached_property
from ...util.text import in_short

#: Fourth powers of sizes, times moduli, are numbers.
LARGEST = 1e30


def _require(is_right: bool, wanted: str) -> None:
    if not is_right:
        raise ValueError(wanted)


def flag(value: Any) -> bool:
    """True or false; also 1 and 0."""
    is_number = isinstance(value, (bool, int, float))
    _require(is_number and value in (0, 1), "true or false is wanted")
    return bool(value)


def number(value: Any) -> float:
    """A finite number."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    _require(is_number, "a number is wanted")
    try:
        made = float(value)
    except OverflowError:
        made = math.inf
    _require(math.isfinite(made), "the number is not finite")
    return made


def whole(value: Any) -> int:
    """A whole number, also one like 2.0."""
    made = number(value)
    _require(made == int(made), "a whole number is wanted")
    return int(made)


def positive(value: Any) -> float:
    """A number above zero, neither tiny nor huge."""
    made = number(value)
    _require(1.0 / LARGEST < made < LARGEST, f"a number between 0 and {LARGEST:g} is wanted")
    return made


def not_negative(value: Any) -> float:
    """A number from zero on."""
    return 0.0 if number(value) == 0.0 else positive(value)


def count(value: Any) -> int:
    """A whole number from 1 on."""
    made = whole(value)
    _require(1 <= made < 10**6, "a whole number from 1 on is wanted")
    return made


def part(value: Any) -> float:
    """A number from 0 to 1."""
    made = number(value)
    _require(0.0 <= made <= 1.0, "a number from 0 to 1 is wanted")
    return made


def text(value: Any) -> str:
    """A text on one line."""
    _require(isinstance(value, str), "a text is wanted")
    return " ".join(value.split())


def texts(value: Any) -> tuple[str, ...]:
    """A text, or several."""
    return tuple(text(each) for each in (value if isinstance(value, list) else [value]))


def vector(*sizes: int) -> Callable[[Any], tuple[float, ...]]:
    """What checks for so many finite numbers."""

    def check(value: Any) -> tuple[float, ...]:
        given = value if isinstance(value, (list, tuple)) else [value]
        _require(len(given) in sizes, f"{' or '.join(map(str, sizes))} numbers are wanted")
        return tuple(number(each) for each in given)

    return check


def direction(value: Any) -> tuple[float, ...]:
    """A vector that is not zero."""
    made = vector(3)(value)
    _require(any(made), "the vector is zero")
    return made


def numbers_from_one(value: Any) -> tuple[int, ...]:
    """Numbers from 1 on, each once; a single one may stand without brackets."""
    made = tuple(count(each) for each in (value if isinstance(value, (list, tuple)) else [value]))
    _require(len(set(made)) == len(made), "a number stands there twice")
    return made


def deformations(value: Any) -> tuple[int, ...]:
    """Numbers of deformations from 1 to 6, each once."""
    made = numbers_from_one(value)
    _require(max(made, default=1) <= 6, "deformations have numbers from 1 to 6")
    return made


def shape(value: Any) -> str:
    """The kind of a cross-section."""
    _require(value in ("rect", "circ"), "'rect' or 'circ' is wanted")
    return str(value)


def sizes(value: Any) -> tuple[float, ...]:
    """Width and thickness, or a diameter."""
    return tuple(positive(each) for each in vector(1, 2)(value))


#: Colours by name; by number from 1 in this order.
COLOURS = {
    "blue": (0.62, 0.76, 0.86),
    "grey": (0.78, 0.78, 0.78),
    "darkblue": (0.0, 0.45, 0.7),
    "darkgrey": (0.44, 0.44, 0.44),
    "green": (0.5, 0.76, 0.56),
    "darkgreen": (0.35, 0.54, 0.4),
}


def colour(value: Any) -> tuple[float, ...]:
    """Red, green and blue from 0 to 1, or to 255 where one exceeds 1; a name, or its number."""
    if isinstance(value, str):
        _require(value in COLOURS, f"one of {', '.join(COLOURS)} is wanted, or three numbers")
        return COLOURS[value]
    if not isinstance(value, (list, tuple)):
        words = f"the colours have numbers from 1 to {len(COLOURS)}"
        _require(1 <= whole(value) <= len(COLOURS), words)
        return tuple(COLOURS.values())[whole(value) - 1]
    made = vector(3)(value)
    largest = 255.0 if max(made) > 1.0 else 1.0
    return tuple(part(each / largest) for each in made)


def kind(value: Any) -> str:
    """The keyword of an element, in small letters."""
    known = [each.keyword.lower() for each in element_kinds()]
    made = value.lower() if isinstance(value, str) else ""
    _require(made in known, f"one of {', '.join(known)} is wanted")
    return made


def moments(value: Any) -> tuple[float, ...]:
    """Six moments of inertia, none of them huge."""
    made = vector(6)(value)
    _require(max(map(abs, made)) < LARGEST, f"numbers below {LARGEST:g} are wanted")
    return made


AXES = ("x", "y", "z")
#: Nodes of a deck by point: a position, an orientation, and a warping node, which is not used.
NODES_A_POINT = 3


class Field(NamedTuple):
    """A field of a node or of a set of elements.

    Attributes:
        check: Gives the value as it is used, or raises ValueError in words.
        left_out: What it says that a model does not hold; empty where it is used.
        is_own: Whether only Flexact knows it.
    """

    check: Callable[[Any], Any]
    left_out: str = ""
    is_own: bool = False


PRESCRIBED = "values of prescribed motions"
_SIMULATION = "what is for a simulation"

#: Of each node.
NODE_FIELDS: dict[str, Field] = {
    **{name: Field(flag) for name in ("fix", "fix_pos", "fix_orien")},
    **{f"fix_{axis}": Field(flag) for axis in AXES},
    **{f"fix_r{axis}": Field(flag, is_own=True) for axis in AXES},
    "fix_warp": Field(flag),
    **{f"displ{start}_{axis}": Field(number) for start in ("", "_initial") for axis in AXES},
    **{f"rot{start}_{axis}": Field(number) for start in ("", "_initial") for axis in AXES},
    **{f"rot{start}": Field(vector(4)) for start in ("", "_initial")},
    "mass": Field(not_negative),
    "mominertia": Field(moments),
    **{
        f"{load}{start}": Field(vector(3))
        for load in ("force", "moment")
        for start in ("", "_initial")
    },
    "transfer_in": Field(texts, _SIMULATION),
    "transfer_out": Field(texts, _SIMULATION),
    "name": Field(text, is_own=True),
    "same_pos": Field(count, is_own=True),
    "same_orien": Field(count, is_own=True),
}
#: Of each set of elements.
ELEMENT_FIELDS: dict[str, Field] = {
    "elems": Field(numbers_from_one),
    "emod": Field(positive),
    "smod": Field(positive),
    "dens": Field(not_negative),
    "cshape": Field(shape),
    "dim": Field(sizes),
    "orien": Field(direction),
    "nbeams": Field(count),
    "flex": Field(deformations),
    "color": Field(colour),
    "opacity": Field(part),
    "hide": Field(flag),
    "warping": Field(flag),
    "cw": Field(flag),
    "type": Field(kind, is_own=True),
    "name": Field(text, is_own=True),
}
#: Of the releases, element by element.
RELEASE_FIELDS = {"def": Field(deformations)}
#: What SPACAR Light calls the loads of a deck: XF, on which a simulation starts, and DELXF.
LOADS = {"force": "_initial", "increment": ""}
#: Options; of these releases and gravity are used, and none of the others is looked at.
OPTIONS = (
    *("rls", "filename", "gravity", "silent", "calcbuck", "showinputonly", "loadsteps", "mode"),
    *("transfer", "calccompl", "customvis", "customdyn", "customkin", "spavisual", "rigidstress"),
    "stressperelement",
)


def is_unset(value: Any) -> bool:
    """Whether a field is there and empty, as MATLAB writes those of other entries."""
    return value is None or (isinstance(value, Sequence) and len(value) == 0)


LEFT_OUT, LOST, OWN_FIELD = "left-out", "lost", "own-field"


@dataclass
class Remarks:
    """Counts of what is left out, and of fields that only Flexact knows.

    Attributes:
        left_out: What the verdict does not depend on.
        lost: What it depends on.
        own: Fields of tables.
    """

    left_out: Counter[str] = field(default_factory=Counter)
    lost: Counter[str] = field(default_factory=Counter)
    own: Counter[str] = field(default_factory=Counter)

    def leave_out(self, what: str, times: int = 1) -> None:
        """Note something that the other format does not hold."""
        if times:
            self.left_out[what] += times

    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """A warning of each thing that is lost, a note of each that is left out."""
        words = "lost, though the verdict depends on it: "
        own = ", ".join(f"{name} ({times})" for name, times in self.own.items())
        said = [
            *((Severity.WARNING, LOST, f"{words}{what} ({n})") for what, n in self.lost.items()),
            *((Severity.NOTE, LEFT_OUT, f"{what} ({n})") for what, n in self.left_out.items()),
            (Severity.NOTE, OWN_FIELD, f"fields that SPACAR Light does not know: {own}"),
        ]
        return tuple(Diagnostic(*each) for each in said[: None if own else -1])


class TablesError(ProblemsError, ValueError):
    """Tables that are no model; each problem begins with its place, such as nprops[3].fix."""


class Text:
    """The text that tables were read from.

    Attributes:
        source: The text and its name, if there is one.
    """

    def __init__(
        self, source: Source | None = None, spans: Callable[[], Mapping[str, Place]] | None = None
    ) -> None:
        """Keep the text, and how it is found where each value stands when that is asked for."""
        self.source = source
        self._find_spans = spans

    @cached_property
    def _spans(self) -> Mapping[str, Place]:
        try:
            return {} if self._find_spans is None else self._find_spans()
        except RecursionError:
            # What stands in each other so deeply has no places.
            return {}

    def span_of(self, place: str) -> Place:
        """Where a value stands, or what holds it; zeros where that is not known."""
        while place and place not in self._spans:
            place = place[: max(place.rfind("."), place.rfind("["), 0)]
        return self._spans.get(place, Place(0, 0, 0))


class Found:
    """Problems as they are found."""

    def __init__(self, text: Text, name: str) -> None:
        """Nothing yet."""
        self._text = text
        self._name = name if text.source is None else text.source.name
        self._items: list[Diagnostic] = []
        self._said: set[str] = set()

    def error(self, place: str, message: str, hint: str = "") -> None:
        """Note, once, that something is wrong at a place, such as nprops[3].fix."""
        words = f"{place}: {message}" if place else message
        if words in self._said:
            return
        self._said.add(words)
        span = self._text.span_of(place)
        self._items.append(Diagnostic(Severity.ERROR, "bad-table", words, *span, help=hint))

    def checked(self, place: str, check: Callable[[Any], Any], value: Any) -> Any:
        """The value as it is used; None where the check says what is wrong with it."""
        try:
            return check(value)
        except ValueError as error:
            self.error(place, f"{error}, not {in_short(value)}")
            return None

    def require_none(self) -> None:
        """Raise if anything was found.

        Raises:
            TablesError: everything.
        """
        if self._items:
            raise TablesError(Problems.of(self._items), self._name, self._text.source)
