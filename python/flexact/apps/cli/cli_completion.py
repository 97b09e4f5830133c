# SPDX-License-Identifier: BSD-3-Clause
"""``flexact completion SHELL``: completion of this command's words, made from its parsers."""

from __future__ import annotations

import argparse

from ...util.loading import load
from .help_texts import add_examples
from .outcome import ExitCode
from .shell_words import OptionWords, VerbWords
from .terminal import give
from .verbs import VERBS

SHELLS = ("bash", "zsh", "fish")
#: What the values of options and arguments are, by what help calls them.
_FILES, _FOLDERS = ("FILE", "PAGE", "TABLE"), ("DIR",)


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = (
        "Write a script by which a shell completes verbs, options, their values, and decks. It is "
        "made from this version's own options: make it anew after an update, or let each shell "
        "make it when it starts, as in the examples."
    )
    parser.add_argument("shell", choices=SHELLS, metavar="SHELL", help=", ".join(SHELLS))
    add_examples(
        parser,
        ("For bash, in ~/.bashrc", 'eval "$(flexact completion bash)"'),
        ("For zsh, in ~/.zshrc behind compinit", 'eval "$(flexact completion zsh)"'),
        ("For fish, in ~/.config/fish/config.fish", "flexact completion fish | source"),
    )
    parser.set_defaults(run=complete)


def complete(chosen: argparse.Namespace) -> ExitCode:
    """Print the script of a shell."""
    verbs = [words_of(verb, chosen.parser_of(verb)) for verb in VERBS]
    # Those of the command itself.
    module = load("flexact.apps.cli.completion")
    give(module.SCRIPTS[chosen.shell](words_of("", chosen.parser_of("")), verbs).removesuffix("\n"))
    return ExitCode.ANALYSED


def words_of(verb: str, parser: argparse.ArgumentParser) -> VerbWords:
    """The words of a verb; of the command itself where it is empty."""
    options: list[OptionWords] = []
    choices: tuple[str, ...] = ()
    takes = ""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction) or action.help == argparse.SUPPRESS:
            continue
        if not action.option_strings:
            choices = tuple(map(str, action.choices or ()))
            takes = takes or _kind(action)
            continue
        options.append(
            OptionWords(
                tuple(action.option_strings),
                _plain(action),
                action.nargs != 0,
                tuple(map(str, action.choices or ())),
                _kind(action),
                str(action.metavar or action.dest),
            )
        )
    return VerbWords(verb, VERBS.get(verb, ""), tuple(options), choices, takes)


def _kind(action: argparse.Action) -> str:
    """What a value names: a deck, a file, a folder, or nothing that stands in folders."""
    if action.metavar == "DECK":
        return "deck"
    if action.metavar in _FILES:
        return "file"
    return "folder" if action.metavar in _FOLDERS else ""


def _plain(action: argparse.Action) -> str:
    """What help says of an option, in a line."""
    return (action.help or "") % {"prog": "flexact", "default": action.default}
