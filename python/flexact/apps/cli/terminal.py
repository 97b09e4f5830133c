# SPDX-License-Identifier: BSD-3-Clause
"""What a command says: results on stdout, everything else on stderr."""

from __future__ import annotations

import codecs
import contextlib
import errno
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TextIO

from ...util.errors import reason_of
from ...util.loading import load
from ...util.plain_text import harmless, spelled
from ...util.text import USUAL, refitted
from . import colour

#: What becomes of characters that an encoding lacks.
_SPELLED = "flexact.spelled"
#: No terminal counts as narrower.
_LEAST = 20


class ResultsError(Exception):
    """Results cannot be written to stdout, so that going on has no use."""


@dataclass
class _Manner:
    """How the present run speaks, as was chosen.

    Attributes:
        colour: Of `colour.CHOICES`.
        quiet: Whether words are left out, so that errors and the exit code are left.
        verbose: How much is told of what is done.
    """

    colour: str = "auto"
    quiet: bool = False
    verbose: int = 0


_MANNER = _Manner()


def speak(colour: str = "auto", quiet: bool = False, verbose: int = 0) -> None:
    """Choose how the run speaks that begins."""
    _MANNER.colour, _MANNER.quiet, _MANNER.verbose = colour, quiet, verbose


def is_verbose() -> bool:
    """Whether somebody wants to know what is done, and how long it takes."""
    return _MANNER.verbose > 0


def is_coloured(stream: TextIO | None) -> bool:
    """Whether a stream is to be coloured."""
    wanted = colour.is_wanted(stream, _MANNER.colour, os.environ)
    return wanted and (_obeys_escapes(stream) or _MANNER.colour == "always")


def _obeys_escapes(stream: TextIO | None) -> bool:
    """Whether escape sequences do what they say: older consoles of Windows show them instead."""
    if sys.platform != "win32" or stream is None or not stream.isatty():
        return True
    number = 2 if stream is sys.stderr else 1
    obeys: bool = load("flexact.util.windows").obeys_escapes(number)
    return obeys


def text_width(usual: int = USUAL, stream: TextIO | None = None) -> int:
    """Columns for words: those of the terminal, as many as are read with ease; else `usual`."""
    seen = columns_of(sys.stdout if stream is None else stream)
    return usual if seen is None else max(_LEAST, min(seen, USUAL))


def columns_of(stream: TextIO | None) -> int | None:
    """The columns that COLUMNS states, or the terminal has; None where nobody looks."""
    stated = os.environ.get("COLUMNS", "")
    if stated.isdigit() and int(stated) > 0:
        return int(stated)
    if stream is None or not stream.isatty():
        return None
    with contextlib.suppress(OSError, ValueError):
        # Some terminals say that they have no columns.
        return os.get_terminal_size(stream.fileno()).columns or None
    return None


def _fitted(text: str, stream: TextIO | None) -> str:
    """A text of which no row is wider than the terminal."""
    seen = columns_of(stream)
    return text if seen is None else refitted(text, max(_LEAST, seen))


def say(text: str, style: str = "") -> None:
    """Print what results are in words, as wide as the terminal; errors as for `give`."""
    if not _MANNER.quiet:
        text = _fitted(text, sys.stdout)
        if style and is_coloured(sys.stdout):
            text = colour.painted(text, style)
        give(text)


def give(text: str) -> None:
    """Print results as they are, seen at once however the output is buffered.

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
        if sys.platform == "win32" and error.errno == errno.EINVAL:
            # What Windows says of a pipe at whose end nobody reads on.
            raise BrokenPipeError(errno.EPIPE, "nobody reads on") from error
        raise ResultsError(f"cannot write the results: {reason_of(error)}") from error


def complain(text: str) -> None:
    """Print problems and remarks, behind the results that came before them."""
    if text:
        _clear_progress()
        text = _fitted(text, sys.stderr)
        if is_coloured(sys.stderr):
            text = colour.painted_problems(text)
        _to_stderr(f"{text}\n")


def remark(text: str) -> None:
    """Print what is done, where somebody wants to know."""
    if is_verbose():
        complain(text)


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
        and _obeys_escapes(sys.stderr)
    )


def accept_every_character() -> None:
    """Let stdout and stderr spell out what their encoding lacks; lines end alike everywhere."""
    codecs.register_error(_SPELLED, spelled)
    for stream in (sys.stdout, sys.stderr):
        if (reconfigure := getattr(stream, "reconfigure", None)) is not None:
            reconfigure(errors=_SPELLED, newline="\n")


def discard(stream: TextIO | None) -> None:
    """Send what is still buffered for a stream that broke to nowhere, also at exit."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())  # type: ignore[union-attr]
        os.close(nowhere)
