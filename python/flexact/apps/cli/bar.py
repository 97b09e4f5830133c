# SPDX-License-Identifier: BSD-3-Clause
"""The bar that shows on a terminal how far a large deck has come, stage by stage."""

from __future__ import annotations

import contextlib
import os
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

from ...core.calls import STAGES
from ...model.data import ModelData
from ...util.plain_text import harmless

if TYPE_CHECKING:
    from ...core.progress import Progress

#: Decks of so many bytes, or elements, are worth a bar.
LARGE_FILE = 2**20
LARGE_MODEL = 20_000

_WIDTH, _ROWS = 80, 24

_STAGES = ("reading", *STAGES, "writing")


class Bar:
    """A bar on stderr; it says nothing unless a deck is large and somebody watches."""

    def __init__(self, deck: str, path: str) -> None:
        """The bar of a deck, of which no more than its file is known so far."""
        self._deck = harmless(os.path.basename(deck))
        self._bar: Any = None
        try:
            self._wanted = os.path.getsize(path) >= LARGE_FILE
        except (OSError, ValueError):
            self._wanted = False

    def __enter__(self) -> Bar:
        """Nothing is shown yet."""
        return self

    def __exit__(self, *_: object) -> None:
        """Wipe the bar."""
        self.clear()

    def of_analysis(self, model: ModelData) -> Progress | None:
        """What shows the progress of an analysis; None where it would show nothing."""
        self._wanted = model.arrays.element_number.size >= LARGE_MODEL
        return self.show if self._wanted and is_watched() else None

    def show(self, stage: str, done: float = 0.0) -> None:
        """Draw the bar at a stage, of which a part from 0 to 1 is done."""
        if not self._wanted or not is_watched():
            return
        text = f"{self._deck}: {stage}"
        with contextlib.suppress(ImportError, OSError):
            if self._bar is None:
                self._bar = _drawn(text)
            self._bar.n = max(self._bar.n, (_STAGES.index(stage) + done) / len(_STAGES))
            self._bar.set_description_str(text)

    def show_frames(self, done: float) -> None:
        """Draw the bar of an animation, of which a part from 0 to 1 is drawn; always wanted."""
        self.show_work("drawing", done)

    def show_steps(self, done: float) -> None:
        """Draw the bar of a path, of which a part from 0 to 1 is traced; always wanted."""
        self.show_work("tracing", done)

    def show_work(self, what: str, done: float) -> None:
        """Draw the bar of other work, of which a part from 0 to 1 is done; always wanted."""
        self._wanted = True
        if not is_watched():
            return
        text = f"{self._deck}: {what}"
        with contextlib.suppress(ImportError, OSError):
            if self._bar is None or done <= self._bar.n:
                self.clear()
                self._bar = _drawn(text)
            self._bar.set_description_str(text, refresh=False)
            self._bar.n = done
            self._bar.refresh()

    def clear(self) -> None:
        """Wipe the bar, so that something else can be said."""
        if self._bar is not None:
            with contextlib.suppress(OSError):
                self._bar.clear()


def _drawn(text: str) -> Any:
    tqdm = import_module("tqdm").tqdm
    tqdm.monitor_interval = 0  # no thread of its own: the core's calls say when to draw
    form = "{desc} {percentage:3.0f}%|{bar}| {elapsed}"
    size = size_of_terminal()
    return tqdm(total=1.0, file=sys.stderr, leave=False, desc=text, bar_format=form, **size)


def size_of_terminal() -> dict[str, int]:
    """Columns and rows that a bar may take."""
    # Some terminals say that they have no columns and no rows.
    width = os.get_terminal_size(sys.stderr.fileno()).columns or _WIDTH
    return {"ncols": width - 1, "nrows": _ROWS}


def is_watched() -> bool:
    """Whether stderr is a terminal."""
    return sys.stderr is not None and sys.stderr.isatty()
