# SPDX-License-Identifier: BSD-3-Clause
"""What a command says: results on stdout, everything else on stderr, and an exit code."""

from __future__ import annotations

import codecs
import contextlib
import errno
import os
import re
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import IntEnum
from importlib import import_module
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, TextIO

from ...util.errors import reason_of
from ...util.loading import load
from ...util.text import USUAL, columns, harmless, refitted, spelled

if TYPE_CHECKING:
    from ...core.progress import Progress
    from ...model.data import ModelData


class ExitCode(IntEnum):
    """What a command returns to the shell: as ruff has it, 1 is about decks, 2 about the run.

    Attributes:
        ANALYSED: All is well.
        DECK_ERROR: A deck has errors, cannot be read, or has not what was asked of it.
        OTHER: Wrong usage, output that cannot be written, too little memory, and the like.
        DIFFERENT: The verdict is not the expected one, or an answer differs.
    """

    ANALYSED = 0
    DECK_ERROR = 1
    OTHER = 2
    DIFFERENT = 3


@dataclass(frozen=True)
class Outcome:
    """What came of one deck.

    Attributes:
        deck: Its name.
        code: The exit code that it asks for.
        result: A word or two, counted over the batch.
        remark: Why it wants attention; empty where the code says enough.
    """

    deck: str
    code: ExitCode
    result: str
    remark: str = ""


def exit_code(outcomes: Iterable[Outcome]) -> ExitCode:
    """The exit code of a batch: the gravest of its decks, in the order 2, 1, 3, 0."""
    codes = {outcome.code for outcome in outcomes}
    for code in (ExitCode.OTHER, ExitCode.DECK_ERROR, ExitCode.DIFFERENT):
        if code in codes:
            return code
    return ExitCode.ANALYSED


CHOICES = ("auto", "always", "never")

_STYLES = {
    "good": "1;32",
    "bad": "1;31",
    "unsure": "1;33",
    "error": "1;31",
    "warning": "1;33",
    "note": "1;36",
    "mark": "1;31",
    "faint": "2",
    "strong": "1",
}
_FORCING = ("CLICOLOR_FORCE", "FORCE_COLOR")
#: Patterns are compiled where something is to be coloured.
_HEADS = (
    r"^(?P<where>(?!error|warning|note|tip)[^\s:][^:]*: )?(?P<kind>error|warning|note|tip)"
    r"(?P<code>\[[\w-]+\])?(?=:)"
)
_PLACE = r"^ *(-->|:::)"
_MARKS = r"^( *\| *)([\^]+|-+)( .*)?$"
_HELP = r"^( *= )(help|note)(?=:)"


def painted(text: str, style: str) -> str:
    """A text in a colour; each row by itself, so that a pager shows it."""
    rows = text.split("\n")
    return "\n".join(f"\x1b[{_STYLES[style]}m{row}\x1b[0m" if row else row for row in rows)


def _painted_row(row: str) -> str:
    if found := re.match(_HEADS, row):
        kind = found["kind"]
        where, code = found["where"] or "", found["code"] or ""
        style = kind if kind in _STYLES else "note"
        return f"{where}{painted(kind + code, style)}{row[found.end() :]}"
    if re.match(_PLACE, row):
        return painted(row, "faint")
    if found := re.match(_MARKS, row):
        style = "mark" if "^" in found[2] else "note"
        return found[1] + painted(found[2] + (found[3] or ""), style)
    if found := re.match(_HELP, row):
        return f"{found[1]}{painted(found[2], 'note')}{row[found.end() :]}"
    return row


#: What becomes of characters that an encoding lacks.
_SPELLED = "flexact.spelled"
#: No terminal counts as narrower.
_LEAST = 20


class ResultsError(Exception):
    """Results cannot be written to stdout, so that going on has no use."""


#: How the present run speaks, as was chosen: one of `CHOICES`; whether words are left out, so that
#: errors and the exit code are left; and how much is told of what is done.
_MANNER = SimpleNamespace(colour="auto", quiet=False, verbose=0)


def speak(colour: str = "auto", quiet: bool = False, verbose: int = 0) -> None:
    """Choose how the run speaks that begins."""
    vars(_MANNER).update(colour=colour, quiet=quiet, verbose=verbose)


def is_verbose() -> bool:
    """Whether somebody wants to know what is done, and how long it takes."""
    return bool(_MANNER.verbose)


def is_coloured(stream: TextIO | None) -> bool:
    """Whether a stream is to be coloured.

    `--color` decides; else NO_COLOR, if it is not empty, forbids colour (no-color.org), and
    CLICOLOR_FORCE or FORCE_COLOR wants it; else it is for terminals that are not dumb.
    """
    if _MANNER.colour != "auto":
        return bool(_MANNER.colour == "always")
    if os.environ.get("NO_COLOR"):
        return False
    is_forced = any(os.environ.get(name, "0") not in ("", "0") for name in _FORCING)
    is_seen = stream is not None and stream.isatty() and os.environ.get("TERM") != "dumb"
    return (is_forced or is_seen) and _obeys_escapes(stream)


def _obeys_escapes(stream: TextIO | None) -> bool:
    """Whether escape sequences do what they say: older consoles of Windows show them instead."""
    if sys.platform != "win32" or stream is None or not stream.isatty():
        return True
    number = 2 if stream is sys.stderr else 1
    obeys: bool = load("flexact.util.windows").obeys_escapes(number)
    return obeys


def text_width(usual: int = USUAL) -> int:
    """Columns for words: those of the terminal, as many as are read with ease; else `usual`."""
    seen = columns_of(sys.stdout)
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


def say(text: str) -> None:
    """Print what results are in words, as wide as the terminal; errors as for `give`."""
    if not _MANNER.quiet:
        give(_fitted(text, sys.stdout))


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
        end_progress()
        text = _fitted(text, sys.stderr)
        if is_coloured(sys.stderr):
            # Diagnostics as they were rendered, with kinds, places and carets in colour.
            text = "\n".join(map(_painted_row, text.split("\n")))
        _to_stderr(f"{text}\n")


def show_progress(number: int, total: int, deck: str) -> None:
    """Say which deck of many is at work, where a person waits and sees no results meanwhile."""
    if total > 1 and _is_watched():
        _to_stderr(f"\r\x1b[K[{number}/{total}] {harmless(deck)}")


def end_progress() -> None:
    """Wipe the line of progress."""
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


def padded(text: str, width: int, *, right: bool = False) -> str:
    """A text in a cell, at its left or its right end."""
    room = " " * (width - columns(text))
    return room + text if right else text + room


def shortened_middle(text: str, width: int) -> str:
    """A text without its middle, where it is too wide: a third stays of its beginning."""
    if columns(text) <= width:
        return text
    cut = _cut()
    room = max(width - len(cut), 0)
    head = _first(text, room // 3)
    tail = _first(text[::-1], room - columns(head))[::-1]
    return f"{head}{cut}{tail}"[:width]


def shortened(text: str, width: int) -> str:
    """A text without its end, where it is too wide."""
    if columns(text) <= width:
        return text
    cut = _cut()
    return f"{_first(text, max(width - len(cut), 0))}{cut}"[:width]


def _first(text: str, width: int) -> str:
    kept, wide = 0, 0
    for c in text:
        wide += columns(c)
        if wide > width:
            break
        kept += 1
    return text[:kept]


def _cut() -> str:
    """What stands for what is left out."""
    encoding = getattr(sys.stdout, "encoding", None) or "ascii"
    try:
        "\N{HORIZONTAL ELLIPSIS}".encode(encoding)
    except (UnicodeEncodeError, LookupError):
        return ".."
    return "\N{HORIZONTAL ELLIPSIS}"


#: Decks of so many bytes, or elements, are worth a bar.
LARGE_FILE = 2**20
LARGE_MODEL = 20_000

_WIDTH, _ROWS = 80, 24
_BAR = "{desc} {percentage:3.0f}%|{bar}| {elapsed}"


class Bar:
    """A bar on stderr; it says nothing unless a deck is large and somebody watches."""

    def __init__(self, deck: str, path: str) -> None:
        """The bar of a deck, of which no more than its file is known so far."""
        self._deck = harmless(os.path.basename(deck))
        self._bar: Any = None
        try:
            self._wanted = os.path.getsize(path) >= LARGE_FILE
        except (OSError, ValueError):
            self._wanted = False

    def __enter__(self) -> Bar:
        """Nothing is shown yet."""
        return self

    def __exit__(self, *_: object) -> None:
        """Wipe the bar."""
        self.clear()

    def of_analysis(self, model: ModelData) -> Progress | None:
        """What shows the progress of an analysis; None where it would show nothing."""
        self._wanted = model.arrays.element_number.size >= LARGE_MODEL
        return self.show if self._wanted and is_watched() else None

    def show(self, stage: str, done: float = 0.0) -> None:
        """Draw the bar at a stage, of which a part from 0 to 1 is done."""
        if not self._wanted or not is_watched():
            return
        text = f"{self._deck}: {stage}"
        with contextlib.suppress(ImportError, OSError):
            if self._bar is None:
                self._bar = drawn(total=1.0, desc=text, bar_format=_BAR)
            stages = ("reading", *load("flexact.core.calls").STAGES, "writing")
            self._bar.n = max(self._bar.n, (stages.index(stage) + done) / len(stages))
            self._bar.set_description_str(text)

    def show_work(self, what: str, done: float) -> None:
        """Draw the bar of other work, of which a part from 0 to 1 is done; always wanted."""
        self._wanted = True
        if not is_watched():
            return
        text = f"{self._deck}: {what}"
        with contextlib.suppress(ImportError, OSError):
            if self._bar is None or done <= self._bar.n:
                self.clear()
                self._bar = drawn(total=1.0, desc=text, bar_format=_BAR)
            self._bar.set_description_str(text, refresh=False)
            self._bar.n = done
            self._bar.refresh()

    def clear(self) -> None:
        """Wipe the bar, so that something else can be said."""
        if self._bar is not None:
            with contextlib.suppress(OSError):
                self._bar.clear()


def drawn(**settings: Any) -> Any:
    """A bar of tqdm on stderr, as wide as the terminal."""
    tqdm = import_module("tqdm").tqdm
    # No thread of its own: the core's calls say when to draw, and processes are forked.
    tqdm.monitor_interval = 0
    # Some terminals say that they have no columns and no rows.
    width = os.get_terminal_size(sys.stderr.fileno()).columns or _WIDTH
    return tqdm(file=sys.stderr, leave=False, ncols=width - 1, nrows=_ROWS, **settings)


def is_watched() -> bool:
    """Whether stderr is a terminal."""
    return sys.stderr is not None and sys.stderr.isatty()
