"""``flexact analyse``: verdict, counts, motions and self-stresses of decks."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import flexact
from flexact.batch import BatchError, DeckFile, ExitCode, Outcome, find_decks
from flexact.cli import failures, remarks
from flexact.cli.analysed import add_decision, analysed, opened
from flexact.cli.bar import Bar
from flexact.cli.decks import add_decks, take
from flexact.cli.terminal import complain, say
from flexact.interruption import unwinding
from flexact.rendering import harmless

if TYPE_CHECKING:
    from flexact.mesh.file import MeshFormat

VERDICTS = {
    "exact": flexact.Verdict.EXACT,
    "under": flexact.Verdict.UNDER,
    "over": flexact.Verdict.OVER,
    "both": flexact.Verdict.BOTH,
}


def add_parser(verbs: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add this verb to the command's parser."""
    parser = verbs.add_parser(
        "analyse",
        help="verdict, counts, motions and self-stresses of decks",
        description="Decide whether mechanisms are exactly, under- or over-constrained.",
        allow_abbrev=False,
    )
    add_decks(parser)
    parser.add_argument("--json", action="store_true", help="one JSON object a line on stdout")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="write NAME.json, NAME.log and the mesh NAME.vtu there",
    )
    parser.add_argument(
        "--format", metavar="FORMAT", help="mesh format: vtu (default), vtk, xdmf, ..."
    )
    add_decision(parser)
    parser.add_argument("--expect", choices=VERDICTS, help="exit with 3 for any other verdict")
    parser.set_defaults(run=analyse_decks)


def analyse_decks(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the decks that were asked for, say and write the results."""
    if chosen.format and not chosen.output:
        raise BatchError("--format is for the mesh, which needs a folder: -o DIR")
    decks = find_decks(chosen.decks)
    return take(decks, _Work(chosen, decks).step, as_json=chosen.json)


class _Work:
    """One run of the verb: what was chosen, and where each deck's results go."""

    def __init__(self, chosen: argparse.Namespace, decks: tuple[DeckFile, ...]) -> None:
        self.chosen = chosen
        self.format: MeshFormat | None = None
        self.plan: dict[str, tuple[Path, ...]] = {}
        if chosen.output:
            from flexact.mesh.file import find_format
            from flexact.outputs import plan_files

            with unwinding():
                self.format = find_format(chosen.format or "vtu")
            suffixes = (".json", ".log", self.format.suffix)
            self.plan = plan_files(decks, chosen.output, suffixes)

    def step(self, deck: DeckFile) -> Outcome:
        """Analyse one deck, say and write its results."""
        with Bar(deck.name, deck.path) as bar:
            model = opened(deck, bar)
            remarks.tell_problems(model)
            analysis = analysed(deck, model, self.chosen, bar)
            bar.show("writing")
            failure = self._write(deck, analysis) if self.format is not None else None
            words = analysis.to_json() if self.chosen.json else _words(analysis)
        say(words)
        outcome = self._judge(deck, analysis.verdict)
        if failure is None:
            return outcome
        failures.tell_people(deck, failure)
        return replace(outcome, code=ExitCode.OTHER, remark="results not written")

    def _write(self, deck: DeckFile, analysis: flexact.Analysis) -> Exception | None:
        """Write the results, or say why not: that is no reason to keep the verdict back."""
        from flexact.log import log_text
        from flexact.mesh import Meshes
        from flexact.mesh.file import mesh_bytes
        from flexact.outputs import OutputError, write_together

        assert self.format is not None
        try:
            contents = [f"{analysis.to_json()}\n".encode()]
            meshes = Meshes(analysis)
            log = log_text(analysis, most_in_mesh=meshes.most_modes)
            contents.append(log.encode("utf-8", "backslashreplace"))
            mesh = meshes.still()
            with unwinding():
                contents.append(mesh_bytes(mesh, self.format))
                write_together(dict(zip(self.plan[deck.path], contents, strict=True)))
        except (OutputError, MemoryError) as error:
            return error
        return None

    def _judge(self, deck: DeckFile, verdict: flexact.Verdict) -> Outcome:
        code = ExitCode.ANALYSED
        if self.chosen.expect and verdict is not VERDICTS[self.chosen.expect]:
            code = ExitCode.DIFFERENT
            wanted = VERDICTS[self.chosen.expect].value
            complain(f"{harmless(deck.name)}: {verdict.value}, but expected {wanted}")
        return Outcome(deck.name, code, verdict.value)


def _words(analysis: flexact.Analysis) -> str:
    from flexact.words import MOST_MODES, describe

    # What concerns the deck was told on stderr.
    return f"{describe(analysis, about_model=False, most=MOST_MODES)}\n"
