# SPDX-License-Identifier: BSD-3-Clause
"""Checks of what a builder is given about drawing: elements, cross-sections, colours."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from ..core.elements import kind_of
from ..deck.errors import model_error
from ..util.plain_text import in_short
from ..util.quantities import Quantity, QuantityError
from .appearance_draft import Colour, Said, Shape
from .arguments import UNORDERED, real, several
from .attributes import CrossSection
from .draft import Draft
from .handles import Assembly, FoldedSheet, Node, Sheet
from .part_arguments import indices_of as indices_of_part
from .part_arguments import part
from .selection import require_own

#: A diameter, or two sizes [m].
Section = Quantity | Sequence[Quantity]


def indices_of(draft: Draft, target: object) -> tuple[int, ...]:
    """Indices of the elements of a part, of all parts of an assembly, or of the hinge at a point.

    Raises:
        ModelError: there is no such part, or no hinge whose far side this point is.
    """
    if isinstance(target, FoldedSheet):
        return tuple(i for leaf in target.leaves for i in indices_of(draft, leaf))
    if isinstance(target, Assembly):
        return tuple(i for each in target.parts.values() for i in indices_of(draft, each))
    if isinstance(target, Node):
        require_own(draft, target)
        return (_hinge_at(draft, target),)
    return tuple(indices_of_part(draft, part(draft, target)))


def _hinge_at(draft: Draft, point: Node) -> int:
    """Index of the last hinge that ends at this point; most are asked for when just made."""
    hinge = kind_of("PLHINGE" if draft.planar else "HINGE").number
    for index in range(len(draft.kinds) - 1, -1, -1):
        if draft.slots[index][3] == point.orientation and draft.kinds[index] == hinge:
            return index
    raise model_error(
        "not-an-element",
        "no hinge ends at this point",
        "give an element, a sheet, an element's number, or the point beyond a hinge",
    )


def said(
    target: object,
    section: Section | None,
    colour: Sequence[float] | None,
    edge_colour: Sequence[float] | None,
    opacity: float | None,
    drawn: bool | None,
) -> Said:
    """What is said about drawing a target, checked."""
    checked = {
        "shape": sheet_shape(section) if is_sheet(target) else shape_of(section),
        "colour": None if colour is None else _colour(colour, "colour"),
        "edge_colour": None if edge_colour is None else _colour(edge_colour, "colour of the edges"),
        "opacity": None if opacity is None else _opacity(opacity),
        "drawn": None if drawn is None else _flag(drawn),
    }
    return {name: value for name, value in checked.items() if value is not None}


def is_sheet(target: object) -> bool:
    """Whether the section of this part is its breadth and its thickness."""
    return isinstance(target, (Sheet, FoldedSheet))


def _flag(drawn: object) -> bool:
    if not isinstance(drawn, (bool, np.bool_)):
        raise model_error("not-a-flag", "whether an element is drawn is True or False")
    return bool(drawn)


def shape_of(section: Section | None) -> Shape | None:
    """A cross-section from a diameter, or from the sizes along local y and z [m], or none.

    Raises:
        ModelError: it is neither, or a size is not positive and finite.
    """
    if section is None:
        return None
    what = "a section is a diameter, or two sizes along the local y and z axes"
    if isinstance(section, Iterable) and not isinstance(section, str):
        sizes = _numbers(section, 2, what, "m")
    else:
        sizes = _numbers([section], 1, what, "m")
    if not all(size > 0.0 for size in sizes):
        raise model_error(
            "bad-size", "a size of a cross-section is not positive", "give sizes in metres"
        )
    kind = CrossSection.CIRC if len(sizes) == 1 else CrossSection.RECT
    return Shape(kind, sizes[0], sizes[-1])


def sheet_shape(section: Section | None) -> Shape | None:
    """A cross-section from the width and the thickness of a sheet, whose width is local z."""
    if section is None:
        return None
    what = "the section of a sheet is its width and its thickness"
    width, thickness = _numbers(section, 2, what, "m")
    return shape_of((thickness, width))


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
    return _numbers(given, wanted, what, unit)


def size_of(given: object, what: str) -> float:
    """A size [m]; `shape_of` asks that it be positive.

    Raises:
        ModelError: it is no finite number.
    """
    return _numbers([given], 1, f"the {what} is a number", "m")[0]


def _colour(given: Sequence[float], what: str) -> Colour:
    """Red, green and blue from 0 to 1.

    Raises:
        ModelError: they are not.
    """
    red, green, blue = _numbers(given, 3, f"the {what} is red, green and blue")
    if not all(0.0 <= part <= 1.0 for part in (red, green, blue)):
        raise model_error(
            "bad-colour", f"a part of the {what} is out of range", "give parts from 0 to 1"
        )
    return red, green, blue


def _opacity(given: float) -> float:
    """An opacity from 0 to 1.

    Raises:
        ModelError: it is none.
    """
    (opacity,) = _numbers([given], 1, "an opacity is a number")
    if not 0.0 <= opacity <= 1.0:
        raise model_error(
            "bad-opacity", "an opacity is out of range", "give 0 for invisible, 1 for opaque"
        )
    return opacity


def _numbers(given: object, wanted: int, what: str, unit: str = "") -> tuple[float, ...]:
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
