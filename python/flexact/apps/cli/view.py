# SPDX-License-Identifier: BSD-3-Clause
"""``flexact view``: the page of a deck in the browser."""

from __future__ import annotations

import argparse

from ...analysis.verdict_words import verdict_word
from ...costs.quick_cost import quick_curve
from ...show.page import page
from ...show.saving import page_bytes
from ...show.window import opens, page_path, write_page
from ...show.writers import as_bytes
from ...util.decks import DeckFile
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.outputs import plan_file
from ...util.partial import attempted
from ...util.text import harmless
from .decks import ACCURACY_AND_BEYOND, DECISION, UNITS, foreseen, read_and_analysed, take
from .parser import Verb, argument
from .report import broken_page_of
from .targets import DECK, NO_BROWSER, file, one_deck
from .terminal import Bar, ExitCode, Outcome, say


def view_deck(chosen: argparse.Namespace) -> ExitCode:
    """Show the deck that was asked for."""
    deck = one_deck(chosen)
    if chosen.output is not None:
        plan_file(deck, page_path(chosen.output))
    return take((deck,), lambda each: _step(each, chosen))


def _step(deck: DeckFile, chosen: argparse.Namespace) -> Outcome:
    place = deck.relative.as_posix()
    try:
        with Bar(deck.name, deck.path) as bar:
            analysis = read_and_analysed(deck, chosen, bar)
            bar.show("drawing")
            with unwinding():
                # A still picture takes a while; it is for browsers elsewhere.
                kept = chosen.output is not None
                misaligned = attempted("", lambda: quick_curve(analysis), None, None)
                content = (
                    page_bytes(analysis, misaligned=misaligned)
                    if kept
                    else as_bytes(page(analysis, misaligned=misaligned))
                )
    except BatchError:
        raise
    except Exception as unforeseen:
        error = foreseen(unforeseen)
        broken = broken_page_of(error, deck.name, place)
        if broken is not None:
            _show(deck, broken[0], "cannot be analysed", chosen)
        raise error from None
    _show(deck, content, verdict_word(analysis), chosen)
    return Outcome(deck.name, ExitCode.ANALYSED, verdict_word(analysis))


def _show(deck: DeckFile, content: bytes, word: str, chosen: argparse.Namespace) -> None:
    with unwinding():
        target = write_page(content, deck.name, chosen.output).absolute()
    say(f"{harmless(deck.name)}: {word}; page in {harmless(str(target))}")
    if not chosen.no_browser:
        opens(target.as_uri())


VERB = Verb(
    run=view_deck,
    description=(
        "Open the page of a deck in the browser: verdict, drawing in motion, self-stresses in "
        "colour, tables, deck. Where no browser can be opened it says where the page is. A deck "
        "with errors gives a page with its diagnostics."
    ),
    examples=(
        (
            "Keep the page, and open no browser",
            "flexact view input_decks/paper/five_wires.dat --no-browser -o results/wires.html",
        ),
    ),
    arguments=(
        DECK,
        argument("-o", "--output", type=file, metavar="PAGE", help="keep the page, NAME.html"),
        NO_BROWSER,
        DECISION,
        UNITS,
        *ACCURACY_AND_BEYOND,
    ),
)
