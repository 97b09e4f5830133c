# SPDX-License-Identifier: BSD-3-Clause
"""Worker processes on this machine, each with a line of its own.

Unlike concurrent.futures.ProcessPoolExecutor it knows over which items a worker died, and of what;
it goes on with another one; it stops at once; and its workers end when this process is killed.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import sys
import threading
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from queue import SimpleQueue
from typing import Any, cast

from ..util.errors import reason_of
from ..util.interruption import SIGNALS
from ..util.loading import load
from .chunks import Answer, Chunk, EngineError, Part, Raised, Source, parts_of

#: Results that are there are not held back for longer [s].
_FLUSH = 0.05


def serve(
    function: Callable[[Any], Any] | bytes, line: Connection, others: Iterable[Connection]
) -> None:
    """Do chunks of items as they come.

    Args:
        function: What is applied, or its pickle.
        line: Brings chunks and takes results.
        others: Ends of lines that this process has inherited and must not keep open.
    """
    _detach(others)
    inbox: SimpleQueue[Sequence[Any]] = SimpleQueue()
    # Reads ahead, so that nobody waits for one who waits to send; and ends with its master.
    threading.Thread(target=_listen, args=(line, inbox), daemon=True).start()
    # BLAS and OpenMP: their libraries may be loaded already, and ask no environment any more.
    load("threadpoolctl").threadpool_limits(1)
    if isinstance(function, bytes):
        try:
            function = cast("Callable[[Any], Any]", pickle.loads(function))
        except Exception as error:
            told = f"a worker process cannot load the function ({error}): define it in a module"
            line.send(Part(raised=Raised(EngineError(told), "")))
            raise SystemExit(1) from error
    line.send(Part())
    while True:
        for part in parts_of(function, inbox.get(), _FLUSH):
            _send(line, part)


def _detach(others: Iterable[Connection]) -> None:
    """Leave signals from the keyboard to the master, and its connections as well."""
    for number in SIGNALS:
        ignored = number == signal.SIGINT
        signal.signal(number, signal.SIG_IGN if ignored else signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
    for other in others:
        other.close()


def _listen(line: Connection, inbox: SimpleQueue[Sequence[Any]]) -> None:
    while True:
        try:
            inbox.put(line.recv())
        except (EOFError, OSError):
            os._exit(1)
        except Exception as error:
            message = f"an item cannot be read in a worker process: {error}"
            line.send(Part(raised=Raised(EngineError(message), "")))


def _send(line: Connection, part: Part) -> None:
    try:
        line.send(part)
    except OSError:
        os._exit(1)
    except Exception as error:
        message = f"a result cannot be sent from a worker process: {error}"
        line.send(Part(raised=Raised(EngineError(message), "")))


class Member:
    """A process, its line, and the chunks that it was sent and has not finished."""

    def __init__(self, process: BaseProcess, line: Connection) -> None:
        """One that was started just now."""
        self.process, self.line = process, line
        self.chunks: deque[Chunk] = deque()
        self.done = 0
        self.has_started = False

    def send(self, chunk: Chunk) -> None:
        """Have it do a chunk.

        Raises:
            EngineError: An item cannot be sent.
        """
        self.chunks.append(chunk)
        try:
            # Where it is dead, that is found where its answers are awaited.
            with suppress(OSError):
                self.line.send(chunk.items)
        except Exception as error:
            raise EngineError(f"an item cannot be sent to a worker process: {error}") from error

    def hear(self) -> list[Answer]:
        """What it says, or what there is to say where it is dead.

        Raises:
            EngineError: A result cannot be read, or it did not start.
        """
        try:
            part = self.line.recv()
        except (EOFError, OSError):
            return self.buried()
        except Exception as error:
            raise EngineError(f"a result cannot be read: {error}") from error
        if not self.has_started:
            self.has_started = True
            return [Answer(Chunk((), ()), raised=part.raised)] if part.raised else []
        chunk, first = self.chunks[0], self.done
        self.done += len(part.results)
        if part.is_last:
            self.chunks.popleft()
            self.done = 0
        return [Answer(chunk.part(first, first + len(part.results)), *part[:3])]

    def buried(self) -> list[Answer]:
        """What it leaves: what it was about, and what it had not begun."""
        self.stop()
        code = self.process.exitcode or 0
        if code > 0 and not self.has_started:
            raise EngineError(
                f"worker processes do not start (exit code {code}); where they are not forked, a "
                'script needs `if __name__ == "__main__":` before what it does'
            )
        words = f"signal {-code}" if code < 0 else f"exit code {code}"
        words = "signal 9, as where memory runs out" if code == -9 else words
        death = f"the worker process died ({words})"
        left = [Answer(chunk) for chunk in self.chunks]
        if left:
            begun = self.chunks[0]
            left[0] = Answer(begun.part(self.done, len(begun.items)), death=death)
        return left

    def last_words(self) -> list[Answer]:
        """What there is to hear of it before it is buried."""
        answers: list[Answer] = []
        while not self.line.closed:
            answers += self.hear() if self.line.poll() else self.buried()
        return answers

    def stop(self) -> None:
        """End it at once."""
        self.process.kill()
        self.process.join()
        self.line.close()


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
        self._function: Callable[[Any], Any] | bytes = function
        if not FORKS:
            try:
                self._function = pickle.dumps(function)
            except Exception as error:
                raise EngineError(
                    f"the function cannot be sent to other processes ({error}): define it in a "
                    "module of its own, outside of other functions"
                ) from error
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
