# SPDX-License-Identifier: BSD-3-Clause
"""The command's parser, and what all verbs share: streams, errors, exit codes."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, NoReturn

from flexact.base.errors import BatchError
from flexact.base.loading import load
from flexact.base.plain_text import harmless
from flexact.base.version import VERSION
from flexact.cli.help_texts import Formatter, set_usage
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
    "completion": "a script by which a shell completes the words of this command",
    "help": "what a verb does, with its options and examples",
}
#: 128 and the number of SIGPIPE, which not all systems have.
_PIPE_CLOSED = 128 + 13
_VERBOSE = re.compile(r"-v+|--verbose")
EPILOG = """\
exit codes:
  0  analysed (or advised, costed, traced, checked, compared, stored, drawn, written)
  1  a deck has errors, cannot be read, or has not what was asked of it
  2  wrong usage, output that cannot be written, too little memory, ...
  3  the verdict is not the expected one, or an answer differs from the stored one
Of several decks one bad deck does not stop the rest; the code is 2 if any gave 2, else 1 \
if any gave 1, else 3 if any gave 3.
"""


class Parser(argparse.ArgumentParser):
    """A parser that says what was meant."""

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
    parser.add_argument(
        *("-V", "--version"),
        action=_Version,
        nargs=0,
        const=words,
        help="show the version; with -v also what it is built and runs with, with -vv where",
    )
    parser.usage = "%(prog)s [OPTIONS] COMMAND ..."
    verbs = parser.add_subparsers(
        title="commands", metavar="COMMAND", prog="flexact", required=True
    )
    called = next((word for word in words if word in VERBS), None)
    for verb, about in VERBS.items():
        parser_of_verb = verbs.add_parser(
            verb, help=about, allow_abbrev=False, formatter_class=Formatter
        )
        if verb == called:
            _fill(parser_of_verb, verb, for_good)
    return parser


def parser_of(verb: str) -> argparse.ArgumentParser:
    """The parser of a verb, with all its options; of the command itself where it is empty."""
    if not verb:
        return make_parser(())
    parser = Parser(prog=f"flexact {verb}", allow_abbrev=False, formatter_class=Formatter)
    _fill(parser, verb)
    return parser


def _fill(parser: argparse.ArgumentParser, verb: str, for_good: bool = False) -> None:
    load(f"flexact.cli.{verb}", for_good=for_good).fill(parser)
    parser._positionals.title = "arguments"
    set_usage(parser)


class _Version(argparse.Action):
    """Says the version, and more where -v or -vv stands among the words."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        """Say it, and end."""
        asked = [word for word in self.const or () if _VERBOSE.fullmatch(word)]
        count = sum(1 if word == "--verbose" else len(word) - 1 for word in asked)
        if count:
            say(load("flexact.cli.about").about(paths=count > 1))
        else:
            say(f"flexact {VERSION}")
        parser.exit()


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command; see ``flexact.cli.main``."""
    accept_every_character()
    try:
        if sys.stdout is None:
            raise ResultsError("cannot write the results: standard output is closed")
        code = _obey(arguments)
        finish_results()
    except BrokenPipeError:
        # As what this signal ends, quietly: nobody reads on, and not all was done.
        discard(sys.stdout)
        return _PIPE_CLOSED
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
        if not words:
            complain(make_parser(()).format_help().removesuffix("\n"))
            return ExitCode.OTHER
        chosen = make_parser(words, for_good=arguments is None).parse_args(words)
        return int(chosen.run(chosen))
    except BatchError as error:
        complain(f"flexact: error: {harmless(str(error))}")
        return ExitCode.OTHER
    except SystemExit as ending:
        return ending.code if isinstance(ending.code, int) else ExitCode.ANALYSED
