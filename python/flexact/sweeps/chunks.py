# SPDX-License-Identifier: BSD-3-Clause
"""Items in chunks that take about as long as a message is worth, and what comes back of them."""

from __future__ import annotations

import math
import pickle
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, NamedTuple

from ..util.errors import BatchError


class EngineError(BatchError):
    """Work cannot be done, or cannot go on, for a reason that is not in the work itself."""


#: What a chunk should take [s].
CHUNK_SECONDS = 0.04
#: So many items a chunk at most, however quick they are: they wait in memory.
MOST_ITEMS = 1000


class Chunk(NamedTuple):
    """Some items with their places; `deaths`: workers that died over one that was alone."""

    indices: Sequence[int]
    items: Sequence[Any]
    deaths: int = 0

    def part(self, start: int, stop: int) -> Chunk:
        """Some of it."""
        return Chunk(self.indices[start:stop], self.items[start:stop], self.deaths)


class Raised(NamedTuple):
    """What a function raised, in words where it cannot be sent, and where it did so."""

    error: BaseException
    trace: str

    def again(self) -> BaseException:
        """The exception, with where it was raised as its cause."""
        self.error.__cause__ = RemoteError(f'\n"""\n{self.trace}"""')
        return self.error


class RemoteError(Exception):
    """Where an exception was raised in another process."""


class Answer(NamedTuple):
    """What came of a chunk, or of a part of one."""

    chunk: Chunk
    """Where there is a result of each item, what was done; else what is to be done again."""
    results: Sequence[Any] = ()
    seconds: float = 0.0
    """What they took."""
    raised: Raised | None = None
    """What the item behind them raised."""
    death: str = ""
    """How a worker died over what is to be done again; empty where it had not begun."""
    deaths: int = 1
    """How many did."""


@dataclass
class Source:
    """Where chunks come from: items as they are needed, and first those to be done again.

    Attributes:
        items: The items.
        chunk_seconds: What a chunk should take.
        failure: What the items raised instead of the next; work in hand is finished first.
    """

    items: Iterable[Any]
    chunk_seconds: float = CHUNK_SECONDS
    failure: Exception | None = None
    _again: deque[Chunk] = field(default_factory=deque)
    _seconds: float | None = None
    _size: int = 1
    _taken: int = 0

    def __post_init__(self) -> None:
        """Nothing is taken yet."""
        self._left = iter(self.items)

    @property
    def are_short(self) -> bool:
        """Whether items are known to be so short that one chunk may wait behind another."""
        return self._seconds is not None and self._seconds < self.chunk_seconds

    def next(self) -> Chunk | None:
        """What is to be done next; None where there is no more."""
        if self._again:
            return self._again.popleft()
        if self.failure is not None:
            return None
        items: list[Any] = []
        try:
            items.extend(islice(self._left, self._size))
        except Exception as error:
            self.failure = error
        first = self._taken
        self._taken += len(items)
        return Chunk(range(first, self._taken), items) if items else None

    def learn(self, count: int, seconds: float) -> None:
        """Fit the size of chunks to what some items took."""
        if count:
            of_one = seconds / count
            before = of_one if self._seconds is None else self._seconds
            self._seconds = 0.5 * (before + of_one)
            fitting = int(self.chunk_seconds / max(self._seconds, 1e-9))
            self._size = max(1, min(fitting, 2 * self._size, MOST_ITEMS))

    def put_back(self, chunk: Chunk) -> None:
        """Have a chunk done that was not begun."""
        self._again.append(chunk)

    def repeat(self, chunk: Chunk, deaths: int) -> None:
        """Have the items of a chunk over which workers died done again, one by one."""
        # Which of several it was is not known.
        deaths = chunk.deaths + deaths if len(chunk.items) == 1 else 0
        for index, item in zip(chunk.indices, chunk.items, strict=True):
            self._again.append(Chunk((index,), (item,), deaths))


class Part(NamedTuple):
    """Results of the next items of a chunk, and whether it ends with them."""

    results: Sequence[Any] = ()
    seconds: float = 0.0
    """What they took."""
    raised: Raised | None = None
    """What the item behind them raised."""
    is_last: bool = False


def parts_of(
    function: Callable[[Any], Any], items: Sequence[Any], flush: float = math.inf
) -> Iterator[Part]:
    """What comes of items up to the first that raises, so that what is done is soon known.

    Args:
        function: What is applied.
        items: One at least.
        flush: Results that are there are not held back for longer [s].
    """
    results: list[Any] = []
    start = time.perf_counter()
    for left, item in zip(reversed(range(len(items))), items, strict=True):
        try:
            results.append(function(item))
        except BaseException as error:
            yield Part(results, time.perf_counter() - start, raised(error), True)
            return
        seconds = time.perf_counter() - start
        if not left or seconds > flush:
            yield Part(results, seconds, None, not left)
            results, start = [], time.perf_counter()


def timed(function: Callable[[Any], Any], items: Sequence[Any]) -> Part:
    """What comes of items, at once."""
    return next(parts_of(function, items))


def raised(error: BaseException) -> Raised:
    """An exception, made fit to be sent."""
    trace = "".join(traceback.format_exception(type(error), error, error.__traceback__))
    try:
        # There are those that can be written and not be read again.
        pickle.loads(pickle.dumps(error))
    except Exception:
        error = EngineError(f"{type(error).__name__}: {error}")
    return Raised(error, trace)
