# SPDX-License-Identifier: BSD-3-Clause
"""A process that waits, with everything loaded, for decks to analyse or for a script to run."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import queue
import signal
import sys
import threading
from typing import Any, BinaryIO

from ...core import narrow
from . import frames
from .answering import answer_of
from .watching_messages import Printed


def main() -> None:
    """Answer jobs until nobody asks any more; what scripts print goes along with the answers."""
    narrow.prepare()
    jobs, line = _lines()
    said = _Said(line)
    sys.stdout = io.TextIOWrapper(_Raw(said), "utf-8", "replace", line_buffering=True)
    printed = sys.stdout
    waiting: queue.SimpleQueue[Any] = queue.SimpleQueue()
    threading.Thread(target=_hear, args=(jobs, waiting), daemon=True).start()
    while True:
        answer = answer_of(waiting.get(), said.send)
        # A script may have closed it.
        with contextlib.suppress(ValueError):
            printed.flush()
        said.send(answer)


def _lines() -> tuple[BinaryIO, BinaryIO]:
    """The pipes to who started this process, out of reach of whatever a script does.

    Programs that a script starts write where errors go.
    """
    jobs, line = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    return jobs, line


def _hear(jobs: BinaryIO, waiting: queue.SimpleQueue[Any]) -> None:
    """Hand jobs on; where nobody is left who could give one, end with all that was started."""
    try:
        while True:
            waiting.put(frames.receive(jobs))
    except (EOFError, OSError) as error:
        # What the script itself has closed says nothing of who asks, who ends this process then.
        if getattr(error, "errno", None) == errno.EBADF:
            return
    if hasattr(os, "killpg"):
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


class _Said:
    """The line of answers, for one speaker at a time."""

    def __init__(self, line: BinaryIO) -> None:
        self._line = line
        self._lock = threading.Lock()

    def send(self, value: Any) -> None:
        with self._lock:
            frames.send(self._line, value)


class _Raw(io.RawIOBase):
    """Where what a script prints goes."""

    def __init__(self, said: _Said) -> None:
        self._said = said
        self._process = os.getpid()

    def writable(self) -> bool:
        return True

    def write(self, content: Any) -> int:
        taken = bytes(content)
        if os.getpid() != self._process:
            # A process that was forked has the same line, where its words would fall into others.
            return os.write(2, taken)
        self._said.send(Printed(taken.decode("utf-8", "replace")))
        return len(taken)
