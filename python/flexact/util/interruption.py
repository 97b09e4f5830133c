# SPDX-License-Identifier: BSD-3-Clause
"""What Ctrl-C and its like do: end the process at once, or leave no file half-written.

Python acts on a signal only between its own instructions, so that neither an import nor a
decomposition in the core would end. The command therefore leaves signals to the system, which
ends it at once, except while it writes files.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from types import FrameType

#: Those that the system has: SIGHUP, or on Windows SIGBREAK, where a terminal is closed.
SIGNALS = tuple(
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
    if hasattr(signal, name)
)
#: How Windows says that Ctrl-C ended a process, STATUS_CONTROL_C_EXIT, as a signed number.
_ENDED_BY_CONTROL_C = 0xC000013A - 2**32


class Stopped(KeyboardInterrupt):
    """A signal asks the process to end.

    Attributes:
        number: The signal.
    """

    def __init__(self, number: int) -> None:
        """A signal by its number."""
        super().__init__(number)
        self.number = number


def end_at_once() -> None:
    """Let Ctrl-C end this process, unless whoever started it has it ignored."""
    if _is_main() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def end_by(number: int) -> None:
    """End this process by a signal, which is what a shell wants to see."""
    if sys.platform == "win32":
        # What its C library does by itself is to end with 3, which says something else here.
        os._exit(_ENDED_BY_CONTROL_C)
    signal.signal(number, signal.SIG_DFL)
    signal.raise_signal(number)


@contextlib.contextmanager
def unwinding() -> Iterator[Callable[[], None]]:
    """Make signals that would end the process raise `Stopped`, so that it can clean up.

    Yields:
        To be called between two pieces of work: it raises `Stopped`, too, where a signal came.
    """
    asked: list[int] = []

    def stop(number: int, _: FrameType | None) -> None:
        asked.append(number)
        # No second one stops the cleaning up.
        if len(asked) == 1:
            raise Stopped(number)

    def look() -> None:
        # Python lets it go where it falls into a destructor or a callback of a weak reference,
        # and NumPy where it asks an object for an attribute.
        if asked:
            raise Stopped(asked[0])

    with _handled(signal.SIG_DFL, stop):
        yield look
        look()


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Hold signals back; the first of them acts at the end."""
    held: list[int] = []
    try:
        with _handled(None, lambda number, _: held.append(number)):
            yield
    finally:
        if held and signal.getsignal(held[0]) is signal.SIG_DFL:
            end_by(held[0])
        elif held:
            signal.raise_signal(held[0])


@contextlib.contextmanager
def _handled(only: signal.Handlers | None, handler: signal._HANDLER) -> Iterator[None]:
    """Handle the signals, or those whose handler is `only`, by another handler."""
    before = {number: signal.getsignal(number) for number in SIGNALS} if _is_main() else {}
    # A handler that is None was not set from Python and could not be set again.
    mine = [n for n, old in before.items() if old is not None and only in (None, old)]
    try:
        for number in mine:
            signal.signal(number, handler)
        yield
    finally:
        for number in mine:
            signal.signal(number, before[number])


def _is_main() -> bool:
    return threading.current_thread() is threading.main_thread()
