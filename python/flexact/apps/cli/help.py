# SPDX-License-Identifier: BSD-3-Clause
"""``flexact help VERB``: what ``flexact VERB --help`` says."""

from __future__ import annotations

import argparse

from .command import VERBS
from .help_texts import add_examples
from .outcome import ExitCode


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = "Explain the command, or one of its verbs."
    parser.add_argument("verb", nargs="?", metavar="VERB", choices=VERBS, help="a verb")
    add_examples(parser, ("How decks are analysed", "flexact help analyse"))
    parser.set_defaults(run=explain)


def explain(chosen: argparse.Namespace) -> ExitCode:
    """Print the help that was asked for."""
    chosen.parser_of(chosen.verb or "").print_help()
    return ExitCode.ANALYSED
