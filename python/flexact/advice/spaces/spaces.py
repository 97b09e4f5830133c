# SPDX-License-Identifier: BSD-3-Clause
"""The freedom space and the constraint space of a body, and what to add to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...analysis.carriers import Joint
from ...analysis.change import Change
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...deck.rendering import model_error
from ...model.parts.parts import Part
from ...util.records import Frozen
from ...util.text import in_short
from ..proposal import Proposal
from .flexures import sheets_for, wires_for
from .screws import Family, ScrewSpace
from .subjects import Freed, Site, Subject, rank_of, subject_named, subjects_of
from .wanted_motion import Aim, Wanted, declared_of, not_wanted, read, wanted_of


@dataclass(frozen=True, eq=False)
class Spaces(Frozen):
    """What a body can do when nothing is declared, what holds it, and what may be added.

    Attributes:
        subject: The body, or the joint with an orientation, and its nodes.
        freedom: All twists that it has.
        constraint: All wrenches that hold it: those reciprocal to its twists.
        wanted: What it is meant to do: as was said, else its declared degrees of freedom.
        unwanted: In how many further ways it moves.
        stoppable: How many of these wires can stop without stopping anything that is wanted.
        proposals: Wires that do so, each analysed: first single ones, then, where more are
            needed, a set of them that stops all that can be stopped, and sheets that stop three.
        tried: Whether wires and sheets were tried: if asked for, and of mechanisms that are not
            large.
    """

    subject: Subject
    freedom: ScrewSpace
    constraint: ScrewSpace
    wanted: tuple[Wanted, ...] = ()
    unwanted: int = 0
    stoppable: int = 0
    proposals: tuple[Proposal, ...] = ()
    tried: bool = True

    @property
    def body(self) -> Part | Joint:
        """The body, or the joint with an orientation."""
        return self.subject.body

    @property
    def new_wires(self) -> FloatArray:
        """(w, 2, 3) ends of the wires of the first proposal, on the body and on the ground [m]."""
        wires = [wire for proposal in self.proposals[:1] for wire in proposal.change.wires]
        return np.array([(wire.end, wire.ground) for wire in wires]).reshape(-1, 2, 3)

    @property
    def redundant(self) -> tuple[Family, ...]:
        """Lines along which one more wire holds nothing that is not held already."""
        return self.constraint.lines


def spaces_of(
    result: Result, body: str | None = None, wanted: Sequence[str] = (), *, wires: bool = True
) -> Spaces | None:
    """The freedom space and the constraint space of a body.

    Args:
        result: The result.
        body: Its name, or that of a point with an orientation. Without one it is that of the
            first wanted motion; then the body with most declared coordinates, then the one that
            moves in most independent ways, then the largest; joints with an orientation serve
            where no body is declared or there is none, that at which most parts meet first.
        wanted: What it is meant to do, such as "stage: translation z"
            (`flexact.advice.spaces.wanted_motion`).
        wires: Whether wires and sheets are tried; each takes an analysis.

    Returns:
        None where no body is named and nothing in the mechanism has an orientation and can move,
        or it is so large that its motions are not all kept.

    Raises:
        ModelError: there is no such body, what is wanted cannot be read, or there are too many
            motions to be kept.
        TypeError: the body is no text, or what is wanted is none.
    """
    _require_texts(body, wanted)
    written = [read(each, planar=result.given.planar) for each in wanted]
    names = [each.body for each in written if each.body is not None]
    freed = Freed(result)
    subject = _subject(freed, body if body is not None else next(iter(names), None))
    if subject is None:
        return None
    for name in names:
        if subject_named(result, name) != subject:
            raise model_error(
                "two-bodies",
                f"wanted motions are those of one body, {in_short(subject.name)}, not of "
                f"{in_short(name)}",
                "ask for one body at a time",
            )
    freedom = freed.space(subject)
    is_tried = wires and result.is_told_by_parts
    meant = tuple(wanted_of(result, freedom, each) for each in written)
    meant = meant or declared_of(result, subject, freedom)
    aim = Aim.of(freedom, [each.twist for each in meant if each.is_free])
    besides = not_wanted(result, subject, aim) if written else Change()
    site = Site(freed.result, subject)
    return Spaces(
        *(subject, freedom, freedom.reciprocal, meant, len(aim.unwanted), aim.stoppable),
        (*wires_for(freed, site, aim, besides), *sheets_for(freed, site, aim, besides))
        if is_tried
        else (),
        is_tried,
    )


def _require_texts(body: object, wanted: object) -> None:
    if not isinstance(body, (str, type(None))):
        raise TypeError(f"a body is given by its name, not by {type(body).__name__}")
    if isinstance(wanted, str):
        raise TypeError('wanted motions are several texts, such as ["stage: translation z"]')


def _subject(freed: Freed, body: str | None) -> Subject | None:
    result = freed.result
    if body is not None:
        return subject_named(result, body)
    # What each can do is found of those alone between which nothing else decides.
    ranked = [(rank_of(result, each, 0), each) for each in subjects_of(result)]
    least = min((rank[:3] for rank, _ in ranked), default=None)
    able = [each for rank, each in ranked if rank[:3] == least]
    if not able or not freed.is_known:
        return None
    return min(able, key=lambda each: rank_of(result, each, freed.space(each).dimension))
