# SPDX-License-Identifier: BSD-3-Clause
"""A body of a mechanism that is there: what holds it already counts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..advice.spaces.screws import complement
from ..advice.spaces.subjects import Freed, subject_named
from ..advice.spaces.wanted_motion import Aim, not_wanted
from ..api import analyse
from ..core.arrays import FloatArray
from ..deck.rendering import model_error
from ..model.model import Model
from ..util.records import Frozen
from ..util.text import in_short
from .problem import Problem

#: Of what is wanted, how much may be stopped for rounding of a deck's numbers.
_STOPPED = 1.0e-9


class Joined(NamedTuple):
    """A point of a body that is there, by the numbers of its nodes."""

    position: int
    orientation: int

    def __repr__(self) -> str:
        """As a script has it."""
        return f"model.handle({self.position}, {self.orientation})"


@dataclass(frozen=True, eq=False)
class Held(Frozen):
    """What holds the stage of a problem before flexures are added.

    Attributes:
        model: The mechanism, in which nothing is declared that moves the stage otherwise than is
            wanted.
        rows: (c, 6) orthonormal wrenches (f, m) about the centre that hold the stage, in the frame
            of twists (w L, v).
        over_constrained: How many self-stresses there are.
        nodes: Numbers of a position node and of the orientation node of the stage.
        places: (n, 3) of the stage's points [m], with their nodes.
        numbers: (n,) these.
    """

    model: Model
    rows: FloatArray
    over_constrained: int
    nodes: tuple[int, int]
    places: FloatArray
    numbers: tuple[int, ...]

    @property
    def own(self) -> Joined:
        """A point of the stage."""
        return Joined(*self.nodes)

    def at(self, place: Sequence[float]) -> Joined | None:
        """The point of the stage at a place [m]; None where there is none."""
        near = np.flatnonzero(np.abs(self.places - np.array(place)).max(axis=1) <= 1.0e-12)
        return Joined(self.numbers[int(near[0])], self.nodes[1]) if near.size else None


def held_by(problem: Problem) -> Held | None:
    """What holds the stage of a problem; None where it is of no mechanism.

    Raises:
        ModelError: something that is wanted is stopped already.
    """
    if problem.base is None:
        return None
    result = analyse(problem.base)
    freed = Freed(result)
    subject = subject_named(result, problem.body)
    space = freed.space(subject)
    # About the centre, in (w L, v).
    rows = np.array(space.basis)
    rows[:, 3:] += np.cross(rows[:, :3], problem.centre - space.about)
    scaled = rows * problem.freedom.factors
    free = np.linalg.qr(scaled.T)[0].T if len(scaled) else scaled
    wanted = problem.freedom.scaled
    rest = wanted - (wanted @ free.T) @ free
    if rest.size and np.linalg.norm(rest, axis=1).max() > _STOPPED:
        raise model_error(
            "wanted-stopped",
            f"what holds {in_short(problem.body)} already stops something that is wanted",
            "flexact advise with --wanted says what, and what to release",
        )
    about = np.array([wanted_row / problem.freedom.factors for wanted_row in wanted]).reshape(-1, 6)
    about[:, 3:] += np.cross(about[:, :3], space.about - problem.centre)
    change = not_wanted(result, subject, Aim.of(space, list(about)))
    numbers = result.given.arrays.node_number
    return Held(
        change.apply(result.given),
        complement(np.roll(free, 3, axis=1)),
        result.over_constrained,
        (int(numbers[subject.positions[0]]), int(numbers[subject.orientations[0]])),
        result.given.arrays.node_value[:3, list(subject.positions)].T,
        tuple(int(numbers[node]) for node in subject.positions),
    )
