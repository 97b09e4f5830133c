# SPDX-License-Identifier: BSD-3-Clause
"""How the verbs read and analyse a deck: the choices that they share, remarks, and progress."""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from ...analysis.decomposition import Accuracy, asked_for
from ...analysis.result import Result, result_of
from ...core.calls import METHODS
from ...deck.diagnostics import Diagnostic, Problems, Severity
from ...deck.rendering import DeckError, render_problems
from ...model.data import ModelData
from ...model.reading import read_deck
from ...util import machine as memory
from ...util.decks import SUFFIX, DeckFile, FolderError
from ...util.errors import BatchError, FlexactError
from ...util.loading import load
from ...util.partial import why
from ...util.quantities import quantity
from ...util.text import harmless
from .parser import Group, argument
from .terminal import (
    Bar,
    ExitCode,
    Outcome,
    ResultsError,
    columns_of,
    complain,
    end_progress,
    exit_code,
    give,
    is_verbose,
    say,
    show_progress,
)

_MEMORY = "out-of-memory"
#: Failures that are none of the deck's.
CODES = {
    "AnalysisError": "not-analysed",
    "OutputError": "not-written",
    "MeshFormatError": "not-written",
    "MemoryError": _MEMORY,
    "UnforeseenError": "unforeseen",
}
#: Codes of problems with a file that are not about what is stated in it.
NOT_READ = {
    "cannot-read",
    "is-a-folder",
    "no-such-file",
    "not-a-file",
    "not-text",
    "too-large",
    _MEMORY,
}


class UnforeseenError(BatchError):
    """One deck over which this program stumbles, which shall not cost the others."""


def foreseen(error: Exception) -> Exception:
    """An error that is raised on purpose: itself, or what stands for a mistake of Flexact's own.

    Raises:
        BrokenPipeError: Nobody reads on, so that going on has no use.
        ResultsError: Likewise.
        Exception: A mistake of Flexact's own, in tests (`flexact.util.partial`).
    """
    if isinstance(error, (BrokenPipeError, ResultsError)):
        raise error
    if isinstance(error, (FlexactError, MemoryError)):
        return error
    return UnforeseenError(why(error))


def report(deck: DeckFile, error: Exception, *, as_json: bool) -> Outcome:
    """Report why a deck failed: rendered on stderr, and as one JSON line on stdout if asked."""
    report_failure(deck, error)
    if as_json:
        problems = problems_of(error)
        records = [each.to_dict() for each in problems.kept if each.is_error]
        failure = {"diagnostics": records, "errors": problems.errors}
        # Loaded where it is wanted: a command that starts does not wait for it.
        head = load("flexact.analysis.json").header(deck.name)
        give(load("json").dumps({**head, "error": failure}))
    return outcome_of(deck, error)


def outcome_of(deck: DeckFile, error: Exception) -> Outcome:
    """What the command makes of a deck's failure."""
    codes = {each.code for each in error.diagnostics} if isinstance(error, DeckError) else set()
    is_other = type(error).__name__ in CODES or _MEMORY in codes
    if isinstance(error, FolderError):
        remark = error.remark
    elif isinstance(error, DeckError):
        remark = "cannot be read" if codes & NOT_READ else ""
    else:
        remark = "failed"
    code = ExitCode.OTHER if is_other else ExitCode.DECK_ERROR
    return Outcome(deck.name, code, "failed", remark)


def report_failure(deck: DeckFile, error: Exception) -> None:
    """Report on stderr why a deck failed."""
    if isinstance(error, DeckError):
        width = columns_of(sys.stderr)
        complain(render_problems(error.problems, error.name, error.source, width))
    elif isinstance(error, FolderError):
        complain(_reason(error))
    else:
        complain(f"{harmless(deck.name)}: error: {_reason(error)}")


def _reason(error: Exception) -> str:
    words = "not enough memory" if isinstance(error, MemoryError) else repr(error)
    return harmless(str(error) or words)


def problems_of(error: Exception) -> Problems:
    """Why a deck failed, as problems: those of the deck, else one without a place."""
    if isinstance(error, DeckError):
        return error.problems
    code = getattr(error, "code", CODES.get(type(error).__name__, "failed"))
    return Problems.of([Diagnostic(Severity.ERROR, code, _reason(error))])


REMARKS = {
    ExitCode.OTHER: "failed",
    ExitCode.DECK_ERROR: "deck with errors",
    ExitCode.DIFFERENT: "not as expected",
}


DECKS = argument(
    "decks", nargs="+", metavar="DECK", help=f"a deck, a folder of *{SUFFIX}, or - for stdin"
)

_Of = TypeVar("_Of")


def each_of(
    decks: Sequence[DeckFile],
    step: Callable[[DeckFile], _Of],
    failed: Callable[[DeckFile, Exception], _Of],
) -> Iterator[_Of]:
    """What comes of one deck after the other; a failing deck does not stop the rest.

    Args:
        decks: The decks.
        step: What is done with a deck, which may raise whatever it likes.
        failed: What comes of a deck that has raised an error.
    """
    for number, deck in enumerate(decks, start=1):
        show_progress(number, len(decks), deck.name)
        try:
            if deck.error is not None:
                raise deck.error
            made = step(deck)
        except Exception as error:
            made = failed(deck, foreseen(error))
        yield made
    end_progress()


def take(
    decks: Sequence[DeckFile],
    step: Callable[[DeckFile], Outcome],
    *,
    as_json: bool = False,
    on_failure: Callable[[DeckFile, Exception], None] | None = None,
) -> ExitCode:
    """Take one deck after the other through `step`, and say what they add up to.

    Args:
        decks: The decks.
        step: As for `each_of`; whatever it raises is told.
        as_json: Whether stdout is for JSON alone.
        on_failure: Says on stdout why a deck failed, in a form for programs, which stdout is for
            then.

    Returns:
        The exit code of the command.
    """

    def failed(deck: DeckFile, error: Exception) -> Outcome:
        outcome = report(deck, error, as_json=as_json)
        if on_failure is not None:
            on_failure(deck, error)
        return outcome

    outcomes = list(each_of(decks, step, failed))
    if text := summarise(outcomes):
        complain(text) if as_json or on_failure else say(text)
    return exit_code(outcomes)


def summarise(outcomes: Sequence[Outcome]) -> str:
    """How many decks gave what, and which of them want attention; empty for a single deck."""
    if len(outcomes) < 2:
        return ""
    counts = Counter(outcome.result for outcome in outcomes)
    parts = ", ".join(f"{count} {result}" for result, count in counts.most_common())
    lines = [f"{len(outcomes)} decks: {parts}"]
    lines += [
        f"  {outcome.remark or REMARKS[outcome.code]}: {harmless(outcome.deck)}"
        for outcome in outcomes
        if outcome.code is not ExitCode.ANALYSED
    ]
    return "\n".join(lines)


#: From this number of rows and columns on, people wait for the decomposition.
LONG_WAIT = 2000

#: Methods that hold D(c) in full.
DENSE = ("svd", "jacobi")


def accuracy(text: str) -> Accuracy:
    """A length, or a length and an angle behind a comma, as an option's type."""
    try:
        length, *angle = text.split(",")
        return Accuracy.of(
            [quantity(length, "m"), *(quantity(part, "rad") for part in angle)],
        )
    except (TypeError, ValueError) as error:
        raise argparse.ArgumentTypeError(
            f"a length, or a length and an angle, is wanted, such as 20um or 20um,0.1mrad, not "
            f"{text!r}: {error}"
        ) from None


def tolerance(text: str) -> float:
    """A finite number that is not negative, as an option's type."""
    value = float(text)
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError
    return value


METHOD = argument("--method", choices=METHODS, default=METHODS[0], help="how D(c) is decomposed")
DECISION = Group(
    "how the rank is decided",
    (
        METHOD,
        argument(
            "--tolerance",
            dest="zero_tolerance",
            type=tolerance,
            metavar="T",
            help="singular values of the scaled matrix up to T count as zero",
        ),
        argument(
            "--prove",
            action=argparse.BooleanOptionalAction,
            default=None,
            help="whether to prove the rank in exact arithmetic (where it costs little)",
        ),
    ),
)
#: To what the workshop makes the parts and puts them together.
ACCURACY = argument(
    "--accuracy",
    type=accuracy,
    metavar="LENGTH[,ANGLE]",
    help="of the workshop, such as 20um or 20um,0.1mrad: a verdict that a smaller misalignment "
    "changes is said to be so, in another colour",
)
#: Likewise, where it is held against the size of each model.
ACCURACY_AND_BEYOND = (
    ACCURACY,
    argument("--beyond", action="store_true", help="take an accuracy larger than the model"),
)


def opened(deck: DeckFile, bar: Bar) -> ModelData:
    """Read a deck, while a bar says so."""
    bar.show("reading")
    model = read_deck(deck)
    bar.clear()
    return model


def report_problems(model: ModelData) -> None:
    """Render the warnings and notes about a deck."""
    if model.problems.kept:
        width = columns_of(sys.stderr)
        complain(render_problems(model.problems, model.name, model.source, width))


def analysed(deck: DeckFile, model: ModelData, chosen: argparse.Namespace, bar: Bar) -> Result:
    """Analyse a deck as was chosen, while a bar says how far it is."""
    announce_wait(deck, model, chosen.method)
    if chosen.accuracy is not None and not chosen.beyond:
        chosen.accuracy.require_within(model.size)
    return result_of(
        model,
        asked_for(chosen.method, chosen.zero_tolerance, chosen.prove, chosen.accuracy),
        deck.name,
        bar.of_analysis(model),
    )


def read_and_analysed(deck: DeckFile, chosen: argparse.Namespace, bar: Bar) -> Result:
    """Read a deck, report its problems, and analyse it."""
    begun = time.perf_counter()
    model = opened(deck, bar)
    report_problems(model)
    read = time.perf_counter()
    result = analysed(deck, model, chosen, bar)
    if is_verbose():
        a = result.given.arrays
        complain(
            f"{harmless(deck.name)}: read in {read - begun:.2g} s: {a.node_number.size} nodes, "
            f"{a.element_number.size} elements; D(c) {result.rows} x {result.columns} decomposed "
            f"by {result.method} in {time.perf_counter() - read:.2g} s: {result.certainty.value}"
        )
    return result


def announce_wait(deck: DeckFile, model: ModelData, method: str) -> None:
    """Say that a dense decomposition will take long."""
    if method not in DENSE:
        return
    count = model.count
    long = min(count.rows, count.columns) >= LONG_WAIT
    if long and memory.dense_needed(count.rows, count.columns) <= memory.allowance():
        complain(
            f"{harmless(deck.name)}: decomposing D(c), {count.rows} x {count.columns}; the time "
            "grows with the third power of its size, a minute or so at 5000"
        )
