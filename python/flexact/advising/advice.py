# SPDX-License-Identifier: BSD-3-Clause
"""The advice on a mechanism: all that is found, each piece when it is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, overload

from ..advice.causes.cause import Causes
from ..advice.causes.causes import causes_of
from ..advice.change import Change
from ..advice.proposal import Proposal, Purpose, tried
from ..advice.releases.declarations import Declarations, declarations_of
from ..advice.releases.releases import Releases, releases_of
from ..advice.spaces.spaces import Spaces, spaces_of
from ..advice.undeclaring import undeclarations_of
from ..base.frozen import Frozen
from ..core.progress import Progress
from ..result.extents.decide import extents_of
from ..result.extents.extent import Extents
from ..result.result import Result
from ..result.verdict import Verdict
from .describe import describe, html_of
from .json_advice import dictionary_of
from .motions import AdvisedMotion, AdvisedStress
from .steps import Step, together

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
    """

    analysis: Result
    body: str | None = None
    wanted: tuple[str, ...] = ()

    @cached_property
    def causes(self) -> Causes:
        """Why motions and self-stresses are there: any geometry has them, or this one."""
        return causes_of(self.analysis)

    @cached_property
    def extents(self) -> Extents:
        """Whether motions go on, or only begin."""
        return extents_of(self.analysis)

    @cached_property
    def releases(self) -> Releases:
        """Sets of deformations whose release leaves no self-stress."""
        return releases_of(self.analysis)

    @cached_property
    def declarations(self) -> Declarations:
        """Sets of coordinates whose declaration, or holding, leaves no motion."""
        return declarations_of(self.analysis)

    @cached_property
    def spaces(self) -> Spaces | None:
        """Freedom and constraint of the body; None where there is no body."""
        return spaces_of(self.analysis, self.body, self.wanted)

    @cached_property
    def motions(self) -> tuple[AdvisedMotion, ...]:
        """Each motion with its cause and extent."""
        told = zip(self.analysis.motions, self.extents.motions, strict=True)
        return tuple(AdvisedMotion(motion, self.causes, extent) for motion, extent in told)

    @cached_property
    def self_stresses(self) -> tuple[AdvisedStress, ...]:
        """Each self-stress with its cause."""
        return tuple(AdvisedStress(stress, self.causes) for stress in self.analysis.self_stresses)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """Ways to mend the mechanism, numbered as they are shown; each was tried."""
        every = (one for one in self._proposals() if one.change != Change())
        ordered = sorted(every, key=lambda one: _ORDER.index(one.purpose))
        return tuple(Step(self.analysis, k, one) for k, one in enumerate(ordered, start=1))

    def _proposals(self) -> Iterator[Proposal]:
        yield from map(self._as_it_stands, self.causes.mends)
        yield from undeclarations_of(self.analysis)
        yield from (*self.releases.sets, *self.releases.supports)
        yield from (*self.declarations.sets, *self.declarations.holds)
        if self.spaces is not None:
            yield from map(self._as_it_stands, self.spaces.proposals)

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
        is_exact = tried(self.analysis, change).verdict is Verdict.EXACT
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


def advice_of(result: Result, body: str | None = None, wanted: Sequence[str] = ()) -> Advice:
    """The advice on a mechanism.

    Args:
        result: Its analysis.
        body: The body whose freedom and constraint are looked at, by name.
        wanted: Motions that are meant to be free, such as "stage: translation z".

    Raises:
        ModelError: no body has this name, or a text is not understood.
    """
    made = Advice(result, body, (wanted,) if isinstance(wanted, str) else tuple(wanted))
    if body is not None or made.wanted:
        # What was asked for wrongly is told at once.
        _ = made.spaces
    return made
