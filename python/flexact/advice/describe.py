# SPDX-License-Identifier: BSD-3-Clause
"""The result in plain English: verdict, what stands behind it, and what can be done, in short."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import NamedTuple

from ..analysis.calls import calls_of
from ..analysis.mode_words import (
    conflict_in_words,
    internal_in_words,
    motion_in_parts,
    stress_in_parts,
)
from ..analysis.naming import (
    Line,
    Pieces,
    counted,
    counts_in_words,
    filled,
    in_words,
    line_of,
    part_in_words,
    plain,
)
from ..analysis.places import listed, part_words
from ..analysis.result import Result
from ..analysis.verdict_words import (
    decision,
    declared_in_words,
    margin_line,
    verdict_in_short,
    warnings_of,
)
from ..analysis.ways import Coordinate, Part, Step, Way, on_motions, on_self_stresses
from ..util.text import TIE, USUAL, harmless, table

#: How many motions, and how many self-stresses, are reported one by one on a screen.
MOST_MODES = 12
_PARTS = 6


#: What services take for a command: two colons that begin a line, and ##[ anywhere.
_COMMAND = re.compile(r"(?m)(^\s*:|#)(:|#\[)")


#: A table; its first row has its headings.
_Table = list[tuple[str, ...]]
#: What a section is made of.
_Told = Line | _Table


def describe(
    result: Result, *, about_model: bool = True, most: int | None = None, width: int = USUAL
) -> str:
    """The result for people, in rows of a width.

    Args:
        result: The result.
        about_model: Whether warnings and notes about the model or deck itself are given;
            not on a screen where they have been shown already.
        most: How many motions, and how many self-stresses, are given one by one; by default
            all.
        width: Of the rows, in columns of a terminal.
    """
    sections = (
        _verdict(result),
        _counts(result),
        decision(result),
        _motions(result, most),
        _self_stresses(result, most),
        _notes(result, about_model),
    )
    blocks = (
        [
            table(told, width) if isinstance(told, list) else filled(told, width=width)
            for told in section
        ]
        for section in sections
    )
    text = "\n\n".join("\n".join(block) for block in blocks if block)
    # In the log of a service that runs tests these would be commands, of whoever names a part.
    return _COMMAND.sub(lambda found: f"{found[1]} {found[2]}", text)


class VerdictInWords(NamedTuple):
    """The verdict in a sentence."""

    start: str
    """What stands before the colon."""
    reason: str

    def __str__(self) -> str:
        """The sentence in one line."""
        return f"{self.start}: {self.reason}"


def verdict_in_words(result: Result) -> VerdictInWords:
    """The verdict in a sentence, and whether it holds within the accuracy."""
    under, over = result.under_constrained, result.over_constrained
    reasons = []
    if under:
        declared = "s are held by nothing and are not declared as degrees of freedom"
        if under == 1:
            declared = " is held by nothing and is not declared as a degree of freedom"
        reasons.append(f"{in_words(under)} motion{declared}")
        reasons += _of_folds(under, len(result.folds))
    if over:
        ending = "" if over == 1 else "es"
        reasons.append(f"{in_words(over)} self-stress{ending} can exist without any load")
    none = "every motion is held once or declared, and no self-stress can exist without load"
    start = verdict_in_short(result)
    return VerdictInWords(f"{start[:1].upper()}{start[1:]}", f"{'; '.join(reasons) or none}.")


def _of_folds(under: int, folds: int) -> list[str]:
    """Which of the motions are folds that turn."""
    if not folds:
        return []
    them, are = (
        ("it", "is the fold of a folded sheet")
        if folds == 1
        else ("them", "are folds of folded sheets")
    )
    which = f"{in_words(folds)} of them" if folds < under else "they" if folds > 1 else "it"
    return [f"{which} {are}: declare {them}"]


def _verdict(result: Result) -> Iterator[Line]:
    if result.name:
        yield line_of(harmless(result.name).replace(" ", TIE))
    yield line_of(str(verdict_in_words(result)))
    yield margin_line(result)


def _counts(result: Result) -> Iterator[_Told]:
    yield [
        ("", "   total", " fixed", "dependent", "independent"),
        ("coordinates", *map(str, result.counts.coordinates)),
        ("deformations", *map(str, result.counts.deformations)),
    ]
    yield line_of(f"{declared_in_words(result)}.")


def _motions(result: Result, most: int | None) -> Iterator[Line]:
    told = result.motions[:most]
    internal = internal_in_words(result)
    if internal and result.with_internal_declared is not None:
        told = tuple(motion for motion in told if not motion.is_internal)
    modes = (Line((), motion_in_parts(motion, _PARTS)) for motion in told)
    kind = "motion", "s", "kinematically"
    yield from _modes(kind, result.under_constrained, len(result.motions), modes, internal)
    yield from lines_on_motions(result)


def _self_stresses(result: Result, most: int | None) -> Iterator[Line]:
    told = ((conflict_in_words(each), each) for each in result.self_stresses[:most])
    modes = (
        Line((*lead, ": ") if lead else (), stress_in_parts(each, _PARTS)) for lead, each in told
    )
    kind = "self-stress", "es", "statically"
    yield from _modes(kind, result.over_constrained, len(result.self_stresses), modes)
    yield from lines_on_self_stresses(result)


def _notes(result: Result, about_model: bool) -> Iterator[Line]:
    known = 0 if about_model else len(result.data.problems.kept)
    lines = []
    for item in islice(warnings_of(result), known, None):
        place = f" (line {item.line})" if item.line else ""
        lines.append(line_of(f"{item.severity}: {harmless(item.message)}{place}"))
    yield from dict.fromkeys(lines)


def _modes(
    kind: tuple[str, str, str], count: int, given: int, modes: Iterable[Line], internal: str = ""
) -> Iterator[Line]:
    """Modes one by one, and how many there are besides: nothing where there are none."""
    if not count:
        return
    what, ending, way = kind
    many = what + ending
    heading = (many if count > 1 else what).capitalize()
    how = f"{way} indeterminate; relative values, only their ratios matter"
    yield line_of(f"{heading} ({how})")
    if internal:
        yield line_of(f"  {internal}")
    shown = 0
    for shown, line in enumerate(modes, start=1):
        numbered = line._replace(head=(f"  {shown}. ", *line.head))
        yield numbered.shortened(_PARTS)
    if count > shown and not internal:
        more = counted(count - shown, f"more {what}", "", ending)
        yield line_of(f"  ... and {more}")
    if count > given:
        told = f"Of these {count} {many} {given} are given; the method svd gives all."
        yield line_of(told)
    if count > 1:
        told = f"These {many} are one basis of many: any combination of them is also one."
        yield line_of(told)


# What can be done, in short ------------------------------------------------------

#: How many supports an advice names.
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
    yield line_of(
        f"{start[:1].upper()}{start[1:]} {be} divided into beams whose deformations are not "
        f"declared; counted as one beam each, the mechanism is {counts}."
    )
    if result.given.source is None:
        yield line_of("To declare what is inside: model.declare_internal_motions()")
        return
    statements = tuple((f"DYNE {part.operands}",) for part in advice.parts)
    yield Line(("To declare what is inside, instead of RLSE: ",), statements, (), advice.more)


def _lines_on_folds(result: Result, whole: Result) -> Iterator[Line]:
    """What declares the folds that turn, and what is to be done then."""
    counts = counts_in_words(whole.under_constrained, whole.over_constrained)
    s, them = ("", "it") if len(result.folds) == 1 else ("s", "them")
    yield _line(result, f"To declare the fold{s}: ", next(iter(on_motions(result))))
    yield line_of(f"With {them} declared the mechanism is {counts}.")
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
