# SPDX-License-Identifier: BSD-3-Clause
"""How far a long call of the core has come, while it runs."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from .arrays import IntArray
from .calls import STAGES

#: Receives a stage of the work, and how much of that stage is done, from 0 to 1.
Progress = Callable[[str, float], object]
#: Seconds between two looks at the work.
_PAUSE = 0.1

Result = TypeVar("Result")


def reported(work: Callable[[IntArray], Result], progress: Progress) -> Result:
    """The result of work that says in a (3,) array, stage and per cent, how far it is.

    It runs in a thread of its own, so that this one stays awake for Ctrl-C: the work is then
    told to end soon, and what it gives is dropped.
    """
    stage = np.zeros(3, np.int32)
    results: list[Result] = []
    errors: list[BaseException] = []

    def run() -> None:
        try:
            results.append(work(stage))
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=run, name="flexact", daemon=True)
    thread.start()
    working = True
    try:
        while working:
            number, per_cent, _ = stage.tolist()
            name = STAGES[min(max(number, 0), len(STAGES) - 1)]
            progress(name, min(max(per_cent / 100.0, 0.0), 1.0))
            thread.join(_PAUSE)
            working = thread.is_alive()
    except BaseException:
        stage[2] = 1
        raise
    if errors:
        raise errors[0]
    return results[0]
