# SPDX-License-Identifier: BSD-3-Clause
"""Decks through processes that may hang or die over one of them: the next takes the next deck."""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import resource
import signal
import tempfile
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from multiprocessing.connection import Connection, wait
from typing import NamedTuple

from .command import try_command
from .mutations import Case
from .trial import OffenceError, try_deck

#: Of processor time that a deck may take [s]: no load of the machine makes a deck hang.
LIMIT = 30.0
#: Of waiting, for what takes no processor time [s].
LONGEST_WAIT = 600.0
#: That a process may have taken by the end of a deck [bytes].
MOST_MEMORY = 1.5e9
_PER_WORKER = 400


class Judged(NamedTuple):
    """What became of a deck; `offence` is a word for what must not be, or nothing."""

    case: Case
    outcome: str = ""
    offence: str = ""
    words: str = ""
    seconds: float = 0.0


def judge_without_command(case: Case) -> Judged:
    """Try a deck in this process, but not the command."""
    return judge(case, command=False)


def judge(case: Case, command: bool = True) -> Judged:
    """Try a deck in this process."""
    start = time.process_time()
    offence = words = outcome = ""
    try:
        came = try_deck(case.text)
        outcome = came.value
        if command:
            try_command(case.text, came)
    except OffenceError as error:
        offence, words = "offence", str(error)
    except BaseException as error:
        offence, words = f"traceback ({type(error).__name__})", traceback.format_exc()
    taken = time.process_time() - start
    # Kilobytes, and where they are bytes the limit is never met.
    if not offence and resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1e3 > MOST_MEMORY:
        offence, words = "memory", f"more than {MOST_MEMORY / 1e9:.1f} GB"
    return Judged(case, outcome, offence, words, taken)


def judged(
    cases: Iterable[Case],
    workers: int,
    task: Callable[[Case], Judged] = judge,
    limit: float = LIMIT,
) -> Iterator[Judged]:
    """What became of each deck, in any order.

    Args:
        cases: The decks.
        workers: Processes.
        task: What is done with a deck.
        limit: Of processor time that it may take [s].
    """
    waiting = iter(cases)
    busy: list[_Worker] = []
    idle = [_Worker(task, limit) for _ in range(workers)]
    try:
        while True:
            while idle and (case := next(waiting, None)) is not None:
                worker = idle.pop()
                worker.take(case)
                busy.append(worker)
            if not busy:
                return
            ready = wait([worker.connection for worker in busy], timeout=5.0)
            for worker in list(busy):
                if worker.connection not in ready and not worker.is_overdue():
                    continue
                busy.remove(worker)
                found = worker.give() if worker.connection in ready else worker.hung()
                if worker.is_done():
                    worker.close()
                    worker = _Worker(task, limit)
                idle.append(worker)
                yield found
    finally:
        for worker in busy + idle:
            worker.close()


class _Worker:
    """A process that takes decks one by one."""

    def __init__(self, task: Callable[[Case], Judged], limit: float) -> None:
        handle, self._log = tempfile.mkstemp(prefix="fuzz-", suffix=".log")
        os.close(handle)
        self.connection, theirs = multiprocessing.Pipe()
        context = multiprocessing.get_context("spawn")
        self._process = context.Process(
            target=_work, args=(theirs, self._log, task, limit), daemon=True
        )
        self._process.start()
        theirs.close()
        self._case = Case("", b"")
        self._since = time.monotonic()
        self._taken = 0

    def take(self, case: Case) -> None:
        self._case, self._since = case, time.monotonic()
        self._taken += 1
        self.connection.send(case)

    def give(self) -> Judged:
        """What it found, or how it died."""
        try:
            found: Judged = self.connection.recv()
            return found
        except (EOFError, ConnectionError):
            self._process.join()
            code = self._process.exitcode
            name = "hang" if code == -signal.SIGVTALRM else f"crash ({code})"
            self._taken = _PER_WORKER
            return Judged(self._case, "", name, self._said())

    def hung(self) -> Judged:
        """What it was at when it was given up."""
        assert self._process.pid is not None
        os.kill(self._process.pid, signal.SIGABRT)
        self._process.join(10.0)
        self._taken = _PER_WORKER
        return Judged(self._case, "", "hang", self._said())

    def is_overdue(self) -> bool:
        return time.monotonic() - self._since > LONGEST_WAIT

    def is_done(self) -> bool:
        """A process now and then makes room for a fresh one, as its memory only grows."""
        return self._taken >= _PER_WORKER

    def close(self) -> None:
        self._process.kill()
        self._process.join()
        self.connection.close()
        os.unlink(self._log)

    def _said(self) -> str:
        with open(self._log, encoding="utf-8", errors="replace") as log:
            return log.read()[-4000:]


def _work(connection: Connection, log: str, task: Callable[[Case], Judged], limit: float) -> None:
    """Take decks until nobody gives any; a limit or a fatal signal writes where it was."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with open(log, "w") as file:
        os.dup2(file.fileno(), 2)
        faulthandler.enable(file)
        faulthandler.register(signal.SIGVTALRM, file, chain=True)
        while True:
            try:
                case = connection.recv()
            except EOFError:
                return
            signal.setitimer(signal.ITIMER_VIRTUAL, limit)
            found = task(case)
            signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
            connection.send(found)
