# SPDX-License-Identifier: BSD-3-Clause
"""Items in chunks that take about as long as a message is worth, and what comes back of them."""

from __future__ import annotations

import multiprocessing
import pickle
import time
import traceback
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, NamedTuple, Protocol

from ..util.errors import BatchError
from ..util.loading import load
from ..util.machine import processors


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


NOTHING = Chunk((), ())


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


def timed(
    function: Callable[[Any], Any], items: Sequence[Any]
) -> tuple[list[Any], float, Raised | None]:
    """Results of items up to the first that raises, their time [s], and what it raises."""
    results: list[Any] = []
    start = time.perf_counter()
    try:
        for item in items:
            results.append(function(item))
    except BaseException as error:
        return results, time.perf_counter() - start, raised(error)
    return results, time.perf_counter() - start, None


def raised(error: BaseException) -> Raised:
    """An exception, made fit to be sent."""
    trace = "".join(traceback.format_exception(type(error), error, error.__traceback__))
    try:
        # There are those that can be written and not be read again.
        pickle.loads(pickle.dumps(error))
    except Exception:
        error = EngineError(f"{type(error).__name__}: {error}")
    return Raised(error, trace)


#: Over an item that was alone so many workers die before it is given up.
_MOST_DEATHS = 2


class Done(NamedTuple):
    """What came of an item."""

    index: int  # type: ignore[assignment]
    """Its place among the items, in place of what tuples have of this name."""
    result: Any
    failure: str
    """Why there is no result, since workers died over it; empty where there is one."""


class Crew(Protocol):
    """Those who do the work."""

    @property
    def is_busy(self) -> bool:
        """Whether there is work in hand."""

    def feed(self, source: Source) -> None:
        """Take as much as there is room for."""

    def receive(self) -> list[Answer]:
        """Wait until something comes."""

    def close(self) -> None:
        """Stop at once."""


def results_of(
    function: Callable[[Any], Any],
    items: Iterable[Any],
    *,
    executor: Any = None,
    workers: int | None = None,
) -> Generator[Done, None, None]:
    """Apply a function to items by several workers; results as they come, in any order.

    Items are sent in chunks of some 40 ms of work, found as it runs, and taken as they are needed,
    so that there may be any number of them. A worker that dies is replaced; its items are done
    again one by one, and one over which a second worker dies has a `failure` in place of a
    result. Closing the iterator, or Ctrl-C, stops the workers at once.

    Args:
        function: What is applied; where processes are forked, as on Linux, any function.
        items: What it is applied to.
        executor: None, processes on this machine; "dask", the Dask client that there is, or a
            cluster on this machine; "tcp://host:port", a Dask scheduler; a Dask client; or any
            executor as of concurrent.futures.
        workers: So many processes on this machine, by default one a processor that may be used;
            1, no other than this one. With an executor, how many it has, if it does not say.

    Raises:
        EngineError: The work cannot be sent or done, or an executor is not there or lost.
        ValueError: `workers` is not positive.
        TypeError: `workers` is no whole number, or the executor none of these.
        Exception: What the function or the items raise is raised here.
    """
    if workers is not None and (isinstance(workers, bool) or not isinstance(workers, int)):
        raise TypeError(f"workers must be a whole number, not {type(workers).__name__}")
    if workers is not None and workers < 1:
        raise ValueError(f"workers must be 1 or more, not {workers}")
    crew = _crew(function, executor, workers)
    if crew is None:
        return (Done(k, function(item), "") for k, item in enumerate(items))
    return _run(crew, Source(items))


def _crew(function: Callable[[Any], Any], executor: Any, workers: int | None) -> Crew | None:
    """Those who do the work; None: this process alone."""
    if executor is not None:
        made: Crew = crew_of(function, executor, workers)
        return made
    count = processors() if workers is None else workers
    # A worker of a pool has one processor, and may have no children.
    if count == 1 or multiprocessing.current_process().daemon:
        return None
    pool: Crew = load("flexact.sweeps.pool").LocalPool(function, count)
    return pool


def _run(crew: Crew, source: Source) -> Generator[Done, None, None]:
    try:
        while True:
            crew.feed(source)
            if not crew.is_busy:
                break
            answers = crew.receive()
            failures = [done for answer in answers for done in _learnt(answer, source)]
            # Nobody waits for work while what has come is made use of.
            crew.feed(source)
            for answer in answers:
                yield from map(_done, answer.chunk.indices, answer.results)
            yield from failures
            for answer in answers:
                if answer.raised is not None:
                    raise answer.raised.again()
        if source.failure is not None:
            raise source.failure
    finally:
        crew.close()


def _done(index: int, result: Any) -> Done:
    return Done(index, result, "")


def _learnt(answer: Answer, source: Source) -> Iterator[Done]:
    """Have done again what is to be; give what is not, since too many died over it."""
    chunk = answer.chunk
    if answer.results or answer.raised is not None:
        source.learn(len(answer.results), answer.seconds)
    elif not answer.death:
        source.put_back(chunk)
    elif len(chunk.items) == 1 and chunk.deaths + answer.deaths >= _MOST_DEATHS:
        yield Done(chunk.indices[0], None, answer.death)
    else:
        source.repeat(chunk, answer.deaths)


_MEND = "go on with another one"


class ExecutorCrew:
    """Chunks as futures of an executor, two a worker at most."""

    def __init__(
        self, function: Callable[[Any], Any], executor: Executor, workers: int | None
    ) -> None:
        """Nothing is sent yet."""
        self._function, self._executor = function, executor
        self._workers = workers or _workers_of(executor)
        self._chunks: dict[Future[Any], Chunk] = {}

    @property
    def is_busy(self) -> bool:
        """Whether there is work in hand."""
        return bool(self._chunks)

    def feed(self, source: Source) -> None:
        """Send as many chunks as there is room for."""
        most = self._workers * (2 if source.are_short else 1)
        while len(self._chunks) < most and (chunk := source.next()) is not None:
            try:
                future = self._executor.submit(timed, self._function, chunk.items)
            except RuntimeError as error:
                raise EngineError(f"the executor takes no work ({error}); {_MEND}") from error
            self._chunks[future] = chunk

    def receive(self) -> list[Answer]:
        """What has come, at least something."""
        done = wait(self._chunks, return_when=FIRST_COMPLETED).done
        return [_answer(self._chunks.pop(future), future) for future in done]

    def close(self) -> None:
        """Take back what is not begun; the executor is somebody else's."""
        for future in self._chunks:
            future.cancel()


def _answer(chunk: Chunk, future: Future[Any]) -> Answer:
    try:
        results, seconds, error = future.result()
    except (BrokenExecutor, CancelledError) as reason:
        words = str(reason) or "cancelled"
        raise EngineError(f"the executor is broken ({words}); {_MEND}") from reason
    except Exception as reason:
        raise EngineError(
            f"the executor cannot send the function, an item or a result ({reason}): define the "
            "function in a module of its own, outside of other functions"
        ) from reason
    return Answer(chunk, results, seconds, error)


def _workers_of(executor: Executor) -> int:
    """How many workers an executor says that it has."""
    for name in ("num_workers", "_max_workers"):
        count = getattr(executor, name, None)
        if isinstance(count, int) and count > 0:
            return count
    return processors()


def crew_of(function: Callable[[Any], Any], executor: Any, workers: int | None) -> Any:
    """Those who do the work for one of the executors of `results_of`.

    Raises:
        EngineError: Dask is missing.
        ValueError: A text that is no address.
        TypeError: It is no executor.
    """
    if isinstance(executor, Executor):
        return ExecutorCrew(function, executor, workers)
    of_dask = type(executor).__module__.partition(".")[0] == "distributed"
    if isinstance(executor, str) and executor != "dask" and ":" not in executor:
        raise ValueError(f'the executor must be "dask" or as "tcp://host:port", not {executor!r}')
    if isinstance(executor, str) or of_dask:
        return load("flexact.sweeps.dask").DaskCrew(function, executor, workers)
    raise TypeError(
        "the executor must be one of concurrent.futures, a Dask client or its address, not "
        f"{type(executor).__name__}"
    )
