# SPDX-License-Identifier: BSD-3-Clause
"""Calls of Python that do what an advice says, for models that were made in Python."""

from __future__ import annotations

from typing import NamedTuple

from ..advice.ways import Coordinate, Part, Way
from ..core.elements import Role
from ..model.parts.parts import Part as NamedPart
from ..result.outcome import Outcome
from .deformation import bending_of, part_of, role_of

#: What a method of a model is, by the statement of a deck that does the same.
_METHODS = {"DYNX": "independent", "FIX": "fix", "RLSE": "release", "DYNE": "independent"}
#: The word for holding what is released, which a deck does without a statement.
HOLD = "hold"

#: A name, a number, or a place [m].
Argument = str | int | tuple[float, ...]


class Call(NamedTuple):
    """A call of a method of a model."""

    method: str
    arguments: tuple[Argument, ...]
    at: Argument | None = None
    """The end of a part, where one is said."""

    def in_words(self, model: str = "model", *, exact: bool = False) -> str:
        """As it is typed.

        Args:
            model: The name of the model.
            exact: Whether numbers have all digits where the first twelve are not enough.
        """
        words = [_typed(each, exact) for each in self.arguments]
        if self.at is not None:
            words.append(f"at={_typed(self.at, exact)}")
        return f"{model}.{self.method}({', '.join(words)})"


def call_in_words(result: Outcome, advice: Way, part: Part) -> str:
    """Such as `model.release("sheet 1", "in-plane bending", at="clamp 1")`.

    Empty where no word says it without local axes.
    """
    return call_of(result, advice.keywords[0], part)


def call_of(result: Outcome, keyword: str, part: Part) -> str:
    """The call that does with a part what a statement of a deck does, or `HOLD`."""
    method = _METHODS.get(keyword, keyword)
    if isinstance(part, Coordinate):
        return coordinate_call(result, method, part.node, part.name).in_words()
    call = deformation_call(result, method, part.element, part.number)
    return "" if call is None else call.in_words()


def coordinate_call(result: Outcome, method: str, node: int, name: str) -> Call:
    """The call of a method with a coordinate of a node, by its number."""
    position = result.parts.place_of(result.given.node_index[node])
    return Call(method, (node if position is None else _point(result, position), name))


def deformation_call(result: Outcome, method: str, element: int, number: int) -> Call | None:
    """The call of a method with a deformation; None where no word says it without local axes.

    Args:
        result: The result.
        method: Such as "release".
        element: Number of the element.
        number: Number of the deformation, from 1.
    """
    index = result.data.element_index[element]
    part = named_part(part_of(result, index), element)
    bending = bending_of(result, index, number)
    words = {Role.ELONGATION: "elongation", Role.TORSION: "twist"}
    role = role_of(result, index, number)
    if bending is None:
        return Call(method, (part, words[Role(role)] if role in words else number))
    if bending.word is None:
        return None
    return Call(method, (part, bending.word), _point(result, bending.position))


def named_part(part: NamedPart, number: int) -> str | int:
    """A part by its name, or by the number of its element."""
    return part.name if part.is_named else number


def _point(result: Outcome, position: int) -> Argument:
    name = result.parts.name_of_point(position)
    if name:
        return name
    count = 2 if result.given.planar else 3
    return tuple(result.given.arrays.node_value[:count, position].tolist())


def _typed(given: Argument, exact: bool) -> str:
    if isinstance(given, str):
        return '"' + given.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(given, int):
        return str(given)
    return f"({', '.join(_number(value, exact) for value in given)})"


def _number(value: float, exact: bool) -> str:
    short = f"{value + 0.0:.12g}"
    return repr(value) if exact and float(short) != value else short
