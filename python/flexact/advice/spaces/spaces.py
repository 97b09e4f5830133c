# SPDX-License-Identifier: BSD-3-Clause
"""The freedom space and the constraint space of a body, and what to add to it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...analysis.change import Change
from ...analysis.naming import Line, Pieces, coordinate_in_words, in_words, line_of, named_element
from ...analysis.places import axis_words, joint_words, part_words
from ...analysis.result import Result
from ...analysis.screws import ScrewKind
from ...core.arrays import FloatArray
from ...deck.rendering import model_error
from ...model.parts.parts import Part
from ...util.records import Frozen
from ...util.text import in_short
from ..step import Step
from .flexures import added_in_words, sheets_for, wire_in_words, wires_for
from .screws import ScrewSpace
from .subjects import Freed, Site, Subject, rank_of, subject_named, subjects_of
from .wanted_motion import Aim, Wanted, Written, declared_of, not_wanted, read_all, wanted_of
from .words import Geometry, space_in_words


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
        steps: Wires that do so, each analysed: first single ones, then, where more are
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
    steps: tuple[Step, ...] = ()
    tried: bool = True

    @property
    def new_wires(self) -> FloatArray:
        """(w, 2, 3) ends of the wires of the first step, on the body and on the ground [m]."""
        wires = [wire for step in self.steps[:1] for wire in step.change.wires]
        return np.array([(wire.end, wire.ground) for wire in wires]).reshape(-1, 2, 3)


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
    if not isinstance(body, (str, type(None))):
        raise TypeError(f"a body is given by its name, not by {type(body).__name__}")
    if isinstance(wanted, str):
        raise TypeError('wanted motions are several texts, such as ["stage: translation z"]')
    told: list[Written] = []
    for each in wanted:
        found = read_all(each, planar=result.given.planar)
        # One motion is told as it was written, with its body.
        told += [found[0]._replace(text=each)] if len(found) == 1 else found
    names = [each.body for each in told if each.body is not None]
    written = [each for each in told if each.kind is not ScrewKind.NONE]
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
    meant = meant if told else declared_of(result, subject, freedom)
    aim = Aim.of(freedom, [each.twist for each in meant if each.is_free])
    besides = not_wanted(result, subject, aim) if told else Change()
    site = Site(freed.result, subject)
    return Spaces(
        *(subject, freedom, freedom.reciprocal, meant, len(aim.unwanted), aim.stoppable),
        (*wires_for(freed, site, aim, besides), *sheets_for(freed, site, aim, besides))
        if is_tried
        else (),
        is_tried,
    )


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


# In words ---------------------------------------------------------------------------

#: How many motions a sheet stops.
_HELD_BY_A_SHEET = 3


def spaces_lines(result: Result, spaces: Spaces | None, *, added: bool = True) -> tuple[Line, ...]:
    """What a body can do, what holds it, and what may be added to it.

    Without spaces it is said why, where there are bodies after all.

    Args:
        result: The result.
        spaces: Freedom and constraint of the body.
        added: Whether the wires and sheets to add are told; not where steps tell them.
    """
    if spaces is not None:
        return (*_lines(result, spaces), *(_added(result, spaces) if added else ()))
    if not subjects_of(result):
        return ()
    return (
        line_of(
            "What a body can do was left out: the mechanism has so many motions, with nothing "
            "declared, that not all of them are kept."
        ),
    )


def _lines(result: Result, spaces: Spaces) -> Iterator[Line]:
    geometry, body = Geometry.of_mechanism(result), body_words(result, spaces)
    start = f"{body[:1].upper()}{body[1:]}"
    free, held = spaces.freedom.dimension, spaces.constraint.dimension
    if free:
        many = f"{in_words(free)} independent motion{'s' * (free != 1)}"
        head = f"Freedom of {body}, with nothing declared: {many}: "
        yield Line((head,), space_in_words(geometry, spaces.freedom))
    else:
        yield line_of(f"{start} cannot move, with nothing declared.")
    if held:
        many = "force or moment" if held == 1 else "forces and moments"
        head = f"Constraint of {body}: {in_words(held)} independent {many}: "
        yield Line((head,), space_in_words(geometry, spaces.constraint))
    else:
        yield line_of(f"Nothing holds {body}.")
    lines = tuple((geometry.of(family),) for family in spaces.constraint.lines)
    if lines and free:
        yield Line(("One more wire would be redundant along: ",), lines)
    elif lines:
        yield line_of("One more wire would be redundant along any line.")
    yield from _on_intent(result, geometry, spaces, body)


def _on_intent(result: Result, geometry: Geometry, spaces: Spaces, body: str) -> Iterator[Line]:
    """What is wanted, what moves besides, and what stops it."""
    had = [each for each in spaces.wanted if each.is_free]
    if had:
        word = "Wanted, as declared: " if had[0].is_declared else "Wanted: "
        yield Line((word,), tuple((_wanted(geometry, each),) for each in had))
    for each in spaces.wanted:
        if not each.is_free:
            yield line_of(f"Wanted, but stopped: {_wanted(geometry, each)}.")
    count = spaces.unwanted
    if not count:
        if had:
            yield line_of(f"Nothing else of {body} moves.")
        return
    besides = f"Besides, {body} moves" if had else f"{body[:1].upper()}{body[1:]} moves"
    others = "other " if had else ""
    yield line_of(f"{besides} in {in_words(count)} {others}independent way{'s' * (count > 1)}.")
    left = count - spaces.stoppable
    if left and not spaces.stoppable:
        what = "it" if left == 1 else "any of them"
        yield line_of(
            f"No wire can stop {what}: a force along any line that does no work on what is "
            "wanted does none on it either; a moment would be needed."
        )
    elif left:
        yield line_of(
            f"Wires can stop {in_words(spaces.stoppable)} of them; for the other "
            f"{in_words(left)} a moment would be needed, which no force along a line gives without "
            "work on what is wanted."
        )
    if not spaces.tried and not result.is_told_by_parts:
        yield line_of("The mechanism is so large that no wires were tried.")
    if spaces.tried and spaces.stoppable and not spaces.steps:
        yield line_of(
            "Of the wires that were tried none stops only that and causes no self-stress."
        )
    # Which declarations of what is not wanted go with the wires.
    items: list[Pieces] = []
    for change in [step.change for step in spaces.steps[:1]]:
        items += [coordinate_in_words(result, node, name) for node, name, _ in change.coordinates]
        items += [(named_element(result, element),) for element, _, _ in change.deformations]
    if items:
        yield Line(("As it is not wanted, the declaration is taken back of: ",), tuple(items))


def _added(result: Result, spaces: Spaces) -> Iterator[Line]:
    """Wires and sheets that stop what is unwanted."""
    geometry, count = Geometry.of_mechanism(result), spaces.unwanted
    what = " and nothing that is wanted" if any(each.is_free for each in spaces.wanted) else ""
    single = [each for each in spaces.steps if len(each.change.wires) == 1]
    if single:
        which = "To stop it" if count == 1 else "To stop one of them"
        yield Line(
            (f"{which}{what}, add: ",),
            tuple(added_in_words(result, each.change) for each in single),
        )
    for step in spaces.steps:
        many = len(step.change.wires)
        if many > 1:
            which = "all" if many == count else in_words(many)
            items = tuple(wire_in_words(result, geometry, wire) for wire in step.change.wires)
            yield Line((f"To stop {which} of them, add all of: ",), items)
    sheets = [each for each in spaces.steps if each.change.sheets]
    if sheets:
        which = "all" if count == _HELD_BY_A_SHEET else "three"
        yield Line(
            (f"To stop {which} of them{what}, add: ",),
            tuple(added_in_words(result, each.change) for each in sheets),
        )


def _wanted(geometry: Geometry, wanted: Wanted) -> str:
    if wanted.kind is ScrewKind.TRANSLATION:
        return f"translation along {axis_words(wanted.direction)}"
    line = geometry.line(wanted.point, wanted.direction)
    if wanted.kind is ScrewKind.ROTATION:
        return f"rotation about {line}"
    return f"a screw about {line}, pitch {geometry.units.said(wanted.pitch, 'm/rad')}"


def dashed_in_words(wires: int) -> str:
    """What so many dashed wires of a drawing are; behind words on the space that is drawn."""
    return f"; dashed: {'a wire' if wires == 1 else 'wires'} to add" if wires else ""


def body_words(result: Result, spaces: Spaces) -> str:
    """What the body is called within a sentence, such as "the stage"."""
    body = spaces.subject.body
    if isinstance(body, Part):
        return part_words(body)
    return joint_words(result.parts, body)
