# SPDX-License-Identifier: BSD-3-Clause
"""Watches a deck or a script: whenever it is saved, what it gives is shown anew."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from ...show.browser import opens
from ...util.errors import BatchError
from .edit_session import Editor
from .errors_part import errors_part
from .saved import Saved
from .scene import Stage
from .server import Server
from .watching_messages import Answer, Broken, Job, Judged, Printed
from .worker_pool import Crew, Worker, WorkerError

#: Between two looks at the files [s].
_LOOK = 0.03
SCRIPT = ".py"


@dataclass(frozen=True)
class Heard:
    """What the watching tells whoever started it.

    Attributes:
        renewed: Called with what a save has changed, and the answer.
        printed: Called with what a script prints.
    """

    renewed: Callable[[str, Answer], None]
    printed: Callable[[str], None]


class Watch:
    """A file that is watched, and the server of its page."""

    def __init__(
        self,
        path: str,
        heard: Heard,
        port: int | None = None,
        decision: tuple[object, ...] = ("auto", None),
    ) -> None:
        """Start the server; nothing is analysed yet.

        Args:
            path: The deck, or the script (.py).
            heard: Who hears of what is going on.
            port: The port; by default a free one.
            decision: Arguments of `flexact.analysis.spaces.asked_for`.

        Raises:
            BatchError: The port cannot be had.
        """
        self.name = os.path.basename(path)
        self.job = Job(path, path.lower().endswith(SCRIPT), decision)
        self._heard = heard
        self.stage = Stage(self.name)
        self.server = Server(path, self.stage, port)
        self.editor = Editor(path, self.stage)
        self.server.posts["edit"] = self.editor.post
        self.crew = Crew(fresh=self.job.is_script)
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
        self.stage.work(f"{self.name} is {'running' if self.job.is_script else 'being analysed'}")
        worker: Worker | WorkerError
        try:
            worker = self.crew.take()
        except WorkerError as error:
            worker = error
        threading.Thread(target=self._answer, args=(worker, number), daemon=True).start()

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
                answer = worker.answer(self.job, lambda heard: self._meanwhile(heard, number))
            except WorkerError as error:
                answer = _unshown(str(error), self.job.path)
            with self._lock:
                # Another save came meanwhile, and it is that one's worker that counts.
                if number != self._number:
                    return
                self._saved.also(answer.files)
                try:
                    words = self.editor.renewed(answer)
                except Exception as error:
                    # One that cannot be shown shall not end the watch.
                    answer = _unshown(f"unforeseen {type(error).__name__}: {error}", self.job.path)
                    words = self.stage.put(answer)
                self._heard.renewed(words, answer)
            self.crew.prepare()
        except BaseException as error:
            # It is the main thread's to end with.
            self._failure = error

    def _meanwhile(self, heard: Printed | Judged, number: int) -> None:
        with self._lock:
            if number != self._number:
                return
            if isinstance(heard, Printed):
                self._heard.printed(heard.text)
            else:
                self.editor.judged(heard.told)


def _unshown(words: str, path: str) -> Broken:
    errors = errors_part(BatchError(words), path)
    return Broken("cannot be analysed", errors, f"<main>{errors}</main>", words, ())
