# SPDX-License-Identifier: BSD-3-Clause
"""``flexact export``: a deck's mechanism as a mesh, still or playing, for ParaView."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from ...analysis.naming import motion_in_words
from ...show.drawing.selection import select_motion
from ...show.mesh.collection import ENDINGS, MESHES, STEM, folder_of
from ...show.writers import PLAYING, write
from ...util.decks import DeckFile
from ...util.interruption import unwinding
from ...util.outputs import plan_file, plan_files
from ...util.partial import attempted
from ...util.text import harmless
from .decks import DECISION, read_and_analysed, take
from .parser import Group, Verb
from .targets import SHOWN_MOTION, deck_arguments, one_deck
from .terminal import Bar, ExitCode, Outcome, complain, say


def export_deck(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the deck and write its mesh."""
    deck = one_deck(chosen)
    target: Path = chosen.output
    with unwinding():
        MESHES.require(target)
    plan_file(deck, target)
    if target.suffix.lower() == PLAYING:
        plan_files([replace(deck, relative=Path(STEM))], folder_of(target), ENDINGS)

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            analysis = read_and_analysed(deck, chosen, bar)
            bar.show("writing")
            missing: list[str] = []
            wanted = chosen.motion, chosen.freedom
            if wanted == (None, None):
                shown = attempted("Its motion", lambda: select_motion(analysis), None, missing)
            else:
                shown = select_motion(analysis, *wanted)
            with unwinding():
                motion = None if shown is None else shown.motion
                write(target, MESHES.contents((analysis, motion), target))
        name = harmless(deck.name)
        if missing:
            complain(f"{name}: note: {missing[0]}")
        elif shown is None:
            complain(f"{name}: note: the mechanism does not move; displacements are zero")
        what = ""
        if shown is not None:
            what = f", showing {motion_in_words(analysis, shown.number, shown.freedom)}"
        say(f"{name}: written to {harmless(str(target))}{what}")
        return Outcome(deck.name, ExitCode.ANALYSED, "written")

    return take([deck], step)


VERB = Verb(
    run=export_deck,
    description="Write a mechanism with its motions and self-stresses as a mesh.",
    examples=(
        (
            "A mesh with all modes",
            "flexact export input_decks/paper/twelve_trusses.dat -o results/trusses.vtu",
        ),
        (
            "A motion that plays in ParaView",
            "flexact export input_decks/paper/twelve_trusses.dat --motion 1 -o results/trusses.pvd",
        ),
    ),
    arguments=(
        *deck_arguments(
            "a mesh: .vtu, .vtp, .vtk, .xdmf, ...; or .pvd, the motion as a cycle that plays"
        ),
        Group("what is shown", (SHOWN_MOTION,)),
        DECISION,
    ),
    defaults={"accuracy": None},
)
