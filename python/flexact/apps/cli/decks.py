# SPDX-License-Identifier: BSD-3-Clause
"""How the verbs take decks: their shared options, one deck after the other, and a line of each."""

from __future__ import annotations

import argparse
import math
import os
import re
import sys
import textwrap
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from ...analysis.decomposition import Accuracy, asked_for
from ...analysis.result import Result, result_of
from ...analysis.verdict import Certainty, Verdict
from ...analysis.verdict_words import certainty_word, margin_cells
from ...core.calls import METHODS
from ...deck.diagnostics import Diagnostic, Problems, Severity
from ...deck.rendering import DeckError, render_problems
from ...model.data import Loads, ModelData
from ...model.reading import read_deck
from ...show.writers import TABLES
from ...util import machine as memory
from ...util.decks import SUFFIX, DeckFile, FolderError
from ...util.errors import BatchError, FlexactError
from ...util.loading import load
from ...util.partial import why
from ...util.quantities import Quantity, QuantityError, as_typed, quantity
from ...util.text import columns as text_columns
from ...util.text import harmless
from ...util.units import METRES, Units, units_of
from .parser import Argument, Group, SetSeveral, argument
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
    padded,
    say,
    shortened,
    shortened_middle,
    show_progress,
)

if TYPE_CHECKING:
    from ...sweeps.columns import Cell

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
        give(load("json").dumps(failure_of(deck.name, error)))
    return outcome_of(deck, error)


def failure_of(name: str, error: Exception) -> dict[str, Any]:
    """Why a deck or a problem failed, as the JSON has it."""
    problems = problems_of(error)
    records = [each.to_dict() for each in problems.kept if each.is_error]
    failure = {"diagnostics": records, "errors": problems.errors}
    # Loaded where it is wanted: a command that starts does not wait for it.
    head = load("flexact.analysis.json").header(name)
    return {**head, "error": failure}


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
    if len(outcomes) > 1:
        counts = Counter(outcome.result for outcome in outcomes)
        parts = ", ".join(f"{count} {result}" for result, count in counts.most_common())
        lines = [f"{len(outcomes)} decks: {parts}"]
        lines += [
            f"  {outcome.remark or REMARKS[outcome.code]}: {harmless(outcome.deck)}"
            for outcome in outcomes
            if outcome.code is not ExitCode.ANALYSED
        ]
        text = "\n".join(lines)
        complain(text) if as_json or on_failure else say(text)
    return exit_code(outcomes)


#: From this number of rows and columns on, people wait for the decomposition.
LONG_WAIT = 2000

#: Methods that hold D(c) in full.
DENSE = ("svd", "jacobi")


def accuracy(text: str) -> tuple[Quantity, ...]:
    """A length, or a length and an angle behind a comma, as an option's type."""
    try:
        length, *angle = text.split(",")
        Accuracy.of([quantity(length, "m"), *(quantity(part, "rad") for part in angle)])
        return as_typed(length, "m"), *(as_typed(part, "rad") for part in angle)
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


#: From so many columns on the method sparse is the quickest, and up to so many jacobi takes a tenth
#: of a second.
_SPARSE, _QUICK = 100, 400
#: What one word for the trade of speed for accuracy sets of each option, and how that is said. A
#: proof costs a fifth at most, and without it zeros are judged with more digits, which may take
#: longer (docs/benchmarks.md).
TRADES: dict[str, dict[str, tuple[Any, str]]] = {
    "--fast": {
        "method": ("sparse", f"--method sparse from {_SPARSE} columns of D(c) on"),
        "columns_of_method": ((_SPARSE, math.inf), ""),
        "prove": (None, "a proof where it costs little"),
        "beams": ("4", "--beams 4"),
    },
    "--certain": {
        "method": ("jacobi", f"--method jacobi up to {_QUICK} columns of D(c)"),
        "columns_of_method": ((0, _QUICK), ""),
        "prove": (True, "--prove"),
        "beams": ("auto", "--beams auto"),
    },
}


def trades(*options: str) -> tuple[Argument, ...]:
    """The words for the trade of speed for accuracy, for a verb that has some of the options."""
    return tuple(
        argument(
            word,
            action=SetSeveral,
            nargs=0,
            dest="trade",
            default=(),
            const={o: settings[o] for o in options if o in settings},
            help=f"sets {', '.join(s for o in options if (s := settings.get(o, ('', ''))[1]))}",
        )
        for word, settings in TRADES.items()
    )


def say_trade(
    deck: DeckFile, chosen: argparse.Namespace, work: str, begun: float, gives: str
) -> None:
    """Say on one line what work cost and what it gives, where all is to be said.

    Args:
        deck: The deck.
        chosen: The options, with the word for the trade and what that set.
        work: What was done.
        begun: When, by `time.perf_counter`.
        gives: How sure or accurate the answer is.
    """
    if not is_verbose():
        return
    word, *settings = chosen.trade or ("",)
    by = f" ({word}: {', '.join(settings)})" if word else ""
    peak = memory.peak()
    kept = f" and {peak / 1e6:.0f} MB at most" if peak else ""
    seconds = time.perf_counter() - begun
    complain(f"{harmless(deck.name)}: {work}{by} in {seconds:.2g} s{kept}: {gives}")


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
        *trades("method", "columns_of_method", "prove"),
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


#: In which numbers are shown and, without a unit, given.
UNITS = argument(
    "--units",
    choices=("m", "mm"),
    help="units of what is shown, and of numbers that are given without one: m, or mm with N, MPa, "
    "N mm and N/mm; those of the deck by default",
)


#: Standard acceleration of free fall [m/s2], ISO 80000-3.
_FREE_FALL = 9.80665


def gravity(text: str) -> tuple[Quantity, ...]:
    """A direction of free fall, such as -z, or its components, as an option's type."""
    found = re.fullmatch(r"([+-]?)([xyz])", text.strip())
    if found is not None:
        size = f"{'-' if found[1] == '-' else ''}{_FREE_FALL}m/s2"
        return tuple(size if axis == found[2] else 0.0 for axis in "xyz")
    parts = text.split(",")
    try:
        if len(parts) not in (2, 3):
            raise ValueError
        return tuple(as_typed(part, "m/s2") for part in parts)
    except (QuantityError, ValueError):
        raise argparse.ArgumentTypeError(
            "a direction in which everything falls is wanted, such as -z, or accelerations along "
            f"x, y, z, such as 0,0,-9.81m/s2, not {text!r}"
        ) from None


#: In which attitude the mechanism is.
GRAVITY = argument(
    "--gravity",
    type=gravity,
    metavar="DIRECTION",
    help="where things fall, in place of GRAVITY of the deck: --gravity=-z, or "
    "--gravity=0,0,-9.81; how the mechanism rests is told",
)


def opened(deck: DeckFile, bar: Bar, chosen: argparse.Namespace) -> ModelData:
    """Read a deck, while a bar says so, in the units and the attitude that were chosen."""
    bar.show("reading")
    model = read_deck(deck)
    bar.clear()
    if units := getattr(chosen, "units", None):
        model = replace(model, units=units_of(units))
    if falls := getattr(chosen, "gravity", None):
        acceleration = [model.units.read(part, "m/s2") for part in falls]
        if model.planar and any(acceleration[2:]):
            raise BatchError("the model is planar: write --gravity=-y, or --gravity=0,-9.81m/s2")
        if not model.planar and len(acceleration) < 3:
            raise BatchError("the model is spatial: write --gravity=-z, or --gravity=0,0,-9.81m/s2")
        acceleration = [*acceleration, 0.0][:3]
        nothing = np.zeros((model.arrays.node_number.size, 3))
        loads = model.loads or Loads(nothing, nothing, np.zeros(3))
        none = "" if model.has_stiffness else "stiffness (ESTIFF)"
        if not (none or model.has_mass or loads.force.any() or loads.increment.any()):
            none = "mass (EM, XM)"
        if none:
            complain(f"{harmless(deck.name)}: how it rests is not told: the deck gives no {none}")
        model = replace(model, loads=replace(loads, gravity=np.array(acceleration)))
    return model


def report_problems(model: ModelData) -> None:
    """Render the warnings and notes about a deck."""
    if model.problems.kept:
        width = columns_of(sys.stderr)
        complain(render_problems(model.problems, model.name, model.source, width))


def decision_of(chosen: argparse.Namespace, units: Units = METRES) -> tuple[Any, ...]:
    """How the rank is to be decided: arguments of `asked_for`."""
    columns = getattr(chosen, "columns_of_method", None)
    decision = (chosen.method, chosen.zero_tolerance, chosen.prove, chosen.accuracy)
    return (*decision, units, columns)


def analysed(deck: DeckFile, model: ModelData, chosen: argparse.Namespace, bar: Bar) -> Result:
    """Analyse a deck as was chosen, while a bar says how far it is."""
    asked = asked_for(*decision_of(chosen, model.units))
    if asked.columns is None:
        announce_wait(deck, model, asked.method)
    if asked.accuracy is not None and not chosen.beyond:
        asked.accuracy.require_within(model.size, model.units)
    return result_of(
        model,
        asked,
        deck.name,
        bar.of_analysis(model),
    )


def read_and_analysed(deck: DeckFile, chosen: argparse.Namespace, bar: Bar) -> Result:
    """Read a deck, report its problems, and analyse it."""
    begun = time.perf_counter()
    model = opened(deck, bar, chosen)
    report_problems(model)
    read = time.perf_counter()
    result = analysed(deck, model, chosen, bar)
    a = result.given.arrays
    work = (
        f"read in {read - begun:.2g} s: {a.node_number.size} nodes, {a.element_number.size} "
        f"elements; D(c) {result.rows} x {result.columns} decomposed by {result.method}"
    )
    say_trade(deck, chosen, work, read, certainty_word(result))
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


#: A terminal of fewer columns is taken for one of so many.
_NARROWEST = 32
#: From so many columns of the terminal on there is a place for everything.
_WIDE, _WIDER = 64, 100
#: Columns that are left out where there are fewer.
_LESS = ("freedoms", "certainty")
#: Width of each column, and in a wide terminal.
_WIDTHS = {
    "verdict": (6, 8),
    "under": (5, 5),
    "over": (4, 5),
    "freedoms": (8, 8),
    "margin": (8, 8),
    "certainty": (9, 9),
    "errors": (6, 6),
    "warnings": (8, 8),
    "notes": (5, 5),
}
_WIDE_MARGIN = 20
_NUMBERS = ("under", "over", "freedoms", "errors", "warnings", "notes")
#: Of a cell.
Value = str | int | tuple[str, str]
#: A name is not made shorter than this where there are other columns.
_SHORTEST = 8


class Cells(NamedTuple):
    """What the line of a deck says."""

    values: Mapping[str, Value]
    """By the names of the columns; texts, or numbers."""
    error: str = ""
    """Why there are no others, in place of those behind the first."""
    first: str = "error"
    """The value of the first column, where there is an error."""
    behind: str = ""
    """What stands behind the last column."""


class SummaryTable:
    """The columns of a table, and its lines.

    A value that is two texts is the first in a narrow terminal, and the second in a wide one.
    """

    def __init__(self, columns: Sequence[str], names: Sequence[str]) -> None:
        """Lay out the columns behind that of the decks, whose names are known."""
        # That stated, that of the terminal, or any number.
        seen = columns_of(sys.stdout)
        self.width = max(seen, _NARROWEST) if seen else math.inf
        is_wide, self._wider = self.width >= _WIDE, self.width >= _WIDER
        self._gap = " " * (2 if is_wide else 1)
        self._columns = {
            name: _WIDTHS[name][is_wide] for name in columns if is_wide or name not in _LESS
        }
        if self._wider and "margin" in self._columns:
            self._columns["margin"] = _WIDE_MARGIN
        self.folder, ending = "", ""
        longest = max(text_columns(name) for name in ("deck", *names))
        others = sum(self._columns.values()) + len(self._gap) * len(self._columns)
        room = max(self.width - others, _SHORTEST)
        if longest > room:
            # What all names have in common tells none from another.
            self.folder, ending = _in_common(names)
            longest -= text_columns(self.folder) + len(ending)
        self._name = max(int(min(longest, room)), len("deck"))
        self._names = {name: name[len(self.folder) :].removesuffix(ending) for name in names}

    def head(self) -> str:
        """The first line."""
        return self._line("deck", {name: name for name in self._columns})

    def line(self, name: str, cells: Cells) -> str:
        """The line of a deck."""
        made, behind = self._line(name, cells.values), cells.behind
        if cells.error:
            first = next(iter(self._columns))
            made, behind = self._line(name, {first: cells.first}, (first,)), cells.error
        if behind:
            made += self._gap + behind
        return made if self.width == math.inf else shortened(made, int(self.width))

    def filled(self, words: str) -> str:
        """A sentence below the table."""
        if self.width == math.inf:
            return words
        wide = int(self.width)
        return textwrap.fill(words, wide, subsequent_indent="  ", break_on_hyphens=False)

    def _line(
        self,
        name: str,
        values: Mapping[str, Value],
        columns: Sequence[str] = (),
    ) -> str:
        made = [padded(shortened_middle(self._names.get(name, name), self._name), self._name)]
        for column in columns or self._columns:
            value = values.get(column, "")
            text = value[self._wider] if isinstance(value, tuple) else str(value)
            made.append(padded(text, self._columns[column], right=column in _NUMBERS))
        return self._gap.join(made).rstrip()


def _in_common(names: Sequence[str]) -> tuple[str, str]:
    """The folder that all names lie in, with its stroke, and their common suffix."""
    if len(names) < 2:
        return "", ""
    start = os.path.commonprefix(names)  # noqa: RUF071 - the folder is cut from it
    folder = start[: max(start.rfind("/"), start.rfind(os.sep)) + 1]
    suffixes = {os.path.splitext(name)[1] for name in names}
    return folder, suffixes.pop() if len(suffixes) == 1 else ""


_TOLD = ("verdict", "under", "over", "freedoms", "margin", "certainty")


def summary_argument(about: str) -> Argument:
    """The choice of a table."""
    return argument("--summary", action="store_true", help=about)


def is_table(path: Path | None) -> bool:
    """Whether a path names a table, by its suffix."""
    return path is not None and path.suffix.lower() in TABLES


def tabulate(
    decks: Sequence[DeckFile],
    columns: Sequence[str],
    step: Callable[[DeckFile], tuple[Cells, Outcome]],
) -> ExitCode:
    """Take decks through `step`, a line each as soon as it is known, then what they add up to.

    Args:
        decks: The decks.
        columns: Names of columns behind that of the deck; see `SummaryTable`.
        step: What is done with a deck; it may raise what `take` takes.
    """
    table = SummaryTable(columns, [harmless(deck.name) for deck in decks])
    say(table.head())
    outcomes = []
    for deck, (cells, outcome) in zip(decks, each_of(decks, step, failed), strict=True):
        say(table.line(harmless(deck.name), cells))
        outcomes.append(outcome)
    # Of a deck without a verdict the lines say why.
    counts = Counter(outcome.result for outcome in outcomes)
    parts = ", ".join(
        f"{count} {'with errors' if result == 'failed' else result}"
        for result, count in counts.most_common()
    )
    many = len(outcomes)
    place = f" in {table.folder.rstrip('/' + os.sep)}" if table.folder else ""
    say(table.filled(f"{many} deck{'s' * (many != 1)}{place}: {parts}"))
    for outcome in outcomes:
        if outcome.code is ExitCode.DIFFERENT:
            say(f"  not as expected: {harmless(outcome.deck)}")
    return exit_code(outcomes)


def failed(deck: DeckFile, error: Exception) -> tuple[Cells, Outcome]:
    """The line of a deck that has no result: its first error."""
    words = load("flexact.sweeps.batch").first_error(error, "")
    words = words.removeprefix(f"{harmless(deck.name)}: ").removeprefix(":").lstrip()
    return Cells({}, words), outcome_of(deck, error)


def summarise_results(
    chosen: argparse.Namespace,
    decks: Sequence[DeckFile],
    finish: Callable[[DeckFile, Result], Outcome],
) -> ExitCode:
    """Analyse decks, each for its line, and write the table where that was asked for.

    Args:
        chosen: The options of the verb.
        decks: The decks.
        finish: Writes what else is wanted of a result, and says what its verdict asks for.

    Raises:
        OutputError: The table has no place.
    """
    target: Path | None = chosen.output if is_table(chosen.output) else None
    if target is not None:
        load("flexact.apps.cli.targets").plan_table(target, decks)
    rows: dict[str, dict[str, Cell]] = {}

    def step(deck: DeckFile) -> tuple[Cells, Outcome]:
        try:
            with Bar(deck.name, deck.path) as bar:
                result = analysed(deck, opened(deck, bar, chosen), chosen, bar)
                told = _cells(result), finish(deck, result)
        except Exception as error:
            told = failed(deck, foreseen(error))
            rows[deck.name] = {"error": told[0].error}
        else:
            if target is not None:
                rows[deck.name] = {
                    **load("flexact.sweeps.columns").row_of(result),
                    "degrees_of_freedom": result.degrees_of_freedom,
                    "certainty": certainty_word(result),
                }
        return told

    code = tabulate(decks, _TOLD, step)
    if target is not None:
        # Those that `batch` has too go by the same names.
        known = load("flexact.sweeps.columns")
        names = ("verdict", "under_constrained", "over_constrained", "certainty", "margin")
        of = {column.name: column for column in known.COLUMNS}
        columns = (
            *(load("flexact.sweeps.batch").DECK, *(of[name] for name in names[:3])),
            known.Column("degrees_of_freedom", int, "declared degrees of freedom", "verdict"),
            *(of["certainty"], of["margin"], of["margin_angle"], known.ERROR),
        )
        # A folder that gives no decks has not come to a step.
        found = ((deck, rows.get(deck.name, {"error": str(deck.error)})) for deck in decks)
        lines = ([deck.name, *(row.get(c.name) for c in columns[1:])] for deck, row in found)
        load("flexact.sweeps.columns").write_table(target, columns, lines)
        say(f"table in {harmless(str(target))}")
    return code


def _cells(result: Result) -> Cells:
    word = result.verdict.word
    if result.verdict is Verdict.EXACT and result.is_marginal:
        word = "marginal"
    sure = certainty_word(result)
    doubt = "?" * (result.certainty is Certainty.DOUBTFUL)
    return Cells(
        {
            "verdict": word + doubt,
            "under": result.under_constrained,
            "over": result.over_constrained,
            "freedoms": result.degrees_of_freedom,
            "margin": margin_cells(result),
            "certainty": "certain" if sure == Certainty.CERTAIN.value else sure,
        }
    )
