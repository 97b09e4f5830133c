# SPDX-License-Identifier: BSD-3-Clause
"""Where the command starts: signals first, then all that takes time to import."""

from __future__ import annotations

import signal
from collections.abc import Sequence

from flexact.base.interruption import end_at_once, end_by
from flexact.base.loading import load


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Args:
        arguments: The words behind ``flexact``; those of the process if None, which Ctrl-C then
            ends at once.

    Returns:
        The exit code; see ``outcome.ExitCode``. 128 and the number of a signal if one came.
    """
    if arguments is None:
        end_at_once()
    try:
        code: int = load("flexact.cli.command").run(arguments)
        return code
    except KeyboardInterrupt as stop:
        number = getattr(stop, "number", signal.SIGINT)
        if arguments is None:
            end_by(number)
        return 128 + int(number)
