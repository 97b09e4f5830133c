# SPDX-License-Identifier: BSD-3-Clause
"""The advice on a mechanism, in values and in plain English.

The verdict, what is wrong and why, then steps that mend it; each piece is found when it is asked
for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from html import escape
from itertools import groupby, islice
from typing import Any, NamedTuple, TypeVar, overload

import numpy as np

from ..analysis.change import Change
from ..analysis.mode_words import internal_in_words
from ..analysis.naming import (
    Line,
    Pieces,
    counted,
    counts_in_words,
    filled,
    in_a_row,
    line_of,
    plain,
    sentence_of,
)
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..core.progress import Progress
from ..motion.extent import EvidenceKind, Extent, Extents, Kind, finite_in_words
from ..motion.finiteness import extents_of
from ..util.partial import attempted
from ..util.records import Frozen, cached_property
from ..util.text import USUAL, harmless
from . import json
from .causes.cause import Cause, CauseKind, Causes
from .causes.causes import causes_of
from .causes.realignment import both_in_words
from .describe import MOST_MODES, verdict_in_words
from .motions import AdvisedMotion, AdvisedStress
from .releases.candidates import COUNT_SECONDS
from .releases.releases import (
    Sets,
    declarations_of,
    releases_of,
    undeclarations_of,
)
from .releases.words import Release
from .repairs import MOST_STATEMENTS, Repair, best_together, repairs_of, turned_alike
from .spaces.spaces import Spaces, spaces_lines, spaces_of
from .step import After, Purpose, Step, tried

#: What has a statement.
_Made = TypeVar("_Made")
_Given = TypeVar("_Given")
_Told = TypeVar("_Told", AdvisedMotion, AdvisedStress, Step)
#: Of self-stresses of more resultants in all those that stand on a screen are told.
_MOST_ENTRIES = 20_000
#: What steps are for.
_AIMS = {
    Purpose.REPAIR: "To stop nothing twice and leave nothing free that is not declared",
    Purpose.MEND: "To let what is stopped twice stop what is free",
    Purpose.UNDECLARE: "To drive nothing against a constraint",
    Purpose.RELEASE: "To stop nothing twice",
    Purpose.DECLARE: "To leave nothing free that is not declared",
    Purpose.HOLD: "To leave nothing free that is not declared",
    Purpose.ADD_WIRE: "To stop with wires what is free and not wanted",
    Purpose.ADD_SHEET: "To stop with a sheet what is free and not wanted",
}
#: What takes time, in the order in which it is found, and what is said meanwhile.
_PIECES = {
    "causes": "finding causes",
    "repairs": "looking for repairs",
    "extents": "following motions",
    "releases": "trying releases",
    "declarations": "trying declarations",
    "spaces": "finding freedoms",
}


class Counts(NamedTuple):
    """How many smallest sets there are; None of those that are too many to be counted."""

    releases: int | None
    """Of deformations whose release leaves no self-stress."""
    declarations: int | None
    """Of coordinates whose declaration leaves no motion."""
    doubtful_releases: int | None
    """How many more of the first rounding leaves in doubt."""
    doubtful_declarations: int | None
    """And of the second."""


@dataclass(frozen=True, eq=False, repr=False)
class Advice(Frozen, Sequence[Step]):
    """What is wrong with a mechanism, why, and numbered steps that mend it.

    Attributes:
        analysis: The analysis of the mechanism.
        body: The body whose freedom and constraint are looked at; None: the one that the
            freedoms of the mechanism are about.
        wanted: Motions that are meant to be free, such as "stage: translation z".
        bodies: Whether insides of rigid bodies may be released where anything else does it, too.
    """

    analysis: Result
    body: str | None = None
    wanted: tuple[str, ...] = ()
    bodies: bool = False

    @cached_property
    def failed(self) -> list[str]:
        """What could not be made of the advice, behind "Left out: "; the rest of it is there."""
        return []

    def made(self, what: str, make: Callable[[], _Made], instead: _Given) -> _Made | _Given:
        """One piece of the advice, or what stands in its place where it cannot be made."""
        return attempted(what, make, instead, self.failed, "{what}, which failed ({why})")

    @cached_property
    def causes(self) -> Causes:
        """Why motions and self-stresses are there: any geometry has them, or this one."""
        unknown, result = Cause(CauseKind.UNKNOWN), self.analysis
        none = Causes((unknown,) * len(result.motions), (unknown,) * len(result.self_stresses))
        return self.made("causes", lambda: causes_of(result), none)

    @cached_property
    def extents(self) -> Extents:
        """Whether motions go on, or only begin."""
        unknown = Extent(Kind.UNDECIDED, EvidenceKind.NONE, "not given")
        none = Extents((unknown,) * len(self.analysis.motions), None)
        return self.made("how far motions go", lambda: extents_of(self.analysis), none)

    @cached_property
    def repairs(self) -> tuple[Repair, ...]:
        """Few statements about equal parts that make the mechanism exactly constrained."""
        return self.made("repairs", lambda: tuple(repairs_of(self.analysis)), ())

    @cached_property
    def releases(self) -> Sets:
        """Sets of deformations whose release leaves no self-stress."""
        result = self.analysis
        none = Sets(result.over_constrained, Purpose.RELEASE)
        return self.made("releases", lambda: releases_of(result, self.bodies), none)

    @cached_property
    def declarations(self) -> Sets:
        """Sets of coordinates whose declaration, or holding, leaves no motion."""
        none = Sets(self.analysis.under_constrained, Purpose.DECLARE)
        return self.made("declarations", lambda: declarations_of(self.analysis), none)

    @cached_property
    def spaces(self) -> Spaces | None:
        """Freedom and constraint of the body; None where there is no body.

        Raises:
            ModelError: no body has the name that was asked for, or a text is not understood.
        """

        def find(wires: bool) -> tuple[Spaces | None]:
            return (spaces_of(self.analysis, self.body, self.wanted, wires=wires),)

        if self.body is not None or self.wanted:
            # What was asked for wrongly is told, not left out.
            find(wires=False)
        made = self.made("wires and sheets to add", lambda: find(wires=True), None)
        made = made or self.made("freedom and constraint", lambda: find(wires=False), None)
        return made[0] if made else None

    @cached_property
    def motions(self) -> tuple[AdvisedMotion, ...]:
        """Each motion with its cause and extent; not of which nothing could be said."""
        told = zip(self.analysis.motions, self.extents.motions, strict=True)
        every = (AdvisedMotion(motion, self.causes, extent) for motion, extent in told)
        return tuple(self._told("a motion", every))

    @cached_property
    def self_stresses(self) -> tuple[AdvisedStress, ...]:
        """Each self-stress with its cause; of very many that carry much the first ones.

        Not of which nothing could be said.
        """
        result = self.analysis
        sizes = np.cumsum(
            [result.stress_basis.entries(k)[0].size for k in range(len(result.self_stresses))]
        )
        count = max(MOST_MODES, int(np.count_nonzero(sizes <= _MOST_ENTRIES)))
        every = (AdvisedStress(stress, self.causes) for stress in result.self_stresses[:count])
        return tuple(self._told("a self-stress", every))

    def _told(self, what: str, every: Iterable[_Told]) -> Iterator[_Told]:
        """Those of which the words can be said."""
        for one in every:
            if self.made(what, partial(getattr, one, "statement"), None) is not None:
                yield one

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """Ways to mend the mechanism, numbered as they are shown; each was tried."""
        return tuple(self.numbered())

    def numbered(self, progress: Progress | None = None) -> Iterator[Step]:
        """The steps one by one; what those behind them take is not looked for before."""
        every = (one for one in self._found_steps(progress) if one.change != Change())
        for number, step in enumerate(self._told("a step", every), start=1):
            yield replace(step, number=number)

    def _found_steps(self, progress: Progress | None) -> Iterator[Step]:
        """Steps of all kinds, in the order in which they are shown: what makes it exact first."""
        result = self.analysis
        self._find("causes", progress)
        mends = tuple(self._as_it_stands(self.causes.mends))
        taken_back = self.made("declarations to take back", lambda: undeclarations_of(result), ())
        first = [one for one in (*mends, *taken_back) if one.after.verdict is Verdict.EXACT]
        yield from self.made("turns", lambda: turned_alike(result), ())
        yield from first
        both = partial(best_together, result, taken_back, self._sets)
        is_both = not first and result.verdict is Verdict.BOTH
        if is_both and taken_back:
            yield from self.made("a step", both, ())
        self._find("repairs", progress)
        yield from self.repairs
        if is_both and not taken_back and not self.repairs:
            yield from self.made("a step", both, ())
        rest = taken_back if self.repairs else (*mends, *taken_back)
        yield from (one for one in rest if one not in first)
        self._find("releases", progress)
        yield from self._besides((*self.releases.sets, *self.releases.others))
        self._find("declarations", progress)
        yield from self._besides((*self.declarations.sets, *self.declarations.others))
        self._find("spaces", progress)
        yield from self._as_it_stands(() if self.spaces is None else self.spaces.steps)

    def _sets(self) -> tuple[tuple[Release, ...], tuple[Release, ...]]:
        return self.releases.sets, self.declarations.sets

    def _besides(self, steps: Iterable[Step]) -> Iterator[Step]:
        """Those that are worth to be read besides repairs: of few statements, and others."""
        known = {each.effect for each in self.repairs}
        for step in steps:
            places = (*step.change.deformations, *step.change.coordinates)
            if not known or (len(places) <= MOST_STATEMENTS and frozenset(places) not in known):
                yield step

    def _as_it_stands(self, steps: Iterable[Step]) -> Iterator[Step]:
        """Steps that were tried with divided sheets as one beam each, tried without."""
        result = self.analysis
        for step in steps:
            after: After | None = step.after
            if result.with_internal_declared is not None:
                after = self.made("a step", partial(tried, result, step.change), None)
            if after is not None:
                yield replace(step, analysis=result, after=after)

    @property
    def left_out(self) -> Iterator[str]:
        """What was not looked at, each in words that stand behind "Left out: "."""
        result, causes = self.analysis, self.causes
        for many, count, given in (
            ("motions", result.under_constrained, len(self.motions)),
            ("self-stresses", result.over_constrained, len(self.self_stresses)),
        ):
            if given < count:
                yield f"of {count} {many} all but {given}"
        for sets, what, many in (
            (self.releases, "releases", "self-stresses"),
            (self.declarations, "declarations", "motions"),
        ):
            if not sets.size:
                continue
            if sets.is_too_large:
                yield f"sets of {what}, for so many {many}"
            elif not sets.is_counted:
                continue
            elif sets.count is None:
                yield f"how many sets of {what} there are: too many for {COUNT_SECONDS:.0f} seconds"
            elif sets.doubtful != 0:
                more = sets.doubtful and counted(sets.doubtful, "set", "", "s")
                more = more or "some sets"
                yield f"from the count {more} of {what} more, which rounding leaves in doubt"
        if any(one.kind is CauseKind.UNKNOWN for one in (*causes.motions, *causes.self_stresses)):
            yield "whether another geometry would have them, too"
        yield from self.failed
        if count := sum(one.reason == "too large" for one in self.extents.motions):
            yield f"how far {counted(count, 'motion', ' goes', 's go')}: too large to be followed"

    def count(self) -> Counts:  # type: ignore[override]
        """How many sets of releases, and of declarations, leave nothing over.

        Counting takes at most ten seconds each; nothing else of the advice asks for it.
        """
        sets = self.releases, self.declarations
        return Counts(*(each.count for each in sets), *(each.doubtful for each in sets))

    def found(self, progress: Progress | None = None) -> Advice:
        """The advice itself, when all of it is found; `progress` is told how far that is."""
        for name in _PIECES:
            self._find(name, progress)
        return self

    def _find(self, name: str, progress: Progress | None) -> None:
        """Find a piece, and say meanwhile which it is."""
        if progress is not None:
            progress(_PIECES[name], list(_PIECES).index(name) / len(_PIECES))
        getattr(self, name)

    def __len__(self) -> int:
        """How many steps there are."""
        return len(self.steps)

    @overload
    def __getitem__(self, index: int) -> Step: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Step, ...]: ...
    def __getitem__(self, index: int | slice) -> Step | tuple[Step, ...]:
        """A step, or several; like those of a tuple they count from 0."""
        return self.steps[index]

    def to_dict(self) -> dict[str, Any]:
        """The advice as the JSON of `flexact advise` has it: `docs/advice.schema.json`."""
        told = {(step.purpose, step.change) for step in self.steps}
        result, spaces = self.analysis, self.spaces
        return {
            "releases": json.of_sets("deformations", self.releases, told),
            "declarations": json.of_sets("coordinates", self.declarations, told),
            "motions": list(map(json.of_motion, self.motions)),
            "self_stresses": list(map(json.of_self_stress, self.self_stresses)),
            "spaces": None if spaces is None else json.of_spaces(result, spaces, self.wanted),
            "steps": list(map(json.of_step, self.steps)),
            "left_out": list(self.left_out),
        }

    def describe(self) -> str:
        """The advice in plain English: what is wrong and why, then steps that mend it."""
        return describe(self)

    def __repr__(self) -> str:
        """The verdict, and how many steps there are."""
        count = len(self)
        return f"<Advice: {self.analysis.verdict.value}, {count} step{'s' * (count != 1)}>"

    def _repr_html_(self) -> str:
        head = escape(str(verdict_in_words(self.analysis)))
        return (
            f"<div style='border-left:4px solid {self.analysis.colour};padding-left:8px'>"
            f"<b>{head}</b><pre>{escape(describe(self))}</pre></div>"
        )


def advice_of(
    result: Result, body: str | None = None, wanted: Sequence[str] = (), bodies: bool = False
) -> Advice:
    """The advice on a mechanism.

    Args:
        result: Its analysis.
        body: The body whose freedom and constraint are looked at, by name.
        wanted: Motions that are meant to be free, such as "stage: translation z".
        bodies: Whether insides of rigid bodies may be released where anything else does it, too.

    Raises:
        ModelError: no body has this name, or a text is not understood.
    """
    meant = (wanted,) if isinstance(wanted, str) else tuple(wanted)
    made = Advice(result, body, meant, bodies)
    if body is not None or made.wanted:
        # What was asked for wrongly is told at once.
        _ = made.spaces
    return made


# In words ---------------------------------------------------------------------------

#: How many steps of one aim and outcome stand on a screen.
MOST_STEPS = 6
#: Causes of fewer letters are told again.
_SHORT = 100
#: A line of advice, and whether further rows of it are indented.
Told = tuple[Line, bool]
#: Lines that stand together.
Section = tuple[Told, ...]


def describe(advice: Advice, most: int | None = MOST_STEPS, width: int = USUAL) -> str:
    """The advice for people, in rows of a width.

    Args:
        advice: The advice.
        most: How many steps of one aim and outcome are given; None: all.
        width: Of the rows, in columns of a terminal.
    """
    result = advice.analysis
    head = filled(line_of(str(verdict_in_words(result))), width=width)
    blocks = (
        "\n".join(filled(line, hanging=hangs, width=width) for line, hangs in section)
        for section in sections_of(advice, most)
    )
    return "\n\n".join((f"{harmless(result.name)}\n{head}" if result.name else head, *blocks))


def sections_of(advice: Advice, most: int | None = MOST_STEPS) -> tuple[Section, ...]:
    """The advice without the verdict: what is wrong, what mends it, and what a body can do."""
    known: dict[str, str] = {}
    spaces = advice.made(
        "words of freedom and constraint",
        lambda: tuple(
            (line, False) for line in spaces_lines(advice.analysis, advice.spaces, added=False)
        ),
        (),
    )
    made = [
        tuple(_motions(advice, known)),
        tuple(_stresses(advice, known)),
        advice.made("a pair", lambda: _both(advice), ()),
        *_steps(advice, most),
        tuple(_counted(advice)),
    ]
    # What has failed until now is among it.
    if missing := tuple((each,) for each in advice.left_out):
        made.append(((Line(("Left out: ",), missing), False),))
    return tuple(section for section in (*made, spaces) if section)


def _said(words: str, hangs: bool = False) -> Told:
    return line_of(words), hangs


def _motions(advice: Advice, known: dict[str, str]) -> Iterator[Told]:
    if not advice.analysis.under_constrained:
        return
    yield _said("What nothing stops")
    whole = advice.analysis.with_internal_declared
    told = [each for each in advice.motions if whole is None or not each.motion.is_internal]
    told_at = {each.motion.index + 1: each.sentences for each in told}
    yield from _modes(told_at, "motion", known)
    yield from _more(len(told) - MOST_MODES, "motion", "s")
    if not advice.motions:
        yield _said("  None of them is given one by one; the method svd gives all.")
    if whole is not None and (internal := internal_in_words(advice.analysis)):
        counts = counts_in_words(whole.under_constrained, whole.over_constrained)
        as_one = f"With each of them as one beam (flexact declare) the mechanism is {counts}."
        yield _said(f"  {internal} {as_one}", hangs=True)
    for line in finite_in_words(advice.extents) if len(told) > 1 else ():
        yield line._replace(head=("  ", *line.head)), True


def _stresses(advice: Advice, known: dict[str, str]) -> Iterator[Told]:
    if not advice.self_stresses:
        return
    yield _said("What is stopped twice")
    told_at = {each.stress.index + 1: each.sentences for each in advice.self_stresses}
    yield from _modes(told_at, "self-stress", known)
    yield from _more(advice.analysis.over_constrained - MOST_MODES, "self-stress", "es")


def _modes(
    told_at: Mapping[int, Sequence[Pieces]], what: str, known: dict[str, str]
) -> Iterator[Told]:
    """Modes by their numbers; what is said of all of them stands behind them, once.

    Args:
        told_at: Sentences by the numbers of the modes.
        what: What a mode is.
        known: Of which mode words were said, so that nothing long is said in the same words again.
    """
    of_all: list[Pieces] = []
    if len(told_at) > 1:
        first, *others = told_at.values()
        of_all = [each for each in first[1:] if each and all(each in other for other in others)]
    for number, (head, *rest) in islice(told_at.items(), MOST_MODES):
        whose, pieces = f"{what} {number}", list(head)
        for each in rest:
            if not each or each in of_all:
                continue
            words = plain(each)
            first_said = known.setdefault(words, whose)
            is_again = first_said != whose and len(words) >= _SHORT
            pieces += [" ", *((f"The cause is that of {first_said}.",) if is_again else each)]
        yield _item(number, tuple(pieces))
    if of_all:
        words = in_a_row(of_all)
        yield _said(f"  Each of them: {words[0].lower()}{words[1:]}", hangs=True)


def _counted(advice: Advice) -> Iterator[Told]:
    """How many smallest sets there are, where they were counted."""
    for sets, what in ((advice.releases, "release"), (advice.declarations, "declaration")):
        if sets.is_counted and sets.size and sets.count is not None:
            many = counted(sets.count, "set", "", "s")
            of = counted(sets.size, what, "", "s")
            yield _said(f"There {'is' if sets.count == 1 else 'are'} {many} of {of}.")


def _both(advice: Advice) -> Section:
    """Which constraint is spent twice while which motion is free."""
    both = both_in_words(advice.analysis, advice.causes)
    return ((Line(sentence_of(both)), False),) if both else ()


def _steps(advice: Advice, most: int | None) -> Iterator[Section]:
    if not advice.steps and advice.analysis.verdict is Verdict.EXACT:
        is_had = advice.spaces is None or all(each.is_free for each in advice.spaces.wanted)
        but = "" if is_had else ", but what is wanted is stopped"
        yield (_said(f"There is nothing to mend{but}."),)
    kinds = groupby(advice.steps, lambda one: (_AIMS[one.purpose], one.outcome))
    for (aim, outcome), steps in kinds:
        told = tuple(steps)
        yield (
            _said(f"{aim}; then it is {outcome}", hangs=True),
            *(_item(step.number, step.pieces) for step in told[:most]),
            *_more(len(told) - len(told[:most]), "such way", "s"),
        )


def _item(number: int, pieces: Pieces) -> Told:
    return Line((f"  {number}. ", *pieces)), True


def _more(count: int, what: str, ending: str) -> Iterator[Told]:
    if count > 0:
        yield _said(f"  ... and {counted(count, f'more {what}', '', ending)}")
