"""The command's parser, and what all verbs share: streams, interruptions, exit codes."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import NoReturn

from flexact import __version__
from flexact.batch import BatchError, ExitCode
from flexact.cli import analyse, check, regress
from flexact.cli.terminal import accept_every_character, complain, discard

DESCRIPTION = "Exact-constraint analysis of compliant mechanisms."
EPILOG = """\
exit codes:
  0  analysed (or checked, compared, stored)
  1  anything that is not below: wrong usage, output that cannot be written, ...
  2  a deck has errors, or cannot be read
  3  the verdict is not the expected one, or an answer differs from the stored one
Of several decks one bad deck does not stop the rest; the code is 1 if any gave 1,
else 2 if any gave 2, else 3 if any gave 3.
"""


class Parser(argparse.ArgumentParser):
    """A parser whose usage errors exit with 1, because 2 is a deck with errors."""

    def error(self, message: str) -> NoReturn:
        """Say what is wrong with the usage, and how to get help."""
        self.print_usage(sys.stderr)
        self.exit(ExitCode.OTHER, f"{self.prog}: error: {message}\n")


def make_parser() -> argparse.ArgumentParser:
    """The parser of the whole command."""
    parser = Parser(
        prog="flexact",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"flexact {__version__}")
    verbs = parser.add_subparsers(
        title="commands", metavar="COMMAND", prog="flexact", required=True
    )
    for verb in (analyse, check, regress):
        verb.add_parser(verbs)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Args:
        arguments: The words behind ``flexact``; those of the process if None.

    Returns:
        The exit code; see ``ExitCode``.
    """
    accept_every_character()
    try:
        code = _run(arguments)
        if sys.stdout is not None:
            sys.stdout.flush()
    except KeyboardInterrupt:
        code = ExitCode.INTERRUPTED
        discard(sys.stdout)
    except BrokenPipeError:
        code = ExitCode.OTHER
        discard(sys.stdout)
        discard(sys.stderr)
    except OSError as error:
        code = ExitCode.OTHER
        discard(sys.stdout)
        complain(f"flexact: error: {error}")
    return int(code)


def _run(arguments: Sequence[str] | None) -> int:
    try:
        chosen = make_parser().parse_args(arguments)
        return int(chosen.run(chosen))
    except BatchError as error:
        complain(f"flexact: error: {error}")
        return ExitCode.OTHER
    except SystemExit as ending:
        return ending.code if isinstance(ending.code, int) else ExitCode.ANALYSED
