# SPDX-License-Identifier: BSD-3-Clause
"""What Ctrl-C and its like do: end the process at once, or leave no file half-written.

Python acts on a signal only between its own instructions, so that neither an import nor a
decomposition in the core would end. The command therefore leaves signals to the system, which
ends it at once, except while it writes files.
"""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator
from types import FrameType

SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)


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
    signal.signal(number, signal.SIG_DFL)
    signal.raise_signal(number)


@contextlib.contextmanager
def unwinding() -> Iterator[None]:
    """Make signals that would end the process raise `Stopped`, so that it can clean up."""
    asked: list[int] = []

    def stop(number: int, _: FrameType | None) -> None:
        asked.append(number)
        # No second one stops the cleaning up.
        if len(asked) == 1:
            raise Stopped(number)

    with _handled(signal.SIG_DFL, stop):
        yield
        if asked:
            # Where it fell into a destructor or a callback of a weak reference, Python let it go.
            raise Stopped(asked[0])


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Hold signals back; the first of them acts at the end."""
    held: list[int] = []
    try:
        with _handled(None, lambda number, _: held.append(number)):
            yield
    finally:
        if held:
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
