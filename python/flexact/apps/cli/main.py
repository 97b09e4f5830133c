# SPDX-License-Identifier: BSD-3-Clause
"""Where the command starts: signals first, then all that takes time to import."""

from __future__ import annotations

import contextlib
import signal
import sys
from collections.abc import Sequence

from ...util.interruption import end_at_once, end_by
from ...util.loading import load


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Args:
        arguments: The words behind ``flexact``; those of the process if None, which Ctrl-C then
            ends at once.

    Returns:
        The exit code; see ``terminal.ExitCode``. 128 and the number of a signal if one came.
    """
    if arguments is None:
        end_at_once()
    try:
        load("flexact.util.machine").prepare_libraries()
        code: int = load("flexact.apps.cli.command").run(arguments)
        return code
    except (MemoryError, ImportError) as error:
        # What is missing, memory or a library; numpy writes a page about it.
        lines = [line for line in map(str.strip, str(error).splitlines()) if line]
        is_memory = isinstance(error, MemoryError)
        why = "not enough memory" if is_memory else "a library cannot be loaded"
        more = f": {lines[-1]}" if lines else ""
        with contextlib.suppress(OSError, ValueError, AttributeError):
            sys.stderr.write(f"flexact: {why}{more}\n")
        return 2
    except KeyboardInterrupt as stop:
        number = getattr(stop, "number", signal.SIGINT)
        if arguments is None:
            end_by(number)
        return 128 + int(number)
