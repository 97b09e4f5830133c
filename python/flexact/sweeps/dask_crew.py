# SPDX-License-Identifier: BSD-3-Clause
"""Work by the workers of a Dask cluster."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import lru_cache
from queue import Empty, SimpleQueue
from typing import Any

from ..util.loading import load
from . import dask as dask_client
from .dask import DaskClient, dask_or_error
from .errors import EngineError
from .running import Answer, Chunk, Raised, Source, timed

#: What a chunk should take at least [s]: master, scheduler and worker take some 5 ms for it.
LEAST_SECONDS = 0.25
#: What a scheduler is given to do at most [chunks/s]: it can do some four times as much.
CHUNKS_PER_SECOND = 100.0


def timed_there(function: bytes, items: bytes) -> bytes:
    """What a worker is asked to do, in pickles: what cannot be sent is found where it is made."""
    pickle = load("cloudpickle")
    found = timed(_read(function), pickle.loads(items))
    try:
        made: bytes = pickle.dumps(found)
    except Exception as error:
        reason = EngineError(f"a result cannot be sent from a Dask worker: {error}")
        made = pickle.dumps(([], 0.0, Raised(reason, "")))
    return made


@lru_cache(maxsize=4)
def _read(pickled: bytes) -> Callable[[Any], Any]:
    function: Callable[[Any], Any] = load("cloudpickle").loads(pickled)
    return function


class DaskCrew:
    """Chunks as futures of a Dask client, two a thread of the workers at most."""

    def __init__(self, function: Callable[[Any], Any], executor: Any, workers: int | None) -> None:
        """Nothing is opened or sent yet.

        Args:
            function: What is applied.
            executor: A client, the address of a scheduler, or "dask".
            workers: Of a cluster that is to be started on this machine.

        Raises:
            EngineError: Dask is missing, or the function cannot be sent.
        """
        self._killed = dask_or_error().KilledWorker
        self._function = _pickled(function, "the function")
        self._where = executor, workers
        self._cluster: DaskClient | None = None
        self._chunks: dict[Any, Chunk] = {}
        self._finished: SimpleQueue[Any] = SimpleQueue()

    @property
    def is_busy(self) -> bool:
        """Whether there is work in hand."""
        return bool(self._chunks)

    def feed(self, source: Source) -> None:
        """Send as many chunks as there is room for."""
        cluster = self._opened()
        cluster.look()
        source.chunk_seconds = max(LEAST_SECONDS, cluster.threads / CHUNKS_PER_SECOND)
        most = max(1, cluster.threads) * (2 if source.are_short else 1)
        while len(self._chunks) < most and (chunk := source.next()) is not None:
            items = _pickled(chunk.items, "an item")
            try:
                future = cluster.client.submit(timed_there, self._function, items, pure=False)
            except Exception as error:
                raise cluster.lost(error) from error
            self._chunks[future] = chunk
            future.add_done_callback(self._finished.put)

    def receive(self) -> list[Answer]:
        """What has come; nothing where a while went by without."""
        done = []
        with suppress(Empty):
            done.append(self._finished.get(timeout=dask_client.LOOK))
            while True:
                done.append(self._finished.get_nowait())
        cluster = self._opened()
        cluster.look()
        # A worker that dies takes results along that nobody had fetched yet.
        gone = [future for future in done if future.status in ("cancelled", "lost")]
        done = [future for future in done if future not in gone]
        good = [future for future in done if future.status != "error"]
        try:
            found = cluster.client.gather(good)
        except Exception as error:
            raise cluster.lost(error) from error
        chunks = {future: self._chunks.pop(future) for future in done}
        answers = [_answer(chunks[f], made) for f, made in zip(good, found, strict=True)]
        bad = [future for future in done if future.status == "error"]
        answers += [Answer(self._chunks.pop(future)) for future in gone]
        return answers + [self._failed(chunks[future], future.exception()) for future in bad]

    def close(self) -> None:
        """Take back what is not done, and close what was opened here."""
        if self._cluster is not None:
            self._cluster.close(self._chunks)
        self._chunks.clear()

    def _opened(self) -> DaskClient:
        if self._cluster is None:
            self._cluster = DaskClient(*self._where)
        return self._cluster

    def _failed(self, chunk: Chunk, error: BaseException) -> Answer:
        if isinstance(error, self._killed):
            count = error.allowed_failures + 1
            words = f"the worker process died (so did {count} Dask workers)"
            return Answer(chunk, death=words, deaths=count)
        raise EngineError(
            f"a Dask worker cannot do the work ({type(error).__name__}: {error}): the workers need "
            "the same versions of Flexact and Python, and the modules of the function"
        ) from error


def _pickled(given: Callable[[Any], Any] | Sequence[Any], what: str) -> bytes:
    try:
        made: bytes = load("cloudpickle").dumps(given)
    except Exception as error:
        raise EngineError(f"{what} cannot be sent to Dask workers: {error}") from error
    return made


def _answer(chunk: Chunk, made: bytes) -> Answer:
    try:
        return Answer(chunk, *load("cloudpickle").loads(made))
    except Exception as error:
        raise EngineError(f"a result cannot be read: {error}") from error
