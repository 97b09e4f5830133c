# SPDX-License-Identifier: BSD-3-Clause
"""A function applied to many items, wherever there are workers."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Generator, Iterable, Iterator
from typing import Any, NamedTuple, Protocol

from ..util.loading import load
from ..util.processors import processors
from .running import Answer, Source

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
        module = load("flexact.sweeps.executors")
        made: Crew = module.crew_of(function, executor, workers)
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
