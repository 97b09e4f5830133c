# SPDX-License-Identifier: BSD-3-Clause
"""Who does the work on many decks: the options, and the results in the order of the decks."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from ...util.loading import load
from .targets import number


def add_workers(parser: argparse.ArgumentParser) -> None:
    """Add to a verb's parser who does the work."""
    who = parser.add_argument_group("who does the work").add_mutually_exclusive_group()
    who.add_argument(
        "-j", "--workers", type=number, metavar="N", help="processes (default: one a processor)"
    )
    who.add_argument(
        "--dask",
        type=address,
        metavar="ADDRESS",
        help="work on a Dask cluster: tcp://host:port of its scheduler",
    )


def address(text: str) -> str:
    """Where a scheduler is, as an option's type."""
    if not re.fullmatch(r"[a-z]+://\S+:\d+", text):
        raise argparse.ArgumentTypeError(f"tcp://host:port of a scheduler is wanted, not {text!r}")
    return text


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
