# SPDX-License-Identifier: BSD-3-Clause
"""``flexact watch``: the page of a deck, a script, CAD or a problem, renewed with each save."""

from __future__ import annotations

import argparse
import time
from contextlib import closing
from functools import partial
from pathlib import Path

from ...deck.rendering import DeckError
from ...model.reading import file_bytes
from ...util.decks import STDIN, DeckFile, FolderError
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.text import harmless
from ..convert.cad.reader import require_step
from ..watch.cad import is_step
from ..watch.scene import SCRIPT, Answer, Broken, is_problem
from ..watch.watch import Watch
from .decks import ACCURACY, DECISION, decision_of, report
from .parser import Verb, argument
from .targets import NO_BROWSER, one_deck
from .terminal import ExitCode, complain, say

_LARGEST_PORT = 65535


def port(text: str) -> int:
    """A port, as an option's type."""
    number = int(text) if text.isascii() and text.isdigit() else 0
    if not 1 <= number <= _LARGEST_PORT:
        raise argparse.ArgumentTypeError(
            f"a number from 1 to {_LARGEST_PORT} is wanted, not {text!r}"
        )
    return number


def watch(chosen: argparse.Namespace) -> ExitCode:
    """Serve, until a signal ends it."""
    path = chosen.deck
    if path == STDIN:
        raise BatchError("what comes from stdin is not saved anew; name a file to watch")
    is_own = path.lower().endswith(SCRIPT) or is_step(path) or is_problem(path)
    deck = DeckFile(path, Path(path)) if is_own else one_deck(chosen)
    path = deck.path
    try:
        if deck.error is not None:
            raise deck.error
        # What cannot be read now is more likely to be a slip than a deck to come.
        if is_step(path):
            require_step(Path(path))
        else:
            file_bytes(path)
    except (DeckError, FolderError) as error:
        return report(deck, error, as_json=False).code
    name = harmless(path)

    def renewed(words: str, answer: Answer) -> None:
        """Say what has changed, or what is wrong."""
        if isinstance(answer, Broken):
            complain(harmless_lines(answer.words))
            words = answer.in_short
        elif answer.problems:
            complain(harmless_lines(answer.problems))
        say(f"{time.strftime('%H:%M:%S')} {name}: {words}")

    with unwinding():
        watched = Watch(
            path, renewed, partial(print, end="", flush=True), chosen.port, decision_of(chosen)
        )
        with closing(watched):
            say(f"{name} is shown at {watched.server.address}")
            if not chosen.no_browser and not watched.opens():
                complain("no browser opens here; open this address in one of this machine")
            watched.run()
    return ExitCode.ANALYSED


def harmless_lines(text: str) -> str:
    """Text of several lines in which nothing can move a cursor."""
    return "\n".join(harmless(line, keep_tabs=True) for line in text.split("\n"))


VERB = Verb(
    run=watch,
    description=(
        "Serve the page of a deck, of what a Python script shows, of the mechanism in a STEP file, "
        "or of the layouts for a design problem, to the browser of this machine, and renew it "
        "whenever the file is saved. Ctrl-C ends it."
    ),
    examples=(
        ("A deck", "flexact watch input_decks/paper/five_wires.dat"),
        (
            "A design problem, with layouts as they are found",
            "flexact watch input_decks/designs/mirror_hinge.toml",
        ),
        ("CAD, with what is said of its parts", "flexact watch guide.step"),
        ("A script, at a port that stays", "flexact watch design.py --port 8080 --no-browser"),
    ),
    arguments=(
        argument(
            "deck",
            metavar="FILE",
            help="a deck, a script (*.py): its last .show(), else its last model or analysis; a "
            "STEP file (*.step, *.stp), or a design problem (*.toml, *.json)",
        ),
        argument("--port", type=port, metavar="N", help="the port of this machine (a free one)"),
        NO_BROWSER,
        DECISION,
        ACCURACY,
    ),
)
