# SPDX-License-Identifier: BSD-3-Clause
"""Work on a Dask cluster, whose client is found or opened, watched, and closed if opened here."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import lru_cache
from queue import Empty, SimpleQueue
from typing import Any, cast

from ..util.loading import load
from ..util.machine import processors
from .chunks import Answer, Chunk, EngineError, Part, Raised, Source, timed

#: How long a scheduler may take to answer, and how long there may be no worker [s].
_ANSWER, _NO_WORKER = 10.0, 60.0
#: How often workers are counted [s].
LOOK = 2.0


def _set_levels(levels: dict[str, int]) -> None:
    for name, level in levels.items():
        logging.getLogger(name).setLevel(level)


#: What a chunk should take at least [s]: master, scheduler and worker take some 5 ms for it.
LEAST_SECONDS = 0.25
#: What a scheduler is given to do at most [chunks/s]: it can do some four times as much.
CHUNKS_PER_SECOND = 100.0


def timed_there(function: bytes, items: bytes) -> bytes:
    """What a worker is asked to do, in pickles: what cannot be sent is found where it is made."""
    pickle = load("cloudpickle")
    found = timed(_read(function), pickle.loads(items))
    try:
        return bytes(pickle.dumps(found))
    except Exception as error:
        reason = EngineError(f"a result cannot be sent from a Dask worker: {error}")
        return bytes(pickle.dumps(Part(raised=Raised(reason, ""))))


@lru_cache(maxsize=4)
def _read(pickled: bytes) -> Callable[[Any], Any]:
    return cast("Callable[[Any], Any]", load("cloudpickle").loads(pickled))


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
        try:
            self._dask: Any = load("distributed")
        except ImportError as error:
            raise EngineError(
                f"Dask needs the package distributed: pip install distributed ({error})"
            ) from error
        self._function = _pickled(function, "the function")
        self._executor, self._count = executor, workers
        self._client: Any = None
        self._own: list[Any] = []
        self._levels: dict[str, int] = {}
        self._is_lost = False
        # Threads of all workers, when they were last counted.
        self._threads, self._looked, self._had_workers = 0, 0.0, 0.0
        self._chunks: dict[Any, Chunk] = {}
        self._finished: SimpleQueue[Any] = SimpleQueue()

    @property
    def is_busy(self) -> bool:
        """Whether there is work in hand."""
        return bool(self._chunks)

    def feed(self, source: Source) -> None:
        """Send as many chunks as there is room for."""
        self._look()
        source.chunk_seconds = max(LEAST_SECONDS, self._threads / CHUNKS_PER_SECOND)
        most = max(1, self._threads) * (2 if source.are_short else 1)
        while len(self._chunks) < most and (chunk := source.next()) is not None:
            items = _pickled(chunk.items, "an item")
            try:
                future = self._client.submit(timed_there, self._function, items, pure=False)
            except Exception as error:
                raise self._lost(error) from error
            self._chunks[future] = chunk
            future.add_done_callback(self._finished.put)

    def receive(self) -> list[Answer]:
        """What has come; nothing where a while went by without."""
        done = []
        with suppress(Empty):
            done.append(self._finished.get(timeout=LOOK))
            while True:
                done.append(self._finished.get_nowait())
        self._look()
        # A worker that dies takes results along that nobody had fetched yet.
        gone = [future for future in done if future.status in ("cancelled", "lost")]
        bad = [future for future in done if future.status == "error"]
        good = [future for future in done if future not in (*gone, *bad)]
        try:
            found = self._client.gather(good)
        except Exception as error:
            raise self._lost(error) from error
        chunks = {future: self._chunks.pop(future) for future in done}
        answers = [_answer(chunks[f], made) for f, made in zip(good, found, strict=True)]
        answers += [Answer(chunks[future]) for future in gone]
        return answers + [self._failed(chunks[future], future.exception()) for future in bad]

    def close(self) -> None:
        """Take back what is not done, and close what was opened here."""
        with suppress(Exception):
            if self._client.status == "running":
                self._client.cancel(list(self._chunks))
        for each in self._own:
            with suppress(Exception):
                each.close(timeout=_ANSWER)
        # It has words of its own about a connection that was lost, some of them late.
        if not self._is_lost:
            _set_levels(self._levels)
        self._chunks.clear()

    def _look(self) -> None:
        """Find or open a client, and count its workers, now and then.

        Raises:
            EngineError: There is none, it is lost, or has had no worker for long.
        """
        if self._client is None:
            self._client = self._found() or self._opened()
        now = time.monotonic()
        if self._client.status != "running":
            raise self._lost("the connection is broken")
        if self._looked and now - self._looked < LOOK:
            return
        try:
            self._threads = sum(self._client.nthreads().values())
        except Exception as error:
            raise self._lost(error) from error
        if self._threads or not self._looked:
            self._had_workers = now
        elif now - self._had_workers > _NO_WORKER:
            raise EngineError(
                f"the Dask scheduler has had no worker for {_NO_WORKER:.0f} s; start some, such as "
                f"`dask worker {self._address()}`, and try again"
            )
        self._looked = now

    def _lost(self, reason: object) -> EngineError:
        """What is said where a scheduler is lost."""
        self._is_lost = True
        words = (str(reason) or type(reason).__name__).splitlines()[0]
        return EngineError(
            f"the Dask scheduler at {self._address()} was lost ({words}): start it again, then "
            "what was not done"
        )

    def _address(self) -> str:
        scheduler = getattr(self._client, "scheduler", None)
        known = self._executor if isinstance(self._executor, str) else "its address"
        return str(getattr(scheduler, "address", None) or known)

    def _found(self) -> Any:
        if self._executor == "dask":
            with suppress(ValueError):
                return self._dask.default_client()
        if isinstance(self._executor, str):
            return None
        if self._executor.asynchronous:
            raise EngineError("an asynchronous Dask client cannot be used: give its address")
        return self._executor

    def _opened(self) -> Any:
        self._levels = {
            name: logging.getLogger(name).level
            for name in logging.root.manager.loggerDict
            if name.startswith("distributed")
        }
        _set_levels(dict.fromkeys(self._levels, logging.CRITICAL + 1))
        where = self._executor
        try:
            if where == "dask":
                cluster = self._dask.LocalCluster(
                    n_workers=self._count or processors(),
                    threads_per_worker=1,
                    dashboard_address="127.0.0.1:0",
                    silence_logs=logging.CRITICAL,
                )
                self._own.append(cluster)
                where = cluster.scheduler_address
            configured = load("dask").config.get("distributed.comm.timeouts.connect")
            wait = min(_ANSWER, float(load("dask.utils").parse_timedelta(configured)))
            client = self._dask.Client(where, timeout=wait, set_as_default=False)
        except Exception as error:
            self._is_lost = True
            words = (
                f"no Dask cluster can be started on this machine: {error}"
                if self._executor == "dask"
                else f"no Dask scheduler answers at {self._executor}; start one (`dask scheduler`, "
                f"then `dask worker {self._executor}`), or mend the address"
            )
            raise EngineError(words) from error
        self._own.insert(0, client)
        return client

    def _failed(self, chunk: Chunk, error: BaseException) -> Answer:
        if isinstance(error, self._dask.KilledWorker):
            count = error.allowed_failures + 1
            words = f"the worker process died (so did {count} Dask workers)"
            return Answer(chunk, death=words, deaths=count)
        raise EngineError(
            f"a Dask worker cannot do the work ({type(error).__name__}: {error}): the workers need "
            "the same versions of Flexact and Python, and the modules of the function"
        ) from error


def _pickled(given: Callable[[Any], Any] | Sequence[Any], what: str) -> bytes:
    try:
        return bytes(load("cloudpickle").dumps(given))
    except Exception as error:
        raise EngineError(f"{what} cannot be sent to Dask workers: {error}") from error


def _answer(chunk: Chunk, made: bytes) -> Answer:
    try:
        return Answer(chunk, *load("cloudpickle").loads(made)[:3])
    except Exception as error:
        raise EngineError(f"a result cannot be read: {error}") from error
