"""What is told about a sound deck before its results."""

from __future__ import annotations

import flexact
from flexact import memory
from flexact.batch import DeckFile
from flexact.cli.terminal import complain
from flexact.rendering import harmless, render_problems

#: From so many rows and columns on, people wait for the decomposition.
LONG_WAIT = 2000


def tell_problems(model: flexact.Model) -> None:
    """Render the warnings and notes about a deck."""
    if model.diagnostics:
        complain(render_problems(model.data.problems, model.name, model.data.source))


def tell_wait(deck: DeckFile, model: flexact.Model) -> None:
    """Say that a decomposition will take long."""
    count = model.data.count
    long = min(count.rows, count.columns) >= LONG_WAIT
    if long and memory.is_enough(count.rows, count.columns):
        complain(
            f"{harmless(deck.name)}: decomposing D(c), {count.rows} x {count.columns}; the time "
            "grows with the third power of its size, a minute or so at 5000"
        )
