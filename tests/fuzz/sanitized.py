# SPDX-License-Identifier: BSD-3-Clause
"""Decks through the core alone, built with sanitizers and all run-time checks."""

from __future__ import annotations

import os
import resource
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from .mutations import Case
from .seeds import ROOT
from .workers import LIMIT, LONGEST_WAIT, Judged

#: The program fuzz_core, which tools/test_core.sh builds.
PROGRAM = ROOT / "build" / "mechanics" / "tests" / "fuzz" / "fuzz_core"
#: So many decks a process.
BATCH = 200
#: Leaks are not looked for: what is allocated in the main program of a Fortran run counts as one.
_OPTIONS = {
    "ASAN_OPTIONS": "detect_leaks=0",
    "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
    "OPENBLAS_NUM_THREADS": "1",
}


def judged(cases: Iterable[Case], program: Path = PROGRAM) -> Iterator[Judged]:
    """Those decks over which the program ended; the others are taken in silence."""
    waiting = iter(cases)
    while batch := list(islice(waiting, BATCH)):
        while batch:
            taken, found = _run(batch, program)
            if found is not None:
                yield found
            batch = batch[taken:]


def _run(batch: list[Case], program: Path) -> tuple[int, Judged | None]:
    """How many decks were taken, and what the last of them ended with, if it did."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{number}.dat" for number in range(len(batch))]
        for path, case in zip(paths, batch, strict=True):
            path.write_bytes(case.text)
        names = Path(folder) / "decks"
        names.write_text("".join(f"{path}\n" for path in paths), encoding="utf-8")
        try:
            ran = subprocess.run(
                [program, names],
                capture_output=True,
                timeout=LONGEST_WAIT,
                env={**os.environ, **_OPTIONS},
                preexec_fn=_limit_time,
            )
        except subprocess.TimeoutExpired as late:
            taken = (late.stdout or b"").count(b"\n")
            return taken, _ended(batch[taken - 1], "hang", late.stderr or b"")
    taken = ran.stdout.count(b"\n")
    if ran.returncode == 0 and taken == len(batch):
        return taken, None
    return taken, _ended(batch[taken - 1], f"sanitizer ({ran.returncode})", ran.stderr)


def _limit_time() -> None:
    limit = int(LIMIT * BATCH / 10)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))


def _ended(case: Case, offence: str, said: bytes) -> Judged:
    return Judged(case, "", offence, said.decode("utf-8", "replace")[:6000])
