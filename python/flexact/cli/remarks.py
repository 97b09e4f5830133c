"""What is told about a sound deck before its results."""

from __future__ import annotations

import flexact
from flexact import memory
from flexact.batch import DeckFile
from flexact.cli.terminal import complain
from flexact.rendering import harmless, render_problems

#: From so many rows and columns on, people wait for the decomposition.
LONG_WAIT = 2000

#: Methods that hold D(c) in full.
DENSE = ("svd", "jacobi", "qr")


def tell_problems(model: flexact.Model) -> None:
    """Render the warnings and notes about a deck."""
    if model.diagnostics:
        complain(render_problems(model.data.problems, model.name, model.data.source))


def tell_wait(deck: DeckFile, model: flexact.Model, method: str) -> None:
    """Say that a dense decomposition will take long."""
    count = model.data.count
    long = method in DENSE and min(count.rows, count.columns) >= LONG_WAIT
    if long and memory.dense_needed(count.rows, count.columns) <= memory.allowance():
        complain(
            f"{harmless(deck.name)}: decomposing D(c), {count.rows} x {count.columns}; the time "
            "grows with the third power of its size, a minute or so at 5000"
        )
