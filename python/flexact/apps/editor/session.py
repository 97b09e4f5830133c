# SPDX-License-Identifier: BSD-3-Clause
"""An open deck: its problems while it is typed, its verdict when typing rests, then steps."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field

from .advisor import Advice, Advisor
from .background import OneAtATime, beside
from .editor_deck import Deck
from .editor_problems import Problem, problems_of
from .problems import Opinion, advice_on, opinion_on

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


@dataclass(frozen=True)
class Work:
    """What all sessions share.

    Attributes:
        advisor: Who finds steps.
        queue: Where what takes long waits for its turn.
    """

    advisor: Advisor
    queue: OneAtATime = field(default_factory=OneAtATime)


class Session:
    """The states of one open deck; what comes too late is dropped."""

    def __init__(self, deck: Deck, tell: Callable[[Seen], None], work: Work) -> None:
        """Start to look at it; `tell` is called when something is known."""
        self._tell, self._work = tell, work
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
            seen.opinion = await self._work.queue.run(lambda: opinion_on(deck))
            self._tell(seen)
            opinion = seen.opinion
            if opinion is not None and opinion.result is not None:
                seen.advice = await self._work.queue.run(
                    lambda: advice_on(opinion, self._work.advisor)
                )
        finally:
            seen.is_done.set()
