# SPDX-License-Identifier: BSD-3-Clause
"""Values as users give them: numbers, vectors, directions, angles, texts; and whose they were."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from operator import index as whole_number

from ..deck.diagnostics import Problems
from ..deck.rendering import ModelError, model_error
from ..util.quantities import Quantity, QuantityError, measured
from ..util.text import in_short
from .draft import NO_VECTOR, Vector

#: What gives three parts and still is no vector.
UNORDERED = (str, bytes, bytearray, set, frozenset, dict)
#: A direction by the name of a global axis, or as a vector.
Direction = str | Sequence[float]
_AXES: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def vector(given: Sequence[Quantity], what: str, unit: str = "") -> Vector:
    """Three finite numbers; with a unit also texts that say theirs, such as "3 mm".

    Raises:
        ModelError: they are not.
    """
    try:
        if isinstance(given, UNORDERED):
            raise TypeError
        x, y, z = (real(part, unit) for part in given)
    except QuantityError as error:
        raise model_error("bad-number", f"the {what}: {error}") from None
    except (TypeError, ValueError, OverflowError):
        raise model_error("bad-number", f"the {what} must be three numbers") from None
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
        raise model_error("bad-number", f"the {what} has a component that is not finite")
    return x, y, z


def real(part: object, unit: str = "") -> float:
    """A number, but no text that reads as one; with a unit also a text that says its own.

    Raises:
        QuantityError: the text says no unit, or another kind of one.
        TypeError, ValueError, OverflowError: it is no number.
    """
    if isinstance(part, str) and unit:
        return measured(part, unit)
    if isinstance(part, (str, bytes, bytearray, complex)):
        raise TypeError
    return float(part)  # type: ignore[arg-type]


def several(given: object, what: str) -> tuple[object, ...]:
    """The items of a list, tuple or array.

    Raises:
        ModelError: it has none, or is a single text.
    """
    try:
        if isinstance(given, (str, bytes, bytearray)):
            raise TypeError
        return tuple(given)  # type: ignore[arg-type]
    except TypeError:
        raise model_error("bad-number", f"{what} are wanted, not {in_short(given)}") from None


def count(given: object, least: int, most: int, what: str) -> int:
    """A whole number from `least` to `most`.

    Raises:
        ModelError: it is none.
    """
    made = whole(given, f"the number of {what} must be a whole number")
    if not least <= made <= most:
        raise model_error(
            "out-of-range", f"{in_short(made)} {what}: there can be {least} to {most}"
        )
    return made


def angle(given: object) -> float:
    """An angle in degrees; a text says its unit, such as "0.5 rad".

    Raises:
        ModelError: it is no finite number.
    """
    try:
        made = real(given, "deg")
    except QuantityError as error:
        raise model_error("bad-number", str(error)) from None
    except (TypeError, ValueError, OverflowError):
        made = math.nan
    if not math.isfinite(made):
        raise model_error("bad-number", f"an angle is a number of degrees, not {in_short(given)}")
    return made


def text(given: object, what: str) -> str:
    """A text, such as a name, as a plain str: a member of an Enum is known to its script alone."""
    if not isinstance(given, str):
        raise model_error("bad-name", f"{what} must be text, not {type(given).__name__}")
    return str.__str__(given)


def direction(given: Direction, what: str) -> Vector:
    """Three finite numbers that are not all zero, or the axis "x", "y" or "z"."""
    if isinstance(given, str):
        found = _AXES.get(given.strip().lower())
        if found is None:
            raise model_error(
                "bad-number",
                f"the {what} must be three numbers, or x, y or z, not {in_short(given)}",
            )
        return found
    made = vector(given, what)
    if made == NO_VECTOR:
        raise model_error("zero-vector", f"the {what} is zero", "give a vector that is not zero")
    return made


def whole(given: object, what: str) -> int:
    """A whole number; `what` says of what.

    Raises:
        ModelError: it is none.
    """
    try:
        return whole_number(given)  # type: ignore[arg-type]
    except TypeError:
        raise model_error("bad-number", f"{what}, not {in_short(given)}") from None


def unit(given: Vector) -> Vector:
    """The vector of length one along this one; zero of zero."""
    largest = max(map(abs, given))
    if largest == 0.0:
        return NO_VECTOR
    x, y, z = (part / largest for part in given)
    norm = math.hypot(x, y, z)
    return x / norm, y / norm, z / norm


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def numbers_of_size(
    given: object, sizes: tuple[int, ...], what: str, unit: str = ""
) -> tuple[float, ...]:
    """Finite numbers, as many as one of `sizes` says; a single one may stand alone.

    With a unit also texts that say theirs, such as "3 mm".

    Raises:
        ModelError: they are not.
    """
    single = not isinstance(given, Iterable) or getattr(given, "ndim", 1) == 0
    single = single or (isinstance(given, str) and bool(unit))
    parts = (given,) if single else several(given, what)
    wanted = len(parts) if len(parts) in sizes else sizes[0]
    given = parts if single or not isinstance(given, UNORDERED) else given
    return numbers(given, wanted, what, unit)


def numbers(given: object, wanted: int, what: str, unit: str = "") -> tuple[float, ...]:
    """So many finite numbers; with a unit also texts that say theirs.

    Raises:
        ModelError: they are not.
    """
    try:
        if isinstance(given, UNORDERED) or not isinstance(given, Iterable):
            raise TypeError
        parts = tuple(real(part, unit) for part in given if not isinstance(part, bool))
        if len(parts) != wanted:
            raise ValueError
    except QuantityError as error:
        raise model_error("bad-number", f"{what}: {error}") from None
    except (TypeError, ValueError, OverflowError):
        raise model_error("bad-number", f"{what}, not {in_short(given)}") from None
    if not all(map(math.isfinite, parts)):
        raise model_error("bad-number", f"{what}, and one of them is not finite")
    return parts


@contextmanager
def call(method: str, name: object = "") -> Iterator[None]:
    """Begin the message of an error with the call and the part that it was about."""
    try:
        yield
    except ModelError as error:
        name = name if isinstance(name, str) else getattr(name, "name", "")
        if not isinstance(name, str) or not name or len(error.diagnostics) != 1:
            raise
        (problem,) = error.diagnostics
        if problem.message.startswith(f"{method} "):
            raise
        message = f"{method} {in_short(name)}: {problem.message}"
        raise ModelError(Problems.of([replace(problem, message=message)])) from None
