# SPDX-License-Identifier: BSD-3-Clause
"""What can be done, in words."""

from __future__ import annotations

from collections.abc import Iterator

from ..analysis.calls import calls_of
from ..analysis.naming import (
    Line,
    Pieces,
    counts_in_words,
    in_words,
    part_in_words,
    plain,
    sentence,
)
from ..analysis.places import listed, part_words
from ..analysis.result import Result
from ..analysis.ways import Coordinate, Part, Step, Way, on_motions, on_self_stresses

#: How many parts an advice names.
_PARTS = 6
_SUPPORTS = 3


def lines_on_motions(result: Result) -> tuple[Line, ...]:
    """What may be declared or held so that there are fewer motions."""
    if not result.under_constrained:
        return ()
    advice = on_motions(result)
    whole = result.with_internal_declared
    if whole is not None:
        # What is inside of sheets is declared first; what is left then is told.
        internal = next(iter(advice), None)
        rest = lines_on_motions(whole)
        return rest if internal is None else (*_lines_on_internal(result, whole, internal), *rest)
    if result.with_folds_declared is not None:
        return tuple(_lines_on_folds(result, result.with_folds_declared))
    count = result.under_constrained
    heads = {
        Step.DECLARE_OR_HOLD: "To remove one motion, declare or hold one of: "
        if count > 1
        else "If this motion is wanted, declare one of these independent; if not, hold (fix) it: ",
        Step.DECLARE_OR_HOLD_RELEASED: "Or declare or hold one of these released deformations: ",
        Step.DECLARE_OR_HOLD_ALL: f"To remove {_all(count)}, declare or hold all of: ",
    }
    return tuple(_line(result, heads[item.step], item) for item in advice)


def _lines_on_internal(result: Result, whole: Result, advice: Way) -> Iterator[Line]:
    """What makes each divided sheet or wire one beam, and what the verdict is then."""
    chains = [chain for chain in result.given.chains if chain.condensed_classes is None]
    names = [part_words(result.parts.of_element(chain.elements[0])) for chain in chains]
    if len(names) > _PARTS:
        names = [*names[: _PARTS - 1], f"{len(names) - _PARTS + 1} other parts"]
    counts = counts_in_words(whole.under_constrained, whole.over_constrained)
    be = "is" if len(chains) == 1 else "are"
    start = listed(names)
    yield sentence(
        f"{start[:1].upper()}{start[1:]} {be} divided into beams whose deformations are not "
        f"declared; counted as one beam each, the mechanism is {counts}."
    )
    if result.given.source is None:
        yield sentence("To declare what is inside: model.declare_internal_motions()")
        return
    statements = tuple((f"DYNE {part.operands}",) for part in advice.parts)
    yield Line(("To declare what is inside, instead of RLSE: ",), statements, (), advice.more)


def _lines_on_folds(result: Result, whole: Result) -> Iterator[Line]:
    """What declares the folds that turn, and what is to be done then."""
    counts = counts_in_words(whole.under_constrained, whole.over_constrained)
    s, them = ("", "it") if len(result.folds) == 1 else ("s", "them")
    yield _line(result, f"To declare the fold{s}: ", next(iter(on_motions(result))))
    yield sentence(f"With {them} declared the mechanism is {counts}.")
    yield from lines_on_motions(whole)


def lines_on_self_stresses(result: Result) -> tuple[Line, ...]:
    """What may be released, freed or taken away so that there are fewer self-stresses."""
    is_hidden = not result.over_constrained
    if result.under_constrained:
        # Then it is told what the mechanism is with each divided sheet or wire as one beam.
        result = result.with_internal_declared or result
    count = result.over_constrained
    ways = {
        Step.RELEASE: "release one of: ",
        Step.UNDECLARE: "take a declaration away (driven against a constraint): ",
        Step.FREE_SUPPORT: "free a support: ",
    }
    start = "To remove it, " if count == 1 else "To remove one, "
    if is_hidden:
        start = "To remove a self-stress that there is with one beam each, "
    made = []
    for advice in on_self_stresses(result):
        if advice.step is Step.RELEASE_ALL:
            head = f"To remove {_all(count)}, release all of: "
        else:
            head, start = start + ways[advice.step], "Or "
        made.append(_line(result, head, advice))
    return tuple(made)


def _line(result: Result, head: str, advice: Way) -> Line:
    most = {
        Step.DECLARE_FOLDS: len(advice.parts),
        Step.FREE_SUPPORT: _SUPPORTS,
        Step.DECLARE_OR_HOLD_ALL: len(advice.parts),
        Step.RELEASE_ALL: len(advice.parts),
    }.get(advice.step, _PARTS)
    items: dict[str, tuple[Pieces, str]] = {}
    for part in advice.parts:
        # Several nodes of one body are one place to a designer.
        words = part_in_words(result, part)
        is_told = not items or advice.step is Step.DECLARE_FOLDS
        items.setdefault(plain(words), (words, _note(result, advice, part, first=is_told)))
    pieces, notes = zip(*items.values(), strict=True)
    return Line((head,), pieces, notes, advice.more).shortened(most)


def _note(result: Result, advice: Way, part: Part, first: bool) -> str:
    """How it is done with a part: in a deck by a statement, in Python by a call."""
    if result.given.source is None:
        calls = calls_of(result, advice, part) if first else ()
        return f"({', '.join(calls)})" if calls else ""
    if not advice.keywords:
        return ""
    if isinstance(part, Coordinate) and advice.step is Step.UNDECLARE:
        return f"(without DYNX {part.operands})"
    statements = [f"{keyword} {part.operands}" for keyword in advice.keywords]
    if len(statements) == 1:
        return f"({statements[0]}{' instead' * advice.instead})"
    return f"({(' instead of ' if advice.instead else ' or ').join(statements)})" if first else ""


def _all(count: int) -> str:
    return "both" if count == 2 else f"all {in_words(count)}"
