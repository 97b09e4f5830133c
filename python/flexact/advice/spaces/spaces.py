# SPDX-License-Identifier: BSD-3-Clause
"""The freedom space and the constraint space of a body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...base.frozen import Frozen
from ...model.parts.parts import Part
from ...result.carriers import Joint
from ...result.result import Result
from ..proposal import Proposal
from .families import Family
from .freedom import Freed
from .screw_space import ScrewSpace
from .subjects import Subject, rank_of, subject_named, subjects_of


@dataclass(frozen=True, eq=False)
class Spaces(Frozen):
    """What a body can do when nothing is declared, and what holds it.

    Attributes:
        subject: The body, or the joint with an orientation, and its nodes.
        freedom: All twists that it has.
        constraint: All wrenches that hold it: those reciprocal to its twists.
        proposals: Wires that stop what is unwanted and nothing that is wanted.
    """

    subject: Subject
    freedom: ScrewSpace
    constraint: ScrewSpace
    proposals: tuple[Proposal, ...] = ()

    @property
    def body(self) -> Part | Joint:
        """The body, or the joint with an orientation."""
        return self.subject.body

    @property
    def redundant(self) -> tuple[Family, ...]:
        """Lines along which one more wire holds nothing that is not held already."""
        return self.constraint.lines


def spaces_of(
    result: Result, body: str | None = None, wanted: Sequence[str] = ()
) -> Spaces | None:
    """The freedom space and the constraint space of a body.

    Args:
        result: The result.
        body: Its name, or that of a point with an orientation. Without one it is the body with
            most declared coordinates, then the one that moves in most independent ways, then the
            largest; joints with an orientation serve where no body is declared or there is none,
            that at which most parts meet first.
        wanted: What it is meant to do, such as "stage: translation z".

    Returns:
        None where nothing in the mechanism has an orientation and can move, and no body is named.

    Raises:
        ModelError: there is no such body, or what is wanted cannot be read.
    """
    freed = Freed(result)
    subject = _subject(freed, body)
    if subject is None:
        return None
    freedom = freed.space(subject)
    return Spaces(subject, freedom, freedom.reciprocal)


def _subject(freed: Freed, body: str | None) -> Subject | None:
    result = freed.result
    if body is not None:
        return subject_named(result, body)
    ranked = [
        (rank_of(result, each, freed.space(each).dimension), each) for each in subjects_of(result)
    ]
    return min(ranked, key=lambda pair: pair[0])[1] if ranked else None
