# SPDX-License-Identifier: BSD-3-Clause
"""What is best done about a result: the first step of the advice, in a line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from ..analysis.naming import Line, ended, line_of, plain
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..util.loading import load
from ..util.partial import attempted
from ..util.text import TIE, harmless

if TYPE_CHECKING:
    from .step import Step

#: Of a D(c) with more multiplications than this a step takes more than some 0.3 s to find; of
#: more than this so does a repair of few statements.
_MOST_TO_ADVISE, _MOST_TO_REPAIR = 1.0e6, 1.0e8


def todo_of(result: Result, *told: str) -> tuple[Line, ...]:
    """What is best done, then sentences on what is known besides, such as what it costs."""

    def found() -> Line | None:
        return do_this(result, first_steps(result, 1))

    lines = [attempted("What is best done", found, None, None)]
    lines += map(line_of, told)
    return tuple(line for line in lines if line is not None and plain(line.head))


def first_steps(result: Result, most: int) -> tuple[Step, ...] | None:
    """The first steps of the advice, none where none is needed; None where that takes long.

    Of large mechanisms they are repairs of few statements.
    """
    if result.verdict is Verdict.EXACT:
        return ()
    size = float(result.rows) * result.columns * min(result.rows, result.columns)
    if size > _MOST_TO_REPAIR:
        return None
    advice = load("flexact.advice.advice").advice_of(result)
    # Vectors of any length may stand in a model.
    with np.errstate(all="ignore"):
        if size > _MOST_TO_ADVISE:
            made = (replace(one, number=k) for k, one in enumerate(advice.repairs[:most], 1))
            return tuple(made) or None
        return tuple(islice(advice.numbered(), most))


def do_this(result: Result, steps: Sequence[Step] | None) -> Line | None:
    """The first step, and what the mechanism is then; None where none is needed.

    Args:
        result: The result.
        steps: The first steps of its advice, as `first_steps` gives them.
    """
    if steps is None:
        where = "analysis.advice()"
        if result.given.source is not None and result.name:
            name = load("shlex").quote(harmless(result.name))
            where = f"flexact advise {name}".replace(" ", TIE)
        return line_of(f"{where} says what can be done.")
    if not steps:
        return None
    pieces, outcome = ended(steps[0].words()), steps[0].outcome
    then = "" if outcome in plain(pieces) else f", and the mechanism is {outcome}"
    return line_of(f"Do this{then}: ", *pieces)
