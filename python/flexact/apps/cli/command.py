# SPDX-License-Identifier: BSD-3-Clause
"""The command's parser, and what all verbs share: streams, errors, exit codes."""

from __future__ import annotations

import argparse
import difflib
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, NoReturn

from ...util.errors import BatchError
from ...util.loading import VERSION, load
from ...util.text import harmless
from . import terminal as colour
from .help_texts import Formatter, set_usage
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

if TYPE_CHECKING:
    from _typeshed import SupportsWrite


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
    "bench": "how fast this machine is, in half a minute",
    "lsp": "a language server for editors, which start it",
    "completion": "a script by which a shell completes the words of this command",
    "help": "what a verb does, with its options and examples",
}


def require_once(
    parser: argparse.ArgumentParser,
    namespace: argparse.Namespace,
    dest: str,
    value: object,
    option: str | None,
) -> None:
    """Note what an option says, and end where it was said otherwise before.

    Args:
        parser: Whose option it is.
        namespace: Of this call; what was given is kept there.
        dest: What the option sets, under whatever name it is called.
        value: What it says.
        option: The name by which it was called; None of an argument without a name.
    """
    if option is None:
        return
    given: dict[str, tuple[object, str]] = namespace.__dict__.setdefault("given", {})
    before, name = given.setdefault(dest, (value, option))
    if before != value:
        if name == option:
            parser.error(f"{option} is given twice, and not alike: give it once")
        parser.error(f"{name} and {option} contradict each other: choose one")


class Store(argparse._StoreAction):
    """Stores a value, once."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store it."""
        require_once(parser, namespace, self.dest, values, option_string)
        super().__call__(parser, namespace, values, option_string)


class OnOff(argparse.BooleanOptionalAction):
    """Stores whether something is wanted, once."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store it."""
        is_on = not (option_string or "").startswith("--no-")
        require_once(parser, namespace, self.dest, is_on, option_string)
        super().__call__(parser, namespace, values, option_string)


def add_renamed(
    parser: argparse.ArgumentParser,
    old: str,
    new: str,
    *,
    dest: str,
    kind: Callable[[str], Any] = str,
    choices: Sequence[str] | None = None,
) -> None:
    """Let an option be called by its old name, which help and completion leave out."""
    # Without a default of its own that of the new name stays.
    parser.add_argument(
        old,
        action=_Renamed,
        const=new,
        dest=dest,
        type=str if kind is None else kind,
        choices=choices,
        default=argparse.SUPPRESS,
        help=argparse.SUPPRESS,
    )


class _Renamed(argparse.Action):
    """Stores as the new name does, and says so."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        complain(f"warning: {option_string} is now called {self.const}")
        require_once(parser, namespace, self.dest, values, option_string)
        setattr(namespace, self.dest, values)


_UNKNOWN = re.compile(r"unrecognized arguments: (.*)", re.DOTALL)
_MISSING = re.compile(r"the following arguments are required: (.*)")
_CHOICE = re.compile(r"argument (\S+): invalid choice: '(.*)' \(choose from (.*)\)", re.DOTALL)
_NO_VALUE = re.compile(r"argument (\S+): expected (?:one|at least one) argument")
_INVALID = re.compile(r"argument (\S+): (.*)", re.DOTALL)


def usage_error(message: str, parser: argparse.ArgumentParser) -> str:
    """What argparse says, as people know it from elsewhere.

    Args:
        message: Of argparse.
        parser: Of the command or of a verb.
    """
    what, tip = _meant(message, parser)
    usage = parser.format_usage().strip()
    parts = [f"error: {what}"]
    if tip:
        parts.append(f"  tip: {tip}")
    parts += [f"U{usage[1:]}", f"For more information, try '{parser.prog} --help'."]
    return "\n\n".join(parts)


def _meant(message: str, parser: argparse.ArgumentParser) -> tuple[str, str]:
    """What is wrong, and a tip, which may be empty."""
    if found := _UNKNOWN.fullmatch(message):
        first = next((w for w in found[1].split() if w.startswith("-")), found[1].split(" ")[0])
        word = first.split("=")[0]
        near = _near(word, parser._option_string_actions)
        tip = f"a similar argument exists: '{near}'" if near else ""
        return f"unexpected argument '{first}' found", tip
    if found := _MISSING.fullmatch(message):
        names = found[1]
        if names == "COMMAND":
            return "a command is required but none was given", ""
        return f"the following required arguments were not given: {names}", ""
    if found := _CHOICE.fullmatch(message):
        return _wrong_choice(found[1], found[2], re.findall(r"[\w-]+", found[3]))
    if found := _NO_VALUE.fullmatch(message):
        return f"a value is required for '{found[1]}' but none was given", ""
    if found := _INVALID.fullmatch(message):
        return f"invalid value for '{found[1]}': {found[2]}", ""
    return message, ""


def _wrong_choice(name: str, given: str, choices: list[str]) -> tuple[str, str]:
    near = _near(given, choices)
    if name == "COMMAND":
        tip = f"a similar command exists: '{near}'" if near else ""
        return f"unrecognized command '{given}'", tip
    tip = f"a similar value exists: '{near}'" if near else ""
    return f"invalid value '{given}' for '{name}': choose from {', '.join(choices)}", tip


def _near(word: str, known: Iterable[str]) -> str:
    found = difflib.get_close_matches(word, list(known), 1)
    return found[0] if found else ""


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
        told = usage_error(harmless(message), self)
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
