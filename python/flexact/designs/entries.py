# SPDX-License-Identifier: BSD-3-Clause
"""What a person writes for the entries of a problem: numbers, lengths, places, boxes, words.

What is wrong is kept, with its place where there is a text, until all has been looked at. A number
that is wrong is NaN in the meantime, which no comparison holds of, so that nothing is said twice.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ..advice.spaces.wanted_motion import numbers
from ..core.arrays import FloatArray
from ..deck.diagnostics import Diagnostic, Problems, Severity
from ..deck.rendering import DeckError, ModelError, ProblemsError
from ..model.names import nearest
from ..util.quantities import QuantityError
from ..util.text import in_short
from ..util.units import METRES
from .problem import Box, Region
from .texts import MOST_DEPTH, FileText, Path

#: Errors that are told; others are counted.
_MOST_ERRORS = 100
#: Lengths [m], masses [kg] and moments of inertia [kg m2] beyond which nobody designs: a slip of a
#: unit, or of a finger.
LEAST_LENGTH, _MOST_LENGTH, _MOST_MASS = 1.0e-12, 1.0e6, 1.0e12
#: Boxes, and points, of one region.
_MOST_PLACES = 2000
#: Keys of a region that is one box.
CORNERS = ("low", "high")


class Entries:
    """The entries of one problem, as far as they were read.

    Attributes:
        text: The file; None of a problem from Python.
        units: Of numbers that say none.
        total: How many errors there were.
        remarks: Sentences about what was taken, and not said.
    """

    def __init__(self, text: FileText | None = None, name: str = "") -> None:
        """Begin to read."""
        self.text = text
        self.units = METRES
        self.total = 0
        self.remarks: list[str] = []
        self._name = text.source.name if text else name
        self._found: list[Diagnostic] = []

    # What is wrong

    def wrong(
        self,
        path: Path,
        message: str,
        hint: str = "",
        *,
        code: str = "bad-problem",
        of_key: bool = False,
        other: Path | None = None,
    ) -> None:
        """Keep an error.

        Args:
            path: The keys of its entry.
            message: What is wrong.
            hint: How to mend it.
            code: Its kind.
            of_key: Whether the key itself is wrong, not its value.
            other: The keys of a second entry that has to do with it.
        """
        self.total += 1
        if self.total > _MOST_ERRORS:
            return
        place = self.text.place(path, of_key=of_key) if self.text else None
        second = self.text.place(other) if self.text and place and other is not None else None
        self._found.append(
            Diagnostic(
                *(Severity.ERROR, code, message, *(place or (0, 0, 0))),
                help=hint,
                other=second if second != place else None,
            )
        )

    def told(self, path: Path, error: ProblemsError, what: str = "") -> None:
        """Keep what another error says."""
        for each in error.diagnostics:
            message = f"{what}: {each.message}" if what else each.message
            self.wrong(path, message, each.help, code=each.code)

    def no_such(
        self,
        path: Path,
        message: str,
        word: object,
        known: Iterable[str],
        *,
        code: str = "bad-problem",
        of_key: bool = False,
    ) -> None:
        """Keep that a word is none of some, with the nearest of them."""
        known = tuple(known)
        near = nearest(word, known) if isinstance(word, str) else []
        hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
        self.wrong(path, message, hint, code=code, of_key=of_key)

    def known_keys(
        self, path: Path, given: dict[str, Any], what: str, known: Iterable[str]
    ) -> None:
        """Keep which keys of a table are none."""
        known = tuple(known)
        for key in [each for each in given if each not in known]:
            message = f"{what} has no key {in_short(key)}"
            self.no_such((*path, key), message, key, known, code="unknown-key", of_key=True)

    def finish(self) -> None:
        """Raise if anything was wrong, in the order of the text.

        Raises:
            DeckError: of a file.
            ModelError: of anything else.
        """
        if not self.total:
            return
        found = sorted(self._found, key=lambda each: (each.line, each.column))
        problems = Problems(tuple(found), self.total)
        if self.text is not None:
            raise DeckError(problems, self._name, self.text.source)
        raise ModelError(problems, self._name)

    def plain(self, given: object, depth: int = 0) -> Any:
        """What is given with lists for arrays and tuples, and dictionaries for other mappings.

        Raises:
            ModelError: it lies too deep within itself.
        """
        if depth > MOST_DEPTH:
            self.wrong((), "lists or tables lie too deep within each other")
            self.finish()
        if isinstance(given, (np.ndarray, np.generic)):
            return given.tolist()
        if isinstance(given, Mapping):
            return {
                key if isinstance(key, str) else in_short(key): self.plain(each, depth + 1)
                for key, each in given.items()
            }
        if isinstance(given, (list, tuple)):
            return [self.plain(each, depth + 1) for each in given]
        return given

    # Values

    def number(
        self, path: Path, given: object, what: str, unit: str = "", least: float = -math.inf
    ) -> float:
        """A finite number in SI, or a text with its unit; NaN where it is none.

        Args:
            path: Its keys.
            given: It.
            what: What messages call it.
            unit: Its unit in SI; "" of one without.
            least: Below which it is wrong; 0, or nothing.
        """
        try:
            if isinstance(given, bool) or (isinstance(given, str) and not unit):
                raise TypeError
            value = self.units.read(given, unit) if unit else float(given)  # type: ignore[arg-type]
        except QuantityError as error:
            self.wrong(path, f"{what}: {error}")
            return math.nan
        except (TypeError, ValueError, ArithmeticError):
            said = f" [{self.units.symbol(unit)}]" if unit else ""
            quoted = ', or one with its unit in quotes, such as "20 mm"' if unit == "m" else ""
            message = f"{what} is a number{said}, not {in_short(given)}"
            self.wrong(path, message, f"write a number{quoted}")
            return math.nan
        if not math.isfinite(value):
            self.wrong(path, f"{what} is not finite: {in_short(given)}")
        elif value < least:
            self.wrong(path, f"{what} is negative: {in_short(given)}")
        elif unit not in ("", "m") and abs(value) > _MOST_MASS:
            self.wrong(path, f"{what} is too large: {in_short(given)}", "are its units right?")
        else:
            return value
        return math.nan

    def length(self, path: Path, given: object, what: str, *, zero: bool = False) -> float:
        """A positive length, or one that may be zero [m]; NaN where it is none."""
        value = self.number(path, given, what, "m")
        if value < 0.0 or (value == 0.0 and not zero):
            is_what = "is negative" if value < 0.0 else "is zero"
            self.wrong(path, f"{what} {is_what}: {in_short(given)}", "write a length above zero")
            return math.nan
        if value > _MOST_LENGTH or 0.0 < value < LEAST_LENGTH:
            size = "large" if value > 1.0 else "small"
            hint = 'numbers are in metres; write "20 mm", or units = "mm", where they are not'
            self.wrong(path, f"{what} is too {size}: {value:.4g} m", hint)
            return math.nan
        return value

    def span(self, path: Path, given: object, what: str) -> tuple[float, float]:
        """Two lengths, the least first; one stands for both. NaN where they are none."""
        if not isinstance(given, list):
            value = self.length(path, given, what)
            return value, value
        if len(given) != 2:
            hint = "write the least and the largest, or one number where they are the same"
            self.wrong(path, f"{what} has {len(given)} numbers, not one or two", hint)
            return math.nan, math.nan
        low = self.length((*path, 0), given[0], f"the least {what}")
        high = self.length((*path, 1), given[1], f"the largest {what}")
        if low > high:
            shown = f"{self.units.said(low, 'm')} and {self.units.said(high, 'm')}"
            message = f"the least {what} is larger than the largest: {shown}"
            self.wrong(path, message, "write the least first")
            return math.nan, math.nan
        return low, high

    def whole(self, path: Path, given: object, what: str, least: int, most: int) -> int:
        """A whole number within limits; the least where it is none."""
        if not isinstance(given, (int, float)) or isinstance(given, bool) or given % 1 != 0:
            self.wrong(path, f"{what} is a whole number, not {in_short(given)}")
        elif not least <= given <= most:
            self.wrong(path, f"{what} can be {least} to {most}, not {in_short(given)}")
        else:
            return int(given)
        return least

    def word(self, path: Path, given: object, what: str) -> str:
        """A text in one row; empty where it is none."""
        if isinstance(given, str):
            return " ".join(given.split())
        self.wrong(path, f"{what} is a text, not {in_short(given)}", "put it in quotes")
        return ""

    def three(self, path: Path, given: object, what: str, unit: str = "m") -> FloatArray | None:
        """(3,) numbers, also as a text "(0, 0, 20 mm)"; None where they are not."""
        if isinstance(given, str) and unit and given.strip().startswith("("):
            try:
                return numbers(given, given.strip(), (3,), self.units)
            except ModelError as error:
                self.told(path, error, what)
                return None
        if not isinstance(given, list) or len(given) != 3:
            has = f"{len(given)} numbers" if isinstance(given, list) else in_short(given)
            self.wrong(path, f"{what} has three numbers, such as [0, 0, 0.02], not {has}")
            return None
        made = np.array(
            [
                self.number((*path, k), each, f"{axis} of {what}", unit)
                for k, (each, axis) in enumerate(zip(given, "xyz", strict=True))
            ]
        )
        if unit and np.abs(made).max() > _MOST_LENGTH:
            self.wrong(path, f"{what} is more than 1000 km away", "are its units right?")
            return None
        return None if np.isnan(made).any() else made

    # Places

    def box(self, path: Path, given: object, what: str) -> Box | None:
        """A box of two corners, or of three ranges in a text; None where it is none."""
        if isinstance(given, Box):
            return given
        pairs: list[tuple[Path, object]] = []
        if isinstance(given, str):
            ranges = [[end.strip() for end in each.split("..")] for each in given.split(",")]
            if len(ranges) == 3 and all(len(each) <= 2 and all(each) for each in ranges):
                pairs = [(path, [_plain(each[k]) for each in ranges]) for k in (0, -1)]
        elif isinstance(given, dict) and set(given) == set(CORNERS):
            pairs = [((*path, key), given[key]) for key in CORNERS]
        elif isinstance(given, list) and len(given) == 2:
            pairs = [((*path, k), each) for k, each in enumerate(given)]
        if not pairs:
            hint = "write [[x, y, z], [x, y, z]], its lowest and its highest corner, or "
            hint += '"0.06..0.08, -0.08..0.08, -0.08..0.08"'
            self.wrong(path, f"{what} is none: {in_short(given)}", hint, code="bad-region")
            return None
        low, high = (
            self.three(each, value, f"the {corner} corner of {what}")
            for (each, value), corner in zip(pairs, CORNERS, strict=True)
        )
        if low is None or high is None:
            return None
        for axis, least, most in zip("xyz", low, high, strict=True):
            if least > most:
                ends = " to ".join(self.units.said(each, "m", 6) for each in (least, most))
                message = f"{what} has {axis} from {ends}: the first is larger"
                hint = "write the lowest corner first, in x, y and z"
                self.wrong(path, message, hint, code="bad-region")
                return None
        return Box(low + 0.0, high + 0.0)

    def region(self, path: Path, given: object, what: str) -> Region | None:
        """Boxes and points; None where something about them is wrong.

        Args:
            path: Its keys.
            given: A table with boxes and points, or one box, or several.
            what: What it is the region of.
        """
        if isinstance(given, Region):
            return given
        is_table, count = isinstance(given, dict), self.total
        inside = dict(given) if isinstance(given, dict) else {"boxes": given}
        inside = {key: value for key, value in inside.items() if value is not None}
        keys = {each: (*path, each) if is_table else path for each in ("boxes", "points")}
        boxes, points = inside.get("boxes", []), inside.get("points", [])
        if corners := {each: inside[each] for each in CORNERS if each in inside}:
            boxes, keys["boxes"] = corners, path
        elif isinstance(boxes, str):
            boxes = [each.strip() for each in boxes.split(";") if each.strip()]
        is_one = isinstance(boxes, (Box, dict)) or (
            isinstance(boxes, list) and len(boxes) == 2 and all(map(_is_point, boxes))
        )
        made: dict[str, list[Any]] = {"boxes": [], "points": []}
        for key, listed, read, one in (
            ("boxes", [boxes] if is_one else boxes, self.box, "box"),
            ("points", [points] if _is_point(points) else points, self.three, "point"),
        ):
            if not isinstance(listed, list):
                self.wrong(keys[key], f"{key} of {what} are a list, not {in_short(listed)}")
            elif len(listed) > _MOST_PLACES:
                self.wrong(keys[key], f"{what} has {len(listed)} {key}: at most {_MOST_PLACES}")
            else:
                for k, each in enumerate(listed):
                    # One that stands alone has the place of the key.
                    at = (*keys[key], k) if listed is inside.get(key) else keys[key]
                    made[key].append(read(at, each, f"{one} {k + 1} of {what}"))
        if self.total > count:
            return None
        return Region(tuple(made["boxes"]), np.array(made["points"]).reshape(-1, 3))


def _plain(word: str) -> object:
    """A number where a text says no unit."""
    try:
        return float(word)
    except ValueError:
        return word


def _is_point(given: object) -> bool:
    return (
        isinstance(given, list)
        and len(given) == 3
        and not any(isinstance(each, (list, dict, Box)) for each in given)
    )
