"""The closing lines of a command that took many decks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from flexact.batch import ExitCode, Outcome

REMARKS = {
    ExitCode.OTHER: "failed",
    ExitCode.DECK_ERROR: "deck with errors",
    ExitCode.DIFFERENT: "not as expected",
}


def summarise(outcomes: Sequence[Outcome]) -> str:
    """How many decks gave what, and which of them want attention; empty for a single deck."""
    if len(outcomes) < 2:
        return ""
    counts = Counter(outcome.result for outcome in outcomes)
    parts = ", ".join(f"{count} {result}" for result, count in counts.most_common())
    lines = [f"{len(outcomes)} decks: {parts}"]
    lines += [
        f"  {REMARKS[outcome.code]}: {outcome.deck}"
        for outcome in outcomes
        if outcome.code is not ExitCode.ANALYSED
    ]
    return "\n".join(lines)
