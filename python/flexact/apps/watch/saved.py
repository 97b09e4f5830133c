# SPDX-License-Identifier: BSD-3-Clause
"""Files that are watched: whether they were saved, and are at rest again.

They are looked at again and again, which works for every way to save, and on every file system.
"""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Iterable

#: So long nothing may change before a file counts as saved [s].
QUIET = 0.08
#: The same of a file that is not there, is empty, or ends amid a line where it did not before.
UNFINISHED = 0.6
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
        self._was_whole = _is_whole(path)

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
        if time_now - self._first < _LONGEST and time_now - self._since < self._patience():
            return False
        self._rest = now
        self._was_whole = _is_whole(self.path)
        return True

    def _patience(self) -> float:
        is_whole = _is_whole(self.path)
        return QUIET if is_whole or (is_whole is not None and not self._was_whole) else UNFINISHED

    def _look(self) -> dict[str, _State]:
        return {path: _state(path) for path in (self.path, *self._more)}


def _state(path: str) -> _State:
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


def _is_whole(path: str) -> bool | None:
    """Whether a file ends with a line; None where it is empty or not there."""
    try:
        # What is no file may keep whoever opens it waiting.
        if not stat.S_ISREG(os.stat(path).st_mode):
            return None
        with open(os.open(path, _HOW), "rb") as file:
            file.seek(0, os.SEEK_END)
            if not file.tell():
                return None
            file.seek(-1, os.SEEK_END)
            return file.read(1) in b"\r\n"
    except OSError:
        return None
