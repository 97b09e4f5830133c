# SPDX-License-Identifier: BSD-3-Clause
"""What is best done about a result: the first step of the advice, in a line."""

from __future__ import annotations

from ..analysis.naming import Line, ended, line_of, plain
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..util.loading import load
from ..util.partial import attempted
from ..util.text import TIE, harmless

#: Of a D(c) with more multiplications than this a step takes more than some 0.3 s to find.
_MOST_TO_ADVISE = 1.0e6


def todo_of(result: Result, costs: str = "") -> tuple[Line, ...]:
    """What is best done, then what over-constraint costs, where that is known."""
    lines = [attempted("What is best done", lambda: do_this(result), None, None)]
    return tuple(line for line in (*lines, line_of(costs)) if line is not None and plain(line.head))


def do_this(result: Result) -> Line | None:
    """The first step of the advice, and what the mechanism is then; None where none is needed."""
    if result.verdict is Verdict.EXACT:
        return None
    if float(result.rows) * result.columns * min(result.rows, result.columns) > _MOST_TO_ADVISE:
        where = "analysis.advice()"
        if result.given.source is not None and result.name:
            where = f"flexact advise {harmless(result.name)}".replace(" ", TIE)
        return line_of(f"{where} says what can be done.")
    step = next(load("flexact.advice.advice").advice_of(result).numbered(), None)
    if step is None:
        return None
    pieces, outcome = ended(step.words()), step.after.outcome
    then = "" if outcome in plain(pieces) else f", and the mechanism is {outcome}"
    return line_of(f"Do this{then}: ", *pieces)
