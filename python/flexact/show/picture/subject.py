# SPDX-License-Identifier: BSD-3-Clause
"""What a picture shows: the drawing, a motion, a degree of freedom, or a self-stress."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from operator import index

from ...advice.spaces.spaces import Spaces
from ...analysis.naming import motion_in_words
from ...analysis.places import listed
from ...analysis.result import Result
from ...util.errors import require_kind
from ...util.partial import attempted
from ...util.text import harmless
from ..drawing import (
    QUANTITIES,
    Drawing,
    Movement,
    drawing_of,
    move,
    names_in,
    quantity_named,
    resultants,
)
from ..drawing.presses import presses_of
from ..drawing.selection import require_there, select_motion
from ..spaces import SpaceShown, holds_shown, spaces_shown
from .files import PictureError
from .stress import Stress


@dataclass(frozen=True)
class Subject:
    """What one panel shows; a drawing alone has neither movement nor stress.

    Attributes:
        title: Above it.
        movement: A motion as it is drawn.
        stress: A self-stress as it is drawn.
        space: A freedom or a constraint space as it is drawn.
    """

    title: str = "Reference shape"
    movement: Movement | None = None
    stress: Stress | None = None
    space: SpaceShown | None = None


@dataclass(frozen=True)
class Chosen:
    """What was asked for; numbers from 1, a freedom also by its name."""

    motion: int | None = None
    freedom: int | str | None = None
    stress: int | None = None
    quantity: str | None = None
    spaces: Spaces | None = None
    held: bool = False

    def __post_init__(self) -> None:
        """Check what can be checked without an analysis."""
        if self.spaces is not None:
            require_kind(self.spaces, Spaces, "spaces are those of a body, as advice has them")
            if self.moves or self.is_stressed:
                raise PictureError("a picture shows spaces, or motions and self-stresses, not both")
        if self.held and (self.moves or self.is_stressed or self.spaces is not None):
            raise PictureError("a picture shows what flexures hold alone")
        for name in ("motion", "freedom", "stress"):
            number = getattr(self, name)
            if number is None or (name == "freedom" and isinstance(number, str)):
                continue
            try:
                index(number)
            except TypeError:
                kind = type(number).__name__
                raise TypeError(f"{name} is a number from 1, not {kind}") from None
        if self.quantity is not None:
            require_kind(self.quantity, str, "a quantity is given by its name")
        if self.quantity is not None and quantity_named(self.quantity) is None:
            raise PictureError(
                f"there is no quantity {self.quantity!r}: it is one of {', '.join(QUANTITIES)}"
            )
        if self.quantity is not None and self.stress is None and self.moves:
            raise PictureError("a quantity is of a self-stress; there is none in this picture")

    @property
    def moves(self) -> bool:
        """Whether a motion was asked for."""
        return self.motion is not None or self.freedom is not None

    @property
    def is_stressed(self) -> bool:
        """Whether a self-stress was asked for."""
        return self.stress is not None or self.quantity is not None


def subjects_of(analysis: Result, drawing: Drawing, chosen: Chosen) -> list[Subject]:
    """What a still picture shows, a panel each.

    What was chosen, of spaces two; else the first motion and the first self-stress, those that
    there are; else the first degree of freedom that moves; else the drawing.

    Raises:
        BatchError: Something chosen is not there.
    """
    if chosen.moves or chosen.is_stressed:
        return _asked_for(analysis, drawing, chosen)
    if chosen.held:
        held = holds_shown(analysis, drawing.size, drawing.planar)
        if not held:
            raise PictureError(
                "what each flexure holds is shown of mechanisms that are exactly constrained, "
                "whose flexures each stand between two bodies"
            )
        return [Subject("What each flexure holds, and how well", space=held[0])]
    if chosen.spaces is not None:
        shown = spaces_shown(analysis, chosen.spaces, drawing.size, drawing.planar)
        return [Subject(_heading(each.title), space=each) for each in shown]
    made: list[Subject] = []
    missing: list[str] = []
    if len(analysis.motions) or not len(analysis.self_stresses):
        first = attempted("The motion", partial(_moving, analysis, drawing), made, missing)
        made += first
    if len(analysis.self_stresses):
        stressed = partial(_stressed, analysis, drawing, 1, None)
        made += attempted("The self-stress", stressed, list[Subject](), missing)
    return made or [Subject(" ".join(missing) or Subject.title)]


def moving_subject(analysis: Result, drawing: Drawing, chosen: Chosen) -> Subject:
    """What an animation shows.

    What was chosen; else the first motion, the first degree of freedom that moves, the first
    self-stress or the drawing, of which the last two do not move.

    Raises:
        BatchError: What was chosen is not there.
        PictureError: Several were chosen.
    """
    if chosen.held:
        raise PictureError("what flexures hold does not move: it is a PNG or an SVG")
    if chosen.spaces is not None:
        raise PictureError(
            "freedom and constraint spaces do not move: they are a PNG, an SVG or a PDF"
        )
    if chosen.moves or chosen.is_stressed:
        made = _asked_for(analysis, drawing, chosen)
        if len(made) > 1:
            raise PictureError(
                "an animation shows one of them: a motion, a degree of freedom or a self-stress"
            )
        return made[0]
    missing: list[str] = []
    made = attempted("The motion", partial(_moving, analysis, drawing), list[Subject](), missing)
    if not made and len(analysis.self_stresses):
        made = _stressed(analysis, drawing, 1, None)
    return made[0] if made else Subject(" ".join(missing) or Subject.title)


def _asked_for(analysis: Result, drawing: Drawing, chosen: Chosen) -> list[Subject]:
    made = []
    if chosen.motion is not None:
        made += _moving(analysis, drawing, motion=chosen.motion)
    if chosen.freedom is not None:
        made += _moving(analysis, drawing, freedom=chosen.freedom)
    if chosen.is_stressed:
        number = 1 if chosen.stress is None else chosen.stress
        made += _stressed(analysis, drawing, number, chosen.quantity)
    return made


def _moving(analysis: Result, drawing: Drawing, **chosen: int | str) -> list[Subject]:
    """The motion that is chosen, or is shown where none is; nothing where there is none."""
    shown = select_motion(analysis, **chosen)  # type: ignore[arg-type]
    if shown is None:
        return []
    words = motion_in_words(analysis, shown.number, shown.freedom)
    return [Subject(_heading(words), movement=move(drawing, shown.motion))]


def _stressed(
    analysis: Result, drawing: Drawing, number: int, quantity: str | None
) -> list[Subject]:
    stresses = analysis.self_stresses
    require_there(number, len(stresses), "self-stress", "self-stresses")
    values = resultants(drawing, stresses[number - 1])
    known = (quantity_named(quantity) if quantity else None) or values.dominant
    words = f"self-stress {number} of {analysis.over_constrained}"
    presses = presses_of(drawing, stresses[number - 1])
    return [Subject(_heading(words), stress=Stress(values, known, values.largest(known), presses))]


def refuse_zero(analysis: Result, number: int | None, quantity: str | None) -> None:
    """Raise where a quantity of a self-stress is zero everywhere, so that there is none to see.

    Args:
        analysis: The result.
        number: Of the self-stress, from 1; None: the first.
        quantity: Its name; None: the dominant one, which is not zero.

    Raises:
        PictureError: It is zero; this names the quantities that are not.
        BatchError: There is no such self-stress.
    """
    if quantity is None:
        return
    number = 1 if number is None else number
    require_there(number, len(analysis.self_stresses), "self-stress", "self-stresses")
    drawing = drawing_of(analysis.given)
    values = resultants(drawing, analysis.self_stresses[number - 1])
    known = quantity_named(quantity)
    if known is None or values.largest(known) > 0.0:
        return
    names = names_in(drawing)
    name = quantity if quantity.lower() in {"n", "t", "my", "mz"} else names[known]
    others = [name for each, name in names.items() if values.largest(each) > 0.0]
    are = "is" if len(others) == 1 else "are"
    rest = f"; {listed(others)} {are} not" if others else ""
    raise PictureError(f"{harmless(name)} is zero everywhere in self-stress {number}{rest}")


def _heading(words: str) -> str:
    return harmless(words[:1].upper() + words[1:])
