# SPDX-License-Identifier: BSD-3-Clause
"""What becomes known of an open deck after each change: problems, the verdict, steps."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeVar

from ...advice.advice import Advice, advice_of
from ...analysis.decomposition import Asked
from ...analysis.mode_words import (
    conflict_in_words,
    internal_in_words,
    motion_in_parts,
    stress_in_parts,
)
from ...analysis.naming import Named, Pieces, plain
from ...analysis.result import Result, result_of
from ...analysis.verdict import Verdict
from ...analysis.verdict_words import margin_in_short, verdict_in_short, warnings_of
from ...deck.diagnostics import Diagnostic, Place, Severity
from ...util.errors import FlexactError
from ...util.text import harmless
from .deck import Deck, Document, Position, Range


class Remark(NamedTuple):
    """What stands at another place of a problem."""

    range: Range
    text: str


class Problem(NamedTuple):
    """A problem at its place.

    Attributes:
        range: Where it is.
        severity: How grave it is.
        code: Its code.
        message: What is wrong.
        remarks: What is said besides, and where: the label, the other place, the help.
        help: How to mend it.
    """

    range: Range
    severity: Severity
    code: str
    message: str
    remarks: tuple[Remark, ...] = ()
    help: str = ""


def problems_of(deck: Deck) -> list[Problem]:
    """All that was found, in the order of the places."""
    problems = deck.problems
    made = [_problem(deck.document, item) for item in problems.kept]
    more = problems.total - len(problems.kept)
    if more > 0:
        words = f"and {more} more problem{'s' if more > 1 else ''}"
        made.append(Problem(first_line(deck.document), Severity.NOTE, "more", words))
    return made


def first_line(document: Document) -> Range:
    """All of the first line."""
    return Range.within(0, 0, len(document.bare[0]))


def _problem(document: Document, item: Diagnostic) -> Problem:
    place = Place(item.line, item.column, item.last_column)
    range_ = _range(document, place) if item.line > 0 else first_line(document)
    remarks = []
    if item.label:
        remarks.append(Remark(range_, harmless(item.label)))
    if item.other is not None:
        other = "first here" if item.other < (item.line, item.column) else "and here"
        remarks.append(Remark(_range(document, item.other), other))
    if item.help:
        remarks.append(Remark(range_, f"help: {harmless(item.help)}"))
    return Problem(
        range_,
        item.severity,
        item.code,
        harmless(item.message),
        tuple(remarks),
        item.help,
    )


def _range(document: Document, place: Place) -> Range:
    start = document.place_of(place.line, place.column)
    end = document.place_of(place.line, max(place.last_column, place.column) + 1)
    return Range(start, max(start, Position(*end)))


#: Motions, and self-stresses, that are said one by one, and what takes part in each.
_MOST, _PARTS = 4, 4
#: Elements up to which steps are looked for.
LARGEST_FOR_STEPS = 1500


@dataclass(frozen=True, eq=False)
class Opinion:
    """What an analysis says.

    Attributes:
        words: Such as "over-constrained by 1; margin 12 um"; why there is none where the
            analysis failed.
        verdict: The verdict; None where there is none.
        remarks: Motions, self-stresses and doubts, at the elements and nodes that take part.
        result: The result; None where there is none.
    """

    words: str
    verdict: Verdict | None
    remarks: tuple[Remark, ...] = ()
    result: Result | None = None


def opinion_on(deck: Deck) -> Opinion | None:
    """The verdict on a deck; None where it has errors."""
    data = deck.data
    if data is None:
        return None
    try:
        result: Result = result_of(data, Asked(), "deck", None, Result)
        return Opinion(
            f"{verdict_in_short(result)}; {margin_in_short(result)}",
            result.verdict,
            tuple(_remarks(deck, result)),
            result,
        )
    except (FlexactError, MemoryError) as error:
        return Opinion(f"no verdict: {harmless(str(error)).splitlines()[0]}", None)


def advice_on(opinion: Opinion) -> Advice | None:
    """Steps that mend the mechanism; None where nothing is to be mended, or it is too large."""
    result = opinion.result
    if result is None or result.verdict is Verdict.EXACT:
        return None
    if result.given.arrays.element_number.size > LARGEST_FOR_STEPS:
        return None
    try:
        advice = advice_of(result)
        _ = advice.steps
    except (FlexactError, MemoryError):
        return None
    return advice


def _remarks(deck: Deck, result: Result) -> list[Remark]:
    made = []
    internal = internal_in_words(result)
    motions = [one for one in result.motions if not (internal and one.is_internal)]
    for number, motion in enumerate(motions[:_MOST], start=1):
        moving = _listed(motion_in_parts(motion, _PARTS))
        made.append(_remark(deck, f"motion {number}: ", moving, moving))
    if internal:
        made.append(Remark(first_line(deck.document), internal))
    for number, stress in enumerate(result.self_stresses[:_MOST], start=1):
        carried = _listed(stress_in_parts(stress, _PARTS))
        words = conflict_in_words(stress) or carried
        made.append(_remark(deck, f"self-stress {number}: ", words, carried))
    doubts = warnings_of(result)[len(result.data.problems.kept) :]
    start = first_line(deck.document)
    return made + [Remark(start, harmless(item.message)) for item in doubts]


def _listed(parts: Sequence[Pieces]) -> Pieces:
    """Several pieces as one list."""
    apart = [piece for one in parts for piece in ("; ", *one)]
    return tuple(apart[1:])


def _remark(deck: Deck, head: str, words: Pieces, carried: Pieces) -> Remark:
    """A remark where the first of what takes part stands."""
    named = next((piece for piece in (*carried, *words) if isinstance(piece, Named)), None)
    where = deck.index.definition((named.kind, named.number)) if named is not None else []
    return Remark(where[0] if where else first_line(deck.document), f"{head}{plain(words)}")


Made = TypeVar("Made")


async def beside(work: Callable[[], Made]) -> Made:
    """What some work gives, which runs in a thread of its own while others are answered."""
    return await asyncio.shield(_started(work))


def _started(work: Callable[[], Made]) -> asyncio.Future[Made]:
    loop = asyncio.get_running_loop()
    future: asyncio.Future[Made] = loop.create_future()
    # Nobody may be left to hear of it.
    future.add_done_callback(lambda done: done.cancelled() or done.exception())

    def tell(give: Callable[[Any], None], what: object) -> None:
        if not future.done():
            give(what)

    def run() -> None:
        give: Callable[[Any], None] = future.set_result
        what: object
        try:
            what = work()
        except BaseException as error:
            give, what = future.set_exception, error
        if not loop.is_closed():
            loop.call_soon_threadsafe(tell, give, what)

    threading.Thread(target=run, name="flexact", daemon=True).start()
    return future


class OneAtATime:
    """Long work, of which the next starts when the last has ended, wanted or not.

    The core cannot be stopped halfway; so no more than one processor is busy for nothing.
    """

    def __init__(self) -> None:
        """Nothing is going on."""
        self._last: asyncio.Future[object] | None = None

    async def run(self, work: Callable[[], Made]) -> Made:
        """Wait for what is going on, then do the work; a task that is cancelled starts nothing."""
        while self._last is not None and not self._last.done():
            await asyncio.wait([self._last])
        future = _started(work)
        self._last = future  # type: ignore[assignment]
        return await asyncio.shield(future)


#: Seconds without a change after which a deck is read, then analysed; and of large ones.
_READ, _ANALYSE = 0.08, 0.35
_LINES_OF_LARGE, _OF_LARGE = 20_000, 0.4


@dataclass
class Seen:
    """What is known of a deck at one moment.

    Attributes:
        deck: The deck.
        problems: What is wrong with it; None while it is not read.
        opinion: The verdict; None while there is none.
        advice: Steps that mend it; None while or where there are none.
        is_done: Whether nothing more will come.
    """

    deck: Deck
    problems: list[Problem] | None = None
    opinion: Opinion | None = None
    advice: Advice | None = None
    is_done: asyncio.Event = field(default_factory=asyncio.Event)


class Session:
    """The states of one open deck; what comes too late is dropped."""

    def __init__(self, deck: Deck, tell: Callable[[Seen], None], queue: OneAtATime) -> None:
        """Start to look at it; `tell` is called when something is known.

        What takes long waits in the queue, which all sessions share, for its turn.
        """
        self._tell, self._queue = tell, queue
        self._task: asyncio.Task[None] | None = None
        self.seen = Seen(deck)
        self.change(deck, is_new=True)

    @property
    def deck(self) -> Deck:
        """The deck as it is now."""
        return self.seen.deck

    def change(self, deck: Deck, is_new: bool = False) -> None:
        """The deck as it is from now on."""
        self.close()
        self.seen = Seen(deck)
        self._task = asyncio.get_running_loop().create_task(self._look(self.seen, is_new))

    def close(self) -> None:
        """Look no more."""
        if self._task is not None:
            self._task.cancel()
        self.seen.is_done.set()

    async def _look(self, seen: Seen, is_new: bool) -> None:
        try:
            deck = seen.deck
            rest = _OF_LARGE if len(deck.document.lines) > _LINES_OF_LARGE else 0.0
            await asyncio.sleep(0.0 if is_new else _READ + rest)
            seen.problems = await beside(lambda: problems_of(deck))
            self._tell(seen)
            if deck.data is None:
                return
            await asyncio.sleep(_ANALYSE + rest)
            seen.opinion = await self._queue.run(lambda: opinion_on(deck))
            self._tell(seen)
            opinion = seen.opinion
            if opinion is not None and opinion.result is not None:
                seen.advice = await self._queue.run(lambda: advice_on(opinion))
        finally:
            seen.is_done.set()
