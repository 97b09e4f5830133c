# SPDX-License-Identifier: BSD-3-Clause
"""The advice on a mechanism: all that is found, each piece when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeVar, overload

import numpy as np

from ..analysis.change import Change
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..core.progress import Progress
from ..motion.extent import EvidenceKind, Extent, Extents, Kind, Reason
from ..motion.finiteness import extents_of
from ..util.errors import FlexactError
from ..util.partial import attempted
from ..util.records import Frozen, cached_property
from .causes.cause import Cause, CauseKind, Causes
from .causes.causes import causes_of
from .describe import MOST_MODES
from .json import dictionary_of
from .motions import AdvisedMotion, AdvisedStress
from .proposal import Proposal, Purpose, tried
from .releases.releases import Declarations, Releases, declarations_of, releases_of
from .spaces.spaces import Spaces, spaces_of
from .steps import Step, together
from .undeclaring import undeclarations_of
from .words import describe, html_of

#: What has a statement.
_Made = TypeVar("_Made")
_Given = TypeVar("_Given")
_Told = TypeVar("_Told", AdvisedMotion, AdvisedStress, Step)
#: Of self-stresses of more resultants in all those that stand on a screen are told.
_MOST_ENTRIES = 20_000
#: Kinds of steps in the order in which they are shown.
_ORDER = (
    *(Purpose.MEND, Purpose.UNDECLARE, Purpose.RELEASE, Purpose.DECLARE, Purpose.HOLD),
    *(Purpose.ADD_WIRE, Purpose.ADD_SHEET),
)
#: What takes time, in the order in which it is found, and what is said meanwhile.
_PIECES = {
    "causes": "finding causes",
    "extents": "following motions",
    "releases": "trying releases",
    "declarations": "trying declarations",
    "spaces": "finding freedoms",
}


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

    def _each(
        self, what: str, items: Iterable[_Given], make: Callable[[_Given], _Made]
    ) -> Iterator[_Made]:
        """What `make` gives of each item, without those of which it fails."""
        for item in items:
            nothing: tuple[_Made, ...] = ()
            yield from self.made(what, partial(_alone, make, item), nothing)

    @cached_property
    def causes(self) -> Causes:
        """Why motions and self-stresses are there: any geometry has them, or this one."""
        unknown, result = Cause(CauseKind.UNKNOWN), self.analysis
        none = Causes((unknown,) * len(result.motions), (unknown,) * len(result.self_stresses))
        return self.made("causes", lambda: causes_of(result), none)

    @cached_property
    def extents(self) -> Extents:
        """Whether motions go on, or only begin."""
        unknown = Extent(Kind.UNDECIDED, EvidenceKind.NONE, Reason.NOT_GIVEN)
        none = Extents((unknown,) * len(self.analysis.motions), None)
        return self.made("how far motions go", lambda: extents_of(self.analysis), none)

    @cached_property
    def releases(self) -> Releases:
        """Sets of deformations whose release leaves no self-stress."""
        result, none = self.analysis, Releases(self.analysis.over_constrained, None)
        return self.made("releases", lambda: releases_of(result, self.bodies), none)

    @cached_property
    def declarations(self) -> Declarations:
        """Sets of coordinates whose declaration, or holding, leaves no motion."""
        none = Declarations(self.analysis.under_constrained, None)
        return self.made("declarations", lambda: declarations_of(self.analysis), none)

    @cached_property
    def spaces(self) -> Spaces | None:
        """Freedom and constraint of the body; None where there is no body.

        Raises:
            ModelError: no body has the name that was asked for, or a text is not understood.
        """
        asked = self.analysis, self.body, self.wanted
        if self.body is not None or self.wanted:
            # What was asked for wrongly is told, not left out.
            spaces_of(*asked, wires=False)
        made: tuple[Spaces | None, ...] = ()
        made = self.made("wires and sheets to add", partial(_alone, spaces_of, *asked), made)
        without = partial(_alone, spaces_of, *asked, wires=False)
        made = made or self.made("freedom and constraint", without, made)
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
        return self._each(what, every, lambda one: (one, one.statement)[0])

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """Ways to mend the mechanism, numbered as they are shown; each was tried."""
        every = (one for one in self._proposals() if one.change != Change())
        ordered = sorted(every, key=lambda one: _ORDER.index(one.purpose))
        told = list(self._told("a step", (Step(self.analysis, 0, one) for one in ordered)))
        return tuple(replace(step, number=k) for k, step in enumerate(told, start=1))

    def _proposals(self) -> Iterator[Proposal]:
        yield from self._each("a step", self.causes.mends, self._as_it_stands)
        yield from self.made(
            "declarations to take back", lambda: undeclarations_of(self.analysis), ()
        )
        yield from (*self.releases.sets, *self.releases.supports)
        yield from (*self.declarations.sets, *self.declarations.holds)
        if self.spaces is not None:
            yield from self._each("a step", self.spaces.proposals, self._as_it_stands)

    def _as_it_stands(self, one: Proposal) -> Proposal:
        """A proposal that was tried with divided sheets as one beam each, tried without."""
        if self.analysis.with_internal_declared is None:
            return one
        return replace(one, after=tried(self.analysis, one.change))

    @cached_property
    def exact_by(self) -> tuple[int, ...]:
        """Numbers of steps, one of each kind that it takes, that make it exactly constrained.

        They are the best of each kind, analysed together; none where one step does it alone, or
        where they do not do it.
        """
        firsts = {step.purpose: step.number for step in reversed(self.steps)}
        release = Purpose.UNDECLARE if Purpose.UNDECLARE in firsts else Purpose.RELEASE
        able = [firsts[kind] for kind in (release, Purpose.DECLARE) if kind in firsts]
        exact = (step for step in self.steps if step.after.verdict is Verdict.EXACT)
        if self.analysis.verdict is not Verdict.BOTH or len(able) < 2 or any(exact):
            return ()
        change = together(self.steps[number - 1].change for number in able)
        try:
            is_exact = tried(self.analysis, change).verdict is Verdict.EXACT
        except FlexactError:
            return ()
        return tuple(able) if is_exact else ()

    def found(self, progress: Progress | None = None) -> Advice:
        """The advice itself, when all of it is found; `progress` is told how far that is."""
        for k, (name, words) in enumerate(_PIECES.items()):
            if progress is not None:
                progress(words, k / len(_PIECES))
            getattr(self, name)
        return self

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
        """The advice as the JSON of `flexact advise` has it."""
        return dictionary_of(self)

    def describe(self) -> str:
        """The advice in plain English: what is wrong and why, then steps that mend it."""
        return describe(self)

    def __repr__(self) -> str:
        """The verdict, and how many steps there are."""
        count = len(self)
        return f"<Advice: {self.analysis.verdict.value}, {count} step{'s' * (count != 1)}>"

    def _repr_html_(self) -> str:
        return html_of(self)


def _alone(make: Callable[..., _Made], *given: object, **more: object) -> tuple[_Made, ...]:
    return (make(*given, **more),)


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
