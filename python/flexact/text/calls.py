# SPDX-License-Identifier: BSD-3-Clause
"""Calls of Python that do what an advice says, for models that were made in Python."""

from __future__ import annotations

from ..advice.ways import Coordinate, Part, Way
from ..core.elements import Role
from ..model.parts.parts import Part as NamedPart
from ..result.outcome import Outcome
from .deformation import bending_of, part_of, role_of

#: What a method of a model is, by the statement of a deck that does the same.
_METHODS = {"DYNX": "independent", "FIX": "fix", "RLSE": "release", "DYNE": "independent"}
#: The word for holding what is released, which a deck does without a statement.
HOLD = "hold"


def call_in_words(result: Outcome, advice: Way, part: Part) -> str:
    """Such as `model.release("sheet 1", "in-plane bending", at="clamp 1")`.

    Empty where no word says it without local axes.
    """
    return call_of(result, advice.keywords[0], part)


def call_of(result: Outcome, keyword: str, part: Part) -> str:
    """The call that does with a part what a statement of a deck does, or `HOLD`."""
    method = _METHODS.get(keyword, keyword)
    if isinstance(part, Coordinate):
        position = result.parts.place_of(result.given.node_index[part.node])
        where = str(part.node) if position is None else _point(result, position)
        return f'model.{method}({where}, "{part.name}")'
    deformation = _deformation(result, part.element, part.number)
    return f"model.{method}({deformation})" if deformation else ""


def _deformation(result: Outcome, number: int, deformation: int) -> str:
    index = result.data.element_index[number]
    part = part_of(result, index)
    bending = bending_of(result, index, deformation)
    words = {Role.ELONGATION: "elongation", Role.TORSION: "twist"}
    role = role_of(result, index, deformation)
    if bending is None:
        what = f'"{words[Role(role)]}"' if role in words else str(deformation)
        return f"{_part(part, number)}, {what}"
    if bending.word is None:
        return ""
    return f'{_part(part, number)}, "{bending.word}", at={_point(result, bending.position)}'


def _part(part: NamedPart, number: int) -> str:
    return f'"{part.name}"' if part.is_named else str(number)


def _point(result: Outcome, position: int) -> str:
    name = result.parts.name_of_point(position)
    if name:
        return f'"{name}"'
    count = 2 if result.given.planar else 3
    place = result.given.arrays.node_value[:count, position].tolist()
    return f"({', '.join(f'{value + 0.0:.12g}' for value in place)})"
