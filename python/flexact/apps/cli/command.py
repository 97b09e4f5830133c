# SPDX-License-Identifier: BSD-3-Clause
"""The command: its parser, the version, streams that break, and exit codes."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from typing import NoReturn

from ...util.errors import BatchError
from ...util.loading import VERSION, load
from ...util.text import harmless
from .parser import VERBS, Formatter, Parser, fill
from .terminal import (
    ExitCode,
    ResultsError,
    accept_every_character,
    complain,
    discard,
    finish_results,
    give,
    speak,
)

DESCRIPTION = "Exact-constraint analysis of compliant mechanisms."
#: 128 and the number of SIGPIPE, which not all systems have.
_PIPE_CLOSED = 128 + 13
_VERBOSE = r"-v+|--verbose"
EPILOG = """\
exit codes:
  0  analysed (or advised, costed, traced, checked, compared, stored, drawn, written)
  1  a deck has errors, cannot be read, or has not what was asked of it
  2  wrong usage, output that cannot be written, too little memory, ...
  3  the verdict is not the expected one, or an answer differs from the stored one
Of several decks one bad deck does not stop the rest; the code is 2 if any gave 2, else 1 \
if any gave 1, else 3 if any gave 3.
"""


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
    # Where the verb comes first, as it should, no other is looked for.
    there = {called: VERBS[called]} if called and called == words[0] else VERBS
    for verb, about in there.items():
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
    fill(parser, load(f"flexact.apps.cli.{verb}", for_good=for_good).VERB)
    parser.set_defaults(parser_of=parser_of)


class _Version(argparse.Action):
    """Says the version, and more where -v or -vv stands among the words."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        """Say it, and end."""
        asked = [word for word in self.const or () if re.fullmatch(_VERBOSE, word)]
        count = sum(1 if word == "--verbose" else len(word) - 1 for word in asked)
        if count:
            give(load("flexact.apps.cli.about").about(paths=count > 1))
        else:
            give(f"flexact {VERSION}")
        parser.exit()


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command; see ``flexact.apps.cli.main``."""
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
        speak()
        if not words:
            complain(make_parser(()).format_help().removesuffix("\n"))
            return ExitCode.OTHER
        chosen = make_parser(words, for_good=arguments is None).parse_args(words)
        speak(chosen.color, chosen.quiet, chosen.verbose)
        return int(chosen.run(chosen))
    except BatchError as error:
        complain(f"flexact: error: {harmless(str(error))}")
        return ExitCode.OTHER
    except SystemExit as ending:
        return ending.code if isinstance(ending.code, int) else ExitCode.ANALYSED
