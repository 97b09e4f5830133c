"""Where the command starts: signals first, then all that takes time to import."""

from __future__ import annotations

import signal
from collections.abc import Sequence

from flexact.interruption import end_at_once, end_by


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Args:
        arguments: The words behind ``flexact``; those of the process if None, which Ctrl-C then
            ends at once.

    Returns:
        The exit code; see ``flexact.batch.ExitCode``. 128 and the number of a signal if one came.
    """
    if arguments is None:
        end_at_once()
    try:
        from flexact.cli.command import run

        return run(arguments)
    except KeyboardInterrupt as stop:
        number = getattr(stop, "number", signal.SIGINT)
        if arguments is None:
            end_by(number)
        return 128 + int(number)
