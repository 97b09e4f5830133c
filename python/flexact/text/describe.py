# SPDX-License-Identifier: BSD-3-Clause
"""The result in plain English: verdict first, then what stands behind it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import NamedTuple

from ..base.plain_text import harmless
from ..result.result import Result
from .advice import lines_on_motions, lines_on_self_stresses
from .decision import decision
from .margin import but_only, margin_line
from .motions import internal_in_words, motion_in_parts
from .naming import counted, counts_in_words, in_words
from .self_stresses import conflict_in_words, stress_in_parts
from .sentences import Line, Pieces, filled, sentence
from .warnings import warnings_of

#: How many motions, and how many self-stresses, are reported one by one on a screen.
MOST_MODES = 12
_PARTS = 6


def describe(result: Result, *, about_model: bool = True, most: int | None = None) -> str:
    """The result for people, in lines of at most about a hundred characters.

    Args:
        result: The result.
        about_model: Whether warnings and notes about the model or deck itself are given;
            not on a screen where they have been shown already.
        most: How many motions, and how many self-stresses, are given one by one; by default
            all.
    """
    sections = (
        _verdict(result),
        _counts(result),
        map(filled, decision(result)),
        _motions(result, most),
        _self_stresses(result, most),
        _notes(result, about_model),
    )
    blocks = ("\n".join(section) for section in map(list, sections) if section)
    return "\n\n".join(blocks)


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
    if over:
        ending = "" if over == 1 else "es"
        reasons.append(f"{in_words(over)} self-stress{ending} can exist without any load")
    none = "every motion is held once or declared, and no self-stress can exist without load"
    start = counts_in_words(under, over).capitalize() + but_only(result)
    return VerdictInWords(start, f"{'; '.join(reasons) or none}.")


def _verdict(result: Result) -> Iterator[str]:
    if result.name:
        yield harmless(result.name)
    yield filled(sentence(str(verdict_in_words(result))))
    yield filled(margin_line(result))


def _counts(result: Result) -> Iterator[str]:
    yield f"{'':14}{'total':>8}{'fixed':>8}{'dependent':>11}{'independent':>13}"
    for name, part in (
        ("coordinates", result.counts.coordinates),
        ("deformations", result.counts.deformations),
    ):
        total, fixed, dependent, independent = part
        yield f"{name:14}{total:8d}{fixed:8d}{dependent:11d}{independent:13d}"
    yield f"{counted(result.degrees_of_freedom, 'degree', '', 's')} of freedom declared."


def _motions(result: Result, most: int | None) -> Iterator[str]:
    told = result.motions[:most]
    internal = internal_in_words(result)
    if internal:
        told = tuple(motion for motion in told if not motion.is_internal)
    modes = (Line((), motion_in_parts(motion, _PARTS)) for motion in told)
    kind = _Kind("motion", "s", "kinematically")
    yield from _modes(kind, result.under_constrained, len(result.motions), modes, internal)
    yield from map(filled, lines_on_motions(result))


def _self_stresses(result: Result, most: int | None) -> Iterator[str]:
    modes = (
        Line(_lead(conflict_in_words(stress)), stress_in_parts(stress, _PARTS))
        for stress in result.self_stresses[:most]
    )
    kind = _Kind("self-stress", "es", "statically")
    yield from _modes(kind, result.over_constrained, len(result.self_stresses), modes)
    yield from map(filled, lines_on_self_stresses(result))


def _lead(words: Pieces) -> Pieces:
    return (*words, ": ") if words else ()


def _notes(result: Result, about_model: bool) -> Iterator[str]:
    known = 0 if about_model else len(result.data.problems.kept)
    lines = []
    for item in islice(warnings_of(result), known, None):
        place = f" (line {item.line})" if item.line else ""
        lines.append(filled(sentence(f"{item.severity}: {harmless(item.message)}{place}")))
    yield from dict.fromkeys(lines)


class _Kind(NamedTuple):
    """Motions or self-stresses, in words."""

    what: str
    ending: str
    how: str


def _modes(
    kind: _Kind, count: int, given: int, modes: Iterable[Line], internal: str = ""
) -> Iterator[str]:
    """Modes one by one, and how many there are besides: nothing where there are none."""
    if not count:
        return
    what, many = kind.what, kind.what + kind.ending
    heading = (many if count > 1 else what).capitalize()
    yield f"{heading} ({kind.how} indeterminate; relative values, only their ratios matter)"
    if internal:
        yield filled(sentence(f"  {internal}"))
    shown = 0
    for shown, line in enumerate(modes, start=1):
        numbered = line._replace(head=(f"  {shown}. ", *line.head))
        yield filled(numbered.shortened(_PARTS))
    if count > shown and not internal:
        yield f"  ... and {counted(count - shown, 'more ' + what, '', kind.ending)}"
    if count > given:
        yield f"Of these {count} {many} {given} are given; the method svd gives all."
    if count > 1:
        yield f"These {many} are one basis of many: any combination of them is also one."
