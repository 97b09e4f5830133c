# SPDX-License-Identifier: BSD-3-Clause
"""What must hold of the command, whatever deck it is given."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

from flexact.apps.cli.main import main

from .trial import OffenceError, Outcome

#: Words before and behind the deck's path; of files the name.
VERBS: tuple[tuple[list[str], list[str]], ...] = (
    (["check"], []),
    (["analyse"], []),
    (["analyse", "--json"], []),
    (["analyse", "--accuracy", "2e-5"], ["-o", "results"]),
    (["declare"], ["-o", "declared.dat"]),
    (["export"], ["-o", "mesh.vtu"]),
    (["report"], ["-o", "page.html"]),
    (["picture"], ["-o", "picture.svg"]),
    (["convert"], ["-o", "tables.json"]),
    (["convert"], ["-o", "mesh.vtk"]),
)
#: One deck in so many goes through a verb in this process, and one through a process of its own.
EVERY, EVERY_PROCESS = 25, 250
#: Exit codes by what became of the deck; a verdict that is not reached is an error of its own.
_CODES = {Outcome.REFUSED: (1,), Outcome.ANALYSED: (0, 1, 2), Outcome.READ: (0, 1, 2)}
_LIMIT = 300.0


def try_command(text: bytes, outcome: Outcome) -> None:
    """Give the deck to a verb, now and then; which one, its bytes decide.

    Raises:
        OffenceError: what must hold does not.
        Exception: anything that escapes is an offence, too.
    """
    number = zlib.crc32(text)
    if number % EVERY:
        return
    before, behind = VERBS[number // EVERY % len(VERBS)]
    if before[0] not in ("check", "declare", "convert") and outcome is Outcome.READ:
        # Too large to be analysed.
        return
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "deck.dat"
        deck.write_bytes(text)
        last = [str(Path(folder) / word) if not word.startswith("-") else word for word in behind]
        words = [*before, str(deck), *last]
        run = _in_a_process if number % EVERY_PROCESS == 0 else _in_this_process
        code, said = run(words)
    what = f"flexact {' '.join([*before, 'deck.dat', *behind])}"
    if code not in _CODES[outcome]:
        raise OffenceError(f"{what} exits with {code}, though the deck is {outcome.value}:\n{said}")
    if "Traceback" in said:
        raise OffenceError(f"{what}:\n{said}")


def _in_a_process(words: list[str]) -> tuple[int, str]:
    ran = subprocess.run(
        [sys.executable, "-X", "faulthandler", "-m", "flexact", *words],
        capture_output=True,
        timeout=_LIMIT,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
    )
    return ran.returncode, ran.stderr.decode("utf-8")


def _in_this_process(words: list[str]) -> tuple[int, str]:
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8") for _ in range(2))
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(words)
        err.flush()
    return code, err.buffer.getvalue().decode("utf-8")
