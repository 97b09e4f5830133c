# SPDX-License-Identifier: BSD-3-Clause
"""The answers of all variants, in their order, from whoever works on them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing
from itertools import islice
from typing import Any, NamedTuple, TypeVar

from ..core.progress import Progress
from .engine_running import results_of
from .errors import EngineError
from .parameters import Wrong
from .sweeps_worker import Answer, failed

Item = TypeVar("Item")


class Work(NamedTuple):
    """By whom the work is done, and who is told of it."""

    workers: int | None = None
    executor: Any = None
    progress: Progress | None = None


def answers_of(
    function: Callable[[Item], Answer],
    items: Iterator[Item | Wrong],
    count: int | None,
    want: str,
    work: Work,
) -> list[Answer]:
    """The answer to each item; what is done when the engine is lost stays.

    Args:
        function: What makes an answer.
        items: Taken as they are needed; what is wrong with one is its answer.
        count: How many there will be, if that is known.
        want: One of `WANTS`.
        work: By whom.

    Raises:
        EngineError: nothing could be done at all.
    """
    answers: dict[int, Answer] = {}
    sent: list[int] = []
    seen = 0

    def taken() -> Iterator[Item]:
        nonlocal seen
        for item in items:
            place, seen = seen, seen + 1
            if isinstance(item, Wrong):
                answers[place] = failed(item.message, want)
            else:
                sent.append(place)
                yield item

    results = results_of(function, taken(), executor=work.executor, workers=work.workers)
    try:
        with closing(results):
            for done in results:
                answer = done.result or failed(done.failure, want)
                answers[sent[done.index]] = answer
                if work.progress is not None:
                    share = len(answers) / count if count else 0.0
                    work.progress(f"variant {len(answers)}", min(share, 1.0))
    except EngineError as error:
        if not answers:
            raise
        left = taken()
        # Rows that come one by one may have no end.
        for _ in left if count is not None else islice(left, 1):
            pass
        further = "" if count is not None else ", nor is what would follow"
        for place in range(seen):
            answers.setdefault(place, failed(f"not done{further}: {error}", want))
    return [answers[place] for place in range(seen)]
