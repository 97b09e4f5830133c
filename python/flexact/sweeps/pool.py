# SPDX-License-Identifier: BSD-3-Clause
"""Worker processes on this machine, each with a line of its own.

Unlike concurrent.futures.ProcessPoolExecutor it knows over which items a worker died, and of what;
it goes on with another one; it stops at once; and its workers end when this process is killed.
"""

from __future__ import annotations

import multiprocessing
import pickle
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import wait
from typing import Any

from ..util.errors import reason_of
from ..util.interruption import SIGNALS
from ..util.loading import load
from .errors import EngineError
from .member import Member
from .running import Answer, Source
from .worker import serve

#: Forked processes are not safe with the libraries of macOS, and Windows has none.
FORKS = sys.platform not in ("darwin", "win32")
#: Lines that Windows can wait for at once, but for a few.
_MOST_ON_WINDOWS = 60
#: How often it is asked whether a worker whose line is silent is alive [s].
_LOOK = 1.0


class LocalPool:
    """So many processes at most; each is started when there is work for it."""

    def __init__(self, function: Callable[[Any], Any], workers: int) -> None:
        """Nothing is started yet.

        Raises:
            EngineError: The function cannot be handed over.
        """
        self._context: Any = multiprocessing.get_context("fork" if FORKS else "spawn")
        self._function = function if FORKS else pickled(function)
        self._most = min(workers, _MOST_ON_WINDOWS) if sys.platform == "win32" else workers
        self._workers: list[Member] = []
        # Those that are forked have it then.
        load("threadpoolctl")

    @property
    def is_busy(self) -> bool:
        """Whether there is work in hand."""
        return any(worker.chunks for worker in self._workers)

    def feed(self, source: Source) -> None:
        """Give every worker that has room something to do."""
        # What is short may wait behind another, so that no worker ever waits for its next.
        for depth in range(2 if source.are_short else 1):
            for worker in [w for w in self._workers if len(w.chunks) == depth]:
                if (chunk := source.next()) is None:
                    return
                worker.send(chunk)
            while len(self._workers) < self._most:
                if (chunk := source.next()) is None:
                    return
                self._start()
                self._workers[-1].send(chunk)

    def receive(self) -> list[Answer]:
        """What has come, at least something unless a worker died that had nothing to do."""
        workers = {worker.line: worker for worker in self._workers}
        heard = [workers[line] for line in wait(list(workers), _LOOK) if line in workers]
        answers = [answer for worker in heard for answer in worker.hear()]
        if not heard:
            # Children of a worker can hold its line open.
            dead = [worker for worker in self._workers if not worker.process.is_alive()]
            answers = [answer for worker in dead for answer in worker.last_words()]
        self._workers = [worker for worker in self._workers if not worker.line.closed]
        return answers

    def close(self) -> None:
        """Stop all workers at once."""
        for worker in self._workers:
            worker.process.kill()
        while self._workers:
            self._workers.pop().stop()

    def _start(self) -> None:
        mine, its = self._context.Pipe()
        others = [worker.line for worker in self._workers] + [mine] if FORKS else []
        process = self._context.Process(
            target=serve, args=(self._function, its, others), name="flexact-worker", daemon=True
        )
        try:
            with _undisturbed():
                process.start()
        except OSError as error:
            mine.close()
            raise EngineError(
                f"no worker process can be started: {reason_of(error)}; ask for fewer workers"
            ) from error
        finally:
            its.close()
        self._workers.append(Member(process, mine))


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Signals wait, in a child until it has handlers of its own; and no word about threads."""
    blocks = hasattr(signal, "pthread_sigmask")
    before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS) if blocks else ()
    try:
        with warnings.catch_warnings():
            # Those of BLAS and of notebooks hold nothing that a worker needs.
            warnings.filterwarnings("ignore", category=DeprecationWarning, message=".*fork")
            yield
    finally:
        if blocks:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def pickled(function: Callable[[Any], Any]) -> bytes:
    """A function as bytes.

    Raises:
        EngineError: It has none.
    """
    try:
        return pickle.dumps(function)
    except Exception as error:
        raise EngineError(
            f"the function cannot be sent to other processes ({error}): define it in a module "
            "of its own, outside of other functions"
        ) from error
