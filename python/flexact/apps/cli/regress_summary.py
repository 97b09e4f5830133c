# SPDX-License-Identifier: BSD-3-Clause
"""What came of many decks: how many of what, which want attention, and what can be done."""

from __future__ import annotations

import argparse
import shlex
from collections import Counter
from collections.abc import Iterator, Sequence

from ...util.decks import DeckFile
from ...util.plain_text import harmless
from ..checks.comparison import Finding, State, reasons

#: So many decks of a kind are named; what came of each stands above.
_MOST_NAMED = 20

_Found = Sequence[tuple[DeckFile, Finding]]


def summary(found: _Found, chosen: argparse.Namespace) -> str:
    """How many decks gave what, the worst first, and how new answers are stored."""
    counts = Counter(finding.state for _, finding in found)
    parts = [f"{counts[state]} {state.value}" for state in State if counts[state]]
    lines = [f"{len(found)} decks: {', '.join(parts)}"]
    for state in (State.DIFFERENT, State.FAILED, State.MISSING):
        lines += _of(state, [pair for pair in found if pair[1].state is state])
    if counts[State.DIFFERENT] or counts[State.MISSING]:
        lines += ["To store the new answers, once they are right:", f"  {_command(chosen)}"]
    return "\n".join(lines)


def _of(state: State, found: _Found) -> Iterator[str]:
    if not found:
        return
    worst = sorted(found, key=lambda pair: (-pair[1].gravity, -len(pair[1].differences)))
    first = state.value[0].upper() + state.value[1:]
    yield f"{first}{', the worst first' if state is State.DIFFERENT else ''}:"
    for deck, finding in worst[:_MOST_NAMED]:
        yield f"  {harmless(deck.name)}{_why(finding)}"
    if len(worst) > _MOST_NAMED:
        yield f"  and {len(worst) - _MOST_NAMED} more"


def _why(finding: Finding) -> str:
    if finding.state is State.MISSING:
        return ""
    first, *others = reasons(finding)
    more = f"; {len(others)} more" if others and finding.state is State.DIFFERENT else ""
    return f": {first}{more}"


def _command(chosen: argparse.Namespace) -> str:
    """What stores the answers that are new or differ, and leaves the others alone."""
    method = [] if chosen.method == "auto" else ["--method", chosen.method]
    words = ["flexact", "regress", *chosen.decks, "--against", str(chosen.against), *method]
    return harmless(shlex.join([*words, "--store"]))
