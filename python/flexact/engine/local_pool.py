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
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from ..base.errors import reason_of
from ..base.interruption import SIGNALS
from ..base.loading import load
from .chunks import NOTHING, Answer, Chunk, Source
from .errors import EngineError
from .worker import Part, serve

#: Forked processes are not safe with the libraries of macOS, and Windows has none.
FORKS = sys.platform not in ("darwin", "win32")
#: How often it is asked whether a worker whose line is silent is alive [s].
_LOOK = 1.0


class _Worker:
    """A process, its line, and the chunks that it was sent and has not finished."""

    def __init__(self, process: BaseProcess, line: Connection) -> None:
        self.process, self.line = process, line
        self.chunks: deque[Chunk] = deque()
        self.done = 0
        self.has_started = False

    def send(self, chunk: Chunk) -> None:
        self.chunks.append(chunk)
        try:
            self.line.send(chunk.items)
        except OSError:
            # It is dead, which is found where its answers are awaited.
            return
        except Exception as error:
            raise EngineError(f"an item cannot be sent to a worker process: {error}") from error

    def hear(self) -> list[Answer]:
        """What it says, or what there is to say where it is dead."""
        try:
            part = self.line.recv()
        except (EOFError, OSError):
            return self.buried()
        except Exception as error:
            raise EngineError(f"a result cannot be read: {error}") from error
        if not self.has_started:
            self.has_started = True
            return [Answer(NOTHING, raised=part.raised)] if part.raised else []
        return [self._answer(part)]

    def _answer(self, part: Part) -> Answer:
        chunk, first = self.chunks[0], self.done
        self.done += len(part.results)
        if part.is_last:
            self.chunks.popleft()
            self.done = 0
        some = chunk.part(first, first + len(part.results))
        return Answer(some, part.results, part.seconds, part.raised)

    def buried(self) -> list[Answer]:
        """What it leaves: what it was about, and what it had not begun."""
        self.stop()
        code = self.process.exitcode or 0
        if code > 0 and not self.has_started:
            raise EngineError(
                f"worker processes do not start (exit code {code}); a script that uses them "
                'needs `if __name__ == "__main__":` before what it does'
            )
        death = f"the worker process died ({_words_of(code)})"
        left = [Answer(chunk) for chunk in self.chunks]
        if left:
            begun = self.chunks[0]
            left[0] = Answer(begun.part(self.done, len(begun.items)), death=death)
        return left

    def stop(self) -> None:
        self.process.kill()
        self.process.join()
        self.line.close()


def _words_of(code: int) -> str:
    if code == -9:
        return "signal 9, as where memory runs out"
    return f"signal {-code}" if code < 0 else f"exit code {code}"


class LocalPool:
    """So many processes at most; each is started when there is work for it."""

    def __init__(self, function: Callable[[Any], Any], workers: int) -> None:
        """Nothing is started yet.

        Raises:
            EngineError: The function cannot be handed over.
        """
        self._context: Any = multiprocessing.get_context("fork" if FORKS else "spawn")
        self._function = function if FORKS else pickled(function)
        self._most = workers
        self._workers: list[_Worker] = []
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
            answers = [answer for worker in dead for answer in _last_words(worker)]
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
        self._workers.append(_Worker(process, mine))


def _last_words(worker: _Worker) -> list[Answer]:
    answers: list[Answer] = []
    while not worker.line.closed:
        answers += worker.hear() if worker.line.poll() else worker.buried()
    return answers


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
