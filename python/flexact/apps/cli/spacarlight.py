# SPDX-License-Identifier: BSD-3-Clause
"""``flexact spacarlight``: what `spacarlight.m` asks for scripts in MATLAB and Octave."""

from __future__ import annotations

import argparse
from importlib import resources
from pathlib import Path

from ...advice.describe import describe
from ...advice.todo import todo_of
from ...analysis.result import Result
from ...costs.quick_cost import quick_cost, quick_curve
from ...deck.diagnostics import Severity
from ...deck.rendering import ProblemsError
from ...model.data import ModelData
from ...model.reading import read_text
from ...show.page import page
from ...show.window import opens, page_path
from ...show.writers import as_bytes
from ...util.decks import DeckFile
from ...util.errors import BatchError, FlexactError
from ...util.interruption import unwinding
from ...util.loading import load
from ...util.outputs import plan_file, write_together
from ...util.partial import attempted
from ...util.text import harmless, wrapped
from ..convert.files import JSON, YAML, bytes_in, read_tables
from ..convert.script_results import Script, results_of, text_of_results
from ..convert.table_input import LEFT_OUT, PRESCRIBED, SIMULATED, TRANSFER
from .parser import Verb, argument
from .targets import NO_BROWSER, file
from .terminal import ExitCode, complain, say, text_width

#: The function is a file of the package, to be put on the path of MATLAB or Octave.
_FOLDER = "matlab"


def run_script(chosen: argparse.Namespace) -> ExitCode:
    """Say the verdict of the script's tables, and write its page, deck and results."""
    if chosen.path:
        say(str(resources.files("flexact") / _FOLDER))
        return ExitCode.ANALYSED
    if chosen.file is None:
        raise BatchError("which tables? name a file, or ask with --path where spacarlight.m is")
    path: Path = chosen.file
    if path.suffix.lower() not in (*JSON, *YAML):
        raise BatchError(f"{path}: tables are .json or .yaml")
    source = DeckFile(str(path), Path(path.stem))
    for target in (chosen.output, chosen.page, chosen.deck):
        if target is not None:
            plan_file(source, target)
    try:
        tables, text = read_tables(bytes_in(path), str(path), path.suffix.lower())
        script = Script.of(tables, path.stem, text)
        # What is said of the deck names its lines, and it is there to go on with.
        deck = script.designed.to_deck()
    except ProblemsError as error:
        complain(str(error))
        return ExitCode.DECK_ERROR
    _say_remarks(script.designed.data)
    name = path.stem if chosen.deck is None else str(chosen.deck)
    with unwinding():
        designed = load("flexact.api").analyse(read_text(deck, name))
        _say(designed)
        files = {chosen.deck: deck.encode()}
        if chosen.page is not None:
            curve = attempted("", lambda: quick_curve(designed), None, None)
            files[page_path(chosen.page)] = as_bytes(page(designed, misaligned=curve))
        files.pop(None, None)
        write_together(files)
    if chosen.page is not None:
        say(f"The drawing in motion: {harmless(str(chosen.page))}")
        if not chosen.no_browser:
            opens(chosen.page.absolute().as_uri())
    if chosen.output is None:
        return ExitCode.ANALYSED
    try:
        with unwinding():
            results = results_of(script, designed)
    except FlexactError as error:
        complain(f"flexact: error: no results: {harmless(str(error))}")
        return ExitCode.DECK_ERROR
    for note in results.get("notes", ()):
        say(wrapped(f"Of the results: {note}.", text_width(), "  "))
    for missing, why in results["missing"].items():
        complain(f"flexact: not among the results: {missing}: {harmless(why)}")
    write_together({chosen.output: text_of_results(results).encode()})
    return ExitCode.ANALYSED


def _say_remarks(model: ModelData) -> None:
    """What the flexures were taken for, and what of the script is left out here."""
    for each in model.besides:
        if each.code == TRANSFER or each.message.startswith((SIMULATED, PRESCRIBED)):
            continue
        lead = "warning: " if each.severity is Severity.WARNING else ""
        lead += "left out: " if each.code == LEFT_OUT else ""
        say(wrapped(f"{lead}{harmless(each.message)}.", text_width(), "  "))


def _say(result: Result) -> None:
    """The verdict, what is best done and what it costs: the head of what `analyse` says."""
    cost = attempted("", lambda: quick_cost(result), "", None)
    words = describe(
        result, about_model=False, most=0, width=text_width(), todo=todo_of(result, cost)
    )
    say(words.split("\n\n")[0])


VERB = Verb(
    run=run_script,
    description=(
        "Answer a script for SPACAR Light, whose tables are given as JSON: the verdict and what "
        "over-constraint costs, a page, a deck, and the results that scripts read. The function "
        "spacarlight.m calls it; --path says where that is, for addpath of MATLAB and Octave."
    ),
    examples=(
        (
            "Where spacarlight.m is",
            "flexact spacarlight --path",
        ),
    ),
    arguments=(
        argument("file", metavar="TABLES", type=Path, nargs="?", help="tables, .json or .yaml"),
        argument("--path", action="store_true", help="say in which folder spacarlight.m is"),
        argument(
            "-o",
            "--output",
            type=file,
            metavar="FILE",
            help="results along the load steps, as JSON",
        ),
        argument("--page", type=file, metavar="PAGE", help="the page of the verdict, NAME.html"),
        argument("--deck", type=file, metavar="FILE", help="the deck that the verdict is of"),
        NO_BROWSER,
    ),
)
