"""How the verbs analyse a deck: the choices that they share, remarks, and progress."""

from __future__ import annotations

import argparse
import math

import flexact
from flexact._boundary import METHODS
from flexact.batch import DeckFile
from flexact.cli import remarks
from flexact.cli.bar import Bar


def add_decision(parser: argparse.ArgumentParser) -> None:
    """Add to a verb's parser how the rank of D(c) is decided."""
    add_method(parser)
    parser.add_argument(
        "--tolerance",
        dest="zero_tolerance",
        type=tolerance,
        metavar="T",
        help="singular values of the scaled matrix up to T count as zero",
    )


def add_method(parser: argparse.ArgumentParser) -> None:
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


def opened(deck: DeckFile, bar: Bar) -> flexact.Model:
    """Read a deck, while a bar says so."""
    bar.show("reading")
    model = flexact.read(deck.path)
    bar.clear()
    return model


def analysed(
    deck: DeckFile, model: flexact.Model, chosen: argparse.Namespace, bar: Bar
) -> flexact.Analysis:
    """Analyse a deck as was chosen, while a bar says how far it is."""
    remarks.tell_wait(deck, model, chosen.method)
    return flexact.analyse(
        model,
        method=chosen.method,
        tolerance=chosen.zero_tolerance,
        name=deck.name,
        progress=bar.of_analysis(model),
    )
