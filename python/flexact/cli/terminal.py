# SPDX-License-Identifier: BSD-3-Clause
"""What a command says: results on stdout, everything else on stderr."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from typing import TextIO

from flexact.base.errors import reason_of
from flexact.base.plain_text import harmless


class ResultsError(Exception):
    """Results cannot be written to stdout, so that going on has no use."""


def say(text: str) -> None:
    """Print results, seen at once however the output is buffered.

    Raises:
        BrokenPipeError: Nobody reads on.
        ResultsError: They cannot be written for another reason.
    """
    with _results():
        print(text, flush=True)


def put(content: bytes) -> None:
    """Write a file's content to stdout in place of words; errors as for `say`."""
    with _results():
        sys.stdout.flush()
        if (raw := getattr(sys.stdout, "buffer", None)) is not None:
            raw.write(content)
            raw.flush()
        else:
            sys.stdout.write(content.decode("utf-8", "replace"))


def finish_results() -> None:
    """Write what is still buffered; errors as for `say`."""
    with _results():
        sys.stdout.flush()


@contextlib.contextmanager
def _results() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        raise ResultsError(f"cannot write the results: {reason_of(error)}") from error


def complain(text: str) -> None:
    """Print problems and remarks, behind the results that came before them."""
    if text:
        _clear_progress()
        _to_stderr(f"{text}\n")


def show_progress(number: int, total: int, deck: str) -> None:
    """Say which deck of many is at work, where a person waits and sees no results meanwhile."""
    if total > 1 and _is_watched():
        _to_stderr(f"\r\x1b[K[{number}/{total}] {harmless(deck)}")


def end_progress() -> None:
    """Wipe the line of progress."""
    _clear_progress()


def _clear_progress() -> None:
    if _is_watched():
        _to_stderr("\r\x1b[K")


def _to_stderr(text: str) -> None:
    if sys.stderr is None:
        return
    try:
        print(text, end="", file=sys.stderr, flush=True)
    except OSError:
        # Results count even where nobody can see what is reported.
        discard(sys.stderr)


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
