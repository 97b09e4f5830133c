# SPDX-License-Identifier: BSD-3-Clause
"""The advice in plain English: the verdict, what is wrong and why, and steps that mend it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from itertools import groupby, islice
from typing import TYPE_CHECKING, NamedTuple

from ..analysis.mode_words import internal_in_words
from ..analysis.naming import Line, Named, Piece, Pieces, counted, counts_in_words, filled, plain
from ..analysis.naming import sentence as line_of
from ..analysis.places import listed
from ..analysis.verdict import Verdict
from ..motion.extent import finite_in_words
from ..util.text import USUAL, harmless
from .causes.words import both_in_words
from .describe import MOST_MODES, verdict_in_words
from .left_out import left_out
from .proposal import Purpose
from .spaces.words import spaces_lines

if TYPE_CHECKING:
    from .advice import Advice


def begun(pieces: Pieces) -> Pieces:
    """The pieces with a capital first letter, as a sentence begins."""
    for place, piece in enumerate(pieces):
        if str(piece):
            return (*pieces[:place], _capital(piece), *pieces[place + 1 :])
    return pieces


def ended(pieces: Pieces, mark: str = ".") -> Pieces:
    """The pieces with a mark at their end, in place of the one that is there."""
    if not pieces:
        return pieces
    last = pieces[-1]
    if isinstance(last, Named):
        return (*pieces, mark)
    return (*pieces[:-1], last.rstrip(" .:;") + mark)


def sentence(pieces: Pieces) -> Pieces:
    """The pieces from a capital letter to a full stop; nothing where there are no words."""
    return ended(begun(pieces)) if plain(pieces).strip() else ()


def in_a_row(sentences: Iterable[Pieces]) -> str:
    """Sentences behind each other, as text."""
    return " ".join(words for words in map(plain, sentences) if words)


def _capital(piece: Piece) -> Piece:
    words = str(piece)
    first = words[:1].upper() + words[1:]
    return piece._replace(words=first) if isinstance(piece, Named) else first


#: How many steps of one aim and outcome stand on a screen.
MOST_STEPS = 6
#: Causes of fewer letters are told again.
_SHORT = 100
#: What steps are for.
_AIMS = {
    Purpose.MEND: "To let what is stopped twice stop what is free",
    Purpose.UNDECLARE: "To drive nothing against a constraint",
    Purpose.RELEASE: "To stop nothing twice",
    Purpose.DECLARE: "To leave nothing free that is not declared",
    Purpose.HOLD: "To leave nothing free that is not declared",
    Purpose.ADD_WIRE: "To stop with wires what is free and not wanted",
    Purpose.ADD_SHEET: "To stop with a sheet what is free and not wanted",
}


class Told(NamedTuple):
    """A line of advice."""

    line: Line
    hangs: bool = False
    """Whether further rows of it are indented."""


#: Lines that stand together.
Section = tuple[Told, ...]


def describe(advice: Advice, most: int | None = MOST_STEPS, width: int = USUAL) -> str:
    """The advice for people, in rows of a width.

    Args:
        advice: The advice.
        most: How many steps of one aim and outcome are given; None: all.
        width: Of the rows, in columns of a terminal.
    """
    blocks = (
        "\n".join(filled(told.line, hanging=told.hangs, width=width) for told in section)
        for section in sections_of(advice, most)
    )
    return "\n\n".join((_verdict(advice, width), *blocks))


def html_of(advice: Advice) -> str:
    """The advice in a notebook: the verdict, and the words below it."""
    head = escape(str(verdict_in_words(advice.analysis)))
    colour = advice.analysis.colour
    return (
        f"<div style='border-left:4px solid {colour};padding-left:8px'><b>{head}</b>"
        f"<pre>{escape(describe(advice))}</pre></div>"
    )


def sections_of(advice: Advice, most: int | None = MOST_STEPS) -> tuple[Section, ...]:
    """The advice without the verdict: what is wrong, what mends it, and what a body can do."""
    known = _Known()
    spaces = advice.made(
        "words of freedom and constraint",
        lambda: tuple(map(Told, spaces_lines(advice.analysis, advice.spaces, added=False))),
        (),
    )
    made = (
        tuple(_motions(advice, known)),
        tuple(_stresses(advice, known)),
        advice.made("a pair", lambda: tuple(_both(advice)), ()),
        *_steps(advice, most),
        tuple(_left_out(advice)),
        spaces,
    )
    return tuple(section for section in made if section)


def _verdict(advice: Advice, width: int) -> str:
    result = advice.analysis
    words = filled(line_of(str(verdict_in_words(result))), width=width)
    return f"{harmless(result.name)}\n{words}" if result.name else words


def _motions(advice: Advice, known: _Known) -> Iterator[Told]:
    if not advice.analysis.under_constrained:
        return
    yield Told(line_of("What nothing stops"))
    whole = advice.analysis.with_internal_declared
    told = [each for each in advice.motions if whole is None or not each.motion.is_internal]
    told_at = {each.motion.index + 1: each.sentences for each in told}
    yield from _modes(told_at, "motion", known)
    yield from _more(len(told) - MOST_MODES, "motion", "s")
    if not advice.motions:
        yield Told(line_of("  None of them is given one by one; the method svd gives all."))
    if whole is not None and (internal := internal_in_words(advice.analysis)):
        counts = counts_in_words(whole.under_constrained, whole.over_constrained)
        as_one = f"With each of them as one beam (flexact declare) the mechanism is {counts}."
        yield Told(line_of(f"  {internal} {as_one}"), hangs=True)
    for line in finite_in_words(advice.extents) if len(told) > 1 else ():
        yield Told(line._replace(head=("  ", *line.head)), hangs=True)


def _stresses(advice: Advice, known: _Known) -> Iterator[Told]:
    if not advice.self_stresses:
        return
    yield Told(line_of("What is stopped twice"))
    told_at = {each.stress.index + 1: each.sentences for each in advice.self_stresses}
    yield from _modes(told_at, "self-stress", known)
    yield from _more(advice.analysis.over_constrained - MOST_MODES, "self-stress", "es")


def _modes(told_at: Mapping[int, Sequence[Pieces]], what: str, known: _Known) -> Iterator[Told]:
    """Modes by their numbers; what is said of all of them stands behind them, once."""
    of_all: list[Pieces] = []
    if len(told_at) > 1:
        first, *others = told_at.values()
        of_all = [each for each in first[1:] if each and all(each in other for other in others)]
    for number, (head, *rest) in islice(told_at.items(), MOST_MODES):
        told = [known.told(each, f"{what} {number}") for each in rest if each not in of_all]
        pieces = [(" ", *each) for each in told if each]
        yield _item(number, (*head, *(piece for each in pieces for piece in each)))
    if of_all:
        words = in_a_row(of_all)
        yield Told(line_of(f"  Each of them: {words[0].lower()}{words[1:]}"), hangs=True)


class _Known:
    """What was said, so that nothing long is said in the same words again."""

    def __init__(self) -> None:
        self._whose: dict[str, str] = {}

    def told(self, pieces: Pieces, whose: str) -> Pieces:
        """The pieces, or of which motion or self-stress they were said before."""
        words = plain(pieces)
        first = self._whose.setdefault(words, whose)
        if first == whose or len(words) < _SHORT:
            return pieces
        return (f"The cause is that of {first}.",)


def _both(advice: Advice) -> Iterator[Told]:
    """Which constraint is spent twice while which motion is free."""
    if both := both_in_words(advice.analysis, advice.causes):
        yield Told(Line(ended(begun(both))))


def _steps(advice: Advice, most: int | None) -> Iterator[Section]:
    if not advice.steps and advice.analysis.verdict is Verdict.EXACT:
        is_had = advice.spaces is None or all(each.is_free for each in advice.spaces.wanted)
        but = "" if is_had else ", but what is wanted is stopped"
        yield (Told(line_of(f"There is nothing to mend{but}.")),)
    kinds = groupby(advice.steps, lambda one: (_AIMS[one.purpose], one.outcome))
    for (aim, outcome), steps in kinds:
        told = tuple(steps)
        shown = told[:most]
        yield (
            Told(line_of(f"{aim}; then it is {outcome}"), hangs=True),
            *(_item(step.number, step.pieces) for step in shown),
            *_more(len(told) - len(shown), "such way", "s"),
        )
    if numbers := tuple(map(str, advice.exact_by)):
        how = f"--apply {','.join(numbers)}"
        words = f"Steps {listed(numbers)} together make it exactly constrained ({how})."
        yield (Told(line_of(words)),)


def _left_out(advice: Advice) -> Iterator[Told]:
    if missing := tuple((each,) for each in left_out(advice)):
        yield Told(Line(("Left out: ",), missing))


def _item(number: int, pieces: Pieces) -> Told:
    return Told(Line((f"  {number}. ", *pieces)), hangs=True)


def _more(count: int, what: str, ending: str) -> Iterator[Told]:
    if count > 0:
        yield Told(line_of(f"  ... and {counted(count, f'more {what}', '', ending)}"))
