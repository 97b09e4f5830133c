# SPDX-License-Identifier: BSD-3-Clause
"""How the verbs read and analyse a deck: the choices that they share, remarks, and progress."""

from __future__ import annotations

import argparse
import math
import sys
import time

from ...analysis.accuracy import Accuracy
from ...analysis.result import Result, result_of
from ...analysis.spaces import asked_for
from ...core.calls import METHODS
from ...deck.rendering import render_problems
from ...model.data import ModelData
from ...model.reading import read_deck
from ...util import memory
from ...util.decks import DeckFile
from ...util.plain_text import harmless
from ...util.quantities import quantity
from .bar import Bar
from .terminal import columns_of, complain, is_verbose

#: From this number of rows and columns on, people wait for the decomposition.
LONG_WAIT = 2000

#: Methods that hold D(c) in full.
DENSE = ("svd", "jacobi")


def add_decision(parser: argparse.ArgumentParser) -> None:
    """Add to a verb's parser how the rank of D(c) is decided."""
    group = parser.add_argument_group("how the rank is decided")
    add_method(group)
    group.add_argument(
        "--tolerance",
        dest="zero_tolerance",
        type=tolerance,
        metavar="T",
        help="singular values of the scaled matrix up to T count as zero",
    )
    group.add_argument(
        "--prove",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="whether to prove the rank in exact arithmetic (where it costs little)",
    )


def add_accuracy(parser: argparse.ArgumentParser, *, is_held_against: bool = True) -> None:
    """Add to a verb's parser to what the workshop makes the parts and puts them together.

    Args:
        parser: The parser.
        is_held_against: Whether it is held against the size of each model.
    """
    parser.add_argument(
        "--accuracy",
        type=accuracy,
        metavar="LENGTH[,ANGLE]",
        help="of the workshop, such as 20um or 20um,0.1mrad: a verdict that a smaller "
        "misalignment changes is said to be so, in another colour",
    )
    if is_held_against:
        parser.add_argument(
            "--beyond", action="store_true", help="take an accuracy larger than the model"
        )


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


def add_method(parser: argparse._ActionsContainer) -> None:
    """Add the choice of the method to a verb's parser."""
    parser.add_argument(
        "--method", choices=METHODS, default=METHODS[0], help="how D(c) is decomposed"
    )


def tolerance(text: str) -> float:
    """A finite number that is not negative, as an option's type."""
    value = float(text)
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError
    return value


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
        complain(_done(deck, result, read - begun, time.perf_counter() - read))
    return result


def _done(deck: DeckFile, result: Result, reading: float, analysing: float) -> str:
    """What was done to a deck, and how long it took [s]."""
    a = result.given.arrays
    return (
        f"{harmless(deck.name)}: read in {reading:.2g} s: {a.node_number.size} nodes, "
        f"{a.element_number.size} elements; D(c) {result.rows} x {result.columns} decomposed by "
        f"{result.method} in {analysing:.2g} s: {result.certainty.value}"
    )


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
