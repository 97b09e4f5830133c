# SPDX-License-Identifier: BSD-3-Clause
"""A process that waits, with everything loaded, for decks to analyse or a script to run."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import pickle
import queue
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import ModuleType, TracebackType
from typing import Any, BinaryIO

from ...analysis.decomposition import asked_for
from ...analysis.result import Result, result_of
from ...deck.diagnostics import Diagnostic, Place, Problems, Severity, Source
from ...deck.rendering import ProblemsError
from ...model.model import Model
from ...model.reading import file_bytes, read_file
from ...show.page.content import broken_content
from ...show.window import take_with
from ...util.loading import load
from ...util.machine import prepare_libraries
from ...util.partial import why
from ..convert.cad.kept_choices import choices_beside
from .cad import is_step, read_cad
from .scene import (
    SCRIPT,
    Answer,
    Before,
    Broken,
    Laid,
    Shown,
    errors_part,
    is_problem,
    shown_of,
    summary_of,
    takes_a_while,
)
from .worker_pool import receive, send

#: How many callers of the line that failed are named.
_MOST_CALLERS = 3


class Script:
    """A script and the folder that its own modules are in."""

    def __init__(self, path: str) -> None:
        """Nothing is run yet."""
        self.path = os.path.abspath(path)
        self.name = os.path.basename(path)
        self.folder = os.path.dirname(self.path)
        self._read: set[str] = set()
        self._wanted: set[str] = set()
        self._shown: list[tuple[Any, int]] = []
        self._start = time.time()

    def run(self) -> tuple[Model | Result, str, str, str]:
        """Run it as `python script.py` does, and find what it shows.

        Returns:
            A model or the result of one, what it is called where it has no name, which of the
            script's it is, in words, and the name of the model in the script.

        Raises:
            DeckError: The script or a deck that it reads cannot be read.
            ProblemsError: It fails, or shows nothing.
        """
        source = file_bytes(self.path)
        take_with(lambda shown, line: self._shown.append((shown, line)))
        sys.addaudithook(self._heard)
        main = ModuleType("__main__")
        main.__file__ = self.path
        sys.modules["__main__"] = main
        sys.argv = [self.path]
        sys.path.insert(0, self.folder)
        try:
            exec(compile(source, self.path, "exec"), main.__dict__)
        except SystemExit as ending:
            code = ending.code
            if code is not None and not (isinstance(code, int) and code == 0):
                raise self._failed(ending) from None
        except BaseException as error:
            raise self._failed(error) from None
        finally:
            # It may have closed it, or put something else there.
            with contextlib.suppress(Exception):
                sys.stdout.flush()
        return self._found(main)

    def files(self) -> tuple[str, ...]:
        """Files of its own folder that it has read, or wanted: modules, decks, tables."""
        modules = {getattr(module, "__file__", None) for module in list(sys.modules.values())}
        read = {path for path in {*modules, *self._read} if path and self._is_own(path)}
        return tuple(sorted(read | self._wanted))

    def _is_own(self, path: str) -> bool:
        if path == self.path or not path.startswith(self.folder + os.sep):
            return False
        if {"site-packages", "__pycache__"} & set(Path(path).parts):
            return False
        try:
            # What it has written itself would have it run again, and again.
            return os.path.isfile(path) and os.stat(path).st_mtime < self._start
        except OSError:
            return False

    def _heard(self, event: str, arguments: tuple[Any, ...]) -> None:
        """Keep which files are read; of everything that Python does this is called."""
        if event != "open" or not isinstance(arguments[0], str):
            return
        if not arguments[2] & (os.O_WRONLY | os.O_RDWR):
            self._read.add(os.path.abspath(arguments[0]))

    def _found(self, main: ModuleType) -> tuple[Model | Result, str, str, str]:
        if self._shown:
            shown, line = self._shown[-1]
            count = len(self._shown)
            of = f", the last of {count} that are shown" if count > 1 else ""
            name = next((k for k, value in vars(main).items() if value is shown), self.name)
            which = f"shown in line {line} of {self.name}{of}"
            return shown, name, which, _model_name(main, shown)
        made = {
            name: value
            for name, value in vars(main).items()
            if isinstance(value, (Model, Result)) and not name.startswith("_")
        }
        if not made:
            item = Diagnostic(
                Severity.ERROR,
                "nothing-to-show",
                "the script shows nothing and has no Model or Analysis",
                help="end it with model.show(), or give the model a name: guide = flexact.Model()",
            )
            raise ProblemsError(Problems.of([item]), self.name)
        name, value = next(reversed(made.items()))
        which = f"{name}, the last model or analysis of {self.name}"
        return value, name, which, _model_name(main, value)

    def _failed(self, error: BaseException) -> ProblemsError:
        """The error in words, at its place in a file of the user."""
        self._want(error)
        if isinstance(error, SyntaxError) and error.filename:
            return self._wrong_syntax(error)
        if isinstance(error, ProblemsError) and error.source is not None:
            return error
        path, place, callers = self._place(error.__traceback__)
        problems = [
            Diagnostic(Severity.ERROR, code, message, *place, help=hint)
            for code, message, hint in _said(error)
        ]
        if callers:
            hint = "; ".join(filter(None, (problems[-1].help, callers)))
            problems[-1] = replace(problems[-1], help=hint)
        return ProblemsError(Problems.of(problems), self._shortened(path), _source(path))

    def _want(self, error: BaseException) -> None:
        """Keep what is missing in its folder: once it is there, it goes on."""
        name = None
        if isinstance(error, ModuleNotFoundError) and error.name:
            name = f"{error.name.split('.')[0]}.py"
        elif isinstance(error, FileNotFoundError) and isinstance(error.filename, str):
            name = error.filename
        elif isinstance(error, ProblemsError) and error.source is None and error.name:
            name = error.name
        if name is not None and "\0" not in name:
            path = os.path.abspath(os.path.join(self.folder, name))
            if path.startswith(self.folder + os.sep) and not os.path.exists(path):
                self._wanted.add(path)

    def _wrong_syntax(self, error: SyntaxError) -> ProblemsError:
        path = os.path.abspath(str(error.filename))
        self._read.add(path)
        column = max(1, error.offset or 1)
        last = max(column, (error.end_offset or column + 1) - 1)
        same_line = getattr(error, "end_lineno", None) in (None, error.lineno)
        item = Diagnostic(
            *(Severity.ERROR, type(error).__name__, error.msg or "wrong syntax"),
            *(error.lineno or 1, column, last if same_line else column),
        )
        return ProblemsError(Problems.of([item]), self._shortened(path), _source(path))

    def _place(self, trace: TracebackType | None) -> tuple[str, Place, str]:
        """The innermost place in a file of the user, and by which lines it was called."""
        own = [
            frame
            for frame in traceback.extract_tb(trace)
            if frame.filename == self.path or self._is_own(frame.filename)
        ]
        self._read |= {frame.filename for frame in own}
        if not own:
            return self.path, Place(0, 0, 0), ""
        *callers, inner = own
        line = inner.lineno or 1
        source = _source(inner.filename)
        first, last = 1, 1
        if source is not None:
            text = source.line(line)
            first = len(text) - len(text.lstrip()) + 1
            last = max(first, len(text.rstrip()))
            start, end = getattr(inner, "colno", None), getattr(inner, "end_colno", None)
            if start is not None and end is not None and inner.end_lineno == line:
                first, last = start + 1, max(start + 1, end)
            first, last = source.character_columns(line, first, last)
        names = [f"{self._shortened(each.filename)}:{each.lineno}" for each in reversed(callers)]
        words = f"called from {', '.join(names[:_MOST_CALLERS])}" if names else ""
        return inner.filename, Place(line, first, last), words

    def _shortened(self, path: str) -> str:
        return os.path.relpath(path, self.folder) if path.startswith(self.folder) else path


def _model_name(main: ModuleType, shown: object) -> str:
    """The name of the model that is shown, or of which the result is that is shown."""
    names = (
        name
        for name, value in vars(main).items()
        if isinstance(value, Model)
        and not name.startswith("_")
        and (value is shown or (isinstance(shown, Result) and value.data is shown.given))
    )
    return next(names, "model")


def _said(error: BaseException) -> Iterator[tuple[str, str, str]]:
    """Code, message and help of an error."""
    if isinstance(error, ProblemsError):
        for item in error.diagnostics:
            yield item.code, item.message, item.help
        return
    kind = type(error).__name__
    if isinstance(error, SystemExit):
        yield kind, f"the script ended itself with {_words(repr, error.code) or 'an object'}", ""
        return
    words = _words(str, error)
    # The key alone says nothing.
    if isinstance(error, KeyError) and words:
        words = f"there is no key {words}"
    yield kind, words or f"the script stopped with {kind}", ""


def _words(how: Callable[[object], str], of: object) -> str:
    """What an object of a script says of itself, in a line; nothing where it cannot."""
    try:
        return " ".join(how(of).split())
    except Exception:
        return ""


def _source(path: str) -> Source | None:
    try:
        return Source(file_bytes(path), path)
    except ProblemsError:
        return None


def answer_of(
    path: str,
    judged: Callable[[Before], None],
    decision: tuple[Any, ...] = ("auto", None),
) -> Answer:
    """What a deck or a script gives; what is wrong with it is an answer too.

    Args:
        path: Where it is; a script ends with .py, a STEP file with .step or .stp.
        judged: Called with the summary, which is there before the scene, with the scene before
            its motions are followed, and of a problem with layouts while more are sought.
        decision: Arguments of `flexact.analysis.decomposition.asked_for`.
    """
    script = Script(path) if path.lower().endswith(SCRIPT) else None
    which = model = ""
    scenery = cad = None
    # What is said of the parts of a STEP file is watched with it, also before there is anything.
    files: tuple[str, ...] = (str(choices_beside(Path(path))),) if is_step(path) else ()
    result: Result
    try:
        if is_problem(path):
            made: Laid = problems_watched().answer_of(path, judged)
            return made
        if is_step(path):
            mechanism, scenery, cad = read_cad(path)
            result = result_of(mechanism.model.data, asked_for(*decision), mechanism.assembly.name)
        elif script is None:
            result = result_of(read_file(path), asked_for(*decision))
        else:
            found, name, which, model = script.run()
            if isinstance(found, Result):
                result = found
            else:
                result = result_of(found.data, asked_for(*decision), found.data.name or name)
        summary = summary_of(result)
        judged(summary)
        files = files if script is None else script.files()
        kept = b""
        # A script may have put into it what cannot be kept for who switches.
        with contextlib.suppress(Exception):
            kept = pickle.dumps(result, pickle.HIGHEST_PROTOCOL)

        def shown(*, is_whole: bool) -> Shown:
            told = result, summary, which, files
            made = shown_of(*told, scenery=scenery, cad=cad, is_whole=is_whole)
            return replace(made, result=kept, model=model)

        if takes_a_while(result):
            judged(shown(is_whole=False))
        return shown(is_whole=True)
    except Exception as error:
        words = str(error) if isinstance(error, ProblemsError) else why(error)
        files = files if script is None else script.files()
        errors = errors_part(error, path)
        if is_problem(path):
            body = broken_content(error, path, what="Problem", verb="read").body
            return Broken(errors, body, words, files, "cannot be read")
        return Broken(errors, broken_content(error, path).body, words, files)


@cache
def problems_watched() -> Any:
    """What answers design problems, with what it has drawn before; few watch one."""
    return load("flexact.apps.watch.design").Watched()


def main() -> None:
    """Answer jobs until nobody asks any more; what scripts print goes along with the answers."""
    prepare_libraries()
    jobs, line = _lines()
    said = _Said(line)
    sys.stdout = io.TextIOWrapper(said, "utf-8", "replace", line_buffering=True)
    printed = sys.stdout
    waiting: queue.SimpleQueue[Any] = queue.SimpleQueue()
    threading.Thread(target=_hear, args=(jobs, waiting), daemon=True).start()
    while True:
        path, decision = waiting.get()
        answer = answer_of(path, said.send, decision)
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
            waiting.put(receive(jobs))
    except (EOFError, OSError) as error:
        # What the script itself has closed says nothing of who asks, who ends this process then.
        if getattr(error, "errno", None) == errno.EBADF:
            return
    if hasattr(os, "killpg"):
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


class _Said(io.RawIOBase):
    """The line of answers, for one speaker at a time, and where what a script prints goes."""

    def __init__(self, line: BinaryIO) -> None:
        self._line, self._process = line, os.getpid()
        self._lock = threading.Lock()

    def send(self, value: Any) -> None:
        with self._lock:
            send(self._line, value)

    def writable(self) -> bool:
        return True

    def write(self, content: Any) -> int:
        taken = bytes(content)
        if os.getpid() != self._process:
            # A process that was forked has the same line, where its words would fall into others.
            return os.write(2, taken)
        self.send(taken.decode("utf-8", "replace"))
        return len(taken)
