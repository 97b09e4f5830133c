# SPDX-License-Identifier: BSD-3-Clause
"""The result in plain English: verdict first, then what stands behind it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import NamedTuple

from ..analysis.mode_words import (
    conflict_in_words,
    internal_in_words,
    motion_in_parts,
    stress_in_parts,
)
from ..analysis.naming import Line, Pieces, counted, filled, in_words, sentence
from ..analysis.result import Result
from ..analysis.verdict_words import (
    decision,
    declared_in_words,
    margin_line,
    verdict_in_short,
    warnings_of,
)
from ..util.text import TIE, USUAL, harmless, table
from .ways_words import lines_on_motions, lines_on_self_stresses

#: How many motions, and how many self-stresses, are reported one by one on a screen.
MOST_MODES = 12
_PARTS = 6


#: What services take for a command: two colons that begin a line, and ##[ anywhere.
_COMMAND = re.compile(r"(?m)(^\s*:|#)(:|#\[)")


class _Table(NamedTuple):
    """A table; its first row has its headings."""

    rows: tuple[tuple[str, ...], ...]


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
    blocks = ([_shown(told, width) for told in section] for section in sections)
    text = "\n\n".join("\n".join(block) for block in blocks if block)
    # In the log of a service that runs tests these would be commands, of whoever names a part.
    return _COMMAND.sub(lambda found: f"{found[1]} {found[2]}", text)


def _shown(told: _Told, width: int) -> str:
    if isinstance(told, _Table):
        return table(told.rows, width)
    return filled(told, width=width)


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
        yield sentence(harmless(result.name).replace(" ", TIE))
    yield sentence(str(verdict_in_words(result)))
    yield margin_line(result)


def _counts(result: Result) -> Iterator[_Told]:
    counts = result.counts
    yield _Table(
        (
            ("", "   total", " fixed", "dependent", "independent"),
            ("coordinates", *map(str, counts.coordinates)),
            ("deformations", *map(str, counts.deformations)),
        )
    )
    yield sentence(f"{declared_in_words(result)}.")


def _motions(result: Result, most: int | None) -> Iterator[Line]:
    told = result.motions[:most]
    internal = internal_in_words(result)
    if internal and result.with_internal_declared is not None:
        told = tuple(motion for motion in told if not motion.is_internal)
    modes = (Line((), motion_in_parts(motion, _PARTS)) for motion in told)
    kind = _Kind("motion", "s", "kinematically")
    yield from _modes(kind, result.under_constrained, len(result.motions), modes, internal)
    yield from lines_on_motions(result)


def _self_stresses(result: Result, most: int | None) -> Iterator[Line]:
    modes = (
        Line(_lead(conflict_in_words(stress)), stress_in_parts(stress, _PARTS))
        for stress in result.self_stresses[:most]
    )
    kind = _Kind("self-stress", "es", "statically")
    yield from _modes(kind, result.over_constrained, len(result.self_stresses), modes)
    yield from lines_on_self_stresses(result)


def _lead(words: Pieces) -> Pieces:
    return (*words, ": ") if words else ()


def _notes(result: Result, about_model: bool) -> Iterator[Line]:
    known = 0 if about_model else len(result.data.problems.kept)
    lines = []
    for item in islice(warnings_of(result), known, None):
        place = f" (line {item.line})" if item.line else ""
        lines.append(sentence(f"{item.severity}: {harmless(item.message)}{place}"))
    yield from dict.fromkeys(lines)


class _Kind(NamedTuple):
    """Motions or self-stresses, in words."""

    what: str
    ending: str
    how: str


def _modes(
    kind: _Kind, count: int, given: int, modes: Iterable[Line], internal: str = ""
) -> Iterator[Line]:
    """Modes one by one, and how many there are besides: nothing where there are none."""
    if not count:
        return
    what, many = kind.what, kind.what + kind.ending
    heading = (many if count > 1 else what).capitalize()
    how = f"{kind.how} indeterminate; relative values, only their ratios matter"
    yield sentence(f"{heading} ({how})")
    if internal:
        yield sentence(f"  {internal}")
    shown = 0
    for shown, line in enumerate(modes, start=1):
        numbered = line._replace(head=(f"  {shown}. ", *line.head))
        yield numbered.shortened(_PARTS)
    if count > shown and not internal:
        more = counted(count - shown, f"more {what}", "", kind.ending)
        yield sentence(f"  ... and {more}")
    if count > given:
        told = f"Of these {count} {many} {given} are given; the method svd gives all."
        yield sentence(told)
    if count > 1:
        told = f"These {many} are one basis of many: any combination of them is also one."
        yield sentence(told)
