# SPDX-License-Identifier: BSD-3-Clause
"""STEP files read in a child process, within a minute and 4 GB."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

from ....util.errors import BatchError, reason_of
from .assembly import Assembly, Choices

#: Suffixes of STEP files.
SUFFIXES = (".step", ".stp")
#: So much time and memory a file may take [s, bytes].
SECONDS, MEMORY = 60, 4 * 2**30
#: The first line of every STEP file, among the first bytes.
_MAGIC, _HEAD = b"ISO-10303-21", 4096
_START = (
    "import sys; sys.path.insert(0, sys.argv[1]); "
    "from flexact.apps.convert.cad.child import main; main()"
)
_HOME = str(Path(__file__).resolve().parents[4])


def recognised(
    path: Path,
    choices: Choices | None = None,
    *,
    drawing: bool = True,
    seconds: int = SECONDS,
    memory: int = MEMORY,
) -> Assembly:
    """What a STEP file holds, as flexures and bodies.

    Args:
        path: The file.
        choices: What the designer says of its parts.
        drawing: Whether the triangles of its pieces are wanted.
        seconds: The longest that it may take.
        memory: The most memory that it may take [bytes].

    Raises:
        BatchError: it cannot be read, is no STEP file, holds no solids, or takes too much; or
            OpenCASCADE is missing, or a choice names what is not there.
    """
    require_step(path)
    if find_spec("OCP") is None:
        raise BatchError(
            "STEP files need OpenCASCADE, the extra cad: pip install cadquery-ocp-novtk "
            "(Python 3.11 or later)"
        )
    question = pickle.dumps((os.path.abspath(path), choices or Choices(), drawing, memory, seconds))
    try:
        process = subprocess.Popen(
            [sys.executable, "-c", _START, _HOME],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
    except OSError as error:
        raise BatchError(f"{path}: no process can be started: {reason_of(error)}") from error
    try:
        found, _ = process.communicate(question, timeout=seconds)
    except subprocess.TimeoutExpired:
        raise BatchError(_too_long(path, seconds)) from None
    finally:
        if process.poll() is None:
            process.kill()
            process.communicate()
    if process.returncode != 0 or not found:
        raise BatchError(_death(path, process.returncode, seconds))
    made = pickle.loads(found)
    if not isinstance(made, Assembly):
        raise BatchError(f"{path}: {made}")
    return made


def require_step(path: Path) -> None:
    """Raise unless a file begins as STEP files do.

    Raises:
        BatchError: it does not, or cannot be read.
    """
    try:
        if path.is_dir():
            raise BatchError(f"{path}: this is a directory; name a STEP file in it")
        if path.exists() and not path.is_file():
            raise BatchError(
                f"{path}: this is not a regular file; write the STEP file to one first"
            )
        with open(path, "rb") as file:
            head = file.read(_HEAD)
    except OSError as error:
        raise BatchError(f"{path}: the file cannot be read: {reason_of(error)}") from error
    if not head.strip():
        raise BatchError(f"{path}: the file is empty: export it again")
    if _MAGIC not in head:
        raise BatchError(
            f"{path}: this is no STEP file, which begins with ISO-10303-21; export the assembly as "
            "STEP (AP214 or AP242)"
        )


def _too_long(path: Path, seconds: int) -> str:
    return (
        f"{path}: it took more than {seconds} s and was given up: export the mechanism alone, "
        "without threads, texts and other detail"
    )


def _death(path: Path, code: int, seconds: int) -> str:
    if hasattr(signal, "SIGXCPU") and code in (-signal.SIGXCPU, -signal.SIGKILL):
        return _too_long(path, seconds)
    how = f"code {code}" if code >= 0 else (signal.strsignal(-code) or f"signal {-code}").lower()
    return (
        f"{path}: OpenCASCADE ended on this file ({how}): export it again, as AP214 or AP242, "
        "without surfaces and hidden parts"
    )
