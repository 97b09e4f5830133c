# SPDX-License-Identifier: BSD-3-Clause
"""Files while they are written, and those that a killed process has left."""

from __future__ import annotations

import contextlib
import os
import re
import sys
import time
from functools import cache
from pathlib import Path
from typing import BinaryIO

from .loading import load

_NAME = re.compile(r"\.flexact-([0-9a-f]{12})-([1-9][0-9]*)-[0-9a-f]+\.tmp")
#: Between two looks into a folder [s]: a batch may write thousands of files into one.
_PAUSE = 60.0

_looked: dict[Path, float] = {}


def temporary_name() -> str:
    """A name that nobody can know before, with what tells whether its process is alive."""
    return f".flexact-{_system()}-{os.getpid()}-{os.urandom(8).hex()}.tmp"


def new_file(path: Path, like: Path | None = None, mode: int = 0o666) -> BinaryIO:
    """A new file to write; whatever stands there, also a link, is neither followed nor changed.

    Args:
        path: Where it is made.
        like: A file whose mode it gets, where there is one: what others may not read stays so.
        mode: What others may do else, as far as they may do it with every new file.

    Raises:
        OSError: It cannot be made, or something is there already.
    """
    how = os.O_WRONLY | os.O_CREAT | os.O_EXCL
    for name in ("O_NOFOLLOW", "O_CLOEXEC", "O_BINARY"):
        how |= getattr(os, name, 0)
    kept: int | None = None
    if like is not None:
        with contextlib.suppress(FileNotFoundError):
            kept = mode = like.stat().st_mode & 0o777
    handle = os.open(path, how, mode)
    if kept is not None and hasattr(os, "fchmod"):
        # A file system of another kind may have no such modes.
        with contextlib.suppress(OSError):
            os.fchmod(handle, kept)
    return open(handle, "wb")


def remove_left(folder: Path) -> None:
    """Remove the files of this user's processes on this system that are no longer alive."""
    now = time.monotonic()
    if now - _looked.get(folder, -_PAUSE) < _PAUSE:
        return
    _looked[folder] = now
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            found = _NAME.fullmatch(entry.name)
            if found and found[1] == _system() and _is_left(entry, int(found[2])):
                with contextlib.suppress(OSError):
                    os.unlink(entry.path)


def _is_left(entry: os.DirEntry[str], process: int) -> bool:
    if not entry.is_file(follow_symlinks=False):
        return False
    if hasattr(os, "geteuid") and entry.stat(follow_symlinks=False).st_uid != os.geteuid():
        return False
    return not _is_alive(process)


def _is_alive(process: int) -> bool:
    if sys.platform == "win32":
        # There os.kill ends a process whatever it is told.
        alive: bool = load("flexact.util.windows").is_alive(process)
        return alive
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


@cache
def _system() -> str:
    """Within what process numbers have a meaning: a run of a machine, and a container in it."""
    # Loaded where a file is written, for they take a tenth of the time of the first word.
    parts: list[str] = [load("socket").gethostname()]
    with contextlib.suppress(OSError):
        parts.append(Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii"))
    with contextlib.suppress(OSError):
        parts.append(os.readlink("/proc/self/ns/pid"))
    found: str = load("hashlib").sha256("\n".join(parts).encode()).hexdigest()
    return found[:12]
