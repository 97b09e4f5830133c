# SPDX-License-Identifier: BSD-3-Clause
"""The processes that analyse and run scripts: one at work, and one that is ready for the next."""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import struct
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import IO, Any

from ...util.errors import FlexactError, reason_of
from .scene import Answer, Before, is_before

_LENGTH = struct.Struct("!Q")
#: Longer is no value of ours.
_MOST = 2**32


def send(line: IO[bytes], value: Any) -> None:
    """Write a value.

    Raises:
        OSError: Nobody reads on.
    """
    content = pickle.dumps(value, pickle.HIGHEST_PROTOCOL)
    line.write(_LENGTH.pack(len(content)) + content)
    line.flush()


def receive(line: IO[bytes]) -> Any:
    """The next value.

    Raises:
        EOFError: There is none, or it ends too early.
        Exception: What is there was not sent by `send`.
    """
    (length,) = _LENGTH.unpack(_read(line, _LENGTH.size))
    if length > _MOST:
        raise ValueError("longer than any value")
    return pickle.loads(_read(line, length))


def _read(line: IO[bytes], length: int) -> bytes:
    content = line.read(length)
    if len(content) < length:
        raise EOFError
    return content


#: Starts a worker. The folder at hand is no place for modules: a deck lies there.
_START = (
    "import sys; sys.path[:] = [p for p in sys.path if p] + [sys.argv[1]]; "
    "from flexact.apps.watch.worker import main; main()"
)
#: The folder that this package was loaded from.
_HOME = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


#: How long it may take to end what a worker has started, where another program does that [s].
_PATIENCE = 5.0
_CRASHED = 2**31


class WorkerError(FlexactError):
    """A worker ended before it had an answer; the text says how."""


class Worker:
    """A process that answers jobs, in a session of its own so that Ctrl-C is not for it."""

    def __init__(self) -> None:
        """Start it; it loads what it needs while nobody waits.

        Raises:
            WorkerError: The system gives no process, or no pipes to it.
        """
        try:
            self._process = subprocess.Popen(
                [sys.executable, "-c", _START, _HOME],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                **_apart(),
            )
        except OSError as error:
            raise WorkerError(
                f"no process can be started now: {reason_of(error)}; save the file again to try "
                "anew"
            ) from error
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._jobs, self._line = self._process.stdin, self._process.stdout
        self.is_busy = False

    def answer(
        self, question: tuple[str, tuple[object, ...]], meanwhile: Callable[[Before], None]
    ) -> Answer:
        """What comes of a path and a decision; what is heard before goes to `meanwhile`.

        Raises:
            WorkerError: It has ended.
        """
        self.is_busy = True
        try:
            send(self._jobs, question)
        except OSError:
            raise self._death() from None
        while is_before(heard := self._hear()):
            meanwhile(heard)
        self.is_busy = False
        made: Answer = heard
        return made

    def _hear(self) -> Any:
        try:
            return receive(self._line)
        except (EOFError, OSError):
            raise self._death() from None
        except Exception:
            # A script may write to whatever is open in its process.
            self.stop()
            raise WorkerError("what the process sent was no answer, and it was ended") from None

    def _death(self) -> WorkerError:
        try:
            return WorkerError(_how(self._process.wait(_PATIENCE)))
        except subprocess.TimeoutExpired:
            self.stop()
            return WorkerError("the process hears and says nothing any more, and was ended")

    @property
    def is_alive(self) -> bool:
        """Whether it can be asked."""
        return self._process.poll() is None

    def stop(self) -> None:
        """End it at once, and whatever it has started."""
        if hasattr(os, "killpg"):
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)
        else:
            with contextlib.suppress(OSError, subprocess.SubprocessError):
                subprocess.run(
                    ["taskkill", "/F", "/T", "/PID", str(self._process.pid)],
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    timeout=_PATIENCE,
                )
            self._process.kill()
        self._process.wait()


def _apart() -> dict[str, Any]:
    """What starts a process that Ctrl-C of this terminal is not for."""
    if sys.platform == "win32":
        return {"creationflags": getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0x200)}
    return {"start_new_session": True}


def _how(code: int) -> str:
    if code >= _CRASHED:
        # How Windows says of what a process died.
        return f"the process ended with code {code:#010x} before it had an answer"
    if code >= 0:
        return f"the process ended with code {code} before it had an answer"
    name = signal.strsignal(-code) or f"signal {-code}"
    return f"the process was ended before it had an answer: {name.lower()}"


class Crew:
    """The worker whose answer is shown, and a fresh one for the next script."""

    def __init__(self, *, fresh: bool, ready: bool = False) -> None:
        """Start the first worker.

        Args:
            fresh: Whether each job takes a process that has done nothing before.
            ready: Whether another one is to be ready where one at work may be stopped.
        """
        self._fresh, self._ready = fresh, fresh or ready
        self._lock = threading.Lock()
        self._at_work: Worker | None = None
        self._spare: Worker | None = None
        self._closed = False
        with contextlib.suppress(WorkerError):
            self._spare = Worker()

    def take(self) -> Worker:
        """The worker for a new job; the one before is stopped unless it can go on.

        Raises:
            WorkerError: There can be none.
        """
        with self._lock:
            before = self._at_work
            if before is not None:
                if not self._fresh and before.is_alive and not before.is_busy:
                    return before
                before.stop()
                self._at_work = None
            if self._closed:
                raise WorkerError("the end")
            self._at_work, self._spare = self._spare or Worker(), None
            return self._at_work

    def prepare(self) -> None:
        """Have a fresh worker ready, where one will be wanted."""
        with self._lock:
            if self._ready and self._spare is None and not self._closed:
                # Else it is tried again when it is wanted.
                with contextlib.suppress(WorkerError):
                    self._spare = Worker()

    def close(self) -> None:
        """Stop all of them."""
        with self._lock:
            self._closed = True
            for worker in (self._at_work, self._spare):
                if worker is not None:
                    worker.stop()
