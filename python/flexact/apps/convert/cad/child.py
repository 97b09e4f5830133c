# SPDX-License-Identifier: BSD-3-Clause
"""What runs in the child process: read a STEP file, recognise it, send back plain data.

OpenCASCADE is not loaded anywhere else, so that a file that makes it crash, wait for ever or ask
for all memory does so here.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
from pathlib import Path

from ....util.errors import FlexactError
from .assembly import Choices
from .report import assembly_of
from .step_file import parts_of

if sys.platform != "win32":
    import resource

_TOO_LARGE = (
    "it takes more memory than it is given: export the mechanism alone, or with less detail"
)


def limit(memory: int, seconds: int) -> None:
    """Bound this process, where the system can: memory in bytes, and time of its processor."""
    if sys.platform == "win32":
        return
    for kind, bound in ((resource.RLIMIT_AS, memory), (resource.RLIMIT_CPU, seconds)):
        _, hard = resource.getrlimit(kind)
        if hard == resource.RLIM_INFINITY or hard > bound:
            resource.setrlimit(kind, (bound, bound))


def answer(path: str, choices: Choices, drawing: bool) -> object:
    """The assembly in a file, or a text that says why there is none."""
    try:
        parts, doubts, remarks = parts_of(Path(path))
        return assembly_of(
            parts, choices, name=Path(path).stem, drawing=drawing, doubts=doubts, remarks=remarks
        )
    except FlexactError as error:
        return str(error)
    except MemoryError:
        return _TOO_LARGE
    except Exception as error:
        words = " ".join(str(error).split())[:200]
        if "bad_alloc" in words or "OutOfMemory" in type(error).__name__:
            return _TOO_LARGE
        return f"OpenCASCADE failed on it ({type(error).__name__}: {words}): export it again"


def main() -> None:
    """Answer the question that comes by stdin; what the library prints goes nowhere."""
    # Ctrl-C is to end it at once, also within the library.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    out = os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    path, choices, drawing, memory, seconds = pickle.load(sys.stdin.buffer)
    limit(memory, seconds)
    pickle.dump(answer(path, choices, drawing), out, protocol=pickle.HIGHEST_PROTOCOL)
    out.close()
    # Taking OpenCASCADE apart is of no use to anybody.
    os._exit(0)
