# SPDX-License-Identifier: BSD-3-Clause
"""What a process of the local pool does until it is stopped."""

from __future__ import annotations

import os
import pickle
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from multiprocessing.connection import Connection
from queue import SimpleQueue
from typing import Any, NamedTuple

from ..util.interruption import SIGNALS
from ..util.loading import load
from .errors import EngineError
from .running import Raised, raised

#: Results that are there are not held back for longer [s].
_FLUSH = 0.05


class Part(NamedTuple):
    """Results of the next items of what a worker does, and whether its chunk ends with them."""

    results: Sequence[Any] = ()
    seconds: float = 0.0
    raised: Raised | None = None
    is_last: bool = False


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
    called = _loaded(function, line) if isinstance(function, bytes) else function
    line.send(Part())
    while True:
        for part in _parts(called, inbox.get()):
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


def _loaded(pickled: bytes, line: Connection) -> Callable[[Any], Any]:
    try:
        function: Callable[[Any], Any] = pickle.loads(pickled)
    except Exception as error:
        message = f"a worker process cannot load the function ({error}): define it in a module"
        line.send(Part(raised=Raised(EngineError(message), "")))
        raise SystemExit(1) from error
    return function


def _parts(function: Callable[[Any], Any], items: Sequence[Any]) -> Iterator[Part]:
    """What comes of items, in parts, so that what is done is soon known."""
    results: list[Any] = []
    start = time.perf_counter()
    last = len(items) - 1
    for k, item in enumerate(items):
        try:
            results.append(function(item))
        except BaseException as error:
            yield Part(results, time.perf_counter() - start, raised(error), True)
            return
        seconds = time.perf_counter() - start
        if k == last or seconds > _FLUSH:
            yield Part(results, seconds, None, k == last)
            results, start = [], time.perf_counter()


def _send(line: Connection, part: Part) -> None:
    try:
        line.send(part)
    except OSError:
        os._exit(1)
    except Exception as error:
        message = f"a result cannot be sent from a worker process: {error}"
        line.send(Part(raised=Raised(EngineError(message), "")))
