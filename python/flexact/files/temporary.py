# SPDX-License-Identifier: BSD-3-Clause
"""Names of files while they are written, and those that a killed process has left."""

from __future__ import annotations

import contextlib
import os
import re
import sys
import time
from functools import cache
from itertools import count
from pathlib import Path

from ..base.loading import load

_NAME = re.compile(r"\.flexact-([0-9a-f]{12})-([1-9][0-9]*)-[0-9]+\.tmp")
#: Between two looks into a folder [s]: a batch may write thousands of files into one.
_PAUSE = 60.0

_number = count()
_looked: dict[Path, float] = {}


def temporary_name() -> str:
    """A name that no other file has, with what tells whether its process is alive."""
    return f".flexact-{_system()}-{os.getpid()}-{next(_number)}.tmp"


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
        alive: bool = load("flexact.base.windows").is_alive(process)
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
