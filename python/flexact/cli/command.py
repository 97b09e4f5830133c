# SPDX-License-Identifier: BSD-3-Clause
"""The command's parser, and what all verbs share: streams, errors, exit codes."""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, NoReturn

from flexact.base.errors import BatchError
from flexact.base.loading import load
from flexact.base.plain_text import harmless
from flexact.base.version import VERSION
from flexact.cli.outcome import ExitCode
from flexact.cli.terminal import (
    ResultsError,
    accept_every_character,
    complain,
    discard,
    finish_results,
    say,
)

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

DESCRIPTION = "Exact-constraint analysis of compliant mechanisms."
#: The verbs, each in a module of its name.
VERBS = {
    "analyse": "verdict, counts, motions and self-stresses of decks",
    "advise": "what is wrong with decks and why, and steps that mend it",
    "cost": "what over-constraint costs: tolerances of clamps, and what each release keeps",
    "check": "the diagnostics of decks, without analysing them",
    "batch": "a table of many decks, by all processors",
    "declare": "a deck in which every divided sheet or wire counts as one beam",
    "regress": "compare decks with stored answers, or store them",
    "picture": "a deck's mechanism as a picture: its motion, its self-stress",
    "export": "a deck's mechanism with its modes as a mesh, for ParaView",
    "trace": "the path of a motion, both ways, with its dead points",
    "view": "a deck's page in the browser",
    "watch": "the page of a deck or a script in the browser, renewed whenever it is saved",
    "report": "a page of each deck, to open in a browser and to mail",
    "convert": "decks from and to tables as of SPACAR Light, and meshes of lines",
}
EPILOG = """\
exit codes:
  0  analysed (or advised, costed, traced, checked, compared, stored, drawn, written)
  1  anything that is not below: wrong usage, output that cannot be written, ...
  2  a deck has errors, or cannot be read
  3  the verdict is not the expected one, or an answer differs from the stored one
Of several decks one bad deck does not stop the rest; the code is 1 if any gave 1,
else 2 if any gave 2, else 3 if any gave 3.
"""


class Formatter(argparse.RawDescriptionHelpFormatter):
    """As wide as the terminal, which argparse asks for by a package that is slow to load."""

    def __init__(self, prog: str) -> None:
        """Take the width where somebody looks."""
        stated = os.environ.get("COLUMNS", "")
        width = int(stated) if stated.isdigit() else 0
        if not width and sys.stdout is not None and sys.stdout.isatty():
            width = os.get_terminal_size(sys.stdout.fileno()).columns
        super().__init__(prog, width=(width or 80) - 2)


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
    near = load("difflib").get_close_matches(found[1], re.findall(r"[\w-]+", found[2]), 1)
    return f"; did you mean {near[0]}?" if near else ""


def make_parser(words: Sequence[str], for_good: bool = False) -> argparse.ArgumentParser:
    """The parser of the whole command; the verb among the words is the one that is loaded."""
    parser = Parser(
        prog="flexact",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=Formatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"flexact {VERSION}")
    verbs = parser.add_subparsers(
        title="commands", metavar="COMMAND", prog="flexact", required=True
    )
    called = next((word for word in words if word in VERBS), None)
    for verb, about in VERBS.items():
        parser_of_verb = verbs.add_parser(
            verb, help=about, allow_abbrev=False, formatter_class=Formatter
        )
        if verb == called:
            load(f"flexact.cli.{verb}", for_good=for_good).fill(parser_of_verb)
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
        words = sys.argv[1:] if arguments is None else arguments
        chosen = make_parser(words, for_good=arguments is None).parse_args(words)
        return int(chosen.run(chosen))
    except BatchError as error:
        complain(f"flexact: error: {harmless(str(error))}")
        return ExitCode.OTHER
    except SystemExit as ending:
        return ending.code if isinstance(ending.code, int) else ExitCode.ANALYSED
