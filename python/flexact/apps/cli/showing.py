# SPDX-License-Identifier: BSD-3-Clause
"""What the verbs that show a mechanism share: the choice of the deck and of the motion."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from .targets import file


def add_deck(
    parser: argparse.ArgumentParser, words: str, kind: Callable[[str], Path] = file
) -> None:
    """Add the one deck to a verb's parser, and the file made of it, which `words` describe."""
    parser.add_argument("deck", metavar="DECK", help="a deck, or - for stdin")
    parser.add_argument("-o", "--output", type=kind, metavar="FILE", required=True, help=words)


def add_shown(parser: argparse.ArgumentParser, title: str = "what is shown") -> Any:
    """Add the choice of the motion to a verb's parser; numbers count from 1.

    Returns:
        The group of options, for more of them.
    """
    group = parser.add_argument_group(title)
    which = group.add_mutually_exclusive_group()
    which.add_argument(
        "--motion", type=number, metavar="K", help="show motion K (default: the first, if any)"
    )
    which.add_argument(
        "--freedom",
        type=number_or_name,
        metavar="K",
        help="show declared degree of freedom K, or that of a name, such as 'stage y'",
    )
    return group


def add_no_browser(parser: argparse.ArgumentParser) -> None:
    """Add to a verb's parser that no browser is to be opened."""
    parser.add_argument("--no-browser", action="store_true", help="open no browser")


def number(text: str) -> int:
    """A whole number from 1, as an option's type."""
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"a whole number from 1 is wanted, not {text!r}")
    return value


def number_or_name(text: str) -> int | str:
    """A whole number from 1, or a name, as an option's type."""
    return number(text) if text.strip().lstrip("+-").isdecimal() or not text.strip() else text


def one_deck(chosen: argparse.Namespace) -> DeckFile:
    """The deck that is meant.

    Raises:
        BatchError: A folder with several decks is meant.
    """
    decks = find_decks([chosen.deck])
    if len(decks) > 1:
        raise BatchError(f"{chosen.deck} holds {len(decks)} decks; this takes one at a time")
    return decks[0]
