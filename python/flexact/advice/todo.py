# SPDX-License-Identifier: BSD-3-Clause
"""What is best done about a result: the first step of the advice, in a line."""

from __future__ import annotations

import shlex

import numpy as np

from ..analysis.naming import Line, ended, line_of, plain
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..util.loading import load
from ..util.partial import attempted
from ..util.text import TIE, harmless
from .step import Step

#: Of a D(c) with more multiplications than this a step takes more than some 0.3 s to find; of
#: more than this so does a repair of few statements.
_MOST_TO_ADVISE, _MOST_TO_REPAIR = 1.0e6, 1.0e8


def todo_of(result: Result, costs: str = "") -> tuple[Line, ...]:
    """What is best done, then what over-constraint costs, where that is known."""
    lines = [attempted("What is best done", lambda: do_this(result), None, None)]
    return tuple(line for line in (*lines, line_of(costs)) if line is not None and plain(line.head))


def do_this(result: Result) -> Line | None:
    """The first step of the advice, and what the mechanism is then; None where none is needed."""
    if result.verdict is Verdict.EXACT:
        return None
    size = float(result.rows) * result.columns * min(result.rows, result.columns)
    step: Step | None = None
    # Vectors of any length may stand in a model.
    with np.errstate(all="ignore"):
        if size <= _MOST_TO_REPAIR:
            advice = load("flexact.advice.advice").advice_of(result)
            steps = advice.numbered() if size <= _MOST_TO_ADVISE else iter(advice.repairs)
            step = next(steps, None)
    if step is None and size > _MOST_TO_ADVISE:
        where = "analysis.advice()"
        if result.given.source is not None and result.name:
            where = f"flexact advise {shlex.quote(harmless(result.name))}".replace(" ", TIE)
        return line_of(f"{where} says what can be done.")
    if step is None:
        return None
    pieces, outcome = ended(step.words()), step.after.outcome
    then = "" if outcome in plain(pieces) else f", and the mechanism is {outcome}"
    return line_of(f"Do this{then}: ", *pieces)
