# SPDX-License-Identifier: BSD-3-Clause
"""A process that waits, with everything loaded, for decks to analyse or for a script to run."""

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
from collections.abc import Callable
from dataclasses import replace
from typing import Any, BinaryIO

from ...analysis.decomposition import asked_for
from ...analysis.result import Result, result_of
from ...analysis.verdict_words import verdict_word
from ...core import narrow
from ...deck.rendering import ProblemsError, render_problems
from ...model.data import ModelData
from ...model.reading import read_file
from ...show.page.content import broken_content, content_of
from ...util.partial import why
from . import worker_pool as frames
from .messages import Answer, Broken, Job, ResultSummary, Shown, summary_of
from .scene import errors_part
from .script import Script


def answer_of(job: Job, judged: Callable[[ResultSummary], None]) -> Answer:
    """What a job gives; what is wrong with the deck or the script is an answer too.

    Args:
        job: What is asked for.
        judged: Called with the summary, which is there before the scene.
    """
    script = Script(job.path) if job.is_script else None
    which = model = ""
    result: Result | None
    try:
        if script is None:
            result = result_of(read_file(job.path), asked_for(*job.decision))
        else:
            found = script.run()
            which, model = found.which, found.model
            result = found.shown if isinstance(found.shown, Result) else None
            if result is None:
                data: ModelData = found.shown.data
                result = result_of(data, asked_for(*job.decision), data.name or found.name)
        summary = summary_of(result)
        judged(summary)
        shown = shown_of(result, summary, which, () if script is None else script.files())
        kept = b""
        # A script may have put into it what cannot be kept for who switches.
        with contextlib.suppress(Exception):
            kept = pickle.dumps(result, pickle.HIGHEST_PROTOCOL)
        return replace(shown, result=kept, model=model)
    except Exception as error:
        words = str(error) if isinstance(error, ProblemsError) else why(error)
        files = () if script is None else script.files()
        body = broken_content(error, job.path).body
        return Broken("cannot be analysed", errors_part(error, job.path), body, words, files)


def shown_of(
    result: Result,
    summary: ResultSummary,
    which: str,
    files: tuple[str, ...],
    *,
    is_edited: bool = False,
) -> Shown:
    """A result as the page shows it.

    Args:
        result: The result.
        summary: Of it.
        which: Which model it is, in words.
        files: What it was made of.
        is_edited: Whether it is not that of the file.
    """
    body = content_of(result, has_origin=not is_edited).body
    title = verdict_word(result)
    given = result.given
    problems = given.problems
    words = render_problems(problems, given.name, given.source) if problems.kept else ""
    return Shown(title, body, summary, which, words, files)


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
        self._said.send(taken.decode("utf-8", "replace"))
        return len(taken)
