# SPDX-License-Identifier: BSD-3-Clause
"""``flexact export``: a mechanism as solids, table or mesh; and the files of `analyse -o`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ...analysis.json import text_of
from ...analysis.naming import motion_in_words
from ...analysis.result import Result
from ...show.drawing.selection import require_there, select_motion
from ...show.mesh import Meshes
from ...show.mesh.collection import ENDINGS, MESHES
from ...show.mesh.file import find_format, mesh_bytes
from ...show.spacar_log import log_text, spacar_log
from ...show.writers import FLEXURES, STILL_SOLIDS, write
from ...util.decks import DeckFile
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.outputs import plan_files, write_together
from ...util.partial import attempted
from ...util.text import harmless
from .decks import DECISION, UNITS, foreseen, read_and_analysed, take
from .parser import Group, Verb, argument
from .targets import SHOWN_MOTION, deck_arguments, number, one_deck, plan_shown
from .terminal import Bar, ExitCode, Outcome, complain, say


def export_deck(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the deck and write its mesh."""
    deck = one_deck(chosen)
    target: Path = chosen.output
    with unwinding():
        _, shows, _ = MESHES.require(target)
    takes_notes = "notes" in shows
    plan_shown(deck, target, ENDINGS)

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            analysis = read_and_analysed(deck, chosen, bar)
            bar.show("writing")
            missing: list[str] = []
            wanted, suffix = (chosen.motion, chosen.freedom), target.suffix.lower()
            if suffix in FLEXURES and wanted != (None, None):
                raise BatchError(f"a table of flexures shows no motion; {target.name} is one")
            if wanted == (None, None) and suffix in (*STILL_SOLIDS, *FLEXURES):
                shown = None
            elif wanted == (None, None):
                shown = attempted("Its motion", lambda: select_motion(analysis), None, missing)
            else:
                shown = select_motion(analysis, *wanted)
            told: dict[str, Any] = {"notes": missing} if takes_notes else {}
            if chosen.stress is not None:
                require_there(
                    chosen.stress, len(analysis.self_stresses), "self-stress", "self-stresses"
                )
                told["stress"] = chosen.stress
            with unwinding():
                motion = None if shown is None else shown.motion
                write(target, MESHES.contents((analysis, motion), target, **told))
        name = harmless(deck.name)
        for note in missing:
            complain(f"{name}: note: {harmless(note)}")
        if shown is None and not missing and not takes_notes:
            complain(f"{name}: note: the mechanism does not move; displacements are zero")
        what = ""
        if shown is not None:
            what = f", showing {motion_in_words(analysis, shown.number, shown.freedom)}"
        say(f"{name}: written to {harmless(str(target))}{what}")
        return Outcome(deck.name, ExitCode.ANALYSED, "written")

    return take([deck], step)


def plan_results(
    decks: Sequence[DeckFile], folder: Path, mesh_format: str
) -> tuple[str, dict[str, tuple[Path, ...]]]:
    """The format of meshes, and where each deck's results go, before anything is computed.

    Raises:
        OutputError: Two decks would write one file, or the folder cannot take files.
        MeshFormatError: There is no such mesh format.
    """
    with unwinding():
        form = find_format(mesh_format)
    return form, plan_files(decks, folder, (".json", ".log", f".{form}"))


def write_results(
    result: Result, files: Sequence[Path], mesh_format: str, log: str | None
) -> Exception | None:
    """Write the results of a deck, or say why not: that is no reason to keep the verdict back."""
    try:
        contents = contents_of(result, mesh_format, log)
        with unwinding():
            write_together(dict(zip(files, contents, strict=True)))
    except Exception as error:
        return foreseen(error)
    return None


def contents_of(result: Result, mesh_format: str, log: str | None = None) -> tuple[bytes, ...]:
    """What stands in the files of a result, in the order of the plan.

    `log` is the form of the log, None that of Flexact.

    Raises:
        OutputError: The mesh cannot be written.
        MemoryError: There is not enough memory.
    """
    json = f"{text_of(result)}\n".encode()
    meshes = Meshes(result)
    words = spacar_log(result) if log else log_text(result, most_in_mesh=meshes.most_modes)
    mesh = meshes.still()
    with unwinding():
        return json, words.encode("utf-8", "backslashreplace"), mesh_bytes(mesh, mesh_format)


VERB = Verb(
    run=export_deck,
    description=(
        "Write a mechanism as solids for CAD, as a table of its flexures, or as a mesh with its "
        "motions and self-stresses."
    ),
    examples=(
        (
            "Solids for CAD, in mm",
            "flexact export input_decks/flexures/parallel_guide.dat -o results/guide.step",
        ),
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
            "solids: .step, .3mf, .stl, or .glb, in which the motion plays; a table of flexures: "
            ".csv, .xlsx; a mesh: .vtu, .vtp, .vtk, .xdmf, ...; or .pvd, the motion as a cycle "
            "that plays"
        ),
        Group(
            "what is shown",
            (
                SHOWN_MOTION,
                argument(
                    "--stress",
                    type=number,
                    metavar="K",
                    help="colour a .glb by self-stress K (default: the first, if any)",
                ),
            ),
        ),
        DECISION,
        UNITS,
    ),
    defaults={"accuracy": None},
)
