# SPDX-License-Identifier: BSD-3-Clause
"""The command's parser, and what all verbs share: streams, errors, exit codes."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NoReturn

from ...util.errors import BatchError
from ...util.loading import load
from ...util.plain_text import harmless
from ...util.version import VERSION
from . import colour
from .help_texts import Formatter, set_usage
from .once import OnOff, Store
from .outcome import ExitCode
from .terminal import (
    ResultsError,
    accept_every_character,
    complain,
    discard,
    finish_results,
    give,
    speak,
)
from .verbs import VERBS

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

DESCRIPTION = "Exact-constraint analysis of compliant mechanisms."
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
    """A parser that says what was meant, and takes no option in two ways."""

    def __init__(self, *words: Any, **named: Any) -> None:
        """As of `argparse`."""
        super().__init__(*words, **named)
        for kind in (None, "store"):
            self.register("action", kind, Store)
        self.register("action", argparse.BooleanOptionalAction, OnOff)

    def error(self, message: str) -> NoReturn:
        """Say what is wrong with the usage, what may have been meant, and how to get help."""
        told = load("flexact.apps.cli.usage").told(harmless(message), self)
        self.exit(ExitCode.OTHER, f"{told}\n")

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse words; what a verb does not know is told with the verb's own usage."""
        made, rest = super().parse_known_args(args, namespace)
        if rest:
            self.error(f"unrecognized arguments: {' '.join(rest)}")
        return made, rest

    def _print_message(self, message: str, file: SupportsWrite[str] | None = None) -> None:
        # argparse's own is silent where stdout cannot be written.
        if file is sys.stdout:
            give(message.removesuffix("\n"))
        else:
            complain(message.removesuffix("\n"))


def _add_manner(parser: argparse.ArgumentParser) -> None:
    """Add to a verb's parser how it speaks."""
    manner = parser.add_argument_group("how it speaks")
    manner.add_argument(
        "--color",
        choices=colour.CHOICES,
        default="auto",
        help="whether to colour; auto: a terminal, unless NO_COLOR is set",
    )
    loud = manner.add_mutually_exclusive_group()
    loud.add_argument(
        "-q", "--quiet", action="store_true", help="say errors alone, and write what is asked for"
    )
    loud.add_argument(
        "-v", "--verbose", action="count", default=0, help="say what is done, and how long it takes"
    )


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
    load(f"flexact.apps.cli.{verb}", for_good=for_good).fill(parser)
    parser.set_defaults(parser_of=parser_of)
    _add_manner(parser)
    parser._positionals.title = "arguments"
    set_usage(parser)


class _Version(argparse.Action):
    """Says the version, and more where -v or -vv stands among the words."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        """Say it, and end."""
        asked = [word for word in self.const or () if _VERBOSE.fullmatch(word)]
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
