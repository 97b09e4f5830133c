"""``flexact export``: a deck's mechanism as a mesh, still or playing, for ParaView."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from flexact.batch import DeckFile, ExitCode, Outcome
from flexact.cli import remarks
from flexact.cli.analysed import add_decision, analysed, opened
from flexact.cli.bar import Bar
from flexact.cli.decks import take
from flexact.cli.showing import add_deck, add_shown, one_deck, shown_motion
from flexact.cli.terminal import complain, say
from flexact.interruption import unwinding
from flexact.rendering import harmless


def add_parser(verbs: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add this verb to the command's parser."""
    parser = verbs.add_parser(
        "export",
        help="a deck's mechanism with its modes as a mesh, for ParaView",
        description="Write a mechanism with its motions and self-stresses as a mesh.",
        allow_abbrev=False,
    )
    add_deck(
        parser, "a mesh: .vtu, .vtp, .vtk, .xdmf, ...; or .pvd, the motion as a cycle that plays"
    )
    add_shown(parser)
    add_decision(parser)
    parser.set_defaults(run=export_deck)


def export_deck(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the deck and write its mesh."""
    from flexact.mesh.writing import mesh_writer

    deck = one_deck(chosen)
    target: Path = chosen.output
    with unwinding():
        write = mesh_writer(target)
    _require_room(deck, target)

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            model = opened(deck, bar)
            remarks.tell_problems(model)
            analysis = analysed(deck, model, chosen, bar)
            bar.show("writing")
            shown = shown_motion(analysis, chosen)
            with unwinding():
                write(analysis, None if shown is None else shown.motion, target)
        name = harmless(deck.name)
        if shown is None:
            complain(f"{name}: note: the mechanism does not move; displacements are zero")
        what = "" if shown is None else f", showing {shown.words}"
        say(f"{name}: written to {harmless(str(target))}{what}")
        return Outcome(deck.name, ExitCode.ANALYSED, "written")

    return take([deck], step)


def _require_room(deck: DeckFile, target: Path) -> None:
    """Raise where the files cannot be, or would overwrite the deck.

    Raises:
        BatchError: They cannot.
    """
    from flexact.outputs import plan_file, plan_files

    plan_file(deck, target)
    from flexact.mesh.cycle import ENDINGS, STEM, SUFFIX, folder_of

    if target.suffix.lower() == SUFFIX:
        plan_files([replace(deck, relative=Path(STEM))], folder_of(target), ENDINGS)
