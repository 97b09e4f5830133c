# SPDX-License-Identifier: BSD-3-Clause
"""Many items done by several workers: processes here, a Dask cluster, or an executor."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from typing import Any, NamedTuple, Protocol

from ..util.loading import load
from ..util.machine import processors
from .chunks import Answer, Chunk, EngineError, Source, timed

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
    require_workers(workers)
    crew = _crew(function, executor, workers)
    if crew is None:
        return (Done(k, function(item), "") for k, item in enumerate(items))
    return _run(crew, Source(items))


def require_workers(workers: object) -> None:
    """Raise unless it is a number of workers, or None.

    Raises:
        TypeError: It is no whole number.
        ValueError: It is not positive.
    """
    if workers is None:
        return
    if isinstance(workers, bool) or not isinstance(workers, int):
        raise TypeError(f"workers must be a whole number, not {type(workers).__name__}")
    if workers < 1:
        raise ValueError(f"workers must be 1 or more, not {workers}")


def _crew(function: Callable[[Any], Any], executor: Any, workers: int | None) -> Crew | None:
    """Those who do the work; None: this process alone."""
    crew: Crew
    if executor is None:
        count = processors() if workers is None else workers
        # A worker of a pool has one processor, and may have no children.
        if count == 1 or multiprocessing.current_process().daemon:
            return None
        crew = load("flexact.sweeps.pool").LocalPool(function, count)
        return crew
    if isinstance(executor, Executor):
        return ExecutorCrew(function, executor, workers)
    if isinstance(executor, str) and executor != "dask" and ":" not in executor:
        raise ValueError(f'the executor must be "dask" or as "tcp://host:port", not {executor!r}')
    if isinstance(executor, str) or type(executor).__module__.split(".")[0] == "distributed":
        crew = load("flexact.sweeps.dask").DaskCrew(function, executor, workers)
        return crew
    raise TypeError(
        "the executor must be one of concurrent.futures, a Dask client or its address, not "
        f"{type(executor).__name__}"
    )


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
                for index, result in zip(answer.chunk.indices, answer.results, strict=False):
                    yield Done(index, result, "")
            yield from failures
            for answer in answers:
                if answer.raised is not None:
                    raise answer.raised.again()
        if source.failure is not None:
            raise source.failure
    finally:
        crew.close()


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
        said = [getattr(executor, name, None) for name in ("num_workers", "_max_workers")]
        counts = [count for count in said if isinstance(count, int) and count > 0]
        self._workers = workers or next(iter(counts), 0) or processors()
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
        return Answer(chunk, *future.result()[:3])
    except (BrokenExecutor, CancelledError) as reason:
        words = str(reason) or "cancelled"
        raise EngineError(f"the executor is broken ({words}); {_MEND}") from reason
    except Exception as reason:
        raise EngineError(
            f"the executor cannot send the function, an item or a result ({reason}): define the "
            "function in a module of its own, outside of other functions"
        ) from reason
