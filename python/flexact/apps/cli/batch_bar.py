# SPDX-License-Identifier: BSD-3-Clause
"""How many of many decks are done, how fast, and how long it will still take."""

from __future__ import annotations

import contextlib
import sys
import time
from importlib import import_module
from typing import Any

from .bar import is_watched, size_of_terminal
from .terminal import complain

_FORM = "{n_fmt} of {total_fmt} decks |{bar}| {rate_fmt}, {remaining} left{postfix}"
#: Where nobody watches, in a log, a line is written so often [s].
_LINE = 60.0


class BatchBar:
    """A bar on stderr; where that is no terminal, a line from time to time."""

    def __init__(self, total: int, before: int) -> None:
        """Of so many decks some were done before."""
        self._total, self._before, self._done, self._errors = total, before, before, 0
        self._start = self._last = time.monotonic()
        self._bar: Any = None

    def __enter__(self) -> BatchBar:
        """Draw the bar, if somebody watches."""
        if is_watched():
            with contextlib.suppress(ImportError, OSError):
                self._bar = self._drawn()
        return self

    def __exit__(self, *_: object) -> None:
        """Wipe the bar."""
        if self._bar is not None:
            with contextlib.suppress(OSError):
                self._bar.close()

    def _drawn(self) -> Any:
        tqdm = import_module("tqdm").tqdm
        tqdm.monitor_interval = 0  # no thread of its own: processes are forked
        return tqdm(
            **{"total": self._total, "initial": self._before, "file": sys.stderr, "leave": False},
            **{"unit": " decks", "bar_format": _FORM, **size_of_terminal()},
        )

    def count(self, has_error: bool) -> None:
        """One more deck is done."""
        self._done += 1
        self._errors += has_error
        if self._bar is None:
            self._in_a_log()
            return
        with contextlib.suppress(OSError):
            if has_error:
                words = f"{self._errors} with errors"
                self._bar.set_postfix_str(words, refresh=False)
            self._bar.update(1)

    def _in_a_log(self) -> None:
        now = time.monotonic()
        if now - self._last < _LINE:
            return
        self._last = now
        rate = (self._done - self._before) / (now - self._start)
        left = import_module("tqdm").tqdm.format_interval((self._total - self._done) / rate)
        complain(f"{self._done} of {self._total} decks, {rate:.3g} decks/s, {left} left")
