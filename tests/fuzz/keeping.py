# SPDX-License-Identifier: BSD-3-Clause
"""Offending decks, as short as they can be made, in a folder."""

from __future__ import annotations

import re
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

from . import sanitized, workers
from .minimising import Fails, minimised
from .mutations import Case
from .workers import Judged

#: Of each kind; what comes after these is counted.
_MOST_KEPT = 3
#: How often a shorter deck is tried: in this process, or in one of its own.
_TRIES, _TRIES_OF_PROCESSES = 3000, 100


class Folder:
    """Where offending decks are kept, with the words of each beside it."""

    def __init__(self, path: Path) -> None:
        """Make it when something is kept."""
        self._path = path
        self._lock = threading.Lock()
        self.kinds: Counter[str] = Counter()

    def keep(self, found: Judged, of_core: bool) -> None:
        """Write a deck, and beside it as short a one as offends in the same way."""
        kind = kind_of(found)
        with self._lock:
            self.kinds[kind] += 1
            if self.kinds[kind] > _MOST_KEPT:
                return
        name = found.case.name
        self._write(f"{name}.whole.dat", found.case.text)
        self._write(f"{name}.txt", f"{found.offence}\n{found.words}\n".encode())
        self._write(f"{name}.dat", shortened(found, of_core))

    def _write(self, name: str, content: bytes) -> None:
        self._path.mkdir(parents=True, exist_ok=True)
        (self._path / name).write_bytes(content)

    def lines(self) -> Iterator[str]:
        """What was found, the most frequent first."""
        total = self.kinds.total()
        yield f"{total or 'no'} offence{'s' * (total != 1)}"
        for kind, count in self.kinds.most_common():
            yield f"{count:>9} {kind}"
        if self.kinds:
            yield f"Decks and words: {self._path}"


def kind_of(found: Judged) -> str:
    """What two decks share that offend in the same way: words and place, without numbers."""
    lines = [line.strip() for line in found.words.splitlines() if line.strip()] or [""]
    places = [line for line in lines if re.match(r'File ".*/flexact/|#\d+ .*flexact_', line)]
    said = lines[-1] if found.offence.startswith("traceback") else lines[0]
    where = re.sub(r".*/", "", (places[-1:] or [""])[0])
    return f"{found.offence}: {re.sub('[0-9]+', 'N', said)[:80]} {where}".strip()


def shortened(found: Judged, of_core: bool) -> bytes:
    """A part of the deck that offends in the same way."""
    kind = kind_of(found)

    def failing(judge: Callable[[Case], Judged | None]) -> Fails:
        def fails(text: bytes) -> bool:
            again = judge(Case(found.case.name, text))
            return again is not None and bool(again.offence) and kind_of(again) == kind

        return fails

    if of_core:
        fails = failing(lambda case: next(sanitized.judged([case]), None))
        return minimised(found.case.text, fails, _TRIES_OF_PROCESSES)
    if found.offence.startswith(("offence", "traceback")):
        fails = failing(workers.judge_without_command)
        if fails(found.case.text):
            return minimised(found.case.text, fails, _TRIES)
    fails = failing(lambda case: next(workers.judged([case], 1), None))
    return minimised(found.case.text, fails, _TRIES_OF_PROCESSES)
