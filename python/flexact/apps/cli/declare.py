# SPDX-License-Identifier: BSD-3-Clause
"""``flexact declare``: a deck in which every divided sheet or wire counts as one beam."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...model.model import Model
from ...model.parts.parts import surplus_of
from ...model.reading import read_deck
from ...util.decks import DeckFile
from ...util.outputs import STDOUT
from ...util.text import harmless
from .decks import report_problems, take
from .parser import Verb
from .targets import deck_arguments, one_deck, plan_deck, write_text
from .terminal import ExitCode, Outcome, complain, say


def declare_deck(chosen: argparse.Namespace) -> ExitCode:
    """Declare what is internal to the sheets and wires of the deck that was asked for."""
    deck = one_deck(chosen)
    target: Path = chosen.output
    plan_deck(deck, target)

    def step(deck: DeckFile) -> Outcome:
        model = Model.from_data(read_deck(deck))
        report_problems(model.data)
        count = len(surplus_of(model.data))
        if not count and target != STDOUT:
            text = "nothing to declare: every sheet and wire counts as one beam already"
            say(f"{harmless(deck.name)}: {text}; no deck is written")
            return Outcome(deck.name, ExitCode.ANALYSED, "nothing to declare")
        model.declare_internal_motions()
        write_text(target, model.to_deck().encode())
        what = f"{count} element{'s' * (count != 1)} declared" if count else "nothing to declare"
        if target == STDOUT:
            complain(f"{harmless(deck.name)}: {what}")
        else:
            say(f"{harmless(deck.name)}: written to {harmless(str(target))}, {what}")
        return Outcome(deck.name, ExitCode.ANALYSED, "written")

    return take([deck], step)


VERB = Verb(
    run=declare_deck,
    description=(
        "Write a deck in which what is inside divided sheets and wires is independent (DYNE), so "
        "that each of them counts as one beam. Where nothing is to be declared no file is "
        "written; on standard output the deck comes as it is."
    ),
    examples=(
        (
            "A deck whose sheets of four beams count as one beam each",
            "flexact declare input_decks/flexures/parallel_guide_four_beams_undeclared.dat "
            "-o results/declared.dat",
        ),
    ),
    arguments=(*deck_arguments("the deck to be written; - for stdout", Path),),
)
