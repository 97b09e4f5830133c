# SPDX-License-Identifier: BSD-3-Clause
"""What is clicked in a watched page, and what the page shows then."""

from __future__ import annotations

import pickle
import threading
from http import HTTPStatus
from pathlib import Path
from typing import Any

from ..base.errors import FlexactError
from ..base.plain_text import harmless
from ..diagnostics.errors import ProblemsError
from ..page.verdict_part import kind_of
from ..result.result import Result, result_of
from ..switches import Session, answered
from .answering import shown_of
from .messages import Answer, Broken, Shown
from .scene import Stage


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

    def renewed(self, answer: Answer) -> str:
        """Show what came of the file, with all edits; what has changed, in words."""
        with self._lock:
            if isinstance(answer, Broken):
                self._session.broken()
                return self._stage.put(answer)
            self._file, self._is_taken = answer, False
            if not self._session.history.now:
                return self._stage.put(answer)
            self._take()
            try:
                shown = self._shown()
            except (FlexactError, MemoryError) as error:
                self._session.put_aside(_in_short(error))
                shown = answer
            return self._stage.put(shown)

    def post(self, body: bytes) -> tuple[HTTPStatus, dict[str, Any]]:
        """Answer a request; its errors are in words."""
        with self._lock:
            self._take()
            before = self._session.history.copy()
            reply = answered(self._session, body)
            if reply.changed:
                try:
                    self._stage.put(self._shown())
                except (FlexactError, MemoryError) as error:
                    self._session.history = before
                    words = f"this cannot be analysed: {_in_short(error)}"
                    return HTTPStatus.UNPROCESSABLE_ENTITY, {"error": words}
            if "told" in reply.content:
                reply.content["told"].update(self._looks())
            return reply.status, reply.content

    def _take(self) -> None:
        """Give the session the analysis of the file, as soon as somebody clicks."""
        if self._file is not None and not self._is_taken:
            self._is_taken = True
            base: Result = pickle.loads(self._file.result)
            self._session.model_name = self._file.model or "model"
            self._session.renew(base)

    def _shown(self) -> Shown:
        """What the page shows with all edits.

        Raises:
            FlexactError: The mechanism cannot be analysed.
            MemoryError: It is too large.
        """
        assert self._file is not None
        base, count = self._session.board.base, len(self._session.history.now)
        if not count:
            self._session.analysed(base)
            return self._file
        now = result_of(self._session.model(), base.asked, base.name)
        self._session.analysed(now)
        changes = f"with {count} change{'s' * (count > 1)} that the file does not have"
        which = f"{self._file.which}, {changes}" if self._file.which else changes
        return shown_of(now, which, self._file.files)

    def _looks(self) -> dict[str, Any]:
        """The colour of the verdict, by the class of the page."""
        now = self._session.known
        return {} if now is None else {"kind": kind_of(now)[0]}


def _in_short(error: FlexactError | MemoryError) -> str:
    if isinstance(error, ProblemsError) and error.diagnostics:
        return harmless(error.diagnostics[0].message)
    return harmless(str(error)) or "not enough memory"
