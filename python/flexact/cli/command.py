"""The command's parser, and what all verbs share: streams, errors, exit codes."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from difflib import get_close_matches
from typing import TYPE_CHECKING, NoReturn

from flexact import __version__
from flexact.batch import BatchError, ExitCode
from flexact.cli import analyse, check, export, picture, regress, report
from flexact.cli.terminal import (
    ResultsError,
    accept_every_character,
    complain,
    discard,
    finish_results,
    say,
)
from flexact.rendering import harmless

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

DESCRIPTION = "Exact-constraint analysis of compliant mechanisms."
EPILOG = """\
exit codes:
  0  analysed (or checked, compared, stored, drawn, written)
  1  anything that is not below: wrong usage, output that cannot be written, ...
  2  a deck has errors, or cannot be read
  3  the verdict is not the expected one, or an answer differs from the stored one
Of several decks one bad deck does not stop the rest; the code is 1 if any gave 1,
else 2 if any gave 2, else 3 if any gave 3.
"""


class Parser(argparse.ArgumentParser):
    """A parser whose usage errors exit with 1, because 2 is a deck with errors."""

    def error(self, message: str) -> NoReturn:
        """Say what is wrong with the usage, and what was meant or how to get help."""
        self.print_usage(sys.stderr)
        text = f"{self.prog}: error: {harmless(message)}{_hint(message)}\n"
        self.exit(ExitCode.OTHER, text)

    def _print_message(self, message: str, file: SupportsWrite[str] | None = None) -> None:
        # argparse's own is silent where stdout cannot be written.
        if file is sys.stdout:
            say(message.removesuffix("\n"))
        else:
            complain(message.removesuffix("\n"))


def _hint(message: str) -> str:
    found = re.search(r"invalid choice: '(.*)' \(choose from (.*)\)", message)
    if found is None:
        return ""
    near = get_close_matches(found[1], re.findall(r"[\w-]+", found[2]), 1)
    return f"; did you mean {near[0]}?" if near else ""


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
    for verb in (analyse, check, regress, picture, export, report):
        verb.add_parser(verbs)
    return parser


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command; see ``flexact.cli.main``."""
    accept_every_character()
    try:
        if sys.stdout is None:
            raise ResultsError("cannot write the results: standard output is closed")
        code = _obey(arguments)
        finish_results()
    except BrokenPipeError:
        code = ExitCode.OTHER
        discard(sys.stdout)
    except (ResultsError, OSError) as error:
        code = ExitCode.OTHER
        discard(sys.stdout)
        complain(f"flexact: error: {harmless(str(error))}")
    except KeyboardInterrupt:
        discard(sys.stdout)
        raise
    return int(code)


def _obey(arguments: Sequence[str] | None) -> int:
    try:
        chosen = make_parser().parse_args(arguments)
        return int(chosen.run(chosen))
    except BatchError as error:
        complain(f"flexact: error: {harmless(str(error))}")
        return ExitCode.OTHER
    except SystemExit as ending:
        return ending.code if isinstance(ending.code, int) else ExitCode.ANALYSED
