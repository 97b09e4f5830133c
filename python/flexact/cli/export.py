"""``flexact export``: a deck's mechanism as a mesh, still or playing, for ParaView."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from flexact.batch import BatchError, DeckFile, ExitCode, Outcome
from flexact.cli import remarks
from flexact.cli.analysed import add_decision, analysed, opened
from flexact.cli.bar import Bar
from flexact.cli.decks import take
from flexact.cli.showing import add_deck, add_shown, one_deck, shown_motion
from flexact.cli.terminal import complain, say
from flexact.interruption import unwinding
from flexact.rendering import harmless

#: The suffix of a motion that plays.
_CYCLE = ".pvd"

if TYPE_CHECKING:
    import flexact
    from flexact.shown import Shown

    Write = Callable[[flexact.Analysis, Shown | None, Path], None]


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
    deck = one_deck(chosen)
    target: Path = chosen.output
    with unwinding():
        write = _writer(target)
    _require_room(deck, target)

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            model = opened(deck, bar)
            remarks.tell_problems(model)
            analysis = analysed(deck, model, chosen, bar)
            bar.show("writing")
            shown = shown_motion(analysis, chosen)
            with unwinding():
                write(analysis, shown, target)
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
    if target.suffix.lower() == _CYCLE:
        from flexact.mesh_cycle import ENDINGS, STEM, folder_of

        plan_files([replace(deck, relative=Path(STEM))], folder_of(target), ENDINGS)


def _writer(target: Path) -> Write:
    """What writes files with this suffix.

    Raises:
        BatchError: There is nothing, or a package is missing.
    """
    suffix = target.suffix.lower()
    if not suffix:
        raise BatchError(f"the suffix of {target} is to say what to write: .vtu, .pvd, ...")
    if suffix == _CYCLE:
        return _write_cycle
    if suffix == ".vtp":
        from flexact.mesh_polydata import require

        require()
        return _write_polydata
    return _meshio_writer(suffix)


def _meshio_writer(suffix: str) -> Write:
    from flexact.mesh import mesh_of
    from flexact.mesh_file import MeshFormatError, find_format
    from flexact.mesh_names import named_bytes
    from flexact.outputs import write_together

    try:
        form = find_format(suffix)
    except MeshFormatError as error:
        raise MeshFormatError(f"{error}; and so will pvd, which plays, or vtp") from error

    def write(analysis: flexact.Analysis, shown: Shown | None, target: Path) -> None:
        mesh = mesh_of(analysis, None if shown is None else shown.motion)
        write_together({target: named_bytes(mesh, form)})

    return write


def _write_polydata(analysis: flexact.Analysis, shown: Shown | None, target: Path) -> None:
    from flexact.mesh import mesh_of
    from flexact.mesh_polydata import polydata_bytes
    from flexact.outputs import write_together

    mesh = mesh_of(analysis, None if shown is None else shown.motion)
    write_together({target: polydata_bytes(mesh)})


def _write_cycle(analysis: flexact.Analysis, shown: Shown | None, target: Path) -> None:
    from flexact.mesh_cycle import Cycle, write_cycle

    write_cycle(Cycle(analysis, None if shown is None else shown.motion, target))
