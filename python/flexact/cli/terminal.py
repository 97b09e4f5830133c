"""What a command says: results on stdout, everything else on stderr."""

from __future__ import annotations

import contextlib
import os
import sys
from typing import TextIO


def say(text: str) -> None:
    """Print results, seen at once however the output is buffered."""
    if sys.stdout is not None:
        print(text, flush=True)


def complain(text: str) -> None:
    """Print problems and remarks, behind the results that came before them."""
    if sys.stderr is not None and text:
        _clear_progress()
        print(text, file=sys.stderr, flush=True)


def show_progress(number: int, total: int, deck: str) -> None:
    """Say which deck of many is at work, where a person waits and sees no results meanwhile."""
    if total > 1 and _is_watched():
        print(f"\r\x1b[K[{number}/{total}] {deck}", end="", file=sys.stderr, flush=True)


def end_progress() -> None:
    """Wipe the line of progress."""
    _clear_progress()


def _clear_progress() -> None:
    if _is_watched():
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def _is_watched() -> bool:
    return (
        sys.stderr is not None
        and sys.stderr.isatty()
        and not (sys.stdout is not None and sys.stdout.isatty())
    )


def accept_every_character() -> None:
    """Let stdout and stderr spell out what their encoding lacks, rather than fail."""
    for stream in (sys.stdout, sys.stderr):
        if (reconfigure := getattr(stream, "reconfigure", None)) is not None:
            reconfigure(errors="backslashreplace")


def discard(stream: TextIO | None) -> None:
    """Send what is still buffered for a stream that broke to nowhere, also at exit."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())  # type: ignore[union-attr]
        os.close(nowhere)
