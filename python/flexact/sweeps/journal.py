# SPDX-License-Identifier: BSD-3-Clause
"""What is finished of a long run, line by line, so that an interruption loses nothing of it.

A line is a check sum (CRC-32 of the rest, eight hexadecimal digits), a blank, and a record as
JSON, in which NaN and Infinity may stand. The first record is the head: what the run was asked
to do. Lines are only ever added. One that does not fit its check sum, such as the last one of a
process that was killed while it wrote, counts as if it were not there.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import time
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..util.errors import BatchError, reason_of
from ..util.loading import load
from ..util.outputs import OutputError, TakenError, keep_names, written_whole

if sys.platform != "win32":
    import fcntl

#: At most so long a power cut may reach back [s].
PAUSE = 1.0
_BUFFER = 2**20
_DIGITS = 8
_encoded = json.JSONEncoder(separators=(",", ":")).encode
_CLOSED = -1
#: The byte that stands for the file where nobody else can read what is locked: far behind its end.
_LOCKED = 2**31 - 2


class JournalError(BatchError):
    """A journal that cannot be used."""


class Journal:
    """A journal that is open for adding, and locked against other processes."""

    def __init__(self, path: Path, handle: int) -> None:
        """A file that is open for reading and adding."""
        self.path = path
        self._handle = handle
        self._size = os.fstat(handle).st_size
        self._kept = time.monotonic()
        self.head: Any = None

    @classmethod
    def begin(cls, path: Path, head: Any) -> Journal:
        """A new journal, which is there with its head or not at all.

        Raises:
            OutputError: It cannot be written.
            JournalError: Another process has just begun one.
        """
        try:
            with written_whole(path, anew=True) as file:
                file.write(_line(head))
            made = cls.resume(path)
        except TakenError:
            made = None
        if made is None or made.head != head:
            raise JournalError(f"{path} is another run's, which has just begun")
        return made

    @classmethod
    def resume(cls, path: Path) -> Journal | None:
        """The journal of a run that was interrupted; None where there is none.

        Raises:
            JournalError: It cannot be read, it is no journal, or its run goes on.
        """
        try:
            handle = os.open(path, os.O_RDWR | os.O_APPEND | getattr(os, "O_BINARY", 0))
        except FileNotFoundError:
            return None
        except OSError as error:
            raise JournalError(f"cannot read {path}: {reason_of(error)}") from error
        made = cls(path, handle)
        try:
            made._lock()
            if not made._is_in_place():
                # The run that had it locked has ended meanwhile, and taken it away.
                made.close()
                return cls.resume(path)
            place, head = next(made.entries(), (0, None))
            if head is None or place:
                raise JournalError(
                    f"{path} does not begin as a journal does; delete it to start anew"
                )
            if made._size and made._bytes(made._size - 1, 1) != b"\n":
                # What is added begins a line, whatever a killed process has left half-written.
                made._write(b"\n")
        except BaseException:
            made.close()
            raise
        made.head = head
        return made

    def _is_in_place(self) -> bool:
        """Whether the file that is open is the one at the path."""
        try:
            return os.path.samestat(os.fstat(self._handle), os.stat(self.path))
        except FileNotFoundError:
            return False

    def _lock(self) -> None:
        """Keep other processes away until this one ends, however it does."""
        try:
            if sys.platform == "win32":
                os.lseek(self._handle, _LOCKED, os.SEEK_SET)
                library = load("msvcrt")
                library.locking(self._handle, library.LK_NBLCK, 1)
            else:
                # Of this process alone: what it has forked may live a little longer.
                fcntl.lockf(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except (BlockingIOError, PermissionError):
            raise JournalError(
                f"{self.path} belongs to a run that is still going on; wait for its end"
            ) from None
        except OSError:
            return  # a file system without locks

    def entries(self) -> Iterator[tuple[int, Any]]:
        """Where lines begin with their records, in the order in which they were added."""
        place, rest = 0, b""
        while part := self._bytes(place + len(rest), _BUFFER):
            *lines, rest = (rest + part).split(b"\n")
            for line in lines:
                if (found := _record(line)) is not None:
                    yield place, found
                place += len(line) + 1

    def add(self, record: Any) -> int:
        """Add a record; a process that is killed afterwards does not lose it.

        Returns:
            Where its line begins.

        Raises:
            OutputError: It cannot be written.
        """
        place = self._size
        self._write(_line(record))
        return place

    def read(self, place: int) -> Any:
        """The record whose line begins at a place.

        Raises:
            JournalError: There is none any more.
        """
        line, size = b"", _BUFFER >> 8
        while b"\n" not in line:
            part = self._bytes(place + len(line), size)
            if not part:
                break
            line, size = line + part, _BUFFER
        found = _record(line.partition(b"\n")[0])
        if found is None:
            raise JournalError(f"{self.path} was changed by others while it was in use")
        return found

    def keep(self, *, at_once: bool = False) -> None:
        """Have the disk keep what was added, from time to time, so that a power cut cannot take it.

        Args:
            at_once: Whether it is time, however short ago it was done.

        Raises:
            OutputError: The disk cannot.
        """
        if self._handle == _CLOSED or (not at_once and time.monotonic() - self._kept < PAUSE):
            return
        try:
            os.fsync(self._handle)
        except OSError as error:
            raise OutputError(f"cannot write {self.path}: {reason_of(error)}") from error
        self._kept = time.monotonic()

    def _bytes(self, place: int, size: int) -> bytes:
        os.lseek(self._handle, place, os.SEEK_SET)
        return os.read(self._handle, size)

    def _write(self, line: bytes) -> None:
        try:
            left = memoryview(line)
            while left:
                written = os.write(self._handle, left)
                left, self._size = left[written:], self._size + written
        except OSError as error:
            raise OutputError(f"cannot write {self.path}: {reason_of(error)}") from error

    def close(self) -> None:
        """Leave the journal as it is."""
        handle, self._handle = self._handle, _CLOSED
        if handle != _CLOSED:
            with contextlib.suppress(OSError):
                os.close(handle)

    def remove(self) -> None:
        """Take the journal away: what it was for is done.

        Raises:
            OutputError: It cannot be.
        """
        if sys.platform == "win32":
            # There nothing can be removed that is open.
            self.close()
        try:
            self.path.unlink(missing_ok=True)
        except OSError as error:
            raise OutputError(f"cannot remove {self.path}: {reason_of(error)}") from error
        keep_names(self.path.absolute().parent)
        self.close()


def _line(record: Any) -> bytes:
    text = _encoded(record).encode("ascii")
    return b"%08x %s\n" % (zlib.crc32(text), text)


def _record(line: bytes) -> Any:
    """The record of a line, an object; None where the line is not whole, or holds none."""
    text = line[_DIGITS + 1 :]
    if not text or line[: _DIGITS + 1] != b"%08x " % zlib.crc32(text):
        return None
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None
