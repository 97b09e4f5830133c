# SPDX-License-Identifier: BSD-3-Clause
"""What is clicked in a watched page, and what the page shows then."""

from __future__ import annotations

import pickle
import threading
from http import HTTPStatus
from pathlib import Path
from typing import Any

from ...analysis.result import Result, result_of
from ...deck.rendering import ProblemsError
from ...show.page.assets import text
from ...show.page.content import kind_of
from ...util.errors import BatchError, FlexactError
from ...util.partial import why
from ...util.text import harmless
from .live_edit import Session, answered
from .messages import Answer, Broken, Shown, Told, told_of
from .scene import Stage
from .worker import shown_of


class Editor:
    """The session of a watched file: edits stay when it is saved, and are shown with it."""

    def __init__(self, path: str, stage: Stage) -> None:
        """Nothing is there to be clicked yet.

        Args:
            path: The file that is watched.
            stage: What the page shows.
        """
        self._session = Session(Path(path))
        self._stage = stage
        self._lock = threading.Lock()
        #: The file as it is, until somebody clicks.
        self._file: Shown | None = None
        self._is_taken = True
        self._number = 0

    def renewed(self, answer: Answer) -> str:
        """Show what came of the file, with all edits; what has changed, in words."""
        with self._lock:
            self._number += 1
            if isinstance(answer, Broken):
                self._session.broken()
                return self._stage.put(answer)
            self._file, self._is_taken = answer, False
            if not self._session.history.now:
                return self._stage.put(answer)
            try:
                self._take()
                now = self._analysed()
                # The file may say all of it itself now.
                if not self._session.history.now:
                    return self._stage.put(answer)
                shown = self._with_edits(now, told_of(now))
            except (FlexactError, MemoryError) as error:
                self._session.put_aside(_in_short(error))
                shown = answer
            return self._stage.put(shown)

    def judged(self, told: Told) -> None:
        """Say the verdict of the file, unless edits give another one."""
        if not self._session.history.now:
            self._stage.judge(told)

    def post(self, body: bytes) -> tuple[HTTPStatus, dict[str, Any]]:
        """Answer a request; its errors are in words.

        The verdict is in the answer, and the scene follows.
        """
        with self._lock:
            try:
                self._take()
            except FlexactError as error:
                return HTTPStatus.UNPROCESSABLE_ENTITY, {"error": str(error)}
            before = self._session.history.copy()
            reply = answered(self._session, body)
            if reply.changed:
                try:
                    self._show(self._analysed())
                except (FlexactError, MemoryError) as error:
                    self._session.history = before
                    words = f"this cannot be analysed: {_in_short(error)}"
                    return HTTPStatus.UNPROCESSABLE_ENTITY, {"error": words}
            if reply.changed or "told" in reply.content:
                now = self._session.known
                looks = {} if now is None else {"kind": kind_of(now)[0]}
                reply.content["told"] = {**self._session.told(), **looks}
            return reply.status, reply.content

    def _take(self) -> None:
        """Give the session the analysis of the file, as soon as somebody clicks.

        Raises:
            FlexactError: The model holds what the script alone can make, such as its classes.
        """
        if self._file is not None and not self._is_taken:
            try:
                base: Result = pickle.loads(self._file.result)
            except Exception as error:
                words = f"this model cannot be switched: {harmless(' '.join(str(error).split()))}"
                raise BatchError(words) from error
            self._is_taken = True
            self._session.model_name = self._file.model or "model"
            self._session.renew(base)

    def _analysed(self) -> Result:
        """The analysis with all edits.

        Raises:
            FlexactError: The mechanism cannot be analysed.
            MemoryError: It is too large.
        """
        base = now = self._session.board.base
        if self._session.history.now:
            now = result_of(self._session.model(), base.asked, base.name, kind=Result)
        self._session.analysed(now)
        return now

    def _show(self, now: Result) -> None:
        """Show a result, unless another one comes meanwhile."""
        self._number += 1
        number = self._number
        if now is self._session.board.base and self._file is not None:
            self._stage.put(self._file)
            return

        def show() -> None:
            try:
                told = told_of(now)
                with self._lock:
                    if number != self._number:
                        return
                    self._stage.judge(told)
                shown: Answer = self._with_edits(now, told)
            except Exception as error:
                words = _in_short(error)
                shown = Broken("cannot be drawn", text(words), text(words), words, ())
            with self._lock:
                if number == self._number:
                    self._stage.put(shown)

        threading.Thread(target=show, daemon=True).start()

    def _with_edits(self, now: Result, told: Told) -> Shown:
        """What the page shows of a result with edits."""
        assert self._file is not None
        count = len(self._session.history.now)
        changes = f"with {count} change{'s' * (count > 1)} that the file does not have"
        which = f"{self._file.which}, {changes}" if self._file.which else changes
        return shown_of(now, told, which, self._file.files, is_edited=True)


def _in_short(error: Exception) -> str:
    if isinstance(error, ProblemsError) and error.diagnostics:
        return harmless(error.diagnostics[0].message)
    return harmless(why(error))
