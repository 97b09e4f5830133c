# SPDX-License-Identifier: BSD-3-Clause
"""The result in plain English: verdict, what stands behind it, and what can be done, in short."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

from ..analysis.mode_words import (
    conflict_in_words,
    internal_in_words,
    motion_in_parts,
    stress_in_parts,
)
from ..analysis.naming import (
    Line,
    Named,
    Pieces,
    counted,
    counts_in_words,
    filled,
    in_words,
    line_of,
    part_in_words,
    plain,
    together_in_words,
)
from ..analysis.places import listed, part_words
from ..analysis.result import Result
from ..analysis.verdict_words import (
    decision,
    decision_in_short,
    declared_in_words,
    margin_line,
    verdict_in_short,
    warnings_of,
)
from ..analysis.ways import Coordinate, Part, Step, Way, on_motions, on_self_stresses
from ..util.groups import grouped
from ..util.loading import load
from ..util.text import TIE, USUAL, harmless, table

if TYPE_CHECKING:
    from ..analysis.holding import BodyHolding

#: How many motions, and how many self-stresses, are reported one by one on a screen.
MOST_MODES = 12
_PARTS = 6


#: What services take for a command: two colons that begin a line, and ##[ anywhere.
_COMMAND = re.compile(r"(?m)(^\s*:|#)(:|#\[)")


#: A table; its first row has its headings.
_Table = list[tuple[str, ...]]
#: What a section is made of.
_Told = Line | _Table


#: Rows of a screen, of which some are the name, the verdict and the tables.
_ROWS = 30
#: How many lines on bodies and how many motions and self-stresses stand on a screen, and in how
#: many words: the first that fit.
_SCREENS = ((8, 12, _PARTS), (8, 6, 2), (8, 3, 2), (8, 2, 1), (6, 1, 1), (4, 1, 1), (2, 0, 1))
#: Rows of one sentence, and warnings, on a screen.
_MOST_OF_SENTENCE, _MOST_WARNINGS = 3, 2


def describe(
    result: Result,
    *,
    about_model: bool = True,
    most: int | None = None,
    width: int = USUAL,
    verbose: bool = False,
    todo: Sequence[Line] = (),
) -> str:
    """The result for people, in rows of a width: one screen, or all there is to say.

    Args:
        result: The result.
        about_model: Whether warnings and notes about the model or deck itself are given;
            not on a screen where they have been shown already.
        most: How many motions, and how many self-stresses, are given one by one; by default
            all, of a screen as many as fit.
        width: Of the rows, in columns of a terminal.
        verbose: Whether all is said, on more than one screen.
        todo: What is best done, and what over-constraint costs (`flexact.advice.todo`).
    """
    if verbose:
        sections: tuple[Iterable[_Told], ...] = (
            (*_verdict(result), *held_lines(result, None), *todo, margin_line(result)),
            (*_counts(result), line_of(f"{declared_in_words(result)}.")),
            decision(result),
            _motions(result, most, _PARTS, (*lines_on_motions(result),)),
            _self_stresses(result, most, _PARTS, lines_on_self_stresses(result)),
            _notes(result, about_model),
        )
        return _safe("\n\n".join(filter(None, (_block(each, width) for each in sections))))
    text = ""
    count = max(result.under_constrained, result.over_constrained)
    for bodies, modes, parts in _SCREENS[0 if count <= MOST_MODES else 2 :]:
        modes = min(modes, MOST_MODES if most is None else most)
        first = (*_verdict(result), *held_lines(result, bodies), *todo, margin_line(result))
        shown: tuple[Iterable[_Told], ...] = (
            first,
            (*_counts(result), *_ranked(result)),
            _motions(result, modes, parts, _on_insides(result)),
            _self_stresses(result, modes, parts, ()),
            _first_notes(result, about_model),
        )
        made = (_block(each, width, _MOST_OF_SENTENCE) for each in shown)
        text = "\n\n".join(filter(None, made))
        if text.count("\n") < _ROWS:
            break
    return _safe(text)


def _safe(text: str) -> str:
    # In the log of a service that runs tests these would be commands, of whoever names a part.
    return _COMMAND.sub(lambda found: f"{found[1]} {found[2]}", text)


#: Where the statements or calls begin that do what a sentence says.
_STATEMENTS = r" \((?:[A-Z]{3,} \d|model\.)"


def _without_statements(text: str) -> str:
    """A sentence without its statements of a deck or calls of Python, which stand in brackets."""
    while found := re.search(_STATEMENTS, text):
        depth, quoted, end = 0, False, found.start()
        for end in range(found.start() + 1, len(text)):
            quoted ^= text[end] == '"'
            depth += 0 if quoted else (text[end] == "(") - (text[end] == ")")
            if not depth:
                break
        text = text[: found.start()] + text[end + 1 :]
    return text


def _block(section: Iterable[_Told], width: int, most: int | None = None) -> str:
    """A section as rows; of a sentence the first ones, if need be without its statements."""
    rows = []
    for told in section:
        if isinstance(told, list):
            rows += table(told, width).split("\n")
            continue
        hanging = plain(told.head).startswith("  ")
        lines = filled(told, hanging=hanging, width=width).split("\n")
        if most is not None and len(lines) > most and not told.items:
            shorter = line_of(_without_statements(plain(told.head)))
            lines = filled(shorter, hanging=hanging, width=width).split("\n")
        if most is not None and len(lines) > most:
            lines = [*lines[: most - 1], f"{lines[most - 1][: width - 4].rstrip(' ;,.')} ..."]
        rows += lines
    return "\n".join(rows)


#: How many bodies that are held alike are named, but for those whose numbers follow each other.
_BODIES = 3


def held_lines(
    result: Result, most: int | None = 8, named: Callable[[BodyHolding], Named] | None = None
) -> Iterator[Line]:
    """A line on each body: how often its motions are held, which are declared, and free.

    Equal ones are said once; then what is held too often between its ends and no body feels.

    Args:
        result: The result.
        most: How many lines at most; None for all.
        named: By what a body is linked with a drawing; None where there is none.
    """
    holding = result.holding
    alike = grouped((body.words, body) for body in holding.bodies)
    lines: list[tuple[Pieces, int]] = []
    for words, bodies in alike.items():
        names = [Named("element", 0, one.name) if named is None else named(one) for one in bodies]
        each = ", each" * (len(names) > 1)
        lines.append(((*together_in_words(names, _BODIES), f"{each}: {words}."), len(names)))
    lines += [((str(each),), 0) for each in holding.inside]
    if holding.left_out:
        lines = [((holding.left_out,), 0)]
    shown = len(lines) if most is None or len(lines) <= most else most - 1
    for pieces, _ in lines[:shown]:
        yield line_of(harmless(plain(pieces))) if named is None else Line(pieces)
    if rest := sum(count for _, count in lines[shown:]):
        yield line_of(f"... and {counted(rest, 'more bod', 'y', 'ies')} (-v).")


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


def _counts(result: Result) -> Iterator[_Told]:
    yield [
        ("", "   total", " fixed", "dependent", "independent"),
        ("coordinates", *map(str, result.counts.coordinates)),
        ("deformations", *map(str, result.counts.deformations)),
    ]


def _ranked(result: Result) -> Iterator[Line]:
    """How many degrees of freedom are declared, and the rank, in short."""
    yield line_of(f"{declared_in_words(result)}.")
    yield from decision_in_short(result)


def _motions(
    result: Result, most: int | None, parts: int, ways: tuple[Line, ...]
) -> Iterator[Line]:
    told = result.motions[:most]
    internal = internal_in_words(result)
    if internal and result.with_internal_declared is not None:
        told = tuple(motion for motion in told if not motion.is_internal)
    modes = (Line((), motion_in_parts(motion, parts)).shortened(parts) for motion in told)
    kind = "motion", "s", "kinematically"
    yield from _modes(kind, result.under_constrained, len(result.motions), modes, most, internal)
    yield from ways


def _self_stresses(
    result: Result, most: int | None, parts: int, ways: tuple[Line, ...]
) -> Iterator[Line]:
    told = ((conflict_in_words(each), each) for each in result.self_stresses[:most])
    modes = (
        Line((*lead, "."))
        if lead and parts < _PARTS
        else Line((*lead, ": ") if lead else (), stress_in_parts(each, parts)).shortened(parts)
        for lead, each in told
    )
    kind = "self-stress", "es", "statically"
    yield from _modes(kind, result.over_constrained, len(result.self_stresses), modes, most)
    yield from ways


def _first_notes(result: Result, about_model: bool) -> Iterator[Line]:
    """The first warnings and notes, and how many there are besides."""
    lines = list(_notes(result, about_model))
    yield from lines[:_MOST_WARNINGS]
    if (more := len(lines) - _MOST_WARNINGS) > 0:
        yield line_of(f"... and {counted(more, 'more warning', '', 's')} (-v).")


def _notes(result: Result, about_model: bool) -> Iterator[Line]:
    known = 0 if about_model else len(result.data.problems.kept)
    lines = []
    for item in islice(warnings_of(result), known, None):
        place = f" (line {item.line})" if item.line else ""
        lines.append(line_of(f"{item.severity}: {harmless(item.message)}{place}"))
    yield from dict.fromkeys(lines)


def _modes(
    kind: tuple[str, str, str],
    count: int,
    given: int,
    modes: Iterable[Line],
    most: int | None,
    internal: str = "",
) -> Iterator[Line]:
    """Modes one by one, and how many there are besides: nothing where there are none."""
    if not count or (most == 0 and not internal):
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
        yield numbered
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


def _on_insides(result: Result) -> tuple[Line, ...]:
    """What the mechanism is with insides of sheets, or folds, declared; nothing without any."""
    whole = result.with_internal_declared
    if whole is not None:
        return (_internal_as_one(result, whole),)
    if result.with_folds_declared is not None:
        return (_folds_declared(result, result.with_folds_declared),)
    return ()


def _lines_on_internal(result: Result, whole: Result, advice: Way) -> Iterator[Line]:
    """What makes each divided sheet or wire one beam, and what the verdict is then."""
    yield _internal_as_one(result, whole)
    if result.given.source is None:
        yield line_of("To declare what is inside: model.declare_internal_motions()")
        return
    statements = tuple((f"DYNE {part.operands}",) for part in advice.parts)
    yield Line(("To declare what is inside, instead of RLSE: ",), statements, (), advice.more)


def _internal_as_one(result: Result, whole: Result) -> Line:
    """What the mechanism is with each divided sheet or wire as one beam."""
    chains = [chain for chain in result.given.chains if chain.condensed_classes is None]
    names = [part_words(result.parts.of_element(chain.elements[0])) for chain in chains]
    if len(names) > _PARTS:
        names = [*names[: _PARTS - 1], f"{len(names) - _PARTS + 1} other parts"]
    counts = counts_in_words(whole.under_constrained, whole.over_constrained)
    be = "is" if len(chains) == 1 else "are"
    start = listed(names)
    return line_of(
        f"{start[:1].upper()}{start[1:]} {be} divided into beams whose deformations are not "
        f"declared; counted as one beam each, the mechanism is {counts}."
    )


def _lines_on_folds(result: Result, whole: Result) -> Iterator[Line]:
    """What declares the folds that turn, and what is to be done then."""
    s = "" if len(result.folds) == 1 else "s"
    yield _line(result, f"To declare the fold{s}: ", next(iter(on_motions(result))))
    yield _folds_declared(result, whole)
    yield from lines_on_motions(whole)


def _folds_declared(result: Result, whole: Result) -> Line:
    """What the mechanism is with the folds that turn declared."""
    counts = counts_in_words(whole.under_constrained, whole.over_constrained)
    s = "" if len(result.folds) == 1 else "s"
    return line_of(f"With the fold{s} declared the mechanism is {counts}.")


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
        calls: tuple[str, ...] = ()
        if first:
            calls = load("flexact.analysis.calls").calls_of(result, advice, part)
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
