# SPDX-License-Identifier: BSD-3-Clause
"""Work by an executor that somebody else has made, as of concurrent.futures."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from typing import Any

from ..util.loading import load
from ..util.processors import processors
from .errors import EngineError
from .running import Answer, Chunk, Source, timed

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
        return load("flexact.sweeps.dask_crew").DaskCrew(function, executor, workers)
    raise TypeError(
        "the executor must be one of concurrent.futures, a Dask client or its address, not "
        f"{type(executor).__name__}"
    )
