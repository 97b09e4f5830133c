# SPDX-License-Identifier: BSD-3-Clause
"""Watches a deck, a script or a STEP file: whenever it is saved, what it gives is shown anew."""

from __future__ import annotations

import math
import os
import stat
import threading
import time
from collections.abc import Callable, Iterable
from pathlib import Path

from ...show.window import opens
from ...util.errors import BatchError
from .cad import is_step
from .edit_session import Session
from .scene import SCRIPT, Answer, Before, Broken, Laid, Shown, Stage, errors_part, is_problem
from .server import Server
from .worker_pool import Crew, Worker, WorkerError

#: So long nothing may change before a file counts as saved [s].
QUIET = 0.08
#: The same of a file that is not there, is empty, or ends amid a line where it did not before.
UNFINISHED = 0.6
#: The same of a STEP file without its last words: CAD writes large ones bit by bit.
WRITING = 10.0
#: The last words of a STEP file, and how many blanks may follow.
_LAST, _BLANKS = b"END-ISO-10303-21", 200
#: A look at files that are saved without end does not wait for ever [s].
_LONGEST = 3.0

_HOW = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)

#: Time of the last change, size, and place on the disk; None where there is no file.
_State = tuple[int, int, int] | None


class Saved:
    """The files, as they were when they were last at rest."""

    def __init__(self, path: str) -> None:
        """Start with one file, as it is now."""
        self.path = path
        self._more: tuple[str, ...] = ()
        self._rest = self._seen = self._look()
        self._since = self._first = 0.0
        self._was_whole, self._is_step = _is_whole(path), is_step(path)

    def also(self, paths: Iterable[str]) -> None:
        """Watch these files besides, as they are now, and no others."""
        more = tuple(dict.fromkeys(paths))
        if more == self._more:
            return
        kept = {path: self._rest[path] for path in (self.path, *self._more)}
        self._more = more
        now = self._look()
        # What was watched before may have changed while the others were found.
        self._rest = {path: kept.get(path, state) for path, state in now.items()}
        self._seen = now

    def is_renewed(self) -> bool:
        """Whether something was saved since this was last true, and is at rest now."""
        now, time_now = self._look(), time.monotonic()
        if now != self._seen:
            if self._seen == self._rest:
                self._first = time_now
            self._seen, self._since = now, time_now
            return False
        if now == self._rest:
            return False
        is_whole = _is_whole(self.path)
        ends = is_whole or (is_whole is not None and not self._was_whole)
        patience, longest = QUIET if ends else UNFINISHED, _LONGEST
        if self._is_step and not is_whole:
            patience, longest = WRITING, math.inf
        if time_now - self._first < longest and time_now - self._since < patience:
            return False
        self._rest, self._was_whole = now, is_whole
        return True

    def _look(self) -> dict[str, _State]:
        return {path: _state(path) for path in (self.path, *self._more)}


def _state(path: str) -> _State:
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


def _is_whole(path: str) -> bool | None:
    """Whether a file ends with a line, or as STEP files do; None where it is empty or not there."""
    try:
        # What is no file may keep whoever opens it waiting.
        if not stat.S_ISREG(os.stat(path).st_mode):
            return None
        with open(os.open(path, _HOW), "rb") as file:
            file.seek(0, os.SEEK_END)
            if not file.tell():
                return None
            if is_step(path):
                file.seek(-min(file.tell(), len(_LAST) + _BLANKS), os.SEEK_END)
                return _LAST in file.read()
            file.seek(-1, os.SEEK_END)
            return file.read(1) in b"\r\n"
    except OSError:
        return None


#: Between two looks at the files [s].
_LOOK = 0.03


class Watch:
    """A file that is watched, and the server of its page."""

    def __init__(
        self,
        path: str,
        renewed: Callable[[str, Answer], None],
        printed: Callable[[str], None],
        port: int | None = None,
        decision: tuple[object, ...] = ("auto", None),
    ) -> None:
        """Start the server; nothing is analysed yet.

        Args:
            path: The deck, the script (.py), the STEP file (.step, .stp), or the design problem
                (.toml, .json).
            renewed: Called with what a save has changed, and the answer.
            printed: Called with what a script prints.
            port: The port; by default a free one.
            decision: Arguments of `flexact.analysis.decomposition.asked_for`.

        Raises:
            BatchError: The port cannot be had.
        """
        self.name = os.path.basename(path)
        self.path, self._decision = path, decision
        is_script = path.lower().endswith(SCRIPT)
        doing = "running" if is_script else "being read" if is_step(path) else "being analysed"
        of_layouts = is_problem(path)
        doing = "being read, and layouts are sought" if of_layouts else doing
        self._work = f"{self.name} is {doing}"
        self._renewed, self._printed = renewed, printed
        self.stage = Stage(self.name, of_layouts=of_layouts)
        self.session = Session(Path(path), self.stage)
        self.server = Server(path, self.stage, self.session.post, port)
        self.crew = Crew(fresh=is_script, ready=of_layouts)
        self._saved = Saved(path)
        self._lock = threading.Lock()
        self._number = 0
        self._failure: BaseException | None = None

    def opens(self) -> bool:
        """Open the page in the browser of this desk; False where there is none."""
        try:
            return opens(self.server.secrets.door(self.server.address).as_uri())
        except OSError:
            return False

    def run(self) -> None:
        """Go on until an exception, such as that of Ctrl-C, ends it."""
        threading.Thread(target=self.server.serve_forever, args=(0.1,), daemon=True).start()
        self.renew()
        while True:
            time.sleep(_LOOK)
            if self._failure is not None:
                raise self._failure
            if self._saved.is_renewed():
                self.renew()

    def renew(self) -> None:
        """Analyse the file as it is now; what was at work before is stopped."""
        with self._lock:
            self._number += 1
            number = self._number
        self.stage.work(self._work)
        worker: Worker | WorkerError
        try:
            worker = self.crew.take()
        except WorkerError as error:
            worker = error
        threading.Thread(target=self._answer, args=(worker, number), daemon=True).start()
        # Where the one before was stopped there is none for the next save.
        threading.Thread(target=self.crew.prepare, daemon=True).start()

    def close(self) -> None:
        """Stop everything, and let the pages know."""
        with self._lock:
            self._number += 1
        self.stage.close()
        self.crew.close()
        self.server.server_close()

    def _answer(self, worker: Worker | WorkerError, number: int) -> None:
        try:
            try:
                if isinstance(worker, WorkerError):
                    raise worker
                question = self.path, self._decision
                answer = worker.answer(question, lambda heard: self._meanwhile(heard, number))
            except WorkerError as error:
                answer = _unshown(str(error), self.path)
            with self._lock:
                # Another save came meanwhile, and it is that one's worker that counts.
                if number != self._number:
                    return
                self._saved.also(answer.files)
                try:
                    if isinstance(answer, Laid):
                        words = self.stage.put(answer)
                    else:
                        words = self.session.renewed(answer)
                except Exception as error:
                    # One that cannot be shown shall not end the watch.
                    answer = _unshown(f"unforeseen {type(error).__name__}: {error}", self.path)
                    words = self.stage.put(answer)
                self._renewed(words, answer)
            self.crew.prepare()
        except BaseException as error:
            # It is the main thread's to end with.
            self._failure = error

    def _meanwhile(self, heard: Before, number: int) -> None:
        with self._lock:
            if number != self._number:
                return
            if isinstance(heard, str):
                self._printed(heard)
            elif isinstance(heard, Laid):
                self.stage.put(heard)
            elif isinstance(heard, Shown):
                # What it was made of may be saved before it is whole.
                self._saved.also(heard.files)
                self.session.renewed(heard)
            else:
                self.session.judged(heard)


def _unshown(words: str, path: str) -> Broken:
    errors = errors_part(BatchError(words), path)
    return Broken(errors, f"<main>{errors}</main>", words, ())
