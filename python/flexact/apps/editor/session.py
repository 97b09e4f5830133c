# SPDX-License-Identifier: BSD-3-Clause
"""What becomes known of an open deck after each change: problems, the verdict, steps."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from ...advice.advice import Advice
from .deck import Deck
from .problems import Opinion, Problem, advice_on, opinion_on, problems_of

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
            is_large = len(deck.document.lines) > _LINES_OF_LARGE
            rest = _OF_LARGE if is_large else 0.0
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
