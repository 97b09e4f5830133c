# SPDX-License-Identifier: BSD-3-Clause
"""``flexact design``: from a wanted freedom to layouts of flexures."""

from __future__ import annotations

import argparse
import signal
import sys
from pathlib import Path
from typing import Any

from ...deck.rendering import ProblemsError, render_problems
from ...designs.design import Designs, layouts_of
from ...designs.explain import explain
from ...designs.explain_files import EXPLANATIONS
from ...designs.files import DESIGNS, LAYOUTS, write_decks
from ...designs.problem import SUFFIXES, Problem
from ...designs.reading import problem_of_deck, problem_of_file
from ...model.reading import read
from ...show.writers import write
from ...util.decks import DeckFile
from ...util.errors import BatchError, FlexactError
from ...util.interruption import Stopped, unwinding
from ...util.loading import load
from ...util.outputs import plan_file, plan_files
from ...util.text import harmless
from .decks import failure_of
from .parser import Verb, argument
from .targets import number
from .terminal import Bar, ExitCode, columns_of, complain, give, say, text_width

#: Options that are for decks.
_OF_DECKS = ("body", "wanted", "ground")
#: Options that take the place of what a problem says.
_INSTEAD = ("kinds", "symmetry", "rank", "count")


def design_layouts(chosen: argparse.Namespace) -> ExitCode:
    """Find layouts for the problem that was asked for, say and write them."""
    _plan(chosen, DeckFile(chosen.problem, Path(chosen.problem).with_suffix("")))
    try:
        return _designed(chosen, _problem(chosen))
    except ProblemsError as error:
        width = columns_of(sys.stderr)
        name = error.name or harmless(chosen.problem)
        complain(render_problems(error.problems, name, error.source, width))
        if chosen.json:
            give(load("json").dumps(failure_of(harmless(chosen.problem), error)))
        return ExitCode.OTHER
    except BatchError:
        raise
    except FlexactError as error:
        raise BatchError(str(error)) from error


def _designed(chosen: argparse.Namespace, problem: Problem) -> ExitCode:
    """What the freedom of a problem takes, or its layouts."""
    target: Path | None = chosen.output
    if chosen.explain:
        made = explain(problem)
        if target is not None:
            with unwinding():
                write(target, EXPLANATIONS.contents(made, target))
        give(made.to_json()) if chosen.json else say(f"{made}\n")
        return _written(target, chosen)
    with Bar(problem.title, chosen.problem) as bar, unwinding() as look:

        def show(_: object) -> None:
            look()
            bar.show_work("looking for layouts", 0.5)

        designs = layouts_of(problem, show)
    number = chosen.apply
    if number is not None and designs.layouts and number > len(designs):
        raise BatchError(f"there is no layout {number}: there are {len(designs)}")
    if chosen.refine and designs.layouts:
        designs = _refined(designs, chosen)
        if number is not None:
            number = next(each.number for each in designs if each.refined)
    if chosen.json:
        give(designs.to_json())
    if not designs.layouts:
        if not chosen.json:
            say(f"{designs.describe(text_width())}\n")
        # A page or an answer says why there is none.
        if target is not None and chosen.apply is None and not _is_folder(target):
            with unwinding():
                write(target, DESIGNS.contents(designs, target))
            _written(target, chosen)
        return ExitCode.DECK_ERROR
    if (target is None or chosen.apply is None or chosen.refine) and not chosen.json:
        say(f"{designs.describe(text_width())}\n")
    if target is None:
        return ExitCode.ANALYSED
    with unwinding():
        if number is not None:
            write(target, LAYOUTS.contents(designs[number - 1], target))
        elif _is_folder(target):
            write_decks(designs, target)
        else:
            write(target, DESIGNS.contents(designs, target))
    return _written(target, chosen)


def _refined(designs: Designs, chosen: argparse.Namespace) -> Designs:
    """The layouts with some refined; Ctrl-C keeps the best so far."""
    numbers = () if chosen.apply is None else (chosen.apply,)
    made = None
    try:
        with Bar(designs.problem.title, chosen.problem) as bar, unwinding():
            made = designs.refined(*numbers, progress=bar.show_work)
    except Stopped as stopped:
        if made is None or stopped.number != signal.SIGINT:
            raise
    return made


def _plan(chosen: argparse.Namespace, given: DeckFile) -> None:
    """Find out what is wrong with the choice before anything is sought.

    Raises:
        BatchError: options do not go together, or the file cannot be written.
    """
    is_problem = Path(chosen.problem).suffix.lower() in SUFFIXES
    for name in _OF_DECKS if is_problem else ():
        if getattr(chosen, name):
            raise BatchError(f"--{name} is for a deck; a problem says it itself")
    target: Path | None = chosen.output
    for name in ("apply", "refine"):
        if chosen.explain and getattr(chosen, name):
            raise BatchError(f"--explain finds no layouts: leave it out, or --{name}")
    if target is None:
        if chosen.apply is not None:
            raise BatchError("--apply writes a layout: say where, with -o FILE.dat")
        return
    if chosen.explain:
        EXPLANATIONS.require(target)
    elif chosen.apply is not None:
        LAYOUTS.require(target)
    elif not _is_folder(target):
        DESIGNS.require(target)
    if _is_folder(target):
        plan_files([given], target, (".dat",))
    else:
        plan_file(given, target)


def _is_folder(target: Path) -> bool:
    return not target.suffix or target.is_dir()


def _written(target: Path | None, chosen: argparse.Namespace) -> ExitCode:
    if target is not None:
        text = f"{harmless(chosen.problem)}: written to {harmless(str(target))}"
        complain(text) if chosen.json else say(text)
    return ExitCode.ANALYSED


def _problem(chosen: argparse.Namespace) -> Problem:
    """The problem of a file or a deck, with what options say instead.

    Raises:
        ProblemsError: something of it is wrong; all of it is said.
    """
    instead = {name: getattr(chosen, name) for name in _INSTEAD if getattr(chosen, name)}
    if Path(chosen.problem).suffix.lower() in SUFFIXES:
        return problem_of_file(chosen.problem, instead)
    model = read(chosen.problem)
    of_deck: dict[str, Any] = {"ground": chosen.ground} if chosen.ground else {}
    return problem_of_deck(model, chosen.body, chosen.wanted, **of_deck, **instead)


VERB = Verb(
    run=design_layouts,
    description=(
        "Layouts of flexures that give a body the freedom that is wanted of it and nothing else: "
        "each exactly constrained by the analysis, and ordered by what it is worth."
    ),
    examples=(
        (
            "Layouts of a hinge for a mirror",
            "flexact design input_decks/designs/mirror_hinge.toml",
        ),
        (
            "What a freedom takes, without layouts",
            "flexact design input_decks/designs/mirror_hinge.toml --explain",
        ),
        (
            "The deck of the second layout",
            "flexact design input_decks/designs/mirror_hinge.toml --apply 2 -o results/hinge.dat",
        ),
        (
            "Better sizes and places of the first three",
            "flexact design input_decks/designs/mirror_hinge.toml --refine",
        ),
    ),
    arguments=(
        argument(
            "problem",
            metavar="PROBLEM",
            help="a problem (.toml, .json, .yaml), or a deck to a body of which flexures are added",
        ),
        argument("--explain", action="store_true", help="what the freedom takes, without layouts"),
        argument("-n", "--count", type=number, metavar="N", help="so many layouts (10)"),
        argument(
            "--rank",
            metavar="SCORE",
            help='by what they are ordered, such as "first parasitic frequency" (worst stiffness)',
        ),
        argument(
            "--kinds",
            metavar="KINDS",
            help='of flexures, such as "wire, folded sheet"',
        ),
        argument(
            "--symmetry",
            metavar="SYMMETRY",
            help='that layouts have: "mirror x", "3-fold about z", none, or any',
        ),
        argument(
            "--apply",
            type=number,
            metavar="K",
            help="write layout K to the file of -o: a deck (.dat), a script (.py), its page "
            "(.html), solids (.step, .3mf, .stl, .glb), or a picture",
        ),
        argument(
            "--refine",
            action="store_true",
            help="better sizes and places, within the limits, of the first three layouts, or of "
            "that of --apply; by the score by which they are ordered",
        ),
        argument("--body", metavar="NAME", help="of a deck, the body that is to move"),
        argument(
            "--wanted",
            action="append",
            default=[],
            metavar="MOTION",
            help='of a deck, what it is to do, such as "rotation x"; may be repeated',
        ),
        argument(
            "--ground",
            action="append",
            default=[],
            metavar="BOX",
            help='of a deck, where flexures may end: "0.06..0.08, -0.08..0.08, -0.08..0.08"; may '
            "be repeated",
        ),
        argument("--json", action="store_true", help="one JSON object on stdout"),
        argument(
            *("-o", "--output"),
            type=Path,
            metavar="FILE",
            help="a page of all layouts (.html), the answer (.json), or a folder for their decks; "
            "with --apply the deck or script of one; with --explain a picture or page of the "
            "freedom",
        ),
    ),
)
