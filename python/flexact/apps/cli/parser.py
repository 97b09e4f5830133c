# SPDX-License-Identifier: BSD-3-Clause
"""Parsers of the command's words: verbs as data, options given once, help as wide as a terminal."""

from __future__ import annotations

import argparse
import re
import sys
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

from ...util.loading import load
from ...util.text import harmless
from .terminal import CHOICES, ExitCode, complain, give, text_width

if TYPE_CHECKING:
    from _typeshed import SupportsWrite


#: The verbs, each in a module of its name.
VERBS = {
    "analyse": "verdict, counts, motions and self-stresses of decks",
    "advise": "what is wrong with decks and why, and steps that mend it",
    "design": "layouts of flexures for a wanted freedom, exactly constrained and proven so",
    "cost": "what over-constraint costs: tolerances of clamps, and what each release keeps",
    "table": "stiffness and compliance at a point, along a stroke, and when it is warm",
    "transfer": "what a controller sees: poles, zeros and the response from forces to motion",
    "check": "the diagnostics of decks, without analysing them",
    "batch": "a table of many decks, by all processors",
    "declare": "a deck in which every divided sheet or wire counts as one beam",
    "regress": "compare decks with stored answers, or store them",
    "picture": "a deck's mechanism as a picture: its motion, its self-stress",
    "export": "a deck's mechanism with its modes as a mesh, for ParaView",
    "trace": "the path of a motion, both ways, with its dead points",
    "view": "a deck's page in the browser",
    "watch": "the page of a deck, script or STEP file in the browser, renewed at each save",
    "report": "a page of each deck, to open in a browser and to mail",
    "convert": "decks from and to tables of SPACAR Light, of flexures, meshes of lines; from CAD",
    "spacarlight": "verdict and results of a script for SPACAR Light, for MATLAB and Octave",
    "bench": "how fast this machine is, in half a minute",
    "lsp": "a language server for editors, which start it",
    "completion": "a script by which a shell completes the words of this command",
    "help": "what a verb does, with its options and examples",
}


#: An argument or an option, as `argparse.add_argument` takes it: its names and its settings.
Argument = tuple[tuple[str, ...], dict[str, Any]]


class Group(NamedTuple):
    """Arguments under a title; without one, arguments of which one at most is given."""

    title: str
    arguments: tuple[Argument | Group, ...]


class Verb(NamedTuple):
    """A verb: what it is for, its arguments, and what it does."""

    run: Callable[[argparse.Namespace], int]
    description: str
    examples: Sequence[tuple[str, str]]
    """Of each what it does, and the words of the shell."""
    arguments: Sequence[Argument | Group] = ()
    defaults: Mapping[str, Any] = {}
    """Of what is no argument of this verb, but asked for by what it shares with others."""
    negative: re.Pattern[str] | None = None
    """What is a value of an option although it begins with a minus; None: numbers alone."""


def argument(*names: str, **settings: Any) -> Argument:
    """An argument or an option, as `argparse.add_argument` takes it."""
    return names, settings


#: How every verb speaks.
MANNER = Group(
    "how it speaks",
    (
        argument(
            "--color",
            choices=CHOICES,
            default="auto",
            help="whether to colour; auto: a terminal, unless NO_COLOR is set",
        ),
        Group(
            "",
            (
                argument(
                    *("-q", "--quiet"),
                    action="store_true",
                    help="say errors alone, and write what is asked for",
                ),
                argument(
                    *("-v", "--verbose"),
                    action="count",
                    default=0,
                    help="say all there is to say, what is done, and how long it takes",
                ),
            ),
        ),
    ),
)


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


class SetSeveral(argparse.Action):
    """Sets several options by one name, beside which they are refused.

    Its `const` holds what each of them is set to, and how that is said; what is stored is the name
    and what is said.
    """

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Set them."""
        for dest, (value, _) in self.const.items():
            # Also where the other option says the same.
            require_once(parser, namespace, dest, (option_string, value), option_string)
            setattr(namespace, dest, value)
        setattr(
            namespace,
            self.dest,
            (option_string, *(said for _, said in self.const.values() if said)),
        )


#: Patterns are compiled where something is wrong.
_UNKNOWN = r"(?s)unrecognized arguments: (.*)"
_CHOICE = r"(?s)argument (\S+): invalid choice: '(.*)' \(choose from (.*)\)"
#: Other messages of argparse, and what is said in their place.
_PLAIN = (
    (
        r"the following arguments are required: (.*)",
        r"the following required arguments were not given: \1",
    ),
    (
        r"argument (\S+): expected (?:one|at least one) argument",
        r"a value is required for '\1' but none was given",
    ),
    (r"(?s)argument (\S+): (.*)", r"invalid value for '\1': \2"),
)


def _meant(message: str, parser: argparse.ArgumentParser) -> tuple[str, str, str]:
    """What is wrong, what is near to it, which may be empty, and what kind of thing that is."""
    if found := re.fullmatch(_UNKNOWN, message):
        first = next((w for w in found[1].split() if w.startswith("-")), found[1].split(" ")[0])
        near = _near(first.split("=")[0], parser._option_string_actions)
        return f"unexpected argument '{first}' found", near, "argument"
    if found := re.fullmatch(_CHOICE, message):
        name, given, choices = found[1], found[2], re.findall(r"[\w-]+", found[3])
        near = _near(given, choices)
        if name == "COMMAND":
            return f"unrecognized command '{given}'", near, "command"
        told = f"invalid value '{given}' for '{name}': choose from {', '.join(choices)}"
        return told, near, "value"
    if message == "the following arguments are required: COMMAND":
        return "a command is required but none was given", "", ""
    for pattern, words in _PLAIN:
        if found := re.fullmatch(pattern, message):
            return found.expand(words), "", ""
    return message, "", ""


def _near(word: str, known: Iterable[str]) -> str:
    return next(iter(load("difflib").get_close_matches(word, list(known), 1)), "")


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
        what, near, kind = _meant(harmless(message), self)
        tip = [f"  tip: a similar {kind} exists: '{near}'"] if near else []
        parts = (f"error: {what}", *tip, f"U{self.format_usage().strip()[1:]}")
        self.exit(
            ExitCode.OTHER,
            "\n\n".join((*parts, f"For more information, try '{self.prog} --help'.\n")),
        )

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


#: Begins a line of the shell among the examples.
PROMPT = "$ "
_HEAD = "examples, in a clone:"
_STEP = "    "
#: What hangs behind a number or a prompt at the start of a line.
_LEAD = r" *(?:\d  |\$ )?"
#: A word of the shell.
_WORD = r"(?:'[^']*'|\"[^\"]*\"|\S)+"
_NARROW, _USUAL = 60, 80


class Formatter(argparse.RawDescriptionHelpFormatter):
    """As wide as the terminal, which argparse asks for by a package that is slow to load."""

    def __init__(self, prog: str) -> None:
        """Take the width where somebody looks."""
        super().__init__(prog, width=text_width(_USUAL), max_help_position=20)

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(_fitted(line, width) for line in text.splitlines())

    def _format_usage(
        self,
        usage: str | None,
        actions: Iterable[argparse.Action],
        groups: Iterable[argparse._MutuallyExclusiveGroup],
        prefix: str | None,
    ) -> str:
        if usage is not None:
            words = f"{prefix or 'usage: '}{usage % {'prog': self._prog}}"
            made = _wrapped(words, self._width, "       ", break_long_words=False)
            return f"{made}\n\n"
        return super()._format_usage(usage, actions, groups, prefix)


def _fitted(line: str, width: int) -> str:
    found = re.match(_LEAD, line)
    lead = found[0] if found else ""
    if lead.endswith(PROMPT):
        # A path that is alone in its row is to have room in it.
        return _shell_lines(line, width, " " * (len(lead) if width > _NARROW else 1))
    return _wrapped(line, width, " " * len(lead)) if line.strip() else ""


def _wrapped(text: str, width: int, indent: str, *, break_long_words: bool = True) -> str:
    return textwrap.fill(
        text,
        width,
        subsequent_indent=indent,
        break_on_hyphens=False,
        break_long_words=break_long_words,
    )


def _shell_lines(line: str, width: int, indent: str) -> str:
    """A line of the shell, which goes on behind a backslash where it is too long."""
    words = re.findall(_WORD, line)
    for place in range(len(words) - 2, 1, -1):
        # An option and its value stay together where they fit.
        word, value = words[place : place + 2]
        fits = len(indent) + len(word) + len(value) + 3 <= width
        if fits and word.startswith("-") and value[0] not in "-|<":
            words[place : place + 2] = [f"{word} {value}"]
    rows, row = [], line[: len(line) - len(line.lstrip())] + " ".join(words[:2])
    for place, word in enumerate(words[2:], start=2):
        tail = 0 if place == len(words) - 1 else 2
        if len(row) + 1 + len(word) + tail <= width:
            row = f"{row} {word}"
        else:
            rows.append(row)
            row = indent + word
    return " \\\n".join((*rows, row))


def _add(parser: argparse._ActionsContainer, each: Argument | Group) -> None:
    if not isinstance(each, Group):
        names, settings = each
        parser.add_argument(*names, **settings)
        return
    group = (
        parser.add_argument_group(each.title)
        if each.title
        else parser.add_mutually_exclusive_group()
    )
    for one in each.arguments:
        _add(group, one)


def fill(parser: argparse.ArgumentParser, verb: Verb) -> None:
    """Give a verb's parser its words and arguments, and how every verb speaks."""
    parser.description = verb.description
    for each in (*verb.arguments, MANNER):
        _add(parser, each)
    lines = [_HEAD]
    for about, words in verb.examples:
        lines += [f"  {about}:", f"{_STEP}{PROMPT}{words}"]
    parser.epilog = "\n".join(lines)
    parser.set_defaults(run=verb.run, **verb.defaults)
    parser._positionals.title = "arguments"
    if verb.negative is not None:
        # There is no public way to say so before Python 3.14.
        parser._negative_number_matcher = verb.negative
    # The usage is one line: what must be stated, and [OPTIONS] for the rest.
    usage = ["%(prog)s", "[OPTIONS]"]
    for action in parser._actions:
        name = str(action.metavar or action.dest).replace("%", "%%")
        if action.option_strings and action.required:
            usage.append(f"{action.option_strings[0]} {name}")
        elif not action.option_strings:
            shown = f"{name}{'...' if action.nargs in ('+', '*') else ''}"
            usage.append(f"[{shown}]" if action.nargs in ("?", "*") else shown)
    parser.usage = " ".join(usage)
