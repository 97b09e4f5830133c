# SPDX-License-Identifier: BSD-3-Clause
"""Work beside the conversation with the editor, in threads that no ending waits for."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from typing import TypeVar

Made = TypeVar("Made")


async def beside(work: Callable[[], Made]) -> Made:
    """What some work gives, which runs in a thread of its own while others are answered."""
    return await asyncio.shield(_started(work))


def _started(work: Callable[[], Made]) -> asyncio.Future[Made]:
    loop = asyncio.get_running_loop()
    future: asyncio.Future[Made] = loop.create_future()
    # Nobody may be left to hear of it.
    future.add_done_callback(lambda done: done.cancelled() or done.exception())

    def tell(made: Made | None, error: BaseException | None) -> None:
        if future.done():
            return
        if error is not None:
            future.set_exception(error)
        else:
            future.set_result(made)  # type: ignore[arg-type]

    def run() -> None:
        made, error = None, None
        try:
            made = work()
        except BaseException as caught:
            error = caught
        if not loop.is_closed():
            loop.call_soon_threadsafe(tell, made, error)

    threading.Thread(target=run, name="flexact", daemon=True).start()
    return future


class OneAtATime:
    """Long work, of which the next starts when the last has ended, wanted or not.

    The core cannot be stopped halfway; so no more than one processor is busy for nothing.
    """

    def __init__(self) -> None:
        """Nothing is going on."""
        self._last: asyncio.Future[object] | None = None

    async def run(self, work: Callable[[], Made]) -> Made:
        """Wait for what is going on, then do the work; a task that is cancelled starts nothing."""
        while self._last is not None and not self._last.done():
            await asyncio.wait([self._last])
        future = _started(work)
        self._last = future  # type: ignore[assignment]
        return await asyncio.shield(future)
