# SPDX-License-Identifier: BSD-3-Clause
"""What can be done, in words."""

from __future__ import annotations

from ..advice.advice import Advice, Part, Step, on_motions, on_self_stresses
from ..result.result import Result
from .calls import call_in_words
from .naming import in_words, part_in_words
from .sentences import Line, Pieces, plain

#: How many parts an advice names.
_PARTS = 6
_SUPPORTS = 3


def lines_on_motions(result: Result) -> tuple[Line, ...]:
    """What may be declared or held so that there are fewer motions."""
    count = result.under_constrained
    heads = {
        Step.DECLARE_OR_HOLD: "To remove one motion, declare or hold one of: "
        if count > 1
        else "If this motion is wanted, declare one of these independent; if not, hold (fix) it: ",
        Step.DECLARE_OR_HOLD_RELEASED: "Or declare or hold one of these released deformations: ",
        Step.DECLARE_OR_HOLD_ALL: f"To remove {_all(count)}, declare or hold all of: ",
    }
    return tuple(_line(result, heads[advice.step], advice) for advice in on_motions(result))


def lines_on_self_stresses(result: Result) -> tuple[Line, ...]:
    """What may be released, freed or taken away so that there are fewer self-stresses."""
    count = result.over_constrained
    ways = {
        Step.RELEASE: "release one of: ",
        Step.UNDECLARE: "take a declaration away (driven against a constraint): ",
        Step.FREE_SUPPORT: "free a support: ",
    }
    start = "To remove it, " if count == 1 else "To remove one, "
    made = []
    for advice in on_self_stresses(result):
        if advice.step is Step.RELEASE_ALL:
            head = f"To remove {_all(count)}, release all of: "
        else:
            head, start = start + ways[advice.step], "Or "
        made.append(_line(result, head, advice))
    return tuple(made)


def _line(result: Result, head: str, advice: Advice) -> Line:
    most = {
        Step.FREE_SUPPORT: _SUPPORTS,
        Step.DECLARE_OR_HOLD_ALL: len(advice.parts),
        Step.RELEASE_ALL: len(advice.parts),
    }.get(advice.step, _PARTS)
    items: dict[str, tuple[Pieces, str]] = {}
    for part in advice.parts:
        # Several nodes of one body are one place to a designer.
        words = part_in_words(result, part)
        items.setdefault(plain(words), (words, _note(result, advice, part, first=not items)))
    pieces, notes = zip(*items.values(), strict=True)
    return Line((head,), pieces, notes, advice.more).shortened(most)


def _note(result: Result, advice: Advice, part: Part, first: bool) -> str:
    """How it is done with a part: in a deck by a statement, in Python by a call."""
    if not advice.keywords:
        return ""
    if result.given.source is None:
        return f"({call_in_words(result, advice, part)})" if first else ""
    statements = [f"{keyword} {part.operands}" for keyword in advice.keywords]
    if len(statements) == 1:
        return f"({statements[0]}{' instead' * advice.instead})"
    return f"({(' instead of ' if advice.instead else ' or ').join(statements)})" if first else ""


def _all(count: int) -> str:
    return "both" if count == 2 else f"all {in_words(count)}"
