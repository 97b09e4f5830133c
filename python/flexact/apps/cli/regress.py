# SPDX-License-Identifier: BSD-3-Clause
"""``flexact regress``: compare decks with stored answers, or store them."""

from __future__ import annotations

import argparse
import os
import shlex
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from ...analysis.verdict import AnalysisError
from ...core.progress import Progress
from ...model.data import ModelData
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.loading import load
from ...util.outputs import OutputError, plan_file, plan_files, write_together
from ...util.text import harmless
from ..checks.comparison import Comparison, State, answer_place, case_of, finding_of
from .decks import DECKS, METHOD, announce_wait, report, tolerance
from .parser import Verb, argument
from .targets import WORKERS, file, folder
from .terminal import Bar, ExitCode, Outcome, end_progress, exit_code, say, show_progress

#: So many decks of a kind are named; what came of each stands above.
_MOST_NAMED = 20

_Found = Sequence[tuple[DeckFile, Comparison]]


def summary(found: _Found, chosen: argparse.Namespace) -> str:
    """How many decks gave what, the worst first, and how new answers are stored."""
    counts = Counter(finding.state for _, finding in found)
    parts = [f"{counts[state]} {state.value}" for state in State if counts[state]]
    lines = [f"{len(found)} decks: {', '.join(parts)}"]
    for state in (State.DIFFERENT, State.FAILED, State.MISSING):
        if not counts[state]:
            continue
        some = [pair for pair in found if pair[1].state is state]
        worst = sorted(some, key=lambda pair: (-pair[1].gravity, -len(pair[1].differences)))
        order = ", the worst first" if state is State.DIFFERENT else ""
        lines.append(f"{state.value[0].upper()}{state.value[1:]}{order}:")
        lines += [f"  {harmless(deck.name)}{_why(each)}" for deck, each in worst[:_MOST_NAMED]]
        if len(worst) > _MOST_NAMED:
            lines.append(f"  and {len(worst) - _MOST_NAMED} more")
    if counts[State.DIFFERENT] or counts[State.MISSING]:
        lines += ["To store the new answers, once they are right:", f"  {_command(chosen)}"]
    return "\n".join(lines)


def _why(finding: Comparison) -> str:
    if finding.state is State.MISSING:
        return ""
    first, *others = finding.reasons
    more = f"; {len(others)} more" if others and finding.state is State.DIFFERENT else ""
    return f": {first}{more}"


def _command(chosen: argparse.Namespace) -> str:
    """What stores the answers that are new or differ, and leaves the others alone."""
    method = [] if chosen.method == "auto" else ["--method", chosen.method]
    words = ["flexact", "regress", *chosen.decks, "--against", str(chosen.against), *method]
    return harmless(shlex.join([*words, "--store"]))


def regress_decks(chosen: argparse.Namespace) -> ExitCode:
    """Compare the decks that were asked for with their stored answers, or store them."""
    if chosen.store and chosen.within is not None:
        raise BatchError("--within is for comparing; it has no meaning with --store")
    start = time.time()
    decks = find_decks(chosen.decks)
    if chosen.store:
        plan_files(decks, chosen.against, (".json",))
    if chosen.junit is not None:
        _require_place(chosen.junit, decks, chosen.against)
    found, codes = [], []
    for number, (deck, finding) in enumerate(_findings(decks, chosen), start=1):
        finding, code = _said(deck, finding, chosen.against)
        found.append((deck, finding))
        codes.append(Outcome(deck.name, code, finding.state.value))
        show_progress(number, len(decks), deck.name)
    end_progress()
    if len(decks) > 1:
        say(summary(found, chosen))
    if chosen.junit is not None:
        text = load("flexact.apps.checks.outputs").junit_xml(found, time.time() - start, start)
        with unwinding():
            write_together({chosen.junit: text})
    return exit_code(codes)


def _require_place(junit: Path, decks: Sequence[DeckFile], answers: Path) -> None:
    """Raise where the JUnit file has no place, or one that is taken.

    Raises:
        OutputError: It has none.
    """
    plan_file(DeckFile("the JUnit file", Path()), junit)
    place = os.path.realpath(junit)
    for deck in decks:
        for taken in (deck.path, answer_place(deck, answers)):
            if os.path.realpath(taken) == place:
                raise OutputError(f"{junit} would overwrite {taken}")


def _findings(
    decks: Sequence[DeckFile], chosen: argparse.Namespace
) -> Iterator[tuple[DeckFile, Comparison]]:
    """What comes of each deck, in their order; a folder that gives none fails."""
    asked = {"method": chosen.method, "tolerance": chosen.within, "stores": chosen.store}
    good = [deck for deck in decks if deck.error is None]
    results: Iterator[tuple[Comparison, str]]
    if chosen.dask is None and (len(good) == 1 or chosen.workers == 1):
        results = ((_watched(deck, chosen, asked), "") for deck in good)
    else:
        cases = (case_of(deck, chosen.against) for deck in good)
        results = in_order(partial(finding_of, **asked), cases, chosen)
    for deck in decks:
        if deck.error is not None:
            yield deck, Comparison(State.FAILED, error=deck.error)
            continue
        finding, failure = next(results)
        yield deck, Comparison(State.FAILED, error=AnalysisError(failure)) if failure else finding


def _watched(deck: DeckFile, chosen: argparse.Namespace, asked: dict[str, Any]) -> Comparison:
    """What comes of a deck, while a bar says how far it is."""

    def watch(model: ModelData) -> Progress | None:
        bar.clear()
        announce_wait(deck, model, chosen.method)
        return bar.of_analysis(model)

    with Bar(deck.name, deck.path) as bar:
        bar.show("reading")
        return finding_of(case_of(deck, chosen.against), watch=watch, **asked)


def _said(deck: DeckFile, finding: Comparison, answers: Path) -> tuple[Comparison, ExitCode]:
    """Say what came of a deck, and store it if it is to be."""
    name, place = harmless(deck.name), answer_place(deck, answers)
    if finding.state is State.STORED:
        try:
            with unwinding():
                write_together({place: finding.text.encode()})
        except OutputError as error:
            finding = Comparison(State.FAILED, error=error, seconds=finding.seconds)
        else:
            say(f"{name}: stored in {harmless(str(place))}")
            # All findings are kept, but not the texts of large answers.
            finding = replace(finding, text="")
    if finding.error is not None:
        return finding, report(deck, finding.error, as_json=False).code
    if finding.state is State.DIFFERENT:
        head = f"{name}: differs from {harmless(str(place))}"
        say("\n".join((head, *(f"  {harmless(line)}" for line in finding.differences))))
        return finding, ExitCode.DIFFERENT
    if finding.state is State.AS_STORED:
        say(f"{name}: as stored")
    return finding, ExitCode.ANALYSED


def in_order(
    function: Callable[[Any], Any], items: Iterable[Any], chosen: argparse.Namespace
) -> Iterator[tuple[Any, str]]:
    """Results in the order of the items, each with why there is none; see `results_of`."""
    waiting: dict[int, tuple[Any, str]] = {}
    place = 0
    results_of = load("flexact.sweeps.running").results_of
    for done in results_of(function, items, executor=chosen.dask, workers=chosen.workers):
        waiting[done.index] = done.result, done.failure
        while place in waiting:
            yield waiting.pop(place)
            place += 1


VERB = Verb(
    run=regress_decks,
    description="Compare what does not depend on sign, order or basis with stored answers.",
    examples=(
        (
            "Store the answers, once they are right",
            "flexact regress input_decks/paper --against results/answers --store",
        ),
        (
            "Compare with them: exits with 3 if one differs",
            "flexact regress input_decks/paper --against results/answers",
        ),
    ),
    arguments=(
        DECKS,
        argument(
            "--against",
            type=folder,
            metavar="DIR",
            required=True,
            help="folder of the stored answers: the decks are compared with them, or with --store "
            "theirs are stored there",
        ),
        argument(
            "--store",
            action="store_true",
            help="store the answers that are new or differ in that folder, instead of comparing",
        ),
        argument(
            "--within",
            type=tolerance,
            metavar="D",
            help="largest difference of singular values, as a fraction of the largest "
            "(default 1e-9), and of entries of projectors (default 1e-8)",
        ),
        argument(
            "--junit", type=file, metavar="FILE", help="write what came of each deck as JUnit XML"
        ),
        WORKERS,
        METHOD,
    ),
)
