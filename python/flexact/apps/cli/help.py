# SPDX-License-Identifier: BSD-3-Clause
"""``flexact help VERB``: what ``flexact VERB --help`` says."""

from __future__ import annotations

import argparse

from .parser import VERBS, Verb, argument
from .terminal import ExitCode


def explain(chosen: argparse.Namespace) -> ExitCode:
    """Print the help that was asked for."""
    chosen.parser_of(chosen.verb or "").print_help()
    return ExitCode.ANALYSED


VERB = Verb(
    run=explain,
    description="Explain the command, or one of its verbs.",
    examples=(("How decks are analysed", "flexact help analyse"),),
    arguments=(argument("verb", nargs="?", metavar="VERB", choices=VERBS, help="a verb"),),
)
