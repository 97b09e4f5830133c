# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces, and what flexures hold, as pictures and pages show them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce
from operator import add

import numpy as np

from ..advice.holding import hold_in_words, holds_in_words, holds_of, number_of
from ..advice.spaces.spaces import Spaces
from ..advice.spaces.words import body_words, dashed_in_words, spaces_lines
from ..analysis.naming import plain
from ..analysis.result import Result
from ..core.arrays import FloatArray
from .drawing import SpaceShape, shape_of_space
from .drawing.spaces import shape_of_hold

_NO_WIRES = np.zeros((0, 2, 3))


@dataclass(frozen=True)
class SpaceShown:
    """A space, or what flexures hold.

    Attributes:
        title: What it is called.
        shape: What is drawn of it.
        words: What it is.
        wires: (w, 2, 3) ends of wires that may be added [m].
        labels: Places (3,) [m], each with what stands there.
    """

    title: str
    shape: SpaceShape
    words: str
    wires: FloatArray
    labels: tuple[tuple[FloatArray, str], ...] = ()


def spaces_shown(result: Result, spaces: Spaces, size: float, planar: bool) -> Iterator[SpaceShown]:
    """The freedom space and the constraint space of a body, in a drawing of a size [m]."""
    lines = spaces_lines(result, spaces)
    for which, space, line in zip(
        ("Freedom", "Constraint"), (spaces.freedom, spaces.constraint), lines, strict=False
    ):
        is_freedom = not space.of_wrenches
        shape = shape_of_space(
            space.families, space.about, size, is_freedom=is_freedom, planar=planar
        )
        wires = _NO_WIRES if is_freedom else spaces.new_wires
        words = plain(line.head) + "; ".join(map(plain, line.items))
        title = f"{which} space of {body_words(result, spaces)}"
        yield SpaceShown(title, shape, words + dashed_in_words(len(wires)), wires)


def holds_shown(result: Result, size: float, planar: bool, most: int = 0) -> list[SpaceShown]:
    """What all flexures of an exactly constrained mechanism hold, with how well at each.

    Behind that what each of them holds, of several and up to so many; nothing where that is not
    known.
    """
    holds = holds_of(result)
    if not holds:
        return []
    shapes = [shape_of_hold(each, size, planar=planar) for each in holds]
    labels = tuple((each.space.about, number_of(each)) for each in holds)
    title, words = "What each flexure holds", holds_in_words(holds)
    made = [SpaceShown(title, reduce(add, shapes), words, _NO_WIRES, labels)]
    if 1 < len(holds) <= most:
        for hold, shape, label in zip(holds, shapes, labels, strict=True):
            title, words = f"{hold.name}: {label[1]}", hold_in_words(result, hold)
            made.append(SpaceShown(title, shape, words, _NO_WIRES, (label,)))
    return made
